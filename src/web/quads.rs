//! Refinement in one call, and the quad mesh that it makes.

use js_sys::{Float32Array, Float64Array, Uint8Array, Uint32Array};
use wasm_bindgen::prelude::{JsValue, wasm_bindgen};

use super::convert::{cells, check_parents, points, to_object};
use super::errors::Failure;
use super::file::format_named;
use super::listener::Listener;
use super::memory::{Affordable, Cost, Limited};
use super::pool::on_pool;
use super::surface::Surface;
use crate::geometry::Point;
use crate::io::{self, Document};
use crate::mesh::check::{check_quads, summary};
use crate::mesh::quality::quad_quality;
use crate::mesh::{FaceId, NodeId, QuadMesh, mesh_hash};
use crate::refine::{Estimate, QuadOptions, RefineError, RefinedQuads, estimate_quads, refine_quads};

/// What memory holds; `www/lib/options.ts` has the number of quads that this comes to.
const COST: Cost =
    Cost { bytes_per_cell: Estimate::BYTES_PER_QUAD, most_asked: QuadOptions::MOST_QUADS, cells: "quads" };

impl Limited for QuadOptions {
    type Error = RefineError;
    const COST: &'static Cost = &COST;

    fn max_cells(&mut self) -> &mut u64 {
        &mut self.max_quads
    }

    fn too_many(error: &RefineError) -> Option<u64> {
        if let RefineError::TooManyQuads { quads, .. } = error { Some(*quads) } else { None }
    }
}

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

    /// The fingerprint of nodes and quads.
    pub fn hash(&self) -> String {
        let mesh = &self.refined.mesh;
        on_pool(|| mesh_hash(&mesh.positions, &mesh.quads)).to_string()
    }

    /// How well shaped the quads are: an object with the fields of `MeshQuality` in `www/lib/results.ts`.
    ///
    /// # Errors
    /// None in practice: numbers can always be converted.
    pub fn quality(&self) -> Result<JsValue, Failure> {
        to_object(&on_pool(|| quad_quality(&self.refined.mesh).report()))
    }

    /// What is wrong with the mesh: one line for each kind of defect.
    pub fn defects(&self) -> Vec<String> {
        let defects = on_pool(|| check_quads(&self.refined.mesh));
        summary(&defects).iter().map(ToString::to_string).collect()
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
/// What `refine_quads` refuses, meshes that memory would not hold, and options that are none.
#[wasm_bindgen(js_name = refineQuads)]
pub fn refine(surface: &Surface, options: JsValue) -> Result<Quads, Failure> {
    let affordable = Affordable::<QuadOptions>::read(options)?;
    on_pool(|| refine_quads(&surface.mesh, &affordable.options, &Listener))
        .map(Quads::from)
        .map_err(|error| affordable.failure(error))
}

/// Tells how large the result of [`refine`] will be; see `refine::Estimate` for the fields.
///
/// # Errors
/// What `estimate_quads` refuses, and options that are none.
#[wasm_bindgen(js_name = estimateQuads)]
pub fn estimate(surface: &Surface, options: JsValue) -> Result<JsValue, Failure> {
    let options: QuadOptions = serde_wasm_bindgen::from_value(options)?;
    let estimate = on_pool(|| estimate_quads(&surface.mesh, &options, &Listener))?;
    Ok(serde_wasm_bindgen::to_value(&estimate)?)
}

/// A refined mesh, given back as arrays, as the bytes of a file. `surface`, which it was made from, tells the tags.
///
/// # Errors
/// If the arrays do not fit together, there is no such format, or it is not written.
#[wasm_bindgen(js_name = exportQuads)]
pub fn export(
    surface: &Surface,
    nodes: Vec<f64>,
    quads: Vec<u32>,
    level: Vec<u8>,
    parent: &[u32],
    format: &str,
) -> Result<Uint8Array, Failure> {
    let format = format_named(format)?;
    let mesh = quad_mesh(nodes, quads)?;
    check_parents(parent, mesh.quads.len(), surface.mesh.face_count())?;
    let tags = surface.mesh.tags.inherited(parent);
    let parent = parent.iter().copied().map(FaceId).collect();
    let document = Document { tags, level, parent, ..Document::from(mesh) };
    Ok(on_pool(|| io::write(&document, format))?.as_slice().into())
}

/// A measure of each quad, by its name in `MeshQuality`.
///
/// # Errors
/// If the arrays do not fit together or there is no such measure.
#[wasm_bindgen(js_name = quadQuality)]
pub fn quality(nodes: Vec<f64>, quads: Vec<u32>, metric: &str) -> Result<Float32Array, Failure> {
    let mesh = quad_mesh(nodes, quads)?;
    let quality = on_pool(|| quad_quality(&mesh));
    let values = match metric {
        "scaledJacobian" => quality.scaled_jacobian,
        "minAngle" => quality.min_angle,
        "maxAngle" => quality.max_angle,
        "aspect" => quality.aspect,
        _ => {
            let message =
                format!("there is no measure {metric:?}; give scaledJacobian, minAngle, maxAngle or aspect");
            return Err(Failure::options("metric-unknown", &message));
        }
    };
    Ok(values.as_slice().into())
}

/// The mesh of these arrays, in their own memory.
fn quad_mesh(nodes: Vec<f64>, quads: Vec<u32>) -> Result<QuadMesh, Failure> {
    let positions = points(nodes)?;
    let quads = cells(quads, positions.len(), "quads")?;
    Ok(QuadMesh { positions, quads })
}
