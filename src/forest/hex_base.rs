//! The base of a forest of octrees, from a hex mesh: every hex of level 0 is refined once, as in the paper (section
//! 3), which tells edge, face and volume nodes apart everywhere.

use super::HexForest;
use super::octree::{HexLevel, LevelEdges, LevelFaces, Sides, edges_of_face, refine};
use crate::mesh::topology::{HexEdges, HexFaces, hex_of};
use crate::mesh::{EdgeId, FaceId, HexMesh};
use crate::parallel;

impl HexForest {
    /// The forest of level 1: every hex of `input` refined once. The input's nodes keep their numbers.
    ///
    /// # Panics
    /// If a hex has a node twice or one that is out of range, or if hexes disagree about a face: `check_hexes`
    /// tells before.
    pub fn refined_once(input: &HexMesh) -> Self {
        let (count, hexes) = (input.positions.len(), input.hexes.as_slice());
        let (faces, edges) = parallel::join(|| HexFaces::of(count, hexes), || HexEdges::of(count, hexes));
        let edges_of = |f: FaceId| -> [EdgeId; 4] {
            let side = faces.sides(f)[0];
            edges_of_face(side as usize % 6, &edges.of_hex[hex_of(side).index()])
        };
        let face_edges = faces.ids().map(edges_of).collect();
        let sides = faces.of_hex.iter().zip(&edges.of_hex);
        let sides = sides.map(|(&faces, &edges)| Sides { edges, faces }).collect();
        let level_faces = LevelFaces::base(faces.nodes, face_edges);
        let mut base = HexLevel::base(input.hexes.clone(), sides, LevelEdges::base(edges.ends), level_faces);
        let mut positions = input.positions.clone();
        let mut first = HexLevel::default();
        let all: Vec<u32> = (0..input.hexes.len() as u32).collect();
        refine(&mut positions, &mut base, &mut first, &all);
        Self { positions, levels: vec![first], base }
    }
}
