//! Reads MEDIT meshes: one section after the other.

use super::SHARP;
use crate::geometry::Point;
use crate::io::cell_collector::{CellAttributes, CellCollector};
use crate::io::cell_kind::CellKind;
use crate::io::refusal::{code, excerpt, refuse, refuse_not_finite};
use crate::io::tag_interner::CellTags;
use crate::io::tag_numbers::Names;
use crate::io::tokens::Tokens;
use crate::io::{Document, Format, ReadError};
use crate::mesh::NodeId;

/// The mesh in a MEDIT file.
pub fn read(bytes: &[u8]) -> Result<Document, ReadError> {
    let mut file = MeditFile::open(bytes)?;
    while let Some(keyword) = file.tokens.next() {
        match keyword {
            b"End" | b"END" => break,
            b"Dimension" => file.read_dimension()?,
            b"Vertices" => file.read_vertices()?,
            b"Triangles" => file.read_cells(CellKind::Triangle, 3)?,
            b"Quadrilaterals" => file.read_cells(CellKind::Quad, 4)?,
            // The second spelling is that of the first programs.
            b"Hexahedra" | b"Hexaedra" => file.read_cells(CellKind::Hex, 8)?,
            b"QuadrilateralsQ2" => file.read_cells(CellKind::Quad9, 9)?,
            b"HexahedraQ2" => file.read_cells(CellKind::Hex27, 27)?,
            b"QuadrilateralsQ2Ordering" => file.check_order(keyword, &Q2_CORNERS[..4], 2)?,
            b"HexahedraQ2Ordering" => file.check_order(keyword, &Q2_CORNERS, 3)?,
            b"Edges" => file.read_cells(CellKind::Polyline, 2)?,
            b"Corners" => file.corners = file.read_list()?,
            b"Ridges" => file.ridges = file.read_list()?,
            _ => file.skip_section(keyword)?,
        }
    }
    file.finish()
}

/// Kinds of cells that would be lost if their section were stepped over.
const REFUSED: [(&[u8], &str); 8] = [
    (b"Tetrahedra", "tetrahedra"),
    (b"Pyramids", "pyramids"),
    (b"Prisms", "prisms"),
    (b"Pentahedra", "prisms"),
    (b"TrianglesP2", "triangles of second order"),
    (b"TetrahedraP2", "tetrahedra of second order"),
    (b"PrismsP2", "prisms of second order"),
    (b"PyramidsP2", "pyramids of second order"),
];

/// The places of the corners of a hexahedron of the second order, of which those of a quadrilateral are the first four, in
/// steps of half an edge: the first nodes unless the file says otherwise.
const Q2_CORNERS: [[i64; 3]; 8] =
    [[0, 0, 0], [2, 0, 0], [2, 2, 0], [0, 2, 0], [0, 0, 2], [2, 0, 2], [2, 2, 2], [0, 2, 2]];

struct MeditFile<'a> {
    tokens: Tokens<'a>,
    dimension: usize,
    positions: Vec<Point>,
    /// Made when the nodes are known.
    cells: Option<CellCollector>,
    references: Vec<i64>,
    edges: Vec<[i64; 2]>,
    /// Numbers of edges and of nodes, from 1.
    ridges: Vec<i64>,
    corners: Vec<i64>,
}

