//! All-hex meshes of solids, from the surface to the mesh.

mod cancel;
mod csg;
mod forecast;
mod gates;
mod motions;
mod parts;
mod second_order;
mod shells;

use crate::hexes::meshes;
