//! The frame in which most of a solid is aligned with the axes.

use glam::DMat3;

use super::clusters::{Weighted, axes, clusters, is_parallel, is_perpendicular, planes};
use crate::geometry::{Frame, Point};
use crate::solid::SolidModel;

/// So many of the largest clusters are tried as an axis.
const TRIED: usize = 16;
/// The world's axes are kept unless others align so large a share of the area more: what organic shapes have aligned
/// with any axes is chance.
const GAIN: f64 = 0.05;
/// Axes of unit length that differ by less than this from the world's are the world's.
const SAME: f64 = 1e-6;

/// The frame, about the middle of the solid's box, with whose axes most of the solid's planar area and its extruded
/// surfaces are aligned, up to 2 degrees. Of the 24 ways to name the axes it is the one closest to the world's; if no
/// frame aligns notably more than the world's axes do, it is they.
pub fn best_frame(solid: &SolidModel) -> Frame {
    let all = clusters([planes(solid), axes(solid)].concat());
    let total: f64 = all.iter().map(|c| c.area).sum();
    let mut best = (aligned(&all, DMat3::IDENTITY) + GAIN * total, DMat3::IDENTITY);
    for z in all.iter().take(TRIED) {
        for candidate in frames_about(z.direction, &all) {
            let score = aligned(&all, candidate);
            // Strictly, beyond rounding: of equals the first is kept.
            if score > best.0 * (1.0 + 1e-9) {
                best = (score, candidate);
            }
        }
    }
    Frame::with_axes(solid.bounds().center(), closest_to_world(best.1))
}

/// Frames with the axis `z`, and with `x` along another cluster, or along what is left of a world axis.
fn frames_about(z: Point, all: &[Weighted]) -> Vec<DMat3> {
    let across = |x: Point| {
        let x = (x - z * z.dot(x)).normalize();
        DMat3::from_cols(x, z.cross(x), z)
    };
    let perpendicular = all.iter().take(TRIED).map(|c| c.direction).filter(|x| is_perpendicular(*x, z));
    let world = [Point::X, Point::Y, Point::Z].into_iter().find(|x| x.dot(z).abs() < 0.9);
    perpendicular.chain(world).map(across).collect()
}

/// The area of the clusters that are parallel to one of the axes.
fn aligned(all: &[Weighted], axes: DMat3) -> f64 {
    let is_aligned = |c: &&Weighted| (0..3).any(|i| is_parallel(axes.col(i), c.direction));
    all.iter().filter(is_aligned).map(|c| c.area).sum()
}

/// The same axes, named and turned so that they are as close to the world's as can be.
fn closest_to_world(axes: DMat3) -> DMat3 {
    let mut best = (f64::NEG_INFINITY, axes);
    for [i, j] in [[0, 1], [0, 2], [1, 0], [1, 2], [2, 0], [2, 1]] {
        for (u, v) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let (x, y) = (axes.col(i) * u, axes.col(j) * v);
            let z = x.cross(y);
            let closeness = x.x + y.y + z.z;
            if closeness > best.0 + SAME {
                best = (closeness, DMat3::from_cols(x, y, z));
            }
        }
    }
    if best.1.abs_diff_eq(DMat3::IDENTITY, SAME) { DMat3::IDENTITY } else { best.1 }
}
