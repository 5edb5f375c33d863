//! Places in memory that many threads write, each its own. All the unsafe code of the loops is here, and where they
//! call it.

use std::ops::Range;
use std::sync::atomic::AtomicBool;

use super::try_each_block;
use crate::{Cancelled, Monitor};

/// A run of places for `T`, of which no two threads may touch the same. Whoever has it must keep what it was made from
/// in its place, and use none of these places otherwise.
pub(super) struct Slots<T> {
    first: *mut T,
    count: usize,
}

// SAFETY: a thread that has the slots can move a `T` into one, or get an exclusive reference to one, both of which
// `T: Send` allows; the callers of the methods see to it that no two threads use the same slot.
unsafe impl<T: Send> Sync for Slots<T> {}

impl<T> Slots<T> {
    /// The first `count` places behind the items of `all`, which has room for them. They hold nothing yet.
    ///
    /// # Panics
    /// If there is no room for them.
    pub(super) fn after(all: &mut Vec<T>, count: usize) -> Self {
        let spare = all.spare_capacity_mut();
        assert!(count <= spare.len(), "room for what is to come");
        Self { first: spare.as_mut_ptr().cast(), count }
    }

    /// The same places, `N` at a time.
    pub(super) fn in_arrays<const N: usize>(self) -> Slots<[T; N]> {
        Slots { first: self.first.cast(), count: self.count / N }
    }

    /// The places of items that are there.
    pub(super) fn of(items: &mut [T]) -> Self {
        Self { first: items.as_mut_ptr(), count: items.len() }
    }

    /// Writes `value` to slot `k`, dropping nothing.
    ///
    /// # Safety
    /// `k` is below the number of slots, and no other thread uses slot `k`.
    pub(super) unsafe fn write(&self, k: usize, value: T) {
        debug_assert!(k < self.count);
        // SAFETY: as the caller promises, the place is in the run, and no other thread's.
        unsafe { self.first.add(k).write(value) }
    }

    /// Moves all `items` to the slots from `start`, leaving none.
    ///
    /// # Safety
    /// All those slots are below the number of slots, and no other thread uses them.
    pub(super) unsafe fn take(&self, start: usize, items: &mut Vec<T>) {
        debug_assert!(start + items.len() <= self.count);
        // SAFETY: as the caller promises, the places are in the run, and no other thread's. Once the vector is empty, the
        // items are in the slots alone.
        unsafe {
            self.first.add(start).copy_from_nonoverlapping(items.as_ptr(), items.len());
            items.set_len(0);
        }
    }

    /// The item in slot `k`.
    ///
    /// # Safety
    /// `k` is below the number of slots, the slot holds an item, and nobody else uses it while the reference is there.
    #[allow(clippy::mut_from_ref)]
    pub(super) unsafe fn get_mut(&self, k: usize) -> &mut T {
        debug_assert!(k < self.count);
        // SAFETY: as the caller promises, the place is in the run, holds an item, and is no other thread's.
        unsafe { &mut *self.first.add(k) }
    }
}

/// Copies `count` items, by all threads, unless the monitor stops it.
///
/// # Errors
/// If the monitor stops it; then some items were not copied.
///
/// # Safety
/// There are `count` items at `from`, and places for as many at `to`, which do not overlap and nobody else uses.
pub(super) unsafe fn try_copy<T>(
    from: *const T,
    to: *mut T,
    count: usize,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    let copy = Copy { from: from.cast(), to: to.cast() };
    // SAFETY: blocks do not overlap, and end at the last byte.
    try_each_block(count * size_of::<T>(), COPIED_AT_ONCE, monitor, &|bytes| unsafe { copy.bytes(bytes) })
}

/// How many bytes a thread copies before the monitor is asked again.
const COPIED_AT_ONCE: usize = 1 << 18;

/// Memory that is copied by many threads.
struct Copy {
    from: *const u8,
    to: *mut u8,
}

// SAFETY: its method's caller sees to it that no two threads use the same bytes.
unsafe impl Sync for Copy {}

impl Copy {
    /// # Safety
    /// The bytes are part of what is to be copied, and no other thread copies them.
    unsafe fn bytes(&self, range: Range<usize>) {
        // SAFETY: as the caller promises.
        unsafe { self.to.add(range.start).copy_from_nonoverlapping(self.from.add(range.start), range.len()) }
    }
}

/// The flags as many threads can set them.
pub(super) fn shared(flags: &mut [bool]) -> &[AtomicBool] {
    let flags: *mut [bool] = flags;
    // SAFETY: `AtomicBool` is in memory what `bool` is, and while the reference is there, nobody else has one.
    unsafe { &*(flags as *const [AtomicBool]) }
}
