//! What is nearest, and on which side of it a point lies.
//!
//! The sign of a distance is that of the angle-weighted pseudo-normal at the nearest point: of the face, the edge or the
//! vertex that it is on (Baerentzen and Aanaes, "Signed distance computation using the angle weighted pseudonormal",
//! 2005, who prove it right for every closed manifold surface).

use super::shell::{Shell, next, previous, triangle_of};
use crate::geometry::{Nearest, NearestTriangle, Point, segment_weights, triangle_weights};
use crate::parallel;

/// The point of the boundary nearest to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Foot {
    /// Where it is.
    pub point: Point,
    /// The outward unit normal of its triangle.
    pub normal: Point,
    /// How far it is from the point asked for.
    pub distance: f64,
    /// Its triangle, among [`SolidModel::triangles`](super::SolidModel::triangles).
    pub triangle: u32,
}

/// The point of a curve nearest to another.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CurveFoot {
    /// Where it is.
    pub point: Point,
    /// The unit direction of its edge, from the curve's start to its end.
    pub tangent: Point,
    /// How far it is from the point asked for.
    pub distance: f64,
    /// How far it is along the curve from its start.
    pub at: f64,
}

/// Finds the nearest of some triangles of a shell.
#[derive(Debug)]
pub(super) struct TriangleSearch {
    tree: NearestTriangle,
}

impl TriangleSearch {
    pub fn new(shell: &Shell, triangles: impl IntoIterator<Item = usize>) -> Self {
        Self { tree: NearestTriangle::new(triangles.into_iter().map(|t| shell.mesh.at(t))) }
    }

    pub fn nearest(&self, p: Point) -> Nearest {
        self.tree.nearest(p).expect("a surface has triangles")
    }
}

/// Finds the nearest point of a curve.
#[derive(Debug)]
pub(super) struct CurveSearch {
    /// The edges, as triangles without area.
    tree: NearestTriangle,
    points: Vec<Point>,
    /// How far along the curve each of the points is.
    at: Vec<f64>,
}

impl CurveSearch {
    /// A search of the curve through `points`.
    pub fn new(points: Vec<Point>) -> Self {
        let mut at = vec![0.0];
        for pair in points.windows(2) {
            at.push(at[at.len() - 1] + pair[0].distance(pair[1]));
        }
        Self { tree: NearestTriangle::new(points.windows(2).map(|w| [w[0], w[1], w[1]])), points, at }
    }

    pub fn nearest(&self, p: Point) -> CurveFoot {
        let edge = self.tree.nearest(p).expect("a curve has edges").triangle;
        let [a, b] = [self.points[edge], self.points[edge + 1]];
        let [wa, wb] = segment_weights(p, [a, b]);
        let point = a * wa + b * wb;
        CurveFoot {
            point,
            tangent: (b - a).normalize_or_zero(),
            distance: point.distance(p),
            at: self.at[edge] + (self.at[edge + 1] - self.at[edge]) * wb,
        }
    }
}

/// The sum of the normals of the triangles around each vertex, weighted by their angles there.
pub(super) fn vertex_normals(shell: &Shell, normals: &[Point]) -> Vec<Point> {
    let out = shell.out_of();
    parallel::collect(out.len(), |v| {
        let share = |k: u32| {
            let (a, b) = (shell.along(k), -shell.along(previous(k)));
            normals[triangle_of(k)] * libm::atan2(a.cross(b).length(), a.dot(b))
        };
        shell.fan(out[v]).map(share).sum()
    })
}

/// The pseudo-normal at the point of triangle `t` that is nearest to `p`, of any length.
pub(super) fn pseudo_normal(
    shell: &Shell,
    normals: &[Point],
    vertex_normals: &[Point],
    t: usize,
    p: Point,
) -> Point {
    let weights = triangle_weights(p, shell.mesh.at(t));
    let first = 3 * t as u32;
    match weights.map(|w| w > 0.0) {
        [true, true, true] => normals[t],
        [true, false, false] => vertex_normals[shell.from(first) as usize],
        [false, true, false] => vertex_normals[shell.from(next(first)) as usize],
        [false, false, true] => vertex_normals[shell.from(previous(first)) as usize],
        [a, b, _] => {
            let k = first
                + if a && b {
                    0
                } else if b {
                    1
                } else {
                    2
                };
            normals[t] + normals[triangle_of(shell.twin(k))]
        }
    }
}
