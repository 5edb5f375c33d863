//! Edges at which the interface touches itself, and how a pillow passes them (Ebeida et al., figure 13).
//!
//! Around an edge the hexes stand in runs of refined and of coarse ones. Two runs are normal: the pillow passes
//! between them. At a **pinched** edge there are more, and the runs of one side stay joined through the edge
//! while each run of the other is wrapped:
//!
//! ```text
//!   R | C          R | C     coarse joined      R \ C     refined joined
//!   --+--   is        \                            \
//!   C | R          C   \ R   or                 C | \ R   (the two R meet at the edge)
//! ```
//!
//! On the boundary the outside counts as a hex of the joined side, whose region then keeps the node.
//!
//! At both ends of the edge the separated runs must lie in different regions of the node's star, or the pillow's
//! faces would meet twice. The coarse side is joined unless that fails there; if the refined side fails too,
//! a coarse hex at the edge must be refined as well.

use super::interface::{Interface, Star};
use super::regions::{Regions, has_edge};
use crate::mesh::NodeId;
use crate::parallel;

/// A pinched edge.
#[derive(Clone, Copy)]
pub(super) struct Pinch {
    /// Its ends, the lesser first.
    ends: [NodeId; 2],
    /// True if the refined runs are joined through it, false if the coarse ones are.
    pub(super) joins_refined: bool,
    /// Has it faces of the boundary?
    pub(super) on_boundary: bool,
}

/// The pinched edges of an interface.
pub(super) struct Pinches {
    /// In the order of their ends.
    edges: Vec<Pinch>,
    /// For each node of the interface: has it a pinched edge?
    at_node: Vec<bool>,
}

impl Pinches {
    /// Finds the pinched edges; the coarse runs are joined at all of them.
    pub(super) fn find(interface: &Interface) -> Self {
        let edges = parallel::gather_with(interface.nodes.len(), Star::default, |star, place, edges| {
            star.load(interface, place);
            edges.extend(pinches_above(star));
        });
        let mut at_node = vec![false; interface.nodes.len()];
        for place in edges.iter().flat_map(|edge| edge.ends).filter_map(|end| interface.place(end)) {
            at_node[place] = true;
        }
        Self { edges, at_node }
    }

    /// Number of pinched edges.
    pub(super) fn len(&self) -> usize {
        self.edges.len()
    }

    /// Has node `place` of the interface a pinched edge?
    pub(super) fn are_at(&self, place: usize) -> bool {
        self.at_node[place]
    }

    /// The pinched edge between two nodes.
    pub(super) fn between(&self, a: NodeId, b: NodeId) -> Option<&Pinch> {
        let ends = [a.min(b), a.max(b)];
        self.edges.binary_search_by_key(&ends, |edge| edge.ends).ok().map(|k| &self.edges[k])
    }

    /// Decides which side each edge joins. Returns the coarse hexes that must be refined too, ascending; none if
    /// all edges can be passed.
    pub(super) fn resolve(&mut self, interface: &Interface) -> Vec<u32> {
        let (mut star, mut regions) = (Star::default(), Regions::default());
        let mut changed = true;
        while changed {
            changed = false;
            for k in 0..self.edges.len() {
                if !self.edges[k].joins_refined && !self.can_pass(k, interface, &mut star, &mut regions) {
                    self.edges[k].joins_refined = true;
                    changed = true;
                }
            }
        }
        let mut more = Vec::new();
        for k in 0..self.edges.len() {
            if !self.can_pass(k, interface, &mut star, &mut regions) {
                let end = self.edges[k].ends[1];
                let at_edge = |star: &Star, hex: usize| has_edge(interface, star, hex, end);
                let place = interface.place(self.edges[k].ends[0]).expect("an end is of the interface");
                star.load(interface, place);
                add_coarse(&star, &mut more, |hex| at_edge(&star, hex));
            }
        }
        more.sort_unstable();
        more
    }

    /// Do the separated runs of edge `k` lie in different regions at both ends, and does at most one region
    /// want to keep each end?
    fn can_pass(&self, k: usize, interface: &Interface, star: &mut Star, regions: &mut Regions) -> bool {
        let pinch = self.edges[k];
        let [a, b] = pinch.ends;
        [(a, b), (b, a)].into_iter().all(|(node, end)| {
            let place = interface.place(node).expect("both ends are of the interface");
            star.load(interface, place);
            regions.load(interface, star, self, place);
            regions.separates_runs(interface, star, end, !pinch.joins_refined)
                && !(pinch.on_boundary && regions.forced_count() > 1)
        })
    }
}

/// The pinched edges from a star's node to greater ones, by their other ends.
fn pinches_above(star: &Star) -> Vec<Pinch> {
    let ends = star.faces.iter().filter(|face| star.is_interface(face)).flat_map(|f| [f.rest[0], f.rest[2]]);
    let mut ends: Vec<NodeId> = ends.filter(|&end| end > star.node).collect();
    ends.sort_unstable();
    ends.dedup();
    let pinch = |end: NodeId| {
        let faces = || star.faces.iter().filter(move |face| face.has_edge(end));
        let interface_faces = faces().filter(|face| star.is_interface(face)).count();
        let on_boundary = faces().any(|face| face.second.is_none());
        let is_pinched = interface_faces > if on_boundary { 1 } else { 2 };
        is_pinched.then_some(Pinch { ends: [star.node, end], joins_refined: false, on_boundary })
    };
    ends.into_iter().filter_map(pinch).collect()
}

/// Adds to `more` the coarse hex with the most interface faces in the star, of those that `is_candidate`, unless
/// one of them is there already.
pub(super) fn add_coarse(star: &Star, more: &mut Vec<u32>, is_candidate: impl Fn(usize) -> bool) {
    let candidates = || (0..star.hexes.len()).filter(|&k| !star.is_refined(k) && is_candidate(k));
    if candidates().any(|k| more.contains(&star.hexes[k].0)) {
        return;
    }
    let faces = |k: usize| {
        let has = |f: &&super::interface::StarFace| f.first.0 == k || f.second.is_some_and(|s| s.0 == k);
        star.faces.iter().filter(has).filter(|face| star.is_interface(face)).count()
    };
    let best = candidates().max_by_key(|&k| (faces(k), std::cmp::Reverse(star.hexes[k].0)));
    more.extend(best.map(|k| star.hexes[k].0));
}
