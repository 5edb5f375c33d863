//! Triangles that cross or touch where they should not.
//!
//! Lengths within the tolerance are nothing: two triangles *cross* if an edge of one goes through
//! the other and reaches beyond its plane on both sides, and *overlap* if both lie in one plane and share more than a
//! strip. Neighbours may share what they meet at.

use crate::geometry::{Aabb, BoxIndex, Point};
use crate::{Cancelled, Monitor, parallel};

/// Two triangles and a place that both have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Crossing {
    pub triangles: [u32; 2],
    pub at: Point,
}

/// All pairs of triangles that cross or overlap, ascending.
pub(crate) fn crossings(
    points: &[Point],
    triangles: &[[u32; 3]],
    tolerance: f64,
    monitor: &dyn Monitor,
) -> Result<Vec<Crossing>, Cancelled> {
    let at = |t: usize| triangles[t].map(|v| points[v as usize]);
    let bounds = |t: usize| Aabb::around(&at(t));
    let index = BoxIndex::within((0..triangles.len()).map(bounds), monitor)?;
    parallel::try_gather(triangles.len(), monitor, |t, found| {
        let first = found.len();
        for u in index.touching(&bounds(t).grown(tolerance)).filter(|&u| u > t) {
            let are_neighbours = triangles[t].iter().any(|v| triangles[u].contains(v));
            if let Some(at) = meeting(at(t), at(u), are_neighbours, tolerance) {
                found.push(Crossing { triangles: [t as u32, u as u32], at });
            }
        }
        found[first..].sort_unstable_by_key(|crossing| crossing.triangles);
    })
}

/// A place where two triangles meet that should not.
pub(crate) fn meeting(a: [Point; 3], b: [Point; 3], are_neighbours: bool, tolerance: f64) -> Option<Point> {
    let [normal_a, normal_b] = [a, b].map(|t| (t[1] - t[0]).cross(t[2] - t[0]).normalize_or_zero());
    let above_a = b.map(|p| normal_a.dot(p - a[0]));
    let above_b = a.map(|p| normal_b.dot(p - b[0]));
    for above in [above_a, above_b] {
        if above.iter().all(|&d| d > tolerance) || above.iter().all(|&d| d < -tolerance) {
            return None;
        }
    }
    if above_a.iter().chain(&above_b).all(|d| d.abs() <= tolerance) {
        return overlap(a, b, normal_a, tolerance);
    }
    // Neighbours come up to what they share; others not even to an edge, but for rounding.
    let margin = if are_neighbours { tolerance } else { -1e-3 * tolerance };
    crossed(a, normal_a, b, above_a, tolerance, margin)
        .or_else(|| crossed(b, normal_b, a, above_b, tolerance, margin))
}

/// Where an edge of `other` goes through the triangle, at least `margin` from its border.
fn crossed(
    triangle: [Point; 3],
    normal: Point,
    other: [Point; 3],
    above: [f64; 3],
    tolerance: f64,
    margin: f64,
) -> Option<Point> {
    (0..3).find_map(|i| {
        let j = (i + 1) % 3;
        let (p, q, dp, dq) = (other[i], other[j], above[i], above[j]);
        if dp.min(dq) >= -tolerance || dp.max(dq) <= tolerance {
            return None;
        }
        let at = p + (q - p) * (dp / (dp - dq));
        let is_within = (0..3).all(|k| inward(triangle, k, normal).dot(at - triangle[k]) >= margin);
        is_within.then_some(at)
    })
}

/// The unit vector in a triangle's plane that points inward from edge `k`.
fn inward(triangle: [Point; 3], k: usize, normal: Point) -> Point {
    normal.cross(triangle[(k + 1) % 3] - triangle[k]).normalize_or_zero()
}

/// A point that two triangles of one plane share, if they do not lie apart, up to a strip, across one of their edges.
fn overlap(a: [Point; 3], b: [Point; 3], normal: Point, tolerance: f64) -> Option<Point> {
    let edges = [(a, b), (b, a)].into_iter().flat_map(|(t, other)| (0..3).map(move |k| (t, other, k)));
    for (t, other, k) in edges {
        // Away from the triangle's own third corner, whichever way it is turned.
        let across = inward(t, k, normal);
        let out = if across.dot(t[(k + 2) % 3] - t[k]) > 0.0 { -across } else { across };
        let deepest = other.iter().map(|&p| out.dot(p - t[k])).fold(f64::INFINITY, f64::min);
        if deepest >= -tolerance {
            return None;
        }
    }
    let middle = |t: [Point; 3]| (t[0] + t[1] + t[2]) / 3.0;
    Some(crate::geometry::closest_on_triangle(middle(b), a))
}
