//! The boundary of a hex mesh.

use rayon::prelude::*;

use crate::mesh::numbering::hex::FACES;
use crate::mesh::{HexId, NodeId};

/// The faces that one hex alone has, anticlockwise seen from outside, each with its hex; in the order of
/// the hexes and of their faces in [`FACES`].
///
/// ```
/// use hexmill::mesh::{NodeId, topology::hex_boundary};
/// let two = [[0, 1, 4, 3, 6, 7, 10, 9], [1, 2, 5, 4, 7, 8, 11, 10]].map(|hex| hex.map(NodeId));
/// assert_eq!(hex_boundary(&two).len(), 10);
/// ```
pub fn hex_boundary(hexes: &[[NodeId; 8]]) -> Vec<([NodeId; 4], HexId)> {
    let face = |index: usize| FACES[index % 6].map(|corner| hexes[index / 6][usize::from(corner)]);
    let sorted = |index: usize| {
        let mut nodes = face(index);
        nodes.sort_unstable();
        nodes
    };
    // Faces of the same nodes have the same least node: only those few are compared.
    let node_count = hexes.as_flattened().iter().max().map_or(0, |node| node.index() + 1);
    let mut ends = vec![0; node_count + 1];
    for index in 0..6 * hexes.len() {
        ends[sorted(index)[0].index() + 1] += 1;
    }
    for node in 0..node_count {
        ends[node + 1] += ends[node];
    }
    let mut next = ends.clone();
    let mut by_least = vec![0; 6 * hexes.len()];
    for index in 0..6 * hexes.len() {
        let place = &mut next[sorted(index)[0].index()];
        by_least[*place] = index;
        *place += 1;
    }
    let mut boundary: Vec<usize> = (0..node_count)
        .into_par_iter()
        .flat_map_iter(|node| {
            let faces = by_least[ends[node]..ends[node + 1]].iter();
            let mut faces: Vec<([NodeId; 4], usize)> = faces.map(|&index| (sorted(index), index)).collect();
            faces.sort_unstable();
            let alone = faces.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1);
            alone.map(|same| same[0].1).collect::<Vec<_>>()
        })
        .collect();
    boundary.par_sort_unstable();
    boundary.into_iter().map(|index| (face(index), HexId::new(index / 6))).collect()
}
