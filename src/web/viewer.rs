//! The viewer's bindings: one class over [`Scene`] and [`Renderer`].
//!
//! Positions on the canvas are CSS pixels from its upper left corner.

use glam::DVec2;
use wasm_bindgen::prelude::*;
use web_sys::HtmlCanvasElement;

use super::drawn_features::DrawnFeature;
use super::drawn_region::{DrawnRegion, DrawnSection};
use crate::{
    geometry::{Aabb, Point},
    render::Renderer,
    scene::{
        Axis, Background, Camera, ColourMap, FeatureLine, Handle, Palette, Projection, Scene, Style, Surface,
        Up, Viewport, colour_index,
    },
    sizing::Shape,
};

/// A scene drawn on a canvas.
#[wasm_bindgen]
pub struct Viewer {
    pub(super) scene: Scene,
    pub(super) renderer: Renderer,
    flight: Option<[Camera; 2]>,
    /// The colour of each cell of a hex mesh, by index.
    pub(super) cell_colours: Option<(Vec<u8>, Palette)>,
}

/// A face of a surface, or a cell of a hex mesh, and a point on it.
#[wasm_bindgen]
pub struct PickedFace {
    /// The face or cell.
    pub face: u32,
    /// World coordinates of the point.
    pub x: f64,
    /// World coordinates of the point.
    pub y: f64,
    /// World coordinates of the point.
    pub z: f64,
}

#[derive(serde::Deserialize)]
#[serde(rename_all = "camelCase")]
struct StyleChange {
    edges: Option<bool>,
    edge_width: Option<f32>,
    background: Option<Background>,
    projection: Option<Projection>,
    up: Option<Up>,
    covered: Option<[f64; 2]>,
}

#[derive(serde::Serialize)]
struct HandlePosition {
    name: &'static str,
    x: f64,
    y: f64,
}

pub(super) fn wrong_count(values: usize, count: usize, what: &str) -> JsError {
    error(format!("{values} values for {count} {what}; give one value for each"))
}

pub(super) fn error(e: impl std::fmt::Display) -> JsError {
    JsError::new(&e.to_string())
}

#[wasm_bindgen]
impl Viewer {
    /// A viewer on a canvas that can give a WebGL2 context.
    pub async fn create(canvas: HtmlCanvasElement) -> Result<Viewer, JsError> {
        console_error_panic_hook::set_once();
        let renderer = Renderer::on_canvas(canvas).await.map_err(error)?;
        Ok(Self { scene: Scene::default(), renderer, flight: None, cell_colours: None })
    }

    /// Fits a canvas of `width` by `height` CSS pixels, and of how many device pixels.
    pub fn resize(&mut self, width: f64, height: f64, device_width: u32, device_height: u32) {
        self.scene.viewport = Viewport { width: width.max(1.0), height: height.max(1.0) };
        self.renderer.resize(device_width, device_height);
    }

    /// Shows a surface: three coordinates a node, and where each face's corners start and the last ends
    /// (absent: all faces are quads). The camera frames it unless `keep_camera`.
    #[wasm_bindgen(js_name = setMesh)]
    pub fn set_mesh(
        &mut self,
        nodes: Vec<f64>,
        offsets: Option<Vec<u32>>,
        corners: Vec<u32>,
        keep_camera: bool,
    ) -> Result<(), JsError> {
        let surface = Surface::new(&nodes, offsets, corners).map_err(error)?;
        // Before the upload, which needs room of its own.
        drop(nodes);
        self.clear_mesh()?;
        self.renderer.set_surface(Some(&surface)).map_err(error)?;
        self.scene.set_surface(Some(surface));
        self.mesh_changed(keep_camera);
        Ok(())
    }

    pub(super) fn mesh_changed(&mut self, keep_camera: bool) {
        self.renderer.regions_changed();
        self.flight = None;
        if !keep_camera {
            self.scene.camera = self.scene.framed();
        }
    }

