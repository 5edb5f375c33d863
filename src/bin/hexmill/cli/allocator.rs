//! Where the command line's memory is from.
//!
//! Refinement fills the same arrays of megabytes again and again: an allocator that keeps its pages spares the system's clearing
//! them anew, which is up to half of the time. A mesh of a solid takes far longer to compute than its arrays to clear: there the
//! system's allocator is as fast, and holds an eighth to a fifth less.

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use libmimalloc_sys::mi_is_in_heap_region;
use mimalloc::MiMalloc;

/// Is memory from the allocator that keeps pages from now on? Never false again.
static KEEPS_PAGES: AtomicBool = AtomicBool::new(false);

/// The system's allocator, until one that keeps its pages is asked for.
pub(crate) struct Allocator;

/// What was freed may be filled again soon: it is kept for a second.
pub(super) fn keep_pages() {
    KEEPS_PAGES.store(true, Relaxed);
}

/// Large arrays that are freed go back to the system at once, however many there are, and what is free at the end of the heap but
/// for as much. Without this the system keeps the more the larger they were.
pub(super) fn give_back_at_once() {
    #[cfg(target_env = "gnu")]
    {
        const LARGE: libc::c_int = 1 << 19;
        for option in [libc::M_MMAP_THRESHOLD, libc::M_TRIM_THRESHOLD, libc::M_TOP_PAD] {
            // SAFETY: options may be set at any time.
            let is_set = unsafe { libc::mallopt(option, LARGE) };
            debug_assert_eq!(is_set, 1, "the option is known, and in range");
        }
    }
}

/// Gives pages back between blocks that are in use, unless they are kept: small arrays that were freed leave many.
pub(super) fn give_back_what_is_free() {
    #[cfg(target_env = "gnu")]
    if !KEEPS_PAGES.load(Relaxed) {
        // SAFETY: it may be called at any time, by any thread.
        unsafe { libc::malloc_trim(0) };
    }
}

/// Is a block from the allocator that keeps pages?
fn is_kept(block: *mut u8) -> bool {
    // SAFETY: it looks the address up, whatever is there.
    KEEPS_PAGES.load(Relaxed) && unsafe { mi_is_in_heap_region(block.cast()) }
}

// SAFETY: every call is handed on as it is to an allocator, and what is done with a block to the one that it is from.
unsafe impl GlobalAlloc for Allocator {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        // SAFETY: the caller keeps the contract, which is the same.
        unsafe { if KEEPS_PAGES.load(Relaxed) { MiMalloc.alloc(layout) } else { System.alloc(layout) } }
    }

    unsafe fn alloc_zeroed(&self, layout: Layout) -> *mut u8 {
        // SAFETY: as above.
        unsafe {
            if KEEPS_PAGES.load(Relaxed) {
                MiMalloc.alloc_zeroed(layout)
            } else {
                System.alloc_zeroed(layout)
            }
        }
    }

    unsafe fn dealloc(&self, block: *mut u8, layout: Layout) {
        // SAFETY: the block is from this allocator.
        unsafe {
            if is_kept(block) { MiMalloc.dealloc(block, layout) } else { System.dealloc(block, layout) }
        }
    }

    unsafe fn realloc(&self, block: *mut u8, layout: Layout, size: usize) -> *mut u8 {
        // SAFETY: the block is from this allocator.
        unsafe {
            if is_kept(block) {
                MiMalloc.realloc(block, layout, size)
            } else {
                System.realloc(block, layout, size)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Blocks grow and are freed where they are from, also those that were there before.
    #[test]
    fn blocks_stay_with_their_allocator() {
        let layout = Layout::from_size_align(1000, 16).unwrap();
        let filled = |byte: u8| {
            // SAFETY: the layout is not empty, and as many bytes are written as there are.
            unsafe {
                let block = Allocator.alloc(layout);
                block.write_bytes(byte, 1000);
                block
            }
        };
        let before = filled(1);
        assert!(!is_kept(before));
        keep_pages();
        let after = filled(2);
        assert_eq!([is_kept(before), is_kept(after)], [false, true]);
        for (block, byte) in [(before, 1), (after, 2)] {
            let was_kept = is_kept(block);
            // SAFETY: the blocks are from above, and are not used after they are freed.
            unsafe {
                let block = Allocator.realloc(block, layout, 1 << 20);
                assert!(std::slice::from_raw_parts(block, 1000).iter().all(|&b| b == byte));
                assert_eq!(is_kept(block), was_kept);
                Allocator.dealloc(block, Layout::from_size_align(1 << 20, 16).unwrap());
                let block = Allocator.alloc_zeroed(layout);
                assert!(is_kept(block) && std::slice::from_raw_parts(block, 1000).iter().all(|&b| b == 0));
                Allocator.dealloc(block, layout);
            }
        }
    }
}
