//! Background meshes: hexes around a solid, out of which its core is cut (section 4).
//!
//! - [`grid`]: a grid along the solid's own axes whose lines stand in its planar surfaces.
//! - [`swept`]: the quads of its principal face, layer by layer along a direction.
//! - [`octree`]: such a grid, refined where the solid or the user wants smaller cells.
//! - [`choose`] tells which background suits a solid; [`retry`] what to refine where one failed.

mod choose;
mod demand;
mod drivers;
mod grid;
mod lines;
mod octree;
mod pieces;
mod rows;
mod swept;
mod touched;

pub use choose::{Choice, Kind, SweptScore, choose, grid_capture};
pub use drivers::{Failure, Retry, retry};
pub use grid::{AlignedGrid, BackgroundError, estimate_hexes, grid};
pub use octree::{Octree, OctreeMesh, octree};
pub use swept::{SweepError, swept};
