//! The kinds of cells that files hold, and how each format names them.

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
}

impl CellKind {
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
            6 => return Err("triangle strip"),
            10 => return Err("tetrahedron"),
            13 => return Err("wedge"),
            14 => return Err("pyramid"),
            15 | 16 => return Err("prism"),
            21..=37 => return Err("cell of second order"),
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
            15 => (Self::Skipped, 1),
            4 => return Err("tetrahedron"),
            6 => return Err("prism"),
            7 => return Err("pyramid"),
            8..=14 | 16..=140 => return Err("element of second order or higher"),
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
        let in_family = |families: &[&str], nodes: char| {
            families.iter().any(|family| {
                let rest = name.strip_prefix(family).and_then(|rest| rest.strip_prefix(nodes));
                rest.is_some_and(|rest| !rest.starts_with(|c: char| c.is_ascii_digit()))
            })
        };
        if in_family(&FACES, '4') {
            Ok(Self::Quad)
        } else if in_family(&FACES, '3') {
            Ok(Self::Triangle)
        } else if in_family(&SOLIDS, '8') {
            Ok(Self::Hex)
        } else if NO_FACES.iter().any(|family| name.starts_with(family)) {
            Ok(Self::Skipped)
        } else if in_family(&SOLIDS, '4') {
            Err("tetrahedron")
        } else if in_family(&SOLIDS, '6') {
            Err("wedge")
        } else if in_family(&SOLIDS, '5') {
            Err("pyramid")
        } else if in_family(&FACES, '6') || in_family(&FACES, '8') || name.starts_with("C3D") {
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
pub(super) const ONLY_THESE_CELLS: &str = "only triangles, quads, polygons and hexahedra of first order are \
     read; remove the other cells or convert them first";
