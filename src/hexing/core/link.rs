//! The link of a node: a sphere, which the cells around the node divide.
//!
//! Where the node is on the boundary of the mesh, what is beyond is one region more of it, always out. The boundary of a
//! set of cells is a manifold at the node if what is in is joined through faces there, and what is out too: then both are
//! discs, and one circle separates them. Else the set is **pinched** there.

use super::cells::{Cells, NONE};
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::FACES_AT;

/// No component yet.
const UNKNOWN: u8 = u8::MAX;

/// The cells around a node, by components: those that are joined through faces there, and are all in or all out.
#[derive(Default)]
pub(super) struct Link {
    /// Each with its corner there.
    pub cells: Vec<(usize, usize)>,
    /// The component of each cell.
    pub component: Vec<u8>,
    pub components: Vec<Component>,
}

#[derive(Clone, Copy)]
pub(super) struct Component {
    pub is_inside: bool,
    /// Is what lies beyond the mesh part of it?
    pub is_beyond: bool,
}

impl Link {
    /// How many components are in, or out.
    pub fn count(&self, inside: bool) -> usize {
        self.components.iter().filter(|component| component.is_inside == inside).count()
    }

    /// Is a set of cells pinched at a node? If it is, the components are those of this node.
    pub fn is_pinched(&mut self, cells: &Cells<'_>, node: NodeId, is_in: impl Fn(usize) -> bool) -> bool {
        let mut around = cells.around(node);
        let first = around.next().map(|(cell, _)| is_in(cell));
        if around.all(|(cell, _)| Some(is_in(cell)) == first) {
            return false;
        }
        self.look(cells, node, &is_in);
        self.components.len() > 2
    }

    /// Finds the components around a node.
    fn look(&mut self, cells: &Cells<'_>, node: NodeId, is_in: &impl Fn(usize) -> bool) {
        self.cells.clear();
        self.cells.extend(cells.around(node));
        self.component.clear();
        self.component.resize(self.cells.len(), UNKNOWN);
        self.components.clear();
        // What is beyond the mesh first: with it go all cells outside that have a face on its boundary here.
        let on_boundary = |(cell, corner): (usize, usize)| {
            FACES_AT[corner].iter().any(|&(face, _)| cells.neighbours[cell][usize::from(face)] == NONE)
        };
        if cells.around(node).any(on_boundary) {
            self.components.push(Component { is_inside: false, is_beyond: true });
            for k in 0..self.cells.len() {
                if self.component[k] == UNKNOWN && !is_in(self.cells[k].0) && on_boundary(self.cells[k]) {
                    self.flood(cells, k, is_in);
                }
            }
        }
        for k in 0..self.cells.len() {
            if self.component[k] == UNKNOWN {
                self.components.push(Component { is_inside: is_in(self.cells[k].0), is_beyond: false });
                self.flood(cells, k, is_in);
            }
        }
    }

    /// Puts the cells that are joined to the `k`-th into the newest component.
    fn flood(&mut self, cells: &Cells<'_>, k: usize, is_in: &impl Fn(usize) -> bool) {
        let component = (self.components.len() - 1) as u8;
        let mut left = vec![k];
        self.component[k] = component;
        while let Some(k) = left.pop() {
            let (cell, corner) = self.cells[k];
            for (face, _) in FACES_AT[corner] {
                let other = cells.neighbours[cell][usize::from(face)];
                let at = self.cells.iter().position(|&(c, _)| c == other as usize);
                let Some(at) = at.filter(|&at| self.component[at] == UNKNOWN) else { continue };
                if is_in(self.cells[at].0) == is_in(cell) {
                    self.component[at] = component;
                    left.push(at);
                }
            }
        }
    }
}
