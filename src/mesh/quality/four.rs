//! Measures of many hexes, four at a time.

use super::bernstein;
use super::hex;
use crate::geometry::Point;
use crate::geometry::lanes::LANES;
use crate::{Cancelled, Monitor, parallel};

/// The scaled Jacobian of each of `count` hexes, by where each corner of each is: as [`super::scaled_jacobian`] has it.
///
/// # Errors
/// If the monitor stops it.
pub(crate) fn scaled_jacobians(
    count: usize,
    monitor: &dyn Monitor,
    corner: impl Fn(usize, usize) -> Point + Sync,
) -> Result<Vec<f64>, Cancelled> {
    by_four(count, monitor, |four| hex::scaled_jacobians(&|lane, k| corner(hex_at(four, lane, count), k)))
}

/// Whether each of `count` hexes is certainly positive in all of its inside: as [`super::is_positive`] has it.
///
/// # Errors
/// If the monitor stops it.
pub(crate) fn are_positive(
    count: usize,
    monitor: &dyn Monitor,
    corner: impl Fn(usize, usize) -> Point + Sync,
) -> Result<Vec<bool>, Cancelled> {
    by_four(count, monitor, |four| bernstein::are_positive(&|lane, k| corner(hex_at(four, lane, count), k)))
}

/// Which of `count` hexes is looked at in this lane of the four: the last again where there are no more.
fn hex_at(four: usize, lane: usize, count: usize) -> usize {
    (LANES * four + lane).min(count - 1)
}

fn by_four<T: Send>(
    count: usize,
    monitor: &dyn Monitor,
    look: impl Fn(usize) -> [T; LANES] + Sync,
) -> Result<Vec<T>, Cancelled> {
    let mut all = Vec::new();
    parallel::try_extend_arrays(&mut all, count.div_ceil(LANES), monitor, look)?;
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
            let jacobians = scaled_jacobians(hexes.len(), &Silent, |h, k| hexes[h][k]).unwrap();
            let alone: Vec<f64> = hexes.iter().map(scaled_jacobian).collect();
            prop_assert_eq!(jacobians, alone);
            let positive = are_positive(hexes.len(), &Silent, |h, k| hexes[h][k]).unwrap();
            let alone: Vec<bool> = hexes.iter().map(|hex| is_positive(hex) == Certainty::Positive).collect();
            prop_assert_eq!(positive, alone);
        }
    }
}
