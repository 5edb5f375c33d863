//! Sizing: where a mesh is to be refined, and how far.

mod region;

pub use region::{Region, Shape, Target};