impl<'a> MeditFile<'a> {
    fn open(bytes: &'a [u8]) -> Result<Self, ReadError> {
        if bytes.starts_with(&[1, 0, 0, 0]) || bytes.starts_with(&[0, 0, 0, 1]) {
            let message =
                "this is a binary MEDIT file (.meshb), which is not read — save it as ASCII (.mesh)";
            return Err(refuse(Format::Medit, None, code::UNSUPPORTED_ENCODING, message));
        }
        let text = bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes);
        let mut tokens = Tokens::new(Format::Medit, text, 1, Some(b'#'));
        let first = tokens.next().unwrap_or_default();
        if first != b"MeshVersionFormatted" {
            let message = format!("the file begins with {}, not with MeshVersionFormatted", excerpt(first));
            return Err(tokens.refuse(code::NOT_THIS_FORMAT, message));
        }
        let version = tokens.integer("the version")?;
        if !(0..=4).contains(&version) {
            let message = format!("the file has version {version} of the format; 1 to 4 are read");
            return Err(tokens.refuse(code::UNSUPPORTED_VERSION, message));
        }
        Ok(Self {
            tokens,
            dimension: 3,
            positions: Vec::new(),
            cells: None,
            references: Vec::new(),
            edges: Vec::new(),
            ridges: Vec::new(),
            corners: Vec::new(),
        })
    }

    fn read_dimension(&mut self) -> Result<(), ReadError> {
        self.dimension = match self.tokens.integer("the dimension")? {
            2 => 2,
            3 => 3,
            other => {
                let message = format!("the dimension is {other}; it must be 2 or 3");
                return Err(self.tokens.refuse(code::SYNTAX, message));
            }
        };
        Ok(())
    }

    fn read_vertices(&mut self) -> Result<(), ReadError> {
        if self.cells.is_some() {
            return Err(self.tokens.refuse(code::SYNTAX, "the file has a second section of Vertices"));
        }
        let count = self.tokens.count("the number of vertices", 2 * (self.dimension + 1))?;
        self.positions.reserve_exact(count);
        for _ in 0..count {
            let mut position = [0.0; 3];
            for coordinate in &mut position[..self.dimension] {
                *coordinate = self.tokens.float("a coordinate")?;
            }
            if position.iter().any(|x| !x.is_finite()) {
                let number = self.positions.len() + 1;
                return Err(refuse_not_finite(Format::Medit, self.tokens.line(), number));
            }
            self.tokens.integer("the reference of a vertex")?;
            self.positions.push(position.into());
        }
        self.cells = Some(CellCollector::new(Format::Medit, count, 1));
        Ok(())
    }

    fn read_cells(&mut self, kind: CellKind, size: usize) -> Result<(), ReadError> {
        let count = self.tokens.count("the number of cells", 2 * (size + 1))?;
        let Some(cells) = &mut self.cells else {
            return Err(self.tokens.refuse(code::SYNTAX, "the cells come before the Vertices"));
        };
        let mut nodes = [0; 27];
        let nodes = &mut nodes[..size];
        for _ in 0..count {
            for node in &mut *nodes {
                *node = self.tokens.integer("a node of a cell")?;
            }
            cells.push(kind, nodes, self.tokens.line())?;
            self.references.push(self.tokens.integer("the reference of a cell")?);
            if let [a, b] = *nodes {
                self.edges.push([a, b]);
            }
        }
        Ok(())
    }

    fn read_list(&mut self) -> Result<Vec<i64>, ReadError> {
        let count = self.tokens.count("the number of entries", 2)?;
        (0..count).map(|_| self.tokens.integer("a number of a node or edge")).collect()
    }

    /// Reads where the nodes of cells of the second order stand in these, a place along each of their `axes`. The first nodes
    /// have to be the corners in the usual order.
    fn check_order(&mut self, keyword: &[u8], corners: &[[i64; 3]], axes: usize) -> Result<(), ReadError> {
        let count = self.tokens.count("the number of nodes of a cell", 2 * axes)?;
        let mut is_usual = count >= corners.len();
        for node in 0..count {
            for axis in 0..axes {
                let place = self.tokens.integer("the place of a node in a cell")?;
                is_usual &= corners.get(node).is_none_or(|corner| corner[axis] == place);
            }
        }
        if is_usual {
            return Ok(());
        }
        let message = format!(
            "{} gives the nodes of cells in an order that is not read — put the corners first, in the order of Hexahedra or \
             Quadrilaterals",
            excerpt(keyword)
        );
        Err(self.tokens.refuse(code::UNSUPPORTED_FEATURE, message))
    }

    /// Steps over the numbers of a section that says nothing of the mesh.
    fn skip_section(&mut self, keyword: &[u8]) -> Result<(), ReadError> {
        if !keyword[0].is_ascii_alphabetic() {
            let message = format!("{} stands where the name of a section should", excerpt(keyword));
            return Err(self.tokens.refuse(code::SYNTAX, message));
        }
        if let Some((_, name)) = REFUSED.iter().find(|(refused, _)| *refused == keyword)
            && self.tokens.peek() != Some(b"0")
        {
            let message = format!(
                "the file has {name}; only triangles and quadrilaterals of first order, and hexahedra of first and second \
                 order with their faces, are read — remove the other cells or convert them first"
            );
            return Err(self.tokens.refuse(code::UNSUPPORTED_CELL, message));
        }
        while self.tokens.peek().is_some_and(|word| !word[0].is_ascii_alphabetic()) {
            self.tokens.next();
        }
        Ok(())
    }

    fn finish(self) -> Result<Document, ReadError> {
        let refused = |message: String| refuse(Format::Medit, None, code::NODE_OUT_OF_RANGE, message);
        let mut cells = self.cells.ok_or_else(|| {
            refuse(Format::Medit, None, code::NO_CELLS, "the file has no section of Vertices")
        })?;
        let place = |number: i64| usize::try_from(number).ok().and_then(|n| n.checked_sub(1));
        let features = cells.features_mut();
        for &ridge in &self.ridges {
            let edge = place(ridge).and_then(|index| self.edges.get(index)).ok_or_else(|| {
                refused(format!("a ridge is edge {ridge}, but there are {} edges", self.edges.len()))
            })?;
            // The edges were checked with the cells.
            features.creases.push((edge.map(|node| NodeId(node as u32 - 1)), SHARP));
        }
        for &corner in &self.corners {
            let node = place(corner).filter(|&index| index < self.positions.len()).ok_or_else(|| {
                refused(format!("a corner is node {corner}, but there are {} nodes", self.positions.len()))
            })?;
            features.corners.push((NodeId::new(node), SHARP));
        }
        let tags = CellTags::from_numbers(&self.references, &Names::default(), |_| false);
        cells.finish(self.positions, CellAttributes { tags: Some(tags), ..CellAttributes::default() })
    }
}
