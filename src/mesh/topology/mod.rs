//! Adjacency, boundary, components, orientation: what can be said of a surface without positions.

mod edges;

pub use edges::Edges;
