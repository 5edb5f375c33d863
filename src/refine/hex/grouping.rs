//! Blocks of two by two by two hexes in a mesh without families. Where the interface of a refined set cannot be grouped two
//! by two, whole blocks are refined instead: each around a node with eight hexes and six edges, next to each other in
//! lattices, so that they have whole faces in common.

use crate::mesh::numbering::hex::{FACES, NEIGHBOURS};
use crate::mesh::topology::{Bins, HexFaces, Side, hex_of, side_nodes};
use crate::mesh::{FaceId, NodeId};
use crate::monitor::batches;
use crate::{Cancelled, Monitor, parallel};

/// The hexes of a mesh, with what walking from block to block takes.
pub(super) struct Grouping<'a> {
    hexes: &'a [[NodeId; 8]],
    /// The faces of each hex, and the sides of each face.
    faces: Vec<[FaceId; 6]>,
    sides: Bins,
    /// The uses of each node: eight times a hex, and the corner there.
    uses: Bins,
    /// Has the node eight hexes, and four at each of its edges?
    is_regular: Vec<bool>,
}

/// The node in the middle of a block.
type Middle = NodeId;

/// One way to lay blocks over a part of the refined set.
struct Lattice {
    /// The middles of the blocks that have refined hexes.
    middles: Vec<Middle>,
    /// Refined hexes that no block can have, and hexes that are not refined in blocks that are.
    cost: [usize; 2],
}

impl<'a> Grouping<'a> {
    /// Looks at the hexes of a mesh of so many nodes.
    ///
    /// # Errors
    /// If the monitor stops it.
    pub(super) fn of(
        node_count: usize,
        hexes: &'a [[NodeId; 8]],
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let (_, faces, sides) = HexFaces::within(node_count, hexes, monitor)?.into_parts();
        let node = |k: usize| hexes[k / 8][k % 8].index();
        let uses = Bins::monitored(node_count, 8 * hexes.len(), node, monitor)?;
        let is_regular = parallel::try_collect(node_count, monitor, |node| is_regular(hexes, uses.at(node)))?;
        Ok(Self { hexes, faces, sides, uses, is_regular })
    }

    /// The block of each hex: blocks have the `wanted` ones of the refined hexes, as far as these can be in any, with few
    /// others. Hexes that are in none are blocks of their own.
    ///
    /// # Errors
    /// If the monitor stops it.
    pub(super) fn blocks(
        &self,
        refined: &[bool],
        wanted: &[u32],
        monitor: &dyn Monitor,
    ) -> Result<Vec<u32>, Cancelled> {
        let count = self.hexes.len();
        let mut block: Vec<u32> = (0..count as u32).collect();
        let (mut is_taken, mut is_seen) = (vec![false; count], vec![false; count]);
        for batch in batches(wanted.len(), monitor) {
            for hex in batch?.map(|k| wanted[k] as usize) {
                if is_taken[hex] {
                    continue;
                }
                let mut best: Option<Lattice> = None;
                for middle in self.hexes[hex] {
                    monitor.proceed()?;
                    let Some(lattice) = self.lattice(middle, refined, &is_taken, &mut is_seen) else {
                        continue;
                    };
                    if best.as_ref().is_none_or(|best| lattice.cost < best.cost) {
                        best = Some(lattice);
                    }
                }
                for middle in best.into_iter().flat_map(|lattice| lattice.middles) {
                    let number = self.uses.at(middle.index())[0] / 8;
                    for (hex, _) in self.hexes_at(middle) {
                        (block[hex], is_taken[hex]) = (number, true);
                    }
                }
            }
        }
        Ok(block)
    }

    /// Is each hex in one piece with one of these, from node to node?
    ///
    /// # Errors
    /// If the monitor stops it.
    pub(super) fn bodies_of(&self, hexes: &[u32], monitor: &dyn Monitor) -> Result<Vec<bool>, Cancelled> {
        let mut is_in = vec![false; self.hexes.len()];
        let mut queue: Vec<usize> = hexes.iter().map(|&hex| hex as usize).collect();
        queue.iter().for_each(|&hex| is_in[hex] = true);
        while let Some(hex) = queue.pop() {
            monitor.proceed()?;
            for (other, _) in self.hexes[hex].into_iter().flat_map(|node| self.hexes_at(node)) {
                if !std::mem::replace(&mut is_in[other], true) {
                    queue.push(other);
                }
            }
        }
        Ok(is_in)
    }

