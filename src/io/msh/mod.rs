//! Gmsh's MSH (<https://gmsh.info/doc/texinfo/gmsh.html#MSH-file-format>).
//!
//! Written: version 4.1, ASCII, the form that the most programs read beside Gmsh (deal.II among them). Each tag
//! set is an entity of its own, in a physical group for each of its labels, so that Gmsh shows the groups and the file reads
//! back with the same names and numbers. Numbers that are not from 1 to 2^31 - 1 or of two names are others. Elements keep
//! their numbers. Polygons of more than four nodes have no place in the format and are refused;
//! polylines and sharp edges are not written.
//!
//! Read: versions 2.0 to 2.2 and 4.1, ASCII and binary of either byte order. Elements are put in the
//! order of their numbers, physical groups become tags; an element of version 2 that comes once for each of its groups is
//! one cell in all of them; sections that say nothing of the mesh are
//! stepped over.

mod elements;
mod file;
mod groups;
mod nodes;
mod read;
mod write;

pub use read::read;
pub(super) use write::renumbered;
pub use write::write;

/// The label of elements that have no tags in a mesh where others have: Gmsh keeps only elements in
/// physical groups once there is one, and meshio wants all elements in one or none.
const UNTAGGED: &str = "untagged";
