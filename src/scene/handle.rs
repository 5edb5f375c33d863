//! Handles of a region: where they stand, which one is under the pointer, and what dragging one does.
//!
//! A drag never jumps: the pointer's ray is met with a guide (a plane facing the eye, or a line) when
//! the drag starts and again at each move, and the handle goes by the difference.

use glam::{DMat3, DVec2, DVec3};

use super::{
    Camera, Ray, Viewport,
    region::{Placement, unit},
};
use crate::{geometry::Point, sizing::Shape};

/// Pixels from the middle of a region to the knobs that move it along an axis.
pub(super) const AXIS_PIXELS: f64 = 56.0;
/// Smallest extent that a drag leaves, as a share of the one it started with.
const SMALLEST: f64 = 0.01;

/// What a handle takes hold of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grip {
    /// The whole region, moved in the plane that faces the eye.
    Center,
    /// The whole region, moved along its axis x, y or z.
    Axis(usize),
    /// One side of a box, moved along its normal.
    Face {
        /// Axis of the normal.
        axis: usize,
        /// The side at the greater coordinate.
        is_max: bool,
    },
    /// The radius of a ball or cylinder.
    Radius,
    /// The first cap of a cylinder.
    From,
    /// The second cap of a cylinder.
    To,
    /// The plane that cuts a hex mesh, moved along its normal.
    Section,
}

impl Grip {
    /// The handle's name: `center`, `move-x`, `min-x`, `max-x`, `radius`, `from`, `to`, `section`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Center => "center",
            Self::Axis(axis) => ["move-x", "move-y", "move-z"][axis],
            Self::Face { axis, is_max: false } => ["min-x", "min-y", "min-z"][axis],
            Self::Face { axis, is_max: true } => ["max-x", "max-y", "max-z"][axis],
            Self::Radius => "radius",
            Self::From => "from",
            Self::To => "to",
            Self::Section => "section",
        }
    }
}

/// A handle and where it stands in the world.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Handle {
    /// What it takes hold of.
    pub grip: Grip,
    /// Its middle.
    pub at: Point,
}

/// The handles of a region, as they stand before this camera. The middle is the last.
pub fn handles(shape: &Shape, camera: &Camera, viewport: Viewport) -> Vec<Handle> {
    let Some(placement) = Placement::of(shape) else { return Vec::new() };
    let center = placement.center;
    let handle = |grip, at| Handle { grip, at };
    let mut out = match shape {
        Shape::Sphere { radius, .. } => {
            vec![handle(Grip::Radius, center + camera.axes()[0] * *radius)]
        }
        Shape::Cylinder { from, to, radius } => vec![
            handle(Grip::From, *from),
            handle(Grip::To, *to),
            handle(Grip::Radius, center + across(placement.axes.z_axis, camera) * *radius),
        ],
        _ => (0..3)
            .flat_map(|axis| [false, true].map(|is_max| (axis, is_max)))
            .map(|(axis, is_max)| {
                let reach = placement.axes.col(axis) * if is_max { 1.0 } else { -1.0 };
                handle(Grip::Face { axis, is_max }, center + reach)
            })
            .collect(),
    };
    let reach = AXIS_PIXELS * camera.pixel_size(center, viewport);
    let axes = own_axes(shape);
    out.extend((0..3).map(|axis| handle(Grip::Axis(axis), center + axes.col(axis) * reach)));
    out.push(handle(Grip::Center, center));
    out
}

/// Directions in which a region is moved: a box's own, the world's for others.
fn own_axes(shape: &Shape) -> DMat3 {
    match *shape {
        Shape::Box { rotation, .. } => DMat3::from_quat(unit(rotation)),
        _ => DMat3::IDENTITY,
    }
}

/// The direction from a cylinder's axis to its silhouette.
fn across(axis: DVec3, camera: &Camera) -> DVec3 {
    let [right, _, forward] = camera.axes();
    let side = forward.cross(axis);
    // An axis that points at the eye has its silhouette all round.
    let side = if side.length() > 1e-3 * axis.length() { side } else { right };
    (side - axis * (side.dot(axis) / axis.length_squared())).normalize()
}

/// The handle within `reach` pixels of a pixel, the nearest of them; of two as near, the first.
pub fn handle_at(
    handles: &[Handle],
    pixel: DVec2,
    reach: f64,
    camera: &Camera,
    viewport: Viewport,
) -> Option<usize> {
    let distance = |h: &Handle| camera.pixel(h.at, viewport).map(|at| at.distance(pixel));
    handles
        .iter()
        .enumerate()
        .filter_map(|(i, h)| distance(h).filter(|&d| d <= reach).map(|d| (i, d)))
        .min_by(|a, b| a.1.total_cmp(&b.1))
        .map(|(i, _)| i)
}

/// A handle being dragged.
#[derive(Clone, Debug)]
pub struct Drag {
    shape: Shape,
    handle: Handle,
    guide: Guide,
    start: Point,
}

/// What the pointer's ray is met with.
#[derive(Clone, Copy, Debug)]
pub(super) enum Guide {
    Plane { normal: DVec3 },
    Line { direction: DVec3 },
}

