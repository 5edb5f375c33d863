//! The point of a surface that is nearest to another point.
//!
//! Whoever asks mostly asks again nearby, though not at once. So each thread remembers where the last search for points
//! around there ended, and begins the next one with the facets there: with a short distance from the first most of the tree
//! need not be looked at. What is found does not depend on where it began.

mod facets;
mod pack;

use std::cell::Cell;
use std::ops::Range;

use fearless_simd::{Simd, dispatch};

use super::Point;
use super::boxes::{Boxes, Cube};
use super::lanes::{LANES, SINGLES, level};
pub(crate) use facets::{CutQuad, Facet};

/// More boxes than ever wait: seven a level, of which 2^31 facets have no more than 11 below the root of a group, and their
/// groups no more than 11 above.
const WAITING: usize = 160;

/// How many searches a thread remembers, at most.
const REMEMBERED: usize = 1 << 13;

/// No place in a tree.
const NOWHERE: u32 = u32::MAX;

/// A facet's distance may be computed less than that of the box around it by this share of the greatest coordinate.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// A point that is no farther from a facet than this share of the greatest coordinate is on it.
const ON: f64 = 1e-12;

/// Squared distances are not negative: no facet is near enough to look at no other.
const NO_OTHER: f64 = -1.0;

thread_local! {
    /// The leaves where the last searches ended.
    static LAST: [Cell<u32>; REMEMBERED] = const { [const { Cell::new(0) }; REMEMBERED] };
}

/// Finds, among many facets, the one that is nearest to a point: a tree of boxes, eight of which are looked at side by side.
/// General R-trees keep a heap for each question, and take several times as long; optimisation asks millions.
#[derive(Debug)]
pub(crate) struct NearestFacet<F: Facet> {
    tree: Tree,
    /// In the order of the tree.
    facets: Vec<Numbered<F>>,
    shared: F::Shared,
}

/// What holds facets of any kind.
#[derive(Debug)]
struct Tree {
    all: Part,
    /// What may be searched by itself.
    groups: Vec<Part>,
    branches: Vec<Branch>,
    /// The first facet of each leaf, and how many facets there are.
    leaves: Vec<u32>,
    /// The cube around all.
    cube: Cube,
    /// The greatest coordinate, either way.
    extent: f64,
}

/// Finds the nearest of many triangles between the same points.
pub(crate) type NearestTriangle = NearestFacet<[u32; 3]>;

/// Finds the nearest of many quads between the same points, each cut along either diagonal ([`CutQuad`]).
pub(crate) type NearestQuad = NearestFacet<[u32; 4]>;

/// A facet, and its number: its place in the order in which they were given, if that was not told.
#[derive(Clone, Debug)]
pub(crate) struct Numbered<F> {
    pub(crate) facet: F,
    index: u32,
}

/// Some facets: what holds them, and their leaves.
#[derive(Clone, Debug)]
struct Part {
    root: Below,
    leaves: Range<u32>,
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

/// What is known of the closest point before it is looked for.
#[derive(Clone, Copy)]
struct Known {
    /// The leaf that is looked at before all others, if there is one.
    first: u32,
    /// How far it is at most, squared.
    most: f64,
    /// No other is looked for where one is no farther than this, squared.
    enough: f64,
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

impl<F> Numbered<F> {
    fn with(&self, point: Point) -> Nearest {
        Nearest { facet: self.index as usize, point }
    }
}

/// The facet that is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Nearest {
    /// Its number.
    pub(crate) facet: usize,
    /// Its point that is closest.
    pub(crate) point: Point,
}

impl<F: Facet> NearestFacet<F> {
    /// The facet that is nearest to `p`, the first of those that are equally near; `None` if there are no facets.
    pub(crate) fn nearest(&self, p: Point) -> Option<Nearest> {
        self.found(&self.tree.all, p).map(|(numbered, point)| numbered.with(point))
    }

    /// The same, of the facets of a group.
    ///
    /// # Panics
    /// If there is no such group.
    pub(crate) fn nearest_of(&self, group: usize, p: Point) -> Option<Nearest> {
        self.found(&self.tree.groups[group], p).map(|(numbered, point)| numbered.with(point))
    }

