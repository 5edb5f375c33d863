//! Closure of a forest of octrees: what must be refined besides what was asked for, so that a conforming mesh can
//! be made.
//!
//! An element whose eight children are all refined is **doubly refined**; these elements and the others of their
//! level meet at an interface, where conforming refinement puts its transition elements. The rules:
//!
//! 1. *Families* (the paper's rule of the volume node, section 3): if a child of an element is refined, so are its
//!    seven siblings. Then every face node between two levels has four transition elements.
//! 2. *Strong balance*: every element that shares a node with a doubly refined element of its level is refined; level 0
//!    has no families, but is balanced like any other.
//! 3. *Method*: what the method admits at each corner of an element beside the interface ([`Admits`]). Where it
//!    does not, one of the elements at the corner's node becomes doubly refined: the one with the most interface
//!    faces there. (Adding the element whose corner is not admitted fills far more.)
//!
//! Rules 1 and 2 alone give the least forest that holds the given one and obeys them. All are applied from the
//! finest level to the coarsest, and again while anything changes.

use std::collections::VecDeque;
use std::ops::AddAssign;

use super::HexForest;
use super::octree::{HexLevel, Sides};
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::{EDGES_AT, FACES_AT};
use crate::mesh::topology::Bins;
use crate::{Cancelled, Monitor, parallel};

/// What a method can make conform at a corner of an element that is not doubly refined: of the three faces and the
/// three edges there, `faces` and `edges` belong to a doubly refined element.
pub type Admits = fn(faces: usize, edges: usize) -> bool;

/// Method I (section 3.1): no face and at most one edge, one face and its two edges, or two faces and more.
pub fn admits_method_one(faces: usize, edges: usize) -> bool {
    match faces {
        0 => edges <= 1,
        1 => edges == 2,
        _ => true,
    }
}

/// Why a forest was not closed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CloseError {
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// There would be more leaves than allowed.
    #[error("level {level} would bring the forest to {leaves} leaves or more")]
    TooLarge {
        /// The level that would do so.
        level: u8,
        /// How many leaves there would be, at least.
        leaves: u64,
    },
}

/// How many elements closure refined, by rule.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Closure {
    /// For their siblings.
    pub families: usize,
    /// For strong balance.
    pub balance: usize,
    /// For the method.
    pub method: usize,
}

impl AddAssign for Closure {
    fn add_assign(&mut self, more: Self) {
        self.families += more.families;
        self.balance += more.balance;
        self.method += more.method;
    }
}

/// Families that are split, or nodes that are looked at, before the monitor is asked again.
const BATCH: usize = 1 << 14;

impl HexForest {
    /// Refines elements until the forest obeys the rules of families and strong balance, and those of a method.
    ///
    /// # Errors
    /// If that makes more than `limit` leaves, or the monitor stops it.
    pub fn close(
        &mut self,
        method: Option<Admits>,
        limit: u64,
        monitor: &dyn Monitor,
    ) -> Result<Closure, CloseError> {
        let mut closing = Closing { forest: self, wanted: Wanted::default(), limit, monitor };
        closing.close(method)
    }
}

/// A forest that is being closed.
struct Closing<'a> {
    forest: &'a mut HexForest,
    wanted: Wanted,
    limit: u64,
    monitor: &'a dyn Monitor,
}

