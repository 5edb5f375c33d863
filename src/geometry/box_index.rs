//! A spatial index over many axis-aligned boxes.

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::{Aabb, Point};

type Entry = GeomWithData<Rectangle<[f64; 3]>, u32>;

/// A thing may come out this share nearer than its box, because the two are computed differently.
const ROUNDING: f64 = 1e-12;

/// Finds, among many boxes, those that touch another one, and the nearest: an R-tree, packed once.
#[derive(Debug)]
pub struct BoxIndex {
    tree: RTree<Entry>,
}

impl BoxIndex {
    /// An index of `boxes`, numbered from 0. Empty boxes are never found.
    ///
    /// # Panics
    /// If there are more than 2^32 boxes.
    pub fn new(boxes: impl IntoIterator<Item = Aabb>) -> Self {
        let entries = boxes.into_iter().enumerate().filter(|(_, b)| !b.is_empty()).map(|(i, b)| {
            let number = u32::try_from(i).expect("more than 2^32 boxes");
            // The middle of an unbounded box would be no number, which the tree cannot sort.
            let (min, max) = (b.min.max(Point::MIN), b.max.min(Point::MAX));
            Entry::new(Rectangle::from_corners(min.to_array(), max.to_array()), number)
        });
        Self { tree: RTree::bulk_load(entries.collect()) }
    }

    /// An index of `points`, numbered from 0.
    pub fn of_points<'a>(points: impl IntoIterator<Item = &'a Point>) -> Self {
        Self::new(points.into_iter().map(|&p| Aabb { min: p, max: p }))
    }

    /// The numbers of the boxes that touch `query`, in no order that means anything.
    pub fn touching(&self, query: &Aabb) -> impl Iterator<Item = usize> {
        let envelope = AABB::from_corners(query.min.to_array(), query.max.to_array());
        self.tree.locate_in_envelope_intersecting(envelope).map(|entry| entry.data as usize)
    }

    /// The thing in a box that is nearest to `p`, and its distance squared; of several the one with the least number.
    /// `distance_squared` tells of each thing how far it is; none is outside its box.
    pub fn nearest(&self, p: Point, distance_squared: impl Fn(usize) -> f64) -> Option<(usize, f64)> {
        let mut best: Option<(usize, f64)> = None;
        for (entry, to_box) in self.tree.nearest_neighbor_iter_with_distance_2(p.to_array()) {
            let number = entry.data as usize;
            if best.is_some_and(|(_, least)| to_box > least * (1.0 + ROUNDING)) {
                break;
            }
            let squared = distance_squared(number);
            if best.is_none_or(|(first, least)| squared < least || squared == least && number < first) {
                best = Some((number, squared));
            }
        }
        best
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn finds_what_touches() {
        let boxes = (0..100).map(|i| {
            let min = Point::new(f64::from(i % 10), f64::from(i / 10), 0.0);
            Aabb { min, max: min + Point::splat(0.5) }
        });
        let boxes: Vec<Aabb> = boxes.collect();
        let index = BoxIndex::new(boxes.iter().copied());
        for side in [0.0, 0.6, 3.0] {
            for at in [-0.5, 0.25, 4.5, 9.5, 11.0] {
                let query = Aabb { min: Point::splat(at), max: Point::splat(at + side) }
                    .with(Point::new(at, at, 0.0));
                let mut found: Vec<usize> = index.touching(&query).collect();
                found.sort_unstable();
                let expected: Vec<usize> = (0..100).filter(|&i| boxes[i].touches(&query)).collect();
                assert_eq!(found, expected, "at {at}, side {side}");
            }
        }
        assert!(BoxIndex::new([]).nearest(Point::ZERO, |_| 0.0).is_none());
        assert_eq!(BoxIndex::new([Aabb::EMPTY]).touching(&boxes[0]).count(), 0);
    }

    #[test]
    fn unbounded_boxes_are_found_everywhere() {
        let all = Aabb { min: Point::NEG_INFINITY, max: Point::INFINITY };
        let index = BoxIndex::new((0..100).map(|_| all));
        assert_eq!(index.touching(&Aabb { min: Point::ONE, max: Point::ONE }).count(), 100);
        assert_eq!(index.touching(&all).count(), 100);
    }

    #[test]
    fn of_equally_near_points_the_first_is_nearest() {
        let points: Vec<Point> =
            (0..1000).map(|i| Point::new(f64::from(i % 7), f64::from(i % 5), 0.0)).collect();
        let index = BoxIndex::of_points(&points);
        for target in [Point::ZERO, Point::new(3.0, 2.0, 1.0), Point::new(2.5, 2.5, 0.0)] {
            let distance = |i: usize| points[i].distance_squared(target);
            let least = (0..1000).map(distance).fold(f64::INFINITY, f64::min);
            let first = (0..1000).position(|i| distance(i) == least).unwrap();
            assert_eq!(index.nearest(target, distance), Some((first, least)));
        }
    }

    #[cfg(not(target_arch = "wasm32"))]
    mod random {
        use proptest::prelude::*;

        use super::*;
        use crate::geometry::closest_on_triangle;
        use crate::geometry::samples::{point, points};

        proptest! {
            #[test]
            fn nearest_triangles_agree_with_a_search_of_all(
                triangles in prop::collection::vec(points::<3>(1.0), 1..60), p in point(2.0),
            ) {
                let index = BoxIndex::new(triangles.iter().map(Aabb::around));
                let distance = |i: usize| closest_on_triangle(p, triangles[i]).distance_squared(p);
                let (i, squared) = index.nearest(p, distance).unwrap();
                prop_assert_eq!(squared, distance(i));
                prop_assert!((0..triangles.len()).all(|k| distance(k) >= squared));
            }
        }
    }
}
