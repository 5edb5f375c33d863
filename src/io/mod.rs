//! Bytes in, bytes out. No paths, no printing.

pub mod glb;
pub mod inp;
pub mod medit;
pub mod msh;
pub mod obj;
pub mod vtk;
pub mod vtu;

mod document;
mod error;
mod format;

pub use document::{AnyMesh, Document};
pub use error::{ReadError, WriteError};
pub use format::Format;
