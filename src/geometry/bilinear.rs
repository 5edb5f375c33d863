//! The bilinear surface through the corners of a quad.

use super::{Point, segment_weights};

/// Steps towards the closest point, at most: half a dozen are enough where the quad is not folded.
const STEPS: usize = 32;

/// The point with shares `u` and `v` is `a (1-u) (1-v) + b u (1-v) + c u v + d (1-u) v` of the corners `a`, `b`, `c`, `d`,
/// which go around. The surface is what hexes have for a face, and is in the hull of the corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BilinearQuad {
    /// The corners, in order around the quad.
    pub corners: [Point; 4],
}

impl BilinearQuad {
    /// How far the corners are from one plane: half the distance between the diagonals, as lines.
    pub fn warp(&self) -> f64 {
        let [a, b, c, d] = self.corners;
        (0.5 * (b - a).dot((c - a).cross(d - b).normalize_or_zero())).abs()
    }

    /// The point at these shares.
    pub fn point(&self, [u, v]: [f64; 2]) -> Point {
        let [a, b, c, d] = self.corners;
        (a * (1.0 - u) + b * u) * (1.0 - v) + (d * (1.0 - u) + c * u) * v
    }

    /// The unit normal there, by which the corners turn left; zero where there is none.
    pub fn normal(&self, at: [f64; 2]) -> Point {
        let [along_u, along_v] = self.slopes(at);
        along_u.cross(along_v).normalize_or_zero()
    }

    /// The shares, from 0 to 1, of the point that is closest to `p`, which is to be nearer than the quad is large and
    /// folded; else it may be one that is closer than all of the sides and than those around it alone.
    pub fn closest(&self, p: Point) -> [f64; 2] {
        let closer = |a: [f64; 2], b: [f64; 2]| {
            if self.point(b).distance_squared(p) < self.point(a).distance_squared(p) { b } else { a }
        };
        let found = self.descend([0.5; 2], p);
        let nearest = self.on_sides(p).into_iter().fold(found, closer);
        if nearest == found { found } else { self.descend(nearest, p) }
    }

    /// The closest point of each side.
    fn on_sides(&self, p: Point) -> [[f64; 2]; 4] {
        let [a, b, c, d] = self.corners;
        let [bottom, right, top, left] =
            [[a, b], [b, c], [d, c], [a, d]].map(|ends| segment_weights(p, ends)[1]);
        [[bottom, 0.0], [1.0, right], [top, 1.0], [0.0, left]]
    }

    /// Goes from a point to one that is closer to `p` than those around it.
    ///
    /// Newton's steps within the square of shares: a share at its end stays there if it would go beyond. Where such a
    /// step goes no closer, along u and then along v, where the surface is straight and the closest point is known.
    fn descend(&self, mut at: [f64; 2], p: Point) -> [f64; 2] {
        let distance = |at: [f64; 2]| self.point(at).distance_squared(p);
        let mut nearest = distance(at);
        for _ in 0..STEPS {
            let mut next = self.newton(at, p);
            if distance(next) >= nearest {
                next = self.along_each(at, p);
            }
            let closer = distance(next);
            if closer >= nearest {
                break;
            }
            (at, nearest) = (next, closer);
        }
        at
    }

    /// The derivatives by the shares.
    fn slopes(&self, [u, v]: [f64; 2]) -> [Point; 2] {
        let [a, b, c, d] = self.corners;
        [(b - a) * (1.0 - v) + (c - d) * v, (d - a) * (1.0 - u) + (c - b) * u]
    }

    /// Newton's step for half the squared distance.
    fn newton(&self, at: [f64; 2], p: Point) -> [f64; 2] {
        let [a, b, c, d] = self.corners;
        let away = self.point(at) - p;
        let [along_u, along_v] = self.slopes(at);
        let gradient = [along_u, along_v].map(|slope| slope.dot(away));
        let [uu, vv] = [along_u, along_v].map(|slope| slope.length_squared());
        let stays = |k: usize| at[k] <= 0.0 && gradient[k] > 0.0 || at[k] >= 1.0 && gradient[k] < 0.0;
        let step = match [stays(0), stays(1)] {
            [false, false] => {
                let twist = a - b + c - d;
                let straight = along_u.dot(along_v);
                let full = straight + twist.dot(away);
                // Far from the surface the distance may not be convex: there the twist is left out.
                let uv = if uu * vv > full * full { full } else { straight };
                let determinant = uu * vv - uv * uv;
                [vv * gradient[0] - uv * gradient[1], uu * gradient[1] - uv * gradient[0]]
                    .map(|part| part / determinant)
            }
            [is_u, is_v] => {
                [if is_u { 0.0 } else { gradient[0] / uu }, if is_v { 0.0 } else { gradient[1] / vv }]
            }
        };
        [0, 1].map(|k| if step[k].is_finite() { (at[k] - step[k]).clamp(0.0, 1.0) } else { at[k] })
    }

