//! The elements that a caller's size function decides on, and what it said of them.

use js_sys::Float64Array;

use super::errors::Failure;
use crate::geometry::Point;
use crate::refine::Candidates;

/// x, y, z of the centre of each element.
pub(super) fn centers(candidates: &Candidates) -> Float64Array {
    bytemuck::cast_slice::<Point, f64>(&candidates.centers).into()
}

/// Refuses targets that are not one edge length for each candidate.
pub(super) fn check_targets(targets: &[f64], candidates: &Candidates) -> Result<(), Failure> {
    let wanted = candidates.longest.len();
    if targets.len() != wanted {
        let message =
            format!("sizeFunction returned {} lengths for {wanted} elements; return one each", targets.len());
        return Err(Failure::options("size-function-length", &message));
    }
    if let Some(at) = targets.iter().position(|t| t.is_nan() || *t < 0.0) {
        let message =
            format!("sizeFunction returned {} for element {at}; return an edge length", targets[at]);
        return Err(Failure::options("size-function-value", &message));
    }
    Ok(())
}

/// A refinement was asked to go on that was finished, or that an error has ended.
pub(super) fn over() -> Failure {
    Failure::internal("session-over", &"the refinement is over")
}
