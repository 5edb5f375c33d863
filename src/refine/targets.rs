//! A caller's size function: the greatest edge length allowed for each candidate.

use crate::sizing::limit;

/// The first target that is no length above 0.
pub(super) fn first_bad_target(targets: &[f64]) -> Option<usize> {
    targets.iter().position(|&target| target.is_nan() || target <= 0.0)
}

/// True if element `e` is longer than the caller's target for it, by more than rounding.
pub(super) fn exceeds(targets: Option<&[f64]>, e: usize, longest: f64) -> bool {
    targets.is_some_and(|targets| longest > limit(targets[e]))
}
