//! Which background suits a solid.

use glam::DMat3;
use serde::Serialize;

use crate::geometry::area_vector;
use crate::solid::SolidModel;

/// A kind of background.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub enum Kind {
    /// A quad mesh of the principal face, swept (section 4.2).
    Swept,
    /// A grid whose lines stand in planar surfaces.
    Grid,
    /// Such a grid, refined.
    Octree,
}

/// What a swept background would do.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SweptScore {
    /// The share of the boundary's area that is parallel or perpendicular to the direction (equation 4.1).
    pub surface_capture: f64,
    /// The least scaled Jacobian of the principal face's quads.
    pub worst_quad: f64,
}

/// Which background suits the solid best, and why.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Choice {
    /// The kind.
    pub kind: Kind,
    /// The share of the boundary's area that a grid captures.
    pub grid_capture: f64,
    /// The share that the swept mesh captures, if there is one.
    pub swept_capture: Option<f64>,
}

/// A swept mesh has to capture so much more of the area than a grid: a grid's cells are better.
const GAIN: f64 = 0.05;
/// A swept mesh with worse quads is no choice.
const LEAST_QUAD: f64 = 0.15;
/// The cosine of 2 degrees.
const PARALLEL: f64 = 0.999_390_827;

/// Chooses between backgrounds, by the boundary's area that they capture. `wants_levels` tells that cells of several sizes
/// are wanted, which an octree alone has.
pub fn choose(solid: &SolidModel, axes: DMat3, swept: Option<SweptScore>, wants_levels: bool) -> Choice {
    let grid_capture = grid_capture(solid, axes);
    let is_better = |s: &SweptScore| s.worst_quad > LEAST_QUAD && s.surface_capture >= grid_capture + GAIN;
    let kind = match swept {
        _ if wants_levels => Kind::Octree,
        Some(swept) if is_better(&swept) => Kind::Swept,
        _ => Kind::Grid,
    };
    Choice { kind, grid_capture, swept_capture: swept.map(|s| s.surface_capture) }
}

/// The share of the boundary's area that is perpendicular to one of the axes, up to 2 degrees.
pub fn grid_capture(solid: &SolidModel, axes: DMat3) -> f64 {
    let (mut captured, mut total) = (0.0, 0.0);
    for (t, &normal) in solid.normals().iter().enumerate() {
        let area = area_vector(&solid.corners_of(t)).length();
        total += area;
        if (axes.transpose() * normal).abs().max_element() >= PARALLEL {
            captured += area;
        }
    }
    captured / total
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::solid::testing::{cuboid, cylinder, solid};

    #[test]
    fn grids_capture_what_is_along_their_axes() {
        assert!((grid_capture(&solid(&cuboid([1, 2, 3])), DMat3::IDENTITY) - 1.0).abs() < 1e-12);
        let turn = DMat3::from_rotation_z(0.3);
        // Top and bottom alone.
        assert!((grid_capture(&solid(&cuboid([1, 2, 3])), turn) - 4.0 / 22.0).abs() < 1e-12);
    }

    #[test]
    fn a_sweep_is_chosen_where_it_captures_more_with_good_quads() {
        let solid = solid(&cylinder(60));
        let choice = |worst_quad, wants_levels| {
            let swept = Some(SweptScore { surface_capture: 1.0, worst_quad });
            choose(&solid, DMat3::IDENTITY, swept, wants_levels).kind
        };
        assert_eq!(
            [choice(0.5, false), choice(0.1, false), choice(0.5, true)],
            [Kind::Swept, Kind::Grid, Kind::Octree]
        );
        assert_eq!(choose(&solid, DMat3::IDENTITY, None, false).kind, Kind::Grid);
    }
}
