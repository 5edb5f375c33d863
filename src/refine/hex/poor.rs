//! Mends the hexes that the smoothing of a transition left poor.
//!
//! Smoothing moves the layer's nodes alone, and untangling those around what is tangled. A refined hex between two parts of
//! the layer, or a coarse one, may be left next to flat by that, since its other nodes stay: all sweeps over the layer do not
//! help it. Here the nodes of such hexes move, and those up to [`RINGS`] of hexes around, whether of the layer or not. The
//! worst hex never gets worse.
//!
//! Nodes on curved surfaces move if they are the layer's, else they stay: what is divided later stands on the chords between
//! them.

use super::attempt::relax;
use super::local::Local;
use super::options::HexRefineError;
use super::stage::{StageMesh, StageResult};
use crate::Monitor;
use crate::mesh::HexId;
use crate::mesh::quality::{aspect, scaled_jacobian};
use crate::optimize::{BoundarySurface, OptimizeOptions};
use crate::parallel;

/// A hex is poor with a scaled Jacobian below this, over the aspect of the hex which it came from: transitions of cubes
/// hardly ever have one, those of thin hexes are thin.
const POOR: f64 = 0.2;

/// It is also below this share of that of the hex which it came from: what is poor because the input is stays as it is.
const SHARE: f64 = 0.5;

/// Rings of hexes around the poor ones whose nodes move.
const RINGS: usize = 2;

/// Moves nodes around the poor hexes of a stage that was made from the mesh `before`.
pub(super) fn mend_poor(
    stage: &mut StageResult,
    before: &StageMesh,
    surface: &BoundarySurface,
    monitor: &dyn Monitor,
) -> Result<(), HexRefineError> {
    let poor = poor_hexes(stage, before, monitor)?;
    if poor.is_empty() {
        return Ok(());
    }
    let options = OptimizeOptions { smooth_sweeps: 1, worst_sweeps: 16, ..OptimizeOptions::default() };
    let mut local = Local::beside(stage, &poor, RINGS, monitor)?;
    let faces = local.faces(monitor)?;
    if relax(stage, (&mut local, Some(faces)), surface, &options, monitor)?.is_empty() {
        local.write_back(&mut stage.mesh.positions);
    }
    Ok(())
}

/// The poor hexes. They need not be at the layer: where hexes were untangled others moved too.
fn poor_hexes(
    stage: &StageResult,
    before: &StageMesh,
    monitor: &dyn Monitor,
) -> Result<Vec<HexId>, HexRefineError> {
    if stage.layer_nodes.is_empty() {
        return Ok(Vec::new());
    }
    let corners = |mesh: &StageMesh, h: usize| mesh.hexes[h].map(|n| mesh.positions[n.index()]);
    let is_poor = |h: usize| {
        let here = scaled_jacobian(&corners(&stage.mesh, h));
        if here >= POOR {
            return false;
        }
        let parent = corners(before, stage.from[h] as usize);
        here * aspect(&parent) < POOR && here < SHARE * scaled_jacobian(&parent)
    };
    Ok(parallel::try_filter(stage.mesh.hexes.len(), monitor, is_poor)?.into_iter().map(HexId).collect())
}