    /// The closest point along u, and then along v.
    fn along_each(&self, [u, v]: [f64; 2], p: Point) -> [f64; 2] {
        let onto = |share: f64, slope: Point, away: Point| {
            let step = slope.dot(away) / slope.length_squared();
            if step.is_finite() { (share - step).clamp(0.0, 1.0) } else { share }
        };
        let u = onto(u, self.slopes([u, v])[0], self.point([u, v]) - p);
        [u, onto(v, self.slopes([u, v])[1], self.point([u, v]) - p)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn twisted(by: f64) -> BilinearQuad {
        BilinearQuad { corners: [Point::ZERO, Point::X, Point::new(1.0, 1.0, by), Point::Y] }
    }

    #[test]
    fn corners_turn_left_around_the_normal() {
        let quad = twisted(0.5);
        assert_eq!([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|at| quad.point(at)), quad.corners);
        assert_eq!(quad.normal([0.0, 0.0]), Point::Z);
        assert!((quad.point([0.5; 2]) - Point::new(0.5, 0.5, 0.125)).length() < 1e-15);
    }

    #[test]
    fn the_warp_is_half_of_what_parts_the_diagonals() {
        assert_eq!(twisted(0.0).warp(), 0.0);
        let lifted = [0.5, -0.5, 0.5, -0.5];
        let at = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let corners = [0, 1, 2, 3].map(|k| Point::new(at[k][0], at[k][1], lifted[k]));
        assert!((BilinearQuad { corners }.warp() - 0.5).abs() < 1e-15);
        assert_eq!(BilinearQuad { corners: [Point::ONE; 4] }.warp(), 0.0);
    }

    #[test]
    fn points_above_the_surface_fall_back_on_it() {
        for by in [0.0, 0.1, 0.7, -0.7] {
            let quad = twisted(by);
            for k in 0..121 {
                let at = [k % 11, k / 11].map(|i| f64::from(i) / 10.0);
                for height in [-0.2, 0.0, 0.1] {
                    let found = quad.closest(quad.point(at) + quad.normal(at) * height);
                    let error = (found[0] - at[0]).abs().max((found[1] - at[1]).abs());
                    assert!(error < 1e-7, "{by}, {height}: {at:?} became {found:?}");
                }
            }
        }
    }

    /// From the middle one gets to a point of the inside that is closer than those around it, and farther than a side.
    #[test]
    fn a_side_may_be_closer_than_what_the_middle_leads_to() {
        let corners = [
            Point::new(0.2234174161178692, 0.0, -0.19034133843752682),
            Point::new(1.2228375451948404, 0.1301261259672327, 0.24862921198968413),
            Point::new(0.7702559200578473, 0.9098998686302513, 0.09357966708561988),
            Point::new(0.18931632420428257, 1.0476824495144054, 0.21003880765731914),
        ];
        let (quad, p) = (
            BilinearQuad { corners },
            Point::new(0.8817004633191856, 0.6224376515609582, -0.4637692373388988),
        );
        assert_eq!(quad.descend([0.5; 2], p).map(|share| (share * 100.0).round()), [87.0, 66.0]);
        let [u, v] = quad.closest(p);
        assert_eq!([u, (v * 1000.0).round()], [1.0, 775.0]);
    }

    #[test]
    fn what_has_no_area_has_closest_points_too() {
        let point = BilinearQuad { corners: [Point::X; 4] };
        assert_eq!(point.point(point.closest(Point::Y)), Point::X);
        assert_eq!(point.normal([0.5; 2]), Point::ZERO);
        let line = BilinearQuad { corners: [Point::ZERO, Point::X, Point::X, Point::ZERO] };
        let found = line.point(line.closest(Point::new(0.3, 2.0, 0.0)));
        assert!((found - Point::X * 0.3).length() < 1e-15, "{found}");
    }

    #[cfg(not(target_arch = "wasm32"))]
    mod random {
        use proptest::prelude::*;

        use super::*;
        use crate::geometry::samples::{point, points};

        proptest! {
            #[test]
            fn no_sample_is_closer(p in point(1.0), moved in points::<4>(0.25)) {
                let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
                let quad = BilinearQuad {
                    corners: [0, 1, 2, 3].map(|k| Point::new(square[k][0], square[k][1], 0.0) + moved[k]),
                };
                let p = Point::new(p.x + 0.5, p.y + 0.5, 0.5 * p.z);
                let found = quad.closest(p);
                prop_assert!(found.iter().all(|share| (0.0..=1.0).contains(share)));
                let distance = quad.point(found).distance(p);
                for k in 0..33 * 33 {
                    let at = [k % 33, k / 33].map(|i| f64::from(i) / 32.0);
                    prop_assert!(distance <= quad.point(at).distance(p) + 1e-9, "{:?} {:?}", at, found);
                }
            }
        }
    }
}
