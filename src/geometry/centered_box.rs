//! Boxes about the origin, along the axes: any box in its own frame.

use super::{Convex, Point, QuadHull, Solid};

/// The box from `-half` to `half`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CenteredBox {
    /// Half of its edge lengths, none negative.
    pub half: Point,
}

impl Solid for CenteredBox {
    fn holds(&self, p: Point) -> bool {
        p.abs().cmple(self.half).all()
    }

    /// Two convex polyhedra are apart if and only if one of these axes separates them: a normal of the one, a
    /// normal of the other, or a cross product of an edge of each (Gottschalk, Lin, Manocha 1996).
    fn meets(&self, hull: &QuadHull) -> bool {
        let apart = |axis: Point| {
            let [a, b, c, d] = hull.corners.map(|p| p.dot(axis));
            let reach = self.half.dot(axis.abs());
            a.min(b).min(c.min(d)) > reach || a.max(b).max(c.max(d)) < -reach
        };
        let faces = [Point::X, Point::Y, Point::Z];
        // A cross product with a coordinate axis.
        let edges =
            |e: Point| [Point::new(0.0, -e.z, e.y), Point::new(e.z, 0.0, -e.x), Point::new(-e.y, e.x, 0.0)];
        !(faces.into_iter().any(apart)
            || hull.normals().any(apart)
            || hull.edges().flat_map(edges).any(apart))
    }

    fn grown(&self, by: f64) -> Self {
        Self { half: self.half + Point::splat(by) }
    }
}

impl Convex for CenteredBox {
    fn support(&self, direction: Point) -> Point {
        Point::select(direction.cmplt(Point::ZERO), -self.half, self.half)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CUBE: CenteredBox = CenteredBox { half: Point::ONE };

    #[test]
    fn finds_the_axis_of_an_edge_pair() {
        // A long thin quad that passes the cube's edge x = y = 1 across: only the axis (1, 1, 0) tells.
        let passing = |gap: f64| {
            let [middle, along, across] = [
                Point::new(1.0 + gap, 1.0 + gap, 0.0),
                Point::new(9.0, -9.0, 0.0),
                Point::new(1e-3, 1e-3, 9.0),
            ];
            QuadHull::new([
                middle - along - across,
                middle + along - across,
                middle + along + across,
                middle - along + across,
            ])
        };
        assert!(CUBE.meets(&passing(-1e-3)));
        assert!(!CUBE.meets(&passing(0.2)));
    }

    #[test]
    fn a_box_in_the_middle_of_a_large_quad_meets_it() {
        let square =
            |z: f64| QuadHull::new([[-9., -9., z], [9., -9., z], [9., 9., z], [-9., 9., z]].map(Point::from));
        assert!(CUBE.meets(&square(0.3)));
        assert!(CUBE.meets(&square(1.0)), "closed");
        assert!(!CUBE.meets(&square(1.001)));
    }

    #[cfg(not(target_arch = "wasm32"))]
    mod random {
        use proptest::prelude::*;

        use super::*;
        use crate::geometry::hull_within;
        use crate::geometry::samples::{of_hull, point, points};

        proptest! {
            #[test]
            fn agrees_with_samples_and_gjk(corners in points::<4>(2.5), half in point(1.0)) {
                let (hull, body) = (QuadHull::new(corners), CenteredBox { half: half.abs() });
                let meets = body.meets(&hull);
                prop_assert!(meets || !of_hull(corners, 16).any(|s| body.holds(s)));
                prop_assert_eq!(meets, hull_within(&hull.corners, &body, 1e-9));
            }
        }
    }
}
