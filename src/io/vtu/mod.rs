//! VTU: unstructured grids in VTK's XML format
//! (<https://docs.vtk.org/en/latest/vtk_file_formats/vtkxml_file_format.html>).
//!
//! Written: appended raw data, compressed with zlib in blocks, 64-bit headers, which VTK, ParaView and
//! meshio read. Cell data `Level`, `Parent` and `Tag`; the names behind the tags' numbers stand in the
//! field data `TagNames` as bytes of JSON (meshio refuses files with string arrays).
//! Polylines and sharp edges of a surface are not written.
//!
//! Read: ASCII, base64 and appended data (raw and base64), uncompressed and zlib, both byte orders and
//! header types, all scalar types, several pieces.

mod array;
mod base64_stream;
mod read;
mod write;
mod xml;

pub use read::read;
pub use write::write;

/// Field data array: the names behind the numbers of `Tag`.
const TAG_NAMES: &str = "TagNames";
