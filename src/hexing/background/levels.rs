//! Where the layers of a sweep have to stand.
//!
//! 1. At both ends of the solid;
//! 2. in planar surfaces across the direction, the largest first;
//! 3. in planar curves across it, the longest first;
//! 4. at both ends and in the middle of round holes and pins across it that are a few edges thick at most, the largest
//!    first;
//! 5. halfway between a round end of the solid and the nearest planar surface or curve across, where these are about an
//!    edge apart: the solid turns by a right angle between them.
//!
//! What is too close to a level before has none.

use crate::geometry::Point;
use crate::hexing::across::axis_across;
use crate::hexing::extent::{Extent, ONE_LEVEL};
use crate::parallel::put_greatest_first;
use crate::solid::{Curve, SolidModel, Surface, SurfaceClass};

/// Levels of holes and pins closer than this to others, in edge lengths, are left out; all others closer than [`ONE_LEVEL`].
const MERGED_AROUND: f64 = 0.4;

/// Levels so many edges apart, and farther, have more than one step between them: the edges of two are off by a smaller
/// factor.
pub(super) const ONE_STEP: f64 = std::f64::consts::SQRT_2;

/// A curve whose points are no farther apart along the direction than this, in edge lengths, is across it.
const FLAT: f64 = 0.01;

/// The cosine of 1 degree: normals closer than this to the direction are along it.
const ALONG: f64 = 0.999_847_7;

/// Heights along a unit direction, ascending; `tolerance` is the share of [`ONE_LEVEL`] within which planar surfaces are one
/// level.
pub(super) fn levels(solid: &SolidModel, direction: Point, edge_length: f64, tolerance: f64) -> Vec<f64> {
    let Extent { low, high } = Extent::of(solid.points().iter().copied(), direction);
    let mut levels = Levels { at: vec![low, high], edge_length };
    let (mut planes, mut curves, mut round) = (Vec::new(), Vec::new(), Vec::new());
    for surface in solid.surfaces() {
        let extent = Extent::of_surface(solid, surface, direction);
        if is_across(surface, direction) {
            planes.push((surface.area, extent));
        } else if axis_across(solid, surface, direction, edge_length).is_some() {
            round.push((surface.area, extent));
        }
    }
    for Curve { vertices, length, .. } in solid.curves() {
        let extent = Extent::of(vertices.iter().map(|&v| solid.points()[v as usize]), direction);
        if extent.thickness() <= FLAT * edge_length {
            curves.push((*length, extent));
        }
    }
    for list in [&mut planes, &mut curves, &mut round] {
        put_greatest_first(list, |&(size, _)| size);
    }
    planes.iter().for_each(|(_, extent)| levels.add(extent.middle(), tolerance * ONE_LEVEL));
    curves.iter().for_each(|(_, extent)| levels.add(extent.middle(), ONE_LEVEL));
    for (_, extent) in round {
        [extent.low, extent.middle(), extent.high].into_iter().for_each(|at| levels.add(at, MERGED_AROUND));
    }
    for end in [low, high] {
        let away = |at: &f64| (at - end).abs();
        let flat = planes.iter().chain(&curves).map(|(_, extent)| extent.middle());
        let next = flat.min_by(|a, b| away(a).total_cmp(&away(b)));
        if let Some(next) = next.filter(|next| away(next) < ONE_STEP * edge_length) {
            levels.add(0.5 * (end + next), ONE_LEVEL);
        }
    }
    levels.at.sort_unstable_by(f64::total_cmp);
    levels.at
}

/// Levels in the order in which they were found.
struct Levels {
    at: Vec<f64>,
    edge_length: f64,
}

impl Levels {
    /// Adds a level, if none is closer than so many edges.
    fn add(&mut self, level: f64, merged: f64) {
        if self.at.iter().all(|other| (level - other).abs() >= merged * self.edge_length) {
            self.at.push(level);
        }
    }
}

/// Is a surface planar, and across the direction?
fn is_across(surface: &Surface, direction: Point) -> bool {
    matches!(surface.class, SurfaceClass::Planar { normal } if normal.dot(direction).abs() > ALONG)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::solid::testing::{cylinder, moved, solid};

    /// A cylinder across z, of so large a radius about the origin.
    fn pin(radius: f64) -> SolidModel {
        solid(&moved(cylinder(96), |p| Point::new(2.0 * p.z, radius * p.x, radius * p.y)))
    }

    #[test]
    fn pins_across_have_levels_at_both_ends_and_in_the_middle() {
        let found = levels(&pin(0.6), Point::Z, 1.0, 1.0);
        assert_eq!(found.len(), 3, "{found:?}");
        assert!(found.iter().zip([-0.6, 0.0, 0.6]).all(|(a, b)| (a - b).abs() < 1e-3), "{found:?}");
    }

    #[test]
    fn round_ends_have_a_level_between_them_and_what_is_flat() {
        // Half a pin, on a foot of a height of 1.
        let half = |radius: f64| {
            let ridge =
                |p: Point| Point::new(2.0 * p.z, radius * p.x, radius * p.y.max(0.0) - f64::from(p.y < -0.5));
            levels(&solid(&moved(cylinder(96), ridge)), Point::Z, 1.0, 1.0)
        };
        assert_eq!([half(1.0).len(), half(0.3).len()], [4, 3]);
    }

    #[test]
    fn thick_and_thin_pins_and_those_along_have_none_in_the_middle() {
        assert_eq!(levels(&pin(1.7), Point::Z, 1.0, 1.0).len(), 2);
        assert_eq!(levels(&pin(0.3), Point::Z, 1.0, 1.0).len(), 2);
        assert_eq!(levels(&pin(0.6), Point::X, 1.0, 1.0).len(), 2);
    }
}
