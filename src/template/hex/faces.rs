//! Which faces of a template's cells lie in which face of the hex.

use super::{LocalNode, Template, is_mirror};
use crate::mesh::numbering::hex::{CORNERS, FACES, SYMMETRIES};

/// The most cells' faces in a face of the hex: nine of [`THIRDS`](super::THIRDS).
const MOST: usize = 9;

/// The faces of cells that lie in one face of the hex.
#[derive(Clone, Copy, Debug)]
pub(super) struct FacesOn {
    /// Each by its cell and its number there.
    faces: [(u8, u8); MOST],
    count: usize,
}

impl FacesOn {
    /// For each face of the hex the faces of `cells` there; `at` is where the nodes are.
    pub(super) const fn of<const N: usize, const C: usize>(
        at: &[[f64; 3]; N],
        cells: &[[LocalNode; 8]; C],
        cell_count: usize,
    ) -> [Self; 6] {
        let mut all = [Self { faces: [(0, 0); MOST], count: 0 }; 6];
        let mut side = 0;
        while side < 6 {
            let (mut cell, on) = (0, &mut all[side]);
            while cell < cell_count {
                let mut face = 0;
                while face < 6 {
                    let (mut lies_there, mut k) = (true, 0);
                    while k < 4 {
                        let node = cells[cell][FACES[face][k] as usize] as usize;
                        lies_there = lies_there && is_on(at[node], side);
                        k += 1;
                    }
                    if lies_there {
                        on.faces[on.count] = (cell as u8, face as u8);
                        on.count += 1;
                    }
                    face += 1;
                }
                cell += 1;
            }
            side += 1;
        }
        all
    }
}

/// True if a point lies on a face of the reference hex or on its rim.
const fn is_on(at: [f64; 3], face: usize) -> bool {
    let (first, opposite) = (CORNERS[FACES[face][0] as usize], CORNERS[FACES[face][2] as usize]);
    let mut axis = 0;
    while axis < 3 {
        if first[axis] == opposite[axis] {
            return at[axis] == first[axis] as f64;
        }
        axis += 1;
    }
    false
}

/// The face of the reference hex that `symmetry` takes to `face`.
fn taken_to(symmetry: u8, face: u8) -> usize {
    let corners = |of: [u8; 4]| of.into_iter().fold(0u8, |set, k| set | 1 << k);
    let images = &SYMMETRIES[usize::from(symmetry)];
    let wanted = corners(FACES[usize::from(face)]);
    let is_it = |f: &usize| corners(FACES[*f].map(|k| images[usize::from(k)])) == wanted;
    (0..6).find(is_it).expect("a symmetry takes faces to faces")
}

impl Template {
    /// The faces of cells that lie in `face` of a hex in which the template is placed by `symmetry`, each by its cell
    /// and by its number in that cell as [`Template::place`] has it.
    pub fn faces_on(&self, symmetry: u8, face: u8) -> impl Iterator<Item = (usize, u8)> + '_ {
        let on = &self.faces_on[taken_to(symmetry, face)];
        let mirrored = |face: u8| match face {
            // Mirrored cells have the corners with x = 0 and x = 1 exchanged.
            3 => 5,
            5 => 3,
            face => face,
        };
        let number = move |face: u8| if is_mirror(symmetry) { mirrored(face) } else { face };
        on.faces[..on.count].iter().map(move |&(cell, face)| (usize::from(cell), number(face)))
    }
}
