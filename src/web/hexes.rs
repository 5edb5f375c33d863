//! Refinement of hexes in one call, what it will do, and the hex mesh that it makes.

use js_sys::{Uint8Array, Uint32Array};
use serde::Serialize;
use wasm_bindgen::prelude::{JsValue, wasm_bindgen};

use super::convert::{check_parents, to_object};
use super::errors::Failure;
use super::file::format_named;
use super::hex_arrays::{HexArrays, face_groups, hex_mesh, pairs};
use super::hex_mesh::HexMesh;
use super::listener::Listener;
use super::memory::{Affordable, Cost, Limited};
use super::pool::on_pool;
use crate::io::{self, Document};
use crate::mesh::{FaceGroups, FaceId, Tags};
use crate::refine::hex::{
    Added, HexForecast, HexOptions, HexPlan, HexRefineError, RefinedHexes, StageForecast, refine_hexes,
};

/// What memory holds; `www/lib/hex-options.ts` has the number of hexes that this comes to.
const COST: Cost = Cost { bytes_per_cell: BYTES_PER_HEX, most_asked: HexOptions::MOST_HEXES, cells: "hexes" };

/// Peak memory of refinement for each hex of the result, in WebAssembly.
const BYTES_PER_HEX: u64 = 600;

impl Limited for HexOptions {
    type Error = HexRefineError;
    const COST: &'static Cost = &COST;

    fn max_cells(&mut self) -> &mut u64 {
        &mut self.max_hexes
    }

    fn too_many(error: &HexRefineError) -> Option<u64> {
        if let HexRefineError::TooManyHexes { hexes, .. } = error { Some(*hexes) } else { None }
    }
}

/// A refined hex mesh on its way to JavaScript.
#[wasm_bindgen]
pub struct Hexes {
    refined: RefinedHexes,
}

#[wasm_bindgen]
impl Hexes {
    /// Gives the mesh away. The faces that are in [`groups`](Self::groups) are to be asked for before.
    pub fn arrays(&mut self) -> HexArrays {
        std::mem::take(&mut self.refined.mesh).into()
    }

    /// The refinement level of each hex.
    pub fn level(&self) -> Uint8Array {
        self.refined.level.as_slice().into()
    }

    /// The input hex that each hex is part of.
    pub fn parent(&self) -> Uint32Array {
        self.refined.root.as_slice().into()
    }

    /// The faces that are in groups: two numbers for each, 6 times its hex and its number there, and which of
    /// the input's groups it is in.
    pub fn groups(&self) -> Uint32Array {
        pairs(self.refined.mesh.groups.labels())
    }

    /// Elements that are larger than asked for, because the deepest level allowed was reached.
    pub fn capped(&self) -> usize {
        self.refined.capped
    }

    /// Hexes of the input that were numbered inside out, and were turned.
    pub fn turned(&self) -> usize {
        self.refined.turned
    }

    /// Elements that were refined beyond those asked for, and why: an object with the fields of `AddedHexes` in
    /// `www/lib/results.ts`.
    ///
    /// # Errors
    /// None in practice: numbers can always be converted.
    pub fn added(&self) -> Result<JsValue, Failure> {
        to_object(&self.refined.added)
    }

    /// What each stage did, coarse to fine: objects with the fields of `HexStage` in `www/lib/results.ts`.
    ///
    /// # Errors
    /// None in practice: numbers can always be converted.
    pub fn stages(&self) -> Result<JsValue, Failure> {
        to_object(&self.refined.stages)
    }
}

impl Hexes {
    /// The result of refining an input of which so many hexes had been `turned` when it was loaded.
    pub(super) fn new(refined: RefinedHexes, turned: usize) -> Self {
        Self { refined: RefinedHexes { turned: turned + refined.turned, ..refined } }
    }
}

/// Refines a hex mesh; see `refine::hex::refine_hexes`.
///
/// # Errors
/// What `refine_hexes` refuses, meshes that memory would not hold, and options that are none.
#[wasm_bindgen(js_name = refineHexes)]
pub fn refine(input: &HexMesh, options: JsValue) -> Result<Hexes, Failure> {
    let affordable = Affordable::<HexOptions>::read(options)?;
    let refined = on_pool(|| refine_hexes(&input.mesh, &affordable.options, &Listener))
        .map_err(|error| affordable.failure(error))?;
    Ok(Hexes::new(refined, input.turned))
}

/// What is told of a refinement before the work.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Plan {
    tree_hexes: usize,
    hexes: usize,
    transition: usize,
    bytes: u64,
    stages: Vec<StageForecast>,
    added: Added,
    capped: usize,
    turned: usize,
    idle_regions: Vec<u32>,
    coincident_nodes: usize,
}

/// The plan of refining an input of which so many hexes had been `turned` when it was loaded.
pub(super) fn told(plan: &HexPlan, turned: usize) -> Result<JsValue, Failure> {
    let HexForecast { hexes, transition, ref stages, .. } = *plan.forecast();
    to_object(&Plan {
        tree_hexes: plan.tree_hexes(),
        hexes,
        transition,
        bytes: hexes as u64 * BYTES_PER_HEX,
        stages: stages.clone(),
        added: plan.added(),
        capped: plan.capped(),
        turned: turned + plan.turned(),
        idle_regions: plan.idle_regions().to_vec(),
        coincident_nodes: plan.coincident_nodes(),
    })
}

/// Tells what [`refine`] will do: an object with the fields of `HexPlan` in `www/lib/results.ts`.
///
/// # Errors
/// What `HexPlan::new` refuses, meshes that memory would not hold, and options that are none.
#[wasm_bindgen(js_name = planHexes)]
pub fn plan(input: &HexMesh, options: JsValue) -> Result<JsValue, Failure> {
    let affordable = Affordable::<HexOptions>::read(options)?;
    let plan = on_pool(|| HexPlan::new(&input.mesh, &affordable.options, &Listener));
    told(&plan.map_err(|error| affordable.failure(error))?, input.turned)
}

/// A refined mesh, given back as arrays, as the bytes of a file. `input`, which it was made from, tells the tags and
/// what the groups of faces are.
///
/// # Errors
/// If the arrays do not fit together, there is no such format, or it holds no hexes.
#[wasm_bindgen(js_name = exportHexes)]
pub fn export(
    input: &HexMesh,
    nodes: Vec<f64>,
    hexes: Vec<u32>,
    level: Vec<u8>,
    parent: &[u32],
    groups: &[u32],
    format: &str,
) -> Result<Uint8Array, Failure> {
    let format = format_named(format)?;
    let mut mesh = hex_mesh(nodes, hexes)?;
    mesh.groups = face_groups(groups, mesh.hexes.len(), |faces| {
        let (sides, of_element) = faces.into_iter().unzip();
        FaceGroups::new(sides, Tags { sets: input.mesh.groups.tags().sets.clone(), of_element })
    })?;
    check_parents(parent, mesh.hexes.len(), input.mesh.hexes.len())?;
    let tags = input.mesh.tags.inherited(parent);
    let parent = parent.iter().copied().map(FaceId).collect();
    let document = Document { tags, level, parent, ..Document::from(mesh) };
    Ok(on_pool(|| io::write(&document, format))?.as_slice().into())
}
