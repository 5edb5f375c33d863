//! Sizing: where a mesh is to be refined, and how far.
//!
//! [`Region`]s say what a user wants; a [`SizeField`] is made of them, the edge length and the input's
//! curvature, and answers for each element whether it is to be refined. A caller's own
//! [`SizeFunction`] stands beside it.

mod curvature;
mod error;
mod field;
mod function;
mod probe;
mod region;
mod zone;

pub use error::{RegionFault, SizingError};
pub use field::{Demand, SizeField, SizeOptions, SizedElement};
pub use function::{SizeFunction, check_targets};
pub use region::{Region, Shape, Target};
