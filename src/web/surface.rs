//! A surface that JavaScript loaded: the input of refinement.

use std::sync::Arc;

use js_sys::{Float64Array, Uint32Array};
use wasm_bindgen::prelude::wasm_bindgen;

use super::errors::Failure;
use crate::geometry::Point;
use crate::mesh::{NodeId, PolygonMesh};

/// A polygon surface in this module's memory.
#[wasm_bindgen]
pub struct Surface {
    pub(super) mesh: Arc<PolygonMesh>,
}

#[wasm_bindgen]
impl Surface {
    /// A surface of faces given as arrays: x, y, z of each node; where each face's corners start, and the end of
    /// the last; the nodes of all faces. Without `offsets` all faces are quads.
    ///
    /// # Errors
    /// If the arrays do not fit together.
    #[wasm_bindgen(js_name = fromArrays)]
    pub fn from_arrays(nodes: &[f64], offsets: Option<Vec<u32>>, corners: &[u32]) -> Result<Self, Failure> {
        let positions = points(nodes)?;
        check_ids(corners, positions.len())?;
        let offsets = offsets.unwrap_or_else(|| (0..=corners.len() as u32).step_by(4).collect());
        check_offsets(&offsets, corners.len())?;
        let corners = corners.iter().copied().map(NodeId).collect();
        let mesh = PolygonMesh { positions, offsets, corners, ..PolygonMesh::default() };
        Ok(Self { mesh: Arc::new(mesh) })
    }

    /// x, y, z of each node.
    pub fn nodes(&self) -> Float64Array {
        bytemuck::cast_slice::<Point, f64>(&self.mesh.positions).into()
    }

    /// Where each face's corners start, and the end of the last.
    pub fn offsets(&self) -> Uint32Array {
        self.mesh.offsets.as_slice().into()
    }

    /// The nodes of all faces, face after face.
    pub fn corners(&self) -> Uint32Array {
        bytemuck::cast_slice::<NodeId, u32>(&self.mesh.corners).into()
    }
}

/// The nodes of an array of x, y, z.
pub(super) fn points(nodes: &[f64]) -> Result<Vec<Point>, Failure> {
    if let Some(at) = nodes.iter().position(|x| !x.is_finite()) {
        let message =
            format!("coordinate {} of node {} is {}, not a finite number", at % 3, at / 3, nodes[at]);
        return Err(Failure::input("array-not-finite", &message));
    }
    bytemuck::try_cast_slice(nodes).map(<[Point]>::to_vec).map_err(|_| {
        let message = format!("the array of nodes has {} numbers, not three for each node", nodes.len());
        Failure::input("array-length", &message)
    })
}

/// Refuses ids of nodes that are not there.
pub(super) fn check_ids(ids: &[u32], nodes: usize) -> Result<(), Failure> {
    match ids.iter().position(|&id| id as usize >= nodes) {
        None => Ok(()),
        Some(at) => {
            let message =
                format!("corner {at} is node {}, but there are {nodes} nodes, counted from 0", ids[at]);
            Err(Failure::input("array-index-out-of-range", &message))
        }
    }
}

fn check_offsets(offsets: &[u32], corners: usize) -> Result<(), Failure> {
    let ends = offsets.first() == Some(&0) && offsets.last().map(|&end| end as usize) == Some(corners);
    if !ends {
        let message = format!("offsets have to start with 0 and end with the number of corners, {corners}");
        return Err(Failure::input("array-offsets", &message));
    }
    match offsets.windows(2).position(|w| w[1] < w[0] || w[1] - w[0] < 3) {
        None => Ok(()),
        Some(face) => {
            let message = format!("face {face} has fewer than 3 corners by its offsets");
            Err(Failure::input("array-offsets", &message))
        }
    }
}
