//! The kinds of cells that files hold, and how each format names them.

use std::ops::RangeInclusive;

/// A kind of cell that is read. All other kinds are refused by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(super) enum CellKind {
    /// A point or several, or nothing: skipped.
    Skipped,
    /// A polyline of two nodes or more.
    Polyline,
    /// Three nodes.
    Triangle,
    /// Four nodes, in order around it.
    Quad,
    /// Four nodes, row by row (VTK_PIXEL).
    Pixel,
    /// Three nodes or more, in order around it.
    Polygon,
    /// Eight nodes, as VTK_HEXAHEDRON.
    Hex,
    /// Eight nodes, row by row (VTK_VOXEL).
    Voxel,
    /// The ends and a node between them.
    Edge3,
    /// The corners of a quad and a node on each edge.
    Quad8,
    /// As `Quad8`, and a node inside.
    Quad9,
    /// The corners of a hexahedron and a node on each edge.
    Hex20,
    /// As `Hex20`, and a node on each face and inside.
    Hex27,
    /// As `Hex20`, a node inside, and on any of the faces another.
    Hex21To27,
}

impl CellKind {
    /// How many nodes a cell of this kind has: the least number and the greatest.
    pub fn size(self) -> RangeInclusive<usize> {
        match self {
            Self::Skipped => 0..=usize::MAX,
            Self::Polyline => 2..=usize::MAX,
            Self::Triangle | Self::Edge3 => 3..=3,
            Self::Quad | Self::Pixel => 4..=4,
            Self::Polygon => 3..=usize::MAX,
            Self::Hex | Self::Voxel | Self::Quad8 => 8..=8,
            Self::Quad9 => 9..=9,
            Self::Hex20 => 20..=20,
            Self::Hex27 => 27..=27,
            Self::Hex21To27 => 21..=27,
        }
    }

    /// Of a kind of the second order that of its corners, which are the first of its nodes, and how many they are.
    pub fn corners(self) -> Option<(Self, usize)> {
        match self {
            Self::Edge3 => Some((Self::Polyline, 2)),
            Self::Quad8 | Self::Quad9 => Some((Self::Quad, 4)),
            Self::Hex20 | Self::Hex27 | Self::Hex21To27 => Some((Self::Hex, 8)),
            _ => None,
        }
    }

    /// True of hexahedra.
    pub fn is_hex(self) -> bool {
        matches!(self, Self::Hex | Self::Voxel | Self::Hex20 | Self::Hex27 | Self::Hex21To27)
    }

    /// The kind of VTK's cell type `number`, or the name of a kind that is not read.
    pub fn from_vtk(number: i64) -> Result<Self, &'static str> {
        Ok(match number {
            0..=2 => Self::Skipped,
            3 | 4 => Self::Polyline,
            5 => Self::Triangle,
            7 => Self::Polygon,
            8 => Self::Pixel,
            9 => Self::Quad,
            11 => Self::Voxel,
            12 => Self::Hex,
            21 => Self::Edge3,
            23 => Self::Quad8,
            25 => Self::Hex20,
            28 => Self::Quad9,
            29 => Self::Hex27,
            6 => return Err("triangle strip"),
            10 => return Err("tetrahedron"),
            13 => return Err("wedge"),
            14 => return Err("pyramid"),
            15 | 16 => return Err("prism"),
            22..=37 => return Err("cell of second order"),
            42 => return Err("polyhedron"),
            60..=81 => return Err("cell of higher order"),
            _ => return Err("cell of an unknown kind"),
        })
    }

    /// The kind of Gmsh's element type `number` with its number of nodes, or the name of a kind that is
    /// not read.
    pub fn from_gmsh(number: i64) -> Result<(Self, u8), &'static str> {
        Ok(match number {
            1 => (Self::Polyline, 2),
            2 => (Self::Triangle, 3),
            3 => (Self::Quad, 4),
            5 => (Self::Hex, 8),
            8 => (Self::Edge3, 3),
            10 => (Self::Quad9, 9),
            12 => (Self::Hex27, 27),
            15 => (Self::Skipped, 1),
            16 => (Self::Quad8, 8),
            17 => (Self::Hex20, 20),
            4 => return Err("tetrahedron"),
            6 => return Err("prism"),
            7 => return Err("pyramid"),
            9..=140 => return Err("element of second order or higher"),
            _ => return Err("element of an unknown type"),
        })
    }

    /// The kind of Abaqus' element type `name` (in capitals), or the name of a kind that is not read.
    ///
    /// Shells, membranes, plane and axisymmetric continuum elements, rigid and surface elements are
    /// faces; `R`, `I`, `H`, `T`, `P` and the like after the number of nodes say how an element is
    /// integrated and leave its shape alone. Beams, trusses, springs and masses are skipped.
    pub fn from_abaqus(name: &str) -> Result<Self, &'static str> {
        // The letters before the number of nodes: the family of elements.
        const FACES: [&str; 16] = [
            "S", "DS", "STRI", "M3D", "SFM3D", "CPS", "CPE", "CPEG", "CAX", "CGAX", "R3D", "DC2D", "DCAX",
            "AC2D", "ACAX", "F3D",
        ];
        const SOLIDS: [&str; 6] = ["C3D", "DC3D", "AC3D", "DCC3D", "SC", "CSS"];
        const NO_FACES: [&str; 16] = [
            "T2D", "T3D", "B2", "B3", "PIPE", "ELBOW", "SAX", "R2D", "RAX", "RB", "MASS", "ROTARYI",
            "SPRING", "DASHPOT", "CONN", "GAP",
        ];
        let in_family = |families: &[&str], nodes: &str| {
            families.iter().any(|family| {
                let rest = name.strip_prefix(family).and_then(|rest| rest.strip_prefix(nodes));
                rest.is_some_and(|rest| !rest.starts_with(|c: char| c.is_ascii_digit()))
            })
        };
        if in_family(&FACES, "4") {
            Ok(Self::Quad)
        } else if in_family(&FACES, "3") {
            Ok(Self::Triangle)
        } else if in_family(&SOLIDS, "8") {
            Ok(Self::Hex)
        } else if in_family(&FACES, "8") {
            Ok(Self::Quad8)
        } else if in_family(&FACES, "9") {
            Ok(Self::Quad9)
        } else if in_family(&SOLIDS, "20") {
            Ok(Self::Hex20)
        } else if in_family(&SOLIDS, "27") {
            Ok(Self::Hex21To27)
        } else if NO_FACES.iter().any(|family| name.starts_with(family)) {
            Ok(Self::Skipped)
        } else if in_family(&SOLIDS, "4") {
            Err("tetrahedron")
        } else if in_family(&SOLIDS, "6") {
            Err("wedge")
        } else if in_family(&SOLIDS, "5") {
            Err("pyramid")
        } else if in_family(&FACES, "6") || name.starts_with("C3D") {
            Err("element of second order")
        } else {
            Err("element of an unknown type")
        }
    }
}

/// A kind of cell with its article.
pub(super) fn with_article(name: &str) -> String {
    let article = if name.starts_with('e') { "an" } else { "a" };
    format!("{article} {name}")
}

/// What to do about a cell that is not read.
pub(super) const ONLY_THESE_CELLS: &str = "only triangles, quads and polygons of first order, and hexahedra of \
     first and second order with their faces and edges, are read; remove the other cells or convert them first";
