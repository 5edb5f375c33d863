//! Triangles in space: closest points and exact distances.

use super::{Aabb, Point};

/// A triangle by its corners. It may be a segment or a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle(pub [Point; 3]);

impl Triangle {
    /// The smallest box around it.
    pub fn bounds(&self) -> Aabb {
        Aabb::around(&self.0)
    }

    /// The point of the triangle that is nearest to `p`, found by the region of the triangle's plane that
    /// `p` lies over: a corner's, a side's or the inside (Ericson, Real-Time Collision Detection, 5.1.5).
    pub fn closest_point(&self, p: Point) -> Point {
        let [a, b, c] = self.0;
        let (ab, ac, ap) = (b - a, c - a, p - a);
        let (d1, d2) = (ab.dot(ap), ac.dot(ap));
        if d1 <= 0.0 && d2 <= 0.0 {
            return a;
        }
        let bp = p - b;
        let (d3, d4) = (ab.dot(bp), ac.dot(bp));
        if d3 >= 0.0 && d4 <= d3 {
            return b;
        }
        let cp = p - c;
        let (d5, d6) = (ab.dot(cp), ac.dot(cp));
        if d6 >= 0.0 && d5 <= d6 {
            return c;
        }
        let (va, vb, vc) = (d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2);
        let area = va + vb + vc;
        if va > 0.0 && vb > 0.0 && vc > 0.0 && area > 0.0 {
            return a + ab * (vb / area) + ac * (vc / area);
        }
        self.closest_on_sides(p)
    }

    fn closest_on_sides(&self, p: Point) -> Point {
        let [a, b, c] = self.0;
        let mut best = closest_on_segment(p, [a, b]);
        for side in [[b, c], [c, a]] {
            let q = closest_on_segment(p, side);
            if q.distance_squared(p) < best.distance_squared(p) {
                best = q;
            }
        }
        best
    }

    /// The square of the distance from `p`.
    pub fn distance_squared(&self, p: Point) -> f64 {
        self.closest_point(p).distance_squared(p)
    }

    /// The square of the distance between two triangles; 0 if they meet.
    pub fn distance_squared_to(&self, other: &Self) -> f64 {
        if self.is_pierced_by(other) || other.is_pierced_by(self) {
            return 0.0;
        }
        // Triangles that do not pierce each other are nearest at a corner of one or at sides of both.
        let corners =
            |t: &Self, u: &Self| t.0.iter().map(|&p| u.distance_squared(p)).fold(f64::INFINITY, f64::min);
        let mut least = corners(self, other).min(corners(other, self));
        for side in self.sides() {
            for other_side in other.sides() {
                least = least.min(segments_distance_squared(side, other_side));
            }
        }
        least
    }

    fn sides(&self) -> [[Point; 2]; 3] {
        let [a, b, c] = self.0;
        [[a, b], [b, c], [c, a]]
    }

    /// True if a side of `other` passes through the inside of `self`. Sides in the plane of `self` do
    /// not count: those come near a side or a corner.
    fn is_pierced_by(&self, other: &Self) -> bool {
        let [a, b, c] = self.0;
        let volume = |p: Point, q: Point, r: Point, s: Point| (q - p).cross(r - p).dot(s - p);
        other.sides().iter().any(|&[p, q]| {
            if volume(a, b, c, p) * volume(a, b, c, q) >= 0.0 {
                return false;
            }
            let turns = [volume(p, q, a, b), volume(p, q, b, c), volume(p, q, c, a)];
            turns.iter().all(|&v| v > 0.0) || turns.iter().all(|&v| v < 0.0)
        })
    }
}

/// The point of a segment that is nearest to `p`.
pub fn closest_on_segment(p: Point, [a, b]: [Point; 2]) -> Point {
    let along = b - a;
    let t = (p - a).dot(along) / along.length_squared();
    // Also false where the segment is a point and t is no number.
    if t > 0.0 { a + along * t.min(1.0) } else { a }
}

