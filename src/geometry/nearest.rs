//! The point of a surface that is nearest to another point.
//!
//! Whoever asks mostly asks again nearby, though not at once. So each thread remembers where the last search for points
//! around there ended, and begins the next one with the facets there: with a short distance from the first most of the tree
//! need not be looked at. What is found does not depend on where it began.

use std::cell::Cell;
use std::ops::Range;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch};

use super::boxes::{Boxes, Cube};
use super::closest::closest_on_four;
use super::lanes::{LANES, Row, Rows, SINGLES, Vectors, level};
use super::{Aabb, Point};
use crate::{Cancelled, Monitor, Silent};

/// The monitor is asked before more facets than this are split.
const MANY: usize = 1 << 14;

/// More boxes than ever wait: seven a level, of which 2^31 facets have no more than 11.
const WAITING: usize = 96;

/// How many searches a thread remembers, at most.
const REMEMBERED: usize = 1 << 13;

/// No place in a tree.
const NOWHERE: u32 = u32::MAX;

/// A facet's distance may be computed less than that of the box around it by this share of the greatest coordinate.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

thread_local! {
    /// The leaves where the last searches ended.
    static LAST: [Cell<u32>; REMEMBERED] = const { [const { Cell::new(0) }; REMEMBERED] };
}

/// A piece of a surface.
pub(crate) trait Facet: Sized {
    /// How many are looked at together: `LANES` at most.
    const TOGETHER: usize;

    /// Points whose convex hull it is in.
    fn corners(&self) -> &[Point];

    /// The points that are closest to `p` of `TOGETHER` facets at most, and how far they are from it, squared. Where there are
    /// fewer the rest say nothing.
    fn closest_of<S: Simd>(simd: S, facets: &[Numbered<Self>], p: Point) -> (Rows, Row);
}

/// A triangle.
impl Facet for [Point; 3] {
    const TOGETHER: usize = LANES;

    fn corners(&self) -> &[Point] {
        self
    }

    #[inline(always)]
    fn closest_of<S: Simd>(simd: S, facets: &[Numbered<Self>], p: Point) -> (Rows, Row) {
        let mut four = [&facets[0].facet; LANES];
        for (lane, numbered) in four.iter_mut().zip(facets) {
            *lane = &numbered.facet;
        }
        let [a, b, c, d] = four;
        let corners = [
            Vectors::of(simd, [a[0], b[0], c[0], d[0]]),
            Vectors::of(simd, [a[1], b[1], c[1], d[1]]),
            Vectors::of(simd, [a[2], b[2], c[2], d[2]]),
        ];
        let (points, squared) = closest_on_four(simd, Vectors::splat(simd, p.to_array()), corners);
        (points.store(), squared.to_array())
    }
}

/// Finds, among many facets, the one that is nearest to a point: a tree of boxes, eight of which are looked at side by side.
/// General R-trees keep a heap for each question, and take several times as long; optimisation asks millions.
#[derive(Debug)]
pub(crate) struct NearestFacet<F> {
    root: Below,
    /// Each before what is below.
    branches: Vec<Branch>,
    /// The first facet of each leaf, and how many facets there are.
    leaves: Vec<u32>,
    /// In the order of the tree.
    facets: Vec<Numbered<F>>,
    /// The cube around all.
    cube: Cube,
    /// The greatest coordinate, either way.
    extent: f64,
}

/// Finds the nearest of many triangles.
pub(crate) type NearestTriangle = NearestFacet<[Point; 3]>;

/// A facet, and its place in the order in which they were given.
#[derive(Clone, Debug)]
pub(crate) struct Numbered<F> {
    pub(crate) facet: F,
    index: u32,
}

/// Eight boxes. Where there are fewer the rest are infinitely far.
#[derive(Clone, Debug)]
struct Branch {
    boxes: Boxes,
    below: [Below; SINGLES],
}

/// What is in a box: twice the place of a branch, or of a leaf and one.
#[derive(Clone, Copy, Debug)]
struct Below(u32);

impl Below {
    fn branch(place: usize) -> Self {
        Self(2 * place as u32)
    }

    fn leaf(place: usize) -> Self {
        Self(2 * place as u32 + 1)
    }

    /// Behind how far its box is. Distances are not negative: the lesser the distance, the lesser the number.
    #[inline(always)]
    fn at(self, distance: f32) -> u64 {
        u64::from(distance.to_bits()) << 32 | u64::from(self.0)
    }
}

/// The point of a facet that is closest to another, how far that is, squared, and the facet's place in the tree and among
/// those that were given.
struct Closest {
    distance: f64,
    place: u32,
    index: u32,
    leaf: u32,
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
pub(crate) struct Nearest {
    /// Its place in the order in which the facets were given.
    pub(crate) facet: usize,
    /// Its point that is closest.
    pub(crate) point: Point,
}

impl<F: Facet> NearestFacet<F> {
    /// An index of facets with finite corners.
    ///
    /// # Panics
    /// If there are more than 2^31 facets.
    pub(crate) fn new(facets: impl IntoIterator<Item = F>) -> Self {
        Self::within(facets, &Silent).expect("nobody stops it")
    }

