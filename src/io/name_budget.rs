//! How much memory the names of groups may take.

use crate::mesh::{Group, TagSet};

/// Names may take this many bytes for each byte of the file. Every set of names holds copies of its
/// names, so without a bound a small file could ask for memory that grows as the square of its size.
const BYTES_PER_BYTE: usize = 16;
/// Names of this many bytes are fine in any file.
const BYTES_ALWAYS: usize = 1 << 20;

/// The memory that is left for names.
#[derive(Default)]
pub(super) struct NameBudget {
    left: usize,
}

impl NameBudget {
    /// The memory for the names of a file of `size` bytes.
    pub fn new(size: usize) -> Self {
        Self { left: size.saturating_mul(BYTES_PER_BYTE).saturating_add(BYTES_ALWAYS) }
    }

    /// Takes what one more set needs; false if there is not so much left.
    pub fn take(&mut self, set: &TagSet) -> bool {
        let groups = set.groups.iter().map(|group| &group.name);
        let names = groups.chain(&set.object).chain(&set.material);
        // Each name is held twice: to find the set, and in the set.
        let bytes: usize = names.map(|name| 2 * (name.len() + size_of::<Group>())).sum();
        let left = self.left.checked_sub(bytes);
        self.left = left.unwrap_or(self.left);
        left.is_some()
    }
}
