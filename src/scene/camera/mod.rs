//! The camera: a turntable with Z or Y up that orbits about any point, pans, and zooms to any point.

use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI, TAU};

use glam::{DMat3, DMat4, DVec2, DVec3, DVec4};

use crate::geometry::{Aabb, Point};

/// Vertical field of view: 35 degrees, about a 57 mm lens; wider makes parts look bent.
const FIELD_OF_VIEW: f64 = 35.0 * PI / 180.0;
/// Free space around what is framed, as a share of it.
const FRAME_MARGIN: f64 = 1.08;
/// Nearest depth drawn as a share of the farthest, so that 24 bits of depth suffice.
const NEAR_SHARE: f64 = 1e-4;
/// Steepest view: straight down or up.
const STEEPEST: f64 = FRAC_PI_2;

/// How depth shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Projection {
    /// Far things are smaller.
    #[default]
    Perspective,
    /// Parallel lines stay parallel.
    Orthographic,
}

/// A direction to look along.
#[derive(Clone, Copy, Debug, PartialEq, Eq, serde::Deserialize)]
pub enum Axis {
    /// Along +x: the left side is seen.
    #[serde(rename = "+x")]
    PlusX,
    /// Along -x: the right side is seen.
    #[serde(rename = "-x")]
    MinusX,
    /// Along +y: the front is seen.
    #[serde(rename = "+y")]
    PlusY,
    /// Along -y: the back is seen.
    #[serde(rename = "-y")]
    MinusY,
    /// Along +z: the bottom is seen.
    #[serde(rename = "+z")]
    PlusZ,
    /// Along -z: the top is seen.
    #[serde(rename = "-z")]
    MinusZ,
    /// From the front, right and above.
    #[serde(rename = "iso")]
    Iso,
}

/// The direction that is up on the screen.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Up {
    /// As in CAD.
    #[default]
    Z,
    /// As in modelling and animation; the front looks along +z.
    Y,
}

impl Up {
    /// A vector of the turntable, whose own axis is z, in the world.
    fn world_from_turntable(self, v: DVec3) -> DVec3 {
        match self {
            Self::Z => v,
            Self::Y => DVec3::new(v.x, v.z, -v.y),
        }
    }

    /// A direction of the world, seen from the turntable.
    fn turntable_from_world(self, axis: Axis) -> Axis {
        match (self, axis) {
            (Self::Y, Axis::PlusY) => Axis::PlusZ,
            (Self::Y, Axis::MinusY) => Axis::MinusZ,
            (Self::Y, Axis::PlusZ) => Axis::MinusY,
            (Self::Y, Axis::MinusZ) => Axis::PlusY,
            _ => axis,
        }
    }
}

/// Size of the canvas in CSS pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Viewport {
    /// Pixels across.
    pub width: f64,
    /// Pixels down.
    pub height: f64,
}

/// A half-line in world coordinates; the direction is a unit vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ray {
    /// Where it starts.
    pub origin: Point,
    /// Where it goes.
    pub direction: DVec3,
}

/// Where the eye is and which way it looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// The eye.
    pub eye: Point,
    /// What is up.
    pub up: Up,
    /// Turn of the view direction about the upward axis, from +x.
    pub yaw: f64,
    /// Rise of the view direction above the horizon.
    pub pitch: f64,
    /// Distance from the eye to what is looked at: sets the scale of the orthographic view and of pans.
    pub distance: f64,
    /// How depth shows.
    pub projection: Projection,
}

impl Default for Camera {
    fn default() -> Self {
        let unit = Aabb { min: Point::splat(-1.0), max: Point::splat(1.0) };
        let mut camera = Self {
            eye: Point::ZERO,
            up: Up::default(),
            yaw: 0.0,
            pitch: 0.0,
            distance: 1.0,
            projection: Projection::default(),
        };
        camera.turn_to(Axis::Iso);
        camera.frame(corners(&unit), Viewport { width: 1.0, height: 1.0 }, DVec2::ONE);
        camera
    }
}

impl Camera {
    /// Right, up and forward unit vectors.
    pub fn axes(&self) -> [DVec3; 3] {
        let (sin_yaw, cos_yaw) = self.yaw.sin_cos();
        let (sin_pitch, cos_pitch) = self.pitch.sin_cos();
        let forward = DVec3::new(cos_pitch * cos_yaw, cos_pitch * sin_yaw, sin_pitch);
        let right = DVec3::new(sin_yaw, -cos_yaw, 0.0);
        [right, right.cross(forward), forward].map(|v| self.up.world_from_turntable(v))
    }

    /// The point looked at.
    pub fn target(&self) -> Point {
        self.eye + self.axes()[2] * self.distance
    }

