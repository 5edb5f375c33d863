//! The layer templates of Method I (Ebeida et al., figure 8), after which every transition hex has one refined
//! face, one refined edge, or neither.
//!
//! ```text
//!   A, SLAB          B, COLUMN (along z)     C, CORNER (in 3D: a box and three frusta)
//!   *-------*        *-------*
//!   |       |        | \     |               the box stands at corner 0
//!   +-------+        +--+    |
//!   |       |        |  | \  |
//!   *-------*        0--+----*
//! ```
//!
//! Which template a coarse hex takes follows from which of its nodes refined hexes have too ([`select`]).

use super::{LocalNode, Template};
use crate::mesh::numbering::hex::SYMMETRIES;

/// Template A: two slabs, one above the other along z.
pub static SLAB: Template = Template::new(
    [[0.0, 0.0, 0.5], [1.0, 0.0, 0.5], [1.0, 1.0, 0.5], [0.0, 1.0, 0.5]],
    [[0, 1, 2, 3, 8, 9, 10, 11], [8, 9, 10, 11, 4, 5, 6, 7]],
);

/// Template B: a box at the edge from corner 0 to corner 4, and two frusta.
pub static COLUMN: Template = {
    const X: [LocalNode; 2] = [8, 9];
    const Y: [LocalNode; 2] = [10, 11];
    const XY: [LocalNode; 2] = [12, 13];
    Template::new(
        [
            [0.5, 0.0, 0.0],
            [0.5, 0.0, 1.0],
            [0.0, 0.5, 0.0],
            [0.0, 0.5, 1.0],
            [0.5, 0.5, 0.0],
            [0.5, 0.5, 1.0],
        ],
        [
            [0, X[0], XY[0], Y[0], 4, X[1], XY[1], Y[1]],
            [X[0], 1, 2, XY[0], X[1], 5, 6, XY[1]],
            [Y[0], XY[0], 2, 3, Y[1], XY[1], 6, 7],
        ],
    )
};

/// Template C: a box at corner 0, and three frusta.
pub static CORNER: Template = {
    const X: LocalNode = 8;
    const Y: LocalNode = 9;
    const Z: LocalNode = 10;
    const XY: LocalNode = 11;
    const YZ: LocalNode = 12;
    const ZX: LocalNode = 13;
    const XYZ: LocalNode = 14;
    Template::new(
        [
            [0.5, 0.0, 0.0],
            [0.0, 0.5, 0.0],
            [0.0, 0.0, 0.5],
            [0.5, 0.5, 0.0],
            [0.0, 0.5, 0.5],
            [0.5, 0.0, 0.5],
            [0.5, 0.5, 0.5],
        ],
        [
            [0, X, XY, Y, Z, ZX, XYZ, YZ],
            [X, 1, 2, XY, ZX, 5, 6, XYZ],
            [Y, XY, 2, 3, YZ, XYZ, 6, 7],
            [Z, ZX, XYZ, YZ, 4, 5, 6, 7],
        ],
    )
};

/// The layer template of a coarse hex.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Selected {
    /// No node is refined: the hex stays.
    Stay,
    /// One face: [`SLAB`], by the symmetry that takes its face z = 1 to that face.
    Face(u8),
    /// One edge, or all but one (two faces): [`COLUMN`], by the symmetry that takes its box to that edge.
    Edge(u8),
    /// One node, or all but one (three faces): [`CORNER`], by the symmetry that takes its box to that node.
    Node(u8),
    /// No template fits.
    None,
}

/// The layer template of a hex by its refined nodes: bit `k` of `refined` is corner `k`.
pub fn select(refined: u8) -> Selected {
    SELECTED[usize::from(refined)]
}

static SELECTED: [Selected; 256] = {
    let mut table = [Selected::None; 256];
    table[0] = Selected::Stay;
    let mut s = 24;
    while s > 0 {
        s -= 1;
        let face = image(s, 0b1111_0000);
        let (edge, node) = (image(s, 0b0001_0001), image(s, 0b0000_0001));
        table[face as usize] = Selected::Face(s as u8);
        table[edge as usize] = Selected::Edge(s as u8);
        table[!edge as usize] = Selected::Edge(s as u8);
        table[node as usize] = Selected::Node(s as u8);
        table[!node as usize] = Selected::Node(s as u8);
    }
    table
};

/// Where a symmetry takes a set of corners.
const fn image(symmetry: usize, corners: u8) -> u8 {
    let (mut to, mut k) = (0, 0);
    while k < 8 {
        if corners >> k & 1 == 1 {
            to |= 1 << SYMMETRIES[symmetry][k];
        }
        k += 1;
    }
    to
}
