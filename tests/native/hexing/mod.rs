//! All-hex meshes of solids, from the surface to the mesh.

mod csg;
mod parts;

use crate::hexes::meshes;