    /// Turns by the given angles about a point, which stays where it is on the screen. The pitch stops
    /// at straight down and up.
    pub fn orbit(&mut self, pivot: Point, yaw: f64, pitch: f64) {
        let before = DMat3::from_cols_array_2d(&self.axes().map(|a| a.to_array()));
        self.yaw = (self.yaw + yaw).rem_euclid(TAU);
        self.pitch = (self.pitch + pitch).clamp(-STEEPEST, STEEPEST);
        let after = DMat3::from_cols_array_2d(&self.axes().map(|a| a.to_array()));
        self.eye = pivot + after * (before.transpose() * (self.eye - pivot));
    }

    /// Moves so that what lies at the depth of `grabbed` follows a pointer that goes by `pixels`.
    pub fn pan(&mut self, grabbed: Point, pixels: DVec2, viewport: Viewport) {
        let [right, up, _] = self.axes();
        let size = self.pixel_size(grabbed, viewport);
        self.eye += (up * pixels.y - right * pixels.x) * size;
    }

    /// Scales the distance to `anchor`, which stays where it is on the screen. Less than 1: closer.
    pub fn dolly(&mut self, anchor: Point, factor: f64) {
        self.eye = anchor + (self.eye - anchor) * factor;
        self.distance *= factor;
    }

    /// Looks along an axis at the same target.
    pub fn look_along(&mut self, axis: Axis) {
        let target = self.target();
        self.turn_to(axis);
        self.eye = target - self.axes()[2] * self.distance;
    }

    fn turn_to(&mut self, axis: Axis) {
        // Seen from above, what is behind is up on the screen; so is it from below.
        (self.yaw, self.pitch) = match self.up.turntable_from_world(axis) {
            Axis::PlusX => (0.0, 0.0),
            Axis::MinusX => (PI, 0.0),
            Axis::PlusY => (FRAC_PI_2, 0.0),
            Axis::MinusY => (3.0 * FRAC_PI_2, 0.0),
            Axis::PlusZ => (FRAC_PI_2, FRAC_PI_2),
            Axis::MinusZ => (FRAC_PI_2, -FRAC_PI_2),
            Axis::Iso => (3.0 * FRAC_PI_4, -0.5_f64.atan()),
        };
    }

    /// Moves until the points fill the middle of the viewport, of which they take the `share` across and down,
    /// as near as they all can be seen. Without points nothing happens.
    pub fn frame(&mut self, points: impl IntoIterator<Item = Point>, viewport: Viewport, share: DVec2) {
        let [right, up, forward] = self.axes();
        let tangents = tangents(viewport) * share / FRAME_MARGIN;
        // How far the points reach beyond each side of a pyramid whose tip is at the origin, or of a shaft.
        let slope = if self.projection == Projection::Perspective { tangents } else { DVec2::ZERO };
        let mut reach = [DVec2::NEG_INFINITY; 2];
        let mut depths = Aabb::EMPTY;
        for p in points {
            let (lateral, depth) = (DVec2::new(p.dot(right), p.dot(up)), p.dot(forward));
            reach = [reach[0].max(lateral - slope * depth), reach[1].max(-lateral - slope * depth)];
            depths = depths.with(DVec3::splat(depth));
        }
        if depths.is_empty() {
            return;
        }
        // The tip goes to the middle between opposite sides, and back until both are behind the points.
        let middle = (reach[0] - reach[1]) * 0.5;
        let needed = ((reach[0] + reach[1]) * 0.5 / tangents).max_element();
        let focus = depths.center().x;
        let distance = match self.projection {
            Projection::Perspective => focus + needed,
            Projection::Orthographic => needed,
        };
        // A single point says nothing of the distance.
        if distance > f64::EPSILON * (focus.abs() + middle.abs().max_element()) {
            self.distance = distance;
        }
        self.eye = right * middle.x + up * middle.y + forward * (focus - self.distance);
    }

    /// Size of a pixel at the depth of a point, in world units.
    pub fn pixel_size(&self, at: Point, viewport: Viewport) -> f64 {
        let depth = match self.projection {
            Projection::Perspective => (at - self.eye).dot(self.axes()[2]).max(self.distance * NEAR_SHARE),
            Projection::Orthographic => self.distance,
        };
        2.0 * depth * tangents(viewport).y / viewport.height
    }

    /// The ray through a pixel.
    pub fn ray(&self, pixel: DVec2, viewport: Viewport) -> Ray {
        let [right, up, forward] = self.axes();
        let DVec2 { x: tan_x, y: tan_y } = tangents(viewport);
        let x = (pixel.x / viewport.width * 2.0 - 1.0) * tan_x;
        let y = (1.0 - pixel.y / viewport.height * 2.0) * tan_y;
        let lateral = right * x + up * y;
        match self.projection {
            Projection::Perspective => Ray { origin: self.eye, direction: (forward + lateral).normalize() },
            // From far behind the eye: the orthographic view has no near side.
            Projection::Orthographic => Ray {
                origin: self.eye + lateral * self.distance - forward * self.distance * 1e3,
                direction: forward,
            },
        }
    }