    /// As [`new`](Self::new), told by a monitor when to stop.
    ///
    /// # Errors
    /// If the monitor stops it.
    ///
    /// # Panics
    /// As [`new`](Self::new).
    pub(crate) fn within(
        facets: impl IntoIterator<Item = F>,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let mut facets: Vec<Numbered<F>> = facets
            .into_iter()
            .enumerate()
            .map(|(k, facet)| Numbered {
                facet,
                index: i32::try_from(k).expect("no more than 2^31 facets") as u32,
            })
            .collect();
        let middle = |facet: &F| facet.corners().iter().sum::<Point>() / facet.corners().len() as f64;
        let mut order: Vec<Middle> =
            facets.iter().map(|of| Middle { index: of.index, at: middle(&of.facet) }).collect();
        sort(&mut order, F::TOGETHER, monitor)?;
        rearrange(&mut facets, order);
        let bounds = around(&facets);
        let extent = bounds.min.abs().max(bounds.max.abs()).max_element();
        let (cube, branches, leaves) = (Cube::around(&bounds), Vec::new(), Vec::new());
        let mut tree = Self { root: Below::branch(0), branches, leaves, facets, cube, extent };
        (tree.root, _) = tree.add(0..tree.facets.len(), monitor)?;
        tree.leaves.push(tree.facets.len() as u32);
        tree.branches.shrink_to_fit();
        tree.leaves.shrink_to_fit();
        Ok(tree)
    }

    /// Adds what is below the box around the facets at these places. That box too.
    fn add(&mut self, places: Range<usize>, monitor: &dyn Monitor) -> Result<(Below, Aabb), Cancelled> {
        if places.len() > MANY {
            monitor.proceed()?;
        }
        if places.len() <= F::TOGETHER {
            self.leaves.push(places.start as u32);
            return Ok((Below::leaf(self.leaves.len() - 1), around(&self.facets[places])));
        }
        let place = self.branches.len();
        self.branches.push(Branch { boxes: Boxes::NONE, below: [Below::branch(place); SINGLES] });
        let mut all = Aabb::EMPTY;
        let full = full(places.len(), F::TOGETHER);
        for (lane, start) in places.clone().step_by(full).enumerate() {
            let (below, bounds) = self.add(start..places.end.min(start + full), monitor)?;
            let branch = &mut self.branches[place];
            branch.below[lane] = below;
            branch.boxes.set(lane, &self.cube, &bounds);
            all = all.with(bounds.min).with(bounds.max);
        }
        Ok((Below::branch(place), all))
    }

    /// The facet that is nearest to `p`, the first of those that are equally near; `None` if there are no facets.
    pub(crate) fn nearest(&self, p: Point) -> Option<Nearest> {
        self.found(p).map(|(numbered, point)| Nearest { facet: numbered.index as usize, point })
    }

    /// The same, as the facet itself.
    pub(crate) fn nearest_facet(&self, p: Point) -> Option<&F> {
        self.found(p).map(|(numbered, _)| &numbered.facet)
    }

    /// As [`nearest`](Self::nearest), of the facets whose distance, squared, is no greater than `most`.
    pub(crate) fn nearest_within(&self, p: Point, most: f64) -> Option<Nearest> {
        if self.facets.is_empty() {
            return None;
        }
        let Closest { place, index, point, .. } = self.nearest_from(NOWHERE, most, p);
        (place != NOWHERE).then_some(Nearest { facet: index as usize, point })
    }

    /// Of all facets that with the least distance as it is computed, and of these the first.
    fn found(&self, p: Point) -> Option<(&Numbered<F>, Point)> {
        if self.facets.is_empty() {
            return None;
        }
        let last_leaf = self.leaves.len() as u32 - 2;
        // Searches that share a place only spoil each other's beginning.
        let tree = std::ptr::from_ref(self).addr() / align_of_val(self);
        let memory = tree.wrapping_add(self.cube.part(p)) % REMEMBERED;
        let first = LAST.with(|last| last[memory].get()).min(last_leaf);
        let best = self.nearest_from(first, f64::INFINITY, p);
        LAST.with(|last| last[memory].set(best.leaf));
        // There is none if no distance can be compared.
        Some((self.facets.get(best.place as usize).unwrap_or(&self.facets[0]), best.point))
    }

    /// The closest point, if it is no farther than so much, squared. Looks at the `first` leaf, if there is one, before all
    /// others.
    #[inline(never)]
    fn nearest_from(&self, first: u32, most: f64, p: Point) -> Closest {
        dispatch!(level(), simd => self.nearer(simd, first, most, p))
    }