    /// Shows no surface.
    #[wasm_bindgen(js_name = clearMesh)]
    pub fn clear_mesh(&mut self) -> Result<(), JsError> {
        self.scene.set_surface(None);
        self.cell_colours = None;
        self.renderer.regions_changed();
        self.renderer.set_surface(None).map_err(error)
    }

    /// Gives all faces the same colour.
    #[wasm_bindgen(js_name = colourPlain)]
    pub fn colour_plain(&mut self) {
        self.cell_colours = None;
        self.renderer.set_colours(None);
    }

    /// Colours each face of a surface, or each cell of a hex mesh, by its value. There must be one value for each.
    #[wasm_bindgen(js_name = colourByValue)]
    pub fn colour_by_value(
        &mut self,
        values: &[f32],
        low: f32,
        high: f32,
        map: JsValue,
    ) -> Result<(), JsError> {
        let map: ColourMap = serde_wasm_bindgen::from_value(map)?;
        let faces = || (self.scene.surface().map_or(0, Surface::face_count), "faces");
        let (count, what) =
            self.scene.cutaway().map_or_else(faces, |cutaway| (cutaway.hexes().len(), "cells"));
        if values.len() != count {
            return Err(wrong_count(values.len(), count, what));
        }
        let range = [low, high];
        let indices: Vec<u8> = values.iter().map(|&v| colour_index(v, range, map)).collect();
        if self.scene.cutaway().is_some() {
            self.cell_colours = Some((indices, map.palette(range)));
            self.colour_cells();
        } else {
            self.renderer.set_colours(Some((&indices, &map.palette(range))));
        }
        Ok(())
    }

    /// Changes the parts of the style that are given.
    #[wasm_bindgen(js_name = setStyle)]
    pub fn set_style(&mut self, change: JsValue) -> Result<(), JsError> {
        let change: StyleChange = serde_wasm_bindgen::from_value(change)?;
        let style = &mut self.scene.style;
        *style = Style {
            edges: change.edges.unwrap_or(style.edges),
            edge_width: change.edge_width.unwrap_or(style.edge_width).clamp(0.0, 20.0),
            background: change.background.unwrap_or(style.background),
            covered: change.covered.map_or(style.covered, |covered| covered.map(|pixels| pixels.max(0.0))),
        };
        self.renderer.regions_changed();
        let camera = &mut self.scene.camera;
        camera.projection = change.projection.unwrap_or(camera.projection);
        if let Some(up) = change.up.filter(|&up| up != camera.up) {
            camera.up = up;
            camera.look_along(Axis::Iso);
            self.flight = None;
            self.scene.camera = self.scene.framed();
        }
        Ok(())
    }

    /// Draws a frame.
    pub fn draw(&mut self) -> Result<(), JsError> {
        self.renderer.draw(&self.scene).map_err(error)
    }

    /// Prepares for picking, which the first pick on a surface would otherwise have to wait for.
    #[wasm_bindgen(js_name = preparePicking)]
    pub fn prepare_picking(&self) {
        self.scene.prepare_picking();
    }

    /// The first face of the surface, or cell of the hex mesh, under a pixel.
    pub fn pick(&self, x: f64, y: f64) -> Option<PickedFace> {
        self.scene.pick(DVec2::new(x, y)).map(|hit| PickedFace {
            face: self.scene.cutaway().map_or(hit.face as u32, |cutaway| cutaway.cells()[hit.face]),
            x: hit.point.x,
            y: hit.point.y,
            z: hit.point.z,
        })
    }

    /// Replaces the regions; the selected one shows its handles.
    #[wasm_bindgen(js_name = setRegions)]
    pub fn set_regions(&mut self, regions: JsValue, selected: Option<u32>) -> Result<(), JsError> {
        let regions: Vec<DrawnRegion> = serde_wasm_bindgen::from_value(regions)?;
        let shapes = regions.into_iter().map(Shape::from).collect();
        self.scene.set_regions(shapes, selected.map(|i| i as usize));
        self.renderer.regions_changed();
        Ok(())
    }

