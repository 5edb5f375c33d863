//! The templates of a hex: what a hex becomes when some of its edges, faces and its inside are divided.
//!
//! A template is written as a picture on the reference hex: where its nodes are, and which of them each
//! cell has. What a node divides follows from where it is: a node on an edge divides that edge, one on a
//! face that face, one within the hex the hex. **That is its key**: two hexes that divide the same edge or
//! face share its nodes by identity. Where an edge or face has several nodes, each belongs to its nearest
//! corner (its *anchor*), and they are told apart by the order of their anchors' ids, in which all hexes
//! at that edge or face agree.
//!
//! Templates are stored in one orientation; the other 47 come from the symmetries of the reference hex.
//!
//! | template | cells | nodes | source |
//! |---|---|---|---|
//! | [`SPLIT`] | 8 | 27 | Ebeida et al., section 3 |
//! | [`QUARTER`] | 7 | 23 | Ebeida et al., figure 7a |
//! | [`SLAB`], [`COLUMN`], [`CORNER`] | 2, 3, 4 | 12, 14, 15 | Ebeida et al., figure 8: templates A, B, C |
//! | [`THIRDS`] | 27 | 64 | Schneiders 1996 |
//! | [`THIRTEEN`] | 13 | 32 | section 4.3 of the paper on non-regular background meshes |

mod faces;
mod layer;
mod quarter;
mod regular;
#[cfg(test)]
mod tests;
mod thirteen;

pub use layer::{COLUMN, CORNER, SLAB, Selected, select};
pub use quarter::QUARTER;
pub use regular::{SPLIT, THIRDS};
pub use thirteen::THIRTEEN;

use crate::geometry::Point;
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::{CORNER_AT, CORNERS, EDGES, FACES, SYMMETRIES};
use faces::FacesOn;

/// A node of a template by its local number. The corners come first, numbered as in `mesh::numbering`.
pub type LocalNode = u8;

/// The most nodes that a template has.
pub const MOST_NODES: usize = 64;
/// The most cells that a template has.
pub const MOST_CELLS: usize = 27;

/// Edges and faces of a hex by one number: edge `k` is side `k`, face `k` is side `12 + k`.
pub const SIDES: usize = 18;
/// The number of the hex's inside, after its sides.
pub const INSIDE: u8 = SIDES as u8;

/// A side that a template divides, or the inside, with the template's nodes there.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// The edge (0..12) or face (12..18) that is divided, or [`INSIDE`].
    pub side: u8,
    /// How many nodes divide it.
    pub count: u8,
    nodes: [LocalNode; 8],
    anchors: [u8; 8],
}

/// A refinement template.
#[derive(Debug)]
pub struct Template {
    at: [[f64; 3]; MOST_NODES],
    node_count: usize,
    cells: [[LocalNode; 8]; MOST_CELLS],
    cell_count: usize,
    parts: [Part; SIDES + 1],
    part_count: usize,
    faces_on: [FacesOn; 6],
}

/// The corner numbers of a cell seen in a mirror across x.
const MIRRORED: [usize; 8] = [1, 0, 3, 2, 5, 4, 7, 6];

impl Template {
    /// The template with the nodes `at` after the eight corners, and the given cells.
    const fn new<const N: usize, const C: usize>(at: [[f64; 3]; N], cells: [[LocalNode; 8]; C]) -> Self {
        let mut template = Self {
            at: [[0.0; 3]; MOST_NODES],
            node_count: 8 + N,
            cells: [[0; 8]; MOST_CELLS],
            cell_count: C,
            parts: [Part { side: 0, count: 0, nodes: [0; 8], anchors: [0; 8] }; SIDES + 1],
            part_count: 0,
            faces_on: FacesOn::of(&at, &cells, 0),
        };
        let mut k = 0;
        while k < 8 {
            template.at[k] = [CORNERS[k][0] as f64, CORNERS[k][1] as f64, CORNERS[k][2] as f64];
            k += 1;
        }
        while k < 8 + N {
            template.at[k] = at[k - 8];
            k += 1;
        }
        let mut c = 0;
        while c < C {
            template.cells[c] = cells[c];
            c += 1;
        }
        template.faces_on = FacesOn::of(&template.at, &template.cells, C);
        let mut side = 0;
        while side <= INSIDE {
            let part = template.part(side);
            if part.count > 0 {
                template.parts[template.part_count] = part;
                template.part_count += 1;
            }
            side += 1;
        }
        template
    }

    /// The nodes that lie in a side.
    const fn part(&self, side: u8) -> Part {
        let mut part = Part { side, count: 0, nodes: [0; 8], anchors: [0; 8] };
        let mut node = 8;
        while node < self.node_count {
            if lies_in(self.at[node], side) {
                part.nodes[part.count as usize] = node as LocalNode;
                part.anchors[part.count as usize] = nearest_corner(self.at[node]);
                part.count += 1;
            }
            node += 1;
        }
        part
    }

    /// How many nodes the template has, its corners among them.
    pub const fn node_count(&self) -> usize {
        self.node_count
    }

    /// How many nodes are not corners.
    pub const fn new_node_count(&self) -> usize {
        self.node_count - 8
    }

    /// How many cells the hex becomes.
    pub const fn cell_count(&self) -> usize {
        self.cell_count
    }

