//! Bindings for the browser: convert, delegate, map errors.

#[cfg(all(feature = "viewer", target_arch = "wasm32"))]
mod viewer;
