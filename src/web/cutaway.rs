//! The viewer's bindings for hex meshes: what is shown of them.

use wasm_bindgen::prelude::*;

use super::{
    drawn_region::DrawnSection,
    viewer::{Viewer, error, wrong_count},
};
use crate::{
    geometry::{Aabb, Point},
    scene::{Cut, Hexes},
};

#[wasm_bindgen]
impl Viewer {
    /// Shows a hex mesh, all of it: three coordinates a node, eight nodes a hex in the order of VTK_HEXAHEDRON. The
    /// camera frames it unless `keep_camera`.
    #[wasm_bindgen(js_name = setHexes)]
    pub fn set_hexes(&mut self, nodes: Vec<f64>, hexes: Vec<u32>, keep_camera: bool) -> Result<(), JsError> {
        let hexes = Hexes::new(&nodes, &hexes).map_err(error)?;
        drop(nodes);
        self.clear_mesh()?;
        self.scene.set_hexes(hexes);
        self.renderer.set_surface(self.scene.surface()).map_err(error)?;
        self.mesh_changed(keep_camera);
        Ok(())
    }

    /// Hides whole cells of the hex mesh beyond a plane, or none: those whose middle m has `normal . m > offset`.
    #[wasm_bindgen(js_name = setSection)]
    pub fn set_section(&mut self, section: JsValue) -> Result<(), JsError> {
        let section: Option<DrawnSection> = serde_wasm_bindgen::from_value(section)?;
        let section = section.map(DrawnSection::plane).transpose().map_err(error)?;
        self.change_cut(|cut| cut.section = section)
    }

    /// Hides so many layers of cells of the hex mesh, from the boundary inwards.
    pub fn peel(&mut self, layers: u16) -> Result<(), JsError> {
        self.change_cut(|cut| cut.peel = layers)
    }

    /// How many layers of cells the hex mesh has; 0 for a surface.
    pub fn layers(&self) -> u16 {
        self.scene.cutaway().map_or(0, |cutaway| cutaway.hexes().layers())
    }

    /// Layers of cells that lie over a cell of the hex mesh.
    #[wasm_bindgen(js_name = depthOf)]
    pub fn depth_of(&self, cell: u32) -> Option<u16> {
        let hexes = self.scene.cutaway()?.hexes();
        (cell < hexes.len() as u32).then(|| hexes.depth(cell as usize))
    }

    /// Hides cells of the hex mesh whose value does not lie from `low` to `high`; without values, none. There must be
    /// one value a cell.
    pub fn filter(&mut self, values: Option<Vec<f32>>, low: f32, high: f32) -> Result<(), JsError> {
        let cells = self.scene.cutaway().map_or(0, |cutaway| cutaway.hexes().len());
        let kept = match values {
            Some(values) if values.len() != cells => return Err(wrong_count(values.len(), cells, "cells")),
            values => values.map(|values| values.iter().map(|v| (low..=high).contains(v)).collect()),
        };
        self.change_cut(|cut| cut.kept = kept)
    }

    fn change_cut(&mut self, change: impl FnOnce(&mut Cut)) -> Result<(), JsError> {
        let Some(mut cut) = self.scene.cutaway().map(|cutaway| cutaway.cut().clone()) else { return Ok(()) };
        change(&mut cut);
        if self.scene.cutaway().is_some_and(|cutaway| *cutaway.cut() == cut) {
            return Ok(());
        }
        self.scene.set_cut(cut);
        self.faces_changed()
    }

    /// Draws the faces that another cut has left.
    pub(super) fn faces_changed(&mut self) -> Result<(), JsError> {
        let Some(surface) = self.scene.surface() else { return Ok(()) };
        self.renderer.set_faces(surface).map_err(error)?;
        self.colour_cells();
        Ok(())
    }

    pub(super) fn colour_cells(&mut self) {
        let (Some(cutaway), Some((colours, palette))) = (self.scene.cutaway(), &self.cell_colours) else {
            return;
        };
        let of_faces: Vec<u8> = cutaway.cells().iter().map(|&cell| colours[cell as usize]).collect();
        self.renderer.set_colours(Some((&of_faces, palette)));
    }

    /// Outlines a cell of the hex mesh over all else, or none.
    pub fn mark(&mut self, cell: Option<u32>) {
        self.scene.mark(cell.map(|cell| cell as usize));
    }

    /// The direction in which the camera looks, a unit vector.
    pub fn forward(&self) -> Vec<f64> {
        self.scene.camera.axes()[2].to_array().to_vec()
    }

    /// Draws the edges of a box, from its least x, y, z to its greatest, or of none.
    #[wasm_bindgen(js_name = setBox)]
    pub fn set_box(&mut self, ends: Option<Vec<f64>>) {
        let point = |at: usize| move |ends: &Vec<f64>| ends.get(at..at + 3).map(Point::from_slice);
        let bounds = ends.as_ref().and_then(|ends| Some(Aabb { min: point(0)(ends)?, max: point(3)(ends)? }));
        self.scene.set_box(bounds);
        self.renderer.regions_changed();
    }
}
