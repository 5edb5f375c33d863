//! The regular templates: 1 -> 8 and 1 -> 27.

use super::{LocalNode, Template};
use crate::mesh::numbering::hex::CORNERS;

/// 1 -> 8. Child `i` is at corner `i`, its axes parallel to the hex's: its local corner `j` is the hex's corner
/// if `j` is `i`, divides an edge where they differ in one coordinate, a face in two, the hex in three.
pub static SPLIT: Template = {
    let (at, local) = lattice::<19>(2);
    let mut cells = [[0; 8]; 8];
    let mut child = 0;
    while child < 8 {
        cells[child] = cell_at(&local, CORNERS[child]);
        child += 1;
    }
    Template::new(at, cells)
};

/// 1 -> 27, in rows along x, rows along y, layers along z.
pub static THIRDS: Template = {
    let (at, local) = lattice::<56>(3);
    let mut cells = [[0; 8]; 27];
    let mut child = 0;
    while child < 27 {
        cells[child] = cell_at(&local, [child as u8 % 3, child as u8 / 3 % 3, child as u8 / 9]);
        child += 1;
    }
    Template::new(at, cells)
};

/// Local numbers by place in a lattice, up to three steps along each axis.
type Lattice = [[[LocalNode; 4]; 4]; 4];

/// The `N` points other than corners of the lattice with `steps` steps along each axis, and all its numbers.
const fn lattice<const N: usize>(steps: u8) -> ([[f64; 3]; N], Lattice) {
    let (mut at, mut local, mut count) = ([[0.0; 3]; N], [[[0; 4]; 4]; 4], 0);
    let mut k = 0;
    while k < 8 {
        let [x, y, z] = CORNERS[k];
        local[(z * steps) as usize][(y * steps) as usize][(x * steps) as usize] = k as LocalNode;
        k += 1;
    }
    let line = steps as usize + 1;
    let mut place = 0;
    while place < line * line * line {
        let (x, y, z) = (place % line, place / line % line, place / line / line);
        let ends = [x, y, z];
        let (mut is_corner, mut axis) = (true, 0);
        while axis < 3 {
            is_corner = is_corner && (ends[axis] == 0 || ends[axis] == line - 1);
            axis += 1;
        }
        if !is_corner {
            let n = steps as f64;
            at[count] = [x as f64 / n, y as f64 / n, z as f64 / n];
            local[z][y][x] = (8 + count) as LocalNode;
            count += 1;
        }
        place += 1;
    }
    (at, local)
}

/// The cell of a lattice whose corner 0 is at x, y, z.
const fn cell_at(local: &Lattice, [x, y, z]: [u8; 3]) -> [LocalNode; 8] {
    let (mut cell, mut k) = ([0; 8], 0);
    while k < 8 {
        let [dx, dy, dz] = CORNERS[k];
        cell[k] = local[(z + dz) as usize][(y + dy) as usize][(x + dx) as usize];
        k += 1;
    }
    cell
}
