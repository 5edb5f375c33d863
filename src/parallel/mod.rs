//! Loops over many threads whose results do not depend on how many there are.
//!
//! Every loop goes down to [`each_block`], which is no generic function: it cuts the numbers below a length into
//! contiguous blocks and calls one `dyn Fn` a block. So a loop costs about as much code as its body, where a chain of
//! iterator adaptors costs kilobytes each, which the browser would have to fetch. Results come out in the order of the
//! numbers, whichever thread made them.
//!
//! The loops named `try_…` ask a [`Monitor`] before each block and stop soon after it says so.
//!
//! Where there are no threads, which is the one-thread WebAssembly module, the blocks are run one after the other.

mod blocks;
mod slots;
mod sort;

use std::ops::Range;
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use crate::{Cancelled, Monitor, Silent};
pub use blocks::{each_block, thread_count, try_each_block};
use slots::Slots;
pub use sort::{greatest_first, put_greatest_first, put_least_first, sort};

/// What `make` gives for each number below `count`.
pub fn collect<T: Send>(count: usize, make: impl Fn(usize) -> T + Sync) -> Vec<T> {
    unstopped(try_collect(count, &Silent, make))
}

/// As [`collect`], unless the monitor stops it.
///
/// # Errors
/// If the monitor stops it.
pub fn try_collect<T: Send>(
    count: usize,
    monitor: &dyn Monitor,
    make: impl Fn(usize) -> T + Sync,
) -> Result<Vec<T>, Cancelled> {
    let mut all = Vec::new();
    try_extend(&mut all, count, monitor, make)?;
    Ok(all)
}

/// As [`collect`], with something for `make` to work with. It is made once a block, so nothing may follow from what the
/// last call has left in it.
pub fn collect_with<S, T: Send>(
    count: usize,
    init: impl Fn() -> S + Sync,
    make: impl Fn(&mut S, usize) -> T + Sync,
) -> Vec<T> {
    gather_with(count, init, |with, k, made| made.push(make(with, k)))
}

/// As [`collect_with`]; `make` may raise any of the flags as well.
pub fn collect_raising<S, T: Send>(
    flags: &mut [bool],
    count: usize,
    init: impl Fn() -> S + Sync,
    make: impl Fn(&mut S, usize, &Flags) -> T + Sync,
) -> Vec<T> {
    let flags = Flags(slots::shared(flags));
    collect_with(count, init, |with, k| make(with, k, &flags))
}

/// Appends what `make` gives for each number below `count`.
pub fn extend<T: Send>(all: &mut Vec<T>, count: usize, make: impl Fn(usize) -> T + Sync) {
    unstopped(try_extend(all, count, &Silent, make));
}

/// As [`extend`], unless the monitor stops it: then it appends nothing.
///
/// # Errors
/// If the monitor stops it.
pub fn try_extend<T: Send>(
    all: &mut Vec<T>,
    count: usize,
    monitor: &dyn Monitor,
    make: impl Fn(usize) -> T + Sync,
) -> Result<(), Cancelled> {
    try_reserve(all, count, monitor)?;
    let slots = Slots::after(all, count);
    try_each_block(count, block_size(count), monitor, &|block| {
        // SAFETY: blocks do not overlap, and end at `count` at most.
        block.for_each(|k| unsafe { slots.write(k, make(k)) });
    })?;
    // SAFETY: every slot below `count` was written; neither a panic in `make` nor a stop comes here.
    unsafe { all.set_len(all.len() + count) };
    Ok(())
}

/// Appends copies of `more`.
pub fn extend_from_slice<T: Copy + Send + Sync>(all: &mut Vec<T>, more: &[T]) {
    extend(all, more.len(), |k| more[k]);
}

/// Appends what `make` gives from the items so far, for each number below `count`.
pub fn grow<T: Send + Sync>(all: &mut Vec<T>, count: usize, make: impl Fn(&[T], usize) -> T + Sync) {
    unstopped(try_grow(all, count, &Silent, make));
}

/// As [`grow`], unless the monitor stops it: then it appends nothing.
///
/// # Errors
/// If the monitor stops it.
pub fn try_grow<T: Send + Sync>(
    all: &mut Vec<T>,
    count: usize,
    monitor: &dyn Monitor,
    make: impl Fn(&[T], usize) -> T + Sync,
) -> Result<(), Cancelled> {
    try_reserve(all, count, monitor)?;
    let slots = Slots::after(all, count);
    let before = all.as_slice();
    try_each_block(count, block_size(count), monitor, &|block| {
        // SAFETY: blocks do not overlap, and end at `count` at most; the slots lie behind `before`.
        block.for_each(|k| unsafe { slots.write(k, make(before, k)) });
    })?;
    // SAFETY: every slot below `count` was written; neither a panic in `make` nor a stop comes here.
    unsafe { all.set_len(all.len() + count) };
    Ok(())
}

