//! What a file holds, whatever its format.

use crate::geometry::Point;
use crate::mesh::{FaceId, HexMesh, PolygonMesh, QuadMesh, SecondOrder, Tags};
use crate::refine::RefinedQuads;
use crate::refine::hex::RefinedHexes;

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

impl AnyMesh {
    /// Coordinates of the nodes.
    pub fn positions(&self) -> &[Point] {
        match self {
            Self::Polygons(mesh) => &mesh.positions,
            Self::Quads(mesh) => &mesh.positions,
            Self::Hexes(mesh) => &mesh.positions,
        }
    }

    /// Number of nodes.
    pub fn node_count(&self) -> usize {
        self.positions().len()
    }

    /// Number of cells: faces or hexes.
    pub fn cell_count(&self) -> usize {
        match self {
            Self::Polygons(mesh) => mesh.face_count(),
            Self::Quads(mesh) => mesh.quads.len(),
            Self::Hexes(mesh) => mesh.hexes.len(),
        }
    }
}

/// A mesh with what is known of its cells. The vectors have an entry a cell, or none at all.
///
/// The names of the cells stand in [`Document::tags`] alone: the `tags` of the mesh within are empty. The groups of the
/// faces of hexes stand in the mesh.
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
    /// What makes the hexes hexes of the second order; only written.
    pub second_order: Option<SecondOrder>,
    /// Hexes of the second order in a file: their corners were read, their nodes on edges, on faces and inside left out.
    pub linearized: usize,
    /// Cells in a VTU or legacy VTK file that it hides, or that another piece has too (`vtkGhostType`, `vtkGhostLevels`):
    /// they were left out.
    pub hidden: usize,
    /// Faces in a file of hexes that are no faces of these, and were left out.
    pub dropped_faces: usize,
    /// The groups in a file of hexes that were left out, all or in part: of such faces, of edges and of nodes. One without
    /// a name is told by its number.
    pub dropped_groups: Vec<String>,
    /// The arrays of a VTU or legacy VTK file, on cells or nodes, that are not read: they are no tags, levels or parents.
    pub dropped_arrays: Vec<String>,
}

impl Document {
    /// A document of `mesh` alone; the mesh's own tags become the document's.
    pub fn new(mut mesh: AnyMesh) -> Self {
        let tags = match &mut mesh {
            AnyMesh::Polygons(mesh) => std::mem::take(&mut mesh.tags),
            AnyMesh::Hexes(mesh) => std::mem::take(&mut mesh.tags),
            AnyMesh::Quads(_) => Tags::default(),
        };
        Self {
            mesh,
            tags,
            level: Vec::new(),
            parent: Vec::new(),
            second_order: None,
            linearized: 0,
            hidden: 0,
            dropped_faces: 0,
            dropped_groups: Vec::new(),
            dropped_arrays: Vec::new(),
        }
    }

    /// The faces of the document as a surface with its tags, or `None` if it holds hexes.
    pub fn into_surface(self) -> Option<PolygonMesh> {
        let mut surface = match self.mesh {
            AnyMesh::Polygons(mesh) => mesh,
            AnyMesh::Quads(mesh) => PolygonMesh {
                positions: mesh.positions,
                offsets: (0..=mesh.quads.len()).map(|q| 4 * q as u32).collect(),
                corners: mesh.quads.into_flattened(),
                ..PolygonMesh::default()
            },
            AnyMesh::Hexes(_) => return None,
        };
        surface.tags = self.tags;
        Some(surface)
    }
}

impl From<PolygonMesh> for Document {
    fn from(mesh: PolygonMesh) -> Self {
        Self::new(AnyMesh::Polygons(mesh))
    }
}

impl From<QuadMesh> for Document {
    fn from(mesh: QuadMesh) -> Self {
        Self::new(AnyMesh::Quads(mesh))
    }
}

impl From<HexMesh> for Document {
    fn from(mesh: HexMesh) -> Self {
        Self::new(AnyMesh::Hexes(mesh))
    }
}

impl From<RefinedHexes> for Document {
    fn from(refined: RefinedHexes) -> Self {
        let document = Self::from(refined.mesh);
        Self { level: refined.level, parent: refined.root.into_iter().map(FaceId).collect(), ..document }
    }
}

impl From<RefinedQuads> for Document {
    fn from(refined: RefinedQuads) -> Self {
        let RefinedQuads { mesh, tags, level, parent, .. } = refined;
        Self { tags, level, parent, ..Self::from(mesh) }
    }
}
