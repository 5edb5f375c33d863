//! What may be asked for when a solid is made, and what is said of it.

use serde::{Deserialize, Serialize};

use super::error::SolidError;
use crate::geometry::Point;

/// How a surface becomes a solid.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct SolidOptions {
    /// Degrees: triangles whose normals differ by more meet at a feature edge. Usually 30 to 40.
    pub feature_angle: f64,
    /// Degrees: where a curve turns by more from one edge to the next it has a corner.
    pub corner_angle: f64,
    /// Are borders of groups, objects and materials features, and polylines and creases of the file?
    pub tags: bool,
    /// The edge length of the mesh to come. If it is given, features are noise and left out that end within a surface
    /// and are shorter, and connected sets of features that are shorter than twice that, unless the file marks them.
    pub edge_length: Option<f64>,
    /// Holes are filled that fit into a box whose diagonal is this share of that of the surface's box.
    pub hole_size: f64,
}

impl Default for SolidOptions {
    fn default() -> Self {
        Self { feature_angle: 35.0, corner_angle: 50.0, tags: true, edge_length: None, hole_size: 0.02 }
    }
}

impl SolidOptions {
    /// Says what is out of range.
    pub(super) fn check(&self) -> Result<(), SolidError> {
        let check = |option, value: f64, is_right: bool, wanted| {
            is_right.then_some(()).ok_or(SolidError::Option { option, value, wanted })
        };
        for (option, value) in
            [("the feature angle", self.feature_angle), ("the corner angle", self.corner_angle)]
        {
            check(option, value, value > 0.0 && value < 180.0, "more than 0 and less than 180 degrees")?;
        }
        let length = self.edge_length.unwrap_or(1.0);
        check("the edge length", length, length > 0.0 && length.is_finite(), "a positive number")?;
        let hole = self.hole_size;
        check(
            "the size of holes to fill",
            hole,
            (0.0..=1.0).contains(&hole),
            "a share of the diagonal, 0 to 1",
        )
    }
}

/// What was found in a surface, and what was mended.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct SolidReport {
    /// Points with the same coordinates as others, which they were welded to.
    pub welded_points: usize,
    /// Points closer to others than a millionth of the diagonal, which they were welded to.
    pub close_points: usize,
    /// Triangles that were dropped because they had a point twice.
    pub degenerate_triangles: usize,
    /// Triangles that were dropped because others were the same.
    pub duplicate_triangles: usize,
    /// Triangles that were dropped in pairs that lay on each other and looked opposite ways: walls within the solid.
    pub wall_triangles: usize,
    /// Holes that were filled.
    pub filled_holes: Vec<FilledHole>,
    /// Triangles that were turned around.
    pub turned_triangles: usize,
    /// Triangles without height whose longest edge was flipped.
    pub flipped_triangles: usize,
    /// Points at which several fans of triangles met; each fan has a point of its own now.
    pub split_points: usize,
    /// Edges of polylines and creases of the file that are no edges of the surface.
    pub unmatched_edges: usize,
    /// Feature edges that were taken for noise.
    pub noise_edges: usize,
    /// Points of the solid.
    pub points: usize,
    /// Triangles of the solid.
    pub triangles: usize,
    /// Disjoint bodies.
    pub bodies: usize,
    /// Voids within bodies.
    pub voids: usize,
    /// Corners.
    pub corners: usize,
    /// Curves.
    pub curves: usize,
    /// Surfaces.
    pub surfaces: usize,
    /// The Euler characteristic of the boundary.
    pub euler: i64,
    /// For each surface the names of the file's groups that all of it is in, as [`TagSet::names`](crate::mesh::TagSet::names) has them;
    /// empty if the file has no groups.
    pub surface_groups: Vec<Vec<String>>,
}

impl SolidReport {
    /// What was mended, in words; nothing if the surface was sound.
    pub fn mended(&self) -> Vec<String> {
        let kinds = [
            (self.close_points, "point", "welded to others close by"),
            (self.degenerate_triangles, "triangle", "dropped for having a point twice"),
            (self.duplicate_triangles, "triangle", "dropped for being there twice"),
            (self.wall_triangles, "triangle", "of inner walls or of sheets without thickness dropped"),
            (self.filled_holes.len(), "hole", "filled"),
            (self.turned_triangles, "triangle", "turned outward"),
            (self.flipped_triangles, "flat triangle", "flipped"),
            (self.split_points, "point", "split where parts touched"),
        ];
        let plural = |count: usize| if count == 1 { "" } else { "s" };
        let is_some = kinds.iter().filter(|(count, ..)| *count > 0);
        is_some.map(|&(count, noun, what)| format!("{count} {noun}{} {what}", plural(count))).collect()
    }
}

/// A hole that was filled.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct FilledHole {
    /// The middle of its box.
    pub at: Point,
    /// Edges of its rim.
    pub edges: usize,
}
