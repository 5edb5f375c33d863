//! What may be asked for when a solid is made, and what is said of it.

use super::error::SolidError;
use serde::{Deserialize, Serialize};

/// How a surface becomes a solid.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct SolidOptions {
    /// Degrees: triangles whose normals differ by more meet at a feature edge. Usually 30 to 40.
    pub feature_angle: f64,
    /// Degrees: where a curve turns by more from one edge to the next it has a corner.
    pub corner_angle: f64,
}

impl Default for SolidOptions {
    fn default() -> Self {
        Self { feature_angle: 35.0, corner_angle: 50.0 }
    }
}

impl SolidOptions {
    /// Says what is out of range.
    pub(super) fn check(&self) -> Result<(), SolidError> {
        let angle = |option, value: f64| {
            let wanted = "more than 0 and less than 180 degrees";
            let is_right = value > 0.0 && value < 180.0;
            is_right.then_some(()).ok_or(SolidError::Option { option, value, wanted })
        };
        angle("the feature angle", self.feature_angle)?;
        angle("the corner angle", self.corner_angle)
    }
}

/// What was found in a surface, and what was mended.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct SolidReport {
    /// Points that were one with another.
    pub welded_points: usize,
    /// Triangles that were dropped because they had a point twice.
    pub degenerate_triangles: usize,
    /// Triangles that were turned around.
    pub turned_triangles: usize,
    /// Points at which several fans of triangles met; each fan has a point of its own now.
    pub split_points: usize,
    /// Points, triangles and bodies of the solid.
    pub points: usize,
    /// Triangles of the solid.
    pub triangles: usize,
    /// Disjoint bodies.
    pub bodies: usize,
    /// Corners.
    pub corners: usize,
    /// Curves.
    pub curves: usize,
    /// Surfaces.
    pub surfaces: usize,
}
