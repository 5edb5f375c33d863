//! The trees that decide what is refined: of 8 children for Methods I and II, of 27 for 3-refinement. Levels are told by
//! number; level 0 is the input.

use super::options::HexRefineError;
use super::thirds::ThirdsForest;
use crate::forest::{Admits, CloseError, Closure, HexForest};
use crate::geometry::Point;
use crate::mesh::{HexMesh, NodeId};
use crate::{Cancelled, Monitor};

/// A tree over every hex of the input.
#[derive(Debug)]
pub(super) enum Trees {
    /// Octrees.
    Octrees(Box<HexForest>),
    /// Trees of 27 children.
    Thirds(ThirdsForest),
}

/// The elements of one level.
#[derive(Clone, Copy)]
pub(super) struct TreeLevel<'a> {
    /// The nodes of each. Those of the deepest level may not be made ([`Trees::make_last`]).
    pub(super) elements: &'a [[NodeId; 8]],
    /// Those that are refined, in the order in which they were: the children of the k-th are the k-th family of the
    /// next level.
    pub(super) refined: &'a [u32],
    /// For each: is it refined?
    pub(super) is_refined: &'a [bool],
}

impl Trees {
    /// Octrees over `input`, not refined yet.
    pub(super) fn octrees(input: &HexMesh, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        Ok(Self::Octrees(Box::new(HexForest::within(input, monitor)?)))
    }

    /// Trees of 27 children over `input`, not refined yet.
    pub(super) fn thirds(input: &HexMesh) -> Self {
        Self::Thirds(ThirdsForest::new(input))
    }

    /// How many children an element has.
    pub(super) fn children(&self) -> usize {
        match self {
            Self::Octrees(_) => 8,
            Self::Thirds(_) => 27,
        }
    }

    /// The number of levels that have elements.
    pub(super) fn depth(&self) -> usize {
        match self {
            Self::Octrees(forest) => 1 + forest.levels.iter().take_while(|level| !level.is_empty()).count(),
            Self::Thirds(forest) => forest.levels.len(),
        }
    }

    /// The elements of level `number`, which there must be.
    pub(super) fn level(&self, number: usize) -> TreeLevel<'_> {
        match self {
            Self::Octrees(forest) => {
                let level = number.checked_sub(1).map_or(&forest.base, |depth| &forest.levels[depth]);
                TreeLevel {
                    elements: &level.elements,
                    refined: &level.refined,
                    is_refined: &level.is_refined,
                }
            }
            Self::Thirds(forest) => {
                let level = &forest.levels[number];
                TreeLevel {
                    elements: &level.elements,
                    refined: &level.refined,
                    is_refined: &level.is_refined,
                }
            }
        }
    }

    /// Coordinates of the nodes of all levels.
    pub(super) fn positions(&self) -> &[Point] {
        match self {
            Self::Octrees(forest) => &forest.positions,
            Self::Thirds(forest) => &forest.positions,
        }
    }

    /// Number of elements that are not refined.
    pub(super) fn leaf_count(&self) -> usize {
        (0..self.depth()).map(|number| self.level(number)).map(|l| l.is_refined.len() - l.refined.len()).sum()
    }

    /// Refines the elements `marked` of level `number`, none of which is yet.
    pub(super) fn split(
        &mut self,
        number: usize,
        marked: &[u32],
        monitor: &dyn Monitor,
    ) -> Result<(), HexRefineError> {
        match self {
            Self::Octrees(forest) => match number.checked_sub(1) {
                None => forest.split_base(marked, monitor)?,
                Some(depth) => forest.split(depth, marked, monitor)?,
            },
            Self::Thirds(forest) => forest.split(number, marked, monitor)?,
        }
        Ok(())
    }

    /// Makes the elements of the deepest level.
    pub(super) fn make_last(&mut self, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        let depth = self.depth();
        match self {
            Self::Octrees(forest) if depth > 1 => forest.make(depth - 2, monitor),
            _ => Ok(()),
        }
    }

    /// Refines what the rules of conforming refinement ask for, besides; at most to `limit` leaves.
    pub(super) fn close(
        &mut self,
        method: Option<Admits>,
        limit: u64,
        monitor: &dyn Monitor,
    ) -> Result<Closure, HexRefineError> {
        let closed = match self {
            Self::Octrees(forest) => forest.close(method, limit, monitor),
            Self::Thirds(forest) => forest.grade(limit, monitor),
        };
        closed.map_err(|error| match error {
            CloseError::Cancelled(cancelled) => cancelled.into(),
            CloseError::TooLarge { level, leaves } => {
                HexRefineError::TooManyHexes { level, hexes: leaves, limit }
            }
        })
    }
}
