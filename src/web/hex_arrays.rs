//! Hex meshes on their way to JavaScript as arrays, and back.

use js_sys::{Float32Array, Float64Array, Uint32Array};
use wasm_bindgen::prelude::{JsValue, wasm_bindgen};

use super::convert::{cells, points, to_object};
use super::errors::Failure;
use super::listener::Listener;
use super::pool::on_pool;
use crate::geometry::Point;
use crate::mesh::check::{check_hexes_within, summary};
use crate::mesh::quality::{hex_quality, hex_quality_within};
use crate::mesh::{FaceGroups, HexMesh, NodeId, mesh_hash};

/// A hex mesh that was made, on its way to JavaScript.
#[wasm_bindgen]
pub struct HexArrays {
    mesh: HexMesh,
}

impl From<HexMesh> for HexArrays {
    fn from(mesh: HexMesh) -> Self {
        Self { mesh }
    }
}

#[wasm_bindgen]
impl HexArrays {
    /// x, y, z of each node.
    pub fn nodes(&self) -> Float64Array {
        bytemuck::cast_slice::<Point, f64>(&self.mesh.positions).into()
    }

    /// The eight nodes of each hex.
    pub fn hexes(&self) -> Uint32Array {
        bytemuck::cast_slice::<[NodeId; 8], u32>(&self.mesh.hexes).into()
    }

    /// The fingerprint of nodes and hexes.
    pub fn hash(&self) -> String {
        on_pool(|| mesh_hash(&self.mesh.positions, &self.mesh.hexes)).to_string()
    }

    /// How well shaped the hexes are: an object with the fields of `HexQuality` in `www/lib/results.ts`.
    ///
    /// # Errors
    /// If it was cancelled.
    pub fn quality(&self) -> Result<JsValue, Failure> {
        let quality = on_pool(|| hex_quality_within(&self.mesh, &Listener).map(|quality| quality.report()))?;
        to_object(&quality)
    }

    /// What is wrong with the mesh: one line for each kind of defect.
    ///
    /// # Errors
    /// If it was cancelled.
    pub fn defects(&self) -> Result<Vec<String>, Failure> {
        let defects = on_pool(|| check_hexes_within(&self.mesh, &Listener))?;
        Ok(summary(&defects).iter().map(ToString::to_string).collect())
    }
}

/// A measure of each hex, by its name in `HexQuality`.
///
/// # Errors
/// If the arrays do not fit together or there is no such measure.
#[wasm_bindgen(js_name = hexQuality)]
pub fn quality(nodes: Vec<f64>, hexes: Vec<u32>, metric: &str) -> Result<Float32Array, Failure> {
    let mesh = hex_mesh(nodes, hexes)?;
    let quality = on_pool(|| hex_quality(&mesh));
    let values = match metric {
        "scaledJacobian" => quality.scaled_jacobian,
        "aspect" => quality.aspect,
        "volume" => quality.volume,
        _ => {
            let message = format!("there is no measure {metric:?}; give scaledJacobian, aspect or volume");
            return Err(Failure::options("metric-unknown", &message));
        }
    };
    Ok(values.as_slice().into())
}

/// The mesh of these arrays, in their own memory.
pub(super) fn hex_mesh(nodes: Vec<f64>, hexes: Vec<u32>) -> Result<HexMesh, Failure> {
    let positions = points(nodes)?;
    let hexes = cells(hexes, positions.len(), "hexes")?;
    Ok(HexMesh { positions, hexes, ..HexMesh::default() })
}

/// Boundary faces, each with what it belongs to, as an array of two numbers for each.
pub(super) fn pairs(faces: impl Iterator<Item = (u32, u32)>) -> Uint32Array {
    let pairs: Vec<u32> = faces.flat_map(|(side, of)| [side, of]).collect();
    pairs.as_slice().into()
}

/// The groups that `grouped` makes of what [`pairs`] told.
pub(super) fn face_groups(
    pairs: &[u32],
    hexes: usize,
    grouped: impl FnOnce(Vec<(u32, u32)>) -> Option<FaceGroups>,
) -> Result<FaceGroups, Failure> {
    let (pairs, rest) = pairs.as_chunks::<2>();
    if pairs.is_empty() && rest.is_empty() {
        return Ok(FaceGroups::default());
    }
    let is_in_range = pairs.last().is_none_or(|&[last, _]| (last as usize) < 6 * hexes);
    let groups = grouped(pairs.iter().map(|&[side, of]| (side, of)).collect());
    let message = "the groups of faces are not those of the mesh";
    groups
        .filter(|_| is_in_range && rest.is_empty())
        .ok_or_else(|| Failure::input("groups-invalid", &message))
}
