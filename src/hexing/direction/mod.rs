//! Directions of a solid: the principal one of the paper's swept background, and the frame that suits a grid.

mod clusters;
mod frame;
mod principal;
mod silhouette;

pub(super) use clusters::{PARALLEL, PERPENDICULAR};
pub use frame::best_frame;
pub use principal::{DirectionScore, principal_directions};

#[cfg(test)]
mod tests;
