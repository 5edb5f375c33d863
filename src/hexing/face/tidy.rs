//! Fewer nodes with too many or too few cells, before cells are split.
//!
//! ```text
//!  turn an edge                     close a quad
//!  d---c---b       d---c---b         \ d /           \ d /
//!  |   |   |  ->   |  /    |        --a c--    ->   ---e---     a and c become e
//!  e---a---f       e-a-----f         / b \           / b \
//! ```
//!
//! An operation is done where it lowers the sum of squares of (cells at a node less those there should be), and where
//! every cell stays convex; two triangles at an edge become a quad. Each lowers the number of cells or that sum, so that
//! they come to an end. At last, quads whose corner on a smooth curve has no other cell are halved from there.

use std::collections::{HashMap, HashSet};

use glam::DVec2;

use super::cells::{Bends, Cell, corners};
use super::mesher::TIDY;
use super::sample::Samples;
use super::smooth::{Course, Stars, smooth};
use super::triangulation::NONE;
use crate::{Cancelled, Monitor};

/// Rounds over all cells.
const ROUNDS: usize = 12;

/// The least scaled Jacobian, or sine of a triangle's angles, that an operation may leave.
const LEAST: f64 = 0.15;

/// The defect of a node that must not be made.
const HOPELESS: i32 = 1000;

/// Between rounds.
const SMOOTH: Course = Course { doublings: 0, mu: 0.0, target: 2.0, rounds: 3 };

/// Cells between two questions to the monitor.
const BATCH: usize = 1 << 12;

/// Cells while they are made over. Nodes that are closed into others stay among the points, unused.
pub(super) struct Patch<'a> {
    pub(super) points: Vec<DVec2>,
    pub(super) cells: Vec<Cell>,
    held: Vec<bool>,
    /// How many cells there should be at each node.
    ideal: Vec<i32>,
    bends: &'a Bends,
}

impl<'a> Patch<'a> {
    pub(super) fn new(points: Vec<DVec2>, cells: Vec<Cell>, samples: &Samples, bends: &'a Bends) -> Self {
        let held: Vec<bool> = (0..points.len()).map(|p| p < samples.coarse).collect();
        let ideal = ideal(&points, &cells, &held);
        Self { points, cells, held, ideal, bends }
    }

    /// Does what helps, and smooths, until nothing more helps.
    pub(super) fn tidy(&mut self, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        smooth(&mut self.points, &self.cells, &self.held, &[SMOOTH], monitor)?;
        for round in 0..ROUNDS {
            monitor.checkpoint(TIDY, round as f64 / ROUNDS as f64)?;
            let done = Round::new(self).run(monitor)?;
            if done == 0 {
                break;
            }
            self.cells.retain(|cell| cell[0] != NONE);
            smooth(&mut self.points, &self.cells, &self.held, &[SMOOTH], monitor)?;
        }
        self.halve_wide();
        monitor.checkpoint(TIDY, 1.0)
    }

    /// Divides quads with a wide corner from there.
    fn halve_wide(&mut self) {
        for c in 0..self.cells.len() {
            let cell = self.cells[c];
            let Some(k) = self.bends.wide_corner(&cell, |n| self.points[n as usize]) else { continue };
            if cell[3] == NONE {
                continue;
            }
            let [a, b, d, e] = [0, 1, 2, 3].map(|i| cell[(k + i) % 4]);
            let halves = [[a, b, d, NONE], [a, d, e, NONE]];
            if halves.iter().all(|half| self.is_fair(half, None)) {
                self.cells[c] = halves[0];
                self.cells.push(halves[1]);
            }
        }
    }

    /// Is the cell convex by a margin, with the node `moved` at another place?
    fn is_fair(&self, cell: &Cell, moved: Option<(u32, DVec2)>) -> bool {
        let at = |n: u32| match moved {
            Some((node, place)) if node == n => place,
            _ => self.points[n as usize],
        };
        self.bends.quality(cell, at) > LEAST
    }
}

/// How many cells there should be at each node: one for each right angle, at least one.
fn ideal(points: &[DVec2], cells: &[Cell], held: &[bool]) -> Vec<i32> {
    let mut degrees = vec![0.0; points.len()];
    for cell in cells {
        let nodes = corners(cell);
        for (k, &node) in nodes.iter().enumerate() {
            let [p, next, previous] =
                [k, k + 1, k + nodes.len() - 1].map(|i| points[nodes[i % nodes.len()] as usize]);
            degrees[node as usize] += super::graph::turn(next - p, previous - p);
        }
    }
    let of_node = |p: usize| if held[p] { (degrees[p] / 90.0).round().max(1.0) as i32 } else { 4 };
    (0..points.len()).map(of_node).collect()
}

