//! Paths for all legs at once, by negotiation (PathFinder: McMurchie and Ebeling, FPGA 1995).
//!
//! 1. Each leg takes its cheapest path. Paths may share nodes, at a price.
//! 2. Legs that share nodes are routed again, one after the other. From round to round the price grows, and nodes that
//!    were shared stay dearer.
//! 3. It ends when no node is shared, or after [`ROUNDS`].
//!
//! Paths that share no node do not cross, and leave a row of quads between them at least. No path runs through the node
//! of a stop. Where a path has the two edges of one quad, it pays: that quad would be flattened to a triangle.

use super::boundary::{Boundary, NONE, Spoke};
use super::corridor::{Corridor, UNIT};
use super::place::Placement;
use super::stops::Leg;
use crate::graph::ShortestPaths;
use crate::{Cancelled, Monitor};

/// Rounds of negotiation.
const ROUNDS: usize = 30;

/// The price of a shared node in the first round, its growth from round to round, and how much dearer a node stays
/// after each round in which it was shared. In costs of edges.
const OVERLAP: f64 = 0.6;
const GROWTH: f64 = 1.35;
const HISTORY: f64 = 0.8;

/// The price of two edges of one quad.
const TURN: f64 = 0.15;

/// The legs' paths, and what is wrong with them.
#[derive(Clone, Debug, Default)]
pub(super) struct Routes {
    /// The spokes of each leg's path from start to end; empty if there is none.
    pub paths: Vec<Vec<u32>>,
    /// Legs without a path, ascending.
    pub unreached: Vec<u32>,
    /// Legs that share a node, ascending, by node.
    pub shared: Vec<(u32, Vec<u32>)>,
}

impl Routes {
    pub fn is_complete(&self) -> bool {
        self.unreached.is_empty() && self.shared.is_empty()
    }
}

pub(super) struct Router<'a> {
    boundary: &'a Boundary,
    legs: &'a [Leg],
    /// The corridor of each leg's curve.
    corridors: &'a [&'a Corridor],
    placement: &'a Placement,
    /// The stop at each node.
    stop_at: Vec<u32>,
    /// How many legs have each node inside their paths.
    users: Vec<u32>,
    /// What each node costs more since it was shared.
    history: Vec<u64>,
    paths: Vec<Vec<u32>>,
    search: ShortestPaths,
}

