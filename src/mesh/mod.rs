//! Meshes: ids, structure-of-arrays meshes, topology, checks, quality.

pub mod check;
mod crossing;
mod distance;
mod face_groups;
mod faces;
mod grid;
mod hash;
mod hex;
mod id;
pub mod numbering;
mod orientation;
mod polygon;
mod quad;
pub mod quality;
mod samples;
pub(crate) mod second_order;
mod tags;
pub mod topology;
mod volume;
mod weld;

pub(crate) use check::hanging_on;
pub use check::{Defect, check_hexes, check_hexes_within, check_polygons, check_quads};
pub(crate) use crossing::{crossings, meeting};
pub(crate) use distance::farthest_from_quads;
pub use distance::{Distance, Distances, distances_of_hexes};
pub use face_groups::FaceGroups;
pub use faces::Faces;
#[cfg(feature = "bindings")]
pub(crate) use grid::in_digits;
pub use grid::{GridError, GridOptions, hex_grid};
pub use hash::{MeshHash, mesh_hash, polygon_hash};
pub use hex::HexMesh;
pub(crate) use id::ids;
pub use id::{EdgeId, FaceId, HexId, NodeId};
pub use orientation::{InvertedHexes, orient_hexes};
pub use polygon::{Features, PolygonMesh};
pub use quad::QuadMesh;
pub(crate) use samples::Sampled;
pub use samples::{Quads, Triangles};
pub use second_order::{SecondOrder, SecondOrderHex};
pub use tags::{Group, TagSet, Tags};
pub(crate) use tags::{MATERIAL, OBJECT};
pub use topology::Edges;
pub use volume::{Volumes, hex_volume};
pub use weld::first_of_same;
