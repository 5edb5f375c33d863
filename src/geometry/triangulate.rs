//! Triangulation of one polygon by clipping ears.
//!
//! Promises: a polygon of n corners gives exactly n - 2 triangles, so that buffers can be laid out
//! before anything is triangulated; every side of the polygon is a side of one triangle, collinear
//! corners included (hanging nodes keep their edges). A simple polygon, concave too, is covered once.
//! A self-intersecting or degenerate polygon is covered somehow, without failing.

use glam::{DVec2, DVec3};

/// Appends the triangles of the polygon with the given corner points to `out`, as indices into
/// `points`, oriented like the polygon.
pub fn triangulate(points: &[DVec3], out: &mut Vec<[u32; 3]>) {
    match points.len() {
        0..=2 => {}
        3 => out.push([0, 1, 2]),
        4 => out.extend(split_quad(points)),
        _ => clip_ears(&flatten(points), out),
    }
}

/// The polygon's area vector (Newell): its length is the area of a planar polygon.
pub fn area_vector(points: &[DVec3]) -> DVec3 {
    let Some(&first) = points.first() else { return DVec3::ZERO };
    points.windows(2).map(|w| (w[0] - first).cross(w[1] - first)).sum::<DVec3>() * 0.5
}

/// The diagonal that lies inside the quad; of two, the shorter.
fn split_quad(p: &[DVec3]) -> [[u32; 3]; 2] {
    let normal = area_vector(p);
    let turns = |a: usize, b: usize, c: usize| (p[b] - p[a]).cross(p[c] - p[a]).dot(normal) > 0.0;
    let first = turns(0, 1, 2) && turns(0, 2, 3);
    let second = turns(1, 2, 3) && turns(1, 3, 0);
    let second_is_shorter = p[1].distance_squared(p[3]) < p[0].distance_squared(p[2]);
    if second && (!first || second_is_shorter) { [[0, 1, 3], [1, 2, 3]] } else { [[0, 1, 2], [0, 2, 3]] }
}

/// The polygon seen along its normal, counter-clockwise: the axis of the normal's largest component
/// is dropped.
fn flatten(points: &[DVec3]) -> Vec<DVec2> {
    let normal = area_vector(points);
    let axis = normal.abs().max_position();
    let sign = if normal[axis] < 0.0 { -1.0 } else { 1.0 };
    points.iter().map(|p| DVec2::new(p[(axis + 1) % 3], p[(axis + 2) % 3] * sign)).collect()
}

/// Clips ears of a counter-clockwise polygon until a triangle is left.
fn clip_ears(p: &[DVec2], out: &mut Vec<[u32; 3]>) {
    let n = p.len();
    let mut next: Vec<usize> = (0..n).map(|i| (i + 1) % n).collect();
    let mut previous: Vec<usize> = (0..n).map(|i| (i + n - 1) % n).collect();
    let mut left = n;
    let mut tip = 0;
    let mut refused = 0;
    while left > 3 {
        let (a, c) = (previous[tip], next[tip]);
        // After a full round without an ear the polygon is not simple: clip anyway.
        if refused < left && !is_ear(p, &next, [a, tip, c]) {
            refused += 1;
            tip = c;
            continue;
        }
        out.push([a as u32, tip as u32, c as u32]);
        next[a] = c;
        previous[c] = a;
        left -= 1;
        refused = 0;
        // Step over the neighbour: ears are taken all round, which avoids fans of slivers.
        tip = next[c];
    }
    out.push([previous[tip] as u32, tip as u32, next[tip] as u32]);
}

/// True if the corner turns left and no other remaining corner lies in its triangle.
fn is_ear(p: &[DVec2], next: &[usize], [a, b, c]: [usize; 3]) -> bool {
    let triangle = [p[a], p[b], p[c]];
    if turn(triangle[0], triangle[1], triangle[2]) <= 0.0 {
        return false;
    }
    let mut i = next[c];
    while i != a {
        if !triangle.contains(&p[i]) && holds(triangle, p[i]) {
            return false;
        }
        i = next[i];
    }
    true
}

/// Twice the signed area of the triangle: positive if it turns left.
fn turn(a: DVec2, b: DVec2, c: DVec2) -> f64 {
    (b - a).perp_dot(c - a)
}

/// True if the closed, counter-clockwise triangle holds `q`.
fn holds([a, b, c]: [DVec2; 3], q: DVec2) -> bool {
    turn(a, b, q) >= 0.0 && turn(b, c, q) >= 0.0 && turn(c, a, q) >= 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(points: &[DVec3]) {
        let mut triangles = Vec::new();
        triangulate(points, &mut triangles);
        let n = points.len();
        assert_eq!(triangles.len(), n - 2);
        let normal = area_vector(points);
        let total: f64 = triangles
            .iter()
            .map(|t| area_vector(&t.map(|i| points[i as usize])).dot(normal.normalize()))
            .inspect(|a| assert!(*a >= -1e-12, "a triangle is turned over: {a}"))
            .sum();
        assert!((total - normal.length()).abs() < 1e-9 * normal.length(), "area {total}");
        for i in 0..n as u32 {
            let side = (i, (i + 1) % n as u32);
            let uses = triangles
                .iter()
                .flat_map(|&[a, b, c]| [(a, b), (b, c), (c, a)])
                .filter(|&s| s == side)
                .count();
            assert_eq!(uses, 1, "side {side:?}");
        }
    }

    fn flat(points: &[[f64; 2]], along: DVec3) -> Vec<DVec3> {
        let (u, v) = along.any_orthonormal_pair();
        points.iter().map(|p| u * p[0] + v * p[1] + along).collect()
    }

    const AXES: [DVec3; 6] = [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z];

    #[test]
    fn polygons_are_covered_once() {
        let square = [[0., 0.], [1., 0.], [1., 1.], [0., 1.]];
        let arrow = [[0., 0.], [2., 1.], [0., 2.], [0.5, 1.]];
        let arrow_turned = [[0.5, 1.], [0., 0.], [2., 1.], [0., 2.]];
        let comb = [
            [0., 0.],
            [5., 0.],
            [5., 3.],
            [4., 3.],
            [4., 1.],
            [3., 1.],
            [3., 3.],
            [2., 3.],
            [2., 1.],
            [0., 1.],
        ];
        let hanging = [[0., 0.], [1., 0.], [2., 0.], [2., 1.], [2., 2.], [1., 2.], [0., 2.], [0., 1.]];
        for axis in AXES {
            for polygon in [&square[..], &arrow, &arrow_turned, &comb, &hanging] {
                check(&flat(polygon, axis));
            }
        }
        check(&flat(&comb, DVec3::new(1.0, 2.0, -3.0).normalize()));
    }

    #[test]
    fn degenerate_polygons_give_n_minus_two_triangles() {
        let point = vec![DVec3::ONE; 7];
        let line: Vec<DVec3> = (0..6).map(|i| DVec3::X * i as f64).collect();
        let bow = vec![DVec3::ZERO, DVec3::new(1., 1., 0.), DVec3::X, DVec3::Y, DVec3::new(0.2, 3., 0.)];
        for polygon in [point, line, bow] {
            let mut triangles = Vec::new();
            triangulate(&polygon, &mut triangles);
            assert_eq!(triangles.len(), polygon.len() - 2);
        }
    }
}
