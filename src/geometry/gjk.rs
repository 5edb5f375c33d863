//! How near two convex bodies come: the algorithm of Gilbert, Johnson and Keerthi (1988).
//!
//! The distance of two bodies is that of the origin from their difference. The algorithm walks towards the origin on
//! simplices with corners in the difference. It knows an upper bound of the distance, its simplex, and a lower
//! bound, the plane through the farthest corner towards the origin; a question "nearer than so much" is answered as
//! soon as one of them tells.

use super::{Point, segment_weights, triangle_weights};

/// A convex body, known by its farthest point in any direction.
pub trait Convex {
    /// A point of the body that is farthest in `direction`; any point of it for the zero vector.
    fn support(&self, direction: Point) -> Point;
}

impl<const N: usize> Convex for [Point; N] {
    /// The hull of the points.
    fn support(&self, direction: Point) -> Point {
        let mut best = (f64::NEG_INFINITY, self[0]);
        for &p in self {
            let far = p.dot(direction);
            if far > best.0 {
                best = (far, p);
            }
        }
        best.1
    }
}

/// Polyhedra take less than ten steps; a round body that is neither near nor far by [`CLOSE`] a few more.
const MOST_STEPS: usize = 64;

/// Bounds this close to each other, as a share of the distance squared, are one.
const CLOSE: f64 = 1e-12;

/// True if the hull of `points` and `body` come as near as `distance`, or nearer.
pub fn hull_within<const N: usize>(points: &[Point; N], body: &impl Convex, distance: f64) -> bool {
    let limit = distance * distance;
    let mut simplex = Simplex::of(points[0] - body.support(Point::ZERO));
    let mut nearest = simplex.corners[0];
    for _ in 0..MOST_STEPS {
        let upper = nearest.length_squared();
        if upper <= limit {
            return true;
        }
        let corner = points.support(-nearest) - body.support(nearest);
        let advance = nearest.dot(corner);
        let apart = advance > 0.0 && advance * advance > limit * upper;
        if apart || upper - advance <= CLOSE * upper {
            return false;
        }
        let Some(closer) = simplex.with(corner) else { return true };
        if closer.length_squared() >= upper {
            return false;
        }
        nearest = closer;
    }
    false
}

/// One to three corners; a fourth is dropped at once for the side nearest to the origin.
struct Simplex {
    corners: [Point; 3],
    len: usize,
}

impl Simplex {
    fn of(corner: Point) -> Self {
        Self { corners: [corner; 3], len: 1 }
    }

    /// Adds a corner, finds the point closest to the origin, and keeps the corners that it is made of. None if the
    /// origin is inside.
    fn with(&mut self, corner: Point) -> Option<Point> {
        let [a, b, c] = self.corners;
        match self.len {
            1 => {
                let [wa, wd] = segment_weights(Point::ZERO, [a, corner]);
                Some(self.keep([a, corner, corner], [wa, wd, 0.0]))
            }
            2 => {
                let corners = [a, b, corner];
                Some(self.keep(corners, triangle_weights(Point::ZERO, corners)))
            }
            _ => {
                if tetrahedron_holds_origin([a, b, c, corner]) {
                    return None;
                }
                let sides = [[a, b, corner], [b, c, corner], [c, a, corner]];
                let (corners, weights) = nearest_side(sides);
                Some(self.keep(corners, weights))
            }
        }
    }

    fn keep(&mut self, corners: [Point; 3], weights: [f64; 3]) -> Point {
        let mut nearest = Point::ZERO;
        self.len = 0;
        for (corner, weight) in corners.into_iter().zip(weights) {
            if weight > 0.0 {
                nearest += corner * weight;
                self.corners[self.len] = corner;
                self.len += 1;
            }
        }
        nearest
    }
}

/// The triangle nearest to the origin, and the weights of its point nearest to the origin.
fn nearest_side(sides: [[Point; 3]; 3]) -> ([Point; 3], [f64; 3]) {
    let mut best = (f64::INFINITY, sides[0], [1.0, 0.0, 0.0]);
    for side in sides {
        let weights = triangle_weights(Point::ZERO, side);
        let [a, b, c] = side;
        let squared = (a * weights[0] + b * weights[1] + c * weights[2]).length_squared();
        if squared < best.0 {
            best = (squared, side, weights);
        }
    }
    (best.1, best.2)
}

fn tetrahedron_holds_origin([a, b, c, d]: [Point; 4]) -> bool {
    let volume = |p: Point, q: Point, r: Point| p.dot(q.cross(r));
    // The volumes that the origin spans with each side, all seen from the same side.
    let parts = [volume(b, c, d), -volume(a, c, d), volume(a, b, d), -volume(a, b, c)];
    parts.iter().all(|&v| v > 0.0) || parts.iter().all(|&v| v < 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::CenteredBox;

    #[test]
    fn tells_distances_of_known_pairs() {
        let quad = [[-1., -1., 3.], [1., -1., 3.], [1., 1., 3.], [-1., 1., 3.]].map(Point::from);
        let cube = CenteredBox { half: Point::ONE };
        assert!(hull_within(&quad, &cube, 2.0) && !hull_within(&quad, &cube, 2.0 - 1e-9));
        let corner = quad.map(|p| p + Point::new(3.0, 4.0, 0.0));
        let gap = Point::new(1.0, 2.0, 2.0).length();
        assert!(hull_within(&corner, &cube, gap + 1e-9) && !hull_within(&corner, &cube, gap - 1e-9));
        assert!(hull_within(&quad, &[Point::Z * 3.0], 0.0), "a point in the quad");
    }

    #[cfg(not(target_arch = "wasm32"))]
    mod random {
        use proptest::prelude::*;

        use super::*;
        use crate::geometry::QuadHull;
        use crate::geometry::samples::{of_hull, of_triangle, point, points};

        proptest! {
            #[test]
            fn points_agree_with_the_triangles_of_the_hull(
                corners in points::<4>(1.0), p in point(2.0), r in 1e-3..2.0_f64,
            ) {
                let exact = QuadHull::new(corners);
                prop_assert_eq!(exact.within(p, r), hull_within(&corners, &[p], r));
            }

            #[test]
            fn triangles_agree_with_samples(
                corners in points::<4>(1.5), triangle in points::<3>(1.5), r in 0.0..1.0_f64,
            ) {
                let within = hull_within(&corners, &triangle, r);
                let hull = QuadHull::new(corners);
                let sampled = of_triangle(triangle, 16).any(|s| hull.within(s, r));
                prop_assert!(within || !sampled);
                let reach = r + 4.3 / 16.0;
                prop_assert!(!within || of_triangle(triangle, 16).any(|s| hull.within(s, reach)));
                prop_assert!(!within || of_hull(corners, 8).any(|s| QuadHull::new(
                    [triangle[0], triangle[1], triangle[2], triangle[2]]).within(s, r + 4.3 / 8.0)));
            }
        }
    }
}
