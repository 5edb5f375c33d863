//! What the writers see of a document: nodes, cells of any kind, and what is known of each cell.

use super::refusal::{code, refuse_writing};
use super::{AnyMesh, Document, Format, WriteError};
use crate::geometry::Point;
use crate::mesh::{FaceId, NodeId, PolygonMesh, Tags};

/// A document that was checked: every node id is in range, every coordinate is finite, and the columns
/// have an entry a cell or none.
pub(super) struct CellView<'a> {
    /// Coordinates of the nodes.
    pub positions: &'a [Point],
    /// The cells.
    pub cells: Cells<'a>,
    /// Names of cells.
    pub tags: &'a Tags,
    /// Level of each cell, or empty.
    pub level: &'a [u8],
    /// Parent of each cell, or empty.
    pub parent: &'a [FaceId],
}

/// The cells of a mesh.
#[derive(Clone, Copy)]
pub(super) enum Cells<'a> {
    /// Faces of any number of nodes.
    Polygons(&'a PolygonMesh),
    /// Quads.
    Quads(&'a [[NodeId; 4]]),
    /// Hexahedra.
    Hexes(&'a [[NodeId; 8]]),
}

impl<'a> Cells<'a> {
    /// Number of cells.
    pub fn len(self) -> usize {
        match self {
            Self::Polygons(mesh) => mesh.face_count(),
            Self::Quads(quads) => quads.len(),
            Self::Hexes(hexes) => hexes.len(),
        }
    }

    /// The nodes of a cell.
    pub fn nodes(self, cell: usize) -> &'a [NodeId] {
        match self {
            Self::Polygons(mesh) => mesh.face(cell),
            Self::Quads(quads) => &quads[cell],
            Self::Hexes(hexes) => &hexes[cell],
        }
    }

    /// The nodes of all cells, cell after cell.
    pub fn corners(self) -> &'a [NodeId] {
        match self {
            Self::Polygons(mesh) => &mesh.corners,
            Self::Quads(quads) => quads.as_flattened(),
            Self::Hexes(hexes) => hexes.as_flattened(),
        }
    }

    /// True if the cells are hexahedra.
    pub fn are_hexes(self) -> bool {
        matches!(self, Self::Hexes(_))
    }
}

impl<'a> CellView<'a> {
    /// The view of `document`, which must hold together.
    pub fn new(document: &'a Document, format: Format) -> Result<Self, WriteError> {
        let (positions, cells) = match &document.mesh {
            AnyMesh::Polygons(mesh) => (&mesh.positions, Cells::Polygons(mesh)),
            AnyMesh::Quads(mesh) => (&mesh.positions, Cells::Quads(&mesh.quads)),
            AnyMesh::Hexes(mesh) => (&mesh.positions, Cells::Hexes(&mesh.hexes)),
        };
        let view =
            Self { positions, cells, tags: &document.tags, level: &document.level, parent: &document.parent };
        view.check().map_err(|(code, message)| refuse_writing(format, code, message))?;
        Ok(view)
    }

    fn check(&self) -> Result<(), (&'static str, String)> {
        let count = self.cells.len();
        let columns = [
            ("tags", self.tags.of_element.len()),
            ("levels", self.level.len()),
            ("parents", self.parent.len()),
        ];
        if let Some((what, length)) = columns.into_iter().find(|&(_, length)| length != 0 && length != count)
        {
            return Err((code::INCONSISTENT, format!("there are {length} {what} for {count} cells")));
        }
        if let Some(set) = self.tags.of_element.iter().find(|&&set| set as usize >= self.tags.sets.len()) {
            return Err((
                code::INCONSISTENT,
                format!("a cell has tag set {set} of {}", self.tags.sets.len()),
            ));
        }
        let nodes = self.positions.len();
        if let Some(node) = self.cells.corners().iter().find(|node| node.index() >= nodes) {
            return Err((code::NODE_OUT_OF_RANGE, format!("a cell names node {node} of {nodes}")));
        }
        if let Some(node) = self.positions.iter().position(|p| !p.is_finite()) {
            return Err((code::NOT_FINITE, format!("node {node} has a coordinate that is NaN or infinite")));
        }
        Ok(())
    }

    /// Refuses polygons of more than four nodes, for the formats that know none.
    pub fn refuse_polygons(&self, format: Format) -> Result<(), WriteError> {
        let Cells::Polygons(mesh) = self.cells else { return Ok(()) };
        match mesh.faces().position(|face| face.len() > 4) {
            None => Ok(()),
            Some(face) => Err(refuse_writing(
                format,
                code::FORMAT_HOLDS_NO_POLYGONS,
                format!(
                    "face {face} has {} nodes, and this format holds triangles and quads only — refine the \
                     mesh, which makes it all quads, or write OBJ, VTU or VTK",
                    mesh.face(face).len()
                ),
            )),
        }
    }
}
