//! Reads ahead: the cells and corners around a node lie all over memory, and a step that finds those of its node in
//! the cache takes about a sixth less.
//!
//! Only hints to the processor: no result depends on them. Where there are none, as in WebAssembly, this does nothing.

use super::problem::Problem;

/// How many nodes ahead it is found which cells they have, these are brought into the cache, and the corners of these.
const USES: usize = 6;
const CELLS: usize = 3;
const CORNERS: usize = 1;

/// Brings into the cache what the nodes after the `k`th of these take, which are looked at in this order.
#[inline]
pub(super) fn read_ahead(problem: &Problem, nodes: &[u32], k: usize) {
    if cfg!(not(target_arch = "x86_64")) {
        return;
    }
    if let Some(&node) = nodes.get(k + USES) {
        fetch(problem.uses(node).first());
    }
    if let Some(&node) = nodes.get(k + CELLS) {
        for (cell, _) in problem.star(node) {
            fetch(problem.cells.get(cell));
            fetch(problem.volume.get(cell));
        }
    }
    if let Some(&node) = nodes.get(k + CORNERS) {
        for (cell, _) in problem.star(node) {
            problem.cells[cell].iter().for_each(|&corner| fetch(problem.points.get(corner as usize)));
        }
    }
}

/// Has the processor begin to bring an item into its cache.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
fn fetch<T>(item: Option<&T>) {
    use std::arch::x86_64::{_MM_HINT_T0, _mm_prefetch};
    if let Some(item) = item {
        // SAFETY: every x86-64 processor has this instruction, which is a hint: it changes nothing, whatever the address.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(item).cast()) }
    }
}

#[cfg(not(target_arch = "x86_64"))]
fn fetch<T>(_: Option<&T>) {}
