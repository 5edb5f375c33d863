//! Makes the boundary of a set of cells a 2-manifold.
//!
//! ```text
//!   +---+---+      At the node in the middle the two cells that are in share an edge, but no face: the boundary is
//!   |in |   |      pinched. One of the two is taken out, or what lies between them is put in, whichever costs least.
//!   +---o---+
//!   |   |in |
//!   +---+---+
//! ```
//!
//! At each node that is pinched (see `link`) a component of those that are too many changes sides, or a single cell that
//! joins two of them: what costs least. A cell costs how deep it lies on its side, in edge lengths, and 1 for each time
//! that it was changed before. No cell is changed more than [`MOST_FLIPS`] times: where that is not enough, all cells at
//! the node are taken out for good. So it ends, whatever the cells.

use super::cells::{Cells, distinct};
use super::link::{Component, Link};
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::FACES_AT;
use crate::{Cancelled, Monitor, parallel};

/// So often a cell may change sides.
const MOST_FLIPS: u8 = 8;

/// Share of an edge: a cell whose centre is deeper stays on its side, even where it stands out alone.
const SHALLOW: f64 = 0.25;

/// What was done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in super::super) struct Repairs {
    /// Cells that changed sides, each time counted.
    pub flips: usize,
    /// Rounds over all nodes that might be pinched.
    pub rounds: usize,
}

/// Changes as few and as shallow cells as may be, until `inside` is bounded by a manifold and no shallow cell stands
/// out, or is missing, alone. `depth` is how deep each cell lies outside, in edge lengths; negative inside.
#[inline(never)] // Compiled once for all that call it.
pub(in super::super) fn make_manifold(
    cells: &Cells<'_>,
    depth: &[f64],
    inside: &mut [bool],
    monitor: &dyn Monitor,
) -> Result<Repairs, Cancelled> {
    let count = cells.len();
    let mut repair = Repair { cells, depth, inside, flips: vec![0; count], repairs: Repairs::default() };
    let mut nodes: Vec<u32> = (0..cells.mesh.positions.len() as u32).collect();
    let mut lonely: Vec<u32> = (0..count as u32).collect();
    while !nodes.is_empty() {
        monitor.proceed()?;
        repair.repairs.rounds += 1;
        let look = |link: &mut Link, k: usize, found: &mut Vec<u32>| {
            found.extend(repair.is_pinched(NodeId(nodes[k]), link).then_some(nodes[k]));
        };
        let pinched = parallel::gather_with(nodes.len(), Link::default, look);
        let mut changed = Vec::new();
        let mut link = Link::default();
        for node in pinched {
            repair.mend(NodeId(node), &mut link, &mut changed);
        }
        if changed.is_empty() {
            for cell in std::mem::take(&mut lonely) {
                repair.turn_if_alone(cell as usize, &mut changed);
            }
        }
        lonely.extend(changed.iter().flat_map(|&cell| cells.beside(cell as usize).map(|c| c as u32)));
        lonely.extend(&changed);
        lonely = distinct(lonely);
        nodes = changed.iter().flat_map(|&cell| cells.mesh.hexes[cell as usize].map(|n| n.0)).collect();
        nodes = distinct(nodes);
    }
    Ok(repair.repairs)
}

struct Repair<'a> {
    cells: &'a Cells<'a>,
    depth: &'a [f64],
    inside: &'a mut [bool],
    /// How often each cell has changed sides; [`u8::MAX`]: it is out for good.
    flips: Vec<u8>,
    repairs: Repairs,
}

/// What may change sides.
#[derive(Clone, Copy)]
enum Change {
    Component(u8),
    /// A cell, by its place in the link.
    Cell(usize),
}

impl Repair<'_> {
    fn is_pinched(&self, node: NodeId, link: &mut Link) -> bool {
        link.is_pinched(self.cells, node, |cell| self.inside[cell])
    }

    fn cost(&self, cell: usize) -> f64 {
        match self.flips[cell] {
            flips if flips >= MOST_FLIPS => f64::INFINITY,
            flips => self.depth[cell].abs() + f64::from(flips),
        }
    }

    /// What it costs that a component changes sides.
    fn cost_of(&self, link: &Link, component: Component, k: u8) -> f64 {
        if component.is_beyond {
            return f64::INFINITY;
        }
        let cells = link.cells.iter().zip(&link.component).filter(|&(_, &of)| of == k);
        cells.map(|(&(cell, _), _)| self.cost(cell)).sum()
    }

    /// Changes cells at a node until it is not pinched.
    fn mend(&mut self, node: NodeId, link: &mut Link, changed: &mut Vec<u32>) {
        while self.is_pinched(node, link) {
            let cheapest = self.cheapest(link);
            for (k, (&(cell, _), &component)) in link.cells.iter().zip(&link.component).enumerate() {
                let changes = match cheapest {
                    Some(Change::Component(of)) => of == component,
                    Some(Change::Cell(at)) => at == k,
                    None => self.inside[cell],
                };
                if changes {
                    self.flip(cell, changed);
                }
                if changes && cheapest.is_none() {
                    self.flips[cell] = u8::MAX;
                }
            }
        }
    }

    /// The change of finite cost that costs least: of a component of those that are too many, or of a cell that joins two
    /// of them.
    fn cheapest(&self, link: &Link) -> Option<Change> {
        let too_many = [link.count(false) > 1, link.count(true) > 1];
        let components = link.components.iter().zip(0u8..);
        let components = components.filter(|(component, _)| too_many[usize::from(component.is_inside)]);
        let components =
            components.map(|(component, k)| (self.cost_of(link, *component, k), Change::Component(k)));
        let bridges = (0..link.cells.len()).filter(|&k| self.is_bridge(link, k));
        let bridges = bridges.map(|k| (self.cost(link.cells[k].0), Change::Cell(k)));
        let changes = components.chain(bridges).filter(|(cost, _)| cost.is_finite());
        changes.min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, change)| change)
    }

    /// Does the `k`-th cell have faces at the node in common with two components of the other side?
    fn is_bridge(&self, link: &Link, k: usize) -> bool {
        let (cell, corner) = link.cells[k];
        let other_side = |&(face, _): &(u8, [u8; 3])| {
            let other = self.cells.neighbours[cell][usize::from(face)] as usize;
            let at = link.cells.iter().position(|&(c, _)| c == other)?;
            (self.inside[other] != self.inside[cell]).then_some(link.component[at])
        };
        let mut components = FACES_AT[corner].iter().filter_map(other_side);
        let first = components.next();
        components.any(|component| Some(component) != first)
    }

    fn flip(&mut self, cell: usize, changed: &mut Vec<u32>) {
        self.inside[cell] = !self.inside[cell];
        self.flips[cell] = self.flips[cell].saturating_add(1);
        self.repairs.flips += 1;
        changed.push(cell as u32);
    }

    /// Takes out a shallow cell with at most one neighbour inside, and puts one in that has five or six.
    fn turn_if_alone(&mut self, cell: usize, changed: &mut Vec<u32>) {
        let beside = self.cells.beside(cell).filter(|&other| self.inside[other]).count();
        let stands_out = if self.inside[cell] { beside <= 1 } else { beside >= 5 };
        if stands_out && self.depth[cell].abs() <= SHALLOW && self.flips[cell] < MOST_FLIPS {
            self.flip(cell, changed);
        }
    }
}

#[cfg(test)]
mod tests;