/// Appends the `N` items that `make` gives for each number below `count`, unless the monitor stops it: then it appends
/// nothing.
///
/// # Errors
/// If the monitor stops it.
pub fn try_extend_arrays<T: Send, const N: usize>(
    all: &mut Vec<T>,
    count: usize,
    monitor: &dyn Monitor,
    make: impl Fn(usize) -> [T; N] + Sync,
) -> Result<(), Cancelled> {
    try_reserve(all, N * count, monitor)?;
    let slots = Slots::after(all, N * count).in_arrays::<N>();
    try_each_block(count, block_size(count), monitor, &|block| {
        // SAFETY: blocks do not overlap, and end at `count` at most.
        block.for_each(|k| unsafe { slots.write(k, make(k)) });
    })?;
    // SAFETY: every slot below `count` was written, `N` items each; neither a panic in `make` nor a stop comes here.
    unsafe { all.set_len(all.len() + N * count) };
    Ok(())
}

/// Makes room for `count` more items, and where there are many, all threads move them. There is room for a quarter more
/// then, so that an array which grows bit by bit is seldom moved.
///
/// # Errors
/// If the monitor stops it; then there may be no more room than before.
pub fn try_reserve<T: Send>(all: &mut Vec<T>, count: usize, monitor: &dyn Monitor) -> Result<(), Cancelled> {
    if count <= all.capacity() - all.len() {
        return Ok(());
    }
    if size_of_val(all.as_slice()) < PAGES {
        all.reserve(count);
        return Ok(());
    }
    let mut larger = Vec::with_capacity(all.len() + count + all.len() / 4);
    // SAFETY: there is room for the items. Once they are copied they belong to `larger`, and no longer to `all`.
    unsafe {
        slots::try_copy(all.as_ptr().cast(), larger.as_mut_ptr(), all.len(), monitor)?;
        larger.set_len(all.len());
        all.set_len(0);
    }
    *all = larger;
    Ok(())
}

/// So many bytes are worth more than one thread.
const PAGES: usize = 1 << 18;

/// Sets the item at `place(k)` to `value(k)` for each number `k` below `count`; the places ascend.
///
/// # Errors
/// If the monitor stops it; then some items are as they were.
///
/// # Panics
/// If a place is out of range, or so far out of order that two threads would have to look at it.
pub fn try_scatter<T: Send>(
    items: &mut [T],
    count: usize,
    monitor: &dyn Monitor,
    place: impl Fn(usize) -> usize + Sync,
    value: impl Fn(usize) -> T + Sync,
) -> Result<(), Cancelled> {
    let size = block_size(count);
    let (mut start, mut rest) = (0, items);
    let mut parts = Vec::with_capacity(count.div_ceil(size));
    for next in (size..count).step_by(size) {
        let (part, behind) = rest.split_at_mut(place(next) - start);
        parts.push((start, part));
        (start, rest) = (place(next), behind);
    }
    parts.push((start, rest));
    try_for_each_mut(&mut parts, monitor, |b, (start, part)| {
        (b * size..count.min((b + 1) * size)).for_each(|k| part[place(k) - *start] = value(k));
    })
}

/// For each number below `count`, whether it is among the `N` places that `mark` gives for some number below `marks`.
pub fn flags<const N: usize>(
    count: usize,
    marks: usize,
    mark: impl Fn(usize) -> [usize; N] + Sync,
) -> Vec<bool> {
    let mut flags = collect(count, |_| false);
    raise(&mut flags, marks, mark);
    flags
}

/// Raises the flags at the `N` places that `mark` gives for each number below `marks`.
pub fn raise<const N: usize>(flags: &mut [bool], marks: usize, mark: impl Fn(usize) -> [usize; N] + Sync) {
    raise_some(flags, marks, |k, flags| mark(k).into_iter().for_each(|place| flags.raise(place)));
}

/// Calls `mark` for each number below `marks`, which may raise any of the flags.
pub fn raise_some(flags: &mut [bool], marks: usize, mark: impl Fn(usize, &Flags) + Sync) {
    let flags = Flags(slots::shared(flags));
    for_each(marks, |k| mark(k, &flags));
}

/// Flags that all threads may raise. They set them to the same value, so that their order does not matter.
pub struct Flags<'a>(&'a [AtomicBool]);

impl Flags<'_> {
    /// Raises the flag at a place.
    #[inline]
    pub fn raise(&self, place: usize) {
        self.0[place].store(true, Relaxed);
    }
}

