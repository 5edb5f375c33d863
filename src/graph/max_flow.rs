//! Maximum flow by two search trees that are kept from one augmenting path to the next.
//!
//! Boykov, Kolmogorov, *An experimental comparison of min-cut/max-flow algorithms for energy minimization in vision*
//! (2004), section 3:
//!
//! 1. growth: the trees of the source and of the sink take in nodes along edges with capacity left, until they touch;
//! 2. augmentation: as much flows along the path as it bears, and nodes whose edge to the parent is full are orphans;
//! 3. adoption: an orphan gets a new parent in its tree, or leaves it and makes orphans of its children.
//!
//! Distances to the roots, remembered with the time at which they were right, keep paths short (section 3.2.3 of
//! Kolmogorov's thesis). Nodes are taken in the order in which they were found, so that the same network is always
//! cut in the same way.

use std::collections::VecDeque;

use crate::{Cancelled, Monitor};

/// Marks in `parent`, beside ids of arcs.
const NO_PARENT: u32 = u32::MAX;
const TERMINAL: u32 = u32::MAX - 1;

/// Paths between two questions whether to stop.
const BATCH: u32 = 256;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Tree {
    Source,
    Sink,
}

/// An edge is two arcs, `2 k` and `2 k + 1`, each with what it can still bear.
pub(super) struct Search {
    head: Vec<u32>,
    residual: Vec<u64>,
    /// The arcs that leave node n are `arcs[starts[n]..starts[n + 1]]`.
    starts: Vec<u32>,
    arcs: Vec<u32>,
    /// What the node can still get from the source, or below zero give to the sink.
    excess: Vec<i64>,
    tree: Vec<Option<Tree>>,
    /// The arc that leads from the node to its parent, or a mark.
    parent: Vec<u32>,
    /// The distance to the root, which was right at the time.
    distance: Vec<u32>,
    time: Vec<u32>,
    now: u32,
    /// Nodes whose arcs are to be looked at.
    active: VecDeque<u32>,
    is_active: Vec<bool>,
    orphans: VecDeque<u32>,
}

impl Search {
    pub(super) fn new(edges: &[([u32; 2], [u64; 2])], excess: Vec<i64>) -> Self {
        let nodes = excess.len();
        let mut starts = vec![0u32; nodes + 1];
        for n in edges.iter().flat_map(|(ends, _)| ends) {
            starts[*n as usize + 1] += 1;
        }
        for n in 0..nodes {
            starts[n + 1] += starts[n];
        }
        let mut next = starts.clone();
        let mut arcs = vec![0; 2 * edges.len()];
        for (arc, &n) in (0u32..).zip(edges.iter().flat_map(|(ends, _)| ends)) {
            arcs[next[n as usize] as usize] = arc;
            next[n as usize] += 1;
        }
        let mut search = Self {
            head: edges.iter().flat_map(|([tail, head], _)| [*head, *tail]).collect(),
            residual: edges.iter().flat_map(|(_, capacities)| *capacities).collect(),
            starts,
            arcs,
            tree: vec![None; nodes],
            parent: vec![NO_PARENT; nodes],
            distance: vec![0; nodes],
            time: vec![0; nodes],
            now: 0,
            active: VecDeque::new(),
            is_active: vec![false; nodes],
            orphans: VecDeque::new(),
            excess,
        };
        for n in 0..nodes as u32 {
            let tree = match search.excess[n as usize] {
                0 => continue,
                1.. => Tree::Source,
                _ => Tree::Sink,
            };
            search.tree[n as usize] = Some(tree);
            search.parent[n as usize] = TERMINAL;
            search.distance[n as usize] = 1;
            search.activate(n);
        }
        search
    }

    /// Lets flow what can; how much that is.
    pub(super) fn run(&mut self, monitor: &dyn Monitor) -> Result<u64, Cancelled> {
        let mut flow = 0;
        while let Some(&node) = self.active.front() {
            match self.grow(node) {
                None => {
                    self.active.pop_front();
                    self.is_active[node as usize] = false;
                }
                // The node stays first, if it is still in a tree: there may be more paths through it.
                Some(bridge) => {
                    self.now += 1;
                    if self.now.is_multiple_of(BATCH) && monitor.cancelled() {
                        return Err(Cancelled);
                    }
                    flow += self.augment(bridge);
                    while let Some(orphan) = self.orphans.pop_front() {
                        self.adopt(orphan);
                    }
                }
            }
        }
        Ok(flow)
    }

    /// The nodes of the source's tree.
    pub(super) fn source_side(&self) -> Vec<bool> {
        self.tree.iter().map(|&tree| tree == Some(Tree::Source)).collect()
    }

    fn activate(&mut self, node: u32) {
        if !std::mem::replace(&mut self.is_active[node as usize], true) {
            self.active.push_back(node);
        }
    }

    fn arcs_of(&self, node: u32) -> std::ops::Range<usize> {
        self.starts[node as usize] as usize..self.starts[node as usize + 1] as usize
    }

    /// What the arc bears in the direction of the tree's flow, if it leads from parent to child.
    fn to_child(&self, tree: Tree, arc: u32) -> u64 {
        match tree {
            Tree::Source => self.residual[arc as usize],
            Tree::Sink => self.residual[sister(arc) as usize],
        }
    }

