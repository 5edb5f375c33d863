//! From the cells of a file, of mixed kinds and in any order, to one mesh.
//!
//! A file with hexahedra is a hex mesh: its faces with tags are groups of faces, and its lines are left out. A
//! file without is a surface, whose lines become [`Features::polylines`]. Of hexahedra of the second order, and their faces
//! and edges, the corners are kept; surfaces of the second order are refused.

use super::cell_kind::{CellKind, ONLY_THESE_CELLS, with_article};
use super::matched_faces::match_faces;
use super::middle_nodes::MiddleNodes;
use super::refusal::{code, refuse, refuse_not_finite};
use super::tag_interner::CellTags;
use super::{Document, Format, ReadError};
use crate::geometry::Point;
use crate::mesh::topology::Side;
use crate::mesh::{FaceGroups, FaceId, Features, HexMesh, NodeId, PolygonMesh};

/// The cells of a file, checked one by one.
pub(super) struct CellCollector {
    format: Format,
    node_count: usize,
    /// The number of the first node in the file: cells come with the file's numbers.
    first_node: i64,
    /// Number of cells so far, of any kind.
    seen: u32,
    offsets: Vec<u32>,
    corners: Vec<NodeId>,
    hexes: Vec<[NodeId; 8]>,
    /// For each face and each hex, which cell of the file it is.
    face_source: Vec<u32>,
    hex_source: Vec<u32>,
    features: Features,
    /// Nodes beside the corners.
    middle: MiddleNodes,
    /// Hexes of the second order so far.
    linearized: usize,
    /// The error about the first face or line of the second order: without hexes it is one.
    refused_face: Option<ReadError>,
    /// Faces of hexes that the file names and does not have.
    dropped_faces: usize,
    /// Cells that the file hides.
    hidden: usize,
    /// Names that hexes have no place for.
    dropped_groups: Vec<String>,
}

/// What a file says of its cells: nothing, or one entry for each cell of any kind, in the file's order.
#[derive(Default)]
pub(super) struct CellAttributes {
    /// The tags.
    pub tags: Option<CellTags>,
    /// Refinement levels.
    pub level: Option<Vec<i64>>,
    /// Cells of the input that the cells are part of.
    pub parent: Option<Vec<i64>>,
}

impl CellCollector {
    /// A collector of cells over `node_count` nodes, which the file numbers from `first_node`.
    pub fn new(format: Format, node_count: usize, first_node: i64) -> Self {
        Self {
            format,
            node_count,
            first_node,
            seen: 0,
            offsets: vec![0],
            corners: Vec::new(),
            hexes: Vec::new(),
            face_source: Vec::new(),
            hex_source: Vec::new(),
            features: Features::default(),
            middle: MiddleNodes::default(),
            linearized: 0,
            refused_face: None,
            dropped_faces: 0,
            hidden: 0,
            dropped_groups: Vec::new(),
        }
    }

    /// Adds a cell with nodes in the file's numbers. `line` is where it stands, for errors.
    pub fn push(&mut self, kind: CellKind, nodes: &[i64], line: Option<u64>) -> Result<(), ReadError> {
        let size = kind.size();
        if !size.contains(&nodes.len()) {
            let message = format!(
                "cell {} (counted from 0) of kind {kind:?} has {} nodes; it needs {}",
                self.seen,
                nodes.len(),
                size.start()
            );
            return Err(refuse(self.format, line, code::CELL_SIZE, message));
        }
        let (kind, nodes) = match kind.corners() {
            Some((linear, count)) => {
                self.leave_middle(kind, &nodes[count..], line)?;
                (linear, &nodes[..count])
            }
            None => (kind, nodes),
        };
        match kind {
            CellKind::Polyline => {
                let line = nodes.iter().map(|&n| self.node(n, line)).collect::<Result<_, _>>()?;
                self.features.polylines.push(line);
            }
            CellKind::Triangle | CellKind::Quad | CellKind::Polygon => self.push_face(nodes, line)?,
            CellKind::Pixel => self.push_face(&[0, 1, 3, 2].map(|i| nodes[i]), line)?,
            CellKind::Hex => self.push_hex(nodes, line)?,
            CellKind::Voxel => self.push_hex(&[0, 1, 3, 2, 4, 5, 7, 6].map(|i| nodes[i]), line)?,
            // Those of the second order were taken for those of their corners.
            _ => {}
        }
        self.seen = self.seen.checked_add(1).ok_or_else(|| self.too_large())?;
        Ok(())
    }

    /// Counts faces that the file names and does not have.
    pub fn drop_faces(&mut self, count: usize) {
        self.dropped_faces += count;
    }

    /// Counts cells that the file hides. They come as skipped ones.
    pub fn hide(&mut self, count: usize) {
        self.hidden += count;
    }

    /// Names groups that a file of hexes has and that are left out.
    pub fn drop_groups(&mut self, names: impl IntoIterator<Item = String>) {
        self.dropped_groups.extend(names);
    }

    /// The error about a cell that is not read; `named` says what it is.
    pub fn refuse_cell(&self, named: &str, line: Option<u64>) -> ReadError {
        let message =
            format!("cell {} (counted from 0) is {}; {ONLY_THESE_CELLS}", self.seen, with_article(named));
        refuse(self.format, line, code::UNSUPPORTED_CELL, message)
    }

    /// Sharp edges and corners that the file gives to the surface.
    pub fn features_mut(&mut self) -> &mut Features {
        &mut self.features
    }

