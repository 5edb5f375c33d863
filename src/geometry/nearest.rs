//! The point of a surface that is nearest to another point.
//!
//! Whoever asks mostly asks again nearby. So each thread remembers where its last searches ended, and begins the next one
//! with that facet: with a short distance from the first most of the tree need not be looked at. What is found does not
//! depend on where it began.

use std::cell::Cell;

use super::{Aabb, Point, closest_on_triangle};
use crate::{Cancelled, Monitor, Silent};

/// A leaf of the tree has at most this many facets.
const LEAF: usize = 4;

/// The monitor is asked before more facets than this are split.
const MANY: usize = 1 << 14;

/// More levels than a tree of 2^32 facets has, which are split in halves.
const DEPTH: usize = 48;

/// How many trees a thread remembers its last search in, at most.
const REMEMBERED: usize = 64;

/// A facet's distance may be computed less than that of the box around it by this share of the greatest coordinate.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

thread_local! {
    /// Where the last searches ended, among the facets in the order of the tree.
    static LAST: [Cell<u32>; REMEMBERED] = const { [const { Cell::new(0) }; REMEMBERED] };
}

/// A piece of a surface.
pub trait Facet {
    /// Points whose convex hull it is in.
    fn corners(&self) -> &[Point];

    /// Its point that is closest to `p`.
    fn closest(&self, p: Point) -> Point;
}

/// A triangle.
impl Facet for [Point; 3] {
    fn corners(&self) -> &[Point] {
        self
    }

    fn closest(&self, p: Point) -> Point {
        closest_on_triangle(p, *self)
    }
}

/// Finds, among many facets, the one that is nearest to a point: a tree of boxes, split in halves along their longest
/// side. General R-trees keep a heap for each question, and take several times as long; optimisation asks millions.
#[derive(Debug)]
pub struct NearestFacet<F> {
    /// The root first, each branch before its halves.
    nodes: Vec<Node>,
    /// In the order of the tree.
    facets: Vec<Numbered<F>>,
    /// The greatest coordinate, either way.
    extent: f64,
}

/// Finds the nearest of many triangles.
pub type NearestTriangle = NearestFacet<[Point; 3]>;

/// A facet, and its place in the order in which they were given.
#[derive(Clone, Debug)]
struct Numbered<F> {
    facet: F,
    index: u32,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Aabb,
    below: Below,
}

#[derive(Clone, Copy, Debug)]
enum Below {
    /// The left half is the next node; where the right one is.
    Right(u32),
    /// The first facet, and how many there are.
    Leaf(u32, u32),
}

/// The point of a facet that is closest to another, how far that is, squared, and the facet's place in the tree.
struct Closest {
    distance: f64,
    place: usize,
    point: Point,
}

impl Closest {
    /// Boxes that are farther, squared, hold nothing that is computed to be as near.
    fn limit(&self, rounding: f64) -> f64 {
        self.distance + rounding * (2.0 * self.distance.sqrt() + rounding)
    }
}

/// The facet that is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Its place in the order in which the facets were given.
    pub facet: usize,
    /// Its point that is closest.
    pub point: Point,
}

impl<F: Facet> NearestFacet<F> {
    /// An index of facets with finite corners.
    ///
    /// # Panics
    /// If there are more than 2^32 facets.
    pub fn new(facets: impl IntoIterator<Item = F>) -> Self {
        Self::within(facets, &Silent).expect("nobody stops it")
    }

    /// As [`new`](Self::new), told by a monitor when to stop.
    ///
    /// # Errors
    /// If the monitor stops it.
    ///
    /// # Panics
    /// As [`new`](Self::new).
    pub fn within(facets: impl IntoIterator<Item = F>, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let numbered = facets.into_iter().enumerate().map(|(index, facet)| Numbered {
            facet,
            index: u32::try_from(index).expect("more than 2^32 facets"),
        });
        let mut all = Self { nodes: Vec::new(), facets: numbered.collect(), extent: 0.0 };
        let mut facets = std::mem::take(&mut all.facets);
        if !facets.is_empty() {
            all.branch(&mut facets, 0, monitor)?;
        }
        if let Some(Node { bounds, .. }) = all.nodes.first() {
            all.extent = bounds.min.abs().max(bounds.max.abs()).max_element();
        }
        Ok(Self { facets, ..all })
    }

