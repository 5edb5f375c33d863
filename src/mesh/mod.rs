//! Meshes: ids, structure-of-arrays meshes, topology, checks, quality.

mod faces;
mod hex;
mod id;
mod polygon;
mod quad;
mod tags;
pub mod topology;

pub use faces::Faces;
pub use hex::HexMesh;
pub use id::{EdgeId, FaceId, HexId, NodeId};
pub use polygon::{Features, PolygonMesh};
pub use quad::QuadMesh;
pub use tags::{TagSet, Tags};
pub use topology::Edges;
