//! Meshes: ids, structure-of-arrays meshes, topology, checks, quality.

pub mod check;
mod faces;
mod hex;
mod id;
mod polygon;
mod quad;
mod tags;
pub mod topology;

pub use check::{Defect, check_polygons, check_quads};
pub use faces::Faces;
pub use hex::HexMesh;
pub use id::{EdgeId, FaceId, HexId, NodeId};
pub use polygon::{Features, PolygonMesh};
pub use quad::QuadMesh;
pub use tags::{TagSet, Tags};
pub use topology::Edges;
