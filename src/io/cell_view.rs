//! What the writers see of a document: nodes, cells of any kind, and what is known of each cell.

use std::borrow::Cow;
use std::sync::LazyLock;

use super::refusal::{code, refuse_writing};
use super::tag_numbers::cell_numbers;
use super::{AnyMesh, Document, Format, WriteError};
use crate::geometry::Point;
use crate::mesh::topology::{hex_of, side_nodes};
use crate::mesh::{FaceGroups, FaceId, NodeId, PolygonMesh, SecondOrder, Tags};

/// A document that was checked: every node id is in range, every coordinate is finite, and the columns
/// have an entry a cell or none.
pub(super) struct CellView<'a> {
    /// Coordinates of the nodes.
    pub positions: Cow<'a, [Point]>,
    /// The cells.
    pub cells: Cells<'a>,
    /// Names of cells.
    pub tags: &'a Tags,
    /// Level of each cell, or empty.
    pub level: &'a [u8],
    /// Parent of each cell, or empty.
    pub parent: &'a [FaceId],
    /// Groups of faces of hexes.
    pub groups: &'a FaceGroups,
}

/// No groups, for surfaces.
static NO_GROUPS: LazyLock<FaceGroups> = LazyLock::new(FaceGroups::default);

/// The cells of a mesh.
#[derive(Clone, Copy)]
pub(super) enum Cells<'a> {
    /// Faces of any number of nodes.
    Polygons(&'a PolygonMesh),
    /// Quads.
    Quads(&'a [[NodeId; 4]]),
    /// Hexahedra.
    Hexes(&'a [[NodeId; 8]]),
    /// Hexahedra of the second order.
    SecondOrder(&'a SecondOrder),
}

/// Faces of hexes that are in groups, all with the same number of nodes.
pub(super) struct GroupedFaces {
    /// How many nodes a face has.
    pub size: usize,
    /// Those of all faces, anticlockwise seen from outside the hex that the group
    /// has them of; of the second order those on the edges and inside follow.
    pub nodes: Vec<NodeId>,
}

impl GroupedFaces {
    /// Number of faces.
    pub fn len(&self) -> usize {
        self.nodes.len() / self.size
    }

    /// The nodes of a face.
    pub fn face(&self, k: usize) -> &[NodeId] {
        &self.nodes[k * self.size..][..self.size]
    }
}

impl<'a> Cells<'a> {
    /// Number of cells.
    pub fn len(self) -> usize {
        match self {
            Self::Polygons(mesh) => mesh.face_count(),
            Self::Quads(quads) => quads.len(),
            Self::Hexes(hexes) => hexes.len(),
            Self::SecondOrder(hexes) => hexes.nodes.len() / hexes.hex.nodes(),
        }
    }

    /// The nodes of a cell.
    pub fn nodes(self, cell: usize) -> &'a [NodeId] {
        match self {
            Self::Polygons(mesh) => mesh.face(cell),
            Self::Quads(quads) => &quads[cell],
            Self::Hexes(hexes) => &hexes[cell],
            Self::SecondOrder(hexes) => hexes.nodes_of(cell),
        }
    }

    /// The nodes of all cells, cell after cell.
    pub fn corners(self) -> &'a [NodeId] {
        match self {
            Self::Polygons(mesh) => &mesh.corners,
            Self::Quads(quads) => quads.as_flattened(),
            Self::Hexes(hexes) => hexes.as_flattened(),
            Self::SecondOrder(hexes) => &hexes.nodes,
        }
    }

    /// True if the cells are hexahedra.
    pub fn are_hexes(self) -> bool {
        matches!(self, Self::Hexes(_) | Self::SecondOrder(_))
    }
}

impl<'a> CellView<'a> {
    /// The view of `document`, which must hold together.
    pub fn new(document: &'a Document, format: Format) -> Result<Self, WriteError> {
        let Document { mesh, tags, level, parent, second_order, .. } = document;
        let (cells, groups) = match (mesh, second_order) {
            (AnyMesh::Polygons(mesh), _) => (Cells::Polygons(mesh), &*NO_GROUPS),
            (AnyMesh::Quads(mesh), _) => (Cells::Quads(&mesh.quads), &*NO_GROUPS),
            (AnyMesh::Hexes(mesh), None) => (Cells::Hexes(&mesh.hexes), &mesh.groups),
            (AnyMesh::Hexes(mesh), Some(hexes)) => (Cells::SecondOrder(hexes), &mesh.groups),
        };
        let positions = match second_order {
            Some(hexes) => Cow::Owned([mesh.positions(), &hexes.positions].concat()),
            None => Cow::Borrowed(mesh.positions()),
        };
        let view = Self { positions, cells, tags, level, parent, groups };
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
        if let Some(side) = self.groups.sides().iter().find(|&&side| hex_of(side).index() >= count) {
            let message = format!("a group of faces is at hex {} of {count}", hex_of(*side));
            return Err((code::INCONSISTENT, message));
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

    /// The faces that are in groups.
    pub fn grouped_faces(&self) -> GroupedFaces {
        let sides = self.groups.sides().iter();
        match self.cells {
            Cells::Hexes(hexes) => {
                GroupedFaces { size: 4, nodes: sides.flat_map(|&side| side_nodes(hexes, side)).collect() }
            }
            Cells::SecondOrder(hexes) => GroupedFaces {
                size: hexes.hex.nodes_of_face(),
                nodes: sides.flat_map(|&side| hexes.nodes_of_side(side)).collect(),
            },
            Cells::Polygons(_) | Cells::Quads(_) => GroupedFaces { size: 4, nodes: Vec::new() },
        }
    }

    /// What is known of each cell, and after it the same of the hex of each face that is in a group.
    pub fn with_grouped_faces<'c, T: Copy>(&self, of_cells: &'c [T]) -> Cow<'c, [T]> {
        if of_cells.is_empty() || self.groups.is_empty() {
            return Cow::Borrowed(of_cells);
        }
        let of_faces = self.groups.sides().iter().map(|&side| of_cells[hex_of(side).index()]);
        Cow::Owned(of_cells.iter().copied().chain(of_faces).collect())
    }

    /// The number of the tag set of each cell, then of each face that is in a group; nothing if there are no
    /// tags. Cells and faces are numbered apart.
    pub fn numbers(&self) -> Vec<i64> {
        let mut numbers = cell_numbers(self.tags);
        if !self.groups.is_empty() {
            numbers.resize(self.cells.len(), 0);
            numbers.extend(cell_numbers(self.groups.tags()));
        }
        numbers
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
