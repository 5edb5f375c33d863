//! What is nearest, and on which side of it a point lies.
//!
//! The sign of a distance is that of the angle-weighted pseudo-normal at the nearest point: of the face, the edge or the
//! vertex that it is on (Baerentzen and Aanaes, "Signed distance computation using the angle weighted pseudonormal",
//! 2005, who prove it right for every closed manifold surface).

use super::shell::{Shell, Triangles, next, previous, triangle_of};
use crate::geometry::{Nearest, NearestTriangle, Point, segment_weights, triangle_weights};
use crate::{Cancelled, Monitor, parallel};

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

/// Finds the nearest of the triangles of a shell, or of those of a part of it.
#[derive(Debug)]
pub(super) struct TriangleSearch {
    tree: NearestTriangle,
}

impl TriangleSearch {
    /// A search among some parts, whose triangles ascend.
    pub fn new<'a>(
        shell: &Shell,
        parts: impl IntoIterator<Item = &'a [u32]>,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let Triangles { points, triangles } = &shell.mesh;
        let numbered = |&t: &u32| (t as usize, triangles[t as usize]);
        let parts = parts.into_iter().map(|of_part| of_part.iter().map(numbered));
        Ok(Self { tree: NearestTriangle::of_groups(points.clone(), parts, monitor)? })
    }

    /// Of all triangles.
    pub fn nearest(&self, p: Point) -> Nearest {
        self.tree.nearest(p).expect("a surface has triangles")
    }

    /// How far the nearest of all triangles is.
    pub fn distance(&self, p: Point) -> f64 {
        self.tree.distance(p)
    }

    /// Of those of a part.
    pub fn nearest_of(&self, part: usize, p: Point) -> Nearest {
        self.tree.nearest_of(part, p).expect("a surface has triangles")
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
        Self { tree: NearestTriangle::of(points.windows(2).map(|w| [w[0], w[1], w[1]])), points, at }
    }

    /// The point so far along the curve from its start; its ends beyond them.
    pub fn point_at(&self, at: f64) -> Point {
        let last = self.at.len() - 1;
        let edge = self.at[1..last].partition_point(|&end| end <= at);
        let [from, to] = [self.at[edge], self.at[edge + 1]];
        let share = if to > from { ((at - from) / (to - from)).clamp(0.0, 1.0) } else { 0.0 };
        self.points[edge].lerp(self.points[edge + 1], share)
    }

    pub fn nearest(&self, p: Point) -> CurveFoot {
        let edge = self.tree.nearest(p).expect("a curve has edges").facet;
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

/// Tells on which side of a shell points lie.
#[derive(Debug)]
pub(super) struct Sides {
    /// The sum of the normals of the triangles around each vertex, weighted by their angles there.
    vertex_normals: Vec<Point>,
}

impl Sides {
    pub fn new(shell: &Shell, normals: &[Point], monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let out = shell.out_of();
        let vertex_normals = parallel::try_collect(out.len(), monitor, |v| {
            let share = |k: u32| {
                let (a, b) = (shell.along(k), -shell.along(previous(k)));
                normals[triangle_of(k)] * libm::atan2(a.cross(b).length(), a.dot(b))
            };
            shell.fan(out[v]).map(share).sum()
        })?;
        Ok(Self { vertex_normals })
    }

    /// The outward unit normal at a vertex.
    pub fn normal_at(&self, v: u32) -> Point {
        self.vertex_normals[v as usize].normalize_or_zero()
    }

    /// How far `p` is from the shell, negative inside, if the nearest point is `foot` on triangle `t`.
    pub fn signed(&self, shell: &Shell, normals: &[Point], t: usize, foot: Point, p: Point) -> f64 {
        let away = p - foot;
        away.length().copysign(away.dot(self.pseudo_normal(shell, normals, t, p)))
    }

    /// The pseudo-normal, of any length, where triangle `t` is nearest to `p`.
    fn pseudo_normal(&self, shell: &Shell, normals: &[Point], t: usize, p: Point) -> Point {
        let first = 3 * t as u32;
        let of_edge = |k: u32| normals[t] + normals[triangle_of(shell.twin(k))];
        let of_vertex = |k: u32| self.vertex_normals[shell.from(k) as usize];
        match triangle_weights(p, shell.mesh.at(t)).map(|w| w > 0.0) {
            [true, true, true] => normals[t],
            [true, true, false] => of_edge(first),
            [false, true, true] => of_edge(next(first)),
            [true, false, true] => of_edge(previous(first)),
            [true, false, false] => of_vertex(first),
            [false, true, false] => of_vertex(next(first)),
            [false, false, _] => of_vertex(previous(first)),
        }
    }
}
