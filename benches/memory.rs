//! Memory of refinement: the most bytes held at a time, for each quad of the result.
//!
//! `cargo bench --bench memory` prints a line a case; one and two threads, 1 M and 4 M quads. Counted by the allocator,
//! so that it does not depend on the machine. A block that grows counts twice while it is copied, as it does where a
//! system cannot move it.

mod cases;

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use cases::{cases, on, pool};

/// Bytes that are held now, and the most since the last reset.
static HELD: AtomicUsize = AtomicUsize::new(0);
static MOST: AtomicUsize = AtomicUsize::new(0);

struct Counting;

#[global_allocator]
static ALLOCATOR: Counting = Counting;

// SAFETY: every call is handed on to the system's allocator as it is.
unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        MOST.fetch_max(HELD.fetch_add(layout.size(), Relaxed) + layout.size(), Relaxed);
        // SAFETY: the caller keeps the contract of `alloc`.
        unsafe { System.alloc(layout) }
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        HELD.fetch_sub(layout.size(), Relaxed);
        // SAFETY: the pointer is from `alloc` with this layout.
        unsafe { System.dealloc(pointer, layout) }
    }
}

fn main() {
    for (name, mesh, options) in cases() {
        for threads in [1, 2] {
            let pool = pool(threads);
            let before = HELD.load(Relaxed);
            MOST.store(before, Relaxed);
            let refined = on(&pool, &mesh, &options);
            let (most, quads) = (MOST.load(Relaxed) - before, refined.mesh.quads.len());
            println!(
                "{name}, {threads} threads: {quads} quads, {most} bytes, {:.1} a quad",
                most as f64 / quads as f64
            );
        }
    }
}
