//! All-hex meshes of solids.

use js_sys::{Float32Array, Float64Array, Uint8Array, Uint32Array};
use serde::Deserialize;
use wasm_bindgen::prelude::{JsValue, wasm_bindgen};

use super::convert::{check_ids, points, to_object};
use super::errors::Failure;
use super::file::format_named;
use super::hex_arrays::{HexArrays, face_groups, hex_mesh, pairs};
use super::listener::Listener;
use super::memory::{Affordable, Cost, Limited};
use super::pool::on_pool;
use super::solid_plan::Plan;
use super::surface::Surface;
use crate::geometry::Point;
use crate::hexing::background::BackgroundError;
use crate::hexing::{self, HexingError, HexingOptions, body_tags, hex_solid, surface_groups};
use crate::io::{self, Document};
use crate::mesh::{HexMesh, NodeId, SecondOrder, SecondOrderHex, Triangles, distances_of_hexes};
use crate::refine::hex::HexRefineError;
use crate::solid::SurfaceId;

/// What memory holds; `www/lib/solid-options.ts` has the number of hexes that this comes to.
const COST: Cost =
    Cost { bytes_per_cell: BYTES_PER_HEX, most_asked: HexingOptions::MOST_HEXES, cells: "hexes" };

/// Peak memory of the work for each hex of the result, in WebAssembly.
pub(super) const BYTES_PER_HEX: u64 = 825;

impl Limited for HexingOptions {
    type Error = HexingError;
    const COST: &'static Cost = &COST;

    fn max_cells(&mut self) -> &mut u64 {
        &mut self.max_hexes
    }

    fn too_many(error: &HexingError) -> Option<u64> {
        let HexingError::Background(error) = error else { return None };
        match error {
            BackgroundError::TooManyHexes { hexes, .. } => Some(*hexes as u64),
            BackgroundError::Refine(HexRefineError::TooManyHexes { hexes, .. }) => Some(*hexes),
            _ => None,
        }
    }
}

/// A mesh of a solid on its way to JavaScript.
#[wasm_bindgen]
pub struct HexedSolid {
    hexed: hexing::HexedSolid,
}

#[wasm_bindgen]
impl HexedSolid {
    /// Gives the mesh away. [`sides`](Self::sides) and [`bodies`](Self::bodies) are to be asked for before.
    pub fn arrays(&mut self) -> HexArrays {
        std::mem::take(&mut self.hexed.mesh).into()
    }

    /// The boundary faces: two numbers for each, 6 times its hex and its number there, and the surface of the solid that
    /// it stands for.
    pub fn sides(&self) -> Uint32Array {
        pairs(on_pool(|| self.hexed.sides()).into_iter().map(|(side, surface)| (side, surface.0)))
    }

    /// The body of each hex; empty if there is but one.
    pub fn bodies(&self) -> Uint32Array {
        self.hexed.mesh.tags.of_element.as_slice().into()
    }

    /// x, y, z of each node beside the corners of hexes of the second order; empty for linear ones.
    #[wasm_bindgen(js_name = middleNodes)]
    pub fn middle_nodes(&self) -> Float64Array {
        let nodes = self.hexed.second_order.as_ref().map_or(&[][..], |made| &made.positions);
        bytemuck::cast_slice::<Point, f64>(nodes).into()
    }

    /// The 20 or 27 nodes of each hex of the second order; empty for linear ones.
    #[wasm_bindgen(js_name = secondOrder)]
    pub fn second_order(&self) -> Uint32Array {
        let nodes = self.hexed.second_order.as_ref().map_or(&[][..], |made| &made.nodes);
        bytemuck::cast_slice::<NodeId, u32>(nodes).into()
    }

    /// What was done and what came of it: an object with the fields of `SolidReport` in `www/lib/solid-results.ts`.
    ///
    /// # Errors
    /// None in practice: numbers can always be converted.
    pub fn report(&self) -> Result<JsValue, Failure> {
        to_object(&self.hexed.report)
    }
}