impl Drag {
    /// Takes hold of a region's handle with a ray through the pointer.
    pub fn new(shape: &Shape, handle: Handle, ray: &Ray, camera: &Camera) -> Option<Self> {
        let placement = Placement::of(shape)?;
        let guide = match (handle.grip, shape) {
            (Grip::Axis(axis), _) => Guide::Line { direction: own_axes(shape).col(axis) },
            (Grip::Face { axis, .. }, _) => Guide::Line { direction: placement.axes.col(axis).normalize() },
            (Grip::Radius, Shape::Cylinder { .. }) => {
                Guide::Line { direction: (handle.at - placement.center).normalize() }
            }
            _ => Guide::Plane { normal: camera.axes()[2] },
        };
        let start = guide.meet(handle.at, ray)?;
        Some(Self { shape: shape.clone(), handle, guide, start })
    }

    /// The region when the pointer's ray is `ray`; `None` where the ray says nothing (along the guide).
    pub fn to(&self, ray: &Ray) -> Option<Shape> {
        let by = self.guide.meet(self.handle.at, ray)? - self.start;
        by.is_finite().then(|| self.moved(by))
    }

    fn moved(&self, by: DVec3) -> Shape {
        let mut shape = self.shape.clone();
        let at = self.handle.at + by;
        match (&mut shape, self.handle.grip) {
            (Shape::Box { min, max, rotation }, Grip::Face { axis, is_max }) => {
                let direction = DMat3::from_quat(unit(*rotation)).col(axis);
                let size = (max[axis] - min[axis]).abs();
                let outward = if is_max { 1.0 } else { -1.0 };
                let more = (by.dot(direction) * outward).max(size * (SMALLEST - 1.0));
                let half = (*max - *min).abs() * 0.5 + DVec3::AXES[axis] * more * 0.5;
                let center = min.midpoint(*max) + direction * more * 0.5 * outward;
                (*min, *max) = (center - half, center + half);
            }
            (Shape::Box { min, max, .. }, _) => {
                *min += by;
                *max += by;
            }
            (Shape::Sphere { center, radius }, Grip::Radius) => {
                *radius = at.distance(*center).max(*radius * SMALLEST);
            }
            (Shape::Sphere { center, .. }, _) => *center += by,
            (Shape::Cylinder { from, to, radius }, Grip::Radius) => {
                let center = from.midpoint(*to);
                let direction = (self.handle.at - center).normalize();
                *radius = (at - center).dot(direction).max(*radius * SMALLEST);
            }
            (Shape::Cylinder { from, to, .. }, Grip::From) => *from = apart(at, *to, *from),
            (Shape::Cylinder { from, to, .. }, Grip::To) => *to = apart(at, *from, *to),
            (Shape::Cylinder { from, to, .. }, _) => {
                *from += by;
                *to += by;
            }
            (Shape::Points { .. } | Shape::Surface { .. }, _) => {}
        }
        shape
    }
}

/// `end`, unless it comes too near to `other`; `before` is where it came from.
fn apart(end: Point, other: Point, before: Point) -> Point {
    let smallest = before.distance(other) * SMALLEST;
    let direction = (end - other).try_normalize().unwrap_or_else(|| (before - other).normalize());
    other + direction * end.distance(other).max(smallest)
}

