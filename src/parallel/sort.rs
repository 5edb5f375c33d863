//! Sorting.

use super::{for_each_mut, join};

/// So many items are sorted by one thread.
const FEW: usize = 1 << 14;

/// Sorts `items`. Equal items are alike, so that their order does not matter.
pub fn sort<T: Ord + Copy + Send + Sync>(items: &mut [T]) {
    if items.len() <= FEW {
        return items.sort_unstable();
    }
    let mut runs: Vec<&mut [T]> = items.chunks_mut(FEW).collect();
    for_each_mut(&mut runs, |_, run| run.sort_unstable());
    let mut merged = items.to_vec();
    merge_runs(items, &mut merged, false);
}

/// The places of numbers, the greatest first, in the order of [`f64::total_cmp`]; of those that are equal the first.
pub fn greatest_first(numbers: impl Iterator<Item = f64>) -> impl Iterator<Item = usize> {
    let mut order: Vec<(u64, u32)> = numbers.map(|number| !ascending(number)).zip(0..).collect();
    order.sort_unstable();
    order.into_iter().map(|(_, k)| k as usize)
}

/// Puts items with the greatest numbers first; those with equal ones stay in their order. A library's stable sort would be
/// compiled for each kind of item.
pub fn put_greatest_first<T: Clone>(items: &mut Vec<T>, number: impl Fn(&T) -> f64) {
    *items = greatest_first(items.iter().map(number)).map(|k| items[k].clone()).collect();
}

/// Sorts numbers that belong to something: the least first, in the order of [`f64::total_cmp`], and of those that are equal that
/// of what comes first.
pub fn put_least_first(items: &mut [(f64, u32)]) {
    let mut order: Vec<(u64, u32)> = items.iter().map(|&(number, of)| (ascending(number), of)).collect();
    order.sort_unstable();
    for (item, (bits, of)) in items.iter_mut().zip(order) {
        *item = (f64::from_bits(if bits & SIGN == 0 { !bits } else { bits ^ SIGN }), of);
    }
}

/// The bit that negative numbers have.
const SIGN: u64 = 1 << 63;

/// Bits in the order of numbers: theirs are so if they are not negative, and else in the opposite one.
fn ascending(number: f64) -> u64 {
    let bits = number.to_bits();
    if bits & SIGN == 0 { bits | SIGN } else { !bits }
}

/// Merges the sorted runs of [`FEW`] items, into `other` if `there`, else into `items`. Both hold the runs.
fn merge_runs<T: Ord + Copy + Send + Sync>(items: &mut [T], other: &mut [T], there: bool) {
    let runs = items.len().div_ceil(FEW);
    if runs <= 1 {
        return;
    }
    let middle = runs / 2 * FEW;
    let (left, right) = items.split_at_mut(middle);
    let (other_left, other_right) = other.split_at_mut(middle);
    join(|| merge_runs(left, other_left, !there), || merge_runs(right, other_right, !there));
    if there { merge(left, right, other) } else { merge(other_left, other_right, items) }
}

/// Merges two sorted runs.
fn merge<T: Ord + Copy>(a: &[T], b: &[T], into: &mut [T]) {
    let (mut a, mut b) = (a.iter().copied().peekable(), b.iter().copied().peekable());
    for place in into {
        let from_a = match (a.peek(), b.peek()) {
            (Some(x), Some(y)) => x <= y,
            (x, _) => x.is_some(),
        };
        *place = if from_a { a.next() } else { b.next() }.expect("as many places as items");
    }
}
