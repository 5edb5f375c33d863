//! What is nearest among many points or triangles.
//!
//! Both are kept in R*-trees of the `rstar` crate, loaded in bulk: that splits by count, so the trees are
//! balanced whatever the data (parry's builder splits by volume, which is 0 for all of a flat surface),
//! works in f64 throughout and on wasm32, and answers depend on the data alone.

use rstar::{AABB, PointDistance, RTree, RTreeObject};

use super::{Point, Triangle};

/// Many points.
#[derive(Clone, Debug)]
pub struct NearestPoint(RTree<[f64; 3]>);

impl NearestPoint {
    /// Prepares `points`, all finite.
    pub fn new(points: &[Point]) -> Self {
        Self(RTree::bulk_load(points.iter().map(|p| p.to_array()).collect()))
    }

    /// The point nearest to `p`; `None` if there are no points.
    pub fn closest_point(&self, p: Point) -> Option<Point> {
        self.0.nearest_neighbor(p.to_array()).map(|&q| q.into())
    }

    /// The points within `radius` of `p`, in no particular order.
    pub fn within(&self, p: Point, radius: f64) -> impl Iterator<Item = Point> {
        self.0.locate_within_distance(p.to_array(), radius * radius).map(|&q| q.into())
    }
}

/// Many triangles.
#[derive(Clone, Debug)]
pub struct NearestTriangle(RTree<Leaf>);

impl NearestTriangle {
    /// Prepares `triangles`, all finite.
    pub fn new(triangles: impl IntoIterator<Item = Triangle>) -> Self {
        Self(RTree::bulk_load(triangles.into_iter().map(Leaf).collect()))
    }

    /// The point of a triangle nearest to `p`; `None` if there are no triangles.
    pub fn closest_point(&self, p: Point) -> Option<Point> {
        self.0.nearest_neighbor(p.to_array()).map(|leaf| leaf.0.closest_point(p))
    }

    /// The triangles within `radius` of `p`, in no particular order.
    pub fn within(&self, p: Point, radius: f64) -> impl Iterator<Item = &Triangle> {
        self.0.locate_within_distance(p.to_array(), radius * radius).map(|leaf| &leaf.0)
    }
}

#[derive(Clone, Debug)]
struct Leaf(Triangle);

impl RTreeObject for Leaf {
    type Envelope = AABB<[f64; 3]>;

    fn envelope(&self) -> Self::Envelope {
        let bounds = self.0.bounds();
        AABB::from_corners(bounds.min.to_array(), bounds.max.to_array())
    }
}

impl PointDistance for Leaf {
    fn distance_2(&self, p: &[f64; 3]) -> f64 {
        self.0.distance_squared((*p).into())
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::geometry::testing::{point, triangle};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn trees_find_what_a_walk_over_all_finds(
            points in proptest::collection::vec(point(), 0..80),
            triangles in proptest::collection::vec(triangle(), 0..60),
            p in point(),
            radius in 0.0..1.5f64,
        ) {
            let least = |d: &mut dyn Iterator<Item = f64>| d.fold(None, |m: Option<f64>, d| Some(m.map_or(d, |m| m.min(d))));
            let tree = NearestPoint::new(&points);
            let found = tree.closest_point(p).map(|q| q.distance_squared(p));
            prop_assert_eq!(found, least(&mut points.iter().map(|q| q.distance_squared(p))));
            let near = points.iter().filter(|q| q.distance_squared(p) <= radius * radius).count();
            prop_assert_eq!(tree.within(p, radius).count(), near);

            let tree = NearestTriangle::new(triangles.iter().copied());
            let found = tree.closest_point(p).map(|q| q.distance_squared(p));
            prop_assert_eq!(found, least(&mut triangles.iter().map(|t| t.distance_squared(p))));
            let near = triangles.iter().filter(|t| t.distance_squared(p) <= radius * radius).count();
            prop_assert_eq!(tree.within(p, radius).count(), near);
        }
    }

    #[test]
    fn a_million_equal_points_are_no_trouble() {
        let tree = NearestPoint::new(&vec![Point::ONE; 1_000_000]);
        assert_eq!(tree.closest_point(Point::ZERO), Some(Point::ONE));
    }
}