/// Calls `work` for each number below `count`.
pub fn for_each(count: usize, work: impl Fn(usize) + Sync) {
    each_block(count, block_size(count), &|block| block.for_each(&work));
}

/// Calls `work` for each item and its place.
pub fn for_each_mut<T: Send>(items: &mut [T], work: impl Fn(usize, &mut T) + Sync) {
    let (count, slots) = (items.len(), Slots::of(items));
    // SAFETY: blocks do not overlap, and end below the number of items, all of which are there.
    each_block(count, block_size(count), &|block| block.for_each(|k| work(k, unsafe { slots.get_mut(k) })));
}

/// As [`for_each_mut`], unless the monitor stops it.
///
/// # Errors
/// If the monitor stops it; then some items were passed over.
pub fn try_for_each_mut<T: Send>(
    items: &mut [T],
    monitor: &dyn Monitor,
    work: impl Fn(usize, &mut T) + Sync,
) -> Result<(), Cancelled> {
    let (count, slots) = (items.len(), Slots::of(items));
    try_each_block(count, block_size(count), monitor, &|block| {
        // SAFETY: blocks do not overlap, and end below the number of items, all of which are there.
        block.for_each(|k| work(k, unsafe { slots.get_mut(k) }));
    })
}

/// Ranges of the numbers below `count`, in order, one for each thread: for work that looks at `len` things in every range, and
/// of which hardly more comes of the others. There is one range alone where these are few.
pub fn shares(count: usize, len: usize) -> Vec<Range<usize>> {
    const FEW: usize = 1 << 15;
    let shares = if len < FEW { 1 } else { thread_count().clamp(1, count.max(1)) };
    (0..shares).map(|k| count * k / shares..count * (k + 1) / shares).collect()
}

/// What `make` gives for each block of `size` numbers below `count`, the last of which may be shorter. What is summed by
/// blocks, and then in their order, is the same to the last bit for any number of threads.
pub fn blocks<T: Send>(count: usize, size: usize, make: impl Fn(Range<usize>) -> T + Sync) -> Vec<T> {
    collect(count.div_ceil(size), |b| make(b * size..count.min((b + 1) * size)))
}

/// As [`blocks`], unless the monitor stops it.
///
/// # Errors
/// If the monitor stops it.
pub fn try_blocks<T: Send>(
    count: usize,
    size: usize,
    monitor: &dyn Monitor,
    make: impl Fn(Range<usize>) -> T + Sync,
) -> Result<Vec<T>, Cancelled> {
    try_collect(count.div_ceil(size), monitor, |b| make(b * size..count.min((b + 1) * size)))
}

/// The numbers below `count` that `keep` is true for, ascending.
///
/// # Panics
/// If one does not fit 32 bits.
pub fn filter(count: usize, keep: impl Fn(usize) -> bool + Sync) -> Vec<u32> {
    unstopped(try_filter(count, &Silent, keep))
}

/// As [`filter`], unless the monitor stops it.
///
/// # Errors
/// If the monitor stops it.
///
/// # Panics
/// If a number does not fit 32 bits.
pub fn try_filter(
    count: usize,
    monitor: &dyn Monitor,
    keep: impl Fn(usize) -> bool + Sync,
) -> Result<Vec<u32>, Cancelled> {
    u32::try_from(count).expect("no more than 2^32 items");
    try_gather(count, monitor, |k, kept| kept.extend(keep(k).then_some(k as u32)))
}

/// What `look` finds at the numbers below `count`, in their order.
pub fn filter_map<T: Send>(count: usize, look: impl Fn(usize) -> Option<T> + Sync) -> Vec<T> {
    gather(count, |k, found| found.extend(look(k)))
}

/// What `look` adds for each number below `count`, in their order.
pub fn gather<T: Send>(count: usize, look: impl Fn(usize, &mut Vec<T>) + Sync) -> Vec<T> {
    unstopped(try_gather(count, &Silent, look))
}

/// As [`gather`], unless the monitor stops it.
///
/// # Errors
/// If the monitor stops it.
pub fn try_gather<T: Send>(
    count: usize,
    monitor: &dyn Monitor,
    look: impl Fn(usize, &mut Vec<T>) + Sync,
) -> Result<Vec<T>, Cancelled> {
    let found_in = |block: Range<usize>| {
        let mut found = Vec::new();
        block.for_each(|k| look(k, &mut found));
        found
    };
    Ok(concat(try_blocks(count, block_size(count), monitor, found_in)?))
}

