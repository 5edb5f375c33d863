//! Random shapes and dense samples of them, for tests.

use proptest::prelude::*;

use super::Point;

/// A point whose coordinates are at most `reach` from 0.
pub(crate) fn point(reach: f64) -> impl Strategy<Value = Point> {
    [-reach..reach, -reach..reach, -reach..reach].prop_map(Point::from)
}

/// `N` such points.
pub(crate) fn points<const N: usize>(reach: f64) -> impl Strategy<Value = [Point; N]> {
    prop::collection::vec(point(reach), N).prop_map(|v| v.try_into().expect("N points"))
}

/// A unit quaternion.
pub(crate) fn rotation() -> impl Strategy<Value = glam::DQuat> {
    let unit = -1.0..1.0_f64;
    [unit.clone(), unit.clone(), unit.clone(), unit]
        .prop_map(glam::DQuat::from_array)
        .prop_filter("a direction", |q| q.length() > 0.1)
        .prop_map(glam::DQuat::normalize)
}

/// Samples of a triangle: its corners and a grid of `n` steps an edge.
pub(crate) fn of_triangle([a, b, c]: [Point; 3], n: u32) -> impl Iterator<Item = Point> {
    (0..=n).flat_map(move |i| {
        (0..=n - i).map(move |j| {
            let (u, v) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
            a + (b - a) * u + (c - a) * v
        })
    })
}

/// Samples of the hull of four points: its corners and a grid of `n` steps an edge.
pub(crate) fn of_hull([a, b, c, d]: [Point; 4], n: u32) -> impl Iterator<Item = Point> {
    (0..=n).flat_map(move |k| {
        let w = f64::from(k) / f64::from(n);
        let towards = move |p: Point| p + (d - p) * w;
        of_triangle([towards(a), towards(b), towards(c)], (n - k).max(1))
    })
}
