//! Hexes: scaled Jacobian, aspect, volume, and whether the Jacobian is positive inside.
//!
//! ```text
//!         c
//!         |   b      at each of the eight corners: a, b, c towards its neighbours, right-handed, unit length
//!         |  /       scaled Jacobian  min over the corners of a . (b x c)     1 for a box
//!         | /        aspect           longest edge / shortest edge            1 for a cube
//!         o-----a    volume           of the trilinear hex, negative where it is inside out
//! ```
//!
//! Verdict also asks the hex's centre for its scaled Jacobian; here [`is_positive`] answers for all of the inside.
//! A hex with an edge of no length has scaled Jacobian 0 or less and the largest aspect that f32 holds.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f64x4};
use serde::Serialize;

use super::bernstein::{Certainty, is_positive};
use super::{Distribution, Summary};
use crate::geometry::Point;
use crate::geometry::lanes::{LANES, Number, Vector, Vectors, level};
use crate::mesh::numbering::hex::{EDGE_BETWEEN, EDGES, NEIGHBOURS};
use crate::mesh::{HexMesh, hex_volume};
use crate::{Cancelled, Monitor, Silent, parallel};

/// Measures of each hex of a mesh, in order of hexes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HexQuality {
    /// From -1 to 1; above 0 where all corners are positive.
    pub scaled_jacobian: Vec<f32>,
    /// From 1.
    pub aspect: Vec<f32>,
    /// In the mesh's unit of length, cubed.
    pub volume: Vec<f32>,
    /// Whether the Jacobian is positive in all of the hex.
    pub positive: Vec<Certainty>,
    /// The sum of the volumes before they were rounded.
    pub total_volume: f64,
}

/// Measures every hex. The same bits for any number of threads.
///
/// ```
/// use hexmill::mesh::{HexMesh, NodeId, numbering::hex::CORNERS, quality::hex_quality};
/// let positions = CORNERS.map(|[x, y, z]| hexmill::geometry::Point::new(2.0 * f64::from(x), y.into(), z.into()));
/// let hexes = vec![[0, 1, 2, 3, 4, 5, 6, 7].map(NodeId)];
/// let quality = hex_quality(&HexMesh { positions: positions.to_vec(), hexes, ..Default::default() });
/// assert_eq!((quality.scaled_jacobian[0], quality.aspect[0], quality.total_volume), (1.0, 2.0, 2.0));
/// ```
pub fn hex_quality(mesh: &HexMesh) -> HexQuality {
    hex_quality_within(mesh, &Silent).expect("nobody stops it")
}

/// As [`hex_quality`], told by a monitor when to stop.
///
/// # Errors
/// If the monitor stops it.
pub fn hex_quality_within(mesh: &HexMesh, monitor: &dyn Monitor) -> Result<HexQuality, Cancelled> {
    let count = mesh.hexes.len();
    let corners = |h: usize| mesh.hexes[h].map(|n| mesh.positions[n.index()]);
    let measured = |measure: &(dyn Fn(&[Point; 8]) -> f64 + Sync)| {
        parallel::try_collect(count, monitor, |h| measure(&corners(h)) as f32)
    };
    let volumes: Vec<f64> = parallel::try_collect(count, monitor, |h| hex_volume(&corners(h)))?;
    Ok(HexQuality {
        scaled_jacobian: measured(&scaled_jacobian)?,
        aspect: measured(&|corners| aspect(corners).min(f64::from(f32::MAX)))?,
        positive: parallel::try_collect(count, monitor, |h| is_positive(&corners(h)))?,
        total_volume: volumes.iter().sum(),
        volume: volumes.into_iter().map(|v| v as f32).collect(),
    })
}

/// The least scaled Jacobian of the eight corners, which are in the order of VTK_HEXAHEDRON.
pub fn scaled_jacobian(corners: &[Point; 8]) -> f64 {
    corner_scaled_jacobians(corners).into_iter().fold(f64::INFINITY, f64::min)
}

