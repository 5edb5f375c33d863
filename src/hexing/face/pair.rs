//! Pairs of triangles become quads.
//!
//! 1. A triangle that would be the only cell in a wide angle between two sides on curves gives its third side to the
//!    triangle beyond: that edge is turned;
//! 2. pairs are made greedily, the best first;
//! 3. then triangles left alone are joined two by two through chains of pairs, each of which gives one triangle up and
//!    takes another (an alternating path, the one that costs the least quality).
//!
//! Only pairs that make convex quads are made, so that every cell can be split into positive quads.

use std::cmp::{Ordering, Reverse};
use std::collections::{BinaryHeap, HashMap};

use glam::DVec2;

use super::cells::{Bends, Cell, sine};
use super::mesher::PAIR;
use super::triangulation::{NONE, Triangles};
use crate::{Cancelled, Monitor};

/// The least scaled Jacobian of a pair.
const LEAST: f64 = 0.25;

/// The least scaled Jacobian of a pair in a chain: a triangle alone is better than worse ones.
const LEAST_IN_CHAIN: f64 = 0.3;

/// Triangles that a search for a chain looks at.
const SEARCH: usize = 256;

/// What each pair of a chain costs beside the quality it lacks.
const LINK: f64 = 0.1;

/// Triangles between two questions to the monitor.
const BATCH: usize = 1 << 12;

/// The cells that the triangles make: quads and triangles, counter-clockwise, in order of their first triangles.
pub(super) fn pair(
    mut triangles: Triangles,
    points: &[DVec2],
    bends: &Bends,
    monitor: &dyn Monitor,
) -> Result<Vec<Cell>, Cancelled> {
    monitor.checkpoint(PAIR, 0.0)?;
    widen(&mut triangles, points, bends);
    let mut pairing = Pairing::new(&triangles, points, bends);
    pairing.greedy();
    for t in 0..triangles.corners.len() {
        if t % BATCH == 0 {
            monitor.checkpoint(PAIR, t as f64 / triangles.corners.len() as f64)?;
        }
        if pairing.mate[t] == NONE {
            pairing.augment(t as u32);
        }
    }
    monitor.checkpoint(PAIR, 1.0)?;
    Ok(pairing.cells())
}

/// Turns edges across from wide angles that have one triangle.
fn widen(triangles: &mut Triangles, points: &[DVec2], bends: &Bends) {
    for t in 0..triangles.corners.len() {
        let [a, b, c] = triangles.corners[t];
        if let Some(k) = bends.wide_corner(&[a, b, c, NONE], |n| points[n as usize]) {
            let across = (k + 1) % 3;
            if triangles.beyond[t][across] != NONE && !triangles.constrained[t][across] {
                turn_edge(triangles, t, across, points);
            }
        }
    }
}

/// Turns the edge `k` of a triangle within the quad of the two triangles at it, unless that is not convex.
///
/// ```text
///       c               c
///     /   \           / | \
///    a-----b    ->    a  |  b        t beside a, its other triangle beside b
///     \   /           \ | /
///       d               d
/// ```
fn turn_edge(triangles: &mut Triangles, t: usize, k: usize, points: &[DVec2]) {
    let other = triangles.beyond[t][k] as usize;
    let [a, b, c] = [0, 1, 2].map(|i| triangles.corners[t][(k + i) % 3]);
    let m = triangles.corners[other].iter().position(|&n| n == b).expect("the edge is shared");
    let d = triangles.corners[other][(m + 2) % 3];
    let at = |n: u32| points[n as usize];
    if sine(at(c), at(a), at(d)) <= 0.0 || sine(at(c), at(d), at(b)) <= 0.0 {
        return;
    }
    if sine(at(d), at(c), at(a)) <= 0.0 || sine(at(d), at(b), at(c)) <= 0.0 {
        return;
    }
    let side = |of: &Triangles, t: usize, k: usize| (of.beyond[t][k % 3], of.constrained[t][k % 3]);
    let [bc, ca] = [side(triangles, t, k + 1), side(triangles, t, k + 2)];
    let [ad, db] = [side(triangles, other, m + 1), side(triangles, other, m + 2)];
    let mut set = |t: usize, corners: [u32; 3], sides: [(u32, bool); 3]| {
        triangles.corners[t] = corners;
        triangles.beyond[t] = sides.map(|(beyond, _)| beyond);
        triangles.constrained[t] = sides.map(|(_, constrained)| constrained);
    };
    set(t, [a, d, c], [ad, (other as u32, false), ca]);
    set(other, [d, b, c], [db, bc, (t as u32, false)]);
    for (moved, from, to) in [(ad.0, other, t), (bc.0, t, other)] {
        if moved != NONE {
            let beyond = &mut triangles.beyond[moved as usize];
            beyond.iter_mut().filter(|beyond| **beyond == from as u32).for_each(|beyond| *beyond = to as u32);
        }
    }
}

struct Pairing<'a> {
    triangles: &'a Triangles,
    /// For each edge of a triangle, the quality of the quad beyond it; negative if there is none.
    quality: Vec<[f64; 3]>,
    mate: Vec<u32>,
}