impl Guide {
    /// The point of the guide through `origin` that the ray meets or comes nearest to.
    pub fn meet(self, origin: Point, ray: &Ray) -> Option<Point> {
        let w = origin - ray.origin;
        match self {
            Self::Plane { normal } => {
                let along = w.dot(normal) / ray.direction.dot(normal);
                (along > 0.0).then(|| ray.origin + ray.direction * along)
            }
            Self::Line { direction } => {
                let cos = direction.dot(ray.direction);
                let sin_squared = 1.0 - cos * cos;
                // Closer than about half a degree to the view direction a line cannot be followed.
                (sin_squared > 1e-4).then(|| {
                    origin + direction * ((cos * w.dot(ray.direction) - w.dot(direction)) / sin_squared)
                })
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use glam::DQuat;

    use super::*;
    use crate::scene::{Axis, Projection};

    const VIEW: Viewport = Viewport { width: 640.0, height: 480.0 };

    fn camera(projection: Projection) -> Camera {
        let mut camera = Camera { projection, ..Camera::default() };
        camera.look_along(Axis::Iso);
        camera.orbit(Point::ZERO, 0.3, 0.1);
        camera
    }

    fn shapes() -> [Shape; 3] {
        let rotation = DQuat::from_axis_angle(DVec3::Z, 0.5);
        [
            Shape::Box { min: Point::splat(-0.3), max: Point::new(0.4, 0.2, 0.1), rotation },
            Shape::Sphere { center: Point::new(0.1, 0.2, 0.3), radius: 0.25 },
            Shape::Cylinder { from: Point::new(0.0, 0.0, -0.4), to: Point::new(0.2, 0.1, 0.4), radius: 0.2 },
        ]
    }

    /// Where the handle `grip` of `shape` stands.
    fn find(shape: &Shape, grip: Grip, camera: &Camera) -> Point {
        handles(shape, camera, VIEW).into_iter().find(|h| h.grip == grip).expect("the handle").at
    }

    /// Drags the handle so that it is asked to go to `target`, starting a few pixels beside it.
    fn drag(shape: &Shape, grip: Grip, target: Point, camera: &Camera) -> Shape {
        let at = find(shape, grip, camera);
        let beside = DVec2::new(3.0, -2.0);
        let through = |p: Point| camera.ray(camera.pixel(p, VIEW).unwrap() + beside, VIEW);
        let drag = Drag::new(shape, Handle { grip, at }, &through(at), camera).unwrap();
        assert_eq!(drag.to(&through(at)).as_ref().map(|s| near(s, shape)), Some(true), "no jump");
        drag.to(&through(target)).unwrap()
    }

    fn near(a: &Shape, b: &Shape) -> bool {
        let (a, b) = (Placement::of(a).unwrap(), Placement::of(b).unwrap());
        a.center.distance(b.center) < 1e-9 && a.axes.abs_diff_eq(b.axes, 1e-9)
    }

    #[test]
    fn every_handle_follows_the_pointer() {
        for projection in [Projection::Perspective, Projection::Orthographic] {
            let camera = camera(projection);
            for shape in shapes() {
                for Handle { grip, at } in handles(&shape, &camera, VIEW) {
                    let placement = Placement::of(&shape).unwrap();
                    let [right, up, _] = camera.axes();
                    let by = match grip {
                        Grip::Center | Grip::From | Grip::To => right * 0.1 + up * 0.05,
                        Grip::Axis(axis) => own_axes(&shape).col(axis) * 0.1,
                        Grip::Face { .. } | Grip::Radius => (at - placement.center).normalize() * 0.1,
                        Grip::Section => unreachable!("it is no region's"),
                    };
                    let moved = drag(&shape, grip, at + by, &camera);
                    let now = find(&moved, grip, &camera);
                    // An axis knob keeps its distance in pixels, which perspective changes a little.
                    let slack = if matches!(grip, Grip::Axis(_)) { 0.02 } else { 2e-3 };
                    assert!(now.distance(at + by) < slack, "{projection:?} {grip:?}: {now} for {}", at + by);
                }
            }
        }
    }

    #[test]
    fn a_side_moves_alone() {
        let camera = camera(Projection::Perspective);
        let shape = &shapes()[0];
        let grip = Grip::Face { axis: 1, is_max: true };
        let direction = DQuat::from_axis_angle(DVec3::Z, 0.5) * DVec3::Y;
        let moved = drag(shape, grip, find(shape, grip, &camera) + direction * 0.2, &camera);
        for axis in 0..3 {
            for is_max in [false, true] {
                let other = Grip::Face { axis, is_max };
                let by = find(&moved, other, &camera) - find(shape, other, &camera);
                let expected = if other == grip {
                    direction * 0.2
                } else if axis == 1 {
                    DVec3::ZERO
                } else {
                    direction * 0.1
                };
                assert!(by.distance(expected) < 1e-2, "{other:?} {by} {expected}");
            }
        }
        let Shape::Box { rotation, .. } = moved else { panic!("still a box") };
        assert_eq!(rotation, DQuat::from_axis_angle(DVec3::Z, 0.5));
    }

    #[test]
    fn extents_stay_positive() {
        let camera = camera(Projection::Orthographic);
        let grip = Grip::Face { axis: 0, is_max: true };
        let far = find(&shapes()[0], grip, &camera) - DQuat::from_axis_angle(DVec3::Z, 0.5) * DVec3::X * 5.0;
        let Shape::Box { min, max, .. } = drag(&shapes()[0], grip, far, &camera) else { panic!("a box") };
        assert!((max.x - min.x - 0.007).abs() < 1e-9, "{min} {max}");
        let Shape::Sphere { radius, .. } =
            drag(&shapes()[1], Grip::Radius, Point::new(0.1, 0.2, 0.3), &camera)
        else {
            panic!("a sphere")
        };
        assert!(radius > 0.0);
        let Shape::Cylinder { from, to, .. } =
            drag(&shapes()[2], Grip::From, Point::new(0.2, 0.1, 0.4), &camera)
        else {
            panic!("a cylinder")
        };
        assert!(from.distance(to) > 0.0);
    }

    #[test]
    fn the_nearest_handle_within_reach_is_taken() {
        let camera = camera(Projection::Perspective);
        let all = handles(&shapes()[0], &camera, VIEW);
        for (i, handle) in all.iter().enumerate() {
            let pixel = camera.pixel(handle.at, VIEW).unwrap();
            assert_eq!(handle_at(&all, pixel + DVec2::new(1.0, 1.0), 8.0, &camera, VIEW), Some(i));
        }
        assert_eq!(handle_at(&all, DVec2::new(-50.0, -50.0), 8.0, &camera, VIEW), None);
        let names: Vec<_> = all.iter().map(|h| h.grip.name()).collect();
        assert_eq!(
            names,
            ["min-x", "max-x", "min-y", "max-y", "min-z", "max-z", "move-x", "move-y", "move-z", "center"]
        );
    }
}
