//! Where the camera goes to show what there is, and the transforms of a frame.

use glam::{DMat4, DVec2, Mat4, Vec4};

use super::{Axis, Camera, Placement, Projection, Scene, camera::corners};
use crate::geometry::{Aabb, Point};

impl Scene {
    /// The camera that shows everything from where it looks now.
    pub fn framed(&self) -> Camera {
        self.framing_all(self.camera)
    }

    /// The camera moved to where it shows the points.
    pub(super) fn framing(&self, points: impl IntoIterator<Item = Point>) -> Camera {
        let mut camera = self.camera;
        camera.frame(points, self.viewport, self.clear());
        camera
    }

    /// `camera` moved to where it shows everything.
    fn framing_all(&self, mut camera: Camera) -> Camera {
        let frame = self.frame();
        let surface = self.surface().into_iter().flat_map(|s| s.positions());
        let surface = surface.map(move |p| frame.world(p.as_dvec3()));
        let boxes = self.placements().iter().flatten().map(Placement::bounds).chain(self.frame_box);
        camera.frame(surface.chain(boxes.flat_map(|b| corners(&b))), self.viewport, self.clear());
        camera
    }

    /// The share of the canvas, across and down, that nothing covers; at least a quarter.
    fn clear(&self) -> DVec2 {
        let size = DVec2::new(self.viewport.width, self.viewport.height);
        (1.0 - 2.0 * DVec2::from_array(self.style.covered) / size).max(DVec2::splat(0.25))
    }

    /// The camera that shows a face and what is around it, or `None` if there is no such face.
    pub fn framed_face(&self, face: usize) -> Option<Camera> {
        let surface = self.surface().filter(|s| face < s.face_count())?;
        Some(self.framed_box(&surface.face_bounds(face)))
    }

    /// The camera that shows a box and what is around it.
    pub fn framed_box(&self, bounds: &Aabb) -> Camera {
        self.framing(corners(&bounds.grown(SURROUNDINGS * bounds.diagonal())))
    }

    /// The camera that shows everything along an axis.
    pub fn along(&self, axis: Axis) -> Camera {
        let mut camera = self.camera;
        camera.look_along(axis);
        self.framing_all(camera)
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
/// What is shown around a framed box, in diagonals of it.
const SURROUNDINGS: f64 = 3.0;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Style, Surface, Viewport};

    #[test]
    fn what_is_framed_stays_clear_of_what_is_covered() {
        let nodes = [0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 4.0, 2.0, 0.0, 0.0, 2.0, 1.0];
        let style = Style { covered: [300.0, 100.0], ..Style::default() };
        let viewport = Viewport { width: 1000.0, height: 800.0 };
        let mut scene = Scene::default();
        scene.set_surface(Some(Surface::new(&nodes, None, vec![0, 1, 2, 3]).unwrap()));
        (scene.viewport, scene.style) = (viewport, style);
        for axis in [Axis::PlusX, Axis::MinusY, Axis::MinusZ, Axis::Iso] {
            let camera = scene.along(axis);
            for node in nodes.chunks(3) {
                let at = camera.pixel(Point::new(node[0], node[1], node[2]), viewport).unwrap();
                assert!((300.0..=700.0).contains(&at.x) && (100.0..=700.0).contains(&at.y), "{axis:?}: {at}");
            }
        }
    }
}
