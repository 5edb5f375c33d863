//! Cheapest paths (Dijkstra), in graphs that are given by a function.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// A path and what it costs.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CheapestPath {
    /// The cost of its start and its arcs.
    pub cost: u64,
    /// Its nodes, from a start to the end.
    pub nodes: Vec<u32>,
}

/// Finds cheapest paths. Keeps its memory from search to search; a search costs what it looks at, not what there is.
///
/// Costs are whole numbers: equal paths are equal on every machine. Of nodes that are equally near the least is
/// settled first, and a node keeps the first way on which it was reached at its cost.
///
/// ```
/// use hexmill::graph::ShortestPaths;
/// // 0 -> 1 -> 2 costs less than 0 -> 2.
/// let arcs: [&[(u32, u64)]; 3] = [&[(1, 2), (2, 5)], &[(2, 2)], &[]];
/// let path = ShortestPaths::new(3).search(&[(0, 1)], |n, out| out.extend(arcs[n as usize]), |n| n == 2).unwrap();
/// assert_eq!((path.cost, path.nodes), (5, vec![0, 1, 2]));
/// ```
#[derive(Clone, Debug, Default)]
pub struct ShortestPaths {
    /// For each node the cost of the best way to it, and the node before it there.
    best: Vec<(u64, u32)>,
    /// Nodes that were reached.
    reached: Vec<u32>,
    queue: BinaryHeap<Reverse<(u64, u32)>>,
    arcs: Vec<(u32, u64)>,
}

/// Not reached, and before a start.
const NONE: u32 = u32::MAX;
const UNREACHED: (u64, u32) = (u64::MAX, NONE);

impl ShortestPaths {
    /// For graphs of `nodes` nodes.
    pub fn new(nodes: usize) -> Self {
        Self { best: vec![UNREACHED; nodes], ..Self::default() }
    }

    /// The cheapest path from one of `starts`, each with what it costs to start there, to a node that `is_end`.
    /// `arcs` appends the arcs that leave a node: where they lead and what they cost. `None` if no end can be reached.
    ///
    /// # Panics
    /// If a node is not less than the number of nodes.
    pub fn search(
        &mut self,
        starts: &[(u32, u64)],
        arcs: impl Fn(u32, &mut Vec<(u32, u64)>),
        is_end: impl Fn(u32) -> bool,
    ) -> Option<CheapestPath> {
        self.clear();
        for &(start, cost) in starts {
            self.reach(start, cost, NONE);
        }
        while let Some(Reverse((cost, node))) = self.queue.pop() {
            if cost > self.best[node as usize].0 {
                continue;
            }
            if is_end(node) {
                return Some(CheapestPath { cost, nodes: self.way_to(node) });
            }
            let mut leaving = std::mem::take(&mut self.arcs);
            leaving.clear();
            arcs(node, &mut leaving);
            for &(head, more) in &leaving {
                self.reach(head, cost.saturating_add(more), node);
            }
            self.arcs = leaving;
        }
        None
    }

    fn clear(&mut self) {
        for node in self.reached.drain(..) {
            self.best[node as usize] = UNREACHED;
        }
        self.queue.clear();
    }

    fn reach(&mut self, node: u32, cost: u64, before: u32) {
        let best = &mut self.best[node as usize];
        if cost < best.0 {
            if best.0 == u64::MAX {
                self.reached.push(node);
            }
            *best = (cost, before);
            self.queue.push(Reverse((cost, node)));
        }
    }

    fn way_to(&self, end: u32) -> Vec<u32> {
        let mut nodes = vec![end];
        let mut at = self.best[end as usize].1;
        while at != NONE {
            nodes.push(at);
            at = self.best[at as usize].1;
        }
        nodes.reverse();
        nodes
    }
}