/// One round: operations on cells that no other operation of the round has touched.
struct Round<'a, 'b> {
    patch: &'a mut Patch<'b>,
    stars: Stars,
    touched: Vec<bool>,
}

impl<'a, 'b> Round<'a, 'b> {
    fn new(patch: &'a mut Patch<'b>) -> Self {
        let stars = Stars::new(patch.points.len(), &patch.cells);
        let touched = vec![false; patch.cells.len()];
        Self { patch, stars, touched }
    }

    /// Returns how many operations were done.
    fn run(&mut self, monitor: &dyn Monitor) -> Result<usize, Cancelled> {
        let mut done = 0;
        for c in 0..self.patch.cells.len() {
            if c % BATCH == 0 {
                monitor.proceed()?;
            }
            if !self.touched[c] && (self.close(c) || self.turn(c)) {
                done += 1;
            }
        }
        Ok(done)
    }

    fn defect(&self, node: u32, change: i32) -> i32 {
        let count = self.stars.of(node as usize).len() as i32 + change;
        let off = count - self.patch.ideal[node as usize];
        // A free node with two cells, or a node without any, is none.
        let least = if self.patch.held[node as usize] { 1 } else { 3 };
        if count < least { HOPELESS } else { off * off }
    }

    /// How much the sum of squares falls by these changes of the numbers of cells at nodes.
    fn gain(&self, changes: &[(u32, i32)]) -> i32 {
        changes.iter().map(|&(node, change)| self.defect(node, 0) - self.defect(node, change)).sum()
    }

    /// Are all cells at these nodes still as they were when the round began?
    fn is_untouched(&self, nodes: &[u32]) -> bool {
        nodes.iter().all(|&n| self.stars.of(n as usize).iter().all(|&c| !self.touched[c as usize]))
    }

    fn touch(&mut self, nodes: &[u32]) {
        for &node in nodes {
            for &c in self.stars.of(node as usize) {
                self.touched[c as usize] = true;
            }
        }
    }

    /// Merges two opposite corners of the quad `c`, if that helps.
    fn close(&mut self, c: usize) -> bool {
        let cell = self.patch.cells[c];
        cell[3] != NONE
            && [0, 1].into_iter().any(|k| self.close_across(c, [0, 1, 2, 3].map(|i| cell[(k + i) % 4])))
    }

    fn close_across(&mut self, c: usize, [a, b, d, e]: Cell) -> bool {
        // a and d are merged, b and e lose a cell.
        let held = [a, d].map(|n| self.patch.held[n as usize]);
        if held[0] && held[1] || !self.is_untouched(&[a, b, d, e]) {
            return false;
        }
        let (kept, gone) = if held[1] { (d, a) } else { (a, d) };
        let added = self.stars.of(gone as usize).len() as i32 - 2;
        let gain = self.gain(&[(kept, added), (b, -1), (e, -1)]) + self.defect(gone, 0);
        if gain <= 0 || self.shared(kept, gone) != 1 || self.common_neighbours(kept, gone) != 2 {
            return false;
        }
        let [from, to] = [gone, kept].map(|n| self.patch.points[n as usize]);
        let place = if held[0] || held[1] { to } else { from.midpoint(to) };
        let around = |n: u32| self.stars.of(n as usize).iter().filter(|&&other| other as usize != c);
        let fair = [kept, gone].into_iter().all(|n| {
            around(n).all(|&other| self.patch.is_fair(&self.patch.cells[other as usize], Some((n, place))))
        });
        if !fair {
            return false;
        }
        self.touch(&[a, b, d, e]);
        for &other in self.stars.of(gone as usize) {
            self.patch.cells[other as usize] =
                self.patch.cells[other as usize].map(|n| if n == gone { kept } else { n });
        }
        self.patch.cells[c] = [NONE; 4];
        self.patch.points[kept as usize] = place;
        true
    }

    /// How many cells have both nodes.
    fn shared(&self, a: u32, b: u32) -> usize {
        self.stars.of(a as usize).iter().filter(|&&c| self.patch.cells[c as usize].contains(&b)).count()
    }

    /// How many nodes have an edge to both nodes.
    fn common_neighbours(&self, a: u32, b: u32) -> usize {
        let of_a: HashSet<u32> = self.neighbours(a).collect();
        self.neighbours(b).filter(|n| of_a.contains(n)).collect::<HashSet<u32>>().len()
    }

    fn neighbours(&self, node: u32) -> impl Iterator<Item = u32> {
        self.stars.of(node as usize).iter().flat_map(move |&c| {
            let nodes = corners(&self.patch.cells[c as usize]);
            let k = nodes.iter().position(|&n| n == node).expect("the cell is at the node");
            [nodes[(k + 1) % nodes.len()], nodes[(k + nodes.len() - 1) % nodes.len()]]
        })
    }