    /// Draws the features of a solid, or none: see [`DrawnFeature`].
    #[wasm_bindgen(js_name = setFeatures)]
    pub fn set_features(&mut self, features: JsValue) -> Result<(), JsError> {
        let features: Vec<DrawnFeature> = serde_wasm_bindgen::from_value(features)?;
        self.scene.set_features(features.into_iter().map(FeatureLine::from).collect());
        self.renderer.regions_changed();
        Ok(())
    }

    /// The index of the nearest region under a pixel.
    #[wasm_bindgen(js_name = regionAt)]
    pub fn region_at(&self, x: f64, y: f64) -> Option<u32> {
        self.scene.region_at(DVec2::new(x, y)).map(|i| i as u32)
    }

    /// The handles of the selected region and of the section: `{ name, x, y }[]`.
    pub fn handles(&self) -> Result<JsValue, JsError> {
        let position = |h: Handle| {
            let at = self.scene.camera.pixel(h.at, self.scene.viewport)?;
            Some(HandlePosition { name: h.grip.name(), x: at.x, y: at.y })
        };
        let positions: Vec<_> = self
            .scene
            .handles()
            .into_iter()
            .chain(self.scene.section_handle())
            .filter_map(position)
            .collect();
        Ok(serde_wasm_bindgen::to_value(&positions)?)
    }

    /// Marks the handle within `reach` pixels of a pixel, if any.
    pub fn hover(&mut self, x: f64, y: f64, reach: f64) {
        self.scene.hover(DVec2::new(x, y), reach);
    }

    /// Name of the marked handle.
    pub fn hovered(&self) -> Option<String> {
        self.scene.hovered().map(|grip| grip.name().into())
    }

    /// Takes hold of the handle within `reach` pixels of a pixel. False: there is none.
    #[wasm_bindgen(js_name = dragStart)]
    pub fn drag_start(&mut self, x: f64, y: f64, reach: f64) -> bool {
        self.scene.drag_start(DVec2::new(x, y), reach)
    }

    /// Drags the held handle to a pixel; see [`Viewer::dragged`].
    #[wasm_bindgen(js_name = dragTo)]
    pub fn drag_to(&mut self, x: f64, y: f64) -> Result<JsValue, JsError> {
        let pixel = DVec2::new(x, y);
        if self.scene.drag_section_to(pixel).is_some() {
            self.faces_changed()?;
        } else if self.scene.drag_to(pixel).is_some() {
            self.renderer.regions_changed();
        }
        self.dragged()
    }

    /// The selected region or the section as it is now, if its handle is held.
    pub fn dragged(&self) -> Result<JsValue, JsError> {
        if let Some(section) = self.scene.held_section() {
            return Ok(serde_wasm_bindgen::to_value(&DrawnSection::of(&section))?);
        }
        Ok(serde_wasm_bindgen::to_value(&self.scene.held_region().and_then(DrawnRegion::of))?)
    }

    /// Takes hold of what is under a pixel: `orbit` turns about it, `pan` makes it follow.
    pub fn grab(&mut self, x: f64, y: f64) {
        self.flight = None;
        self.scene.grab(DVec2::new(x, y));
    }

    /// Takes hold of the pivot or of the middle of all that is shown, as `grab` beside the surface.
    #[wasm_bindgen(js_name = grabMiddle)]
    pub fn grab_middle(&mut self) {
        self.flight = None;
        self.scene.grab_middle();
    }

    /// Lets go of what was grabbed or dragged.
    pub fn release(&mut self) {
        self.scene.release();
    }

    /// Turns about what was grabbed, by radians.
    pub fn orbit(&mut self, yaw: f64, pitch: f64) {
        self.scene.orbit(yaw, pitch);
    }

    /// Moves what was grabbed by pixels.
    pub fn pan(&mut self, x: f64, y: f64) {
        self.scene.pan(DVec2::new(x, y));
    }

