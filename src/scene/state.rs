//! All that a frame shows, and what a pointer does to it.

use std::cell::OnceCell;

use glam::DVec2;

use super::{
    Background, Bvh, Camera, Cutaway, Drag, FeatureLine, Frame, FrontBuffers, Grip, Handle, Hit, Placement,
    RegionBuffers, Surface, Viewport, handle, overlay,
};
use crate::{
    geometry::{Aabb, Point},
    sizing::Shape,
};

/// How the scene is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Style {
    /// Edges of faces are shown.
    pub edges: bool,
    /// Their width in CSS pixels.
    pub edge_width: f32,
    /// What stands behind the model.
    pub background: Background,
    /// CSS pixels at both sides, and at the upper and lower end, of the canvas that something covers: what is
    /// framed and the axes stay clear of them.
    pub covered: [f64; 2],
}

impl Default for Style {
    fn default() -> Self {
        Self { edges: true, edge_width: 1.0, background: Background::default(), covered: [0.0; 2] }
    }
}

/// A surface and regions, seen by a camera.
#[derive(Clone, Debug)]
pub struct Scene {
    /// The eye.
    pub camera: Camera,
    /// The canvas.
    pub viewport: Viewport,
    /// How it is drawn.
    pub style: Style,
    pub(super) surface: Option<Surface>,
    pub(super) tree: OnceCell<Bvh>,
    /// The hex mesh that the surface shows, if it shows one.
    pub(super) cutaway: Option<Cutaway>,
    /// A box whose edges are drawn.
    pub(super) frame_box: Option<Aabb>,
    /// The features of a solid.
    features: Vec<FeatureLine>,
    regions: Vec<Shape>,
    placements: Vec<Option<Placement>>,
    selected: Option<usize>,
    hovered: Option<Grip>,
    drag: Option<Drag>,
    /// What the camera turns about or moves while a pointer is down.
    grabbed: Option<Point>,
    /// What it turns about where there is no face under the pointer, if the user chose it.
    pivot: Option<Point>,
}

impl Default for Scene {
    fn default() -> Self {
        Self {
            camera: Camera::default(),
            viewport: Viewport { width: 1.0, height: 1.0 },
            style: Style::default(),
            surface: None,
            tree: OnceCell::new(),
            cutaway: None,
            frame_box: None,
            features: Vec::new(),
            regions: Vec::new(),
            placements: Vec::new(),
            selected: None,
            hovered: None,
            drag: None,
            grabbed: None,
            pivot: None,
        }
    }
}

impl Scene {
    /// Replaces the surface.
    pub fn set_surface(&mut self, surface: Option<Surface>) {
        self.surface = surface;
        self.tree = OnceCell::new();
        self.cutaway = None;
        self.pivot = None;
    }

    /// Replaces the regions. The selected one shows its handles; a drag of it goes on.
    pub fn set_regions(&mut self, regions: Vec<Shape>, selected: Option<usize>) {
        self.placements = regions.iter().map(Placement::of).collect();
        self.regions = regions;
        if selected != self.selected {
            self.selected = selected;
            self.hovered = None;
            self.drag = None;
        }
    }

    /// Draws the edges of a box, in world coordinates, or of none.
    pub fn set_box(&mut self, frame_box: Option<Aabb>) {
        self.frame_box = frame_box;
    }

    /// Draws the features of a solid, or none.
    pub fn set_features(&mut self, features: Vec<FeatureLine>) {
        self.features = features;
    }

    /// The regions.
    pub fn regions(&self) -> &[Shape] {
        &self.regions
    }

    /// Where the regions that can be drawn are.
    pub fn placements(&self) -> &[Option<Placement>] {
        &self.placements
    }

    /// The region that shows its handles.
    pub fn selected(&self) -> Option<usize> {
        self.selected.filter(|&i| i < self.regions.len())
    }

    /// The handles of the selected region.
    pub fn handles(&self) -> Vec<Handle> {
        self.selected()
            .map_or_else(Vec::new, |i| handle::handles(&self.regions[i], &self.camera, self.viewport))
    }

    fn handle_at(&self, pixel: DVec2, reach: f64) -> Option<Handle> {
        let mut handles = self.handles();
        handles.extend(self.section_handle());
        handle::handle_at(&handles, pixel, reach, &self.camera, self.viewport).map(|i| handles[i])
    }

    /// Marks the handle within `reach` pixels of a pixel, if any.
    pub fn hover(&mut self, pixel: DVec2, reach: f64) {
        self.hovered = self.handle_at(pixel, reach).map(|h| h.grip);
    }

    /// The handle that is marked.
    pub fn hovered(&self) -> Option<Grip> {
        self.hovered
    }

    /// The region whose handle is held.
    pub fn held_region(&self) -> Option<&Shape> {
        self.selected().filter(|_| self.drag.is_some()).map(|i| &self.regions[i])
    }

    /// Takes hold of the handle within `reach` pixels of a pixel. False: there is none.
    pub fn drag_start(&mut self, pixel: DVec2, reach: f64) -> bool {
        let Some(handle) = self.handle_at(pixel, reach) else { return false };
        if handle.grip == Grip::Section {
            return self.drag_section_from(handle, pixel);
        }
        let ray = self.camera.ray(pixel, self.viewport);
        self.drag = self
            .selected()
            .and_then(|selected| Drag::new(&self.regions[selected], handle, &ray, &self.camera));
        self.drag.is_some()
    }

