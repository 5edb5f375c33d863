//! The formats by name.

/// A file format.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Format {
    /// Wavefront OBJ.
    Obj,
    /// STL, ASCII or binary (read only).
    Stl,
    /// VTK XML unstructured grid.
    Vtu,
    /// Legacy VTK.
    Vtk,
    /// Gmsh.
    Msh,
    /// Abaqus input deck.
    Inp,
    /// MEDIT `.mesh`.
    Medit,
    /// Binary glTF (write only).
    Glb,
}

impl Format {
    /// Every format.
    pub const ALL: [Self; 8] =
        [Self::Obj, Self::Stl, Self::Vtu, Self::Vtk, Self::Msh, Self::Inp, Self::Medit, Self::Glb];

    /// The name that front ends use, which is also the usual file extension.
    pub fn name(self) -> &'static str {
        match self {
            Self::Obj => "obj",
            Self::Stl => "stl",
            Self::Vtu => "vtu",
            Self::Vtk => "vtk",
            Self::Msh => "msh",
            Self::Inp => "inp",
            Self::Medit => "mesh",
            Self::Glb => "glb",
        }
    }

    /// Are files of this format read?
    pub fn is_read(self) -> bool {
        self != Self::Glb
    }

    /// Are files of this format written?
    pub fn is_written(self) -> bool {
        self != Self::Stl
    }

    /// Are hexes written in this format? GLB gets their boundary.
    pub fn takes_hexes(self) -> bool {
        self.is_written() && self != Self::Obj
    }

    /// Are hexes of the second order written in this format? They are read as linear ones.
    pub fn takes_second_order(self) -> bool {
        matches!(self, Self::Vtu | Self::Vtk | Self::Msh | Self::Inp)
    }

    /// The format of a file extension, in any case, without the dot. `medit` is taken for `mesh`.
    pub fn from_extension(extension: &str) -> Option<Self> {
        let lower = extension.to_ascii_lowercase();
        if lower == "medit" {
            return Some(Self::Medit);
        }
        Self::ALL.into_iter().find(|f| f.name() == lower)
    }
}

impl std::fmt::Display for Format {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.name())
    }
}
