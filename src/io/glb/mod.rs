//! GLB: binary glTF 2.0 (<https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html>), written for pictures.
//!
//! Faces are cut into triangles, a hex mesh is shown by its boundary. Coordinates are f32 relative to
//! the centre of the mesh, which is the translation of a node in f64: a small mesh far from the
//! origin keeps its shape. The Z axis of the mesh becomes glTF's Y axis. There are no normals, for which
//! the specification demands flat shading: each face looks as flat as it is. Each tag set is a
//! primitive with a material of its own colour and named by its labels; the edges of the mesh are a
//! primitive of lines.

mod json;
mod shape;
mod write;

pub use write::{GlbOptions, write, write_with};
