//! The point of a surface that is nearest to another point.
//!
//! Whoever asks mostly asks again nearby. So each thread remembers where its last searches ended, and begins the next one
//! with that facet: with a short distance from the first most of the tree need not be looked at. What is found does not
//! depend on where it began.

use std::cell::Cell;
use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f64x4};

use super::lanes::{LANES, Number, Row, Rows, Vector, Vectors, level};
use super::{Aabb, Point, closest_on_triangle};
use crate::{Cancelled, Monitor, Silent};

/// The monitor is asked before more facets than this are split.
const MANY: usize = 1 << 14;

/// More boxes than ever wait: three a level, of which 2^32 facets have no more than 17.
const WAITING: usize = 64;

/// How many trees a thread remembers its last search in, at most.
const REMEMBERED: usize = 64;

/// No place in a tree.
const NOWHERE: usize = usize::MAX;

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

/// Finds, among many facets, the one that is nearest to a point: a tree of boxes, four of which are looked at side by side.
/// General R-trees keep a heap for each question, and take several times as long; optimisation asks millions.
#[derive(Debug)]
pub struct NearestFacet<F> {
    /// The root first, if there are facets; each branch before what is below.
    branches: Vec<Branch>,
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

/// Four boxes. Where there are fewer the rest are infinitely far.
#[derive(Clone, Copy, Debug)]
struct Branch {
    min: Rows,
    max: Rows,
    below: [Below; LANES],
}

/// What is in a box.
#[derive(Clone, Copy, Debug)]
enum Below {
    Branch(u32),
    Facet(u32),
}

impl Branch {
    /// How far `p` is from each of the boxes, squared.
    #[inline(always)]
    fn distances<S: Simd>(&self, simd: S, p: Vectors<S>) -> Row {
        let (min, max) = (Vectors::load(simd, &self.min), Vectors::load(simd, &self.max));
        let zero = f64x4::splat(simd, 0.0);
        let (below, above) = (min - p, p - max);
        let outside = |below: f64x4<S>, above: f64x4<S>| below.greater(above).greater(zero);
        let gap = Vectors {
            x: outside(below.x, above.x),
            y: outside(below.y, above.y),
            z: outside(below.z, above.z),
        };
        gap.dot(gap).to_array()
    }
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
        let mut facets: Vec<Numbered<F>> = facets
            .into_iter()
            .enumerate()
            .map(|(k, facet)| Numbered { facet, index: u32::try_from(k).expect("no more than 2^32 facets") })
            .collect();
        let middle = |facet: &F| facet.corners().iter().sum::<Point>() / facet.corners().len() as f64;
        let mut order: Vec<Middle> =
            facets.iter().map(|of| Middle { index: of.index, at: middle(&of.facet) }).collect();
        sort(&mut order, monitor)?;
        rearrange(&mut facets, order);
        let mut all = Self { branches: Vec::with_capacity(facets.len() / 2), facets, extent: 0.0 };
        if !all.facets.is_empty() {
            let bounds = branch(&mut all.branches, &all.facets, 0..all.facets.len(), monitor)?;
            all.extent = bounds.min.abs().max(bounds.max.abs()).max_element();
        }
        Ok(all)
    }

    /// The facet that is nearest to `p`, the first of those that are equally near; `None` if there are no facets.
    pub fn nearest(&self, p: Point) -> Option<Nearest> {
        self.found(p).map(|(numbered, point)| Nearest { facet: numbered.index as usize, point })
    }

    /// The same, as the facet itself.
    pub fn nearest_facet(&self, p: Point) -> Option<&F> {
        self.found(p).map(|(numbered, _)| &numbered.facet)
    }

    /// As [`nearest`](Self::nearest), of the facets whose distance, squared, is no greater than `most`.
    pub fn nearest_within(&self, p: Point, most: f64) -> Option<Nearest> {
        if self.facets.is_empty() {
            return None;
        }
        let none = Closest { distance: most, place: NOWHERE, point: p };
        let Closest { place, point, .. } = dispatch!(level(), simd => self.nearer(simd, none, p));
        Some(Nearest { facet: self.facets.get(place)?.index as usize, point })
    }

    /// Of all facets that with the least distance as it is computed, and of these the first.
    fn found(&self, p: Point) -> Option<(&Numbered<F>, Point)> {
        let last_facet = self.facets.len().checked_sub(1)?;
        // Two trees that share a place only spoil each other's beginning.
        let memory = std::ptr::from_ref(self).addr() / align_of_val(self) % REMEMBERED;
        let first = LAST.with(|last| last[memory].get() as usize).min(last_facet);
        let first = self.closest(first, p);
        let best = dispatch!(level(), simd => self.nearer(simd, first, p));
        LAST.with(|last| last[memory].set(best.place as u32));
        Some((&self.facets[best.place], best.point))
    }

