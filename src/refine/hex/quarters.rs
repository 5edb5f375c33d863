//! Turns transition hexes with one refined face into quarters of the composite template.

use super::divide::Divided;
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::NEIGHBOURS;
use crate::template::hex::{QUARTER, symmetry_to};

/// A transition hex with one refined face, by the corners of that face: at a corner of the parent, at its two edge
/// nodes, and at its face node.
#[derive(Clone, Copy)]
pub(super) struct Quarter {
    pub(super) hex: [NodeId; 8],
    pub(super) k: u8,
    pub(super) e: [u8; 2],
    pub(super) f: u8,
}

impl Quarter {
    /// The quarter on the face with the given corners in order around it, `middle` being the place of `f` there.
    pub(super) fn on_face(hex: [NodeId; 8], face: [u8; 4], middle: u8) -> Self {
        let corner = |turn: u8| face[usize::from((middle + turn) % 4)];
        Self { hex, k: corner(2), e: [corner(1), corner(3)], f: corner(0) }
    }

    /// The edge nodes.
    fn ends(&self) -> [NodeId; 2] {
        self.e.map(|e| self.hex[usize::from(e)])
    }

    /// The coarse corner below a refined one.
    fn below(&self, corner: u8) -> u8 {
        let in_face = |other: u8| [self.k, self.e[0], self.e[1], self.f].contains(&other);
        let mut others = NEIGHBOURS[usize::from(corner)].into_iter().filter(|&other| !in_face(other));
        others.next().expect("a corner of a face has one neighbour outside it")
    }

    /// The quarter with its edge node `e[ex]` as the template's `ex`.
    fn placed(&self, ex: usize) -> Divided {
        let symmetry = symmetry_to(self.below(self.k), self.below(self.e[ex]), self.k);
        Divided { hex: self.hex, template: &QUARTER, symmetry: symmetry.expect("two edges at a corner") }
    }
}

/// Places the quarters. Around each face node they agree on the two opposite edge nodes that are `ex`: the one
/// with the least id, and the one across. None if some face node has not four quarters around it.
pub(super) fn place_quarters(quarters: &[Quarter]) -> Option<Vec<Divided>> {
    let mut by_face_node: Vec<(NodeId, u32)> =
        quarters.iter().zip(0u32..).map(|(quarter, k)| (quarter.hex[usize::from(quarter.f)], k)).collect();
    by_face_node.sort_unstable();
    let mut ex = vec![0u8; quarters.len()];
    for group in by_face_node.chunk_by(|a, b| a.0 == b.0) {
        let group: [usize; 4] = <[_; 4]>::try_from(group).ok()?.map(|(_, k): (NodeId, u32)| k as usize);
        for (k, side) in group.into_iter().zip(opposite_sides(group.map(|k| quarters[k].ends()))?) {
            ex[k] = side;
        }
    }
    Some(quarters.iter().zip(ex).map(|(quarter, ex)| quarter.placed(usize::from(ex))).collect())
}

/// Which end of each of four quarters belongs to the opposite pair with the least id; none if the ends are not
/// those of four quarters around a node.
fn opposite_sides(ends: [[NodeId; 2]; 4]) -> Option<[u8; 4]> {
    let least = *ends.as_flattened().iter().min()?;
    let beside =
        |end: NodeId| end != least && ends.iter().any(|pair| pair.contains(&least) && pair.contains(&end));
    let mut sides = [0; 4];
    for (side, [a, b]) in sides.iter_mut().zip(ends) {
        *side = match (beside(a), beside(b)) {
            (false, true) => 0,
            (true, false) => 1,
            _ => return None,
        };
    }
    let with_least = ends.iter().filter(|pair| pair.contains(&least)).count();
    (with_least == 2).then_some(sides)
}