    #[inline(always)]
    fn nearer<S: Simd>(&self, simd: S, first: u32, most: f64, p: Point) -> Closest {
        let rounding = ROUNDING * (self.extent + p.abs().max_element());
        let mut best = Closest { distance: most, place: NOWHERE, index: NOWHERE, leaf: 0, point: p };
        let mut limit = self.cube.limit(best.limit(rounding));
        let at = self.cube.place(simd, p);
        let mut waiting = [0; WAITING];
        waiting[0] = self.root.at(0.0);
        let mut count = 1;
        if first != NOWHERE {
            // Above the root alone, by which it is told from the same leaf found again.
            waiting[1] = Below::leaf(first as usize).at(0.0);
            count = 2;
        }
        while count > 0 {
            count -= 1;
            let next: u64 = waiting[count];
            if f32::from_bits((next >> 32) as u32) > limit {
                continue;
            }
            let place = next as u32 / 2;
            if next.is_multiple_of(2) {
                let Branch { boxes, below } = &self.branches[place as usize];
                let (distances, mut found) = boxes.within(simd, &at, limit);
                let lowest = count;
                while found != 0 {
                    let lane = found.trailing_zeros() as usize % SINGLES;
                    found &= found - 1;
                    let box_at = below[lane].at(distances[lane]);
                    // The nearest last, which is looked at next.
                    let mut place = count;
                    while place > lowest && waiting[place - 1] < box_at {
                        waiting[place] = waiting[place - 1];
                        place -= 1;
                    }
                    waiting[place] = box_at;
                    count += 1;
                }
            } else if (place != first || count == 1) && self.look_at(simd, place, p, &mut best) {
                limit = self.cube.limit(best.limit(rounding));
            }
        }
        best
    }

    /// Takes the best facet of a leaf, if that is better. Was it?
    #[inline(always)]
    fn look_at<S: Simd>(&self, simd: S, leaf: u32, p: Point, best: &mut Closest) -> bool {
        let [start, end] = [self.leaves[leaf as usize], self.leaves[leaf as usize + 1]];
        let facets = &self.facets[start as usize..end as usize];
        let (points, squared) = F::closest_of(simd, facets, p);
        let mut is_better = false;
        for (lane, numbered) in facets.iter().enumerate().take(LANES) {
            let (distance, index) = (squared[lane], numbered.index);
            if distance < best.distance || distance == best.distance && index < best.index {
                let point = Point::new(points[0][lane], points[1][lane], points[2][lane]);
                *best = Closest { distance, place: start + lane as u32, index, leaf, point };
                is_better = true;
            }
        }
        is_better
    }

    /// The point of a facet that is closest to `p`; `None` if there are no facets.
    pub(crate) fn closest_point(&self, p: Point) -> Option<Point> {
        self.nearest(p).map(|nearest| nearest.point)
    }
}

/// The middle of a facet's corners, and the facet's place in the order in which they were given.
#[derive(Clone, Copy)]
struct Middle {
    at: Point,
    index: u32,
}

/// Puts facets in the order of the tree, where some of them are looked at together.
fn sort(facets: &mut [Middle], together: usize, monitor: &dyn Monitor) -> Result<(), Cancelled> {
    if facets.len() > MANY {
        monitor.proceed()?;
    }
    if facets.len() > together {
        let size = Aabb::around(facets.iter().map(|f| &f.at)).size();
        let axis = (1..3).fold(0, |longest, axis| if size[axis] > size[longest] { axis } else { longest });
        let along = |a: &Middle, b: &Middle| a.at[axis].total_cmp(&b.at[axis]).then(a.index.cmp(&b.index));
        let full = full(facets.len(), together);
        // Half of the parts.
        let left = facets.len().div_ceil(full).div_ceil(2) * full;
        facets.select_nth_unstable_by(left, along);
        let (left, right) = facets.split_at_mut(left);
        sort(left, together, monitor)?;
        sort(right, together, monitor)?;
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

/// How many of so many facets are in each part of a branch, but for the last: what is below it is full.
fn full(count: usize, together: usize) -> usize {
    let mut full = together;
    while SINGLES * full < count {
        full *= SINGLES;
    }
    full
}

/// The box around some facets.
fn around<F: Facet>(facets: &[Numbered<F>]) -> Aabb {
    let mut all = Aabb::EMPTY;
    for numbered in facets {
        for &corner in numbered.facet.corners() {
            all = all.with(corner);
        }
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::closest_on_triangle;

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

    #[test]
    fn all_is_full_in_a_tree_but_for_what_is_last() {
        for n in [1, 2, 4, 5, 11, 16, 17, 40] {
            let tree = NearestTriangle::new(sheet(n));
            let (mut left, mut branches) = ((2 * n * n).div_ceil(LANES), 0);
            assert_eq!(tree.leaves.len(), left + 1);
            while left > 1 {
                // What would be alone in a branch is in the one above.
                branches += left / SINGLES + usize::from(left % SINGLES > 1);
                left = left.div_ceil(SINGLES);
            }
            assert_eq!(tree.branches.len(), branches);
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
