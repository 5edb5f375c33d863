//! Sizing: where a mesh is to be refined, and how far.
//!
//! A [`Region`] is a shape and what is wanted in it; a [`SizeField`] is made once of regions, a global edge length
//! and a limit of curvature, and then tells of any number of elements, from any number of threads, whether each is
//! to be refined.

mod curvature;
mod error;
mod field;
mod json;
mod overlap;
mod region;

pub use error::{RegionFault, SizingError};
pub use field::{SizeField, SizeOptions, SizedElement};
pub use region::{Region, Shape, Target};

pub(crate) use curvature::turn_per_length;
pub(crate) use field::limit;

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests;
