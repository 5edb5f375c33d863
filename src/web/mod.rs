//! wasm-bindgen bindings: convert, delegate, map errors. Nothing here meshes or draws.
//!
//! Five modules are built from this crate by its features: the mesher of surfaces (`quads`) and the refinement of hexes
//! (`hexes`), each on one thread and on a pool of workers (`threads`), and the renderer (`viewer`). Hexes are a module of
//! their own, so that who meshes surfaces need not fetch it. See `scripts/build-wasm.mjs`.

#[cfg(feature = "bindings")]
mod candidates;
#[cfg(feature = "bindings")]
mod convert;
#[cfg(all(feature = "viewer", target_arch = "wasm32"))]
mod cutaway;
#[cfg(all(feature = "viewer", target_arch = "wasm32"))]
mod drawn_region;
#[cfg(feature = "bindings")]
mod errors;
#[cfg(feature = "bindings")]
mod file;
#[cfg(feature = "hexes")]
mod hex_mesh;
#[cfg(feature = "hexes")]
mod hex_refinement;
#[cfg(feature = "hexes")]
mod hexes;
#[cfg(feature = "bindings")]
mod listener;
#[cfg(feature = "bindings")]
mod memory;
#[cfg(feature = "bindings")]
mod pool;
#[cfg(feature = "quads")]
mod quads;
#[cfg(feature = "quads")]
mod refinement;
#[cfg(feature = "quads")]
mod surface;
#[cfg(all(feature = "viewer", target_arch = "wasm32"))]
mod viewer;