/// The square of the distance between two segments, which may be points (Ericson, 5.1.9).
pub fn segments_distance_squared([p, p_end]: [Point; 2], [q, q_end]: [Point; 2]) -> f64 {
    let (u, v, w) = (p_end - p, q_end - q, p - q);
    let (uu, vv, uv) = (u.length_squared(), v.length_squared(), u.dot(v));
    let determinant = uu * vv - uv * uv;
    // Parallel segments: any start will do, the clamped answer from the other side is right.
    let s =
        if determinant > 0.0 { ((uv * v.dot(w) - vv * u.dot(w)) / determinant).clamp(0.0, 1.0) } else { 0.0 };
    let on_q = closest_on_segment(p + u * s, [q, q_end]);
    let on_p = closest_on_segment(on_q, [p, p_end]);
    let on_q = closest_on_segment(on_p, [q, q_end]);
    let inner = on_p.distance_squared(on_q);
    let ends = [p, p_end].map(|e| closest_on_segment(e, [q, q_end]).distance_squared(e));
    let other_ends = [q, q_end].map(|e| closest_on_segment(e, [p, p_end]).distance_squared(e));
    inner.min(ends[0]).min(ends[1]).min(other_ends[0]).min(other_ends[1])
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::geometry::testing::{point, samples, triangle};
    use proptest::prelude::*;

    #[test]
    fn closest_points_over_corners_sides_and_the_inside() {
        let t = Triangle([Point::ZERO, Point::new(4., 0., 0.), Point::new(0., 4., 0.)]);
        let cases = [
            ([-1., -1., 2.], [0., 0., 0.]),
            ([9., -1., 0.], [4., 0., 0.]),
            ([-1., 9., 0.], [0., 4., 0.]),
            ([1., -3., 1.], [1., 0., 0.]),
            ([-2., 2., 1.], [0., 2., 0.]),
            ([4., 4., -1.], [2., 2., 0.]),
            ([1., 1., 7.], [1., 1., 0.]),
        ];
        for (p, expected) in cases {
            assert_eq!(t.closest_point(p.into()), Point::from(expected), "from {p:?}");
        }
    }

    #[test]
    fn triangles_may_be_segments_or_points() {
        let (a, b) = (Point::new(1., 0., 0.), Point::new(3., 0., 0.));
        for corners in [[a, b, b], [b, a, b], [a, b, a.midpoint(b)], [b, b, a]] {
            assert_eq!(Triangle(corners).closest_point(Point::new(2.5, 1., 0.)), Point::new(2.5, 0., 0.));
            assert_eq!(Triangle(corners).closest_point(Point::new(9., 1., 0.)), b);
        }
        assert_eq!(Triangle([a; 3]).closest_point(b), a);
        assert_eq!(Triangle([a; 3]).distance_squared_to(&Triangle([b; 3])), 4.0);
    }

    #[test]
    fn crossing_triangles_have_no_distance() {
        let flat = Triangle([Point::ZERO, Point::new(4., 0., 0.), Point::new(0., 4., 0.)]);
        let through = Triangle([Point::new(1., 1., -1.), Point::new(1., 1., 1.), Point::new(9., 9., 1.)]);
        assert_eq!(flat.distance_squared_to(&through), 0.0);
        let inside = Triangle([Point::new(1., 1., 0.), Point::new(1.5, 1., 0.), Point::new(1., 1.5, 0.)]);
        assert_eq!(flat.distance_squared_to(&inside), 0.0);
        let above = Triangle(inside.0.map(|p| p + Point::Z * 0.5));
        assert_eq!(flat.distance_squared_to(&above), 0.25);
    }

    proptest! {
        #[test]
        fn no_sample_is_nearer_than_the_closest_point(t in triangle(), p in point()) {
            let q = t.closest_point(p);
            let sampled = samples(&t, 40).map(|s| s.distance(p)).fold(f64::INFINITY, f64::min);
            prop_assert!(q.distance(p) <= sampled + 1e-12);
            prop_assert!(samples(&t, 40).any(|s| s.distance(q) < 0.1), "the closest point is on the triangle");
        }

        #[test]
        fn distances_of_triangles_agree_with_samples(t in triangle(), u in triangle()) {
            let exact = t.distance_squared_to(&u).sqrt();
            let sampled = samples(&t, 60).map(|s| u.distance_squared(s).sqrt()).fold(f64::INFINITY, f64::min);
            // No point of `t` is farther from a sample than the sampling step.
            prop_assert!(exact <= sampled + 1e-9, "{exact} > {sampled}");
            prop_assert!(sampled <= exact + 4.0 / 60.0, "{sampled} >> {exact}");
            prop_assert!((exact - u.distance_squared_to(&t).sqrt()).abs() < 1e-9);
        }

        #[test]
        fn distances_of_segments_agree_with_samples(a in [point(), point()], b in [point(), point()]) {
            let exact = segments_distance_squared(a, b).sqrt();
            let along = |i: i32| a[0].lerp(a[1], f64::from(i) / 200.0);
            let sampled = (0..=200).map(along).map(|s| closest_on_segment(s, b).distance(s)).fold(f64::INFINITY, f64::min);
            prop_assert!(exact <= sampled + 1e-9 && sampled <= exact + 4.0 / 200.0);
        }
    }
}
