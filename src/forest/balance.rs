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

use std::sync::atomic::{AtomicU8, Ordering::Relaxed};

use super::{Level, QuadForest};
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
        // How many elements of each level were asked since a deeper one was last split.
        let mut asked = vec![0; self.levels.len()];
        loop {
            let mut changed = false;
            for depth in (0..self.levels.len().saturating_sub(2)).rev() {
                monitor.proceed()?;
                let first = if changed { 0 } else { asked[depth] };
                let marked = self.too_coarse(depth, first, &wanted);
                asked[depth] = self.levels[depth].elements.len();
                let before = self.levels[depth].refined.len();
                self.split(depth, &marked, monitor)?;
                wanted.add(self, depth, before);
                changed |= !marked.is_empty();
            }
            if !changed {
                return Ok(());
            }
        }
    }

    /// The elements of `levels[depth]` from `first` on that touch one which is too fine for them.
    fn too_coarse(&self, depth: usize, first: usize, wanted: &Wanted) -> Vec<u32> {
        let level = &self.levels[depth];
        if level.is_full() || first == level.elements.len() {
            return Vec::new();
        }
        let is_refined = level.are_refined();
        let is_marked = |e: usize| !is_refined[e] && wanted.deeper_than(depth, &level.elements[e]);
        parallel::filter_map(level.elements.len() - first, |k| {
            let e = first + k;
            is_marked(e).then_some(e as u32)
        })
    }
}

/// For each node the depth of the deepest refined element that has it as local node 0.
#[derive(Default)]
struct Wanted(Vec<AtomicU8>);

impl Wanted {
    /// Takes in the elements of `levels[depth]` from `refined[first]` on. At the base local node 0 is no
    /// different from the others, and nothing is coarser. Neither is there where all levels above are full.
    fn add(&mut self, forest: &QuadForest, depth: usize, first: usize) {
        if forest.levels[..depth].iter().all(Level::is_full) {
            return;
        }
        let missing = forest.positions.len() - self.0.len();
        parallel::extend(&mut self.0, missing, |_| AtomicU8::new(0));
        let Level { elements, refined, .. } = &forest.levels[depth];
        let (refined, depth) = (&refined[first..], depth as u8);
        // Threads that set the same node set it to the same value.
        parallel::for_each(refined.len(), |k| {
            let wanted = &self.0[elements[refined[k] as usize][0].index()];
            if wanted.load(Relaxed) < depth {
                wanted.store(depth, Relaxed);
            }
        });
    }

    fn deeper_than(&self, depth: usize, element: &[NodeId; 4]) -> bool {
        element.iter().any(|n| self.0.get(n.index()).is_some_and(|w| usize::from(w.load(Relaxed)) > depth))
    }
}
