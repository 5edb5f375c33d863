//! Sizing: where a mesh is to be refined, and how far.

mod field;
mod region;

pub use field::{SizeField, SizeOptions, SizedElement, SizingError};
pub use region::{Region, Shape, Target};
