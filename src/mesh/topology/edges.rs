//! The unique edges of a surface.

use super::{NodeSets, degrees};
use crate::mesh::{EdgeId, Faces, NodeId, PolygonMesh, QuadMesh};
use crate::monitor::batches;
use crate::{Cancelled, Monitor, Silent};

/// The unique edges of a surface, numbered in the order in which a walk over the faces meets them.
///
/// Linear time and no hashing: each edge hangs in a short list at that of its ends where fewer faces
/// meet, so on a surface the lists walked have bounded length on average, whatever the valence of
/// single nodes (Chiba and Nishizeki: the sum of the smaller degrees over the edges of a graph is at
/// most twice its arboricity times its number of edges; a planar graph's arboricity is at most 3).
///
/// ```
/// use hexmill::mesh::{Edges, NodeId, QuadMesh};
/// // 3---2---5
/// // | 0 | 1 |
/// // 0---1---4
/// let quads = vec![[0, 1, 2, 3].map(NodeId), [1, 4, 5, 2].map(NodeId)];
/// let mesh = QuadMesh { positions: vec![Default::default(); 6], quads };
/// let edges = Edges::of_quads(&mesh);
/// assert_eq!(edges.ends.len(), 7);
/// assert_eq!(edges.of_corner[1], edges.of_corner[7]); // the edge 1-2 of both
/// ```
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Edges {
    /// The two ends of each edge, in the direction in which its first face walks it.
    pub ends: Vec<[NodeId; 2]>,
    /// Parallel to the mesh's corners: the edge from corner `k` to the next corner of its face.
    pub of_corner: Vec<EdgeId>,
}

impl Edges {
    /// The edges of a polygon mesh.
    ///
    /// # Panics
    /// If a node id is out of range: `check_polygons` tells before.
    pub fn of_polygons(mesh: &PolygonMesh) -> Self {
        Self::of(mesh)
    }

    /// The edges of a quad mesh; the edges of quad `q` are `of_corner[4 * q..4 * q + 4]`.
    ///
    /// # Panics
    /// If a node id is out of range: `check_quads` tells before.
    pub fn of_quads(mesh: &QuadMesh) -> Self {
        Self::of(mesh)
    }

    /// The edges of any surface, as the two above.
    pub fn of(mesh: &impl Faces) -> Self {
        Self::monitored(mesh, &Silent).expect("nobody stops it")
    }

    /// The edges of any surface, for callers that may want to stop.
    ///
    /// # Errors
    /// If the monitor stops it.
    pub fn monitored(mesh: &impl Faces, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let corners = mesh.corners();
        // A closed surface has two corners an edge.
        let degrees = degrees(mesh.node_count(), corners);
        let mut sets = NodeSets::new(&degrees, corners.len() / 2);
        let mut of_corner = Vec::with_capacity(corners.len());
        for batch in batches(mesh.face_count(), monitor) {
            for f in batch? {
                let face = mesh.nodes_of(f);
                for (i, &a) in face.iter().enumerate() {
                    let b = face.get(i + 1).copied().unwrap_or(face[0]);
                    of_corner.push(EdgeId(sets.number([a, b])));
                }
            }
        }
        Ok(Self { ends: sets.into_nodes(), of_corner })
    }

    /// Number of edges.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// True if there is no edge.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use std::collections::HashMap;

    fn polygons(nodes: usize, faces: &[&[u32]]) -> PolygonMesh {
        let mut mesh = PolygonMesh { positions: vec![Point::ZERO; nodes], ..Default::default() };
        for face in faces {
            mesh.push_face(face.iter().map(|&n| NodeId(n)));
        }
        mesh
    }

    /// The same numbering by the obvious means.
    fn by_hash_map(mesh: &PolygonMesh) -> Edges {
        let mut seen = HashMap::new();
        let mut edges = Edges::default();
        for face in mesh.faces() {
            for (i, &a) in face.iter().enumerate() {
                let b = face[(i + 1) % face.len()];
                let e = *seen.entry((a.min(b), a.max(b))).or_insert_with(|| {
                    edges.ends.push([a, b]);
                    EdgeId::new(edges.ends.len() - 1)
                });
                edges.of_corner.push(e);
            }
        }
        edges
    }

    #[test]
    fn numbers_edges_in_order_of_first_appearance() {
        let mesh = polygons(5, &[&[0, 1, 2, 3], &[2, 1, 4]]);
        let edges = Edges::of_polygons(&mesh);
        assert_eq!(edges.of_corner.iter().map(|e| e.0).collect::<Vec<_>>(), [0, 1, 2, 3, 1, 4, 5]);
        assert_eq!(edges.ends[1], [NodeId(1), NodeId(2)], "in the direction of the first face");
        assert_eq!(edges, by_hash_map(&mesh));
    }

    #[test]
    fn a_fan_of_huge_valence_takes_linear_time() {
        let spokes = 200_000;
        let mut mesh = polygons(spokes as usize + 1, &[]);
        for i in 0..spokes {
            mesh.push_face([0, 1 + i, 1 + (i + 1) % spokes].map(NodeId));
        }
        let edges = Edges::of_polygons(&mesh);
        assert_eq!(edges.len(), 2 * spokes as usize);
        assert_eq!(edges, by_hash_map(&mesh));
    }

    #[cfg(not(target_arch = "wasm32"))]
    proptest::proptest! {
        #[test]
        fn agrees_with_a_hash_map_on_any_faces(
            faces in proptest::collection::vec(proptest::collection::vec(0u32..12, 1..7), 0..40),
        ) {
            let faces: Vec<&[u32]> = faces.iter().map(Vec::as_slice).collect();
            let mesh = polygons(12, &faces);
            proptest::prop_assert_eq!(Edges::of_polygons(&mesh), by_hash_map(&mesh));
        }
    }
}
