//! Random shapes and dense samples for this module's tests.

use proptest::prelude::*;

use super::{Point, Triangle};

/// Coordinates from -1 to 1, often on a coarse lattice, so that touching, parallel and degenerate
/// shapes come up.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![-1.0..1.0f64, (-2i32..=2).prop_map(|i| f64::from(i) / 2.0)]
}

pub(crate) fn point() -> impl Strategy<Value = Point> {
    [coordinate(), coordinate(), coordinate()].prop_map(Point::from)
}

pub(crate) fn triangle() -> impl Strategy<Value = Triangle> {
    [point(), point(), point()].prop_map(Triangle)
}

/// Points all over a triangle, `n` steps along each side.
pub(crate) fn samples(t: &Triangle, n: u32) -> impl Iterator<Item = Point> {
    let [a, b, c] = t.0;
    (0..=n).flat_map(move |i| {
        (0..=n - i).map(move |j| {
            a + (b - a) * (f64::from(i) / f64::from(n)) + (c - a) * (f64::from(j) / f64::from(n))
        })
    })
}
