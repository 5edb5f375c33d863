//! wasm-bindgen bindings: convert, delegate, map errors. Nothing here meshes or draws.
//!
//! Three modules are built from this crate, each by a feature: the mesher on one thread (`mesher`), the mesher on
//! a pool of workers (`threads`) and the renderer (`viewer`). See `scripts/build-wasm.mjs`.

#[cfg(all(feature = "viewer", target_arch = "wasm32"))]
mod cutaway;
#[cfg(all(feature = "viewer", target_arch = "wasm32"))]
mod drawn_region;
#[cfg(feature = "mesher")]
mod errors;
#[cfg(feature = "mesher")]
mod listener;
#[cfg(feature = "mesher")]
mod memory;
#[cfg(feature = "mesher")]
mod pool;
#[cfg(feature = "mesher")]
mod quads;
#[cfg(feature = "mesher")]
mod refinement;
#[cfg(feature = "mesher")]
mod surface;
#[cfg(all(feature = "viewer", target_arch = "wasm32"))]
mod viewer;