impl<'a> Router<'a> {
    pub fn new(
        boundary: &'a Boundary,
        legs: &'a [Leg],
        corridors: &'a [&'a Corridor],
        placement: &'a Placement,
    ) -> Self {
        let mut stop_at = vec![NONE; boundary.nodes.len()];
        for (stop, &node) in (0..).zip(&placement.nodes) {
            if node != NONE {
                stop_at[node as usize] = stop;
            }
        }
        Self {
            boundary,
            legs,
            corridors,
            placement,
            stop_at,
            users: vec![0; boundary.nodes.len()],
            history: vec![0; boundary.nodes.len()],
            paths: vec![Vec::new(); legs.len()],
            search: ShortestPaths::new(boundary.spokes.len()),
        }
    }

    /// Routes all legs. `known` has paths to begin with, by leg.
    pub fn route(
        mut self,
        known: impl Fn(&Leg) -> Option<Vec<u32>>,
        monitor: &dyn Monitor,
    ) -> Result<Routes, Cancelled> {
        for leg in 0..self.legs.len() {
            if let Some(path) = known(&self.legs[leg]).filter(|path| self.is_path_of(leg, path)) {
                self.occupy(leg, path);
            }
        }
        let mut unreached = vec![false; self.legs.len()];
        let mut price = OVERLAP * UNIT;
        for _ in 0..ROUNDS {
            let mut changed = false;
            for (leg, unreached) in unreached.iter_mut().enumerate() {
                if *unreached || !(self.paths[leg].is_empty() || self.shares(leg)) {
                    continue;
                }
                monitor.proceed()?;
                self.vacate(leg);
                match self.cheapest(leg, price as u64) {
                    Some(path) => self.occupy(leg, path),
                    None => *unreached = true,
                }
                changed = true;
            }
            if !changed {
                break;
            }
            for node in 0..self.users.len() {
                if self.users[node] > 1 {
                    self.history[node] += (HISTORY * UNIT) as u64;
                }
            }
            price *= GROWTH;
        }
        let shared = self.shared();
        let unreached = (0..).zip(unreached).filter_map(|(leg, is)| is.then_some(leg)).collect();
        Ok(Routes { paths: self.paths, unreached, shared })
    }

    /// The nodes inside a path: all but its first and last.
    fn inside<'b>(&'b self, path: &'b [u32]) -> impl Iterator<Item = u32> + use<'b> {
        let but_last = &path[..path.len().saturating_sub(1)];
        but_last.iter().map(|&s| self.boundary.spokes[s as usize].to)
    }

    fn occupy(&mut self, leg: usize, path: Vec<u32>) {
        let inside: Vec<u32> = self.inside(&path).collect();
        inside.into_iter().for_each(|node| self.users[node as usize] += 1);
        self.paths[leg] = path;
    }

    fn vacate(&mut self, leg: usize) {
        let path = std::mem::take(&mut self.paths[leg]);
        let inside: Vec<u32> = self.inside(&path).collect();
        inside.into_iter().for_each(|node| self.users[node as usize] -= 1);
    }

    fn shares(&self, leg: usize) -> bool {
        self.inside(&self.paths[leg]).any(|node| self.users[node as usize] > 1)
    }

    /// Nodes with several legs, ascending, and those legs.
    fn shared(&self) -> Vec<(u32, Vec<u32>)> {
        let mut uses = Vec::new();
        for (leg, path) in (0..).zip(&self.paths) {
            let shared = self.inside(path).filter(|&node| self.users[node as usize] > 1);
            uses.extend(shared.map(|node| (node, leg)));
        }
        uses.sort_unstable();
        let groups = uses.chunk_by(|a, b| a.0 == b.0);
        groups.map(|group| (group[0].0, group.iter().map(|&(_, leg)| leg).collect())).collect()
    }

    /// The spokes with which a leg may begin and, as the spokes back, end.
    fn ends(&self, leg: usize, end: usize) -> Vec<u32> {
        let Leg { stops, arms, .. } = self.legs[leg];
        let node = self.placement.nodes[stops[end] as usize];
        match (node, arms[end]) {
            (NONE, _) => Vec::new(),
            (_, NONE) => {
                let first = self.boundary.first_spoke(node);
                (first..first + self.boundary.valence(node) as u32).collect()
            }
            (_, arm) => vec![self.placement.spokes[stops[end] as usize][arm as usize]],
        }
    }

    fn cheapest(&mut self, leg: usize, price: u64) -> Option<Vec<u32>> {
        let mut search = std::mem::take(&mut self.search);
        let corridor = self.corridors[leg];
        let goal = self.placement.nodes[self.legs[leg].stops[1] as usize];
        let spokes = &self.boundary.spokes;
        let last: Vec<u32> = self.ends(leg, 1).into_iter().map(|s| spokes[s as usize].twin).collect();
        // What it costs to walk a spoke, of which the cost is told, and come to its node; nothing leads through a stop.
        let step = |s: u32, cost: u64| {
            let to = spokes[s as usize].to;
            if self.stop_at[to as usize] != NONE {
                return (to == goal && last.contains(&s)).then_some(cost);
            }
            let crowd = u64::from(self.users[to as usize]) * price + self.history[to as usize];
            Some(cost + crowd)
        };
        let first_step = |s: u32| Some((s, step(s, corridor.cost(self.boundary, s)?)?));
        let starts: Vec<(u32, u64)> = self.ends(leg, 0).into_iter().filter_map(first_step).collect();
        let leave = |into: u32, out: &mut Vec<(u32, u64)>| {
            let Spoke { to, twin, .. } = spokes[into as usize];
            for (s, cost) in (self.boundary.first_spoke(to)..).zip(corridor.costs_at(to)) {
                if let Some(cost) = cost.filter(|_| s != twin).and_then(|cost| step(s, cost)) {
                    out.push((s, cost + self.turn(into, s)));
                }
            }
        };
        let is_end = |s: u32| spokes[s as usize].to == goal && last.contains(&s);
        let path = search.search(&starts, leave, is_end);
        self.search = search;
        Some(path?.nodes)
    }

    fn turn(&self, into: u32, out: u32) -> u64 {
        let [left, right] = self.boundary.quads_beside(into, out);
        if left.min(right) == 1 { (TURN * UNIT) as u64 } else { 0 }
    }

    /// Does a path that was found before still lead from stop to stop?
    fn is_path_of(&self, leg: usize, path: &[u32]) -> bool {
        let [Some(first), Some(last)] = [path.first(), path.last()] else { return false };
        let last = self.boundary.spokes[*last as usize].twin;
        self.ends(leg, 0).contains(first)
            && self.ends(leg, 1).contains(&last)
            && self.inside(path).all(|node| self.stop_at[node as usize] == NONE)
    }
}
