//! Faces of a file that are boundary faces of its hexes.

use std::collections::HashMap;

use crate::mesh::NodeId;
use crate::mesh::numbering::hex::FACES;
use crate::mesh::topology::Side;

/// The faces of a file, beside its hexes.
pub(super) struct Matched {
    /// Those that are boundary faces: the side that each is, ascending, and which cell of the file.
    pub sides: Vec<(Side, u32)>,
    /// The cells of the file that are none.
    pub others: Vec<u32>,
}

/// Which sides of the hexes have a set of nodes.
#[derive(Clone, Copy, Default)]
struct Sides {
    first: Side,
    count: u32,
}

/// Finds each face, given by its nodes and its cell's number, among the sides of the hexes: faces are one if their sets
/// of nodes are. A face between two hexes is no boundary face. Node ids are in range.
pub(super) fn match_faces<'a>(
    hexes: &[[NodeId; 8]],
    node_count: usize,
    faces: impl Iterator<Item = (&'a [NodeId], u32)> + Clone,
) -> Matched {
    let mut sides: HashMap<[NodeId; 4], Sides> = HashMap::new();
    let mut is_at_face = vec![false; if faces.clone().next().is_some() { node_count } else { 0 }];
    for nodes in faces.clone().filter_map(|(face, _)| quad(face)) {
        nodes.iter().for_each(|n| is_at_face[n.index()] = true);
        sides.insert(nodes, Sides::default());
    }
    if !sides.is_empty() {
        for (h, hex) in hexes.iter().enumerate() {
            for (k, corners) in FACES.iter().enumerate() {
                let nodes = corners.map(|corner| hex[usize::from(corner)]);
                if nodes.iter().all(|n| is_at_face[n.index()])
                    && let Some(found) = sides.get_mut(&ascending(nodes))
                {
                    found.first = if found.count == 0 { (6 * h + k) as Side } else { found.first };
                    found.count += 1;
                }
            }
        }
    }
    let (mut matched, mut others) = (Vec::new(), Vec::new());
    for (face, cell) in faces {
        match quad(face).map(|nodes| sides[&nodes]) {
            Some(Sides { first, count: 1 }) => matched.push((first, cell)),
            _ => others.push(cell),
        }
    }
    matched.sort_unstable();
    Matched { sides: matched, others }
}

/// The nodes of a face of four, ascending.
fn quad(face: &[NodeId]) -> Option<[NodeId; 4]> {
    <[NodeId; 4]>::try_from(face).ok().map(ascending)
}

fn ascending(mut nodes: [NodeId; 4]) -> [NodeId; 4] {
    nodes.sort_unstable();
    nodes
}
