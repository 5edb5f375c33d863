//! Which edges are feature edges.

use super::shell::{Shell, triangle_of};
use crate::geometry::Point;
use crate::parallel;

/// For each half-edge whether it is part of a curve: where the normals of its two triangles differ by more than
/// `feature_angle` degrees.
pub(super) fn feature_edges(shell: &Shell, normals: &[Point], feature_angle: f64) -> Vec<bool> {
    let cosine = libm::cos(feature_angle.to_radians());
    parallel::collect(shell.len(), |k| {
        let twin = shell.twins[k];
        normals[triangle_of(k as u32)].dot(normals[triangle_of(twin)]) < cosine
    })
}

/// The angle inside the solid between the two triangles at a half-edge, in degrees.
pub(super) fn interior_angle(shell: &Shell, normals: &[Point], k: u32) -> f64 {
    let [left, right] = [k, shell.twin(k)].map(|k| normals[triangle_of(k)]);
    let across = left.cross(right);
    let turn = libm::atan2(across.length(), left.dot(right)).to_degrees();
    180.0 - turn.copysign(across.dot(shell.along(k)))
}
