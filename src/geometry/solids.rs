//! Balls, boxes of any orientation and capped cylinders: do they meet a triangle, and where are they
//! nearest to a point? All are closed: what touches meets.

use glam::DMat3;

use super::triangle::closest_on_segment;
use super::{Aabb, Point, Triangle};

/// A ball.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ball {
    /// Its centre.
    pub center: Point,
    /// Its radius, at least 0.
    pub radius: f64,
}

impl Ball {
    /// The smallest box around it.
    pub fn bounds(&self) -> Aabb {
        Aabb { min: self.center, max: self.center }.grown(self.radius)
    }

    /// The point of the ball nearest to `p`: `p` itself inside.
    pub fn closest_point(&self, p: Point) -> Point {
        self.center + (p - self.center).clamp_length_max(self.radius)
    }

    /// True if the ball and the triangle share a point.
    pub fn meets(&self, t: &Triangle) -> bool {
        t.distance_squared(self.center) <= self.radius * self.radius
    }
}

/// A box of any orientation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OrientedBox {
    /// Its centre.
    pub center: Point,
    /// Its axes, as the columns of a rotation.
    pub axes: DMat3,
    /// Half of its extent along each axis, at least 0.
    pub half: Point,
}

impl OrientedBox {
    /// The smallest box around it along x, y, z.
    pub fn bounds(&self) -> Aabb {
        let reach = self.axes.abs() * self.half;
        Aabb { min: self.center - reach, max: self.center + reach }
    }

    /// `p` as the box's axes see it from its centre.
    fn local(&self, p: Point) -> Point {
        self.axes.transpose() * (p - self.center)
    }

    /// The point of the box nearest to `p`: `p` itself inside.
    pub fn closest_point(&self, p: Point) -> Point {
        let q = self.local(p);
        let clamped = q.clamp(-self.half, self.half);
        if clamped == q { p } else { self.center + self.axes * clamped }
    }

    /// True if the box and the triangle share a point: no plane along a face of the box, the triangle or
    /// two edges separates them (Akenine-Möller, Fast 3D Triangle-Box Overlap Testing, 2001).
    pub fn meets(&self, t: &Triangle) -> bool {
        let corners = t.0.map(|p| self.local(p));
        let [a, b, c] = corners;
        let (least, most) = (a.min(b).min(c), a.max(b).max(c));
        if least.cmpgt(self.half).any() || most.cmplt(-self.half).any() {
            return false;
        }
        let sides = [b - a, c - b, a - c];
        if self.is_beyond(sides[0].cross(sides[1]), &corners) {
            return false;
        }
        // The cross products of the box's axes with a side.
        let across =
            |s: Point| [Point::new(0., -s.z, s.y), Point::new(s.z, 0., -s.x), Point::new(-s.y, s.x, 0.)];
        !sides.iter().any(|&side| across(side).iter().any(|&axis| self.is_beyond(axis, &corners)))
    }

    /// True if a plane across `axis` parts the box and the triangle, both in the box's frame.
    fn is_beyond(&self, axis: Point, corners: &[Point; 3]) -> bool {
        let [a, b, c] = corners.map(|p| axis.dot(p));
        let reach = axis.abs().dot(self.half);
        a.min(b).min(c) > reach || a.max(b).max(c) < -reach
    }
}

/// A cylinder with flat caps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cylinder {
    /// The middle of its axis.
    pub center: Point,
    /// Two unit vectors across the axis and one along it, as the columns of a rotation.
    pub axes: DMat3,
    /// Half of its length, at least 0.
    pub half_length: f64,
    /// Its radius, at least 0.
    pub radius: f64,
}

impl Cylinder {
    /// The cylinder between two different cap centres.
    pub fn new(from: Point, to: Point, radius: f64) -> Self {
        let along = (to - from).normalize();
        let (u, v) = along.any_orthonormal_pair();
        Self {
            center: from.midpoint(to),
            axes: DMat3::from_cols(u, v, along),
            half_length: from.distance(to) / 2.0,
            radius,
        }
    }

