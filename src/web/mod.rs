//! wasm-bindgen bindings: convert, delegate, map errors. Nothing here meshes or draws.
//!
//! Seven modules are built from this crate by its features: the mesher of surfaces (`quads`), the refinement of hexes
//! (`hexes`) and the mesher of solids (`solids`), each on one thread and on a pool of workers (`threads`), and the renderer
//! (`viewer`). Hexes and solids are modules of their own, so that who meshes surfaces need not fetch them. See
//! `scripts/build-wasm.mjs`.

#[cfg(any(feature = "quads", feature = "hexes"))]
mod candidates;
#[cfg(feature = "bindings")]
mod convert;
#[cfg(all(feature = "viewer", target_arch = "wasm32"))]
mod cutaway;
#[cfg(all(feature = "viewer", target_arch = "wasm32"))]
mod drawn_features;
#[cfg(all(feature = "viewer", target_arch = "wasm32"))]
mod drawn_region;
#[cfg(feature = "bindings")]
mod errors;
#[cfg(feature = "bindings")]
mod file;
#[cfg(any(feature = "hexes", feature = "solids"))]
mod hex_arrays;
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
#[cfg(feature = "solids")]
mod solid_plan;
#[cfg(feature = "solids")]
mod solids;
#[cfg(any(feature = "quads", feature = "solids"))]
mod surface;
#[cfg(all(feature = "viewer", target_arch = "wasm32"))]
mod viewer;
