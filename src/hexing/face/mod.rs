//! The principal face (the paper's §4.1.2): quads in a plane, along curves.
//!
//! [`quad_region`] meshes any planar region with quads alone; its stages are one file each; [`quad_planar_faces`]
//! takes the region from the polygons and polylines of a file, [`principal_face`] from what a solid covers along a
//! direction.

mod cells;
mod course;
mod cover;
mod embed;
mod field;
mod graph;
mod mesher;
mod pack;
mod pair;
mod planar;
mod principal;
mod project;
mod region;
mod relax;
mod sample;
mod scale;
mod shadow;
mod smooth;
mod strips;
mod tidy;
mod triangulation;

pub use mesher::FaceError;
pub use planar::{PlanarQuads, quad_planar_faces};
pub use principal::{PrincipalFace, principal_face};
pub use region::{Region, RegionMesh, RegionOptions, quad_region};

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests;
