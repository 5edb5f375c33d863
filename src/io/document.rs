//! What a file holds, whatever its format.

use crate::mesh::{FaceId, HexMesh, PolygonMesh, QuadMesh, Tags};

/// The cells of a file.
#[derive(Clone, Debug, PartialEq)]
pub enum AnyMesh {
    /// A surface of polygons (triangles and quads among them).
    Polygons(PolygonMesh),
    /// A quad mesh.
    Quads(QuadMesh),
    /// A hex mesh.
    Hexes(HexMesh),
}

/// A mesh with what is known of its cells. The vectors have an entry a cell, or none at all.
#[derive(Clone, Debug, PartialEq)]
pub struct Document {
    /// Nodes and cells.
    pub mesh: AnyMesh,
    /// Names of cells.
    pub tags: Tags,
    /// Refinement level of each cell.
    pub level: Vec<u8>,
    /// The cell of the input that each cell is part of.
    pub parent: Vec<FaceId>,
}