impl Closing<'_> {
    fn close(&mut self, method: Option<Admits>) -> Result<Closure, CloseError> {
        for depth in 0..self.forest.levels.len() {
            self.monitor.proceed()?;
            let families: Vec<u32> = self.forest.levels[depth].refined.iter().map(|e| e / 8).collect();
            self.wanted.add(self.forest, depth, &families);
        }
        let mut added = Closure::default();
        loop {
            let before = added;
            for depth in (0..self.forest.levels.len()).rev() {
                let (halfway, needed) = self.incomplete(depth)?;
                added.families += self.complete(depth, &halfway)?;
                added.balance += self.complete(depth, &needed)?;
                if let Some(admits) = method
                    && let Some(interface) = Interface::new(self.forest, depth)
                {
                    let filling = interface.filling(admits, self.monitor)?;
                    added.method += self.complete(depth, &filling)?;
                }
            }
            added.balance += self.balance_base()?;
            if added == before {
                return Ok(added);
            }
        }
    }

    /// Refuses the split of so many elements of a level if it makes too many leaves.
    fn check_size(&self, level: usize, elements: usize) -> Result<(), CloseError> {
        let leaves = self.forest.leaf_count() as u64 + 7 * elements as u64;
        if leaves > self.limit {
            return Err(CloseError::TooLarge { level: level as u8, leaves });
        }
        Ok(())
    }

    /// Refines the elements of level 0 that balance wants refined; returns how many.
    fn balance_base(&mut self) -> Result<usize, CloseError> {
        self.monitor.proceed()?;
        let base = &self.forest.base;
        let coarse = (0..base.len() as u32).filter(|&e| !base.is_refined[e as usize]);
        let needed: Vec<u32> = coarse.filter(|&e| self.wanted.at(0, &base.elements[e as usize])).collect();
        self.check_size(1, needed.len())?;
        self.forest.split_base(&needed, self.monitor)?;
        Ok(needed.len())
    }

    /// The families of `levels[depth]` that are refined in part, and those that are not but have an element that
    /// balance wants refined.
    fn incomplete(&self, depth: usize) -> Result<(Vec<u32>, Vec<u32>), Cancelled> {
        let level = &self.forest.levels[depth];
        let refined = |k: usize| level.family(k).iter().filter(|&&r| r).count();
        let is_needed = |k: usize| {
            let elements = &level.elements[8 * k..8 * k + 8];
            refined(k) == 0 && elements.iter().any(|e| self.wanted.at(depth + 1, e))
        };
        let families = level.len() / 8;
        let halfway = parallel::try_filter(families, self.monitor, |k| !matches!(refined(k), 0 | 8))?;
        // So the elements of the deepest level are not looked at: maybe they are not made.
        let families = if self.wanted.deepest > depth + 1 { families } else { 0 };
        Ok((halfway, parallel::try_filter(families, self.monitor, is_needed)?))
    }

    /// Refines what is not refined of families of `levels[depth]`; returns how many elements that was.
    fn complete(&mut self, depth: usize, families: &[u32]) -> Result<usize, CloseError> {
        let mut count = 0;
        for batch in families.chunks(BATCH) {
            self.monitor.proceed()?;
            let level = &self.forest.levels[depth];
            let elements = batch.iter().flat_map(|&k| 8 * k..8 * k + 8);
            let marked: Vec<u32> = elements.filter(|&e| !level.is_refined[e as usize]).collect();
            self.check_size(depth + 2, marked.len())?;
            self.forest.split(depth, &marked, self.monitor)?;
            count += marked.len();
        }
        self.monitor.proceed()?;
        self.wanted.add(self.forest, depth, families);
        Ok(count)
    }
}

/// For each node one more than the level of the deepest doubly refined element that has it; 0 if there is none.
///
/// A coarser element with such a node has it in common with an ancestor, at its own level, of the doubly refined
/// element, and that is doubly refined too. So it must be refined as well.
#[derive(Default)]
struct Wanted {
    of_node: Vec<u8>,
    /// The greatest of these.
    deepest: usize,
}

impl Wanted {
    /// Takes in the parents of `families` of `levels[depth]`, which are of level `depth`.
    fn add(&mut self, forest: &HexForest, depth: usize, families: &[u32]) {
        self.of_node.resize(forest.positions.len(), 0);
        if !families.is_empty() {
            self.deepest = self.deepest.max(depth + 1);
        }
        let parents = forest.parents(depth);
        for &k in families {
            for n in parents.elements[parents.refined[k as usize] as usize] {
                let wanted = &mut self.of_node[n.index()];
                *wanted = (*wanted).max(depth as u8 + 1);
            }
        }
    }

    /// True if an element of `level` must be refined.
    fn at(&self, level: usize, element: &[NodeId; 8]) -> bool {
        element.iter().any(|n| usize::from(self.of_node[n.index()]) > level)
    }
}

/// The interface between the doubly refined elements of a level and its other refined elements.
struct Interface<'a> {
    parents: &'a HexLevel,
    node_count: usize,
    /// For each refined element, in the order of families: is it doubly refined?
    is_doubly: Vec<bool>,
    /// For each edge and each face: has a doubly refined element it?
    edges: Vec<bool>,
    faces: Vec<bool>,
}

