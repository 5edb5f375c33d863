//! Which places of a list name each of a row of things.

/// For each bin the places in a list that name it, in ascending order.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct Bins {
    /// Where each bin's places start in `places`, and the end of the last.
    offsets: Vec<u32>,
    places: Vec<u32>,
}

impl Bins {
    /// Turns a list of bins around, by a counting sort; every bin named is less than `count`.
    pub fn of(
        count: usize,
        bins: impl DoubleEndedIterator<Item = usize> + ExactSizeIterator + Clone,
    ) -> Self {
        let mut offsets = vec![0u32; count + 1];
        for bin in bins.clone() {
            offsets[bin] += 1;
        }
        let mut end = 0;
        for offset in &mut offsets {
            end += *offset;
            *offset = end;
        }
        let mut places = vec![0u32; bins.len()];
        for (k, bin) in bins.enumerate().rev() {
            offsets[bin] -= 1;
            places[offsets[bin] as usize] = u32::try_from(k).expect("more than 2^32 places");
        }
        Self { offsets, places }
    }

    /// The places that name bin `b`.
    pub fn at(&self, b: usize) -> &[u32] {
        &self.places[self.range(b)]
    }

    /// Where the places of bin `b` stand among those of all bins.
    pub fn range(&self, b: usize) -> std::ops::Range<usize> {
        self.offsets[b] as usize..self.offsets[b + 1] as usize
    }
}
