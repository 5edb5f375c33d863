//! The edges and faces of a set of hexes, numbered without hashing.
//!
//! An edge is kept at its lesser node, a face at its least, in short lists; an edge or face is found by a
//! walk over the list of its node. Numbers follow the nodes, and at a node the order of the hexes, so they
//! are the same for any number of threads.

use super::blocks::BLOCK;
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::{FACES_AT, NEIGHBOURS};
use crate::mesh::topology::Bins;
use crate::{Cancelled, Monitor, parallel};

/// The hexes at each node of a set.
pub(super) struct Stars(Bins);

impl Stars {
    /// The stars of `node_count` nodes among `count` hexes; `nodes` says which nodes the `k`-th has.
    pub(super) fn new(node_count: usize, count: usize, nodes: impl Fn(usize) -> [NodeId; 8] + Clone) -> Self {
        Self(Bins::of(node_count, 8 * count, |place| nodes(place / 8)[place % 8].index()))
    }

    /// Where the uses of a node stand among those of all nodes.
    pub(super) fn range(&self, node: usize) -> std::ops::Range<usize> {
        self.0.range(node)
    }

    /// The hexes at a node, by their places in the set, and the node's corner in each.
    pub(super) fn at(&self, node: usize) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.0.at(node).iter().map(|&place| (place as usize / 8, place as usize % 8))
    }
}

/// Edges and faces of a set of hexes.
pub(super) struct Skeleton {
    edges: Lists<1>,
    faces: Lists<3>,
}

impl Skeleton {
    /// The skeleton of `hexes`, over `node_count` nodes.
    ///
    /// # Errors
    /// If the monitor stops it.
    pub(super) fn new<H>(
        node_count: usize,
        hexes: &[H],
        nodes: impl Fn(&H) -> &[NodeId; 8] + Sync,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled>
    where
        H: Sync,
    {
        let nodes_of = &nodes;
        let stars = Stars::new(node_count, hexes.len(), |k| *nodes_of(&hexes[k]));
        let hexes_at = |node: usize| stars.at(node).map(|(hex, corner)| (nodes_of(&hexes[hex]), corner));
        let edges = Lists::collect(node_count, monitor, |node, found| {
            for (nodes, corner) in hexes_at(node) {
                for other in NEIGHBOURS[corner] {
                    found([nodes[usize::from(other)]]);
                }
            }
        })?;
        let faces = Lists::collect(node_count, monitor, |node, found| {
            for (nodes, corner) in hexes_at(node) {
                for (_, following) in FACES_AT[corner] {
                    found(one_way(following.map(|k| nodes[usize::from(k)])));
                }
            }
        })?;
        Ok(Self { edges, faces })
    }

    /// Number of edges.
    pub(super) fn edge_count(&self) -> usize {
        self.edges.rest.len()
    }

    /// Number of faces.
    pub(super) fn face_count(&self) -> usize {
        self.faces.rest.len()
    }

    /// The number of the edge between `a` and `b`, which some hex must have.
    pub(super) fn edge(&self, [a, b]: [NodeId; 2]) -> usize {
        self.edges.find(a.min(b), [a.max(b)])
    }

    /// The number of a face, given by its nodes in order around it from any of them, either way; some hex
    /// must have it.
    pub(super) fn face(&self, nodes: [NodeId; 4]) -> usize {
        let least = (1..4).fold(0, |least, k| if nodes[k] < nodes[least] { k } else { least });
        let following = [1, 2, 3].map(|k| nodes[(least + k) % 4]);
        self.faces.find(nodes[least], one_way(following))
    }
}

/// The nodes that follow a face's least one, walked in the direction of the lesser neighbour.
pub(super) fn one_way([next, opposite, before]: [NodeId; 3]) -> [NodeId; 3] {
    if next < before { [next, opposite, before] } else { [before, opposite, next] }
}

/// Sets of `K + 1` nodes, each kept at its least node by the other `K`.
struct Lists<const K: usize> {
    start: Vec<u32>,
    rest: Vec<[NodeId; K]>,
}

impl<const K: usize> Lists<K> {
    /// `at(node, found)` calls `found` with the rest of each set that has `node`; those with a lesser node
    /// are passed over, and so is what was found before.
    fn collect(
        node_count: usize,
        monitor: &dyn Monitor,
        at: impl Fn(usize, &mut dyn FnMut([NodeId; K])) + Sync,
    ) -> Result<Self, Cancelled> {
        let blocks = parallel::try_blocks(node_count, BLOCK, monitor, |nodes| {
            let (mut counts, mut rest) = (Vec::with_capacity(nodes.len()), Vec::new());
            for node in nodes {
                let first = rest.len();
                at(node, &mut |others: [NodeId; K]| {
                    if others.iter().all(|other| other.index() > node) && !rest[first..].contains(&others) {
                        rest.push(others);
                    }
                });
                counts.push((rest.len() - first) as u32);
            }
            (counts, rest)
        })?;
        let mut start = Vec::with_capacity(node_count + 1);
        let mut rest = Vec::with_capacity(blocks.iter().map(|(_, rest)| rest.len()).sum());
        let mut end = 0;
        start.push(end);
        for (counts, more) in blocks {
            for count in counts {
                end += count;
                start.push(end);
            }
            rest.extend_from_slice(&more);
        }
        Ok(Self { start, rest })
    }

    fn find(&self, least: NodeId, rest: [NodeId; K]) -> usize {
        let range = self.start[least.index()] as usize..self.start[least.index() + 1] as usize;
        let place = self.rest[range.clone()].iter().position(|&other| other == rest);
        range.start + place.expect("an edge or face of the set")
    }
}
