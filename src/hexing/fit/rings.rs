//! Hexes around some nodes, ring by ring.

use crate::mesh::HexMesh;
use crate::{Cancelled, Monitor, parallel};

/// Marks the nodes of all hexes at marked nodes too, so many times.
pub(super) fn widen(
    mesh: &HexMesh,
    marked: &mut [bool],
    rings: usize,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    for _ in 0..rings {
        let is_at = |h: usize| mesh.hexes[h].iter().any(|n| marked[n.index()]);
        let touched = parallel::try_filter(mesh.hexes.len(), monitor, is_at)?;
        touched.iter().flat_map(|&h| mesh.hexes[h as usize]).for_each(|n| marked[n.index()] = true);
    }
    Ok(())
}
