//! Mends the hexes that the smoothing of a transition left poor.
//!
//! Smoothing moves the layer's nodes alone, and untangling those around what is tangled. A refined hex between two parts of
//! the layer, or a coarse one, may be left next to flat by that, since its other nodes stay: all sweeps over the layer do not
//! help it. Here the nodes of such hexes move, and those up to [`RINGS`] of hexes around, whether of the layer or not. The
//! worst hex never gets worse.
//!
//! Nodes on curved surfaces move if they are the layer's, else they stay: what is divided later stands on the chords between
//! them.

use super::local::Local;
use super::stage::{StageMesh, StageResult};
use crate::mesh::HexId;
use crate::mesh::quality::{aspect, scaled_jacobian};
use crate::optimize::{BoundarySurface, OptimizeOptions};
use crate::{Cancelled, Monitor, parallel};

/// A hex is poor with a scaled Jacobian below this, over the aspect of the hex which it came from: transitions of cubes
/// hardly ever have one, those of thin hexes are thin.
const POOR: f64 = 0.2;

/// It is also below this share of that of the hex which it came from: what is poor because the input is stays as it is.
const SHARE: f64 = 0.5;

/// Rings of hexes around the poor ones whose nodes move.
const RINGS: usize = 2;

/// Moves nodes around the poor ones of the `smoothed` hexes of a stage that was made from the mesh `before`.
pub(super) fn mend_poor(
    stage: &mut StageResult,
    smoothed: &[HexId],
    before: &StageMesh,
    surface: &BoundarySurface,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    let poor = poor_hexes(stage, smoothed, before, monitor)?;
    if poor.is_empty() {
        return Ok(());
    }
    let options = OptimizeOptions { smooth_sweeps: 1, worst_sweeps: 16, ..OptimizeOptions::default() };
    let mut local = Local::beside(stage, &poor, RINGS, monitor)?;
    let faces = local.kept_faces(&stage.mesh, monitor)?;
    if local.relax(stage, faces, surface, &options, monitor)?.is_empty() {
        local.write_back(&mut stage.mesh.positions);
    }
    Ok(())
}

/// The poor ones of the `smoothed` hexes.
fn poor_hexes(
    stage: &StageResult,
    smoothed: &[HexId],
    before: &StageMesh,
    monitor: &dyn Monitor,
) -> Result<Vec<HexId>, Cancelled> {
    let corners = |mesh: &StageMesh, h: usize| mesh.hexes[h].map(|n| mesh.positions[n.index()]);
    let is_poor = |k: usize| {
        let h = smoothed[k].index();
        let here = scaled_jacobian(&corners(&stage.mesh, h));
        if here >= POOR {
            return false;
        }
        let parent = corners(before, stage.from[h] as usize);
        here * aspect(&parent) < POOR && here < SHARE * scaled_jacobian(&parent)
    };
    let poor = parallel::try_filter(smoothed.len(), monitor, is_poor)?;
    Ok(poor.into_iter().map(|k| smoothed[k as usize]).collect())
}
