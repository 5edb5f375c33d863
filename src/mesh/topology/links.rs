//! The links of a hex mesh's nodes.

use super::{HexEdges, HexFaces};
use crate::mesh::{FaceId, NodeId};
use crate::monitor::batches;
use crate::{Cancelled, Monitor};

/// The links of the nodes. The **link** of a node is the surface that the hexes around it cut out of a small ball
/// about it: a triangle a hex, an edge a face, a corner an edge of the mesh. It is a sphere around a node inside a
/// manifold and a disc around one on its boundary.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Links {
    /// Hexes at each node.
    hexes: Vec<u32>,
    /// The Euler characteristic of each node's link.
    euler: Vec<i32>,
    /// For each node: has it a boundary face?
    pub on_boundary: Vec<bool>,
}

impl Links {
    /// Counts edges, faces and hexes at each of `count` nodes.
    pub fn within(
        count: usize,
        hexes: &[[NodeId; 8]],
        faces: &HexFaces,
        edges: &HexEdges,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let (mut at, mut euler, mut on_boundary) = (vec![0; count], vec![0; count], vec![false; count]);
        for batch in batches(hexes.len(), monitor) {
            hexes[batch?].as_flattened().iter().for_each(|n| at[n.index()] += 1);
        }
        euler.iter_mut().zip(&at).for_each(|(euler, &hexes)| *euler = hexes as i32);
        for batch in batches(edges.ends.len(), monitor) {
            edges.ends[batch?].as_flattened().iter().for_each(|n| euler[n.index()] += 1);
        }
        for batch in batches(faces.nodes.len(), monitor) {
            for f in batch? {
                let is_boundary = faces.is_boundary(FaceId::new(f));
                for n in faces.nodes[f] {
                    euler[n.index()] -= 1;
                    on_boundary[n.index()] |= is_boundary;
                }
            }
        }
        Ok(Self { hexes: at, euler, on_boundary })
    }

    /// The number of nodes, used or not.
    pub fn len(&self) -> usize {
        self.hexes.len()
    }

    /// True if some hex uses node `n`.
    pub fn is_used(&self, n: usize) -> bool {
        self.hexes[n] > 0
    }

    /// The nodes in use whose link has not the Euler characteristic of a sphere (2) or, on the boundary, of a disc
    /// (1), with that characteristic.
    pub fn odd(&self) -> impl Iterator<Item = (NodeId, i32)> {
        let is_odd = |&n: &usize| self.is_used(n) && self.euler[n] != if self.on_boundary[n] { 1 } else { 2 };
        (0..self.euler.len()).filter(is_odd).map(|n| (NodeId::new(n), self.euler[n]))
    }
}
