//! One binary of native integration tests: a module a subject.
#![cfg(not(target_arch = "wasm32"))]

mod cli;
mod formats;
mod hashes;
mod hexes;
mod hexing;
mod obj;
mod optimize;
mod refine;
mod scene;
mod sizing;
mod solid;
#[path = "../fixtures/valid.rs"]
mod valid;
