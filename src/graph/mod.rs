//! Algorithms on graphs that know no mesh.
//!
//! * [`FlowNetwork`]: the minimum cut that separates a source from a sink.
//! * [`ShortestPaths`]: cheapest paths.
//! * [`cheapest_assignment`]: each of some rows gets a column of its own.

mod assignment;
mod max_flow;
mod network;
mod shortest_path;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests;

pub use assignment::{Choice, cheapest_assignment};
pub use network::{FlowNetwork, MinimumCut};
pub use shortest_path::{CheapestPath, ShortestPaths};