    /// The cells, each by its local nodes in the order of VTK_HEXAHEDRON.
    pub fn cells(&self) -> &[[LocalNode; 8]] {
        &self.cells[..self.cell_count]
    }

    /// The sides that the template divides, and the inside if it does so too.
    pub fn parts(&self) -> &[Part] {
        &self.parts[..self.part_count]
    }

    /// Where each node is on the reference hex.
    pub fn at(&self) -> &[[f64; 3]] {
        &self.at[..self.node_count]
    }

    /// Numbers the local nodes of the hex `frame` (see [`in_frame`]): its corners are its own, and
    /// `first(k)` is the least id of the nodes that divide `parts()[k]`.
    pub fn number(&self, frame: &[NodeId; 8], first: impl Fn(usize) -> NodeId) -> [NodeId; MOST_NODES] {
        let mut numbers = [NodeId(0); MOST_NODES];
        numbers[..8].copy_from_slice(frame);
        for (k, part) in self.parts().iter().enumerate() {
            let first = first(k);
            for (node, rank) in part.ranked(frame) {
                numbers[usize::from(node)] = NodeId(first.0 + rank);
            }
        }
        numbers
    }

    /// The cells over numbered nodes, the hex having been placed by `symmetry`: mirrored cells are walked
    /// the other way, so that their volume stays positive.
    pub fn place<'a>(
        &'a self,
        numbers: &'a [NodeId; MOST_NODES],
        symmetry: u8,
    ) -> impl Iterator<Item = [NodeId; 8]> + 'a {
        let mirrored = is_mirror(symmetry);
        self.cells().iter().map(move |cell| {
            let nodes = cell.map(|local| numbers[usize::from(local)]);
            if mirrored { MIRRORED.map(|k| nodes[k]) } else { nodes }
        })
    }

    /// The point of node `local`, in a hex with the given corners, by trilinear interpolation.
    pub fn point(&self, local: LocalNode, corners: &[Point; 8]) -> Point {
        let [x, y, z] = self.at[usize::from(local)];
        let between = |a: Point, b: Point, t: f64| a * (1.0 - t) + b * t;
        let along_x = |a: usize, b: usize| between(corners[a], corners[b], x);
        between(between(along_x(0, 1), along_x(3, 2), y), between(along_x(4, 5), along_x(7, 6), y), z)
    }
}

impl Part {
    /// The part's nodes with their rank in the order of their anchors' ids in `frame`.
    pub fn ranked<'a>(&'a self, frame: &'a [NodeId; 8]) -> impl Iterator<Item = (LocalNode, u32)> + 'a {
        let count = usize::from(self.count);
        (0..count).map(move |i| {
            let id = |k: usize| frame[usize::from(self.anchors[k])];
            let rank = if count == 1 { 0 } else { (0..count).filter(|&k| id(k) < id(i)).count() };
            (self.nodes[i], rank as u32)
        })
    }
}

/// The hex as its template sees it: corner `k` of the template stands at corner `SYMMETRIES[symmetry][k]`.
pub fn in_frame<T: Copy>(hex: &[T; 8], symmetry: u8) -> [T; 8] {
    SYMMETRIES[usize::from(symmetry)].map(|corner| hex[usize::from(corner)])
}

/// True if the symmetry mirrors.
pub fn is_mirror(symmetry: u8) -> bool {
    symmetry >= 24
}

/// The symmetry that takes corners 0, 1 and 4 to the given ones, which must be a corner and two of its
/// neighbours.
pub fn symmetry_to(zero: u8, one: u8, four: u8) -> Option<u8> {
    (0u8..48).find(|&s| {
        let images = &SYMMETRIES[usize::from(s)];
        [images[0], images[1], images[4]] == [zero, one, four]
    })
}

/// The corners of a side, the last ones repeated for an edge; all corners for the inside.
const fn corners_of(side: u8) -> [u8; 8] {
    let mut corners = [0, 1, 2, 3, 4, 5, 6, 7];
    let mut k = 0;
    while k < 8 && side < INSIDE {
        corners[k] = if side < 12 { EDGES[side as usize][k % 2] } else { FACES[side as usize - 12][k % 4] };
        k += 1;
    }
    corners
}

/// True if a point lies inside a side: on the coordinates that the side's corners share, and strictly
/// between 0 and 1 on the others.
const fn lies_in(at: [f64; 3], side: u8) -> bool {
    let corners = corners_of(side);
    let mut axis = 0;
    while axis < 3 {
        let shared = CORNERS[corners[0] as usize][axis];
        let (mut same, mut k) = (true, 1);
        while k < 8 {
            same = same && CORNERS[corners[k] as usize][axis] == shared;
            k += 1;
        }
        let here = if same { at[axis] == shared as f64 } else { at[axis] > 0.0 && at[axis] < 1.0 };
        if !here {
            return false;
        }
        axis += 1;
    }
    true
}

/// The corner nearest to a point of the reference hex; of two the one further from corner 0.
const fn nearest_corner(at: [f64; 3]) -> u8 {
    let (mut bits, mut axis) = (0, 0);
    while axis < 3 {
        bits |= ((at[axis] >= 0.5) as usize) << axis;
        axis += 1;
    }
    CORNER_AT[bits]
}
