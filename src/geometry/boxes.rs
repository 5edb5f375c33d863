//! How far a point is from boxes, eight of which are looked at side by side.
//!
//! They are kept in single precision, as shares of a cube around all of them, and rounded outwards, as is the point: what
//! is told is never more than the distance, and hardly less.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f32x8};

use super::lanes::{Number, SINGLES, SingleRow, SingleRows, Vectors};
use super::{Aabb, Point};

/// Coordinates are rounded outwards by this share of the greatest.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// So many times the cube is as far as anything need be told: a point that is farther off is taken to be there.
const FAR: f64 = (1u64 << 40) as f64;

/// Half the edge of the cube is so many edges of small ones.
const PARTS: f64 = 64.0;

/// Squares of distances may be computed greater by this share than they are.
const SQUARES: f64 = 1e-6;

/// The cube around some boxes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Cube {
    center: Point,
    /// One over half of its edge.
    scale: f64,
    /// By how much coordinates are rounded outwards.
    slack: f64,
}

/// Eight boxes in a cube.
#[derive(Clone, Debug)]
pub(super) struct Boxes {
    min: SingleRows,
    max: SingleRows,
}

/// Where a point is in a cube: no less than `low` and no more than `high`.
#[derive(Clone, Copy)]
pub(super) struct Place<S: Simd> {
    low: Vectors<f32x8<S>>,
    high: Vectors<f32x8<S>>,
}

impl Cube {
    pub(super) fn around(bounds: &Aabb) -> Self {
        let half = 0.5 * bounds.size().max_element();
        let scale = if half > 0.0 && (1.0 / half).is_finite() { 1.0 / half } else { 1.0 };
        let extent = bounds.min.abs().max(bounds.max.abs()).max_element();
        Self { center: bounds.center(), scale, slack: ROUNDING * extent * scale }
    }

    /// A number for each of the small cubes that this one and what is around it is divided into. Two may have the same.
    pub(super) fn part(&self, p: Point) -> usize {
        let [x, y, z] = self.share(p).map(|x| (x * PARTS) as i64 as usize);
        x.wrapping_mul(0x9e37).wrapping_add(y.wrapping_mul(0x79b9)).wrapping_add(z.wrapping_mul(0x7f4b))
    }

    #[inline(always)]
    pub(super) fn place<S: Simd>(&self, simd: S, p: Point) -> Place<S> {
        let [low, high] = [-1.0, 1.0].map(|side| self.rounded(p, side));
        Place { low: Vectors::splat(simd, low), high: Vectors::splat(simd, high) }
    }

    /// What no square of a distance is above, if that is no more than `squared`.
    pub(super) fn limit(&self, squared: f64) -> f32 {
        let limit = squared * self.scale * self.scale * (1.0 + SQUARES);
        (limit as f32 + f32::MIN_POSITIVE).min(f32::MAX)
    }

    /// What no coordinate of a point is below, as a share, or above, where `side` is 1 for -1.
    fn rounded(&self, p: Point, side: f64) -> [f32; 3] {
        self.share(p).map(|x| {
            let x = (x + side * self.slack) as f32;
            // More than rounding to single precision takes from a number, or gives it.
            x + side as f32 * (x.abs() * f32::EPSILON + f32::MIN_POSITIVE)
        })
    }

    fn share(&self, p: Point) -> [f64; 3] {
        ((p - self.center) * self.scale).to_array().map(|x| x.clamp(-FAR, FAR))
    }
}

impl Boxes {
    /// Boxes that are farther than any limit.
    pub(super) const NONE: Self =
        Self { min: [[f32::INFINITY; SINGLES]; 3], max: [[f32::NEG_INFINITY; SINGLES]; 3] };

    pub(super) fn set(&mut self, lane: usize, cube: &Cube, bounds: &Aabb) {
        let (min, max) = (cube.rounded(bounds.min, -1.0), cube.rounded(bounds.max, 1.0));
        for axis in 0..3 {
            (self.min[axis][lane], self.max[axis][lane]) = (min[axis], max[axis]);
        }
    }