/// Fills the solid in a closed surface with hexes; see `hexing::hex_solid`.
///
/// # Errors
/// What `hex_solid` refuses, meshes that memory would not hold, and options that are none.
#[wasm_bindgen(js_name = meshSolid)]
pub fn mesh(surface: &Surface, options: JsValue) -> Result<HexedSolid, Failure> {
    let affordable = Affordable::<HexingOptions>::read(options)?;
    let hexed = on_pool(|| hex_solid(&*surface.mesh, &affordable.options, &Listener))
        .map_err(|error| affordable.failure(error))?;
    Ok(HexedSolid { hexed })
}

/// Tells what [`mesh`] finds in a surface and about how much it makes of it: an object with the fields of `SolidPlan` in
/// `www/lib/solid-results.ts`.
///
/// # Errors
/// If the surface bounds no solid, and options that are none.
#[wasm_bindgen(js_name = planSolid)]
pub fn plan(surface: &Surface, options: JsValue) -> Result<JsValue, Failure> {
    let options: HexingOptions = serde_wasm_bindgen::from_value(options)?;
    let plan = on_pool(|| Plan::new(&surface.mesh, &options, &Listener))?;
    to_object(&plan)
}

/// What file of a solid's mesh is wanted, and the names that it has for each surface besides.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct File {
    format: String,
    surface_groups: Vec<Vec<String>>,
}

/// The mesh of a solid, given back as arrays, as the bytes of a file.
///
/// # Errors
/// If the arrays do not fit together, there is no such format, or it holds no hexes.
#[wasm_bindgen(js_name = exportSolid)]
pub fn export(
    nodes: Vec<f64>,
    hexes: Vec<u32>,
    sides: &[u32],
    bodies: Vec<u32>,
    middle_nodes: Vec<f64>,
    second_order: Vec<u32>,
    file: JsValue,
) -> Result<Uint8Array, Failure> {
    let File { format, surface_groups: names } = serde_wasm_bindgen::from_value(file)?;
    let format = format_named(&format)?;
    let mut mesh = hex_mesh(nodes, hexes)?;
    mesh.groups = face_groups(sides, mesh.hexes.len(), |sides| {
        let sides: Vec<_> = sides.into_iter().map(|(side, surface)| (side, SurfaceId(surface))).collect();
        surface_groups(&sides, &names)
    })?;
    if !bodies.is_empty() {
        if bodies.len() != mesh.hexes.len() {
            return Err(Failure::input("array-bodies", &"bodies has to name a body for each hex"));
        }
        mesh.tags = body_tags(&bodies);
    }
    let second_order = second_order_of(&mesh, middle_nodes, second_order)?;
    let document = Document { second_order, ..Document::from(mesh) };
    Ok(on_pool(|| io::write(&document, format))?.as_slice().into())
}

/// What makes the hexes of `mesh` hexes of the second order, if they are.
fn second_order_of(
    mesh: &HexMesh,
    middle_nodes: Vec<f64>,
    nodes: Vec<u32>,
) -> Result<Option<SecondOrder>, Failure> {
    if nodes.is_empty() {
        return Ok(None);
    }
    let kinds = [SecondOrderHex::Hex20, SecondOrderHex::Hex27];
    let hex =
        kinds.into_iter().find(|kind| kind.nodes() * mesh.hexes.len() == nodes.len()).ok_or_else(|| {
            let message =
                format!("the array of second order has {} numbers, not 20 or 27 for each hex", nodes.len());
            Failure::input("array-length", &message)
        })?;
    let positions = points(middle_nodes)?;
    check_ids(&nodes, mesh.positions.len() + positions.len())?;
    Ok(Some(SecondOrder { hex, positions, nodes: bytemuck::cast_vec(nodes) }))
}

/// How far each hex with a face on the boundary is from a surface; NaN for the others.
///
/// # Errors
/// If the arrays do not fit together.
#[wasm_bindgen(js_name = solidDistances)]
pub fn distances(surface: &Surface, nodes: Vec<f64>, hexes: Vec<u32>) -> Result<Float32Array, Failure> {
    let mesh = hex_mesh(nodes, hexes)?;
    let distances = on_pool(|| {
        let surface = Triangles { positions: &surface.mesh.positions, triangles: &surface.mesh.triangles() };
        distances_of_hexes(&mesh, surface, &Listener).map_err(HexingError::from)
    })?;
    Ok(distances.as_slice().into())
}