    /// The same, as the facet itself.
    pub(crate) fn nearest_facet(&self, p: Point) -> Option<&F> {
        self.found(&self.tree.all, p).map(|(numbered, _)| &numbered.facet)
    }

    /// As [`nearest`](Self::nearest), of the facets whose distance, squared, is no greater than `most`.
    pub(crate) fn nearest_within(&self, p: Point, most: f64) -> Option<Nearest> {
        if self.facets.is_empty() {
            return None;
        }
        let known = Known { first: NOWHERE, most, enough: NO_OTHER };
        let Closest { place, index, point, .. } = self.nearest_from(self.tree.all.root, known, p);
        (place != NOWHERE).then_some(Nearest { facet: index as usize, point })
    }

    /// How far the nearest facet is from `p`, which is 0 where that is no more than rounding makes; infinite if there are no
    /// facets. Most points that distances are told of are on a facet: what else is there need not be looked at.
    pub(crate) fn distance(&self, p: Point) -> f64 {
        if self.facets.is_empty() {
            return f64::INFINITY;
        }
        let on = ON * (self.tree.extent + p.abs().max_element());
        let best = self.search(&self.tree.all, on * on, p);
        if best.distance <= on * on { 0.0 } else { best.point.distance(p) }
    }

    /// Of some facets that with the least distance as it is computed, and of these the first.
    fn found(&self, part: &Part, p: Point) -> Option<(&Numbered<F>, Point)> {
        if self.facets.is_empty() {
            return None;
        }
        let best = self.search(part, NO_OTHER, p);
        // There is none if no distance can be compared.
        let place =
            if best.place == NOWHERE { self.tree.leaves[part.leaves.start as usize] } else { best.place };
        Some((&self.facets[place as usize], best.point))
    }

    /// The closest point of some facets, or any that is no farther than is `enough`, squared. Begins where the last search around
    /// there ended.
    fn search(&self, part: &Part, enough: f64, p: Point) -> Closest {
        // Searches that share a place only spoil each other's beginning.
        let of_part = std::ptr::from_ref(part).addr() / align_of_val(part);
        let memory = of_part.wrapping_add(self.tree.cube.part(p)) % REMEMBERED;
        let Range { start, end } = part.leaves;
        let first = LAST.with(|last| last[memory].get()).clamp(start, end - 1);
        let best = self.nearest_from(part.root, Known { first, most: f64::INFINITY, enough }, p);
        LAST.with(|last| last[memory].set(best.leaf));
        best
    }

    /// The closest point below `root`, as far as is asked for.
    #[inline(never)]
    fn nearest_from(&self, root: Below, known: Known, p: Point) -> Closest {
        dispatch!(level(), simd => self.nearer(simd, root, known, p))
    }

    #[inline(always)]
    fn nearer<S: Simd>(&self, simd: S, root: Below, known: Known, p: Point) -> Closest {
        let Known { first, most, enough } = known;
        let rounding = ROUNDING * (self.tree.extent + p.abs().max_element());
        let mut best = Closest { distance: most, place: NOWHERE, index: NOWHERE, leaf: 0, point: p };
        let mut limit = self.tree.cube.limit(best.limit(rounding));
        let at = self.tree.cube.place(simd, p);
        let mut waiting = [0; WAITING];
        waiting[0] = root.at(0.0);
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
                let Branch { boxes, below } = &self.tree.branches[place as usize];
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
                if best.distance <= enough {
                    break;
                }
                limit = self.tree.cube.limit(best.limit(rounding));
            }
        }
        best
    }

    /// Takes the best facet of a leaf, if that is better. Was it?
    #[inline(always)]
    fn look_at<S: Simd>(&self, simd: S, leaf: u32, p: Point, best: &mut Closest) -> bool {
        let [start, end] = [self.tree.leaves[leaf as usize], self.tree.leaves[leaf as usize + 1]];
        let facets = &self.facets[start as usize..end as usize];
        let (points, squared) = F::closest_of(simd, &self.shared, facets, p);
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

#[cfg(test)]
mod tests;