    /// The smallest box around it along x, y, z.
    pub fn bounds(&self) -> Aabb {
        let along = self.axes.z_axis;
        let across = (Point::ONE - along * along).max(Point::ZERO).map(f64::sqrt);
        let reach = along.abs() * self.half_length + across * self.radius;
        Aabb { min: self.center - reach, max: self.center + reach }
    }

    /// `p` as the cylinder's axes see it from its centre, z along the axis.
    fn local(&self, p: Point) -> Point {
        self.axes.transpose() * (p - self.center)
    }

    /// The point of the cylinder nearest to `p`: `p` itself inside.
    pub fn closest_point(&self, p: Point) -> Point {
        let q = self.local(p);
        let across = q.with_z(0.0).clamp_length_max(self.radius);
        let clamped = across.with_z(q.z.clamp(-self.half_length, self.half_length));
        if clamped == q { p } else { self.center + self.axes * clamped }
    }

    /// True if the cylinder and the triangle share a point: what the planes of the caps leave of the
    /// triangle comes, seen along the axis, within the radius of the axis.
    pub fn meets(&self, t: &Triangle) -> bool {
        let corners = t.0.map(|p| self.local(p));
        let below = |p: &Point| self.half_length - p.z;
        let above = |p: &Point| p.z + self.half_length;
        let left = Clipped::from(corners).keep(below).keep(above);
        left.distance_from_axis() <= self.radius
    }
}

/// A convex polygon of at most five corners: a triangle cut by two planes.
struct Clipped {
    corners: [Point; 5],
    len: usize,
}

impl From<[Point; 3]> for Clipped {
    fn from([a, b, c]: [Point; 3]) -> Self {
        Self { corners: [a, b, c, c, c], len: 3 }
    }
}

impl Clipped {
    fn corners(&self) -> &[Point] {
        &self.corners[..self.len]
    }

    /// The sides, from each corner to the next.
    fn sides(&self) -> impl Iterator<Item = [Point; 2]> {
        let corners = self.corners();
        (0..corners.len()).map(|i| [corners[i], corners[(i + 1) % corners.len()]])
    }

    /// What is left where the linear function `height` is at least 0 (Sutherland and Hodgman).
    fn keep(&self, height: impl Fn(&Point) -> f64) -> Self {
        let mut left = Self { corners: self.corners, len: 0 };
        let mut push = |p: Point| {
            // A plane cuts at most one corner more into a convex polygon; rounding may repeat one.
            if left.len < left.corners.len() {
                left.corners[left.len] = p;
                left.len += 1;
            }
        };
        for [a, b] in self.sides() {
            let (at_a, at_b) = (height(&a), height(&b));
            if at_a >= 0.0 {
                push(a);
            }
            if (at_a > 0.0 && at_b < 0.0) || (at_a < 0.0 && at_b > 0.0) {
                push(a.lerp(b, at_a / (at_a - at_b)));
            }
        }
        left
    }

    /// The distance between the polygon and the z axis, seen along it; infinite for nothing.
    fn distance_from_axis(&self) -> f64 {
        if self.surrounds_axis() {
            return 0.0;
        }
        let flat = |p: Point| p.with_z(0.0);
        self.sides()
            .map(|side| closest_on_segment(Point::ZERO, side.map(flat)).length())
            .fold(f64::INFINITY, f64::min)
    }

