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
//! On the boundary the outside counts as a hex of the joined side, whose region then keeps the node, unless the boundary is free.
//!
//! At both ends of the edge the separated runs must lie in different regions of the node's star, or the pillow's
//! faces would meet twice. The coarse side is joined unless that fails there, or folds the layer on the boundary
//! (`folds`); if the refined side fails too, a coarse hex at the edge must be refined as well.

use std::collections::VecDeque;

use super::blocks::in_blocks;
use super::interface::{Interface, Star};
use super::regions::{Regions, has_edge};
use super::shift::{Beside, Shifts};
use crate::geometry::Point;
use crate::mesh::NodeId;
use crate::mesh::topology::Bins;
use crate::{Cancelled, Monitor};

/// A pinched edge.
#[derive(Clone, Copy)]
pub(super) struct Pinch {
    /// Its ends, the lesser first.
    ends: [NodeId; 2],
    /// True if the refined runs are joined through it, false if the coarse ones are.
    pub(super) joins_refined: bool,
    /// Has it faces of a boundary that is kept?
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
    pub(super) fn find(interface: &Interface, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let at = |star: &mut Star, place: usize, found: &mut Vec<Pinch>| {
            star.load(interface, place);
            found.extend(pinches_above(star, interface.has_free_boundary));
        };
        let edges = in_blocks(interface.nodes.len(), monitor, Star::default, at)?;
        let mut at_node = vec![false; interface.nodes.len()];
        for place in edges.iter().flat_map(|edge| edge.ends).filter_map(|end| interface.place(end)) {
            at_node[place] = true;
        }
        Ok(Self { edges, at_node })
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
    /// all edges can be passed. An edge that changes sides has its neighbours looked at again: each does so once.
    pub(super) fn resolve(
        &mut self,
        positions: &[Point],
        interface: &Interface,
        monitor: &dyn Monitor,
    ) -> Result<Vec<u32>, Cancelled> {
        let mut buffers = Buffers::default();
        let ends: Vec<[usize; 2]> = self.edges.iter().map(|edge| places(interface, edge)).collect();
        let at_node = Bins::of(interface.nodes.len(), 2 * ends.len(), |k| ends.as_flattened()[k]);
        let mut queue: VecDeque<usize> = (0..self.edges.len()).collect();
        let mut is_queued = vec![true; self.edges.len()];
        let mut steps = 0usize;
        while let Some(k) = queue.pop_front() {
            steps += 1;
            if steps.is_multiple_of(ASKED) {
                monitor.proceed()?;
            }
            is_queued[k] = false;
            if self.edges[k].joins_refined || self.can_pass(k, positions, interface, &mut buffers) {
                continue;
            }
            self.edges[k].joins_refined = true;
            for other in ends[k].iter().flat_map(|&end| at_node.at(end)).map(|&place| place as usize / 2) {
                if !self.edges[other].joins_refined && !std::mem::replace(&mut is_queued[other], true) {
                    queue.push_back(other);
                }
            }
        }
        self.impassable(positions, interface, monitor)
    }

    /// For each edge that cannot be passed a coarse hex at it, ascending.
    fn impassable(
        &self,
        positions: &[Point],
        interface: &Interface,
        monitor: &dyn Monitor,
    ) -> Result<Vec<u32>, Cancelled> {
        let (mut buffers, mut more) = (Buffers::default(), Vec::new());
        for (k, edge) in self.edges.iter().enumerate() {
            if k.is_multiple_of(ASKED) {
                monitor.proceed()?;
            }
            if !self.can_pass(k, positions, interface, &mut buffers) {
                let star = &mut buffers.star;
                star.load(interface, places(interface, edge)[0]);
                add_coarse(star, &mut more, |hex| has_edge(interface, star, hex, edge.ends[1]));
            }
        }
        more.sort_unstable();
        Ok(more)
    }

    /// Do the separated runs of edge `k` lie in different regions at both ends, does at most one region want to keep
    /// each end, and can refined hexes leave coarse ones that do without a fold?
    fn can_pass(&self, k: usize, positions: &[Point], interface: &Interface, buffers: &mut Buffers) -> bool {
        let Buffers { star, regions, shifts, beside } = buffers;
        let pinch = self.edges[k];
        let [a, b] = pinch.ends;
        [(a, b), (b, a)].into_iter().all(|(node, end)| {
            let place = interface.place(node).expect("both ends are of the interface");
            star.load(interface, place);
            regions.load(interface, star, self, place);
            if !regions.separates_runs(interface, star, end, !pinch.joins_refined) {
                return false;
            }
            if !pinch.on_boundary {
                return true;
            }
            if regions.forced_count() > 1 {
                return false;
            }
            if pinch.joins_refined {
                return true;
            }
            shifts.load(positions, interface, star, regions, interface.kept());
            shifts.choose_keepers(regions, None, None);
            !shifts.is_folded(|end| beside.freedom(positions, interface, end))
        })
    }
}

/// What looking at one edge after another takes.
#[derive(Default)]
struct Buffers {
    star: Star,
    regions: Regions,
    shifts: Shifts,
    beside: Beside,
}

/// Edges that are looked at before the monitor is asked again.
const ASKED: usize = 1 << 10;

/// The places of an edge's ends.
fn places(interface: &Interface, edge: &Pinch) -> [usize; 2] {
    edge.ends.map(|end| interface.place(end).expect("both ends are of the interface"))
}

/// The pinched edges from a star's node to greater ones, by their other ends.
fn pinches_above(star: &Star, has_free_boundary: bool) -> Vec<Pinch> {
    let ends = star.faces.iter().filter(|face| star.is_interface(face)).flat_map(|f| [f.rest[0], f.rest[2]]);
    let mut ends: Vec<NodeId> = ends.filter(|&end| end > star.node).collect();
    ends.sort_unstable();
    ends.dedup();
    let pinch = |end: NodeId| {
        let faces = || star.faces.iter().filter(move |face| face.has_edge(end));
        let interface_faces = faces().filter(|face| star.is_interface(face)).count();
        let is_at_boundary = faces().any(|face| face.second.is_none());
        let is_pinched = interface_faces > if is_at_boundary { 1 } else { 2 };
        let on_boundary = is_at_boundary && !has_free_boundary;
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
