//! Bytes in, bytes out. No paths, no printing.
//!
//! Every format is a module with a `read`, a `write` or both; [`read()`] and [`write()`] choose among them.
//! A reader refuses only what a [`Document`] cannot represent; what is doubtful in a mesh (repeated
//! nodes, faces of no area, nodes that no face uses) is for [`crate::mesh`]'s checks to report.

pub mod glb;
pub mod inp;
pub mod medit;
pub mod msh;
pub mod obj;
pub mod stl;
pub mod vtk;
pub mod vtu;

mod cell_collector;
mod cell_kind;
mod cell_view;
mod document;
mod error;
mod format;
pub(crate) mod losses;
mod matched_faces;
mod middle_nodes;
mod name_budget;
mod node_numbers;
mod refusal;
mod scalars;
mod sniff;
mod tag_interner;
mod tag_numbers;
mod text;
mod tokens;
mod vtk_cells;

pub use document::{AnyMesh, Document};
pub use error::{ReadError, WriteError};
pub use format::Format;
pub use losses::losses;
pub use sniff::detect;

/// Reads a mesh from the bytes of a file.
pub fn read(bytes: &[u8], format: Format) -> Result<Document, ReadError> {
    match format {
        Format::Obj => obj::read(bytes),
        Format::Stl => stl::read(bytes),
        Format::Vtu => vtu::read(bytes),
        Format::Vtk => vtk::read(bytes),
        Format::Msh => msh::read(bytes),
        Format::Inp => inp::read(bytes),
        Format::Medit => medit::read(bytes),
        Format::Glb => Err(ReadError {
            format,
            line: None,
            code: "format-not-read",
            message: "GLB files are only written: give the mesh as OBJ or another format".into(),
        }),
    }
}

/// Writes a mesh as the bytes of a file.
pub fn write(document: &Document, format: Format) -> Result<Vec<u8>, WriteError> {
    match format {
        Format::Obj => obj::write(document),
        Format::Stl => Err(WriteError {
            format,
            code: "format-not-written",
            message: "STL files are only read, they do not hold how faces hang together: write OBJ or another format"
                .into(),
        }),
        Format::Vtu => vtu::write(document),
        Format::Vtk => vtk::write(document),
        Format::Msh => msh::write(document),
        Format::Inp => inp::write(document),
        Format::Medit => medit::write(document),
        Format::Glb => glb::write(document),
    }
}
