//! A fingerprint of a mesh that is the same on every platform.

use xxhash_rust::xxh3::Xxh3;

use super::{NodeId, PolygonMesh};
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
    let mut hash = begin(positions, cells.len(), N);
    add_ids(&mut hash, bytemuck::cast_slice(cells.as_flattened()));
    MeshHash(hash.digest128())
}

/// The fingerprint of a polygon mesh. If all faces have the same number of nodes it is that of [`mesh_hash`];
/// else the `N` in its bytes is 0, and the faces' numbers of nodes, a `u32` each, stand before their nodes.
pub fn polygon_hash(mesh: &PolygonMesh) -> MeshHash {
    let sizes = || mesh.offsets.windows(2).map(|ends| ends[1] - ends[0]);
    let size = sizes().next().unwrap_or(0);
    let common = if sizes().all(|n| n == size) { size } else { 0 };
    let mut hash = begin(&mesh.positions, mesh.face_count(), common as usize);
    if common == 0 {
        add_ids(&mut hash, &sizes().collect::<Vec<_>>());
    }
    add_ids(&mut hash, bytemuck::cast_slice(&mesh.corners));
    MeshHash(hash.digest128())
}

/// A hash of the counts and the nodes.
fn begin(positions: &[Point], cells: usize, nodes_a_cell: usize) -> Xxh3 {
    let mut hash = Xxh3::new();
    for count in [positions.len(), cells, nodes_a_cell] {
        hash.update(&(count as u64).to_le_bytes());
    }
    let mut coordinates = Vec::with_capacity(BLOCK);
    for block in bytemuck::cast_slice::<Point, f64>(positions).chunks(BLOCK) {
        coordinates.clear();
        // Adding zero turns -0.0 into 0.0 and leaves every other number.
        coordinates.extend(block.iter().map(|x| (x + 0.0).to_bits().to_le()));
        hash.update(bytemuck::cast_slice(&coordinates));
    }
    hash
}

fn add_ids(hash: &mut Xxh3, numbers: &[u32]) {
    let mut ids = Vec::with_capacity(BLOCK);
    for block in numbers.chunks(BLOCK) {
        ids.clear();
        ids.extend(block.iter().map(|n| n.to_le()));
        hash.update(bytemuck::cast_slice(&ids));
    }
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

    fn polygons(faces: &[&[u32]]) -> PolygonMesh {
        let mut mesh = PolygonMesh { positions: vec![Point::ONE; 6], ..PolygonMesh::default() };
        for face in faces {
            mesh.push_face(face.iter().copied().map(NodeId));
        }
        mesh
    }

    #[test]
    fn polygons_of_one_size_hash_as_cells_of_that_size() {
        let quads = polygons(&[&[0, 1, 2, 3], &[1, 4, 5, 2]]);
        let cells = [[0, 1, 2, 3], [1, 4, 5, 2]].map(|q| q.map(NodeId));
        assert_eq!(polygon_hash(&quads), mesh_hash(&quads.positions, &cells));
        assert_eq!(polygon_hash(&PolygonMesh::default()), mesh_hash::<0>(&[], &[]));
    }

    #[test]
    fn polygons_of_several_sizes_hash_by_size_and_nodes() {
        let mesh = polygons(&[&[0, 1, 2], &[1, 4, 5, 2]]);
        let mut bytes = Vec::new();
        for count in [6u64, 2, 0] {
            bytes.extend(count.to_le_bytes());
        }
        mesh.positions.iter().for_each(|p| p.to_array().iter().for_each(|x| bytes.extend(x.to_le_bytes())));
        [3u32, 4, 0, 1, 2, 1, 4, 5, 2].iter().for_each(|n| bytes.extend(n.to_le_bytes()));
        assert_eq!(polygon_hash(&mesh), MeshHash(xxhash_rust::xxh3::xxh3_128(&bytes)));
        assert_ne!(polygon_hash(&mesh), polygon_hash(&polygons(&[&[0, 1, 2, 1], &[4, 5, 2]])));
    }
}