    /// Turns an edge of the cell `c` in the ring of the two cells at it, if that helps.
    fn turn(&mut self, c: usize) -> bool {
        let cell = self.patch.cells[c];
        (0..corners(&cell).len()).any(|k| self.turn_edge(c, k))
    }

    fn turn_edge(&mut self, c: usize, k: usize) -> bool {
        let cell = self.patch.cells[c];
        let nodes = corners(&cell);
        let [a, b] = [nodes[k], nodes[(k + 1) % nodes.len()]];
        if self.patch.bends.is_constrained(a, b) {
            return false;
        }
        let Some(other) = self.beyond(c, a, b) else { return false };
        let ring = ring(nodes, corners(&self.patch.cells[other]), a, b);
        if !self.is_untouched(&ring) {
            return false;
        }
        if let [w, x, y, z] = ring[..] {
            return self.join(c, other, [w, x, y, z], [a, b]);
        }
        let Some([i, j]) = self.best_chord(&ring, [a, b]) else { return false };
        self.touch(&ring);
        let [first, second] = halves(&ring, i, j);
        (self.patch.cells[c], self.patch.cells[other]) = (first, second);
        true
    }

    /// Makes a quad of two triangles at the edge from `a` to `b`, if it is fair.
    fn join(&mut self, c: usize, other: usize, quad: Cell, [a, b]: [u32; 2]) -> bool {
        let loose = [a, b].into_iter().any(|n| self.defect(n, -1) >= HOPELESS);
        if loose || !self.patch.is_fair(&quad, None) {
            return false;
        }
        self.touch(&quad);
        (self.patch.cells[c], self.patch.cells[other]) = (quad, [NONE; 4]);
        true
    }

    /// The cell beyond the edge from `a` to `b` of the cell `c`.
    fn beyond(&self, c: usize, a: u32, b: u32) -> Option<usize> {
        let mut at_a = self.stars.of(a as usize).iter().map(|&other| other as usize);
        at_a.find(|&other| {
            let nodes = corners(&self.patch.cells[other]);
            let n = nodes.len();
            other != c && (0..n).any(|k| nodes[k] == b && nodes[(k + 1) % n] == a)
        })
    }

    /// The chord of a ring of five or six that helps most, if one does, where that from `a` to `b` is now.
    fn best_chord(&self, ring: &[u32], [a, b]: [u32; 2]) -> Option<[usize; 2]> {
        let n = ring.len();
        let mut best: Option<(i32, [usize; 2])> = None;
        for i in 0..n {
            for j in i + 2..n {
                let (x, y) = (ring[i], ring[j]);
                // Both parts are to have three or four corners.
                if n + 1 - (j - i) > 4 || j - i > 3 || (a.min(b), a.max(b)) == (x.min(y), x.max(y)) {
                    continue;
                }
                let mut changes: HashMap<u32, i32> = HashMap::new();
                for (node, change) in [(a, -1), (b, -1), (x, 1), (y, 1)] {
                    *changes.entry(node).or_default() += change;
                }
                let changes: Vec<(u32, i32)> = changes.into_iter().collect();
                let gain = self.gain(&changes);
                let fair = || halves(ring, i, j).iter().all(|cell| self.patch.is_fair(cell, None));
                if gain > best.map_or(0, |(gain, _)| gain)
                    && self.shared(x, y) == self.in_ring(x, y, ring)
                    && fair()
                {
                    best = Some((gain, [i, j]));
                }
            }
        }
        best.map(|(_, chord)| chord)
    }

    /// How many of the two cells of a ring have both nodes: those that the chord between them will replace.
    fn in_ring(&self, x: u32, y: u32, ring: &[u32]) -> usize {
        let of_ring = |c: &&u32| {
            let cell = &self.patch.cells[**c as usize];
            let nodes = corners(cell);
            nodes.contains(&y) && nodes.iter().all(|n| ring.contains(n))
        };
        self.stars.of(x as usize).iter().filter(of_ring).count()
    }
}

/// The nodes around two cells that share the edge from `a` to `b`, counter-clockwise from `b`.
fn ring(first: &[u32], second: &[u32], a: u32, b: u32) -> Vec<u32> {
    let from = |nodes: &[u32], start: u32| -> Vec<u32> {
        let k = nodes.iter().position(|&n| n == start).expect("the node is of the cell");
        (0..nodes.len() - 1).map(|i| nodes[(k + i) % nodes.len()]).collect()
    };
    [from(first, b), from(second, a)].concat()
}

/// The two cells that a chord makes of a ring.
fn halves(ring: &[u32], i: usize, j: usize) -> [Cell; 2] {
    let cell = |nodes: Vec<u32>| [nodes[0], nodes[1], nodes[2], nodes.get(3).copied().unwrap_or(NONE)];
    [cell(ring[i..=j].to_vec()), cell([&ring[j..], &ring[..=i]].concat())]
}
