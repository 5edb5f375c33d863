//! Minimum, mean, percentile, histogram.

use std::ops::Range;

use serde::Serialize;

use crate::parallel;

/// The ends, the mean and the low end of a set of values.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Summary {
    /// The least value.
    pub min: f32,
    /// The greatest value.
    pub max: f32,
    /// The arithmetic mean.
    pub mean: f64,
    /// The value below which one in a hundred lies, interpolated between the two values around it.
    pub percentile_1: f32,
}

/// Values that one task sums: sums are made by blocks and then in order of blocks, so that the mean does
/// not depend on the number of threads.
const BLOCK: usize = 1 << 14;

impl Summary {
    /// Sums `values` up; `None` if there are none.
    pub fn of(values: &[f32]) -> Option<Self> {
        if values.is_empty() {
            return None;
        }
        let blocks: Vec<(f32, f32, f64)> = parallel::blocks(values.len(), BLOCK, |block| {
            let start = (f32::INFINITY, f32::NEG_INFINITY, 0.0);
            values[block].iter().fold(start, |(lo, hi, sum), &v| (lo.min(v), hi.max(v), sum + f64::from(v)))
        });
        Some(Self {
            min: blocks.iter().map(|b| b.0).fold(f32::INFINITY, f32::min),
            max: blocks.iter().map(|b| b.1).fold(f32::NEG_INFINITY, f32::max),
            mean: blocks.iter().map(|b| b.2).sum::<f64>() / values.len() as f64,
            percentile_1: percentile(values, 0.01),
        })
    }
}

/// The value at the given share of the sorted values, interpolated linearly (as NumPy does).
fn percentile(values: &[f32], share: f64) -> f32 {
    let mut values = values.to_vec();
    let at = share * (values.len() - 1) as f64;
    let (_, &mut below, rest) = values.select_nth_unstable_by(at as usize, f32::total_cmp);
    let above = rest.iter().copied().min_by(f32::total_cmp).unwrap_or(below);
    let (below, above) = (f64::from(below), f64::from(above));
    (below + at.fract() * (above - below)) as f32
}

/// How many values fall into each of a row of bins of equal width.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Histogram {
    /// Where the first bin starts.
    pub min: f32,
    /// Where the last bin ends.
    pub max: f32,
    /// Values a bin; those beyond an end are counted in the bin there.
    pub counts: Vec<u32>,
}

impl Histogram {
    /// Counts `values` in `bins` bins over `range`. A value that is no number counts in the first.
    pub fn of(values: &[f32], range: Range<f32>, bins: usize) -> Self {
        let scale = bins as f32 / (range.end - range.start);
        let last = bins.saturating_sub(1);
        let count = |block: Range<usize>| {
            let mut counts = vec![0u32; bins];
            for v in &values[block] {
                counts[(((v - range.start) * scale) as usize).min(last)] += 1;
            }
            counts
        };
        let add = |mut a: Vec<u32>, b: Vec<u32>| {
            a.iter_mut().zip(b).for_each(|(a, b)| *a += b);
            a
        };
        let counts = parallel::blocks(values.len(), BLOCK, count).into_iter().fold(vec![0; bins], add);
        Self { min: range.start, max: range.end, counts }
    }
}

/// A summary and a histogram of the same values.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Distribution {
    /// Their ends and mean.
    #[serde(flatten)]
    pub summary: Summary,
    /// Their counts.
    pub histogram: Histogram,
}

impl Distribution {
    /// Of `values`, with the histogram's range and number of bins; `None` if there are no values.
    pub fn of(values: &[f32], range: Range<f32>, bins: usize) -> Option<Self> {
        Some(Self { summary: Summary::of(values)?, histogram: Histogram::of(values, range, bins) })
    }
}

#[cfg(test)]
mod tests;
