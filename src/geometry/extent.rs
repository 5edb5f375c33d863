//! How large a mesh is and how far from the origin: whether its coordinates can be reckoned with, and divided so often.

use super::{Aabb, Point};

/// The largest coordinate, and the inverse of the smallest extent: a product of four lengths stays a number.
const LARGEST: f64 = 1e60;

/// How many of the least steps between coordinates an edge must keep.
const LEAST_STEPS: f64 = 64.0;

/// The size of a mesh and its place.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Extent {
    /// The diagonal of the box around the nodes.
    pub size: f64,
    /// The greatest coordinate, without its sign.
    pub reach: f64,
}

impl Extent {
    /// That of finite points.
    pub fn of<'a>(points: impl IntoIterator<Item = &'a Point>) -> Self {
        let bounds = Aabb::around(points);
        if bounds.is_empty() {
            return Self { size: 0.0, reach: 0.0 };
        }
        let reach = bounds.min.abs().max_element().max(bounds.max.abs().max_element());
        // Squares of the sides may be no numbers where these are.
        let longest = bounds.size().max_element();
        let size = if longest > 0.0 { longest * (bounds.size() / longest).length() } else { 0.0 };
        Self { size, reach }
    }

    /// True if lengths, areas and volumes are numbers.
    pub fn is_in_range(&self) -> bool {
        let Self { size, reach } = *self;
        reach <= LARGEST && size <= LARGEST && (size == 0.0 || size >= 1.0 / LARGEST)
    }

    /// True if the nodes at the ends of edges of this length are told apart by the digits of the coordinates.
    pub fn has_digits_for(&self, edge: f64) -> bool {
        edge >= LEAST_STEPS * f64::EPSILON * self.reach
    }
}
