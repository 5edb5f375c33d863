//! Abaqus input decks, as CalculiX, Gmsh, PrePoMax and others exchange them too.
//!
//! Written: `*NODE`; `*ELEMENT` of type `S4` and `S3` for faces (general-purpose shells, which need not be
//! plane and which every reader knows as quads and triangles; change the type to `CPS4`, `CPE4` or
//! `CAX4` for a plane or axisymmetric model) and `C3D8` for hexahedra; an `*ELSET` for each label of a
//! tag set and for its number (`TAG_4`), sixteen elements a line; a `*SURFACE` for each of groups of faces. Coordinates have at most 20
//! characters, which is all that Abaqus and CalculiX read: where the shortest exact decimal is longer,
//! the last of its digits are rounded off. Names keep letters, digits, `_` and `-`; anything else becomes `_`.
//! Polygons of more than four nodes are refused; polylines and sharp edges are not written.
//!
//! Read: `*NODE`, `*ELEMENT` (shells, membranes, plane, axisymmetric, rigid and surface elements of three and four
//! nodes, solids of eight; the corners of solids of 20 and 27 nodes and of faces of 8 and 9 beside them; in any integration), `*ELSET` with `GENERATE` and by name, `*SURFACE` of faces of solids,
//! parts and their
//! instances with translation and rotation. Keywords that say nothing of the mesh are stepped over;
//! those that make nodes or elements, or read other files, are refused. Faces `S1` to `S6` of hexahedra are those of
//! `numbering::hex::FACES`, in that order (Abaqus, "Three-dimensional solid element library").

mod assembly;
mod lines;
mod part;
mod read;
mod surfaces;
mod write;

pub use read::read;
pub use write::write;

/// What the label of an element set begins with that stands for a tag's number, its object, its material.
const NUMBER: &str = "TAG_";
const OBJECT: &str = "OBJECT_";
const MATERIAL: &str = "MATERIAL_";
