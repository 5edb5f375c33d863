//! A stage with its transition untangled, smoothed and mended; or what must be refined too.

use std::collections::HashMap;

use super::local::{Local, relax_freely};
use super::options::{HexRefineError, Method};
use super::poor::mend_poor;
use super::stage::{StageError, StageMesh, StageResult, opened_stage};
use crate::Monitor;
use crate::mesh::topology::{HexFaces, Sets};
use crate::mesh::{HexId, NodeId};
use crate::optimize::{BoundarySurface, OptimizeOptions};

/// How a stage ended.
pub(super) enum Attempt {
    /// Every hex is positive.
    Made(Box<StageResult>),
    /// The interface cannot be separated unless these hexes are refined too.
    Conflict(Vec<u32>),
    /// So many `hexes` stay inside out; `coarse` ones beside them are to be refined too.
    Tangled { coarse: Vec<u32>, hexes: usize },
}

/// Where hexes stay inverted, all nodes up to so many rings of hexes around them move, of the layer or not: a layer along a
/// concave ridge needs room that the hexes beside it have.
const WIDER: [usize; 3] = [2, 4, 8];

/// Makes a stage, untangles its transition, smooths it and mends what that leaves poor.
pub(super) fn attempt(
    mesh: &StageMesh,
    refined: &[bool],
    method: Method,
    surface: &BoundarySurface,
    monitor: &dyn Monitor,
) -> Result<Attempt, HexRefineError> {
    let mut next = match opened_stage(mesh, refined, method, monitor) {
        Err(StageError::Conflict(hexes)) => return Ok(Attempt::Conflict(hexes)),
        other => other.map_err(without_template)?,
    };
    if next.layer_nodes.is_empty() {
        return Ok(Attempt::Made(Box::new(next)));
    }
    let (mut tangled, mut smoothed) = if next.mesh.has_free_boundary {
        // Out of it a core is cut that is smoothed when it is fitted.
        let options = OptimizeOptions { courses: 2, smooth_sweeps: 3, ..OptimizeOptions::default() };
        relax_freely(&mut next, &options, monitor)?
    } else {
        let mut local = Local::around(&next, monitor)?;
        let faces = if next.is_inside { None } else { Some(local.faces(monitor)?) };
        let has_none = |faces: &HexFaces| next.mesh.materials.is_empty() && local.is_inside(faces);
        let options = smoothing(method, faces.as_ref().is_none_or(has_none));
        let tangled = local.relax(&next, faces, surface, &options, monitor)?;
        local.write_back(&mut next.mesh.positions);
        (tangled, local.hex_ids)
    };
    for rings in WIDER {
        if tangled.is_empty() {
            break;
        }
        let mut local = Local::beside(&next, &tangled, rings, monitor)?;
        let faces = local.kept_faces(&next.mesh, monitor)?;
        tangled = local.relax(&next, faces, surface, &OptimizeOptions::default(), monitor)?;
        local.write_back(&mut next.mesh.positions);
        smoothed.extend(local.hex_ids);
    }
    if tangled.is_empty() {
        smoothed.sort_unstable();
        smoothed.dedup();
        mend_poor(&mut next, &smoothed, mesh, surface, monitor)?;
        return Ok(Attempt::Made(Box::new(next)));
    }
    Ok(Attempt::Tangled { coarse: coarse_at(&next, &tangled), hexes: tangled.len() })
}

/// How far to smooth the transition of a method. A pillow that is inside was opened before it was divided, and needs less.
fn smoothing(method: Method, is_inside: bool) -> OptimizeOptions {
    let all = OptimizeOptions::default();
    match method {
        Method::One => OptimizeOptions { smooth_sweeps: 2, worst_sweeps: 4, ..all },
        _ if is_inside => OptimizeOptions { smooth_sweeps: 1, worst_sweeps: 4, ..all },
        _ => all,
    }
}

/// What it means that a stage was not made, other than for a conflict: closed trees leave no such place.
pub(super) fn without_template(error: StageError) -> HexRefineError {
    match error {
        StageError::Cancelled(cancelled) => HexRefineError::Cancelled(cancelled),
        StageError::Conflict(hexes) | StageError::Forbidden(hexes) | StageError::NotCouplable(hexes) => {
            HexRefineError::NoTemplate(hexes.len())
        }
    }
}

/// A coarse hex at each cluster of hexes that are `tangled`: the one with the most transition hexes that touch them.
fn coarse_at(stage: &StageResult, tangled: &[HexId]) -> Vec<u32> {
    let hexes = &stage.mesh.hexes;
    // The first tangled hex at each node, and the cluster of each.
    let mut first_at: HashMap<NodeId, u32> = HashMap::new();
    let mut clusters = Sets::new(tangled.len());
    for (k, h) in (0..).zip(tangled) {
        for node in hexes[h.index()] {
            clusters.join(k, *first_at.entry(node).or_insert(k), false);
        }
    }
    let mut touching: Vec<(u32, u32)> = Vec::new();
    for (hex, &from) in hexes.iter().zip(&stage.from).skip(stage.first_transition) {
        let near = hex.iter().filter_map(|node| first_at.get(node));
        touching.extend(near.map(|&k| (clusters.root(k).0, from)).min());
    }
    touching.sort_unstable();
    // Of those with as many the first.
    let most = |of_cluster: &[(u32, u32)]| {
        let of_hexes = of_cluster.chunk_by(|a, b| a == b);
        of_hexes.rev().max_by_key(|of_one| of_one.len()).map(|of_one| of_one[0].1)
    };
    let mut coarse: Vec<u32> = touching.chunk_by(|a, b| a.0 == b.0).filter_map(most).collect();
    coarse.sort_unstable();
    coarse.dedup();
    coarse
}
