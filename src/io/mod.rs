//! Bytes in, bytes out. No paths, no printing.

pub mod glb;
pub mod inp;
pub mod medit;
pub mod msh;
pub mod obj;
pub mod vtk;
pub mod vtu;

mod cell_collector;
mod cell_kind;
mod cell_view;
mod document;
mod error;
mod format;
mod node_numbers;
mod refusal;
mod scalars;
mod tag_interner;
mod tag_numbers;
mod text;
mod tokens;
mod vtk_cells;

pub use document::{AnyMesh, Document};
pub use error::{ReadError, WriteError};
pub use format::Format;
