//! The regions around a node of the interface: what a pillow separates there.
//!
//! A region is a set of hexes of one side around the node that are connected by shared faces, or through a
//! pinched edge that joins their side. Each region but one gets its own copy of the node. Two regions are
//! neighbours if they share a face of the interface; the neighbourhoods form a tree for each connected part
//! of the star.

use super::interface::{Interface, Star};
use super::pinch::Pinches;
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::NEIGHBOURS;
use crate::mesh::topology::Sets;

/// The regions of a star. Its buffers serve one node after another.
#[derive(Default)]
pub(super) struct Regions {
    /// The region of each hex of the star.
    pub(super) of_hex: Vec<u32>,
    /// The regions, in the order of their first hexes.
    pub(super) all: Vec<Region>,
    /// Pairs of neighbours, the lesser first.
    pub(super) neighbours: Vec<[u32; 2]>,
    sets: Sets,
}

/// A region.
#[derive(Clone, Copy)]
pub(super) struct Region {
    /// Its side.
    pub(super) is_refined: bool,
    /// Must it keep the node, because the outside joins it?
    pub(super) is_forced: bool,
    /// How many neighbours it has.
    pub(super) degree: u32,
    /// The least region of its connected part of the star.
    pub(super) part: u32,
}

impl Regions {
    /// Takes the regions of node `place`, whose star is loaded.
    pub(super) fn load(&mut self, interface: &Interface, star: &Star, pinches: &Pinches, place: usize) {
        self.join_hexes(interface, star, pinches, place);
        self.of_hex.clear();
        self.all.clear();
        for hex in 0..star.hexes.len() {
            let root = self.sets.root(hex as u32).0 as usize;
            let region = if root == hex {
                let is_refined = star.is_refined(hex);
                self.all.push(Region { is_refined, is_forced: false, degree: 0, part: 0 });
                self.all.len() as u32 - 1
            } else {
                self.of_hex[root]
            };
            self.of_hex.push(region);
        }
        self.find_neighbours(star);
        if pinches.are_at(place) {
            for end in interface_ends(star) {
                let Some(pinch) = pinches.between(star.node, end).filter(|pinch| pinch.on_boundary) else {
                    continue;
                };
                let joined = |&hex: &usize| {
                    star.is_refined(hex) == pinch.joins_refined && has_edge(interface, star, hex, end)
                };
                if let Some(hex) = (0..star.hexes.len()).find(joined) {
                    self.all[self.of_hex[hex] as usize].is_forced = true;
                }
            }
        }
    }

    /// Unites hexes of one side across their faces and through joined edges.
    fn join_hexes(&mut self, interface: &Interface, star: &Star, pinches: &Pinches, place: usize) {
        self.sets.reset(star.hexes.len());
        for face in &star.faces {
            if let Some((second, _)) = face.second
                && star.is_refined(face.first.0) == star.is_refined(second)
            {
                self.sets.join(face.first.0 as u32, second as u32, false);
            }
        }
        if !pinches.are_at(place) {
            return;
        }
        for end in interface_ends(star) {
            if let Some(pinch) = pinches.between(star.node, end) {
                let joined = |&hex: &usize| {
                    star.is_refined(hex) == pinch.joins_refined && has_edge(interface, star, hex, end)
                };
                let mut joined = (0..star.hexes.len()).filter(joined);
                if let Some(first) = joined.next() {
                    for hex in joined {
                        self.sets.join(first as u32, hex as u32, false);
                    }
                }
            }
        }
    }

    /// Finds the pairs of neighbours, the degrees and the parts.
    fn find_neighbours(&mut self, star: &Star) {
        self.neighbours.clear();
        for face in star.faces.iter().filter(|face| star.is_interface(face)) {
            let second = face.second.expect("an interface face has two hexes").0;
            let (a, b) = (self.of_hex[face.first.0], self.of_hex[second]);
            self.neighbours.push([a.min(b), a.max(b)]);
        }
        self.neighbours.sort_unstable();
        self.neighbours.dedup();
        self.sets.reset(self.all.len());
        for &[a, b] in &self.neighbours {
            self.sets.join(a, b, false);
            self.all[a as usize].degree += 1;
            self.all[b as usize].degree += 1;
        }
        for region in 0..self.all.len() {
            self.all[region].part = self.sets.root(region as u32).0;
        }
    }

    /// Do the neighbourhoods form a tree in each part?
    pub(super) fn are_trees(&self) -> bool {
        let parts = self.all.iter().zip(0u32..).filter(|&(region, k)| region.part == k).count();
        self.neighbours.len() + parts == self.all.len()
    }

    /// How many regions must keep the node.
    pub(super) fn forced_count(&self) -> usize {
        self.all.iter().filter(|region| region.is_forced).count()
    }

    /// Do the runs of one side at the edge to `end` lie in different regions?
    pub(super) fn separates_runs(
        &mut self,
        interface: &Interface,
        star: &Star,
        end: NodeId,
        refined: bool,
    ) -> bool {
        let in_run = |hex: usize| star.is_refined(hex) == refined && has_edge(interface, star, hex, end);
        self.sets.reset(star.hexes.len());
        for face in star.faces.iter().filter(|face| face.has_edge(end)) {
            if let Some((second, _)) = face.second
                && in_run(face.first.0)
                && in_run(second)
            {
                self.sets.join(face.first.0 as u32, second as u32, false);
            }
        }
        let Self { of_hex, sets, .. } = self;
        let mut is_one_run = |a: usize, b: usize| sets.root(a as u32) == sets.root(b as u32);
        (0..star.hexes.len())
            .filter(|&a| in_run(a))
            .all(|a| (0..a).filter(|&b| in_run(b)).all(|b| of_hex[a] != of_hex[b] || is_one_run(a, b)))
    }
}

/// The other ends of the interface edges at a star's node, each once or more.
pub(super) fn interface_ends(star: &Star) -> impl Iterator<Item = NodeId> + '_ {
    star.faces.iter().filter(|face| star.is_interface(face)).flat_map(|face| [face.rest[0], face.rest[2]])
}

/// Has hex `hex` of the star the edge from its node to `end`?
pub(super) fn has_edge(interface: &Interface, star: &Star, hex: usize, end: NodeId) -> bool {
    let (id, corner, _) = star.hexes[hex];
    let nodes = &interface.hexes[id as usize];
    NEIGHBOURS[usize::from(corner)].iter().any(|&k| nodes[usize::from(k)] == end)
}