    /// Where a point stands on the screen, or `None` if it is behind the eye.
    pub fn pixel(&self, at: Point, viewport: Viewport) -> Option<DVec2> {
        let [right, up, forward] = self.axes();
        let v = at - self.eye;
        let depth = match self.projection {
            Projection::Perspective => v.dot(forward),
            Projection::Orthographic => self.distance,
        };
        let DVec2 { x: tan_x, y: tan_y } = tangents(viewport);
        let x = v.dot(right) / (depth * tan_x);
        let y = v.dot(up) / (depth * tan_y);
        (depth > 0.0).then(|| DVec2::new((x + 1.0) * 0.5 * viewport.width, (1.0 - y) * 0.5 * viewport.height))
    }

    /// The point under a pixel at the depth of `at`.
    pub fn point_at_depth_of(&self, at: Point, pixel: DVec2, viewport: Viewport) -> Point {
        let forward = self.axes()[2];
        let ray = self.ray(pixel, viewport);
        ray.origin + ray.direction * ((at - ray.origin).dot(forward) / ray.direction.dot(forward))
    }

    /// The transform from world to clip space (depth 0 to 1) that shows all of `bounds` in front of the
    /// eye.
    pub fn clip_from_world(&self, bounds: &Aabb, viewport: Viewport) -> DMat4 {
        let [right, up, forward] = self.axes();
        let (near, far) = self.depths(bounds);
        let DVec2 { x: tan_x, y: tan_y } = tangents(viewport);
        let view_from_world = DMat4::from_cols(
            DVec4::new(right.x, up.x, forward.x, 0.0),
            DVec4::new(right.y, up.y, forward.y, 0.0),
            DVec4::new(right.z, up.z, forward.z, 0.0),
            DVec4::new(-right.dot(self.eye), -up.dot(self.eye), -forward.dot(self.eye), 1.0),
        );
        let range = far - near;
        let clip_from_view = match self.projection {
            Projection::Perspective => DMat4::from_cols(
                DVec4::new(1.0 / tan_x, 0.0, 0.0, 0.0),
                DVec4::new(0.0, 1.0 / tan_y, 0.0, 0.0),
                DVec4::new(0.0, 0.0, far / range, 1.0),
                DVec4::new(0.0, 0.0, -far * near / range, 0.0),
            ),
            Projection::Orthographic => DMat4::from_cols(
                DVec4::new(1.0 / (tan_x * self.distance), 0.0, 0.0, 0.0),
                DVec4::new(0.0, 1.0 / (tan_y * self.distance), 0.0, 0.0),
                DVec4::new(0.0, 0.0, 1.0 / range, 0.0),
                DVec4::new(0.0, 0.0, -near / range, 1.0),
            ),
        };
        clip_from_view * view_from_world
    }

    /// Least and greatest depth of `bounds`, with a little room.
    fn depths(&self, bounds: &Aabb) -> (f64, f64) {
        let forward = self.axes()[2];
        let (low, high) = corners(bounds)
            .map(|c| (c - self.eye).dot(forward))
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), d| (low.min(d), high.max(d)));
        let room = 0.01 * (high - low) + 1e-3 * self.distance;
        let (low, high) = if low <= high { (low - room, high + room) } else { (-room, room) };
        match self.projection {
            Projection::Orthographic => (low, high),
            Projection::Perspective => {
                let far = high.max(self.distance);
                (low.max(far * NEAR_SHARE), far)
            }
        }
    }

    /// The camera on the way from `self` (0) to `other` (1), turning the short way.
    pub fn between(&self, other: &Self, share: f64) -> Self {
        let turn = (other.yaw - self.yaw + PI).rem_euclid(TAU) - PI;
        let mut camera = *other;
        camera.yaw = self.yaw + turn * share;
        camera.pitch = self.pitch + (other.pitch - self.pitch) * share;
        camera.distance = self.distance * (other.distance / self.distance).powf(share);
        let target = self.target().lerp(other.target(), share);
        camera.eye = target - camera.axes()[2] * camera.distance;
        camera
    }
}

/// Tangents of half the field of view, across and up.
fn tangents(viewport: Viewport) -> DVec2 {
    let aspect = viewport.width / viewport.height;
    DVec2::new(aspect, 1.0) * (FIELD_OF_VIEW * 0.5).tan()
}

/// The corners of a box; none of an empty one.
pub(super) fn corners(bounds: &Aabb) -> impl Iterator<Item = Point> + use<> {
    let ends = [bounds.min, bounds.max];
    let count = if bounds.is_empty() { 0 } else { 8 };
    (0..count).map(move |i: usize| Point::new(ends[i & 1].x, ends[i >> 1 & 1].y, ends[i >> 2].z))
}

#[cfg(test)]
mod tests;
