//! The 3-refinement transition between a face that stays and one that becomes nine.
//!
//! ```text
//!   refined face, z = 1          every side
//!   t03--t13--t23--t33           t00--t10--t20--t30
//!    |    |    |    |             |    |    |    |
//!   t02--t12--t22--t32            |   l10--l20   |
//!    |    |    |    |             |  /        \  |
//!   t01--t11--t21--t31           l00------------l30
//!    |    |    |    |
//!   t00--t10--t20--t30           l00, l30, l33, l03 are the corners of the face that stays
//! ```
//!
//! Nine cells stand between the sheet `l` and the refined face, four below the sheet. All sides show the same
//! four quads, so neighbours need agree on nothing.

use super::{LocalNode, Template};

/// Where the sheet meets the sides.
const LOW: f64 = 0.4;
/// How high the sheet's middle stands.
const HIGH: f64 = 0.75;

/// The 13-hex transition: z = 0 is the face that stays, z = 1 the face that is refined.
pub static THIRTEEN: Template = {
    let mut at = [[0.0; 3]; 24];
    let (mut j, mut count) = (0, 0);
    while j < 4 {
        let mut i = 0;
        while i < 4 {
            let (side_i, side_j) = (i == 0 || i == 3, j == 0 || j == 3);
            let (x, y) = (i as f64 / 3.0, j as f64 / 3.0);
            if !(side_i && side_j) {
                at[count] = [x, y, if side_i || side_j { LOW } else { HIGH }];
                at[count + 12] = [x, y, 1.0];
                count += 1;
            }
            i += 1;
        }
        j += 1;
    }
    Template::new(at, cells())
};

/// The local number of `l_ij` (`top` 0) or `t_ij` (`top` 1).
const fn node(i: usize, j: usize, top: usize) -> LocalNode {
    const CORNER: LocalNode = 0;
    const FREE: [[LocalNode; 4]; 4] =
        [[CORNER, 8, 9, CORNER + 1], [10, 11, 12, 13], [14, 15, 16, 17], [CORNER + 3, 18, 19, CORNER + 2]];
    let number = FREE[j][i];
    if number < 8 { number + 4 * top as LocalNode } else { number + 12 * top as LocalNode }
}

const fn cells() -> [[LocalNode; 8]; 13] {
    let mut cells = [[0; 8]; 13];
    let mut k = 0;
    while k < 9 {
        let (i, j) = (k % 3, k / 3);
        let mut top = 0;
        while top < 2 {
            cells[k][4 * top] = node(i, j, top);
            cells[k][4 * top + 1] = node(i + 1, j, top);
            cells[k][4 * top + 2] = node(i + 1, j + 1, top);
            cells[k][4 * top + 3] = node(i, j + 1, top);
            top += 1;
        }
        k += 1;
    }
    cells[9] = below([[0, 0], [3, 0], [3, 3], [0, 3], [0, 1], [3, 1], [3, 2], [0, 2]]);
    cells[10] = below([[0, 1], [3, 1], [3, 2], [0, 2], [1, 1], [2, 1], [2, 2], [1, 2]]);
    cells[11] = below([[0, 0], [3, 0], [3, 1], [0, 1], [1, 0], [2, 0], [2, 1], [1, 1]]);
    cells[12] = below([[0, 2], [3, 2], [3, 3], [0, 3], [1, 2], [2, 2], [2, 3], [1, 3]]);
    cells
}

/// A cell of nodes `l_ij`.
const fn below(nodes: [[usize; 2]; 8]) -> [LocalNode; 8] {
    let (mut cell, mut k) = ([0; 8], 0);
    while k < 8 {
        cell[k] = node(nodes[k][0], nodes[k][1], 0);
        k += 1;
    }
    cell
}
