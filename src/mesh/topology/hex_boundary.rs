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
    let mut faces: Vec<([NodeId; 4], usize)> = (0..6 * hexes.len())
        .into_par_iter()
        .map(|index| {
            let mut key = face(index);
            key.sort_unstable();
            (key, index)
        })
        .collect();
    faces.par_sort_unstable();
    let mut boundary: Vec<usize> =
        faces.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1).map(|same| same[0].1).collect();
    boundary.sort_unstable();
    boundary.into_iter().map(|index| (face(index), HexId::new(index / 6))).collect()
}