/// A triangle that a chain reaches, and what it costs to come there: cheapest first, then lowest number.
#[derive(PartialEq)]
struct Reached {
    cost: f64,
    triangle: u32,
}

impl Eq for Reached {}

impl Ord for Reached {
    fn cmp(&self, other: &Self) -> Ordering {
        self.cost.total_cmp(&other.cost).then(self.triangle.cmp(&other.triangle))
    }
}

impl PartialOrd for Reached {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl<'a> Pairing<'a> {
    fn new(triangles: &'a Triangles, points: &[DVec2], bends: &Bends) -> Self {
        let mate = vec![NONE; triangles.corners.len()];
        let mut pairing = Self { triangles, quality: Vec::new(), mate };
        let of_edge = |pairing: &Self, t: usize, k: usize| {
            let other = triangles.beyond[t][k];
            if other == NONE || triangles.constrained[t][k] {
                return -1.0;
            }
            bends.quality(&pairing.quad(t, k), |n| points[n as usize])
        };
        pairing.quality =
            (0..triangles.corners.len()).map(|t| [0, 1, 2].map(|k| of_edge(&pairing, t, k))).collect();
        pairing
    }

    /// The quad of a triangle and the one beyond its edge `k`.
    fn quad(&self, t: usize, k: usize) -> Cell {
        let [a, b, c] = [0, 1, 2].map(|i| self.triangles.corners[t][(k + i) % 3]);
        let other = self.triangles.corners[self.triangles.beyond[t][k] as usize];
        let apex = other.into_iter().find(|n| *n != a && *n != b).expect("triangles have three corners");
        [a, apex, b, c]
    }

    fn greedy(&mut self) {
        let mut pairs: Vec<(f64, u32, u32)> = Vec::new();
        for (t, beyond) in self.triangles.beyond.iter().enumerate() {
            let ahead = (0..3).filter(|&k| beyond[k] != NONE && beyond[k] > t as u32);
            pairs.extend(ahead.map(|k| (self.quality[t][k], t as u32, beyond[k])));
        }
        pairs.retain(|&(quality, ..)| quality > LEAST);
        pairs.sort_unstable_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
        for (_, a, b) in pairs {
            if self.mate[a as usize] == NONE && self.mate[b as usize] == NONE {
                (self.mate[a as usize], self.mate[b as usize]) = (b, a);
            }
        }
    }

    /// Looks for a chain from the lone triangle `start` to another lone one, and exchanges its pairs.
    fn augment(&mut self, start: u32) {
        // For each triangle that the chain gives up, the one that takes its mate.
        let mut before: HashMap<u32, u32> = HashMap::new();
        let mut costs = HashMap::from([(start, 0.0)]);
        let mut front = BinaryHeap::from([Reverse(Reached { cost: 0.0, triangle: start })]);
        let mut looked_at = 0;
        while let Some(Reverse(Reached { cost, triangle })) = front.pop() {
            looked_at += 1;
            if looked_at > SEARCH {
                return;
            }
            if costs[&triangle] < cost {
                continue;
            }
            for k in 0..3 {
                let (other, quality) =
                    (self.triangles.beyond[triangle as usize][k], self.quality[triangle as usize][k]);
                if quality < LEAST_IN_CHAIN || other == start || self.mate[triangle as usize] == other {
                    continue;
                }
                let given_up = self.mate[other as usize];
                if given_up == NONE {
                    return self.exchange(start, triangle, other, &before);
                }
                let cost = cost + 1.0 - quality + LINK;
                let known = costs.get(&given_up).is_some_and(|&known| known <= cost);
                if !known && !self.is_on_chain(start, triangle, other, &before) {
                    costs.insert(given_up, cost);
                    before.insert(given_up, triangle);
                    front.push(Reverse(Reached { cost, triangle: given_up }));
                }
            }
        }
    }

    /// Is `triangle` on the chain that ends at `end`?
    fn is_on_chain(&self, start: u32, end: u32, triangle: u32, before: &HashMap<u32, u32>) -> bool {
        let mut at = end;
        while at != start {
            if at == triangle || self.mate[at as usize] == triangle {
                return true;
            }
            at = before[&at];
        }
        false
    }

    fn exchange(&mut self, start: u32, last: u32, lone: u32, before: &HashMap<u32, u32>) {
        let (mut at, mut free) = (last, lone);
        loop {
            let given_up = self.mate[at as usize];
            (self.mate[at as usize], self.mate[free as usize]) = (free, at);
            if at == start {
                return;
            }
            (at, free) = (before[&at], given_up);
        }
    }

    fn cells(&self) -> Vec<Cell> {
        let cell = |t: usize| {
            let mate = self.mate[t];
            if mate == NONE {
                let [a, b, c] = self.triangles.corners[t];
                return Some([a, b, c, NONE]);
            }
            let edge = || self.triangles.beyond[t].iter().position(|&other| other == mate);
            (mate > t as u32).then(|| self.quad(t, edge().expect("mates share an edge")))
        };
        (0..self.mate.len()).filter_map(cell).collect()
    }
}
