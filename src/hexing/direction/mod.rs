//! Directions of a solid: the frame that suits a grid.

mod clusters;
mod frame;

pub use frame::best_frame;

#[cfg(test)]
mod tests;
