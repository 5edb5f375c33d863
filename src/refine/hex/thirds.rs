//! Trees of 27 children, for 3-refinement of any set of hexes.
//!
//! Children and the nodes that they share are made by the template of 27 (`divide`), a level at a time. A level is
//! made anew when elements of the one before are refined too; its elements keep their numbers, since families are
//! numbered in the order in which elements were refined.

use super::divide::{Divided, divide};
use crate::forest::{CloseError, Closure};
use crate::geometry::Point;
use crate::mesh::{HexMesh, NodeId};
use crate::monitor::batches;
use crate::template::hex::THIRDS;
use crate::{Cancelled, Monitor};

/// Hexes that a hex becomes.
const CHILDREN: usize = 27;

/// Trees of 27 children over every hex of the input.
#[derive(Debug)]
pub(super) struct ThirdsForest {
    /// Coordinates of all nodes, level by level.
    pub(super) positions: Vec<Point>,
    /// The levels, from the input's hexes on; the last has no refined elements.
    pub(super) levels: Vec<ThirdsLevel>,
}

/// The elements of one level.
#[derive(Debug, Default)]
pub(super) struct ThirdsLevel {
    pub(super) elements: Vec<[NodeId; 8]>,
    /// Those that are refined; the k-th has the elements `27k..27k + 27` of the next level as its children.
    pub(super) refined: Vec<u32>,
    pub(super) is_refined: Vec<bool>,
    /// The number of nodes of this level and those before.
    node_count: usize,
}

impl ThirdsForest {
    /// The hexes of `input`, none of which is refined.
    pub(super) fn new(input: &HexMesh) -> Self {
        let base = ThirdsLevel {
            elements: input.hexes.clone(),
            refined: Vec::new(),
            is_refined: vec![false; input.hexes.len()],
            node_count: input.positions.len(),
        };
        Self { positions: input.positions.clone(), levels: vec![base] }
    }

    /// Refines the elements `marked` of level `number`, none of which is yet.
    pub(super) fn split(
        &mut self,
        number: usize,
        marked: &[u32],
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        if marked.is_empty() {
            return Ok(());
        }
        self.mark(number, marked);
        self.make_after(number, monitor)
    }

    /// Notes that elements are refined; the levels after theirs are to be made anew.
    fn mark(&mut self, number: usize, marked: &[u32]) {
        let level = &mut self.levels[number];
        marked.iter().for_each(|&e| level.is_refined[e as usize] = true);
        level.refined.extend_from_slice(marked);
    }

    /// Makes the levels after level `number`.
    fn make_after(&mut self, number: usize, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        self.positions.truncate(self.levels[number].node_count);
        for parent in number.. {
            let level = &self.levels[parent];
            if level.refined.is_empty() {
                return Ok(());
            }
            let divided =
                |&e: &u32| Divided { hex: level.elements[e as usize], template: &THIRDS, symmetry: 0 };
            let divided: Vec<Divided> = level.refined.iter().map(divided).collect();
            let mut elements = Vec::new();
            divide(&mut self.positions, &mut elements, &divided, monitor)?;
            if parent + 1 == self.levels.len() {
                self.levels.push(ThirdsLevel::default());
            }
            let child = &mut self.levels[parent + 1];
            child.is_refined.resize(elements.len(), false);
            child.elements = elements;
            child.node_count = self.positions.len();
        }
        Ok(())
    }

    /// Grades the levels: where a child of an element is refined, so is every element of that level that shares a node
    /// with it. Then transition hexes stand beside hexes of their own level alone. The least trees that hold these
    /// and obey the rule.
    pub(super) fn grade(&mut self, limit: u64, monitor: &dyn Monitor) -> Result<Closure, CloseError> {
        let mut added = Closure::default();
        loop {
            let mut coarsest = None;
            for number in (0..self.levels.len().saturating_sub(2)).rev() {
                let more = self.ungraded(number, monitor)?;
                if more.is_empty() {
                    continue;
                }
                let leaves = self.leaf_count() + ((CHILDREN - 1) * more.len()) as u64;
                if leaves > limit {
                    return Err(CloseError::TooLarge { level: number as u8 + 1, leaves });
                }
                self.mark(number, &more);
                added.balance += more.len();
                coarsest = Some(number);
            }
            match coarsest {
                Some(number) => self.make_after(number, monitor)?,
                None => return Ok(added),
            }
        }
    }

    /// The elements of level `number` that are to be refined for what is refined of the next, ascending.
    fn ungraded(&self, number: usize, monitor: &dyn Monitor) -> Result<Vec<u32>, Cancelled> {
        let (level, next) = (&self.levels[number], &self.levels[number + 1]);
        let mut is_near = vec![false; level.node_count];
        for batch in batches(next.refined.len(), monitor) {
            for &child in &next.refined[batch?] {
                // Elements that wait to be made have no children.
                let parent = level.refined[child as usize / CHILDREN];
                level.elements[parent as usize].iter().for_each(|n| is_near[n.index()] = true);
            }
        }
        let mut more = Vec::new();
        for batch in batches(level.elements.len(), monitor) {
            let wanted =
                |e: &usize| !level.is_refined[*e] && level.elements[*e].iter().any(|n| is_near[n.index()]);
            more.extend(batch?.filter(wanted).map(|e| e as u32));
        }
        Ok(more)
    }

    fn leaf_count(&self) -> u64 {
        // Children of elements that wait to be made count as well.
        let refined: usize = self.levels.iter().map(|level| level.refined.len()).sum();
        (self.levels[0].elements.len() + (CHILDREN - 1) * refined) as u64
    }
}