    /// Adds the nodes of these facets, which are those from `first` on.
    fn branch(
        &mut self,
        facets: &mut [Numbered<F>],
        first: usize,
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        if facets.len() > MANY {
            monitor.proceed()?;
        }
        let bounds = Aabb::around(facets.iter().flat_map(|f| f.facet.corners()));
        let place = self.nodes.len();
        self.nodes.push(Node { bounds, below: Below::Leaf(first as u32, facets.len() as u32) });
        if facets.len() <= LEAF {
            return Ok(());
        }
        let size = bounds.size();
        let axis = (1..3).fold(0, |longest, axis| if size[axis] > size[longest] { axis } else { longest });
        let middle = |f: &Numbered<F>| f.facet.corners().iter().map(|p| p[axis]).sum::<f64>();
        let half = facets.len() / 2;
        facets
            .select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)).then(a.index.cmp(&b.index)));
        let (left, right) = facets.split_at_mut(half);
        self.branch(left, first, monitor)?;
        self.nodes[place].below = Below::Right(self.nodes.len() as u32);
        self.branch(right, first + half, monitor)
    }

    /// The facet that is nearest to `p`, the first of those that are equally near; `None` if there are no facets.
    pub fn nearest(&self, p: Point) -> Option<Nearest> {
        self.found(p).map(|(numbered, point)| Nearest { facet: numbered.index as usize, point })
    }

    /// The same, as the facet itself.
    pub fn nearest_facet(&self, p: Point) -> Option<&F> {
        self.found(p).map(|(numbered, _)| &numbered.facet)
    }

    /// Of all facets that with the least distance as it is computed, and of these the first.
    fn found(&self, p: Point) -> Option<(&Numbered<F>, Point)> {
        let last_facet = self.facets.len().checked_sub(1)?;
        // Two trees that share a place only spoil each other's beginning.
        let memory = std::ptr::from_ref(self).addr() / align_of_val(self) % REMEMBERED;
        let first = LAST.with(|last| last[memory].get() as usize).min(last_facet);
        let rounding = ROUNDING * (self.extent + p.abs().max_element());
        let mut best = self.closest(first, p);
        let mut limit = best.limit(rounding);
        let mut waiting = [(0.0, 0); DEPTH];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let (mut distance, mut at) = waiting[count];
            // Down to the nearer half each time, while the other waits.
            while let Below::Right(right) = self.nodes[at as usize].below
                && distance <= limit
            {
                let mut halves =
                    [at + 1, right].map(|k| (self.nodes[k as usize].bounds.distance_squared(p), k));
                if halves[1].0 < halves[0].0 {
                    halves.swap(0, 1);
                }
                if halves[1].0 <= limit {
                    waiting[count] = halves[1];
                    count += 1;
                }
                (distance, at) = halves[0];
            }
            let Below::Leaf(first, len) = self.nodes[at as usize].below else { continue };
            if distance > limit {
                continue;
            }
            for place in first as usize..(first + len) as usize {
                let numbered = &self.facets[place];
                let bounds = Aabb::around(numbered.facet.corners());
                if bounds.distance_squared(p) > limit {
                    continue;
                }
                let other = self.closest(place, p);
                let is_first = || numbered.index < self.facets[best.place].index;
                if other.distance < best.distance || other.distance == best.distance && is_first() {
                    limit = other.limit(rounding);
                    best = other;
                }
            }
        }
        LAST.with(|last| last[memory].set(best.place as u32));
        Some((&self.facets[best.place], best.point))
    }

    /// The point of the facet at this place of the tree that is closest to `p`.
    fn closest(&self, place: usize, p: Point) -> Closest {
        let point = self.facets[place].facet.closest(p);
        Closest { distance: point.distance_squared(p), place, point }
    }

    /// The point of a facet that is closest to `p`; `None` if there are no facets.
    pub fn closest_point(&self, p: Point) -> Option<Point> {
        self.nearest(p).map(|nearest| nearest.point)
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
            assert_eq!(closest_on_triangle(p, triangles[nearest.facet]), nearest.point, "{p}");
        }
    }

    #[test]
    fn the_first_of_equal_triangles_is_found() {
        let twice: Vec<[Point; 3]> = sheet(5).into_iter().chain(sheet(5)).collect();
        let index = NearestTriangle::new(twice.iter().copied());
        for t in &twice[..50] {
            let found = index.nearest((t[0] + t[1] + t[2]) / 3.0).unwrap();
            assert_eq!(twice[found.facet], *t);
            assert!(found.facet < 50);
        }
    }

    /// In another order, and in other trees.
    #[test]
    fn what_is_found_does_not_depend_on_the_searches_before() {
        let triangles: Vec<[Point; 3]> = sheet(9).into_iter().chain(sheet(9)).collect();
        let points: Vec<Point> = (0..60)
            .map(|k| Point::new(f64::from(k % 10), f64::from(k / 10), f64::from(k % 3) - 1.0) / 9.0)
            .collect();
        let index = NearestTriangle::new(triangles.iter().copied());
        let forward: Vec<_> = points.iter().map(|&p| index.nearest(p)).collect();
        let mut backward: Vec<_> = points.iter().rev().map(|&p| index.nearest(p)).collect();
        backward.reverse();
        assert_eq!(forward, backward);
        let anew = |p: Point| NearestTriangle::new(triangles.iter().copied()).nearest(p);
        assert!(points.iter().zip(&forward).all(|(&p, found)| anew(p) == *found));
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
