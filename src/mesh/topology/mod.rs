//! Adjacency, boundary, components, orientation: what can be said of a surface without positions.

mod edges;
mod hex_boundary;
mod report;
mod sets;
mod uses;

pub use edges::Edges;
pub use hex_boundary::hex_boundary;
pub use report::{SurfaceReport, surface_report, two_colouring};
pub use uses::EdgeUses;

pub(crate) use report::{disagrees, edge_ids, non_manifold_nodes, used_nodes};
pub(crate) use sets::Sets;
