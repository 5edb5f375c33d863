//! Axis-aligned boxes.

use super::Point;
use super::lanes::Number;

/// An axis-aligned box; empty while `min > max` on some axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Aabb {
    /// The least corner.
    pub min: Point,
    /// The greatest corner.
    pub max: Point,
}

impl Aabb {
    /// The box that holds nothing.
    pub const EMPTY: Self = Self { min: Point::INFINITY, max: Point::NEG_INFINITY };

    /// The smallest box around `points`.
    #[inline]
    pub fn around<'a>(points: impl IntoIterator<Item = &'a Point>) -> Self {
        points.into_iter().fold(Self::EMPTY, |b, &p| b.with(p))
    }

    /// The smallest box that holds `self` and `p`.
    #[inline]
    pub fn with(self, p: Point) -> Self {
        Self { min: self.min.min(p), max: self.max.max(p) }
    }

    /// True if the box holds no point.
    pub fn is_empty(&self) -> bool {
        self.min.cmpgt(self.max).any()
    }

    /// Edge lengths; zero for an empty box.
    pub fn size(&self) -> Point {
        if self.is_empty() { Point::ZERO } else { self.max - self.min }
    }

    /// Length of the diagonal; zero for an empty box.
    pub fn diagonal(&self) -> f64 {
        self.size().length()
    }

    /// The middle of the box.
    pub fn center(&self) -> Point {
        self.min.midpoint(self.max)
    }

    /// True if the two closed boxes share a point.
    #[inline]
    pub fn touches(&self, other: &Self) -> bool {
        self.min.cmple(other.max).all() && other.min.cmple(self.max).all()
    }

    /// The square of the distance from `p` to the box; 0 within.
    pub fn distance_squared(&self, p: Point) -> f64 {
        let (below, above) = (self.min - p, p - self.max);
        let gap = |axis: usize| below[axis].greater(above[axis]).greater(0.0);
        Point::new(gap(0), gap(1), gap(2)).length_squared()
    }

    /// True if `other` holds all of this closed box.
    pub fn is_within(&self, other: &Self) -> bool {
        other.min.cmple(self.min).all() && self.max.cmple(other.max).all()
    }

    /// The box grown by `margin` on every side.
    #[inline]
    pub fn grown(&self, margin: f64) -> Self {
        Self { min: self.min - Point::splat(margin), max: self.max + Point::splat(margin) }
    }
}