    /// The closest point, if it is no farther than the `best` so far.
    #[inline(always)]
    fn nearer<S: Simd>(&self, simd: S, mut best: Closest, p: Point) -> Closest {
        let rounding = ROUNDING * (self.extent + p.abs().max_element());
        let mut limit = best.limit(rounding);
        let at = Vectors::splat(simd, p);
        let mut waiting = [(0.0, Below::Branch(0)); WAITING];
        let mut count = 1;
        while count > 0 {
            count -= 1;
            let (distance, below) = waiting[count];
            if distance > limit {
                continue;
            }
            match below {
                Below::Branch(branch) => {
                    let branch = &self.branches[branch as usize];
                    let distances = branch.distances(simd, at);
                    let first = count;
                    for (distance, below) in distances.into_iter().zip(branch.below) {
                        if distance <= limit {
                            // The nearest last, which is looked at next.
                            let mut place = count;
                            while place > first && waiting[place - 1].0 < distance {
                                waiting[place] = waiting[place - 1];
                                place -= 1;
                            }
                            waiting[place] = (distance, below);
                            count += 1;
                        }
                    }
                }
                Below::Facet(place) => {
                    let (place, index) = (place as usize, self.facets[place as usize].index);
                    let other = self.closest(place, p);
                    let is_first = || self.facets.get(best.place).is_none_or(|best| index < best.index);
                    if other.distance < best.distance || other.distance == best.distance && is_first() {
                        limit = other.limit(rounding);
                        best = other;
                    }
                }
            }
        }
        best
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

/// The middle of a facet's corners, and the facet's place in the order in which they were given.
#[derive(Clone, Copy)]
struct Middle {
    at: Point,
    index: u32,
}

/// Puts facets in the order of the tree.
fn sort(facets: &mut [Middle], monitor: &dyn Monitor) -> Result<(), Cancelled> {
    if facets.len() > MANY {
        monitor.proceed()?;
    }
    if facets.len() > 1 {
        let size = Aabb::around(facets.iter().map(|f| &f.at)).size();
        let axis = (1..3).fold(0, |longest, axis| if size[axis] > size[longest] { axis } else { longest });
        let along = |a: &Middle, b: &Middle| a.at[axis].total_cmp(&b.at[axis]).then(a.index.cmp(&b.index));
        let [left, _] = halves(0..facets.len());
        facets.select_nth_unstable_by(left.end, along);
        let (left, right) = facets.split_at_mut(left.end);
        sort(left, monitor)?;
        sort(right, monitor)?;
    }
    Ok(())
}

/// Puts at each place the facet whose place is told, without a second array of them: around one circle of places after the
/// other.
fn rearrange<F>(facets: &mut [F], mut from: Vec<Middle>) {
    for first in 0..from.len() {
        let mut place = first;
        loop {
            let next = std::mem::replace(&mut from[place].index, place as u32) as usize;
            if next == first || next == place {
                break;
            }
            facets.swap(place, next);
            place = next;
        }
    }
}

/// Places in two halves, as facets are sorted.
fn halves(places: Range<usize>) -> [Range<usize>; 2] {
    let middle = places.start + places.len() / 2;
    [places.start..middle, middle..places.end]
}

/// Adds a branch of the facets at these places, and all that is below it. The box around them.
fn branch<F: Facet>(
    branches: &mut Vec<Branch>,
    facets: &[Numbered<F>],
    places: Range<usize>,
    monitor: &dyn Monitor,
) -> Result<Aabb, Cancelled> {
    if places.len() > MANY {
        monitor.proceed()?;
    }
    let [left, right] = halves(places);
    let [[a, b], [c, d]] = [halves(left), halves(right)];
    let place = branches.len();
    branches.push(Branch {
        min: [[f64::INFINITY; LANES]; 3],
        max: [[f64::NEG_INFINITY; LANES]; 3],
        below: [Below::Branch(place as u32); LANES],
    });
    let mut all = Aabb::EMPTY;
    for (lane, part) in [a, b, c, d].into_iter().filter(|part| !part.is_empty()).enumerate() {
        let (below, bounds) = match part.len() {
            1 => (Below::Facet(part.start as u32), Aabb::around(facets[part.start].facet.corners())),
            _ => (Below::Branch(branches.len() as u32), branch(branches, facets, part, monitor)?),
        };
        let branch = &mut branches[place];
        branch.below[lane] = below;
        for axis in 0..3 {
            (branch.min[axis][lane], branch.max[axis][lane]) = (bounds.min[axis], bounds.max[axis]);
        }
        all = all.with(bounds.min).with(bounds.max);
    }
    Ok(all)
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
        let none = NearestTriangle::new([]);
        assert_eq!(none.closest_point(Point::ZERO), None);
        assert_eq!(none.nearest_within(Point::ZERO, f64::INFINITY), None);
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

            #[test]
            fn what_is_no_farther_is_found(
                triangles in prop::collection::vec(points::<3>(1.0), 1..60), p in point(2.0),
            ) {
                let index = NearestTriangle::new(triangles.iter().copied());
                let nearest = index.nearest(p);
                let squared = nearest.unwrap().point.distance_squared(p);
                prop_assert_eq!(index.nearest_within(p, squared), nearest);
                prop_assert_eq!(index.nearest_within(p, squared.next_down()), None);
            }
        }
    }
}
