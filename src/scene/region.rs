//! Regions as solids: their surface, outline, bounds, and where a ray enters them.
//!
//! A box, a ball and a cylinder are each the image of a unit solid (the cube, ball and cylinder of
//! radius 1 and half height 1 along z) under a [`Placement`]. Regions of other shapes are not drawn.

use std::f64::consts::TAU;

use glam::{DMat3, DMat4, DQuat, DVec3};

use super::Ray;
use crate::{
    geometry::{Aabb, Point},
    sizing::Shape,
};

/// Segments of a circle.
const CIRCLE: usize = 64;

/// Which unit solid a region is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Solid {
    /// The cube from -1 to 1.
    Cube,
    /// The ball of radius 1.
    Ball,
    /// Radius 1 about z, from z = -1 to 1.
    Cylinder,
}

/// A unit solid placed in the world: `world = center + axes * unit`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Placement {
    /// What is placed.
    pub solid: Solid,
    /// Its middle.
    pub center: Point,
    /// Images of the unit vectors, at right angles to each other.
    pub axes: DMat3,
}

/// A corner of a region's surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePoint {
    /// World coordinates.
    pub position: Point,
    /// Outward unit normal.
    pub normal: DVec3,
}

impl Placement {
    /// The placement of a shape; `None` if such shapes are not drawn or it has no extent.
    pub fn of(shape: &Shape) -> Option<Self> {
        let placement = match *shape {
            Shape::Box { min, max, rotation } => {
                let turn = DMat3::from_quat(unit(rotation));
                let half = (max - min).abs() * 0.5;
                Self {
                    solid: Solid::Cube,
                    center: min.midpoint(max),
                    axes: turn * DMat3::from_diagonal(half),
                }
            }
            Shape::Sphere { center, radius } => {
                Self { solid: Solid::Ball, center, axes: DMat3::from_diagonal(DVec3::splat(radius)) }
            }
            Shape::Cylinder { from, to, radius } => {
                let axis = (to - from) * 0.5;
                let (x, y) = axis.try_normalize()?.any_orthonormal_pair();
                let axes = DMat3::from_cols(x * radius, y * radius, axis);
                Self { solid: Solid::Cylinder, center: from.midpoint(to), axes }
            }
            Shape::Points { .. } | Shape::Surface { .. } => return None,
        };
        let is_solid = placement.axes.determinant().abs() > 0.0 && placement.axes.is_finite();
        (is_solid && placement.center.is_finite()).then_some(placement)
    }

    /// The transform from world coordinates to those of the unit solid.
    pub fn unit_from_world(&self) -> DMat4 {
        DMat4::from_mat3_translation(self.axes, self.center).inverse()
    }

    fn world(&self, unit: DVec3) -> Point {
        self.center + self.axes * unit
    }

    /// The box around the solid.
    pub fn bounds(&self) -> Aabb {
        let [x, y, z] = [self.axes.x_axis, self.axes.y_axis, self.axes.z_axis];
        let reach = match self.solid {
            Solid::Cube => x.abs() + y.abs() + z.abs(),
            Solid::Ball => (x * x + y * y + z * z).map(f64::sqrt),
            Solid::Cylinder => (x * x + y * y).map(f64::sqrt) + z.abs(),
        };
        Aabb { min: self.center - reach, max: self.center + reach }
    }

    /// Distance at which a ray enters the solid from outside.
    pub fn entry(&self, ray: &Ray) -> Option<f64> {
        let unit_from_world = self.unit_from_world();
        let origin = unit_from_world.transform_point3(ray.origin);
        let direction = unit_from_world.transform_vector3(ray.direction);
        let slab = |o: f64, d: f64| sorted((-1.0 - o) / d, (1.0 - o) / d);
        let round = |o: DVec3, d: DVec3| {
            let (a, b, c) = (d.length_squared(), o.dot(d), o.length_squared() - 1.0);
            let discriminant = b * b - a * c;
            if discriminant < 0.0 {
                return NOWHERE;
            }
            ((-b - discriminant.sqrt()) / a, (-b + discriminant.sqrt()) / a)
        };
        let flat = |v: DVec3| v.with_z(0.0);
        let (near, far) = match self.solid {
            Solid::Cube => {
                let x = slab(origin.x, direction.x);
                both(both(x, slab(origin.y, direction.y)), slab(origin.z, direction.z))
            }
            Solid::Ball => round(origin, direction),
            Solid::Cylinder if flat(direction).length_squared() < 1e-18 * direction.length_squared() => {
                if flat(origin).length_squared() > 1.0 {
                    return None;
                }
                slab(origin.z, direction.z)
            }
            Solid::Cylinder => both(round(flat(origin), flat(direction)), slab(origin.z, direction.z)),
        };
        (near <= far && near > 0.0).then_some(near)
    }

