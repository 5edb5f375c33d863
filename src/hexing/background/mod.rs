//! Background meshes: hexes around a solid, out of which its core is cut (section 4).
//!
//! [`grid`]: a grid along the solid's own axes whose lines stand in its planar surfaces. [`swept`]: the quads of its
//! principal face, layer by layer along a direction.

mod grid;
mod lines;
mod rows;
mod swept;
mod touched;

pub use grid::{AlignedGrid, BackgroundError, estimate_hexes, grid};
pub use swept::{SweepError, swept};

use crate::solid::SolidModel;

/// What the solid encloses.
pub(super) fn volume(solid: &SolidModel) -> f64 {
    let center = solid.bounds().center();
    let corners = solid.triangles().iter().map(|t| t.map(|p| solid.points()[p as usize] - center));
    corners.map(|[a, b, c]| a.dot(b.cross(c)) / 6.0).sum()
}
