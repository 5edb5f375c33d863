//! What the module's memory can hold, held against a mesh before the work.
//!
//! WebAssembly's memory ends where its address space does: at the 2 GiB of shared memory that every browser gives.
//! An allocation beyond kills the instance, so meshes that would lead there are refused by their estimate.

use serde::de::DeserializeOwned;
use wasm_bindgen::prelude::JsValue;

use super::errors::Failure;
use crate::mesh::in_digits;

/// Memory for a mesh and the work on it, in bytes: 2 GiB less code, stacks, surfaces, and gaps between blocks.
const MESH_MEMORY: u64 = 1_650_000_000;

/// What the work on one cell takes, and how many cells can be asked for at most.
pub(super) struct Cost {
    /// Peak memory.
    pub(super) bytes_per_cell: u64,
    /// Limits beyond are out of range, whatever memory there is.
    pub(super) most_asked: u64,
    /// The name of the cells.
    pub(super) cells: &'static str,
}

/// A limit of cells.
pub(super) struct Limit {
    /// The limit.
    pub(super) cells: u64,
    /// The limit is that of memory, not a lower one of the caller's.
    pub(super) is_memory_s: bool,
    cost: &'static Cost,
}

impl Cost {
    const fn most(&self) -> u64 {
        MESH_MEMORY / self.bytes_per_cell
    }

    /// The limit where `asked` cells are allowed by the caller. Limits out of range stay, to be refused with the other
    /// options.
    pub(super) fn limit(&'static self, asked: u64) -> Limit {
        let is_memory_s = (self.most()..=self.most_asked).contains(&asked);
        Limit { cells: if is_memory_s { self.most() } else { asked }, is_memory_s, cost: self }
    }
}

impl Limit {
    /// The refusal of so many cells, with what to do: `advice` continues "give".
    pub(super) fn exceeded(&self, cells: f64, advice: &str) -> Failure {
        let Cost { bytes_per_cell, cells: name, .. } = self.cost;
        let gigabytes = |cells: f64| cells * *bytes_per_cell as f64 / 1e9;
        let most = self.cost.most();
        let message = format!(
            "the mesh would have about {} {name} and take {} GB, more than the {:.1} GB that WebAssembly has \
             for it, which hold {most} {name}: {advice}, or use the command line, which has all memory",
            in_digits(cells),
            in_digits((10.0 * gigabytes(cells)).round() / 10.0),
            gigabytes(most as f64),
        );
        Failure::limit("memory-exceeded", &message)
    }
}

/// Options of a refinement with a limit of cells.
pub(super) trait Limited: DeserializeOwned {
    /// Why the refinement was not done.
    type Error: Into<Failure>;
    /// What a cell costs.
    const COST: &'static Cost;
    /// The limit of cells.
    fn max_cells(&mut self) -> &mut u64;
    /// How many cells there would be, if there would be too many.
    fn too_many(error: &Self::Error) -> Option<u64>;
}

/// Options whose limit of cells is one that memory can hold.
pub(super) struct Affordable<O> {
    /// The options.
    pub(super) options: O,
    limit: Limit,
}

impl<O: Limited> Affordable<O> {
    /// Reads options.
    ///
    /// # Errors
    /// If they are none.
    pub(super) fn read(options: JsValue) -> Result<Self, Failure> {
        let mut options: O = serde_wasm_bindgen::from_value(options)?;
        let limit = O::COST.limit(*options.max_cells());
        *options.max_cells() = limit.cells;
        Ok(Self { options, limit })
    }

    /// What to tell of an error of the work with these options.
    pub(super) fn failure(&self, error: O::Error) -> Failure {
        match O::too_many(&error) {
            Some(cells) if self.limit.is_memory_s => {
                let advice = "give a larger edge length, fewer levels or smaller regions";
                self.limit.exceeded(cells as f64, advice)
            }
            _ => error.into(),
        }
    }
}