    /// Triangles of the surface, outside counter-clockwise, three points each.
    pub fn surface(&self) -> Vec<SurfacePoint> {
        let unit = match self.solid {
            Solid::Cube => cube(),
            Solid::Ball => ball(),
            Solid::Cylinder => cylinder(),
        };
        // Normals go by the inverse transpose.
        let normals = self.axes.inverse().transpose();
        let place = |(p, n): (DVec3, DVec3)| SurfacePoint {
            position: self.world(p),
            normal: (normals * n).normalize(),
        };
        // A mirrored placement would turn the triangles over.
        let mut points: Vec<_> = unit.into_iter().map(place).collect();
        if self.axes.determinant() < 0.0 {
            points.chunks_exact_mut(3).for_each(|t| t.swap(1, 2));
        }
        points
    }

    /// Lines that show the shape: edges of a box, three circles of a ball, rims of a cylinder.
    pub fn outline(&self) -> Vec<[Point; 2]> {
        let unit: Vec<[DVec3; 2]> = match self.solid {
            Solid::Cube => cube_edges(),
            Solid::Ball => {
                let [a, b, c]: [fn(f64, f64) -> DVec3; 3] = [
                    |u, v| DVec3::new(u, v, 0.0),
                    |u, v| DVec3::new(0.0, u, v),
                    |u, v| DVec3::new(v, 0.0, u),
                ];
                [a, b, c].into_iter().flat_map(circle).collect()
            }
            Solid::Cylinder => {
                let rims: [fn(f64, f64) -> DVec3; 2] =
                    [|u, v| DVec3::new(u, v, -1.0), |u, v| DVec3::new(u, v, 1.0)];
                let sides = (0..4).map(|i| {
                    let (v, u) = (TAU * f64::from(i) / 4.0).sin_cos();
                    [DVec3::new(u, v, -1.0), DVec3::new(u, v, 1.0)]
                });
                rims.into_iter().flat_map(circle).chain(sides).collect()
            }
        };
        unit.into_iter().map(|ends| ends.map(|p| self.world(p))).collect()
    }
}

/// The span of a ray that misses.
const NOWHERE: (f64, f64) = (f64::INFINITY, f64::NEG_INFINITY);

/// A quaternion from outside as a turn: unit length, or no turn if it has none.
pub(super) fn unit(rotation: DQuat) -> DQuat {
    let length = rotation.length();
    if length.is_finite() && length > 0.0 { rotation / length } else { DQuat::IDENTITY }
}

fn sorted(a: f64, b: f64) -> (f64, f64) {
    (a.min(b), a.max(b))
}

fn both(a: (f64, f64), b: (f64, f64)) -> (f64, f64) {
    (a.0.max(b.0), a.1.min(b.1))
}

fn angle(i: usize) -> (f64, f64) {
    let (sin, cos) = (TAU * i as f64 / CIRCLE as f64).sin_cos();
    (cos, sin)
}

fn circle(at: fn(f64, f64) -> DVec3) -> Vec<[DVec3; 2]> {
    let point = |i| {
        let (u, v) = angle(i);
        at(u, v)
    };
    (0..CIRCLE).map(|i| [point(i), point(i + 1)]).collect()
}

fn cube_edges() -> Vec<[DVec3; 2]> {
    let corner = |i: u32| DVec3::from_array([0, 1, 2].map(|axis| f64::from(i >> axis & 1) * 2.0 - 1.0));
    let edge = |i: u32| (0..3).filter(move |axis| i >> axis & 1 == 0).map(move |axis| [i, i | 1 << axis]);
    (0..8).flat_map(edge).map(|ends| ends.map(corner)).collect()
}

type Vertices = Vec<(DVec3, DVec3)>;

/// The two triangles of a four-sided patch.
fn patch(out: &mut Vertices, corners: [(DVec3, DVec3); 4]) {
    let [a, b, c, d] = corners;
    out.extend([a, b, c, a, c, d]);
}

fn cube() -> Vertices {
    let mut out = Vec::new();
    for normal in [DVec3::X, DVec3::Y, DVec3::Z, DVec3::NEG_X, DVec3::NEG_Y, DVec3::NEG_Z] {
        let u = DVec3::new(normal.y, normal.z, normal.x).abs();
        let v = normal.cross(u);
        patch(&mut out, [-u - v, u - v, u + v, v - u].map(|side| (normal + side, normal)));
    }
    out
}

fn ball() -> Vertices {
    let point = |i: usize, j: usize| {
        let (u, v) = angle(i);
        let (z, r) = (std::f64::consts::PI * (j as f64 / (CIRCLE / 2) as f64 - 0.5)).sin_cos();
        let p = DVec3::new(u * r, v * r, z);
        (p, p)
    };
    let mut out = Vec::new();
    for j in 0..CIRCLE / 2 {
        for i in 0..CIRCLE {
            patch(&mut out, [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)]);
        }
    }
    out
}

