//! Adjacency, boundary, components, orientation: what can be said of a mesh without positions.

mod bins;
mod edges;
mod face_sides;
mod hex_report;
mod hex_topology;
mod hexes;
mod links;
mod node_sets;
mod report;
mod sets;
mod uses;

pub use edges::Edges;
pub use hex_report::{HexReport, hex_report};
pub use hex_topology::HexTopology;
pub use hexes::{HexEdges, HexFaces, Side, hex_boundary, hex_of, side_nodes};
pub use report::{SurfaceReport, surface_report, two_colouring};
pub use uses::EdgeUses;

pub(crate) use bins::Bins;
pub(crate) use face_sides::FaceSides;
pub(crate) use links::Links;
pub(crate) use node_sets::{NodeSets, degrees};
pub(crate) use report::{disagrees, edge_ids, non_manifold_nodes, used_nodes};
pub(crate) use sets::Sets;

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests;
