//! Algorithms on graphs that know no mesh.
//!
//! [`FlowNetwork`]: the minimum cut that separates a source from a sink.

mod max_flow;
mod network;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests;

pub use network::{FlowNetwork, MinimumCut};
