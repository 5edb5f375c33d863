//! The point of a surface that is nearest to another point.

use rstar::{AABB, PointDistance, RTreeObject};

use super::grove::Grove;
use super::{Aabb, Point, closest_on_triangle};
use crate::{Cancelled, Monitor, Silent};

/// Finds, among many triangles, the one that is nearest to a point: R-trees, packed once.
#[derive(Debug)]
pub struct NearestTriangle {
    trees: Grove<Leaf>,
}

/// A triangle by its corners, and its place in the order in which the triangles were given.
#[derive(Clone, Debug)]
struct Leaf {
    corners: [Point; 3],
    index: usize,
}

/// The triangle that is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Its place in the order in which the triangles were given.
    pub triangle: usize,
    /// Its point that is closest.
    pub point: Point,
}

impl NearestTriangle {
    /// An index of triangles with finite corners.
    pub fn new(triangles: impl IntoIterator<Item = [Point; 3]>) -> Self {
        Self::within(triangles, &Silent).expect("nobody stops it")
    }

    /// As [`new`](Self::new), told by a monitor when to stop.
    ///
    /// # Errors
    /// If the monitor stops it.
    pub fn within(
        triangles: impl IntoIterator<Item = [Point; 3]>,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let leaves = triangles.into_iter().enumerate().map(|(index, corners)| Leaf { corners, index });
        Ok(Self { trees: Grove::plant(leaves.collect(), monitor)? })
    }

    /// The triangle that is nearest to `p`; `None` if there are no triangles.
    pub fn nearest(&self, p: Point) -> Option<Nearest> {
        let leaf = self.trees.nearest(p)?;
        Some(Nearest { triangle: leaf.index, point: closest_on_triangle(p, leaf.corners) })
    }

    /// The point of a triangle that is closest to `p`; `None` if there are no triangles.
    pub fn closest_point(&self, p: Point) -> Option<Point> {
        self.nearest(p).map(|nearest| nearest.point)
    }
}

impl RTreeObject for Leaf {
    type Envelope = AABB<[f64; 3]>;

    fn envelope(&self) -> Self::Envelope {
        let bounds = Aabb::around(&self.corners);
        AABB::from_corners(bounds.min.to_array(), bounds.max.to_array())
    }
}

impl PointDistance for Leaf {
    fn distance_2(&self, point: &[f64; 3]) -> f64 {
        let point = Point::from_array(*point);
        closest_on_triangle(point, self.corners).distance_squared(point)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A zigzag of triangles over the unit square, `n` times `n` pairs.
    fn sheet(n: usize) -> Vec<[Point; 3]> {
        let at = |i: usize, j: usize| {
            let [x, y] = [i, j].map(|k| k as f64 / n as f64);
            Point::new(x, y, if (i + j).is_multiple_of(2) { 0.0 } else { 0.1 })
        };
        let cell =
            |i, j| [[at(i, j), at(i + 1, j), at(i, j + 1)], [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]];
        (0..n * n).flat_map(|k| cell(k % n, k / n)).collect()
    }

    #[test]
    fn the_tree_finds_what_a_walk_over_all_finds() {
        let triangles = sheet(9);
        let index = NearestTriangle::new(triangles.iter().copied());
        for k in 0..200 {
            let p = Point::new(
                f64::from(k % 7) / 4.0 - 0.3,
                f64::from(k % 11) / 7.0 - 0.2,
                f64::from(k % 5) - 2.0,
            );
            let walked = triangles
                .iter()
                .map(|t| closest_on_triangle(p, *t).distance(p))
                .fold(f64::INFINITY, f64::min);
            let nearest = index.nearest(p).unwrap();
            assert_eq!(nearest.point.distance(p), walked, "{p}");
            assert_eq!(closest_on_triangle(p, triangles[nearest.triangle]), nearest.point, "{p}");
        }
    }

    #[test]
    fn no_triangles_have_no_nearest_point() {
        assert_eq!(NearestTriangle::new([]).closest_point(Point::ZERO), None);
    }

    #[cfg(not(target_arch = "wasm32"))]
    mod random {
        use proptest::prelude::*;

        use super::*;
        use crate::geometry::samples::{point, points};

        proptest! {
            #[test]
            fn the_closest_point_agrees_with_a_search_of_all(
                triangles in prop::collection::vec(points::<3>(1.0), 1..60), p in point(2.0),
            ) {
                let found = NearestTriangle::new(triangles.iter().copied()).closest_point(p).unwrap();
                let distances = triangles.iter().map(|t| closest_on_triangle(p, *t).distance(p));
                prop_assert_eq!(found.distance(p), distances.fold(f64::INFINITY, f64::min));
            }
        }
    }
}
