//! The loop that all others go down to, and the one place that knows whether there are threads.

use std::ops::Range;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use crate::{Cancelled, Monitor};

/// Calls `work` for each block of `size` numbers below `count`, the last of which may be shorter, on the threads of
/// the rayon pool that the caller is in. Blocks beside each other tend to go to the same thread.
///
/// # Panics
/// If `size` is 0, or if `work` does: then some blocks may be left out.
pub fn each_block(count: usize, size: usize, work: &(dyn Fn(Range<usize>) + Sync)) {
    let block = |b: usize| work(b * size..count.min((b + 1) * size));
    let blocks = 0..count.div_ceil(size);
    #[cfg(any(not(target_arch = "wasm32"), feature = "threads"))]
    if blocks.len() > 1 && rayon::current_num_threads() > 1 {
        return halve(blocks, &block);
    }
    blocks.for_each(block);
}

/// As [`each_block`], asking the monitor before each block.
///
/// # Errors
/// If the monitor stops it; then some blocks were left out.
pub fn try_each_block(
    count: usize,
    size: usize,
    monitor: &dyn Monitor,
    work: &(dyn Fn(Range<usize>) + Sync),
) -> Result<(), Cancelled> {
    let stopped = AtomicBool::new(false);
    each_block(count, size, &|block| {
        if stopped.load(Relaxed) || monitor.cancelled() {
            stopped.store(true, Relaxed);
        } else {
            work(block);
        }
    });
    if stopped.into_inner() { Err(Cancelled) } else { Ok(()) }
}

/// How many threads share the work of the caller's loops.
pub fn thread_count() -> usize {
    #[cfg(any(not(target_arch = "wasm32"), feature = "threads"))]
    let count = rayon::current_num_threads();
    #[cfg(not(any(not(target_arch = "wasm32"), feature = "threads")))]
    let count = 1;
    count
}

#[cfg(any(not(target_arch = "wasm32"), feature = "threads"))]
fn halve(blocks: Range<usize>, work: &(dyn Fn(usize) + Sync)) {
    if blocks.len() <= 1 {
        return blocks.for_each(work);
    }
    let middle = blocks.start + blocks.len() / 2;
    rayon::join(|| halve(blocks.start..middle, work), || halve(middle..blocks.end, work));
}