fn cylinder() -> Vertices {
    let side = |i: usize, z: f64| {
        let (u, v) = angle(i);
        (DVec3::new(u, v, z), DVec3::new(u, v, 0.0))
    };
    let mut out = Vec::new();
    for i in 0..CIRCLE {
        patch(&mut out, [side(i, -1.0), side(i + 1, -1.0), side(i + 1, 1.0), side(i, 1.0)]);
        for z in [-1.0, 1.0] {
            let ends = if z > 0.0 { [i, i + 1] } else { [i + 1, i] };
            let normal = DVec3::Z * z;
            out.push((normal, normal));
            out.extend(ends.map(|e| (side(e, z).0, normal)));
        }
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shapes() -> [Shape; 3] {
        let rotation = DQuat::from_axis_angle(DVec3::new(1.0, 2.0, -1.0).normalize(), 0.8);
        [
            Shape::Box { min: Point::new(1.0, 2.0, 3.0), max: Point::new(2.0, 5.0, 3.5), rotation },
            Shape::Sphere { center: Point::new(-1.0, 4.0, 2.0), radius: 0.7 },
            Shape::Cylinder { from: Point::new(0.0, 1.0, 0.0), to: Point::new(2.0, 2.0, 3.0), radius: 0.4 },
        ]
    }

    fn volume(points: &[SurfacePoint]) -> f64 {
        points.chunks_exact(3).map(|t| t[0].position.dot(t[1].position.cross(t[2].position)) / 6.0).sum()
    }

    #[test]
    fn surfaces_enclose_the_volume_and_face_outwards() {
        let length = 14.0_f64.sqrt();
        let expected = [1.5, TAU / 1.5 * 0.343, TAU * 0.5 * 0.16 * length];
        for (shape, expected) in shapes().iter().zip(expected) {
            let placement = Placement::of(shape).unwrap();
            let points = placement.surface();
            let got = volume(&points);
            assert!((got / expected - 1.0).abs() < 0.01, "{shape:?}: {got} for {expected}");
            for t in points.chunks_exact(3) {
                let [a, b, c] = [t[0], t[1], t[2]];
                let flat = (b.position - a.position).cross(c.position - a.position);
                assert!(flat.dot(a.normal + b.normal + c.normal) >= -1e-12);
            }
            let bounds = placement.bounds();
            let around = points.iter().fold(Aabb::EMPTY, |all, p| all.with(p.position));
            assert!(around.min.cmpge(bounds.min - 1e-9).all() && around.max.cmple(bounds.max + 1e-9).all());
            assert!((around.size() - bounds.size()).abs().max_element() < 0.01 * bounds.diagonal());
        }
    }

    #[test]
    fn rays_enter_on_the_surface() {
        for shape in shapes() {
            let placement = Placement::of(&shape).unwrap();
            for direction in [DVec3::X, DVec3::NEG_Y, DVec3::Z, DVec3::new(1.0, -2.0, 0.3).normalize()] {
                let ray = Ray { origin: placement.center - direction * 20.0, direction };
                let at = ray.origin + direction * placement.entry(&ray).expect("a hit");
                let unit = placement.unit_from_world().transform_point3(at);
                let level = match placement.solid {
                    Solid::Cube => unit.abs().max_element(),
                    Solid::Ball => unit.length(),
                    Solid::Cylinder => unit.truncate().length().max(unit.z.abs()),
                };
                assert!((level - 1.0).abs() < 1e-9, "{shape:?} {level}");
                assert_eq!(placement.entry(&Ray { origin: placement.center, ..ray }), None);
                let aside = direction.any_orthogonal_vector().normalize() * 9.0;
                assert_eq!(placement.entry(&Ray { origin: ray.origin + aside, ..ray }), None);
            }
        }
        let upright = Shape::Cylinder { from: Point::ZERO, to: Point::Z, radius: 1.0 };
        let down = Ray { origin: Point::new(0.5, 0.0, 4.0), direction: DVec3::NEG_Z };
        assert_eq!(Placement::of(&upright).unwrap().entry(&down), Some(3.0));
    }

    #[test]
    fn outlines_lie_on_the_surface() {
        assert_eq!(cube_edges().len(), 12);
        for shape in shapes() {
            let placement = Placement::of(&shape).unwrap();
            let bounds = placement.bounds().grown(1e-9);
            for p in placement.outline().iter().flatten() {
                assert!(p.cmpge(bounds.min).all() && p.cmple(bounds.max).all());
            }
        }
    }

    #[test]
    fn shapes_without_extent_are_not_drawn() {
        let flat = Shape::Box { min: Point::ZERO, max: Point::new(1.0, 1.0, 0.0), rotation: DQuat::IDENTITY };
        let dot = Shape::Cylinder { from: Point::ONE, to: Point::ONE, radius: 1.0 };
        let nan = Shape::Sphere { center: Point::NAN, radius: 1.0 };
        let points = Shape::Points { points: vec![Point::ZERO], radius: 1.0 };
        for shape in [flat, dot, nan, points] {
            assert_eq!(Placement::of(&shape), None);
        }
    }
}
