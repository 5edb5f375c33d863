//! All that a frame shows, and what a pointer does to it.

use std::cell::OnceCell;

use glam::{DMat4, DVec2, Mat4, Vec4};

use super::{Axis, Background, Bvh, Camera, Frame, Hit, Projection, Surface, Viewport};
use crate::geometry::{Aabb, Point};

/// How the scene is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Edges of faces are shown.
    pub edges: bool,
    /// Their width in CSS pixels.
    pub edge_width: f32,
    /// What stands behind the model.
    pub background: Background,
}

impl Default for Style {
    fn default() -> Self {
        Self { edges: true, edge_width: 1.0, background: Background::default() }
    }
}

/// A surface seen by a camera.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The eye.
    pub camera: Camera,
    /// The canvas.
    pub viewport: Viewport,
    /// How it is drawn.
    pub style: Style,
    surface: Option<Surface>,
    tree: OnceCell<Bvh>,
}

impl Default for Scene {
    fn default() -> Self {
        Self {
            camera: Camera::default(),
            viewport: Viewport { width: 1.0, height: 1.0 },
            style: Style::default(),
            surface: None,
            tree: OnceCell::new(),
        }
    }
}

impl Scene {
    /// Replaces the surface.
    pub fn set_surface(&mut self, surface: Option<Surface>) {
        self.surface = surface;
        self.tree = OnceCell::new();
    }

    /// The surface.
    pub fn surface(&self) -> Option<&Surface> {
        self.surface.as_ref()
    }

    /// Where the scene stands in the world.
    pub fn frame(&self) -> Frame {
        self.surface.as_ref().map_or_else(Frame::default, |s| *s.frame())
    }

    /// The box around all that is shown, in world coordinates.
    pub fn bounds(&self) -> Aabb {
        self.surface.as_ref().map_or(Aabb::EMPTY, |s| *s.bounds())
    }

    /// The first face under a pixel. The first call on a surface sorts its faces.
    pub fn pick(&self, pixel: DVec2) -> Option<Hit> {
        let surface = self.surface.as_ref()?;
        let tree = self.tree.get_or_init(|| Bvh::new(surface));
        tree.first_hit(surface, &self.camera.ray(pixel, self.viewport))
    }

    /// The point under a pixel: on the surface, or else at the depth of what the camera looks at.
    pub fn point_under(&self, pixel: DVec2) -> Point {
        self.pick(pixel).map_or_else(
            || self.camera.point_at_depth_of(self.camera.target(), pixel, self.viewport),
            |hit| hit.point,
        )
    }

    /// What to turn about when a drag starts at a pixel: the point on the surface, or else the middle of
    /// all that is shown.
    pub fn pivot_under(&self, pixel: DVec2) -> Point {
        let bounds = self.bounds();
        let middle = if bounds.is_empty() { self.camera.target() } else { bounds.center() };
        self.pick(pixel).map_or(middle, |hit| hit.point)
    }

    /// The camera that shows everything from where it looks now.
    pub fn framed(&self) -> Camera {
        let mut camera = self.camera;
        camera.frame(&self.bounds(), self.viewport);
        camera
    }

    /// The camera that shows a face and what is around it, or `None` if there is no such face.
    pub fn framed_face(&self, face: usize) -> Option<Camera> {
        let surface = self.surface.as_ref().filter(|s| face < s.face_count())?;
        let bounds = surface.face_bounds(face);
        let mut camera = self.camera;
        camera.frame(&bounds.grown(FACE_SURROUNDINGS * bounds.diagonal()), self.viewport);
        Some(camera)
    }

    /// The camera that shows everything along an axis.
    pub fn along(&self, axis: Axis) -> Camera {
        let mut camera = self.camera;
        camera.look_along(axis);
        camera.frame(&self.bounds(), self.viewport);
        camera
    }

    /// Scales the distance to `anchor`, within reason: neither through the surface's own digits nor so
    /// far out that it cannot be found again.
    pub fn zoom(&mut self, anchor: Point, factor: f64) {
        let size = self.bounds().diagonal();
        let limits = if size > 0.0 { ZOOM_LIMITS.map(|l| l * size) } else { [0.0, f64::MAX] };
        let distance = (self.camera.distance * factor).clamp(limits[0], limits[1]);
        self.camera.dolly(anchor, distance / self.camera.distance);
    }

    /// The transform from scene to clip space.
    pub fn clip_from_scene(&self) -> Mat4 {
        let clip_from_world = self.camera.clip_from_world(&self.bounds(), self.viewport);
        (clip_from_world * self.frame().world_from_scene()).as_mat4()
    }

    /// The rotation from scene to view directions: x right, y up, z towards the eye.
    pub fn view_from_scene(&self) -> Mat4 {
        let [right, up, forward] = self.camera.axes();
        DMat4::from_cols(right.extend(0.0), up.extend(0.0), (-forward).extend(0.0), glam::DVec4::W)
            .transpose()
            .as_mat4()
    }

    /// The eye in the scene (w = 1), or the direction towards it where the view is orthographic (w = 0).
    pub fn eye(&self) -> Vec4 {
        match self.camera.projection {
            Projection::Perspective => self.frame().scene(self.camera.eye).extend(1.0),
            Projection::Orthographic => (-self.camera.axes()[2]).as_vec3().extend(0.0),
        }
    }
}

/// Least and greatest distance of the eye, in diagonals of what is shown.
const ZOOM_LIMITS: [f64; 2] = [1e-5, 50.0];
/// What is shown around a framed face, in diagonals of it.
const FACE_SURROUNDINGS: f64 = 3.0;
