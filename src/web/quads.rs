//! Refinement in one call, and the quad mesh that it makes.

use js_sys::{Float64Array, Uint8Array, Uint32Array};
use wasm_bindgen::prelude::{JsValue, wasm_bindgen};

use super::errors::Failure;
use super::listener::Listener;
use super::pool::on_pool;
use super::surface::Surface;
use crate::geometry::Point;
use crate::mesh::{FaceId, NodeId};
use crate::refine::{QuadOptions, RefinedQuads, estimate_quads, refine_quads};

/// A refined mesh on its way to JavaScript.
#[wasm_bindgen]
pub struct Quads {
    refined: RefinedQuads,
}

#[wasm_bindgen]
impl Quads {
    /// x, y, z of each node.
    pub fn nodes(&self) -> Float64Array {
        bytemuck::cast_slice::<Point, f64>(&self.refined.mesh.positions).into()
    }

    /// The four nodes of each quad.
    pub fn quads(&self) -> Uint32Array {
        bytemuck::cast_slice::<[NodeId; 4], u32>(&self.refined.mesh.quads).into()
    }

    /// The refinement level of each quad.
    pub fn level(&self) -> Uint8Array {
        self.refined.level.as_slice().into()
    }

    /// The input face that each quad is part of.
    pub fn parent(&self) -> Uint32Array {
        bytemuck::cast_slice::<FaceId, u32>(&self.refined.parent).into()
    }

    /// Elements that are larger than asked for, because the deepest level allowed was reached.
    pub fn capped(&self) -> usize {
        self.refined.capped
    }
}

impl From<RefinedQuads> for Quads {
    fn from(refined: RefinedQuads) -> Self {
        Self { refined }
    }
}

/// Refines a surface; see `refine::refine_quads`.
///
/// # Errors
/// What `refine_quads` refuses, and options that are none.
#[wasm_bindgen(js_name = refineQuads)]
pub fn refine(surface: &Surface, options: JsValue) -> Result<Quads, Failure> {
    let options: QuadOptions = serde_wasm_bindgen::from_value(options)?;
    Ok(on_pool(|| refine_quads(&surface.mesh, &options, &Listener))?.into())
}

/// Tells how large the result of [`refine`] will be; see `refine::Estimate` for the fields.
///
/// # Errors
/// What `estimate_quads` refuses, and options that are none.
#[wasm_bindgen(js_name = estimateQuads)]
pub fn estimate(surface: &Surface, options: JsValue) -> Result<JsValue, Failure> {
    let options: QuadOptions = serde_wasm_bindgen::from_value(options)?;
    let estimate = on_pool(|| estimate_quads(&surface.mesh, &options))?;
    Ok(serde_wasm_bindgen::to_value(&estimate)?)
}
