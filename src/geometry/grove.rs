//! Search trees over very many leaves.
//!
//! A tree is packed at one go, which for millions of leaves takes seconds. So these are divided into blocks of neighbours
//! with a tree each: the monitor is asked between them. Few leaves are one block.

use rstar::{AABB, RTree, RTreeObject};

use super::{Aabb, Point};
use crate::{Cancelled, Monitor};

/// Leaves of a block, at most: packed in a few hundredths of a second.
const BLOCK: usize = 1 << 16;

/// R-trees, packed once.
#[derive(Debug)]
pub(super) struct Grove<T: RTreeObject> {
    blocks: Vec<(Aabb, RTree<T>)>,
}

impl<T: RTreeObject<Envelope = AABB<[f64; 3]>>> Grove<T> {
    /// Packs the leaves.
    pub fn plant(leaves: Vec<T>, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let (mut left, mut blocks) = (vec![leaves], Vec::new());
        while let Some(mut leaves) = left.pop() {
            monitor.proceed()?;
            let bounds = leaves.iter().map(bounds_of).fold(Aabb::EMPTY, |all, b| all.with(b.min).with(b.max));
            if leaves.len() <= BLOCK {
                blocks.push((bounds, RTree::bulk_load(leaves)));
                continue;
            }
            let axis = (bounds.max - bounds.min).max_position();
            let at = |leaf: &T| bounds_of(leaf).center()[axis];
            let middle = leaves.len() / 2;
            leaves.select_nth_unstable_by(middle, |a, b| at(a).total_cmp(&at(b)));
            let upper = leaves.split_off(middle);
            left.extend([upper, leaves]);
        }
        Ok(Self { blocks })
    }

    /// The leaves whose boxes touch `query`, in no order that means anything.
    pub fn touching(&self, query: &Aabb) -> impl Iterator<Item = &T> {
        let envelope = AABB::from_corners(query.min.to_array(), query.max.to_array());
        let query = *query;
        let near = self.blocks.iter().filter(move |(bounds, _)| bounds.touches(&query));
        near.flat_map(move |(_, tree)| tree.locate_in_envelope_intersecting(envelope))
    }
}

fn bounds_of<T: RTreeObject<Envelope = AABB<[f64; 3]>>>(leaf: &T) -> Aabb {
    let envelope = leaf.envelope();
    Aabb { min: Point::from(envelope.lower()), max: Point::from(envelope.upper()) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Silent;
    use crate::geometry::{BoxIndex, NearestTriangle};
    use std::sync::atomic::{AtomicUsize, Ordering};

    /// More points than a block takes, on a spiral.
    fn spiral() -> impl Iterator<Item = Point> + Clone {
        (0..3 * BLOCK).map(|k| {
            let t = k as f64 / BLOCK as f64;
            Point::new(libm::cos(40.0 * t) * t, libm::sin(40.0 * t) * t, 0.3 * t)
        })
    }

    #[test]
    fn many_blocks_answer_as_a_walk_over_all_does() {
        let nearest = NearestTriangle::of(spiral().map(|p| [p; 3]));
        let points: Vec<Point> = spiral().collect();
        let boxes = BoxIndex::of_points(&points);
        for k in 0..20 {
            let p = Point::new(f64::from(k % 5) - 2.0, f64::from(k % 7) - 3.0, f64::from(k) / 20.0);
            let walked = points.iter().map(|q| q.distance(p)).fold(f64::INFINITY, f64::min);
            assert_eq!(nearest.closest_point(p).unwrap().distance(p), walked, "{p}");
            let around = Aabb { min: p - 0.4, max: p + 0.4 };
            let within = points.iter().filter(|&&q| Aabb { min: q, max: q }.touches(&around)).count();
            assert_eq!(boxes.touching(&around).count(), within, "{p}");
        }
    }

    #[test]
    fn the_monitor_is_asked_between_blocks() {
        struct Stops(AtomicUsize);
        impl Monitor for Stops {
            fn progress(&self, _: crate::Stage, _: f64) {}
            fn cancelled(&self) -> bool {
                self.0.fetch_add(1, Ordering::Relaxed) == 3
            }
        }
        let points: Vec<Point> = spiral().collect();
        let within = |monitor: &dyn Monitor| {
            let triangles = (0..points.len() as u32).map(|n| [n; 3]);
            NearestTriangle::sharing(points.clone(), triangles, monitor)
        };
        assert!(within(&Stops(AtomicUsize::new(0))).is_err());
        assert!(within(&Silent).is_ok());
    }
}
