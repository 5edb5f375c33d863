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
//! 4. `unite`: at a corner of more than three surfaces a sheet over one of them would be pinched. If hexes have two faces in
//!    it still when all other sheets are there, it lies over a neighbour as well, and all is done anew.
//! 5. `collars`: quads that stay flat at a smooth curve are pillowed one by one.
//! 6. `wedges`: a sheet leaves two hexes at a curve between surfaces of its group. Where these meet so sharply that there
//!    is room for one alone, a pillow beside the curve makes it one.
//!
//! All of these are pillows of shrink sets (`shrink`), decided by topology alone. Old nodes stay on the boundary, so that
//! the correspondence stays true. What cannot be pillowed without a pinch is left as it is and reported.
//!
//! New hexes are thin wedges between old nodes and copies: the fit has to push them open. What cannot be pushed open is
//! left out, and all else is inserted anew (`layers`).

mod boundary;
mod collars;
mod groups;
mod layers;
mod need;
mod shrink;
mod sides;
mod unite;
mod wedges;

use super::correspondence::Correspondence;
use crate::mesh::{HexMesh, NodeId};
use crate::solid::SolidModel;
use crate::{Cancelled, Monitor, Stage};
use boundary::Boundary;
use groups::Groups;
use layers::{Layers, Purpose};
use need::Look;
use shrink::{ShrinkSet, Torn, pillow};
use unite::partner;

const SHEETS: Stage = Stage("sheets");

/// The sheets, collars and wedges that were inserted, and what could not be done.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct SheetReport {
    groups: Groups,
    layers: Layers,
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
    insert(mesh, on, Groups::of(solid, &on.reduction), monitor)
}

fn insert(
    mesh: &mut HexMesh,
    on: &mut Correspondence,
    groups: Groups,
    monitor: &dyn Monitor,
) -> Result<SheetReport, Cancelled> {
    let mut report = SheetReport { groups, ..SheetReport::default() };
    report.insert(mesh, on, monitor)?;
    // The fit keeps them for long, and adds nothing.
    mesh.positions.shrink_to_fit();
    mesh.hexes.shrink_to_fit();
    Ok(report)
}

impl SheetReport {
    /// How many sheets, wedges and collars there are.
    pub fn len(&self) -> usize {
        self.layers.len()
    }

    /// True if nothing was inserted.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Parts the `hexes`, which cannot be pushed open, by whether they touch. Each with its culprit, which is the last
    /// sheet, collar or wedge that has a part in it, or is nearest to it; nothing if none was inserted.
    pub(super) fn culprits(&self, mesh: &HexMesh, hexes: &[u32]) -> Vec<(usize, Vec<u32>)> {
        self.layers.culprits(mesh, hexes)
    }

    /// Is it a sheet, and no collar or wedge?
    pub(super) fn is_sheet(&self, layer: usize) -> bool {
        self.layers.is_sheet(layer)
    }

    /// Inserts all anew but for these, and whatever else was left out before. Nodes of the core stay where they are.
    ///
    /// # Errors
    /// [`Cancelled`] when the monitor says so; sheets inserted before that stay.
    pub(super) fn leave_out(
        &mut self,
        mesh: &mut HexMesh,
        on: &mut Correspondence,
        culprits: &[usize],
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        self.layers.leave_out(culprits);
        self.layers.take_all_back(mesh, on);
        self.insert(mesh, on, monitor)
    }

    /// Takes the last sheet, wedge or collar back; false if there is none. Nodes stay where they are.
    pub fn take_back(&mut self, mesh: &mut HexMesh, on: &mut Correspondence) -> bool {
        let Some(layer) = self.layers.pop() else { return false };
        self.hexes -= mesh.hexes.len() - layer.first_hex as usize;
        layer.take_back(mesh, on);
        self.count();
        true
    }