    /// True if the z axis passes through the inside. Polygons seen edge-on are left to their sides.
    fn surrounds_axis(&self) -> bool {
        /// Below this share of the squared size, an area seen along the axis is rounding.
        const EDGE_ON: f64 = 1e-12;
        let size = self.corners().iter().map(|p| p.truncate().length_squared()).fold(0.0, f64::max);
        let turns = || self.sides().map(|[a, b]| a.truncate().perp_dot(b.truncate()));
        turns().sum::<f64>().abs() > EDGE_ON * size
            && (turns().all(|t| t >= 0.0) || turns().all(|t| t <= 0.0))
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::geometry::testing::{point, samples, triangle};
    use glam::DQuat;
    use proptest::prelude::*;

    fn boxes() -> impl Strategy<Value = OrientedBox> {
        let turn = prop_oneof![Just(DQuat::IDENTITY), point().prop_map(|p| DQuat::from_scaled_axis(3.0 * p))];
        (point(), turn, point()).prop_map(|(center, turn, half)| OrientedBox {
            center,
            axes: DMat3::from_quat(turn),
            half: half.abs() * 0.6,
        })
    }

    fn cylinders() -> impl Strategy<Value = Cylinder> {
        (point(), point(), 0.0..0.7f64)
            .prop_filter("an axis", |(a, b, _)| a.distance(*b) > 0.01)
            .prop_map(|(a, b, radius)| Cylinder::new(a, b, radius))
    }

    /// The least distance between a triangle and a convex solid, by projecting to and fro.
    fn gap(t: &Triangle, closest: impl Fn(Point) -> Point) -> f64 {
        let mut p = samples(t, 24)
            .min_by(|p, q| closest(*p).distance(*p).total_cmp(&closest(*q).distance(*q)))
            .unwrap();
        for _ in 0..400 {
            p = t.closest_point(closest(p));
        }
        closest(p).distance(p)
    }

    /// Touching is decided by the last digits: leave a little room on both sides.
    fn agrees(meets: bool, gap: f64) -> Result<(), TestCaseError> {
        prop_assert!(!meets || gap < 1e-3, "said to meet at distance {gap}");
        prop_assert!(meets || gap > 1e-12, "said to be apart at distance {gap}");
        Ok(())
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(1000))]

        #[test]
        fn boxes_meet_what_they_reach(shape in boxes(), t in triangle()) {
            agrees(shape.meets(&t), gap(&t, |p| shape.closest_point(p)))?;
        }

        #[test]
        fn cylinders_meet_what_they_reach(shape in cylinders(), t in triangle()) {
            agrees(shape.meets(&t), gap(&t, |p| shape.closest_point(p)))?;
        }

        #[test]
        fn balls_meet_what_they_reach(center in point(), radius in 0.0..0.7f64, t in triangle()) {
            let shape = Ball { center, radius };
            agrees(shape.meets(&t), gap(&t, |p| shape.closest_point(p)))?;
        }

        #[test]
        fn closest_points_are_in_bounds_and_stay_put(b in boxes(), c in cylinders(), p in point()) {
            for (q, again, bounds) in [
                (b.closest_point(p), b.closest_point(b.closest_point(p)), b.bounds()),
                (c.closest_point(p), c.closest_point(c.closest_point(p)), c.bounds()),
            ] {
                prop_assert!(q.distance(again) < 1e-12);
                let inside = bounds.grown(1e-12).touches(&Aabb::around([&q]));
                prop_assert!(inside);
            }
        }
    }

    #[test]
    fn a_cylinder_is_flat_at_its_caps() {
        let can = Cylinder::new(Point::ZERO, Point::Z * 2.0, 1.0);
        let over_rim =
            |x: f64, z: f64| Triangle([[x, 0., z], [x + 1., -1., z], [x + 1., 1., z]].map(Point::from));
        assert!(can.meets(&over_rim(0.9, 2.0)));
        assert!(!can.meets(&over_rim(0.9, 2.1)), "a ball on the cap would meet it");
        assert!(!can.meets(&over_rim(1.1, 1.0)));
        let around = Triangle([[-9., -9., 1.], [9., -9., 1.], [0., 9., 1.]].map(Point::from));
        assert!(can.meets(&around), "through the inside, no corner or side near");
        let along = Triangle([[0.5, 0., -9.], [0.5, 0., 9.], [0.5, 0., 8.]].map(Point::from));
        assert!(can.meets(&along), "edge-on along the axis");
        let beyond = Triangle([[2., 0., 0.], [3., 0., 0.], [2., 0., 2.]].map(Point::from));
        assert!(!can.meets(&beyond), "edge-on, and its line passes the axis");
    }

    #[test]
    fn a_box_meets_a_triangle_that_it_is_inside_of() {
        let speck = OrientedBox { center: Point::ZERO, axes: DMat3::IDENTITY, half: Point::splat(1e-9) };
        assert!(speck.meets(&Triangle([[-9., -9., 0.], [9., -9., 0.], [0., 9., 0.]].map(Point::from))));
        assert!(
            !speck.meets(&Triangle([[-9., -9., 1e-6], [9., -9., 1e-6], [0., 9., 1e-6]].map(Point::from)))
        );
    }
}
