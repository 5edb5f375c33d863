//! Which places of a list name each of a row of things.

use crate::monitor::batches;
use crate::{Cancelled, Monitor, Silent};

/// For each bin the places in a list that name it, in ascending order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Bins {
    /// Where each bin's places start in `places`, and the end of the last.
    offsets: Vec<u32>,
    places: Vec<u32>,
}

impl Bins {
    /// Turns a list of `len` bins around, by a counting sort; every bin named is less than `count`.
    pub fn of(count: usize, len: usize, bin: impl Fn(usize) -> usize) -> Self {
        Self::monitored(count, len, bin, &Silent).expect("nobody stops it")
    }

    /// As [`Bins::of`], for callers that may want to stop.
    pub fn monitored(
        count: usize,
        len: usize,
        bin: impl Fn(usize) -> usize,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        Self::sorted(count, len, &bin, monitor)
    }

    /// No generic function: the web would have to fetch one for each caller.
    fn sorted(
        count: usize,
        len: usize,
        bin: &dyn Fn(usize) -> usize,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let mut offsets = vec![0u32; count + 1];
        for batch in batches(len, monitor) {
            batch?.for_each(|k| offsets[bin(k)] += 1);
        }
        let mut end = 0;
        for offset in &mut offsets {
            end += *offset;
            *offset = end;
        }
        let mut places = vec![0u32; len];
        for batch in batches(len, monitor) {
            // From the last, so that each bin's places ascend.
            for k in batch?.map(|k| len - 1 - k) {
                let offset = &mut offsets[bin(k)];
                *offset -= 1;
                places[*offset as usize] = u32::try_from(k).expect("more than 2^32 places");
            }
        }
        Ok(Self { offsets, places })
    }

    /// The places that name bin `b`.
    pub fn at(&self, b: usize) -> &[u32] {
        &self.places[self.range(b)]
    }

    /// The same, to be put in another order.
    pub fn at_mut(&mut self, b: usize) -> &mut [u32] {
        let range = self.range(b);
        &mut self.places[range]
    }

    /// Where the places of bin `b` stand among those of all bins.
    pub fn range(&self, b: usize) -> std::ops::Range<usize> {
        self.offsets[b] as usize..self.offsets[b + 1] as usize
    }
}
