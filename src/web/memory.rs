//! What the module's memory can hold, held against a mesh before the work.
//!
//! WebAssembly's memory ends where its address space does: at the 2 GiB of shared memory that every browser gives.
//! An allocation beyond kills the instance, so meshes that would lead there are refused by their estimate.

use wasm_bindgen::prelude::JsValue;

use super::errors::Failure;
use crate::refine::{Estimate, QuadOptions, RefineError};

/// Memory for a mesh and the work on it, in bytes: 2 GiB less code, stacks, surfaces, and gaps between blocks.
const MESH_MEMORY: u64 = 1_650_000_000;

/// The most quads that [`MESH_MEMORY`] holds the work on. `www/lib/options.ts` has the same number.
const MOST_QUADS: u64 = MESH_MEMORY / Estimate::BYTES_PER_QUAD;

/// Options whose limit of quads is one that memory can hold.
pub struct Affordable {
    /// The options.
    pub options: QuadOptions,
    /// The limit is that of memory, not a lower one of the caller's.
    is_memory_s: bool,
}

impl Affordable {
    /// Reads options.
    ///
    /// # Errors
    /// If they are none.
    pub fn read(options: JsValue) -> Result<Self, Failure> {
        let options: QuadOptions = serde_wasm_bindgen::from_value(options)?;
        // Limits out of range stay, to be refused with the other options.
        let is_memory_s = (MOST_QUADS..=QuadOptions::MOST_QUADS).contains(&options.max_quads);
        let max_quads = if is_memory_s { MOST_QUADS } else { options.max_quads };
        Ok(Self { options: QuadOptions { max_quads, ..options }, is_memory_s })
    }

    /// What to tell of an error of the work with these options.
    pub fn failure(&self, error: RefineError) -> Failure {
        match error {
            RefineError::TooManyQuads { quads, .. } if self.is_memory_s => {
                let gigabytes = |quads: u64| quads as f64 * Estimate::BYTES_PER_QUAD as f64 / 1e9;
                let message = format!(
                    "the mesh would have about {quads} quads and take {:.1} GB, more than the {:.1} GB that \
                     WebAssembly has for it, which hold {MOST_QUADS} quads: give a larger edge length, fewer \
                     levels or smaller regions, or use the command line, which has all memory",
                    gigabytes(quads),
                    gigabytes(MOST_QUADS),
                );
                Failure::limit("memory-exceeded", &message)
            }
            other => other.into(),
        }
    }
}
