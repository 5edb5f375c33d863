//! Legacy VTK (<https://docs.vtk.org/en/latest/vtk_file_formats/vtk_legacy_file_format.html>).
//!
//! Written: version 3.0, ASCII (the one form that VTK, ParaView, meshio and Gmsh all read: Gmsh 4.15.2 cannot
//! load its own binary files; VTU is the compact one), an unstructured grid with the cell scalars
//! `Level`, `Parent` and `Tag`, coordinates as the shortest decimals that read back alike. The format has no room for the names behind the tags'
//! numbers that meshio would accept; VTU keeps them. Polylines and sharp edges are not written.
//!
//! Read: versions 1 to 5.1, ASCII and binary, unstructured grids, polygonal data and structured datasets
//! (points, rectilinear grids, grids; quads where a dimension is 1); cell scalars and fields. Other attributes are stepped over.

mod attributes;
mod cells;
mod file;
mod read;
mod structured;
mod write;

pub use read::read;
pub use write::write;
