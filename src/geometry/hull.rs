//! Elements as solids: the convex hulls of their corners.

use super::{Convex, Point, QuadHull, Solid, hull_within};

/// The corners of an element of some kind.
pub trait Corners: Copy {
    /// Their hull.
    type Hull: Hull;

    /// The hull of the corners.
    fn hull(self) -> Self::Hull;
}

/// The convex hull of an element's corners, as shapes ask for it.
pub trait Hull: Copy {
    /// The same hull with its corners moved rigidly.
    fn moved(&self, rigid: impl Fn(Point) -> Point) -> Self;

    /// True if it shares a point with `solid`.
    fn meets(&self, solid: &impl Solid) -> bool;

    /// True if `p` is at most `distance` away.
    fn is_near(&self, p: Point, distance: f64) -> bool;

    /// True if it comes as near to `body` as `distance`.
    fn comes_within(&self, body: &impl Convex, distance: f64) -> bool;
}

impl Corners for [Point; 4] {
    type Hull = QuadHull;

    fn hull(self) -> QuadHull {
        QuadHull::new(self)
    }
}

/// Exact, by the triangles of the hull.
impl Hull for QuadHull {
    fn moved(&self, rigid: impl Fn(Point) -> Point) -> Self {
        self.map(rigid)
    }

    fn meets(&self, solid: &impl Solid) -> bool {
        solid.meets(self)
    }

    fn is_near(&self, p: Point, distance: f64) -> bool {
        self.within(p, distance)
    }

    fn comes_within(&self, body: &impl Convex, distance: f64) -> bool {
        hull_within(&self.corners, body, distance)
    }
}

impl Corners for [Point; 8] {
    type Hull = Self;

    fn hull(self) -> Self {
        self
    }
}

/// Two bodies count as sharing a point if they come so near, as a share of the hex's diagonal: where the origin
/// lies in a side of the simplex, the algorithm can tell them apart no better.
const TOUCHING: f64 = 1e-10;

/// A hex by its corners. Its hull holds the trilinear hex and all that subdivision makes of it.
impl Hull for [Point; 8] {
    fn moved(&self, rigid: impl Fn(Point) -> Point) -> Self {
        self.map(rigid)
    }

    fn meets(&self, solid: &impl Solid) -> bool {
        hull_within(self, solid, TOUCHING * self[0].distance(self[6]))
    }

    fn is_near(&self, p: Point, distance: f64) -> bool {
        hull_within(self, &[p], distance)
    }

    fn comes_within(&self, body: &impl Convex, distance: f64) -> bool {
        hull_within(self, body, distance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::{CenteredBox, CenteredCylinder};

    /// The cube of edge 2 about `middle`.
    fn cube(middle: Point) -> [Point; 8] {
        let signs = [(-1., -1.), (1., -1.), (1., 1.), (-1., 1.)];
        let corner = |k: usize| Point::new(signs[k % 4].0, signs[k % 4].1, if k < 4 { -1. } else { 1. });
        std::array::from_fn(|k| middle + corner(k))
    }

    /// Boxes in symmetric places, where differences of corners and sides of simplices fall on the origin.
    #[test]
    fn cubes_meet_boxes_however_they_lie() {
        let places: &[f64] = &[-3.0, -2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0, 3.0];
        for half in [0.5, 1.0, 1.5] {
            let body = CenteredBox { half: Point::splat(half) };
            for (x, y, z) in places
                .iter()
                .flat_map(|&x| places.iter().flat_map(move |&y| places.iter().map(move |&z| (x, y, z))))
            {
                let gap = Point::new(x, y, z).abs().max_element() - 1.0 - half;
                if gap != 0.0 {
                    assert_eq!(cube(Point::new(x, y, z)).meets(&body), gap < 0.0, "{x} {y} {z} of {half}");
                }
            }
        }
    }

    #[test]
    fn tells_how_near_points_and_cylinders_come() {
        let hex = cube(Point::ZERO);
        assert!(hex.is_near(Point::new(2.0, 2.0, 2.0), 3f64.sqrt() + 1e-9));
        assert!(!hex.is_near(Point::new(2.0, 2.0, 2.0), 3f64.sqrt() - 1e-9));
        assert!(hex.is_near(Point::ZERO, 1e-9), "inside");
        let drum = CenteredCylinder { radius: 0.5, half_length: 2.0 };
        assert!(cube(Point::X * 1.49).meets(&drum) && !cube(Point::X * 1.51).meets(&drum));
        assert!(
            cube(Point::X * 2.0).comes_within(&drum, 0.51) && !cube(Point::X * 2.0).comes_within(&drum, 0.49)
        );
    }

    #[cfg(not(target_arch = "wasm32"))]
    mod random {
        use proptest::prelude::*;

        use super::*;
        use crate::geometry::Aabb;
        use crate::geometry::samples::{point, points, rotation};

        proptest! {
            #[test]
            fn a_hex_of_a_box_agrees_with_the_box(
                corners in points::<2>(1.0), p in point(2.0), r in 1e-3..2.0_f64, turn in rotation(),
            ) {
                let body = Aabb::around(&corners);
                let hex = cube(Point::ZERO).map(|c| turn * (body.center() + c * body.size() * 0.5));
                let distance = p.distance(p.clamp(body.min, body.max));
                prop_assume!((distance - r).abs() > 1e-9);
                prop_assert_eq!(hex.is_near(turn * p, r), distance < r);
            }

            #[test]
            fn hexes_meet_what_their_sides_and_diagonals_meet(hex in points::<8>(1.5), half in point(1.0)) {
                let body = CenteredBox { half: half.abs() };
                let sides = [[0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [3, 0, 4, 7], [0, 1, 6, 7]];
                let met = sides.iter().any(|s| body.meets(&QuadHull::new(s.map(|k| hex[k]))));
                prop_assert!(hex.meets(&body) || !met);
            }
        }
    }
}
