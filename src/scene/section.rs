//! A plane that cuts a hex mesh open between whole cells, and the handle that moves it.

use glam::{DVec3, Vec3};

use super::{
    Camera, Frame, Grip, Handle, Ray, Viewport,
    camera::corners,
    handle::{AXIS_PIXELS, Guide},
};
use crate::geometry::{Aabb, Point};

/// How far beyond the plane a cell's middle may lie and still be shown, in scene units: the middles of one layer of
/// cells, which rounding puts on both sides of a plane through them, stay together.
const ROUNDING: f32 = 1e-5;
/// Room between the mesh and the outline of the plane, as a share of the mesh.
const OUTLINE_ROOM: f64 = 0.03;
/// A view closer to the plane's normal than this sine drags by pixels up and down: along the normal nothing moves.
const STEEP: f64 = 0.1;

/// Cells whose middle `m` lies beyond, `normal . m > offset`, are hidden. World coordinates; the normal has length 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    normal: DVec3,
    offset: f64,
}

impl Section {
    /// The plane `normal . p = offset`, for a normal of any length; `None` if it has no direction or is not finite.
    pub fn new(normal: DVec3, offset: f64) -> Option<Self> {
        let length = normal.length();
        // What has length 1 but for rounding stays the same plane, bit by bit.
        let is_unit = (length - 1.0).abs() < 1e-12;
        let normal = if is_unit { normal } else { normal.try_normalize()? };
        let plane = Self { normal, offset: if is_unit { offset } else { offset / length } };
        plane.offset.is_finite().then_some(plane)
    }

    /// The unit normal: what it points at is hidden.
    pub fn normal(&self) -> DVec3 {
        self.normal
    }

    /// Distance of the plane from the origin, along the normal.
    pub fn offset(&self) -> f64 {
        self.offset
    }

    /// The plane in the scene: `p` is kept where `normal . p <= offset`.
    pub(super) fn in_scene(&self, frame: &Frame) -> (Vec3, f32) {
        let offset = (self.offset - self.normal.dot(frame.origin)) * frame.scale;
        (self.normal.as_vec3(), offset as f32 + ROUNDING)
    }

    /// The point of the plane below the middle of `bounds`.
    fn middle(&self, bounds: &Aabb) -> Point {
        let center = bounds.center();
        center + self.normal * (self.offset - self.normal.dot(center))
    }

    /// The sides of the polygon in which the plane cuts a box a little larger than `bounds`; none if it misses it.
    pub(super) fn outline(&self, bounds: &Aabb) -> Vec<[Point; 2]> {
        let around: Vec<Point> = corners(&bounds.grown(OUTLINE_ROOM * bounds.diagonal())).collect();
        let height = |p: Point| self.normal.dot(p) - self.offset;
        let edges = (0..around.len()).flat_map(|a| [1, 2, 4].map(|bit| (a, a | bit)));
        let mut points: Vec<Point> = edges
            .filter(|(a, b)| a != b)
            .filter_map(|(a, b)| {
                let (from, to) = (height(around[a]), height(around[b]));
                ((from < 0.0) != (to < 0.0)).then(|| around[a].lerp(around[b], from / (from - to)))
            })
            .collect();
        let Some(middle) = (!points.is_empty()).then(|| points.iter().sum::<Point>() / points.len() as f64)
        else {
            return Vec::new();
        };
        let (u, v) = self.normal.any_orthonormal_pair();
        let angle = |p: &Point| (*p - middle).dot(v).atan2((*p - middle).dot(u));
        points.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
        (0..points.len()).map(|k| [points[k], points[(k + 1) % points.len()]]).collect()
    }

    /// The foot and the knob of the handle, which stands on the plane's middle.
    pub(super) fn handle(&self, bounds: &Aabb, camera: &Camera, viewport: Viewport) -> (Point, Handle) {
        let foot = self.middle(bounds);
        let at = foot + self.normal * (AXIS_PIXELS * camera.pixel_size(foot, viewport));
        (foot, Handle { grip: Grip::Section, at })
    }

    /// The plane moved to where it still touches `bounds`.
    pub(super) fn within(self, bounds: &Aabb) -> Self {
        let heights = || corners(bounds).map(|p| self.normal.dot(p));
        let (low, high) =
            heights().fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        if low > high { self } else { Self { offset: self.offset.clamp(low, high), ..self } }
    }
}

/// A section's handle being dragged.
#[derive(Clone, Debug)]
pub(super) struct SectionDrag {
    section: Section,
    at: Point,
    guide: Guide,
    /// What a move along the guide counts as along the normal.
    along: DVec3,
    start: Point,
}

