//! A spatial index over many axis-aligned boxes.

use rstar::primitives::{GeomWithData, Rectangle};

use super::grove::Grove;
use super::{Aabb, Point};
use crate::{Cancelled, Monitor, Silent};

type Entry = GeomWithData<Rectangle<[f64; 3]>, u32>;

/// Finds, among many boxes, those that touch another one: R-trees, packed once.
#[derive(Debug)]
pub struct BoxIndex {
    trees: Grove<Entry>,
}

impl BoxIndex {
    /// An index of `boxes`, numbered from 0. Empty boxes are never found.
    ///
    /// # Panics
    /// If there are more than 2^32 boxes.
    pub fn new(boxes: impl IntoIterator<Item = Aabb>) -> Self {
        Self::within(boxes, &Silent).expect("nobody stops it")
    }

    /// As [`new`](Self::new), told by a monitor when to stop.
    ///
    /// # Errors
    /// If the monitor stops it.
    ///
    /// # Panics
    /// If there are more than 2^32 boxes.
    pub fn within(boxes: impl IntoIterator<Item = Aabb>, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let entries = boxes.into_iter().enumerate().filter(|(_, b)| !b.is_empty()).map(|(i, b)| {
            let number = u32::try_from(i).expect("more than 2^32 boxes");
            // The middle of an unbounded box would be no number, which the tree cannot sort.
            let (min, max) = (b.min.max(Point::MIN), b.max.min(Point::MAX));
            Entry::new(Rectangle::from_corners(min.to_array(), max.to_array()), number)
        });
        Ok(Self { trees: Grove::plant(entries.collect(), monitor)? })
    }

    /// An index of `points`, numbered from 0.
    pub fn of_points<'a>(points: impl IntoIterator<Item = &'a Point>) -> Self {
        Self::new(points.into_iter().map(|&p| Aabb { min: p, max: p }))
    }

    /// The numbers of the boxes that touch `query`, in no order that means anything.
    pub fn touching(&self, query: &Aabb) -> impl Iterator<Item = usize> {
        self.trees.touching(query).map(|entry| entry.data as usize)
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
        assert_eq!(BoxIndex::new([]).touching(&boxes[0]).count(), 0);
        assert_eq!(BoxIndex::new([Aabb::EMPTY]).touching(&boxes[0]).count(), 0);
    }

    #[test]
    fn unbounded_boxes_are_found_everywhere() {
        let all = Aabb { min: Point::NEG_INFINITY, max: Point::INFINITY };
        let index = BoxIndex::new((0..100).map(|_| all));
        assert_eq!(index.touching(&Aabb { min: Point::ONE, max: Point::ONE }).count(), 100);
        assert_eq!(index.touching(&all).count(), 100);
    }
}
