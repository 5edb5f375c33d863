//! Sheets under a mesh's boundary, where cells would be flat on the solid: the paper's topological optimisation by way
//! of the fundamental mesh (section 6).
//!
//! A core mesh has hexes with two faces on one smooth surface, and curves with two hexes where there is room for one.
//! No position of the nodes makes these good. A sheet over the surface gives each boundary quad a hex of its own:
//!
//! 1. `groups`: surfaces that meet flatly or at a concave curve are covered together.
//! 2. `need`: a group is covered only where a cell would be flat without.
//! 3. The smallest group in need first; then all are looked at again, since a sheet can do its neighbours' work, or
//!    make some.
//! 4. `collars`: quads that stay flat at a smooth curve are pillowed one by one.
//! 5. `wedges`: a sheet leaves two hexes at a curve between surfaces of its group. Where these meet so sharply that there
//!    is room for one alone, a pillow beside the curve makes it one.
//!
//! All of these are pillows of shrink sets (`shrink`), decided by topology alone. Old nodes stay on the boundary, so that
//! the correspondence stays true. What cannot be pillowed without a pinch is left as it is and reported.
//!
//! New hexes are thin wedges between old nodes and copies: the fit has to push them open.

mod boundary;
mod collars;
mod groups;
mod need;
mod shrink;
mod sides;
mod wedges;

use super::correspondence::Correspondence;
use crate::mesh::{HexMesh, NodeId};
use crate::solid::SolidModel;
use crate::{Cancelled, Monitor, Stage};
use boundary::Boundary;
use groups::Groups;
use need::Look;
use shrink::{Layer, ShrinkSet, Torn, pillow};

const SHEETS: Stage = Stage("sheets");

/// The sheets, collars and wedges that were inserted, in this order, and what could not be done.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SheetReport {
    layers: Vec<Layer>,
    /// Sheets over groups of surfaces.
    pub sheets: usize,
    /// Pillows beside curves that have room for one hex alone.
    pub wedges: usize,
    /// Pillows around hexes at smooth curves.
    pub collars: usize,
    /// Hexes that were added.
    pub hexes: usize,
    /// Nodes where a sheet or wedge that was needed would have been pinched: it was not inserted.
    pub pinched: Vec<NodeId>,
    /// Nodes on smooth curves at which a quad stays flat.
    pub flat: Vec<NodeId>,
}

impl SheetReport {
    /// How many sheets, wedges and collars there are.
    pub fn len(&self) -> usize {
        self.layers.len()
    }

    /// True if nothing was inserted.
    pub fn is_empty(&self) -> bool {
        self.layers.is_empty()
    }

    /// The place of the last sheet, collar or wedge that has a part in some of the `hexes` by its hexes or nodes; the last
    /// of all if none has. `None` if there are no sheets or no `hexes`.
    pub(super) fn last_with(&self, mesh: &HexMesh, hexes: &[u32]) -> Option<usize> {
        let node = hexes.iter().flat_map(|&h| mesh.hexes[h as usize]).max()?;
        let hex = hexes.iter().copied().max()?;
        let is_part = |layer: &Layer| layer.first_hex <= hex || layer.first_node <= node;
        self.layers.iter().rposition(is_part).or(self.layers.len().checked_sub(1))
    }

    /// Takes the last sheet, wedge or collar back; false if there is none. Nodes stay where they are.
    pub fn take_back(&mut self, mesh: &mut HexMesh, on: &mut Correspondence) -> bool {
        let Some(layer) = self.layers.pop() else { return false };
        self.hexes -= mesh.hexes.len() - layer.first_hex as usize;
        layer.take_back(mesh, on);
        match self.layers.len() {
            left if left < self.sheets => self.sheets -= 1,
            left if left < self.sheets + self.collars => self.collars -= 1,
            _ => self.wedges -= 1,
        }
        true
    }
}

/// Inserts the sheets, collars and wedges that `mesh` needs on `solid`. New nodes come last, as do new hexes; `on` stays
/// true.
///
/// # Errors
/// [`Cancelled`] when the monitor says so; sheets inserted before that stay.
pub fn insert_sheets(
    mesh: &mut HexMesh,
    on: &mut Correspondence,
    solid: &SolidModel,
    monitor: &dyn Monitor,
) -> Result<SheetReport, Cancelled> {
    let groups = Groups::of(solid, &on.reduction);
    insert(mesh, on, &groups, monitor)
}

fn insert(
    mesh: &mut HexMesh,
    on: &mut Correspondence,
    groups: &Groups,
    monitor: &dyn Monitor,
) -> Result<SheetReport, Cancelled> {
    let before = mesh.hexes.len();
    let mut report = SheetReport::default();
    let mut boundary = Boundary::of(mesh, on);
    let mut tried = vec![false; groups.bound()];
    loop {
        let done = tried.iter().filter(|&&tried| tried).count();
        monitor.checkpoint(SHEETS, done as f64 / (tried.len() + 1) as f64)?;
        let needs = Look::new(mesh, on, &boundary, groups).needs();
        let Some(group) = smallest(&boundary, groups, |group| needs[group] && !tried[group]) else { break };
        tried[group as usize] = true;
        let quads = quads_of(&boundary, groups, group);
        match pillow(mesh, on, &mut boundary, &ShrinkSet::Sheet(&quads)) {
            Ok(layer) => report.layers.push(layer),
            Err(Torn(nodes)) => report.pinched.extend(nodes),
        }
    }
    report.sheets = report.layers.len();
    report.layers.extend(collars::insert(mesh, on, &mut boundary, groups));
    report.collars = report.layers.len() - report.sheets;
    let wedges = wedges::insert(mesh, on, &mut boundary, groups, monitor)?;
    report.wedges = wedges.layers.len();
    report.layers.extend(wedges.layers);
    report.pinched.extend(wedges.torn);
    let flat = Look::new(mesh, on, &boundary, groups).flat_corners();
    report.flat = flat.into_iter().map(|corner| corner.node).collect();
    report.flat.sort_unstable();
    report.flat.dedup();
    report.hexes = mesh.hexes.len() - before;
    on.faces = boundary.in_order();
    monitor.checkpoint(SHEETS, 1.0)?;
    Ok(report)
}

/// The group with the fewest quads of those `wanted`, the least if several have as many.
fn smallest(boundary: &Boundary, groups: &Groups, wanted: impl Fn(usize) -> bool) -> Option<u32> {
    let mut sizes = vec![0usize; groups.bound()];
    boundary.surface.iter().for_each(|&surface| sizes[groups.group(surface) as usize] += 1);
    let candidates = (0..sizes.len()).filter(|&group| sizes[group] > 0 && wanted(group));
    candidates.min_by_key(|&group| (sizes[group], group)).map(|group| group as u32)
}

fn quads_of(boundary: &Boundary, groups: &Groups, group: u32) -> Vec<u32> {
    let quads = 0..boundary.quads.len() as u32;
    quads.filter(|&q| groups.group(boundary.surface[q as usize]) == group).collect()
}

#[cfg(test)]
pub(super) mod testing;
#[cfg(test)]
mod tests;