/// As [`gather`], with something for `look` to work with, as in [`collect_with`].
pub fn gather_with<S, T: Send>(
    count: usize,
    init: impl Fn() -> S + Sync,
    look: impl Fn(&mut S, usize, &mut Vec<T>) + Sync,
) -> Vec<T> {
    let found_in = |block: Range<usize>| {
        let (mut with, mut found) = (init(), Vec::new());
        block.for_each(|k| look(&mut with, k, &mut found));
        found
    };
    concat(blocks(count, block_size(count).max(LANE), found_in))
}

/// So many numbers at least share what is made once a block.
const LANE: usize = 8;

/// All items of the parts, in order.
pub fn concat<T: Send>(mut parts: Vec<Vec<T>>) -> Vec<T> {
    if parts.iter().filter(|part| !part.is_empty()).count() <= 1 {
        return parts.into_iter().find(|part| !part.is_empty()).unwrap_or_default();
    }
    let total = parts.iter().map(Vec::len).sum();
    let mut all: Vec<T> = Vec::with_capacity(total);
    let slots = Slots::after(&mut all, total);
    let mut end = 0;
    let mut placed: Vec<(usize, &mut Vec<T>)> = Vec::with_capacity(parts.len());
    for part in &mut parts {
        let start = end;
        end += part.len();
        placed.push((start, part));
    }
    // SAFETY: the parts' places do not overlap, and end at `total`.
    for_each_mut(&mut placed, |_, (start, part)| unsafe { slots.take(*start, part) });
    // SAFETY: the parts' items, `total` in all, now belong to `all`, and no longer to the parts.
    unsafe { all.set_len(total) };
    all
}

/// True if `is` is true for some number below `count`; not all of them may be asked.
pub fn any(count: usize, is: impl Fn(usize) -> bool + Sync) -> bool {
    unstopped(try_any(count, &Silent, is))
}

/// As [`any`], unless the monitor stops it.
///
/// # Errors
/// If the monitor stops it.
pub fn try_any(
    count: usize,
    monitor: &dyn Monitor,
    is: impl Fn(usize) -> bool + Sync,
) -> Result<bool, Cancelled> {
    let found = AtomicBool::new(false);
    try_each_block(count, block_size(count), monitor, &|mut block| {
        if !found.load(Relaxed) && block.any(&is) {
            found.store(true, Relaxed);
        }
    })?;
    Ok(found.into_inner())
}

/// The greatest of 0 and the values of the numbers below `count`, none of which is NaN.
pub fn greatest(count: usize, value: impl Fn(usize) -> f64 + Sync) -> f64 {
    unstopped(try_greatest(count, &Silent, value))
}

/// As [`greatest`], unless the monitor stops it.
///
/// # Errors
/// If the monitor stops it.
pub fn try_greatest(
    count: usize,
    monitor: &dyn Monitor,
    value: impl Fn(usize) -> f64 + Sync,
) -> Result<f64, Cancelled> {
    let of_block = |block: Range<usize>| block.map(&value).fold(0.0, f64::max);
    Ok(try_blocks(count, block_size(count), monitor, of_block)?.into_iter().fold(0.0, f64::max))
}

/// What both give, made at the same time.
pub fn join<A: Send, B: Send>(a: impl FnOnce() -> A + Send, b: impl FnOnce() -> B + Send) -> (A, B) {
    let (a, b) = (Once::new(a), Once::new(b));
    each_block(2, 1, &|block| if block.start == 0 { a.run() } else { b.run() });
    (a.result(), b.result())
}

/// Work that is done once.
struct Once<F, R> {
    work: Mutex<Option<F>>,
    result: Mutex<Option<R>>,
}

impl<F: FnOnce() -> R, R> Once<F, R> {
    fn new(work: F) -> Self {
        Self { work: Mutex::new(Some(work)), result: Mutex::new(None) }
    }

    fn run(&self) {
        let work = self.work.lock().expect("no panic while it is held").take();
        let result = work.map(|work| work());
        *self.result.lock().expect("no panic while it is held") = result;
    }

    fn result(self) -> R {
        self.result.into_inner().expect("no panic while it was held").expect("the work was done")
    }
}

/// The result of a loop that [`Silent`] cannot have stopped.
fn unstopped<T>(result: Result<T, Cancelled>) -> T {
    result.expect("nothing stops it")
}

/// How many numbers a block has, where that is left to this module: so many that a block outweighs what a task costs,
/// and so few that threads get about as much to do each, whatever a number costs.
fn block_size(count: usize) -> usize {
    const MOST: usize = 4096;
    const FINEST: usize = 64;
    (count / FINEST).clamp(1, MOST)
}

#[cfg(test)]
mod tests;
