//! A fingerprint of a mesh that is the same on every platform.

use xxhash_rust::xxh3::Xxh3;

use super::NodeId;
use crate::geometry::Point;

/// 128 bits that tell meshes apart; shown as 32 hexadecimal digits.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct MeshHash(pub u128);

impl std::fmt::Display for MeshHash {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{:032x}", self.0)
    }
}

impl serde::Serialize for MeshHash {
    /// As its digits: no JSON number holds 128 bits.
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

/// The fingerprint of the mesh with the given nodes and cells of `N` nodes each: the XXH3-128 hash, seed
/// 0, of these bytes, all little-endian:
///
/// 1. three `u64`: number of nodes, number of cells, `N`;
/// 2. per node three `f64`, where -0.0 is written as 0.0 (they compare equal);
/// 3. per cell `N` `u32`.
///
/// Two meshes of the same numbers in the same order have the same hash, on every platform, for any
/// number of threads; it says nothing of meshes that differ in numbering alone.
///
/// ```
/// use hexmill::mesh::{NodeId, mesh_hash};
/// let hash = mesh_hash(&[Default::default(); 4], &[[0, 1, 2, 3].map(NodeId)]);
/// assert_eq!(hash.to_string(), "902d19085337aea86512040df6a7e2f6");
/// ```
pub fn mesh_hash<const N: usize>(positions: &[Point], cells: &[[NodeId; N]]) -> MeshHash {
    let mut hash = Xxh3::new();
    for count in [positions.len(), cells.len(), N] {
        hash.update(&(count as u64).to_le_bytes());
    }
    let mut coordinates = Vec::with_capacity(BLOCK);
    for block in bytemuck::cast_slice::<Point, f64>(positions).chunks(BLOCK) {
        coordinates.clear();
        // Adding zero turns -0.0 into 0.0 and leaves every other number.
        coordinates.extend(block.iter().map(|x| (x + 0.0).to_bits().to_le()));
        hash.update(bytemuck::cast_slice(&coordinates));
    }
    let mut ids = Vec::with_capacity(BLOCK);
    for block in cells.as_flattened().chunks(BLOCK) {
        ids.clear();
        ids.extend(block.iter().map(|n| n.0.to_le()));
        hash.update(bytemuck::cast_slice(&ids));
    }
    MeshHash(hash.digest128())
}

/// Numbers that are brought into shape before they are hashed: a block stays in the nearest cache.
const BLOCK: usize = 1024;

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh() -> (Vec<Point>, Vec<[NodeId; 4]>) {
        let positions = (0..2000).map(|i| Point::new(f64::from(i) / 3.0, -f64::from(i), 0.0)).collect();
        (positions, (0..1500).map(|i| [i, i + 1, i + 3, i + 2].map(NodeId)).collect())
    }

    #[test]
    fn is_the_hash_of_the_documented_bytes() {
        let (positions, quads) = mesh();
        let mut bytes = Vec::new();
        for count in [2000u64, 1500, 4] {
            bytes.extend(count.to_le_bytes());
        }
        positions
            .iter()
            .for_each(|p| p.to_array().iter().for_each(|x| bytes.extend((x + 0.0).to_le_bytes())));
        quads.iter().flatten().for_each(|n| bytes.extend(n.0.to_le_bytes()));
        assert_eq!(mesh_hash(&positions, &quads), MeshHash(xxhash_rust::xxh3::xxh3_128(&bytes)));
    }

    #[test]
    fn sees_every_number_but_not_the_sign_of_zero() {
        let (mut positions, mut quads) = mesh();
        let before = mesh_hash(&positions, &quads);
        positions[1234].z = -0.0;
        assert_eq!(mesh_hash(&positions, &quads), before);
        positions[1234].z = f64::MIN_POSITIVE;
        assert_ne!(mesh_hash(&positions, &quads), before);
        positions[1234].z = 0.0;
        quads[999].swap(1, 3);
        assert_ne!(mesh_hash(&positions, &quads), before);
    }

    #[test]
    fn tells_four_nodes_a_cell_from_eight() {
        let ids: [NodeId; 8] = std::array::from_fn(NodeId::new);
        let quads = [[ids[0], ids[1], ids[2], ids[3]], [ids[4], ids[5], ids[6], ids[7]]];
        assert_ne!(mesh_hash(&[], &quads), mesh_hash(&[], &[ids]));
    }
}
