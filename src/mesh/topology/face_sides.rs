//! The sides of hexes that given faces are, for a few faces of many.

use std::collections::HashMap;

use super::Side;
use super::hexes::side_nodes;
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::FACES;

/// Which sides of hexes have the same nodes as some faces, in any order.
pub(crate) struct FaceSides(HashMap<[NodeId; 4], Sides>);

/// The first two sides with a set of nodes, and how many there are.
#[derive(Clone, Copy, Default)]
struct Sides {
    first: [Side; 2],
    count: usize,
    is_told: bool,
}

impl FaceSides {
    /// Looks for `faces` among the sides of the hexes. Node ids are less than `node_count`.
    pub(crate) fn find(
        hexes: &[[NodeId; 8]],
        node_count: usize,
        faces: impl Iterator<Item = [NodeId; 4]>,
    ) -> Self {
        let mut sides: HashMap<[NodeId; 4], Sides> = HashMap::new();
        let mut is_at_face = Vec::new();
        for nodes in faces {
            is_at_face.resize(node_count, false);
            nodes.iter().for_each(|n| is_at_face[n.index()] = true);
            sides.insert(ascending(nodes), Sides::default());
        }
        if sides.is_empty() {
            return Self(sides);
        }
        for (h, hex) in hexes.iter().enumerate() {
            for (k, corners) in FACES.iter().enumerate() {
                let nodes = corners.map(|corner| hex[usize::from(corner)]);
                if nodes.iter().all(|n| is_at_face[n.index()])
                    && let Some(found) = sides.get_mut(&ascending(nodes))
                {
                    if let Some(side) = found.first.get_mut(found.count) {
                        *side = (6 * h + k) as Side;
                    }
                    found.count += 1;
                }
            }
        }
        Self(sides)
    }

    /// The sides that a face is, ascending: one on the boundary, two between hexes; none if the hexes do not have it, or
    /// more than two have.
    pub(crate) fn of(&self, face: [NodeId; 4]) -> &[Side] {
        self.0.get(&ascending(face)).and_then(|found| found.first.get(..found.count)).unwrap_or_default()
    }

    /// The side that a face is; of one between hexes the side from which its nodes go around as they are given where it is
    /// asked for first.
    pub(crate) fn told(&mut self, hexes: &[[NodeId; 8]], face: [NodeId; 4]) -> Option<Side> {
        let found = self.0.get_mut(&ascending(face)).filter(|found| (1..=2).contains(&found.count))?;
        if found.count == 2 && !found.is_told && is_turned_to(face, side_nodes(hexes, found.first[1])) {
            found.first.swap(0, 1);
        }
        found.is_told = true;
        Some(found.first[0])
    }
}

/// Do two faces have the same nodes in the same order around, wherever they begin?
fn is_turned_to(a: [NodeId; 4], b: [NodeId; 4]) -> bool {
    (0..4).any(|shift| (0..4).all(|k| a[k] == b[(k + shift) % 4]))
}

fn ascending(mut nodes: [NodeId; 4]) -> [NodeId; 4] {
    nodes.sort_unstable();
    nodes
}
