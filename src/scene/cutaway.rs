//! A hex mesh in the scene: what is cut away, the cell that is marked, and the plane under the pointer.

use glam::DVec2;

use super::{
    Camera, Cut, Handle, Hexes, Scene, Section,
    camera::corners,
    overlay::{Disc, FrontBuffers, KNOB, KNOB_HOVERED, KNOB_RING, Segment},
    section::SectionDrag,
    theme::Theme,
};
use crate::mesh::numbering::hex::EDGES;

/// Width of a marked cell's edges, in CSS pixels.
const MARK: f32 = 2.5;
/// Width of the plane's outline, in CSS pixels.
const OUTLINE: f32 = 1.5;
/// What is shown around a framed cell, in diagonals of it.
const CELL_SURROUNDINGS: f64 = 1.3;

/// A hex mesh that is looked into. The scene's surface is what its cut leaves.
#[derive(Clone, Debug)]
pub struct Cutaway {
    hexes: Hexes,
    cut: Cut,
    /// The cell behind each face of the surface.
    cells: Vec<u32>,
    marked: Option<usize>,
    drag: Option<SectionDrag>,
}

impl Cutaway {
    /// The mesh.
    pub fn hexes(&self) -> &Hexes {
        &self.hexes
    }

    /// What is cut away.
    pub fn cut(&self) -> &Cut {
        &self.cut
    }

    /// The cell behind each face of the scene's surface.
    pub fn cells(&self) -> &[u32] {
        &self.cells
    }
}

impl Scene {
    /// Shows a hex mesh, all of it, in place of the surface.
    pub fn set_hexes(&mut self, hexes: Hexes) {
        self.set_surface(None);
        self.cutaway =
            Some(Cutaway { hexes, cut: Cut::default(), cells: Vec::new(), marked: None, drag: None });
        self.set_cut(Cut::default());
    }

    /// The hex mesh that is shown.
    pub fn cutaway(&self) -> Option<&Cutaway> {
        self.cutaway.as_ref()
    }

    /// Cuts the hex mesh that is shown.
    pub fn set_cut(&mut self, cut: Cut) {
        let Some(cutaway) = &mut self.cutaway else { return };
        let (surface, cells) = cutaway.hexes.surface(&cut);
        (cutaway.cut, cutaway.cells) = (cut, cells);
        self.surface = Some(surface);
        self.tree.take();
    }

    /// Marks a cell of the hex mesh with lines over all else; a number that no cell has marks none.
    pub fn mark(&mut self, cell: Option<usize>) {
        if let Some(cutaway) = &mut self.cutaway {
            cutaway.marked = cell.filter(|&cell| cell < cutaway.hexes.len());
        }
    }

    /// The camera that shows a cell and what is around it, or `None` if there is no such cell.
    pub fn framed_cell(&self, cell: usize) -> Option<Camera> {
        let hexes = self.cutaway().map(Cutaway::hexes).filter(|hexes| cell < hexes.len())?;
        let bounds = hexes.cell_bounds(cell);
        let around = bounds.grown(CELL_SURROUNDINGS * bounds.diagonal());
        Some(self.framing(corners(&around)))
    }

    fn section(&self) -> Option<Section> {
        self.cutaway().and_then(|cutaway| cutaway.cut.section)
    }

    /// The handle of the plane that cuts the hex mesh.
    pub fn section_handle(&self) -> Option<Handle> {
        let hexes = self.cutaway()?.hexes();
        Some(self.section()?.handle(hexes.nodes().bounds(), &self.camera, self.viewport).1)
    }

    /// Takes hold of the plane by its handle. False: the pointer's ray says nothing of it.
    pub(super) fn drag_section_from(&mut self, handle: Handle, pixel: DVec2) -> bool {
        let ray = self.camera.ray(pixel, self.viewport);
        let drag = self.section().and_then(|s| SectionDrag::new(s, handle.at, &ray, &self.camera));
        let is_held = drag.is_some();
        if let Some(cutaway) = &mut self.cutaway {
            cutaway.drag = drag;
        }
        is_held
    }

    /// Lets go of the plane.
    pub(super) fn release_section(&mut self) {
        if let Some(cutaway) = &mut self.cutaway {
            cutaway.drag = None;
        }
    }

    /// The plane, if it is held.
    pub fn held_section(&self) -> Option<Section> {
        self.section().filter(|_| self.cutaway().is_some_and(|cutaway| cutaway.drag.is_some()))
    }

    /// Drags the held plane to a pixel; the plane as it is then. `None` if it is not held.
    pub fn drag_section_to(&mut self, pixel: DVec2) -> Option<Section> {
        let ray = self.camera.ray(pixel, self.viewport);
        let cutaway = self.cutaway.as_ref()?;
        let to = cutaway.drag.as_ref()?.to(&ray, cutaway.hexes.nodes().bounds());
        if let Some(section) = to.filter(|_| to != cutaway.cut.section) {
            self.set_cut(Cut { section: Some(section), ..cutaway.cut.clone() });
        }
        self.section()
    }

