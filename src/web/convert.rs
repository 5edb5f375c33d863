//! Numbers and objects on their way from JavaScript and to it.

use serde::Serialize;
use wasm_bindgen::prelude::JsValue;

use super::errors::Failure;
use crate::geometry::{Aabb, Point};
use crate::mesh::NodeId;

/// A box, as JavaScript has it.
#[derive(Serialize)]
pub(super) struct Bounds {
    min: Point,
    max: Point,
}

impl From<Aabb> for Bounds {
    fn from(Aabb { min, max }: Aabb) -> Self {
        Self { min, max }
    }
}

/// How large a mesh and its edges are.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct Extent {
    bounds: Bounds,
    longest_edge: f64,
    shortest_edge: f64,
    mean_edge: f64,
}

impl Extent {
    /// Measures the edges with the given ends. Without edges all lengths are 0.
    pub(super) fn of(positions: &[Point], ends: &[[NodeId; 2]]) -> Self {
        let length = |&[a, b]: &[NodeId; 2]| positions[a.index()].distance(positions[b.index()]);
        let (mut longest, mut shortest, mut sum) = (0.0, f64::INFINITY, 0.0);
        for length in ends.iter().map(length) {
            longest = f64::max(longest, length);
            shortest = f64::min(shortest, length);
            sum += length;
        }
        Self {
            bounds: Aabb::around(positions).into(),
            longest_edge: longest,
            shortest_edge: if ends.is_empty() { 0.0 } else { shortest },
            mean_edge: sum / ends.len().max(1) as f64,
        }
    }
}

/// An object with the fields of `value`; those that are flattened into it would otherwise make it a Map. What is not there
/// is null.
pub(super) fn to_object(value: &impl Serialize) -> Result<JsValue, Failure> {
    let serializer =
        serde_wasm_bindgen::Serializer::new().serialize_maps_as_objects(true).serialize_missing_as_null(true);
    Ok(value.serialize(&serializer)?)
}

/// The nodes of an array of x, y, z, in its own memory.
pub(super) fn points(nodes: Vec<f64>) -> Result<Vec<Point>, Failure> {
    if let Some(at) = nodes.iter().position(|x| !x.is_finite()) {
        let message =
            format!("coordinate {} of node {} is {}, not a finite number", at % 3, at / 3, nodes[at]);
        return Err(Failure::input("array-not-finite", &message));
    }
    bytemuck::try_cast_vec(nodes).map_err(|(_, nodes)| {
        let message = format!("the array of nodes has {} numbers, not three for each node", nodes.len());
        Failure::input("array-length", &message)
    })
}

/// The cells of an array of their corners, in its own memory; `what` names them.
pub(super) fn cells<const N: usize>(
    ids: Vec<u32>,
    nodes: usize,
    what: &str,
) -> Result<Vec<[NodeId; N]>, Failure>
where
    [NodeId; N]: bytemuck::AnyBitPattern + bytemuck::NoUninit,
{
    check_ids(&ids, nodes)?;
    bytemuck::try_cast_vec(ids).map_err(|(_, ids)| {
        let message = format!("the array of {what} has {} numbers, not {N} for each of them", ids.len());
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

/// Refuses an array of what cells were made from that does not name one of the input's cells for each.
#[cfg(any(feature = "quads", feature = "hexes"))]
pub(super) fn check_parents(parent: &[u32], cells: usize, of_input: usize) -> Result<(), Failure> {
    if parent.len() == cells && parent.iter().all(|&p| (p as usize) < of_input) {
        return Ok(());
    }
    let message = format!("parent has to name one of the input's {of_input} cells for each of {cells} cells");
    Err(Failure::input("array-parent", &message))
}
