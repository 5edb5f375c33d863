//! Between model units and units of twice the edge length, in which the mesher works.

use glam::DVec2;

use super::mesher::FaceError;
use super::planar::axes;
use crate::geometry::Point;

/// How many of the least steps between coordinates an edge must keep.
const LEAST_STEPS: f64 = 4096.0;

/// So many steps to a unit are told apart in what is projected: what lies whole numbers of edges apart does so up to its last
/// bit, and what comes of it does not hang on the last bits of the edge length.
const STEPS: f64 = (1_u64 << 42) as f64;

/// Units of twice the edge length around the middle of a region.
#[derive(Clone, Copy, Debug)]
pub(super) struct Scale {
    middle: DVec2,
    unit: f64,
}

impl Scale {
    /// For points of a plane.
    pub(super) fn new(points: impl Iterator<Item = DVec2>, edge_length: f64) -> Result<Self, FaceError> {
        if !(edge_length > 0.0 && edge_length.is_finite()) {
            return Err(FaceError::EdgeLength(edge_length));
        }
        let none = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let (least, most) = points.fold(none, |(a, b), p| (a.min(p), b.max(p)));
        if !(least.is_finite() && most.is_finite()) {
            return Err(FaceError::Empty);
        }
        let reach = least.abs().max(most.abs()).max_element();
        if edge_length < LEAST_STEPS * f64::EPSILON * reach {
            return Err(FaceError::TooFewDigits { edge_length, reach });
        }
        Ok(Self { middle: least.midpoint(most), unit: 2.0 * edge_length })
    }

    pub(super) fn unit_from_model(&self, p: DVec2) -> DVec2 {
        (p - self.middle) / self.unit
    }

    pub(super) fn model_from_unit(&self, p: DVec2) -> DVec2 {
        p * self.unit + self.middle
    }

    /// In model units.
    pub(super) fn edge_length(&self) -> f64 {
        0.5 * self.unit
    }

    pub(super) fn length_from_unit(&self, length: f64) -> f64 {
        length * self.unit
    }
}

/// Along a direction, onto a plane across it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Projection {
    /// Unit vectors in the plane, and the direction, right-handed.
    pub(super) axes: [Point; 3],
    pub(super) scale: Scale,
}

impl Projection {
    /// For `points` in space; the direction may be of any length but 0.
    pub(super) fn new(points: &[Point], direction: Point, edge_length: f64) -> Result<Self, FaceError> {
        let Some(direction) = direction.try_normalize() else { return Err(FaceError::Direction) };
        let axes = axes(direction);
        let flat = points.iter().map(|p| DVec2::new(p.dot(axes[0]), p.dot(axes[1])));
        Ok(Self { axes, scale: Scale::new(flat, edge_length)? })
    }

    pub(super) fn direction(&self) -> Point {
        self.axes[2]
    }

    /// Rounded to whole steps.
    pub(super) fn unit_from_model(&self, p: Point) -> DVec2 {
        let place = self.scale.unit_from_model(DVec2::new(p.dot(self.axes[0]), p.dot(self.axes[1])));
        place.map(|x| (x * STEPS).round_ties_even() / STEPS)
    }
}
