//! Loops over blocks of cells.

use crate::{Cancelled, Monitor, parallel};

/// Cells, or nodes, that one thread takes at a time.
pub(super) const BLOCK: usize = 1 << 12;

/// Cuts `all` at `ends`, the last of which is its length.
pub(super) fn cut<T>(mut all: &mut [T], ends: impl Iterator<Item = usize>) -> Vec<&mut [T]> {
    let mut from = 0;
    ends.map(|end| {
        let (block, rest) = std::mem::take(&mut all).split_at_mut(end - from);
        (from, all) = (end, rest);
        block
    })
    .collect()
}

/// `counts`, summed up from zero: entry `k` is the sum of those before `k`, and the last one of all.
pub(super) fn offsets(counts: impl ExactSizeIterator<Item = u32>) -> Vec<u32> {
    let mut offsets = Vec::with_capacity(counts.len() + 1);
    let mut sum = 0u32;
    offsets.push(sum);
    for count in counts {
        sum = sum.checked_add(count).expect("more than 2^32 nodes or cells");
        offsets.push(sum);
    }
    offsets
}

/// What `look` finds at each of `count` places, in their order; its buffers serve one place after another. The monitor
/// is asked before each block.
pub(super) fn in_blocks<B, T: Send>(
    count: usize,
    monitor: &dyn Monitor,
    buffers: impl Fn() -> B + Sync,
    look: impl Fn(&mut B, usize, &mut Vec<T>) + Sync,
) -> Result<Vec<T>, Cancelled> {
    let blocks = parallel::try_blocks(count, BLOCK, monitor, |places| {
        let (mut buffers, mut found) = (buffers(), Vec::new());
        places.for_each(|place| look(&mut buffers, place, &mut found));
        found
    })?;
    Ok(parallel::concat(blocks))
}
