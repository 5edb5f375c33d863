//! Solids in their own frame.

use super::{Convex, Point, QuadHull};

/// A convex solid about the origin, with its boundary.
pub trait Solid: Convex {
    /// True if `p` is in the solid.
    fn holds(&self, p: Point) -> bool;

    /// True if the two share a point.
    fn meets(&self, hull: &QuadHull) -> bool;

    /// The solid with each of its extents longer by `by`: it holds all points that are at most so far away.
    fn grown(&self, by: f64) -> Self;
}
