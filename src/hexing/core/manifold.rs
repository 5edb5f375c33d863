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
//! The **link** of a node is a sphere, which the cells around it divide; where the node is on the boundary of the mesh,
//! what is beyond is one region more of it, always out. The boundary of the set is a manifold at the node if what is in
//! is joined through faces there, and what is out too: then both are discs, and one circle separates them.
//!
//! So a component of those that are too many changes sides, or a single cell that joins two of them: what costs least. A
//! cell costs how deep it lies on its side, in edge lengths, and 1 for each time that it was changed before. No cell is
//! changed more than [`MOST_FLIPS`] times: where that is not enough, all cells at the node are taken out for good. So it
//! ends, whatever the cells.

use super::cells::{Cells, NONE};
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::FACES_AT;
use crate::{Cancelled, Monitor, parallel};

/// So often a cell may change sides.
const MOST_FLIPS: u8 = 8;

/// Share of an edge: a cell whose centre is deeper stays on its side, even where it stands out alone.
const SHALLOW: f64 = 0.25;

/// What was done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Repairs {
    /// Cells that changed sides, each time counted.
    pub flips: usize,
    /// Rounds over all nodes that might be pinched.
    pub rounds: usize,
}

/// Changes as few and as shallow cells as may be, until `inside` is bounded by a manifold and no shallow cell stands
/// out, or is missing, alone. `depth` is how deep each cell lies outside, in edge lengths; negative inside.
pub(super) fn make_manifold(
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
        let look = Star::default;
        let pinched = parallel::gather_with(nodes.len(), look, |star: &mut Star, k, found: &mut Vec<u32>| {
            found.extend(repair.is_pinched(NodeId(nodes[k]), star).then_some(nodes[k]));
        });
        let mut changed = Vec::new();
        let mut star = Star::default();
        for node in pinched {
            repair.mend(NodeId(node), &mut star, &mut changed);
        }
        if changed.is_empty() {
            for cell in std::mem::take(&mut lonely) {
                repair.turn_if_alone(cell as usize, &mut changed);
            }
        }
        lonely.extend(changed.iter().flat_map(|&cell| cells.beside(cell as usize).map(|c| c as u32)));
        lonely.extend(&changed);
        distinct(&mut lonely);
        nodes = changed.iter().flat_map(|&cell| cells.mesh.hexes[cell as usize].map(|n| n.0)).collect();
        distinct(&mut nodes);
    }
    Ok(repair.repairs)
}

fn distinct(ids: &mut Vec<u32>) {
    ids.sort_unstable();
    ids.dedup();
}

struct Repair<'a> {
    cells: &'a Cells<'a>,
    depth: &'a [f64],
    inside: &'a mut [bool],
    /// How often each cell has changed sides; [`u8::MAX`]: it is out for good.
    flips: Vec<u8>,
    repairs: Repairs,
}

/// No component yet.
const UNKNOWN: u8 = u8::MAX;

/// The cells around a node, by components.
#[derive(Default)]
struct Star {
    /// Each with its corner there.
    cells: Vec<(usize, usize)>,
    /// The component of each cell.
    component: Vec<u8>,
    components: Vec<Component>,
}

#[derive(Clone, Copy)]
struct Component {
    is_inside: bool,
    /// What it costs to change sides.
    cost: f64,
}

/// What may change sides.
#[derive(Clone, Copy)]
enum Change {
    Component(u8),
    /// A cell, by its place in the star.
    Cell(usize),
}

impl Star {
    fn count(&self, inside: bool) -> usize {
        self.components.iter().filter(|component| component.is_inside == inside).count()
    }
}

impl Repair<'_> {
    fn is_pinched(&self, node: NodeId, star: &mut Star) -> bool {
        let mut cells = self.cells.around(node);
        let first = cells.next().map(|(cell, _)| self.inside[cell]);
        if cells.all(|(cell, _)| Some(self.inside[cell]) == first) {
            return false;
        }
        self.look(node, star);
        star.components.len() > 2
    }

    /// Finds the components around a node.
    fn look(&self, node: NodeId, star: &mut Star) {
        star.cells.clear();
        star.cells.extend(self.cells.around(node));
        star.component.clear();
        star.component.resize(star.cells.len(), UNKNOWN);
        star.components.clear();
        // What is beyond the mesh first: with it go all cells outside that have a face on its boundary here.
        let on_boundary = |(cell, corner): (usize, usize)| {
            FACES_AT[corner].iter().any(|&(face, _)| self.cells.neighbours[cell][usize::from(face)] == NONE)
        };
        if self.cells.around(node).any(on_boundary) {
            star.components.push(Component { is_inside: false, cost: f64::INFINITY });
            for k in 0..star.cells.len() {
                if star.component[k] == UNKNOWN && !self.inside[star.cells[k].0] && on_boundary(star.cells[k])
                {
                    self.flood(star, k);
                }
            }
        }
        for k in 0..star.cells.len() {
            if star.component[k] == UNKNOWN {
                star.components.push(Component { is_inside: self.inside[star.cells[k].0], cost: 0.0 });
                self.flood(star, k);
            }
        }
    }

    /// Puts the cells that are joined to the `k`-th into the newest component.
    fn flood(&self, star: &mut Star, k: usize) {
        let component = star.components.len() - 1;
        let mut left = vec![k];
        star.component[k] = component as u8;
        while let Some(k) = left.pop() {
            let (cell, corner) = star.cells[k];
            star.components[component].cost += self.cost(cell);
            for (face, _) in FACES_AT[corner] {
                let other = self.cells.neighbours[cell][usize::from(face)];
                let at = star.cells.iter().position(|&(c, _)| c == other as usize);
                let Some(at) = at.filter(|&at| star.component[at] == UNKNOWN) else { continue };
                if self.inside[star.cells[at].0] == self.inside[cell] {
                    star.component[at] = component as u8;
                    left.push(at);
                }
            }
        }
    }

    fn cost(&self, cell: usize) -> f64 {
        match self.flips[cell] {
            flips if flips >= MOST_FLIPS => f64::INFINITY,
            flips => self.depth[cell].abs() + f64::from(flips),
        }
    }

    /// Changes cells at a node until it is not pinched.
    fn mend(&mut self, node: NodeId, star: &mut Star, changed: &mut Vec<u32>) {
        while self.is_pinched(node, star) {
            let cheapest = self.cheapest(star);
            for (k, (&(cell, _), &component)) in star.cells.iter().zip(&star.component).enumerate() {
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
    fn cheapest(&self, star: &Star) -> Option<Change> {
        let too_many = [star.count(false) > 1, star.count(true) > 1];
        let components = star.components.iter().zip(0u8..);
        let components = components.filter(|(component, _)| too_many[usize::from(component.is_inside)]);
        let components = components.map(|(component, k)| (component.cost, Change::Component(k)));
        let bridges = (0..star.cells.len()).filter(|&k| self.is_bridge(star, k));
        let bridges = bridges.map(|k| (self.cost(star.cells[k].0), Change::Cell(k)));
        let changes = components.chain(bridges).filter(|(cost, _)| cost.is_finite());
        changes.min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, change)| change)
    }

    /// Does the `k`-th cell have faces at the node in common with two components of the other side?
    fn is_bridge(&self, star: &Star, k: usize) -> bool {
        let (cell, corner) = star.cells[k];
        let other_side = |&(face, _): &(u8, [u8; 3])| {
            let other = self.cells.neighbours[cell][usize::from(face)] as usize;
            let at = star.cells.iter().position(|&(c, _)| c == other)?;
            (self.inside[other] != self.inside[cell]).then_some(star.component[at])
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