    /// The plane's outline and handle, and the marked cell, over all else.
    pub(super) fn add_cutaway(&self, out: &mut FrontBuffers, theme: &Theme) {
        let Some(cutaway) = &self.cutaway else { return };
        let (hexes, frame) = (&cutaway.hexes, self.frame());
        let line = |width, colour| move |from, to| Segment { from, to, width, colour };
        if let Some(cell) = cutaway.marked {
            let (nodes, positions) = (hexes.cell(cell), hexes.nodes().positions());
            let mark = line(MARK, theme.selected);
            let end = |k: u8| positions[nodes[usize::from(k)] as usize];
            out.lines.extend(EDGES.map(|[a, b]| mark(end(a), end(b))));
        }
        let Some(section) = cutaway.cut.section else { return };
        let bounds = hexes.nodes().bounds();
        let around = line(OUTLINE, theme.section);
        out.lines.extend(section.outline(bounds).into_iter().map(|ends| {
            let [from, to] = ends.map(|p| frame.scene(p));
            around(from, to)
        }));
        let (foot, handle) = section.handle(bounds, &self.camera, self.viewport);
        let is_hovered = self.hovered() == Some(handle.grip);
        out.lines.push(line(if is_hovered { 3.5 } else { 2.5 }, theme.section)(
            frame.scene(foot),
            frame.scene(handle.at),
        ));
        out.discs.push(Disc {
            center: frame.scene(handle.at),
            radius: if is_hovered { KNOB_HOVERED } else { KNOB },
            ring: KNOB_RING,
            fill: theme.section,
            rim: theme.handle,
        });
    }
}

#[cfg(test)]
mod tests {
    use glam::DVec3;

    use super::*;
    use crate::{
        geometry::{Aabb, Point},
        mesh::{GridOptions, hex_grid},
        scene::{Axis, Viewport},
    };

    fn scene() -> Scene {
        let bounds = Aabb { min: Point::ZERO, max: Point::splat(4.0) };
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 64 };
        let mesh = hex_grid(bounds, &options).unwrap();
        let hexes =
            Hexes::new(bytemuck::cast_slice(&mesh.positions), bytemuck::cast_slice(&mesh.hexes)).unwrap();
        let mut scene = Scene::default();
        scene.set_hexes(hexes);
        scene.viewport = Viewport { width: 600.0, height: 600.0 };
        scene.camera = scene.along(Axis::PlusY);
        scene
    }

    fn cut(section: Option<Section>) -> Cut {
        Cut { section, ..Cut::default() }
    }

    #[test]
    fn what_is_picked_is_the_cell_that_is_seen() {
        let mut scene = scene();
        let pixel = scene.camera.pixel(Point::new(1.5, 0.0, 2.5), scene.viewport).unwrap();
        let picked = |scene: &Scene| scene.pick(pixel).map(|hit| scene.cutaway().unwrap().cells()[hit.face]);
        assert_eq!(picked(&scene), Some(1 + 4 * 4 * 2));
        scene.set_cut(cut(Section::new(DVec3::NEG_Y, -2.0)));
        assert_eq!(picked(&scene), Some(1 + 4 * (2 + 4 * 2)));
        scene.set_cut(cut(Section::new(DVec3::NEG_Y, -9.0)));
        assert_eq!(picked(&scene), None);
        scene.set_cut(Cut::default());
        assert_eq!(picked(&scene), Some(1 + 4 * 4 * 2));
    }

    #[test]
    fn the_plane_is_dragged_by_its_knob_through_the_mesh() {
        let mut scene = scene();
        scene.camera = scene.along(Axis::Iso);
        scene.set_cut(cut(Section::new(DVec3::X, 2.0)));
        let shown = scene.surface().unwrap().face_count();
        let at = scene.section_handle().unwrap().at;
        let pixel = |scene: &Scene, p| scene.camera.pixel(p, scene.viewport).unwrap();
        assert!(!scene.drag_start(pixel(&scene, at) + 40.0, 8.0));
        assert_eq!(scene.drag_section_to(pixel(&scene, at)), None);
        assert!(scene.drag_start(pixel(&scene, at), 8.0));
        let to = scene.drag_section_to(pixel(&scene, at - DVec3::X)).expect("the plane");
        assert!((to.offset() - 1.0).abs() < 1e-9 && to.normal() == DVec3::X, "{to:?}");
        assert!(scene.surface().unwrap().face_count() < shown);
        scene.release();
        assert_eq!(scene.drag_section_to(pixel(&scene, at)), None);
    }

    #[test]
    fn a_marked_cell_is_outlined_and_framed() {
        let mut scene = scene();
        let lines = scene.front_buffers().lines.len();
        scene.mark(Some(63));
        assert_eq!(scene.front_buffers().lines.len(), lines + 12);
        scene.mark(Some(64));
        assert_eq!(scene.front_buffers().lines.len(), lines);
        scene.camera = scene.framed_cell(63).unwrap();
        let middle = scene.camera.pixel(Point::splat(3.5), scene.viewport).unwrap();
        assert!(middle.distance(DVec2::splat(300.0)) < 1.0, "{middle}");
        assert_eq!(scene.framed_cell(64), None);
    }
}