    /// The hexes at a node, and its corners there.
    fn hexes_at(&self, node: NodeId) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.uses.at(node.index()).iter().map(|&k| (k as usize / 8, k as usize % 8))
    }

    /// Can a node be the middle of a block, of hexes that are in none?
    fn is_middle(&self, node: NodeId, is_taken: &[bool]) -> bool {
        self.is_regular[node.index()] && self.hexes_at(node).all(|(hex, _)| !is_taken[hex])
    }

    /// The lattice of blocks from the one around `middle`, as far as there are refined hexes in it or one block from it.
    /// `is_seen` is false for all hexes, before and after.
    fn lattice(
        &self,
        middle: Middle,
        refined: &[bool],
        is_taken: &[bool],
        is_seen: &mut [bool],
    ) -> Option<Lattice> {
        if !self.is_middle(middle, is_taken) {
            return None;
        }
        let (mut queue, mut next) = (vec![middle], 0);
        let mut lattice = Lattice { middles: Vec::new(), cost: [0; 2] };
        self.hexes_at(middle).for_each(|(hex, _)| is_seen[hex] = true);
        while let Some(&middle) = queue.get(next) {
            next += 1;
            let missing = self.hexes_at(middle).filter(|&(hex, _)| !refined[hex]).count();
            if missing == 8 {
                continue;
            }
            lattice.middles.push(middle);
            lattice.cost[1] += missing;
            for (beyond, there) in self.hexes_at(middle).flat_map(|(hex, corner)| self.beyond(hex, corner)) {
                if is_seen[beyond] || is_taken[beyond] {
                    continue;
                }
                let is_free = |(hex, _): (usize, usize)| !is_seen[hex];
                if self.is_middle(there, is_taken) && self.hexes_at(there).all(is_free) {
                    self.hexes_at(there).for_each(|(hex, _)| is_seen[hex] = true);
                    queue.push(there);
                } else if refined[beyond] {
                    lattice.cost[0] += 1;
                }
            }
        }
        queue.iter().flat_map(|&middle| self.hexes_at(middle)).for_each(|(hex, _)| is_seen[hex] = false);
        Some(lattice)
    }

    /// The hexes across the three faces of a hex that are not at a corner of it, and the nodes of each that are as far
    /// beyond the face as the corner is before it.
    fn beyond(&self, hex: usize, corner: usize) -> impl Iterator<Item = (usize, NodeId)> + '_ {
        NEIGHBOURS[corner].into_iter().filter_map(move |k| {
            let has_k_alone = |face: &[u8; 4]| face.contains(&k) && !face.contains(&(corner as u8));
            let across =
                FACES.iter().position(has_k_alone).expect("each corner has a face away from each other");
            let sides = self.sides.at(self.faces[hex][across].index());
            let other = |&&side: &&Side| hex_of(side).index() != hex;
            let beyond = hex_of(*sides.iter().find(other)?).index();
            let nodes = &self.hexes[beyond];
            let entered = nodes.iter().position(|&n| n == self.hexes[hex][usize::from(k)])?;
            let ends = NEIGHBOURS[entered].map(|k| nodes[usize::from(k)]);
            let between = side_nodes(self.hexes, sides[0]);
            Some((beyond, ends.into_iter().find(|end| !between.contains(end))?))
        })
    }
}

/// Has a node with these uses eight hexes, and four at each of its edges?
fn is_regular(hexes: &[[NodeId; 8]], uses: &[u32]) -> bool {
    let Ok(uses) = <[u32; 8]>::try_from(uses) else { return false };
    let mut ends = uses.map(|place| {
        let (hex, corner) = (place as usize / 8, place as usize % 8);
        NEIGHBOURS[corner].map(|k| hexes[hex][usize::from(k)])
    });
    let ends = ends.as_flattened_mut();
    ends.sort_unstable();
    ends.chunk_by(|a, b| a == b).all(|same| same.len() == 4)
}
