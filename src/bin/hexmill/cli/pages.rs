//! How soon memory that is no longer used goes back to the system.
//!
//! The allocator keeps it for a second, since refinement fills the same arrays again and again. A mesh of a solid takes far
//! longer to compute than its arrays to clear: there that would only be memory that nobody else can have.

use libmimalloc_sys::{_mi_option_last, mi_option_set, mi_option_t};

/// After how many milliseconds what was freed goes back: an option of the allocator's `mimalloc.h` that the bindings do not
/// name.
const PURGE_DELAY: mi_option_t = 15;

/// Other versions of it may number their options otherwise.
const _: () = assert!(_mi_option_last == 47);

/// What is freed goes back nearly at once from now on.
pub(super) fn give_back_soon() {
    // SAFETY: options are atomic numbers, and may be set at any time.
    unsafe { mi_option_set(PURGE_DELAY, 1) }
}
