//! How far something reaches along a direction, and what of it can be told apart in a sweep.

use crate::geometry::Point;
use crate::solid::{SolidModel, Surface};

/// Heights closer than this, in edge lengths, are one level of a sweep: no layer is between them.
pub(super) const ONE_LEVEL: f64 = 0.25;

/// By so little, in edge lengths, half an edge is missed where it is only by rounding.
pub(super) const ROUNDED: f64 = 1e-6;

/// From where to where something reaches along a direction.
#[derive(Clone, Copy, Debug)]
pub(super) struct Extent {
    pub(super) low: f64,
    pub(super) high: f64,
}

impl Extent {
    pub(super) fn of(points: impl Iterator<Item = Point>, direction: Point) -> Self {
        let none = Self { low: f64::INFINITY, high: f64::NEG_INFINITY };
        points
            .map(|p| p.dot(direction))
            .fold(none, |Self { low, high }, at| Self { low: low.min(at), high: high.max(at) })
    }

    pub(super) fn of_surface(solid: &SolidModel, surface: &Surface, direction: Point) -> Self {
        Self::of(surface.triangles.iter().flat_map(|&t| solid.corners_of(t as usize)), direction)
    }

    pub(super) fn thickness(self) -> f64 {
        self.high - self.low
    }

    pub(super) fn middle(self) -> f64 {
        0.5 * (self.low + self.high)
    }
}
