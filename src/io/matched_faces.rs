//! Faces of a file that are faces of its hexes.

use crate::mesh::NodeId;
use crate::mesh::topology::{FaceSides, Side};

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
    let quad = |face: &[NodeId]| <[NodeId; 4]>::try_from(face).ok();
    let quads = faces.clone().filter_map(|(face, _)| quad(face));
    let mut known = FaceSides::find(hexes, node_count, quads);
    let (mut matched, mut others) = (Vec::new(), Vec::new());
    for (face, cell) in faces {
        match quad(face).and_then(|face| known.told(hexes, face)) {
            Some(side) => matched.push((side, cell)),
            None => others.push(cell),
        }
    }
    matched.sort_unstable();
    Matched { sides: matched, others }
}
