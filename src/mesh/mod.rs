//! Meshes: ids, structure-of-arrays meshes, topology, checks, quality.

pub mod check;
mod faces;
mod hash;
mod hex;
mod id;
pub mod numbering;
mod polygon;
mod quad;
pub mod quality;
mod tags;
pub mod topology;

pub use check::{Defect, check_polygons, check_quads};
pub use faces::Faces;
pub use hash::{MeshHash, mesh_hash, polygon_hash};
pub use hex::HexMesh;
pub use id::{EdgeId, FaceId, HexId, NodeId};
pub use polygon::{Features, PolygonMesh};
pub use quad::QuadMesh;
pub use tags::{TagSet, Tags};
pub use topology::Edges;
