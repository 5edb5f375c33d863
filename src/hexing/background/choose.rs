//! Which background suits a solid.

use glam::DMat3;
use serde::{Deserialize, Serialize};

use crate::geometry::area_vector;
use crate::hexing::direction::PARALLEL;
use crate::solid::SolidModel;

/// The mesh that the core is cut out of (section 4).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Background {
    /// The one that is likely to capture the solid best: see [`choose`]. Another one if that does not show the solid.
    #[default]
    Auto,
    /// A quad mesh of the principal face, swept along the principal direction (section 4.2).
    Swept,
    /// A grid whose lines stand in planar surfaces.
    Grid,
    /// A layer of hexes between the two sides of a thin shell.
    Shell,
    /// A grid of twice the edge length, refined at the boundary, and more where walls are thin, gaps narrow and
    /// curves short.
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
    /// The kind; never `Auto`.
    pub kind: Background,
    /// The share of the boundary's area that a grid captures.
    pub grid_capture: f64,
    /// The share that the swept mesh captures, if there is one.
    pub swept_capture: Option<f64>,
    /// The least scaled Jacobian of the quads that would be swept, if they were made.
    pub worst_quad: Option<f64>,
}

/// A swept mesh has to capture so much more of the area than a grid: a grid's cells are better.
const GAIN: f64 = 0.03;
/// A swept mesh with worse quads is no choice.
const LEAST_QUAD: f64 = 0.15;

/// May a sweep that captures such a share of the area be chosen? Its quads need not be made if not. Free forms are not
/// swept: nobody drew them along any direction.
pub fn may_sweep(solid: &SolidModel, axes: DMat3, surface_capture: f64) -> bool {
    !solid.is_free_form() && surface_capture >= grid_capture(solid, axes) + GAIN
}

/// Chooses between backgrounds, by the boundary's area that they capture, unless one is `wanted`. `wants_levels` tells
/// that cells of several sizes are wanted all over the boundary: then it is an octree.
pub fn choose(
    solid: &SolidModel,
    axes: DMat3,
    wanted: Background,
    swept: Option<SweptScore>,
    wants_levels: bool,
) -> Choice {
    let is_better = |s: &SweptScore| s.worst_quad > LEAST_QUAD && may_sweep(solid, axes, s.surface_capture);
    let kind = match (wanted, swept) {
        (Background::Auto, _) if wants_levels => Background::Octree,
        (Background::Auto, Some(swept)) if is_better(&swept) => Background::Swept,
        (Background::Auto, _) => Background::Grid,
        (wanted, _) => wanted,
    };
    Choice {
        kind,
        grid_capture: grid_capture(solid, axes),
        swept_capture: swept.map(|s| s.surface_capture),
        worst_quad: swept.map(|s| s.worst_quad),
    }
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
    use crate::geometry::Point;
    use crate::solid::testing::{cuboid, cylinder, moved, solid};

    #[test]
    fn grids_capture_what_is_along_their_axes() {
        assert!((grid_capture(&solid(&cuboid([1, 2, 3])), DMat3::IDENTITY) - 1.0).abs() < 1e-12);
        let turn = DMat3::from_rotation_z(0.3);
        // Top and bottom alone.
        assert!((grid_capture(&solid(&cuboid([1, 2, 3])), turn) - 4.0 / 22.0).abs() < 1e-12);
    }

    #[test]
    fn free_forms_are_not_swept() {
        let ball = moved(cuboid([8, 8, 8]), |p| (p - Point::splat(4.0)).normalize());
        let may = |surface| may_sweep(&solid(surface), DMat3::IDENTITY, 1.0);
        assert!(!may(&ball) && may(&cylinder(60)));
    }

    #[test]
    fn a_sweep_is_chosen_where_it_captures_more_with_good_quads() {
        let solid = solid(&cylinder(60));
        let choice = |worst_quad, wants_levels| {
            let swept = Some(SweptScore { surface_capture: 1.0, worst_quad });
            choose(&solid, DMat3::IDENTITY, Background::Auto, swept, wants_levels).kind
        };
        assert_eq!(
            [choice(0.5, false), choice(0.1, false), choice(0.5, true)],
            [Background::Swept, Background::Grid, Background::Octree]
        );
        let without = |wanted| choose(&solid, DMat3::IDENTITY, wanted, None, false).kind;
        assert_eq!(without(Background::Auto), Background::Grid);
        assert_eq!(without(Background::Octree), Background::Octree, "as it was wanted");
    }
}