    /// Drags the held handle to a pixel; the region as it is then. `None` if no handle is held.
    pub fn drag_to(&mut self, pixel: DVec2) -> Option<&Shape> {
        let selected = self.selected()?;
        let drag = self.drag.as_ref()?;
        if let Some(shape) = drag.to(&self.camera.ray(pixel, self.viewport)) {
            self.placements[selected] = Placement::of(&shape);
            self.regions[selected] = shape;
        }
        Some(&self.regions[selected])
    }

    /// Takes hold of the surface under a pixel, or of the middle: [`Scene::orbit`] turns about it,
    /// [`Scene::pan`] makes it follow the pointer.
    pub fn grab(&mut self, pixel: DVec2) {
        self.grabbed = Some(self.pick(pixel).map_or_else(|| self.middle(), |hit| hit.point));
    }

    /// As [`Scene::grab`] where there is no surface.
    pub fn grab_middle(&mut self) {
        self.grabbed = Some(self.middle());
    }

    /// Lets go of what was grabbed or dragged.
    pub fn release(&mut self) {
        self.grabbed = None;
        self.drag = None;
        self.release_section();
    }

    /// Turns about what was grabbed, by radians.
    pub fn orbit(&mut self, yaw: f64, pitch: f64) {
        if let Some(pivot) = self.grabbed {
            self.camera.orbit(pivot, yaw, pitch);
        }
    }

    /// Moves what was grabbed by pixels.
    pub fn pan(&mut self, pixels: DVec2) {
        if let Some(grabbed) = self.grabbed {
            self.camera.pan(grabbed, pixels, self.viewport);
        }
    }

    /// Turns about the point of the surface under a pixel from now on, wherever a drag starts beside the
    /// surface; the camera that looks at it. Beside the surface: about the middle again, and no camera.
    pub fn set_pivot(&mut self, pixel: DVec2) -> Option<Camera> {
        self.pivot = self.pick(pixel).map(|hit| hit.point);
        let pivot = self.pivot?;
        let middle = DVec2::new(self.viewport.width, self.viewport.height) * 0.5;
        let mut camera = self.camera;
        camera.pan(pivot, middle - pixel, self.viewport);
        camera.distance = (pivot - camera.eye).dot(camera.axes()[2]).max(f64::MIN_POSITIVE);
        Some(camera)
    }

    /// What the camera turns about, while it does.
    pub fn pivot_shown(&self) -> Option<Point> {
        self.grabbed
    }

    /// The nearest region under a pixel.
    pub fn region_at(&self, pixel: DVec2) -> Option<usize> {
        let ray = self.camera.ray(pixel, self.viewport);
        self.placements
            .iter()
            .enumerate()
            .filter_map(|(i, p)| Some((i, p.as_ref()?.entry(&ray)?)))
            .min_by(|a, b| a.1.total_cmp(&b.1))
            .map(|(i, _)| i)
    }

    /// Draw buffers of the regions, of the box and of the features.
    pub fn region_buffers(&self) -> RegionBuffers {
        let (theme, frame) = (self.style.background.theme(), self.frame());
        let mut buffers = overlay::region_buffers(&self.placements, self.selected(), &frame, &theme);
        buffers.outlines.extend(self.frame_box.iter().flat_map(|b| overlay::box_outline(b, &frame, &theme)));
        buffers.outlines.extend(self.features.iter().flat_map(|line| line.segments(&frame, &theme)));
        buffers.discs.extend(self.features.iter().filter_map(|line| line.disc(&frame, &theme)));
        buffers
    }

    /// Draw buffers of handles, pivot and triad.
    pub fn front_buffers(&self) -> FrontBuffers {
        overlay::front_buffers(self)
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
        let surface = self.surface.as_ref().map_or(Aabb::EMPTY, |s| *s.bounds());
        let regions = self.placements.iter().flatten().map(Placement::bounds);
        regions
            .chain(self.frame_box)
            .fold(surface, |all, b| Aabb { min: all.min.min(b.min), max: all.max.max(b.max) })
    }

    /// The first face under a pixel.
    pub fn pick(&self, pixel: DVec2) -> Option<Hit> {
        let (surface, tree) = self.prepare_picking()?;
        tree.first_hit(surface, &self.camera.ray(pixel, self.viewport))
    }

    /// Sorts the surface's faces for picking, unless that is done. The first pick does so by itself.
    pub fn prepare_picking(&self) -> Option<(&Surface, &Bvh)> {
        let surface = self.surface.as_ref()?;
        Some((surface, self.tree.get_or_init(|| Bvh::new(surface))))
    }

    /// The point under a pixel: on the surface, or else at the depth of what the camera looks at.
    pub fn point_under(&self, pixel: DVec2) -> Point {
        self.pick(pixel).map_or_else(
            || self.camera.point_at_depth_of(self.camera.target(), pixel, self.viewport),
            |hit| hit.point,
        )
    }

    /// What to turn about where there is no surface: the chosen point, or the middle of all that is shown.
    fn middle(&self) -> Point {
        let bounds = self.bounds();
        let middle = if bounds.is_empty() { self.camera.target() } else { bounds.center() };
        self.pivot.unwrap_or(middle)
    }
}
