//! The direction along which a swept mesh would capture most of a solid (section 4.1.1).
//!
//! 1. Candidates are the normals of planes, the axes of extruded surfaces, and the mean normals of the others; those
//!    within 2 degrees are one.
//! 2. Each is given the paper's metric, equations 4.1 to 4.4, on the triangles.
//!
//! Departures: the mean normal is over the triangles, not over 10 x 10 samples. The paper takes mean normals for
//! cylinders too, which for a whole one is no direction at all; here their axes are taken. Equation 4.2 would be negative
//! where the swept volume is more than twice the solid's: then it is 0.

use serde::Serialize;

use super::clusters::{Weighted, axes, clusters, is_parallel, is_perpendicular, means, planes};
use super::silhouette::shadow;
use crate::geometry::{Point, area_vector};
use crate::solid::SolidModel;
use crate::{Cancelled, Monitor, parallel};

/// So many of the candidates, those with the most area, are measured.
const CANDIDATES: usize = 24;
/// Above this share of captured area, the volume counts too (equation 4.4).
const MOSTLY_CAPTURED: f64 = 0.85;

/// A candidate for the principal direction and its metrics.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct DirectionScore {
    /// The unit direction; its greatest component is positive.
    pub direction: Point,
    /// The area of the surfaces that suggest it.
    pub area: f64,
    /// The share of the boundary's area that is parallel or perpendicular to it, up to 2 degrees (equation 4.1).
    pub surface_capture: f64,
    /// How well the solid's shadow, swept along its length, agrees with its volume, from 0 to 1 (equation 4.2).
    pub volume_capture: f64,
    /// Both together (equations 4.3 and 4.4).
    pub score: f64,
}

/// The candidates for the principal direction, the best first; none on shapes without a plane or an axis.
///
/// # Errors
/// If the monitor stops it.
pub fn principal_directions(
    solid: &SolidModel,
    monitor: &dyn Monitor,
) -> Result<Vec<DirectionScore>, Cancelled> {
    let mut candidates = clusters([planes(solid), axes(solid), means(solid)].concat());
    candidates.truncate(CANDIDATES);
    let volume = solid.volume();
    let mut scores =
        parallel::try_collect(candidates.len(), monitor, |c| score(solid, volume, candidates[c]))?;
    parallel::put_greatest_first(&mut scores, |score| score.score);
    Ok(scores)
}

fn score(solid: &SolidModel, volume: f64, candidate: Weighted) -> DirectionScore {
    let d = candidate.direction;
    let mut captured = 0.0;
    for (t, &normal) in solid.normals().iter().enumerate() {
        if is_parallel(normal, d) || is_perpendicular(normal, d) {
            captured += area_vector(&solid.corners_of(t)).length();
        }
    }
    let surface_capture = captured / solid.area();
    let shadow = shadow(solid, d);
    let volume_capture = (1.0 - (shadow.area * shadow.depth - volume).abs() / volume).clamp(0.0, 1.0);
    let lambda =
        if surface_capture <= MOSTLY_CAPTURED { 1.0 } else { 1.0 + MOSTLY_CAPTURED - surface_capture };
    DirectionScore {
        direction: if d[d.abs().max_position()] < 0.0 { -d } else { d },
        area: candidate.area,
        surface_capture,
        volume_capture,
        score: lambda * surface_capture + (1.0 - lambda) * volume_capture,
    }
}