    /// Turns about the point under a pixel from now on, and prepares a flight that looks at it.
    #[wasm_bindgen(js_name = setPivot)]
    pub fn set_pivot(&mut self, x: f64, y: f64) {
        if let Some(camera) = self.scene.set_pivot(DVec2::new(x, y)) {
            self.fly_to(camera);
        }
    }

    /// Scales the distance to what is under a pixel; less than 1: closer.
    pub fn dolly(&mut self, x: f64, y: f64, factor: f64) {
        self.flight = None;
        let anchor = self.scene.point_under(DVec2::new(x, y));
        self.scene.zoom(anchor, factor);
    }

    /// Prepares a flight to where everything is seen.
    #[wasm_bindgen(js_name = flyToAll)]
    pub fn fly_to_all(&mut self) {
        self.fly_to(self.scene.framed());
    }

    /// Prepares a flight to a face of the surface, or a cell of the hex mesh. Without such a one nothing happens.
    #[wasm_bindgen(js_name = flyToFace)]
    pub fn fly_to_face(&mut self, face: u32) {
        let index = face as usize;
        let is_cell = self.scene.cutaway().is_some();
        if let Some(camera) =
            if is_cell { self.scene.framed_cell(index) } else { self.scene.framed_face(index) }
        {
            self.fly_to(camera);
        }
    }

    /// Prepares a flight to a box, from its least x, y, z to its greatest, and what is around it.
    #[wasm_bindgen(js_name = flyToBox)]
    pub fn fly_to_box(&mut self, ends: &[f64]) -> Result<(), JsError> {
        let (min, max) = ends
            .split_at_checked(3)
            .filter(|(_, max)| max.len() == 3)
            .ok_or_else(|| error("a box has six numbers"))?;
        self.fly_to(
            self.scene.framed_box(&Aabb { min: Point::from_slice(min), max: Point::from_slice(max) }),
        );
        Ok(())
    }

    /// Prepares a flight to where everything is seen along an axis: `+x` to `-z`, or `iso`.
    #[wasm_bindgen(js_name = flyAlong)]
    pub fn fly_along(&mut self, axis: JsValue) -> Result<(), JsError> {
        let axis: Axis = serde_wasm_bindgen::from_value(axis)?;
        self.fly_to(self.scene.along(axis));
        Ok(())
    }

    fn fly_to(&mut self, camera: Camera) {
        self.flight = Some([self.scene.camera, camera]);
    }

    /// Goes to a share of the prepared flight, 0 to 1. False: there is none, or it was broken off.
    pub fn fly(&mut self, share: f64) -> bool {
        let Some([from, to]) = self.flight else { return false };
        self.scene.camera = if share >= 1.0 { to } else { from.between(&to, share) };
        if share >= 1.0 {
            self.flight = None;
        }
        true
    }

    /// The camera as numbers, for [`Viewer::set_camera`].
    pub fn camera(&self) -> Vec<f64> {
        let c = &self.scene.camera;
        vec![c.eye.x, c.eye.y, c.eye.z, c.yaw, c.pitch, c.distance]
    }

    /// Takes up a camera again.
    #[wasm_bindgen(js_name = setCamera)]
    pub fn set_camera(&mut self, numbers: &[f64]) -> Result<(), JsError> {
        let &[x, y, z, yaw, pitch, distance] = numbers else {
            return Err(error("a camera has six numbers"));
        };
        self.scene.camera =
            Camera { eye: glam::DVec3::new(x, y, z), yaw, pitch, distance, ..self.scene.camera };
        Ok(())
    }

    /// Number of faces that are drawn.
    #[wasm_bindgen(js_name = faceCount)]
    pub fn face_count(&self) -> usize {
        self.scene.surface().map_or(0, Surface::face_count)
    }

    /// Bytes of the mesh on the device.
    #[wasm_bindgen(js_name = meshBytes)]
    pub fn mesh_bytes(&self) -> usize {
        self.renderer.mesh_bytes()
    }
}
