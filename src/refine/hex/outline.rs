//! Trees without their elements: which are refined, and nothing else. Four bytes for each refined element, where trees
//! need hundreds for each.

use super::options::HexRefineError;
use super::trees::Trees;
use crate::Monitor;
use crate::mesh::HexMesh;

/// What the trees over a mesh refine.
#[derive(Debug)]
pub(super) struct Outline {
    /// How many children an element has: 8 or 27.
    pub(super) children: usize,
    /// The refined elements of each level, from level 0 on, in the order in which they were refined: the children of
    /// the k-th are the k-th family of the next level.
    pub(super) refined: Vec<Vec<u32>>,
}

impl Outline {
    /// The outline of some trees.
    pub(super) fn of(trees: &Trees) -> Self {
        let levels = (0..trees.depth()).map(|number| trees.level(number));
        let refined = levels.map(|level| level.refined.to_vec()).take_while(|refined| !refined.is_empty());
        Self { children: trees.children(), refined: refined.collect() }
    }

    /// The trees, over the same input. Their elements have the same numbers; their nodes may have others.
    pub(super) fn trees(&self, input: &HexMesh, monitor: &dyn Monitor) -> Result<Trees, HexRefineError> {
        let mut trees =
            if self.children == 8 { Trees::octrees(input, monitor)? } else { Trees::thirds(input) };
        for (number, refined) in self.refined.iter().enumerate() {
            trees.split(number, refined, monitor)?;
        }
        Ok(trees)
    }

    /// How many elements are not refined, over an input of so many hexes.
    pub(super) fn leaf_count(&self, hexes: usize) -> usize {
        hexes + (self.children - 1) * self.refined.iter().map(Vec::len).sum::<usize>()
    }

    /// For each element of level `number`, over an input of so many hexes: is it refined?
    pub(super) fn is_refined(&self, number: usize, hexes: usize) -> Vec<bool> {
        let elements = number.checked_sub(1).map_or(hexes, |above| self.children * self.refined[above].len());
        let mut is_refined = vec![false; elements];
        self.refined[number].iter().for_each(|&e| is_refined[e as usize] = true);
        is_refined
    }
}
