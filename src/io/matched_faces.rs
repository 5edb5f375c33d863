//! Faces of a file that are faces of its hexes.

use std::collections::HashMap;

use crate::mesh::NodeId;
use crate::mesh::topology::{FaceSides, Side, side_nodes};

/// The faces of a file, beside its hexes.
pub(super) struct Matched {
    /// Those that are faces of hexes: the side that each is, ascending, and which cell of the file.
    pub sides: Vec<(Side, u32)>,
    /// The cells of the file that are none.
    pub others: Vec<u32>,
}

/// Finds each face, given by its nodes and its cell's number, among the sides of the hexes: faces are one if their sets
/// of nodes are. A face between two hexes is the side from which it looks the way the file has it; where the file has it
/// twice, the first one's. Node ids are in range.
pub(super) fn match_faces<'a>(
    hexes: &[[NodeId; 8]],
    node_count: usize,
    faces: impl Iterator<Item = (&'a [NodeId], u32)> + Clone,
) -> Matched {
    let quads = faces.clone().filter_map(|(face, _)| quad(face));
    let known = FaceSides::find(hexes, node_count, quads);
    let mut chosen: HashMap<Side, Side> = HashMap::new();
    let mut side_of = |face: [NodeId; 4]| match *known.of(face) {
        [] => None,
        [first] => Some(first),
        [first, second, ..] => Some(*chosen.entry(first).or_insert_with(|| {
            let looks_so = is_turned_to(face, side_nodes(hexes, second));
            if looks_so { second } else { first }
        })),
    };
    let (mut matched, mut others) = (Vec::new(), Vec::new());
    for (face, cell) in faces {
        match quad(face).and_then(&mut side_of) {
            Some(side) => matched.push((side, cell)),
            None => others.push(cell),
        }
    }
    matched.sort_unstable();
    Matched { sides: matched, others }
}

/// The nodes of a face of four.
fn quad(face: &[NodeId]) -> Option<[NodeId; 4]> {
    face.try_into().ok()
}

/// Do two faces have the same nodes in the same order around, wherever they begin?
fn is_turned_to(a: [NodeId; 4], b: [NodeId; 4]) -> bool {
    (0..4).any(|shift| (0..4).all(|k| a[k] == b[(k + shift) % 4]))
}