impl SectionDrag {
    /// Takes hold of the knob of `section`, which stands at `at`, with a ray through the pointer.
    pub fn new(section: Section, at: Point, ray: &Ray, camera: &Camera) -> Option<Self> {
        let [_, up, forward] = camera.axes();
        let is_steep = section.normal.cross(forward).length() < STEEP;
        // A plane seen from its hidden side goes away from the eye as the pointer goes up.
        let away = -section.normal.dot(forward).signum();
        let (guide, along) = if is_steep {
            (Guide::Plane { normal: forward }, up * -away)
        } else {
            (Guide::Line { direction: section.normal }, section.normal)
        };
        let start = guide.meet(at, ray)?;
        Some(Self { section, at, guide, along, start })
    }

    /// The plane when the pointer's ray is `ray`, kept touching `bounds`; `None` where the ray says nothing.
    pub fn to(&self, ray: &Ray, bounds: &Aabb) -> Option<Section> {
        let by = (self.guide.meet(self.at, ray)? - self.start).dot(self.along);
        let offset = self.section.offset + by;
        offset.is_finite().then(|| Section { offset, ..self.section }.within(bounds))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Axis;

    const VIEW: Viewport = Viewport { width: 640.0, height: 480.0 };

    fn unit() -> Aabb {
        Aabb { min: Point::ZERO, max: Point::ONE }
    }

    #[test]
    fn normals_of_any_length_name_the_same_plane() {
        let plane = Section::new(DVec3::new(0.0, 0.0, -4.0), -2.0).unwrap();
        assert_eq!((plane.normal(), plane.offset()), (DVec3::NEG_Z, -0.5));
        for (normal, offset) in [(DVec3::ZERO, 0.0), (DVec3::NAN, 0.0), (DVec3::X, f64::INFINITY)] {
            assert_eq!(Section::new(normal, offset), None);
        }
    }

    #[test]
    fn the_outline_goes_around_the_cut_box() {
        let length = |lines: &[[Point; 2]]| lines.iter().map(|[a, b]| a.distance(*b)).sum::<f64>();
        let room = 2.0 * OUTLINE_ROOM * unit().diagonal();
        let square = Section::new(DVec3::Y, 0.3).unwrap().outline(&unit());
        assert_eq!(square.len(), 4);
        assert!((length(&square) - 4.0 * (1.0 + room)).abs() < 1e-12);
        let hexagon = Section::new(DVec3::ONE, 1.5).unwrap().outline(&unit());
        assert_eq!(hexagon.len(), 6);
        assert!((length(&hexagon) - 6.0 * 0.5_f64.sqrt() * (1.0 + room)).abs() < 1e-12);
        assert!(Section::new(DVec3::Y, 2.0).unwrap().outline(&unit()).is_empty());
    }

    /// Drags the plane's knob so that it is asked to go to where it would be with `wanted`.
    fn drag(section: Section, wanted: Section, camera: &Camera) -> Section {
        let (_, handle) = section.handle(&unit(), camera, VIEW);
        let (_, target) = wanted.handle(&unit(), camera, VIEW);
        let ray = |p| camera.ray(camera.pixel(p, VIEW).unwrap(), VIEW);
        let drag = SectionDrag::new(section, handle.at, &ray(handle.at), camera).unwrap();
        let still = drag.to(&ray(handle.at), &unit()).unwrap();
        assert!((still.offset - section.offset).abs() < 1e-12, "no jump");
        drag.to(&ray(target.at), &unit()).unwrap()
    }

    #[test]
    fn the_knob_moves_the_plane_and_leaves_it_in_the_mesh() {
        let mut camera = Camera::default();
        camera.look_along(Axis::Iso);
        for normal in [DVec3::X, DVec3::NEG_Y, DVec3::new(0.2, 0.3, 0.9)] {
            let at = |share: f64| Section::new(normal, normal.dot(Point::splat(share))).unwrap();
            let moved = drag(at(0.5), at(0.6), &camera);
            // The knob keeps its distance in pixels, which perspective changes a little.
            assert!((moved.offset - at(0.6).offset).abs() < 0.01, "{} {}", moved.offset, at(0.6).offset);
            let beyond = drag(at(0.5), at(3.0), &camera);
            assert_eq!(beyond, at(3.0).within(&unit()));
        }
    }

    #[test]
    fn seen_along_its_normal_the_plane_goes_away_as_the_pointer_goes_up() {
        let mut camera = Camera::default();
        camera.look_along(Axis::PlusY);
        let (front, back) = (Section::new(DVec3::NEG_Y, -0.5).unwrap(), Section::new(DVec3::Y, 0.5).unwrap());
        let ray = |x: f64, y: f64| camera.ray(glam::DVec2::new(x, y), VIEW);
        for section in [front, back] {
            let (_, handle) = section.handle(&unit(), &camera, VIEW);
            let drag = SectionDrag::new(section, handle.at, &ray(320.0, 240.0), &camera).unwrap();
            let up = drag.to(&ray(320.0, 200.0), &unit()).unwrap();
            let y = up.normal.y * up.offset;
            assert!(y > 0.5 && y <= 1.0, "{y}");
        }
    }
}
