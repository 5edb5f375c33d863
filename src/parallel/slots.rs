//! Places in memory that many threads write, each its own. All the unsafe code of the loops is here, and where they
//! call it.

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
