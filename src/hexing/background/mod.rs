//! Background meshes: hexes around a solid, out of which its core is cut (section 4).
//!
//! - [`grid`]: a grid along the solid's own axes whose lines stand in its planar surfaces.
//! - [`Sweep`]: the quads of its principal face, layer by layer along a direction.
//! - [`Shell`]: a layer of hexes between the two sides of a thin shell.
//! - [`octree`]: a grid, refined where the solid or the user wants smaller cells; a sweep is refined so too.
//! - [`choose`] tells which background suits a solid; [`retry`] what to refine where one failed.

mod choose;
mod columns;
mod demand;
mod drivers;
mod grid;
mod levels;
mod lines;
mod middle;
mod octree;
mod pieces;
mod rows;
mod shell;
mod sides;
mod swept;
mod touched;

pub use choose::{Background, Choice, SweptScore, choose, grid_capture, may_sweep};
pub use drivers::{Failure, Missed, retry};
pub(super) use grid::has_walls;
pub use grid::{AlignedGrid, BackgroundError, check_size, estimate_hexes, grid};
pub(super) use lines::LEAST_GAP;
pub(super) use octree::refined;
pub use octree::{Octree, OctreeMesh, Wanted, octree};
pub use shell::Shell;
pub(super) use sides::thickness;
pub use swept::{Sweep, SweepError, SweepOptions};
