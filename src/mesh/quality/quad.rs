//! Quads: scaled Jacobian, angles, aspect.
//!
//! The measures are those of the Verdict library (Stimpson et al., Sandia report 2007-1751), per quad
//! `p0 p1 p2 p3` with unit normal `n` along `(p2 - p0) x (p3 - p1)`:
//!
//! ```text
//!  p3-----p2     at corner k:  u towards the next corner, v towards the one before, unit length
//!   |  n. |                    scaled Jacobian  min over k of n . (u x v)        1 for a rectangle
//!   |     |                    angle            of u and v about n, 0 to 360 degrees
//!  p0-----p1     of all:       aspect           longest edge * perimeter / (4 * area), 1 for a square
//! ```
//!
//! A quad without area has scaled Jacobian 0 and the largest aspect that f32 holds.

use serde::Serialize;

use super::Distribution;
use crate::geometry::Point;
use crate::mesh::{NodeId, QuadMesh};
use crate::parallel;

/// Measures of each quad of a mesh, in order of quads.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct QuadQuality {
    /// From -1 to 1; above 0 for a convex quad.
    pub scaled_jacobian: Vec<f32>,
    /// The least angle in degrees, 0 to 90 where the quad is flat and convex.
    pub min_angle: Vec<f32>,
    /// The greatest angle in degrees, 90 to 180 where the quad is flat and convex.
    pub max_angle: Vec<f32>,
    /// From 1.
    pub aspect: Vec<f32>,
}

/// Measures every quad. The same bits for any number of threads.
///
/// ```
/// use hexmill::mesh::{NodeId, QuadMesh, quality::quad_quality};
/// let positions = [[0., 0.], [2., 0.], [2., 1.], [0., 1.]].map(|[x, y]| hexmill::geometry::Point::new(x, y, 0.));
/// let mesh = QuadMesh { positions: positions.to_vec(), quads: vec![[0, 1, 2, 3].map(NodeId)] };
/// let quality = quad_quality(&mesh);
/// assert_eq!((quality.scaled_jacobian[0], quality.min_angle[0], quality.aspect[0]), (1.0, 90.0, 1.5));
/// ```
pub fn quad_quality(mesh: &QuadMesh) -> QuadQuality {
    let n = mesh.quads.len();
    let measures =
        parallel::collect(n, |q| Measures::of(mesh.quads[q].map(|n: NodeId| mesh.positions[n.index()])));
    let each = |of: fn(&Measures) -> f64| parallel::collect(n, |q| of(&measures[q]) as f32);
    QuadQuality {
        scaled_jacobian: each(|m| m.scaled_jacobian),
        min_angle: each(|m| m.min_angle),
        max_angle: each(|m| m.max_angle),
        aspect: each(|m| m.aspect.min(f64::from(f32::MAX))),
    }
}

/// The measures of one quad.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Measures {
    scaled_jacobian: f64,
    min_angle: f64,
    max_angle: f64,
    aspect: f64,
}

impl Measures {
    fn of(p: [Point; 4]) -> Self {
        let twice_area = (p[2] - p[0]).cross(p[3] - p[1]);
        let normal = twice_area.normalize_or_zero();
        let sides = [0, 1, 2, 3].map(|k| p[(k + 1) % 4] - p[k]);
        let lengths = sides.map(Point::length);
        let unit: [Point; 4] =
            std::array::from_fn(|k| if lengths[k] > 0.0 { sides[k] / lengths[k] } else { sides[k] });
        let corners = [0, 1, 2, 3].map(|k| {
            let (u, v) = (unit[k], -unit[(k + 3) % 4]);
            Turn { sine: normal.dot(u.cross(v)), cosine: u.dot(v) }
        });
        let ranks = corners.map(Turn::rank);
        let (mut least, mut most) = (0, 0);
        for k in 1..4 {
            if ranks[k] < ranks[least] {
                least = k;
            }
            if ranks[k] > ranks[most] {
                most = k;
            }
        }
        let longest = lengths.iter().copied().fold(0.0, f64::max);
        let perimeter: f64 = lengths.iter().sum();
        Self {
            scaled_jacobian: corners.iter().map(|c| c.sine).fold(f64::INFINITY, f64::min),
            min_angle: corners[least].degrees(),
            max_angle: corners[most].degrees(),
            aspect: longest * perimeter / (2.0 * twice_area.length()),
        }
    }
}

/// The angle at a corner by its sine and cosine.
#[derive(Clone, Copy)]
struct Turn {
    sine: f64,
    cosine: f64,
}

impl Turn {
    /// Grows with the angle from 0 to 4 around the circle: orders angles without an arc tangent. 0 beside an edge
    /// without length, as the angle.
    fn rank(self) -> f64 {
        let size = self.cosine.abs() + self.sine.abs();
        if size == 0.0 {
            return 0.0;
        }
        let share = self.cosine / size;
        if self.sine >= 0.0 { 1.0 - share } else { 3.0 + share }
    }

    /// From 0 to 360. Through libm, whose last bit is the same on every platform.
    fn degrees(self) -> f64 {
        // Adding zero turns -0.0 into 0.0, whose arc tangent is 0 and not 180.
        let degrees = libm::atan2(self.sine + 0.0, self.cosine + 0.0).to_degrees();
        if degrees < 0.0 { degrees + 360.0 } else { degrees }
    }
}

/// How the quads of a mesh fare as a whole.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct QualityReport {
    /// Scaled Jacobian, in 40 bins from -1 to 1.
    pub scaled_jacobian: Distribution,
    /// Least angle in degrees, in 45 bins from 0 to 90.
    pub min_angle: Distribution,
    /// Greatest angle in degrees, in 45 bins from 90 to 180.
    pub max_angle: Distribution,
    /// Aspect, in 36 bins from 1 to 10.
    pub aspect: Distribution,
}

impl QuadQuality {
    /// Sums the measures up; `None` for a mesh without quads.
    pub fn report(&self) -> Option<QualityReport> {
        Some(QualityReport {
            scaled_jacobian: Distribution::of(&self.scaled_jacobian, -1.0..1.0, 40)?,
            min_angle: Distribution::of(&self.min_angle, 0.0..90.0, 45)?,
            max_angle: Distribution::of(&self.max_angle, 90.0..180.0, 45)?,
            aspect: Distribution::of(&self.aspect, 1.0..10.0, 36)?,
        })
    }
}

#[cfg(test)]
mod tests;