    /// Takes in the free neighbours of an active node; an arc from the source's tree to the sink's, as soon as there
    /// is one that bears something.
    fn grow(&mut self, node: u32) -> Option<u32> {
        let tree = self.tree[node as usize]?;
        for at in self.arcs_of(node) {
            let arc = self.arcs[at];
            if self.to_child(tree, arc) == 0 {
                continue;
            }
            let other = self.head[arc as usize];
            match self.tree[other as usize] {
                None => {
                    self.tree[other as usize] = Some(tree);
                    self.hang(other, sister(arc), node);
                    self.activate(other);
                }
                Some(of_other) if of_other != tree => {
                    return Some(if tree == Tree::Source { arc } else { sister(arc) });
                }
                Some(_) => {
                    let (o, n) = (other as usize, node as usize);
                    if self.time[o] <= self.time[n] && self.distance[o] > self.distance[n] + 1 {
                        self.hang(other, sister(arc), node);
                    }
                }
            }
        }
        None
    }

    /// Makes `parent` the parent of `node`, by the arc from `node` to it.
    fn hang(&mut self, node: u32, arc: u32, parent: u32) {
        self.parent[node as usize] = arc;
        self.time[node as usize] = self.time[parent as usize];
        self.distance[node as usize] = self.distance[parent as usize] + 1;
    }

    /// Lets as much flow through the arc, which joins the trees, as the path from root to root bears.
    fn augment(&mut self, bridge: u32) -> u64 {
        let ends =
            [(Tree::Source, self.head[sister(bridge) as usize]), (Tree::Sink, self.head[bridge as usize])];
        let mut flow = self.residual[bridge as usize];
        for (tree, mut node) in ends {
            while self.parent[node as usize] != TERMINAL {
                let arc = self.parent[node as usize];
                flow = flow.min(self.to_child(tree, sister(arc)));
                node = self.head[arc as usize];
            }
            flow = flow.min(self.excess[node as usize].unsigned_abs());
        }
        self.push(bridge, flow);
        for (tree, mut node) in ends {
            while self.parent[node as usize] != TERMINAL {
                let arc = self.parent[node as usize];
                self.push(if tree == Tree::Source { sister(arc) } else { arc }, flow);
                if self.to_child(tree, sister(arc)) == 0 {
                    self.orphan(node);
                }
                node = self.head[arc as usize];
            }
            let root = &mut self.excess[node as usize];
            *root -= root.signum() * flow as i64;
            if *root == 0 {
                self.orphan(node);
            }
        }
        flow
    }

    fn push(&mut self, arc: u32, flow: u64) {
        self.residual[arc as usize] -= flow;
        self.residual[sister(arc) as usize] += flow;
    }

    fn orphan(&mut self, node: u32) {
        self.parent[node as usize] = NO_PARENT;
        self.orphans.push_back(node);
    }

    /// Finds the orphan a parent that hangs on a root, the nearest to it; else the orphan leaves its tree.
    fn adopt(&mut self, orphan: u32) {
        let Some(tree) = self.tree[orphan as usize] else { return };
        let mut nearest: Option<(u32, u32)> = None;
        for at in self.arcs_of(orphan) {
            let arc = self.arcs[at];
            let other = self.head[arc as usize];
            if self.tree[other as usize] != Some(tree) || self.to_child(tree, sister(arc)) == 0 {
                continue;
            }
            if let Some(distance) = self.distance_to_root(other)
                && nearest.is_none_or(|(least, _)| distance < least)
            {
                nearest = Some((distance, arc));
            }
        }
        if let Some((distance, arc)) = nearest {
            self.parent[orphan as usize] = arc;
            self.time[orphan as usize] = self.now;
            self.distance[orphan as usize] = distance + 1;
            return;
        }
        self.tree[orphan as usize] = None;
        for at in self.arcs_of(orphan) {
            let arc = self.arcs[at];
            let other = self.head[arc as usize];
            if self.tree[other as usize] != Some(tree) {
                continue;
            }
            if self.to_child(tree, sister(arc)) > 0 {
                self.activate(other);
            }
            if self.parent[other as usize] == sister(arc) {
                self.orphan(other);
            }
        }
    }

    /// How far the node is from the root of its tree; `None` if it hangs on an orphan. Remembered along the way.
    fn distance_to_root(&mut self, node: u32) -> Option<u32> {
        let mut known = node;
        let mut steps = 0;
        let distance = loop {
            if self.time[known as usize] == self.now && self.parent[known as usize] != NO_PARENT {
                break self.distance[known as usize] + steps;
            }
            steps += 1;
            match self.parent[known as usize] {
                NO_PARENT => return None,
                TERMINAL => {
                    self.time[known as usize] = self.now;
                    self.distance[known as usize] = 1;
                    break steps;
                }
                arc => known = self.head[arc as usize],
            }
        };
        let (mut at, mut left) = (node, distance);
        while self.time[at as usize] != self.now {
            self.time[at as usize] = self.now;
            self.distance[at as usize] = left;
            left -= 1;
            at = self.head[self.parent[at as usize] as usize];
        }
        Some(distance)
    }
}

/// The other arc of the same edge.
fn sister(arc: u32) -> u32 {
    arc ^ 1
}
