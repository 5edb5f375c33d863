//! Capped cylinders about the z axis: any capped cylinder in its own frame.

use glam::DVec2;

use super::{Convex, Point, QuadHull, Solid, closest_on_segment};

/// The points with `x² + y² <= radius²` and `|z| <= half_length`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CenteredCylinder {
    /// Its radius.
    pub radius: f64,
    /// Half the distance between its caps.
    pub half_length: f64,
}

/// A triangle cut by two parallel planes has at most five corners.
const MOST_CORNERS: usize = 5;

impl Solid for CenteredCylinder {
    fn holds(&self, p: Point) -> bool {
        p.z.abs() <= self.half_length && p.truncate().length_squared() <= self.radius * self.radius
    }

    /// The part of a triangle between the planes of the caps is a convex polygon. It meets the cylinder if and only
    /// if its projection along the axis comes as near to the origin as the radius.
    fn meets(&self, hull: &QuadHull) -> bool {
        hull.triangles().any(|t| self.meets_triangle(t)) || hull.holds(Point::ZERO)
    }

    fn grown(&self, by: f64) -> Self {
        Self { radius: self.radius + by, half_length: self.half_length + by }
    }
}

impl CenteredCylinder {
    fn meets_triangle(&self, triangle: [Point; 3]) -> bool {
        let mut polygon = Polygon::of(triangle);
        polygon.cut(|p| self.half_length - p.z);
        polygon.cut(|p| self.half_length + p.z);
        polygon.is_near_axis(self.radius)
    }
}

impl Convex for CenteredCylinder {
    fn support(&self, direction: Point) -> Point {
        let outward = direction.truncate().normalize_or_zero() * self.radius;
        outward.extend(if direction.z < 0.0 { -self.half_length } else { self.half_length })
    }
}

/// A convex polygon of few corners.
struct Polygon {
    corners: [Point; MOST_CORNERS],
    len: usize,
}

impl Polygon {
    fn of([a, b, c]: [Point; 3]) -> Self {
        Self { corners: [a, b, c, a, a], len: 3 }
    }

    fn corners(&self) -> &[Point] {
        &self.corners[..self.len]
    }

    /// Keeps the part where `inside`, a linear function, is not negative (Sutherland and Hodgman 1974).
    fn cut(&mut self, inside: impl Fn(Point) -> f64) {
        let whole = Self { corners: self.corners, len: self.len };
        self.len = 0;
        let mut keep = |p: Point| {
            // Rounding may bend a sliver out of convexity; it then has no corner to lose that matters.
            if self.len < MOST_CORNERS {
                self.corners[self.len] = p;
                self.len += 1;
            }
        };
        for (i, &here) in whole.corners().iter().enumerate() {
            let next = whole.corners()[(i + 1) % whole.len];
            let (at_here, at_next) = (inside(here), inside(next));
            if at_here >= 0.0 {
                keep(here);
            }
            if (at_here > 0.0 && at_next < 0.0) || (at_here < 0.0 && at_next > 0.0) {
                keep(here + (next - here) * (at_here / (at_here - at_next)));
            }
        }
    }

    /// True if some point of the polygon is at most `radius` from the z axis.
    fn is_near_axis(&self, radius: f64) -> bool {
        let flat = |p: Point| p.truncate().extend(0.0);
        let sides = || (0..self.len).map(|i| [i, (i + 1) % self.len].map(|k| self.corners[k]));
        let near = |side: [Point; 2]| {
            closest_on_segment(Point::ZERO, side.map(flat)).length_squared() <= radius * radius
        };
        // The axis passes inside if it is on the same side of every edge.
        let turn = |[a, b]: [Point; 2]| DVec2::perp_dot(a.truncate(), b.truncate());
        let around = || self.len > 0 && (sides().all(|s| turn(s) > 0.0) || sides().all(|s| turn(s) < 0.0));
        sides().any(near) || around()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const DRUM: CenteredCylinder = CenteredCylinder { radius: 1.0, half_length: 2.0 };

    fn square(middle: [f64; 3], u: [f64; 3], v: [f64; 3]) -> QuadHull {
        let [m, u, v] = [middle, u, v].map(Point::from);
        QuadHull::new([m - u - v, m + u - v, m + u + v, m - u + v])
    }

    #[test]
    fn meets_quads_across_beside_and_above() {
        assert!(DRUM.meets(&square([0., 0., 0.], [9., 0., 0.], [0., 9., 0.])), "the cut is inside the quad");
        assert!(DRUM.meets(&square([0., 0., 2.], [9., 0., 0.], [0., 9., 0.])), "on the cap");
        assert!(!DRUM.meets(&square([0., 0., 2.01], [9., 0., 0.], [0., 9., 0.])), "above the cap");
        assert!(DRUM.meets(&square([0., 0.99, 0.], [9., 0., 0.], [0., 0., 9.])), "along the axis");
        assert!(!DRUM.meets(&square([0., 1.01, 0.], [9., 0., 0.], [0., 0., 9.])), "beside it");
        assert!(DRUM.meets(&square([0., 0., 0.], [9., 0., 0.], [0., 0., 9.])), "through the axis");
        assert!(DRUM.meets(&square([0., 0., 0.], [0.1, 0., 0.], [0., 0.1, 0.])), "inside");
        // Near the rim, where both the slab and the round wall are met, but not together.
        assert!(!DRUM.meets(&square([1.5, 0., 2.5], [0.8, 0., -0.8], [0., 9., 0.])));
    }

    #[cfg(not(target_arch = "wasm32"))]
    mod random {
        use proptest::prelude::*;

        use super::*;
        use crate::geometry::hull_within;
        use crate::geometry::samples::{of_hull, points};

        proptest! {
            #[test]
            fn agrees_with_samples_and_gjk(
                corners in points::<4>(2.5), radius in 0.0..1.5_f64, half_length in 0.0..1.5_f64,
            ) {
                let (hull, body) = (QuadHull::new(corners), CenteredCylinder { radius, half_length });
                let meets = body.meets(&hull);
                prop_assert!(meets || !of_hull(corners, 16).any(|s| body.holds(s)));
                                prop_assert!(!meets || hull_within(&hull.corners, &body, 1e-6));
                prop_assert!(body.grown(1e-6).meets(&hull) || !hull_within(&hull.corners, &body, 1e-9));
            }
        }
    }
}