    fn count(&mut self) {
        self.sheets = self.layers.count(|purpose| matches!(purpose, Purpose::Sheet(_)));
        self.collars = self.layers.count(|purpose| matches!(purpose, Purpose::Collar(_)));
        self.wedges = self.layers.count(|purpose| matches!(purpose, Purpose::Wedge(_)));
    }

    /// Inserts what is needed and not left out into a mesh without sheets.
    fn insert(
        &mut self,
        mesh: &mut HexMesh,
        on: &mut Correspondence,
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        let before = mesh.hexes.len();
        let boundary = loop {
            let mut boundary = Boundary::of(mesh, on);
            let inserted = self.insert_layers(mesh, on, &mut boundary, monitor);
            self.hexes = mesh.hexes.len() - before;
            self.count();
            on.faces = boundary.in_order();
            match inserted? {
                Inserted::All { pinched } => {
                    self.pinched = pinched;
                    break boundary;
                }
                Inserted::Pinched { unite: [a, b] } => {
                    self.groups.unite(a, b);
                    self.layers.take_all_back(mesh, on);
                }
            }
        };
        let flat = Look::new(mesh, on, &boundary, &self.groups).flat_corners();
        self.flat = flat.into_iter().map(|corner| corner.node).collect();
        self.flat.sort_unstable();
        self.flat.dedup();
        monitor.checkpoint(SHEETS, 1.0)
    }

    /// Inserts sheets, collars and wedges, until a sheet has to lie over two groups.
    fn insert_layers(
        &mut self,
        mesh: &mut HexMesh,
        on: &mut Correspondence,
        boundary: &mut Boundary,
        monitor: &dyn Monitor,
    ) -> Result<Inserted, Cancelled> {
        let Self { groups, layers, .. } = self;
        let mut torn: Vec<(u32, Vec<NodeId>)> = Vec::new();
        let mut waiting: Vec<bool> =
            (0..groups.bound() as u32).map(|group| layers.takes_sheet(group)).collect();
        loop {
            let done = waiting.iter().filter(|&&waiting| !waiting).count();
            monitor.checkpoint(SHEETS, done as f64 / (waiting.len() + 1) as f64)?;
            let needs = Look::new(mesh, on, boundary, groups).needs();
            let Some(group) = smallest(boundary, groups, |group| needs[group] && waiting[group]) else {
                break;
            };
            waiting[group as usize] = false;
            let quads = quads_of(boundary, groups, group);
            match pillow(mesh, on, boundary, &ShrinkSet::Sheet(&quads)) {
                Ok(layer) => layers.push(layer, Purpose::Sheet(group)),
                Err(Torn(nodes)) => torn.push((group, nodes)),
            }
        }
        // Others may have done the work of a sheet that would have been pinched.
        let is_torn = |group: u32| torn.iter().any(|(other, _)| *other == group);
        let look = Look::new(mesh, on, boundary, groups);
        let (needs, bent) = (look.needs(), look.bent_hexes());
        let mut pinched = Vec::new();
        for (group, nodes) in torn.iter().filter(|(group, _)| needs[*group as usize]) {
            let takes = |other: u32| bent.contains(group) && layers.takes_sheet(other);
            let has_none = |other: u32| waiting[other as usize] || is_torn(other);
            if let Some(other) = partner(&look, *group, nodes, takes, has_none) {
                return Ok(Inserted::Pinched { unite: [*group, other] });
            }
            pinched.extend(nodes);
        }
        collars::insert(mesh, on, boundary, groups, layers, monitor)?;
        pinched.extend(wedges::insert(mesh, on, boundary, groups, layers, monitor)?);
        Ok(Inserted::All { pinched })
    }
}

/// What came of inserting sheets, collars and wedges.
enum Inserted {
    /// All are there; or none of those that would have been pinched, at these nodes.
    All { pinched: Vec<NodeId> },
    /// A sheet would have been pinched that is not if it lies over these two groups.
    Pinched { unite: [u32; 2] },
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
