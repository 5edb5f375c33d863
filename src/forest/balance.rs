//! Strong balance: no two elements that share a node differ by more than one level (section 2).
//!
//! Of a refined element of level `l` only one node can touch elements coarser than `l`: local node 0, the
//! corner that it has in common with its parent. The others divide an edge or the face of the parent, and a
//! coarser element that touches one of these has the edge, and so node 0, too. The rule is then
//!
//! > every element of a level below `l` that has local node 0 of a refined element of level `l` is refined.
//!
//! It is applied from the finest level to the coarsest, and again while anything changes: an element that is
//! split for it has children that may be too coarse in turn.

use super::QuadForest;
use crate::mesh::NodeId;
use crate::parallel;
use crate::{Cancelled, Monitor};

impl QuadForest {
    /// Splits elements until the forest is strongly balanced. The result is the smallest balanced forest
    /// that holds this one, whatever the order of the splits.
    pub fn balance(&mut self, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        let mut wanted = Wanted::default();
        for depth in 1..self.levels.len() {
            wanted.add(self, depth, 0);
        }
        loop {
            let mut changed = false;
            for depth in (0..self.levels.len().saturating_sub(2)).rev() {
                monitor.proceed()?;
                let level = &self.levels[depth];
                let marked = parallel::filter(level.elements.len(), |e| {
                    !level.is_refined[e] && wanted.deeper_than(depth, &level.elements[e])
                });
                let before = level.refined.len();
                self.split(depth, &marked, monitor)?;
                wanted.add(self, depth, before);
                changed |= !marked.is_empty();
            }
            if !changed {
                return Ok(());
            }
        }
    }
}

/// For each node the depth of the deepest refined element that has it as local node 0.
#[derive(Default)]
struct Wanted(Vec<u8>);

impl Wanted {
    /// Takes in the elements of `levels[depth]` from `refined[first]` on. At the base local node 0 is no
    /// different from the others, and nothing is coarser.
    fn add(&mut self, forest: &QuadForest, depth: usize, first: usize) {
        self.0.resize(forest.positions.len(), 0);
        let level = &forest.levels[depth];
        for &e in &level.refined[first..] {
            let wanted = &mut self.0[level.elements[e as usize][0].index()];
            *wanted = (*wanted).max(depth as u8);
        }
    }

    fn deeper_than(&self, depth: usize, element: &[NodeId; 4]) -> bool {
        element.iter().any(|n| usize::from(self.0[n.index()]) > depth)
    }
}