/// The least scaled Jacobians of four hexes.
pub(super) fn scaled_jacobians(hexes: &[[Point; 8]; LANES]) -> [f64; LANES] {
    #[inline(always)]
    fn least<S: Simd>(simd: S, hexes: &[[Point; 8]; LANES]) -> [f64; LANES] {
        let jacobians = at_corners(&Vectors::corners(simd, hexes), f64x4::splat(simd, 0.0));
        jacobians
            .into_iter()
            .fold(f64x4::splat(simd, f64::INFINITY), |least, jacobian| least.lesser(jacobian))
            .to_array()
    }
    dispatch!(level(), simd => least(simd, hexes))
}

/// The determinant of the unit vectors along the three edges of each corner, from -1 to 1; 0 at the ends of an edge
/// of no length.
pub fn corner_scaled_jacobians(corners: &[Point; 8]) -> [f64; 8] {
    at_corners(corners, 0.0)
}

#[inline(always)]
fn at_corners<V: Vector>(corners: &[V; 8], zero: V::Number) -> [V::Number; 8] {
    let mut units = [corners[0]; 12];
    for (unit, [low, high]) in units.iter_mut().zip(EDGES) {
        *unit = (corners[usize::from(high)] - corners[usize::from(low)]).normalize_or_zero();
    }
    let mut jacobians = [zero; 8];
    for (jacobian, [a, b, c]) in jacobians.iter_mut().zip(SPOKES) {
        let [a, b, c] = [along(&units, a), along(&units, b), along(&units, c)];
        *jacobian = a.dot(b.cross(c));
    }
    jacobians
}

/// An edge's unit vector, away from a corner.
#[inline(always)]
fn along<V: Vector>(units: &[V; 12], (edge, sign): (u8, f64)) -> V {
    units[usize::from(edge)] * sign
}

/// The edges at each corner in the order of [`NEIGHBOURS`], with -1 for those that arrive there.
const SPOKES: [[(u8, f64); 3]; 8] = {
    let (mut all, mut k) = ([[(0, 1.0); 3]; 8], 0);
    while k < 8 {
        let mut i = 0;
        while i < 3 {
            let edge = EDGE_BETWEEN[k][NEIGHBOURS[k][i] as usize];
            all[k][i] = (edge, if EDGES[edge as usize][0] as usize == k { 1.0 } else { -1.0 });
            i += 1;
        }
        k += 1;
    }
    all
};

/// The longest edge of a hex over the shortest.
pub fn aspect(corners: &[Point; 8]) -> f64 {
    let squared = EDGES.map(|ends| {
        let [a, b] = ends.map(|end| corners[usize::from(end)]);
        a.distance_squared(b)
    });
    let longest = squared.into_iter().fold(0.0, f64::max);
    let shortest = squared.into_iter().fold(f64::INFINITY, f64::min);
    if shortest > 0.0 { (longest / shortest).sqrt() } else { f64::INFINITY }
}

/// How the hexes of a mesh fare as a whole.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct HexQualityReport {
    /// Scaled Jacobian, in 40 bins from -1 to 1.
    pub scaled_jacobian: Distribution,
    /// Aspect, in 36 bins from 1 to 10.
    pub aspect: Distribution,
    /// Volume, without bins: its range is the mesh's own.
    pub volume: Summary,
    /// The volume of all hexes.
    pub total_volume: f64,
    /// Hexes whose Jacobian is not positive somewhere.
    pub not_positive: usize,
    /// Hexes of which that could not be told.
    pub undecided: usize,
}

impl HexQuality {
    /// Sums the measures up; `None` for a mesh without hexes.
    pub fn report(&self) -> Option<HexQualityReport> {
        let count = |of: Certainty| self.positive.iter().filter(|&&c| c == of).count();
        Some(HexQualityReport {
            scaled_jacobian: Distribution::of(&self.scaled_jacobian, -1.0..1.0, 40)?,
            aspect: Distribution::of(&self.aspect, 1.0..10.0, 36)?,
            volume: Summary::of(&self.volume)?,
            total_volume: self.total_volume,
            not_positive: count(Certainty::NotPositive),
            undecided: count(Certainty::Undecided),
        })
    }
}

#[cfg(test)]
mod tests;