impl<'a> Interface<'a> {
    /// The interface of the parents of `levels[depth]`, whose families are refined as a whole or not at all; `None`
    /// if there is none.
    fn new(forest: &'a HexForest, depth: usize) -> Option<Self> {
        let (level, parents) = (&forest.levels[depth], forest.parents(depth));
        let is_doubly: Vec<bool> = level.is_refined.chunks_exact(8).map(|family| family[0]).collect();
        let count = is_doubly.iter().filter(|&&d| d).count();
        if count == 0 || count == is_doubly.len() {
            return None;
        }
        let mut interface = Self {
            parents,
            node_count: forest.positions.len(),
            edges: vec![false; parents.edges.len()],
            faces: vec![false; parents.faces.len()],
            is_doubly,
        };
        for k in 0..interface.is_doubly.len() {
            if interface.is_doubly[k] {
                interface.touch(k);
            }
        }
        Some(interface)
    }

    fn nodes(&self, k: usize) -> &'a [NodeId; 8] {
        &self.parents.elements[self.parents.refined[k] as usize]
    }

    fn sides(&self, k: usize) -> &'a Sides {
        &self.parents.sides[self.parents.refined[k] as usize]
    }

    /// Notes the edges and faces of a doubly refined element.
    fn touch(&mut self, k: usize) {
        let Sides { edges, faces } = self.sides(k);
        edges.iter().for_each(|e| self.edges[e.index()] = true);
        faces.iter().for_each(|f| self.faces[f.index()] = true);
    }

    /// How many of the faces and of the edges at a corner of element `k` belong to doubly refined elements.
    fn at_corner(&self, k: usize, corner: usize) -> (usize, usize) {
        let Sides { edges, faces } = self.sides(k);
        let on = |flags: &[bool], at: [usize; 3]| at.iter().filter(|&&i| flags[i]).count();
        let faces_here = FACES_AT[corner].map(|(f, _)| faces[usize::from(f)].index());
        let edges_here = EDGES_AT[corner].map(|e| edges[usize::from(e)].index());
        (on(&self.faces, faces_here), on(&self.edges, edges_here))
    }

    /// The elements that must become doubly refined so that `admits` holds everywhere, in the order of the rule's
    /// steps: from the least node on, and around each element that was added.
    fn filling(mut self, admits: Admits, monitor: &dyn Monitor) -> Result<Vec<u32>, Cancelled> {
        monitor.proceed()?;
        let this = &self;
        let is_violated = |k: usize, corner: usize| {
            let (faces, edges) = this.at_corner(k, corner);
            !this.is_doubly[k] && !admits(faces, edges)
        };
        let mut queue: Vec<NodeId> = parallel::gather(self.is_doubly.len(), |k, found| {
            found.extend((0..8).filter(|&c| is_violated(k, c)).map(|c| this.nodes(k)[c]));
        });
        if queue.is_empty() {
            return Ok(Vec::new());
        }
        monitor.proceed()?;
        parallel::sort(&mut queue);
        queue.dedup();
        let corner = |place: usize| self.nodes(place / 8)[place % 8].index();
        let stars = Bins::of(self.node_count, 8 * self.is_doubly.len(), corner);
        let mut is_queued = vec![false; self.node_count];
        queue.iter().for_each(|n| is_queued[n.index()] = true);
        let mut queue = VecDeque::from(queue);
        let mut filling = Vec::new();
        let mut steps = 0usize;
        while let Some(node) = queue.pop_front() {
            steps += 1;
            if steps.is_multiple_of(BATCH) {
                monitor.proceed()?;
            }
            is_queued[node.index()] = false;
            while let Some(k) = self.filler(stars.at(node.index()), admits) {
                self.is_doubly[k] = true;
                self.touch(k);
                filling.push(k as u32);
                for &n in self.nodes(k) {
                    if !std::mem::replace(&mut is_queued[n.index()], true) {
                        queue.push_back(n);
                    }
                }
            }
        }
        Ok(filling)
    }

    /// Of the corners at a node, if one is not admitted: the element with the most interface faces there, then the
    /// most edges, then the first.
    fn filler(&self, star: &[u32], admits: Admits) -> Option<usize> {
        let open = star.iter().map(|&place| (place as usize / 8, place as usize % 8));
        let (mut best, mut is_violated) = (None, false);
        for (k, corner) in open.filter(|&(k, _)| !self.is_doubly[k]) {
            let (faces, edges) = self.at_corner(k, corner);
            is_violated |= !admits(faces, edges);
            if best.is_none_or(|(most, _)| (faces, edges) > most) {
                best = Some(((faces, edges), k));
            }
        }
        best.filter(|_| is_violated).map(|(_, k)| k)
    }
}

#[cfg(test)]
mod tests;
