//! The base of a forest of octrees, from a hex mesh. The paper refines every hex of level 0 once (section 3), which tells
//! edge, face and volume nodes apart everywhere.

use super::HexForest;
use super::octree::{HexLevel, LevelEdges, LevelFaces, Sides, edges_of_face};
use crate::mesh::topology::{HexEdges, HexFaces, hex_of};
use crate::mesh::{EdgeId, FaceId, HexMesh};
use crate::{Cancelled, Monitor, Silent, parallel};

impl HexForest {
    /// The forest of level 0: the hexes of `input`, whose nodes keep their numbers.
    ///
    /// # Panics
    /// If a hex has a node twice or one that is out of range, or if hexes disagree about a face: `check_hexes`
    /// tells before.
    pub fn new(input: &HexMesh) -> Self {
        Self::within(input, &Silent).expect("nobody stops it")
    }

    /// As [`HexForest::new`], told by a monitor when to stop.
    ///
    /// # Errors
    /// If the monitor stops it.
    ///
    /// # Panics
    /// As [`HexForest::new`].
    pub fn within(input: &HexMesh, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let (count, hexes) = (input.positions.len(), input.hexes.as_slice());
        let (faces, edges) = parallel::join(
            || HexFaces::within(count, hexes, monitor),
            || HexEdges::within(count, hexes, monitor),
        );
        let (faces, edges) = (faces?, edges?);
        let edges_of = |f: FaceId| -> [EdgeId; 4] {
            let side = faces.sides(f)[0];
            edges_of_face(side as usize % 6, &edges.of_hex[hex_of(side).index()])
        };
        let face_edges = faces.ids().map(edges_of).collect();
        // What is taken apart here is not kept beside what is made of it.
        let (nodes, faces_of_hex, _) = faces.into_parts();
        let HexEdges { ends, of_hex: edges_of_hex } = edges;
        let sides = faces_of_hex.into_iter().zip(edges_of_hex);
        let sides = sides.map(|(faces, edges)| Sides { edges, faces }).collect();
        let level_faces = LevelFaces::base(nodes, face_edges);
        let base = HexLevel::base(input.hexes.clone(), sides, LevelEdges::base(ends), level_faces);
        Ok(Self { positions: input.positions.clone(), levels: vec![HexLevel::default()], base })
    }
}
