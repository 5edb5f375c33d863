//! Memory of refinement: the most bytes held at a time, for each quad or hex of the result.
//!
//! `cargo bench --bench memory` prints a line a case; one and two threads, 1 M and 4 M quads, 0.1 M and 1 M hexes (with
//! `-- hexes` these alone). Counted by the allocator, so that it does not depend on the machine. A block that grows counts twice while it is copied, as it does where a
//! system cannot move it.

mod cases;
mod shell;

use std::alloc::{GlobalAlloc, Layout, System};
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use cases::{cases, on, pool};
use hexmill::Silent;
use hexmill::refine::hex::{HexPlan, Method};

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
    hexes();
    if std::env::args().any(|argument| argument == "hexes") {
        return;
    }
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

fn hexes() {
    for (name, n, level) in shell::SIZES {
        let input = shell::cubes(n);
        for method in [Method::One, Method::Two, Method::Three] {
            // Levels of 27 children are as fine as half as many more of 8.
            let level = if method == Method::Three { level / 2 + 1 } else { level };
            let options = shell::shell(n, level, method);
            let before = HELD.load(Relaxed);
            let most = |what: &str, hexes: usize| {
                let most = MOST.load(Relaxed) - before;
                println!(
                    "{name}, {method:?}, {what}: {hexes} hexes, {most} bytes, {:.1} a hex",
                    most as f64 / hexes as f64
                );
                MOST.store(before, Relaxed);
            };
            MOST.store(before, Relaxed);
            let plan = HexPlan::new(&input, &options, &Silent).expect("a shell in cubes");
            most("plan", plan.forecast().hexes);
            let refined = plan.carry_out(&Silent).expect("a shell in cubes");
            most("mesh", refined.mesh.hexes.len());
        }
    }
}
