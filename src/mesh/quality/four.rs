//! Measures of many hexes, four at a time.

use super::bernstein;
use super::hex;
use crate::geometry::Point;
use crate::geometry::lanes::LANES;
use crate::{Cancelled, Monitor, parallel};

/// The scaled Jacobian of each of `count` hexes, by their corners: as [`super::scaled_jacobian`] has it.
///
/// # Errors
/// If the monitor stops it.
pub(crate) fn scaled_jacobians(
    count: usize,
    monitor: &dyn Monitor,
    corners: impl Fn(usize) -> [Point; 8] + Sync,
) -> Result<Vec<f64>, Cancelled> {
    by_four(count, monitor, corners, hex::scaled_jacobians)
}

/// Whether each of `count` hexes is certainly positive in all of its inside: as [`super::is_positive`] has it.
///
/// # Errors
/// If the monitor stops it.
pub(crate) fn are_positive(
    count: usize,
    monitor: &dyn Monitor,
    corners: impl Fn(usize) -> [Point; 8] + Sync,
) -> Result<Vec<bool>, Cancelled> {
    by_four(count, monitor, corners, bernstein::are_positive)
}

fn by_four<T: Send>(
    count: usize,
    monitor: &dyn Monitor,
    corners: impl Fn(usize) -> [Point; 8] + Sync,
    look: impl Fn(&[[Point; 8]; LANES]) -> [T; LANES] + Sync,
) -> Result<Vec<T>, Cancelled> {
    let mut all = Vec::new();
    parallel::try_extend_arrays(&mut all, count.div_ceil(LANES), monitor, |four| {
        let mut hexes = [[Point::ZERO; 8]; LANES];
        for (lane, hex) in hexes.iter_mut().enumerate() {
            *hex = corners((LANES * four + lane).min(count - 1));
        }
        look(&hexes)
    })?;
    all.truncate(count);
    Ok(all)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::Silent;
    use crate::mesh::numbering::hex::CORNERS;
    use crate::mesh::quality::{Certainty, is_positive, scaled_jacobian};
    use proptest::prelude::*;

    proptest! {
        /// To the last bit, for any number of hexes: cubes with some corners moved, through each other too, or onto each
        /// other.
        #[test]
        fn four_are_as_one(moved in prop::collection::vec((0usize..8, -1.5..1.5, 0usize..8), 0..14)) {
            let hexes: Vec<[Point; 8]> = moved.iter().map(|&(corner, by, onto)| {
                let mut hex = CORNERS.map(|c| Point::from(c.map(f64::from)));
                hex[corner] = if by < -1.0 { hex[onto] } else { hex[corner] + Point::new(by, 0.3 - by, by * by) };
                hex
            }).collect();
            let jacobians = scaled_jacobians(hexes.len(), &Silent, |h| hexes[h]).unwrap();
            let alone: Vec<f64> = hexes.iter().map(scaled_jacobian).collect();
            prop_assert_eq!(jacobians, alone);
            let positive = are_positive(hexes.len(), &Silent, |h| hexes[h]).unwrap();
            let alone: Vec<bool> = hexes.iter().map(|hex| is_positive(hex) == Certainty::Positive).collect();
            prop_assert_eq!(positive, alone);
        }
    }
}
