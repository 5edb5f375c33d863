//! The closest points of segments and triangles, as weights of their ends.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4};

use super::Point;
use super::lanes::{Number, Vectors};

/// Twice a triangle's area below this share of the product of two of its edges: too thin for a normal, its
/// edges stand for it. The error is that share of an edge, far below what coordinates can tell.
const NEEDLE: f64 = 1e-12;

/// The weights of `a` and `b` in the point of segment `ab` that is closest to `p`; from 0 to 1, their sum is 1.
pub fn segment_weights(p: Point, [a, b]: [Point; 2]) -> [f64; 2] {
    let along = b - a;
    let squared = along.length_squared();
    let t = if squared > 0.0 { ((p - a).dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
    [1.0 - t, t]
}

/// The weights of a triangle's corners in its point closest to `p`; from 0 to 1, their sum is 1. Works for
/// triangles of no area too.
///
/// If `p` projects into the triangle, that is the point. Else it lies on one of the edges beyond which `p` is.
pub fn triangle_weights(p: Point, [a, b, c]: [Point; 3]) -> [f64; 3] {
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let normal = ab.cross(ac);
    let area = normal.length_squared();
    let needle = area <= NEEDLE * NEEDLE * ab.length_squared() * ac.length_squared();
    let wb = ap.cross(ac).dot(normal);
    let wc = ab.cross(ap).dot(normal);
    let wa = area - wb - wc;
    if !needle && wa >= 0.0 && wb >= 0.0 && wc >= 0.0 {
        let (wb, wc) = (wb / area, wc / area);
        return [(1.0 - wb - wc).greater(0.0), wb, wc];
    }
    let mut best = (f64::INFINITY, [1.0, 0.0, 0.0]);
    let mut offer = |beyond: bool, ends: [Point; 2], weights: fn([f64; 2]) -> [f64; 3]| {
        if beyond || needle {
            let w = segment_weights(p, ends);
            let distance = p.distance_squared(ends[0] * w[0] + ends[1] * w[1]);
            if distance < best.0 {
                best = (distance, weights(w));
            }
        }
    };
    offer(wc < 0.0, [a, b], |[a, b]| [a, b, 0.0]);
    offer(wa < 0.0, [b, c], |[b, c]| [0.0, b, c]);
    offer(wb < 0.0, [c, a], |[c, a]| [a, 0.0, c]);
    best.1
}

/// The point of segment `ab` that is closest to `p`.
pub fn closest_on_segment(p: Point, ends: [Point; 2]) -> Point {
    let [wa, wb] = segment_weights(p, ends);
    ends[0] * wa + ends[1] * wb
}

/// The point of the triangle that is closest to `p`.
pub fn closest_on_triangle(p: Point, corners: [Point; 3]) -> Point {
    let [wa, wb, wc] = triangle_weights(p, corners);
    corners[0] * wa + corners[1] * wb + corners[2] * wc
}

/// The points of four triangles that are closest to `p`, and how far they are from it, squared: as [`closest_on_triangle`]
/// tells, to the bit but for the sign of zero.
#[inline(always)]
pub(crate) fn closest_on_four<S: Simd>(
    simd: S,
    p: Vectors<f64x4<S>>,
    [a, b, c]: [Vectors<f64x4<S>>; 3],
) -> (Vectors<f64x4<S>>, f64x4<S>) {
    let (zero, one) = (f64x4::splat(simd, 0.0), f64x4::splat(simd, 1.0));
    let (ab, ac, ap) = (b - a, c - a, p - a);
    let normal = ab.cross(ac);
    let area = normal.length_squared();
    let needle = area.simd_le(ab.length_squared() * (NEEDLE * NEEDLE) * ac.length_squared());
    let wb = ap.cross(ac).dot(normal);
    let wc = ab.cross(ap).dot(normal);
    let wa = area - wb - wc;
    let is_over = !needle & wa.simd_ge(0.0) & wb.simd_ge(0.0) & wc.simd_ge(0.0);
    let (over_b, over_c) = (wb / area, wc / area);
    let point = a * (one - over_b - over_c).greater(zero) + b * over_b + c * over_c;
    let is_beyond = !is_over;
    let mut best = (point, is_over.select((p - point).length_squared(), f64x4::splat(simd, f64::INFINITY)));
    for (beyond, from, to) in [(wc, a, b), (wa, b, c), (wb, c, a)] {
        let along = to - from;
        let squared = along.length_squared();
        let share = ((p - from).dot(along) / squared).greater(zero).lesser(one);
        let t = squared.simd_gt(0.0).select(share, zero);
        let point = from * (one - t) + to * t;
        let distance = (p - point).length_squared();
        let is_nearer = is_beyond & (beyond.simd_lt(0.0) | needle) & distance.simd_lt(best.1);
        best = (best.0.replaced(is_nearer, point), is_nearer.select(distance, best.1));
    }
    best
}

#[cfg(test)]
mod tests {
    use super::*;

    const TRIANGLE: [Point; 3] = [Point::ZERO, Point::X, Point::Y];

    #[test]
    fn each_part_of_a_triangle_answers_for_its_side() {
        let cases = [
            ([0.25, 0.25, 3.0], [0.25, 0.25, 0.0]), // inside
            ([-1.0, -1.0, 1.0], [0.0, 0.0, 0.0]),   // corners
            ([3.0, -1.0, 0.0], [1.0, 0.0, 0.0]),
            ([-1.0, 3.0, 0.0], [0.0, 1.0, 0.0]),
            ([0.5, -2.0, 1.0], [0.5, 0.0, 0.0]), // edges
            ([-2.0, 0.5, 1.0], [0.0, 0.5, 0.0]),
            ([1.0, 1.0, -1.0], [0.5, 0.5, 0.0]),
        ];
        for (p, expected) in cases {
            assert_eq!(closest_on_triangle(p.into(), TRIANGLE), expected.into(), "from {p:?}");
        }
    }

    #[test]
    fn triangles_of_no_area_are_segments_and_points() {
        let line = [Point::ZERO, Point::X * 4.0, Point::X];
        assert_eq!(closest_on_triangle(Point::new(3.0, 1.0, 0.0), line), Point::X * 3.0);
        assert_eq!(closest_on_triangle(Point::new(9.0, 1.0, 0.0), line), Point::X * 4.0);
        assert_eq!(closest_on_triangle(Point::Z, [Point::X; 3]), Point::X);
        assert_eq!(closest_on_segment(Point::Z, [Point::X; 2]), Point::X);
    }

    #[cfg(not(target_arch = "wasm32"))]
    mod random {
        use proptest::prelude::*;

        use super::*;
        use crate::geometry::lanes::{Row, level};
        use crate::geometry::samples::{of_triangle, point, points};

        fn four(p: Point, triangles: &[[Point; 3]; 4]) -> ([Point; 4], Row) {
            #[inline(always)]
            fn of<S: Simd>(simd: S, p: Point, t: &[[Point; 3]; 4]) -> ([[f64; 4]; 3], Row) {
                let corner = |k: usize| Vectors::of(simd, [t[0][k], t[1][k], t[2][k], t[3][k]]);
                let p = Vectors::splat(simd, p.to_array());
                let (points, squared) = closest_on_four(simd, p, [corner(0), corner(1), corner(2)]);
                (points.store(), squared.to_array())
            }
            let ([x, y, z], squared) = fearless_simd::dispatch!(level(), simd => of(simd, p, triangles));
            ([0, 1, 2, 3].map(|k| Point::new(x[k], y[k], z[k])), squared)
        }

        proptest! {
            #[test]
            fn four_are_looked_at_as_one_is(
                p in point(3.0), corners in prop::array::uniform4(points::<3>(2.0)), thin in 0usize..5,
            ) {
                // One of them may be as thin as a line, or a point.
                let mut corners = corners;
                if let Some([a, b, c]) = corners.get_mut(thin) {
                    (*b, *c) = if thin == 0 { (*a, *a) } else { (*b, a.lerp(*b, 0.25)) };
                }
                let (points, squared) = four(p, &corners);
                for (k, &triangle) in corners.iter().enumerate() {
                    let expected = closest_on_triangle(p, triangle);
                    prop_assert_eq!(points[k], expected);
                    prop_assert_eq!(squared[k], expected.distance_squared(p));
                }
            }

            #[test]
            fn no_sample_is_closer(p in point(3.0), corners in points::<3>(2.0)) {
                let found = closest_on_triangle(p, corners).distance(p);
                let sampled = of_triangle(corners, 24).map(|s| s.distance(p)).fold(f64::INFINITY, f64::min);
                prop_assert!(found <= sampled + 1e-12);
                prop_assert!(sampled <= found + 4.0 / 12.0, "the samples are dense");
            }

            #[test]
            fn the_gap_stands_on_the_triangle(p in point(3.0), corners in points::<3>(2.0)) {
                // All of the triangle lies behind the plane through the closest point, perpendicular to the gap.
                let closest = closest_on_triangle(p, corners);
                for corner in corners {
                    prop_assert!((corner - closest).dot(p - closest) <= 1e-9);
                }
            }
        }
    }
}