    /// How far the place is from each of them, squared, and which of them are no farther than the limit.
    #[inline(always)]
    pub(super) fn within<S: Simd>(&self, simd: S, place: &Place<S>, limit: f32) -> (SingleRow, u64) {
        let (min, max) = (Vectors::load(simd, &self.min), Vectors::load(simd, &self.max));
        let zero = f32x8::splat(simd, 0.0);
        let (below, above) = (min - place.high, place.low - max);
        let gap = Vectors {
            x: below.x.greater(above.x).greater(zero),
            y: below.y.greater(above.y).greater(zero),
            z: below.z.greater(above.z).greater(zero),
        };
        let squared = gap.length_squared();
        (squared.to_array(), squared.simd_le(limit).to_bitmask())
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use fearless_simd::dispatch;
    use proptest::prelude::*;

    use super::super::lanes::level;
    use super::*;
    use crate::geometry::samples::{point, points};

    /// The squares of the distances of `p`, in the units of `p`, and which of the boxes are within the limit.
    fn seen(bounds: &[Aabb], p: Point, squared: f64) -> (Vec<f64>, Vec<bool>) {
        let all = bounds.iter().fold(Aabb::EMPTY, |all, b| all.with(b.min).with(b.max));
        let cube = Cube::around(&all);
        let mut boxes = Boxes::NONE;
        bounds.iter().enumerate().for_each(|(lane, b)| boxes.set(lane, &cube, b));
        let limit = cube.limit(squared);
        let (distances, found) = dispatch!(level(), simd => boxes.within(simd, &cube.place(simd, p), limit));
        let unit = 1.0 / (cube.scale * cube.scale);
        let lanes = 0..bounds.len();
        assert_eq!(found >> bounds.len(), 0, "there are no others");
        (
            lanes.clone().map(|k| f64::from(distances[k]) * unit).collect(),
            lanes.map(|k| found >> k & 1 == 1).collect(),
        )
    }

    proptest! {
        /// Near the origin and far from it, in small units and in large ones.
        #[test]
        fn boxes_are_never_said_to_be_farther_than_they_are(
            ends in prop::collection::vec(points::<2>(1.0), 1..=SINGLES),
            p in point(3.0),
            exponents in (-20i32..20, 0i32..8),
        ) {
            let unit = libm::exp10(exponents.0.into());
            let offset = Point::splat(unit * libm::exp10(exponents.1.into()));
            let placed = |p: Point| p * unit + offset;
            let p = placed(p);
            let bounds: Vec<Aabb> = ends.iter().map(|&ends| Aabb::around(&ends.map(placed))).collect();
            let exact: Vec<f64> = bounds.iter().map(|b| b.distance_squared(p)).collect();
            for squared in exact.iter().copied().chain([0.0]) {
                let (distances, found) = seen(&bounds, p, squared);
                let reach = 1e-5 * unit + 1e-12 * offset.x;
                for ((&exact, distance), found) in exact.iter().zip(distances).zip(found) {
                    prop_assert!(distance <= exact * (1.0 + SQUARES));
                    prop_assert!(distance.sqrt() >= exact.sqrt() * (1.0 - 1e-5) - reach, "{distance} {exact}");
                    prop_assert!(found || exact > squared);
                }
            }
        }
    }

    #[test]
    fn places_beyond_all_numbers_are_within_some_limit() {
        let bounds = [Aabb { min: Point::ZERO, max: Point::ONE }, Aabb { min: Point::ONE, max: Point::ONE }];
        for p in [Point::splat(1e300), Point::X * -1e200] {
            assert_eq!(seen(&bounds, p, f64::INFINITY).1, [true, true]);
        }
        assert_eq!(seen(&bounds[1..], Point::ONE, 0.0).1, [true], "a cube of no size");
    }
}