    /// Notes the nodes beside the corners of a cell of the second order.
    fn leave_middle(&mut self, kind: CellKind, nodes: &[i64], line: Option<u64>) -> Result<(), ReadError> {
        if kind.is_hex() {
            self.linearized += 1;
        } else if self.refused_face.is_none() {
            let named = if kind == CellKind::Edge3 { "line" } else { "quad" };
            self.refused_face = Some(self.refuse_cell(&format!("{named} of second order"), line));
        }
        for &node in nodes {
            let node = self.node(node, line)?;
            self.middle.note(node, self.node_count);
        }
        Ok(())
    }

    fn push_face(&mut self, nodes: &[i64], line: Option<u64>) -> Result<(), ReadError> {
        for &node in nodes {
            let node = self.node(node, line)?;
            self.corners.push(node);
        }
        self.offsets.push(u32::try_from(self.corners.len()).map_err(|_| self.too_large())?);
        self.face_source.push(self.seen);
        Ok(())
    }

    fn push_hex(&mut self, nodes: &[i64], line: Option<u64>) -> Result<(), ReadError> {
        let mut hex = [NodeId(0); 8];
        for (corner, &node) in hex.iter_mut().zip(nodes) {
            *corner = self.node(node, line)?;
        }
        self.hexes.push(hex);
        self.hex_source.push(self.seen);
        Ok(())
    }

    fn node(&self, number: i64, line: Option<u64>) -> Result<NodeId, ReadError> {
        let index = number.checked_sub(self.first_node).and_then(|n| u32::try_from(n).ok());
        index.filter(|&n| (n as usize) < self.node_count).map(NodeId).ok_or_else(|| {
            let last = self.first_node + self.node_count as i64 - 1;
            let message = if self.node_count == 0 {
                format!("cell {} (counted from 0) names node {number}, but the file has no nodes", self.seen)
            } else {
                format!(
                    "cell {} (counted from 0) names node {number}, but the nodes are numbered {} to {last} — correct the number \
                     or add the node",
                    self.seen, self.first_node
                )
            };
            refuse(self.format, line, code::NODE_OUT_OF_RANGE, message)
        })
    }

    fn too_large(&self) -> ReadError {
        let message = "the mesh has more than 2^32 cells or corners; split it";
        refuse(self.format, None, code::TOO_LARGE, message)
    }

    /// The mesh over `positions`, with what the file says of its cells.
    pub fn finish(
        mut self,
        positions: Vec<Point>,
        attributes: CellAttributes,
    ) -> Result<Document, ReadError> {
        if let Some(node) = positions.iter().position(|p| !p.is_finite()) {
            return Err(refuse_not_finite(self.format, None, node as i64 + self.first_node));
        }
        let hexes = !self.hexes.is_empty();
        let source = if hexes { &self.hex_source } else { &self.face_source };
        if source.is_empty() {
            let message = if self.hidden == 0 {
                "the file holds neither faces nor hexahedra — there is nothing to refine"
            } else {
                "all faces and hexahedra of the file are hidden or of another piece (vtkGhostType) — there is nothing to refine"
            };
            return Err(refuse(self.format, None, code::NO_CELLS, message));
        }
        let mut cell_tags = attributes.tags.unwrap_or_default();
        if let Some(error) = self.refused_face.take_if(|_| !hexes) {
            return Err(error);
        }
        let tags = cell_tags.of_cells(source);
        let level = pick(attributes.level, source, |v| u8::try_from(v).ok());
        let parent = pick(attributes.parent, source, |v| u32::try_from(v).ok().map(FaceId));
        let hidden = self.hidden;
        if !hexes {
            let Self { offsets, corners, features, .. } = self;
            let mesh = PolygonMesh { positions, offsets, corners, features, ..PolygonMesh::default() };
            return Ok(Document { tags, level, parent, hidden, ..Document::from(mesh) });
        }
        let (groups, others) = self.groups(&mut cell_tags)?;
        let dropped_faces = others.len() + self.dropped_faces;
        let mut dropped_groups = cell_tags.names_of(&others);
        dropped_groups.extend(self.dropped_groups);
        let Self { middle, linearized, mut hexes, .. } = self;
        let positions = middle.leave_out(positions, &mut hexes);
        let mesh = HexMesh { positions, hexes, groups, ..HexMesh::default() };
        let document = Document::from(mesh);
        Ok(Document { tags, level, parent, linearized, hidden, dropped_faces, dropped_groups, ..document })
    }

    /// The groups of faces, and the cells that are faces and none of the hexes'.
    fn groups(&self, tags: &mut CellTags) -> Result<(FaceGroups, Vec<u32>), ReadError> {
        if Side::try_from(6 * self.hexes.len()).is_err() {
            return Err(self.too_large());
        }
        let face = |ends: &[u32]| &self.corners[ends[0] as usize..ends[1] as usize];
        let faces = self.offsets.windows(2).map(face).zip(self.face_source.iter().copied());
        let matched = match_faces(&self.hexes, self.node_count, faces);
        Ok((tags.of_sides(&matched.sides, self.format)?, matched.others))
    }
}

/// The entries of the cells in `source`; nothing if one does not fit: then another program's data
/// happen to have the same name.
fn pick<T>(column: Option<Vec<i64>>, source: &[u32], fit: fn(i64) -> Option<T>) -> Vec<T> {
    let Some(column) = column else { return Vec::new() };
    let fitted: Option<Vec<T>> =
        source.iter().map(|&cell| column.get(cell as usize).and_then(|&v| fit(v))).collect();
    fitted.unwrap_or_default()
}
