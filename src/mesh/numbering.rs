//! The reference quad and the reference hex. Every table of corners, edges, faces and symmetries in
//! the crate derives from these two pictures; local corners are numbered as in VTK.
//!
//! ```text
//!   3---2---2      corner k; edge k runs from corner k to corner k + 1
//!   |       |
//!   3       1      y
//!   |       |      |
//!   0---0---1      +--x
//!
//!        7-----------6
//!       /|          /|      corner     0    1    2    3    4    5    6    7
//!      / |         / |      x y z     000  100  110  010  001  101  111  011
//!     4-----------5  |
//!     |  |        |  |      z  y
//!     |  3--------|--2      | /
//!     | /         | /       |/
//!     |/          |/        +---x
//!     0-----------1
//! ```

/// The reference quad: the square from 0 to 1 in x and y.
pub mod quad {
    /// Where each corner is: x, y.
    pub const CORNERS: [[u8; 2]; 4] = [[0, 0], [1, 0], [1, 1], [0, 1]];

    /// The corners of each edge, in the direction of the quad's walk.
    pub const EDGES: [[u8; 2]; 4] = [[0, 1], [1, 2], [2, 3], [3, 0]];

    /// The eight symmetries: `s[k]` is where corner `k` goes. The identity is first; the first four
    /// turn, the others mirror.
    pub const SYMMETRIES: [[u8; 4]; 8] = symmetries();

    const fn symmetries() -> [[u8; 4]; 8] {
        let mut all = [[0; 4]; 8];
        let mut s = 0;
        while s < 8 {
            let mut k = 0;
            while k < 4 {
                let turned = k + s % 4;
                all[s][k] = (if s < 4 { turned } else { 4 + s - k } % 4) as u8;
                k += 1;
            }
            s += 1;
        }
        all
    }
}

/// The reference hex: the cube from 0 to 1 in x, y and z.
pub mod hex {
    /// Where each corner is: x, y, z.
    pub const CORNERS: [[u8; 3]; 8] =
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];

    /// The corner at x, y, z, by `x + 2 * y + 4 * z`. Its own inverse.
    pub const CORNER_AT: [u8; 8] = [0, 1, 3, 2, 4, 5, 7, 6];

    /// The corners of each edge, the one nearer to corner 0 first: around the bottom, around the top,
    /// then upwards.
    pub const EDGES: [[u8; 2]; 12] =
        [[0, 1], [1, 2], [3, 2], [0, 3], [4, 5], [5, 6], [7, 6], [4, 7], [0, 4], [1, 5], [2, 6], [3, 7]];

    /// The corners of each face, anticlockwise seen from outside, starting at its least corner:
    /// z = 0, z = 1, y = 0, x = 1, y = 1, x = 0.
    pub const FACES: [[u8; 4]; 6] =
        [[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [1, 2, 6, 5], [2, 3, 7, 6], [0, 4, 7, 3]];

    /// By two corners that differ in one coordinate, the edge between them; [`NONE`] for others.
    pub const EDGE_BETWEEN: [[u8; 8]; 8] = {
        let (mut all, mut e) = ([[NONE; 8]; 8], 0);
        while e < 12 {
            let [a, b] = EDGES[e];
            all[a as usize][b as usize] = e as u8;
            all[b as usize][a as usize] = e as u8;
            e += 1;
        }
        all
    };

    /// By two opposite corners of a face, the face; [`NONE`] for others.
    pub const FACE_ACROSS: [[u8; 8]; 8] = {
        let (mut all, mut f) = ([[NONE; 8]; 8], 0);
        while f < 6 {
            let mut k = 0;
            while k < 4 {
                all[FACES[f][k] as usize][FACES[f][(k + 2) % 4] as usize] = f as u8;
                k += 1;
            }
            f += 1;
        }
        all
    };

    /// The face that has no corner in common with each face.
    pub const OPPOSITE_FACE: [u8; 6] = [1, 0, 4, 5, 2, 3];

    /// The edges around each face: edge `k` joins corners `k` and `k + 1` of the face.
    pub const EDGES_OF_FACE: [[u8; 4]; 6] = {
        let (mut all, mut f) = ([[NONE; 4]; 6], 0);
        while f < 6 {
            let mut k = 0;
            while k < 4 {
                all[f][k] = EDGE_BETWEEN[FACES[f][k] as usize][FACES[f][(k + 1) % 4] as usize];
                k += 1;
            }
            f += 1;
        }
        all
    };

    /// The two faces at each edge, the lesser first.
    pub const FACES_AT_EDGE: [[u8; 2]; 12] = {
        let (mut all, mut f) = ([[NONE; 2]; 12], 0);
        while f < 6 {
            let mut k = 0;
            while k < 4 {
                let e = EDGES_OF_FACE[f][k] as usize;
                all[e][if all[e][0] == NONE { 0 } else { 1 }] = f as u8;
                k += 1;
            }
            f += 1;
        }
        all
    };

    /// The three faces at each corner: the face's number, then the corners that follow around it.
    pub const FACES_AT: [[(u8, [u8; 3]); 3]; 8] = {
        let (mut all, mut count, mut f) = ([[(NONE, [NONE; 3]); 3]; 8], [0; 8], 0);
        while f < 6 {
            let mut k = 0;
            while k < 4 {
                let corner = FACES[f][k] as usize;
                let following = [FACES[f][(k + 1) % 4], FACES[f][(k + 2) % 4], FACES[f][(k + 3) % 4]];
                all[corner][count[corner]] = (f as u8, following);
                count[corner] += 1;
                k += 1;
            }
            f += 1;
        }
        all
    };

    /// The three edges at each corner.
    pub const EDGES_AT: [[u8; 3]; 8] = {
        let (mut all, mut count, mut e) = ([[NONE; 3]; 8], [0; 8], 0);
        while e < 12 {
            let mut k = 0;
            while k < 2 {
                let corner = EDGES[e][k] as usize;
                all[corner][count[corner]] = e as u8;
                count[corner] += 1;
                k += 1;
            }
            e += 1;
        }
        all
    };

    /// Along how many axes two corners differ: 0 if they are one, 1 at an edge, 2 across a face, 3 across the hex.
    pub const fn apart(a: usize, b: usize) -> usize {
        let (mut count, mut axis) = (0, 0);
        while axis < 3 {
            count += (CORNERS[a][axis] != CORNERS[b][axis]) as usize;
            axis += 1;
        }
        count
    }

    /// No edge or face.
    pub const NONE: u8 = u8::MAX;

    /// The corners at the other ends of the three edges of each corner, in the order in which their directions are
    /// right-handed.
    pub const NEIGHBOURS: [[u8; 3]; 8] = neighbours();

    /// Along x, y and z from an even corner; from an odd one that would be left-handed.
    const fn neighbours() -> [[u8; 3]; 8] {
        let mut all = [[0; 3]; 8];
        let mut k = 0;
        while k < 8 {
            let bits = CORNER_AT[k] as usize;
            let odd = bits.count_ones() % 2 == 1;
            all[k][0] = CORNER_AT[bits ^ 1];
            all[k][if odd { 2 } else { 1 }] = CORNER_AT[bits ^ 2];
            all[k][if odd { 1 } else { 2 }] = CORNER_AT[bits ^ 4];
            k += 1;
        }
        all
    }

    /// The 48 symmetries: `s[k]` is where corner `k` goes. The identity is first; the first 24 turn,
    /// the others mirror.
    pub const SYMMETRIES: [[u8; 8]; 48] = symmetries();

    /// The ways to permute x, y and z: even ones first.
    const AXES: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [2, 1, 0], [1, 0, 2]];

    /// A symmetry permutes the axes and flips some of them. It mirrors if the permutation is odd or
    /// the number of flips is, but not both.
    const fn symmetries() -> [[u8; 8]; 48] {
        let mut all = [[0; 8]; 48];
        let (mut turns, mut mirrors, mut i) = (0, 24, 0);
        while i < 48 {
            let (axes, flips) = (AXES[i / 8], i % 8);
            let odd = (i / 24) ^ (flips.count_ones() as usize % 2);
            let at = if odd == 0 { turns } else { mirrors };
            let mut k = 0;
            while k < 8 {
                all[at][k] = image(k, axes, flips);
                k += 1;
            }
            if odd == 0 {
                turns += 1;
            } else {
                mirrors += 1;
            }
            i += 1;
        }
        all
    }

    const fn image(corner: usize, axes: [usize; 3], flips: usize) -> u8 {
        let (mut bits, mut axis) = (flips, 0);
        while axis < 3 {
            bits ^= (CORNERS[corner][axes[axis]] as usize) << axis;
            axis += 1;
        }
        CORNER_AT[bits]
    }
}

#[cfg(test)]
mod tests {
    use super::{hex, quad};
    use std::collections::BTreeSet;

    fn differing<const D: usize>(a: [u8; D], b: [u8; D]) -> usize {
        (0..D).filter(|&i| a[i] != b[i]).count()
    }

    #[test]
    fn opposite_faces_have_no_corner_in_common() {
        for (face, &opposite) in hex::FACES.iter().zip(&hex::OPPOSITE_FACE) {
            assert!(face.iter().all(|corner| !hex::FACES[usize::from(opposite)].contains(corner)));
        }
    }

    /// Is `all` a group of permutations that keep edges, with the identity first?
    fn is_group_on_edges<const N: usize>(all: &[[u8; N]], edges: &[[u8; 2]]) {
        let set: BTreeSet<_> = all.iter().copied().collect();
        assert_eq!(set.len(), all.len(), "distinct");
        assert!((0..N).all(|k| all[0][k] == k as u8), "the identity is first");
        let compose = |a: &[u8; N], b: &[u8; N]| -> [u8; N] { std::array::from_fn(|k| a[b[k] as usize]) };
        assert!(all.iter().all(|a| all.iter().all(|b| set.contains(&compose(a, b)))), "closed");
        let unordered = |[a, b]: [u8; 2]| (a.min(b), a.max(b));
        let known: BTreeSet<_> = edges.iter().map(|&e| unordered(e)).collect();
        assert!(
            all.iter().all(|s| edges.iter().all(|e| known.contains(&unordered(e.map(|k| s[k as usize])))))
        );
    }

    #[test]
    fn symmetries_are_the_groups_of_the_square_and_the_cube() {
        is_group_on_edges(&quad::SYMMETRIES, &quad::EDGES);
        is_group_on_edges(&hex::SYMMETRIES, &hex::EDGES);
    }

    #[test]
    fn edges_join_corners_that_differ_in_one_coordinate() {
        for [a, b] in quad::EDGES {
            assert_eq!(differing(quad::CORNERS[a as usize], quad::CORNERS[b as usize]), 1);
        }
        let distinct: BTreeSet<_> = hex::EDGES.into_iter().collect();
        assert_eq!(distinct.len(), 12);
        for [a, b] in hex::EDGES {
            assert_eq!(differing(hex::CORNERS[a as usize], hex::CORNERS[b as usize]), 1);
            assert!(hex::CORNERS[a as usize] < hex::CORNERS[b as usize]);
        }
    }

    #[test]
    fn neighbours_are_right_handed() {
        for (k, ends) in hex::NEIGHBOURS.into_iter().enumerate() {
            let [a, b, c] = ends.map(|end| {
                let [to, from] = [end.into(), k].map(|k: usize| hex::CORNERS[k].map(i32::from));
                [0, 1, 2].map(|i| to[i] - from[i])
            });
            let cross = [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
            assert_eq!(a[0] * cross[0] + a[1] * cross[1] + a[2] * cross[2], 1, "corner {k}");
        }
    }

    fn normal(face: [u8; 4]) -> [i32; 3] {
        let at = |k: usize, i: usize| i32::from(hex::CORNERS[face[k] as usize][i]);
        let (u, v) = (|i| at(1, i) - at(0, i), |i| at(3, i) - at(0, i));
        [u(1) * v(2) - u(2) * v(1), u(2) * v(0) - u(0) * v(2), u(0) * v(1) - u(1) * v(0)]
    }

    #[test]
    fn faces_are_walked_anticlockwise_from_outside() {
        let outward = [[0, 0, -1], [0, 0, 1], [0, -1, 0], [1, 0, 0], [0, 1, 0], [-1, 0, 0]];
        assert_eq!(hex::FACES.map(normal), outward);
        for face in hex::FACES {
            assert_eq!(face.iter().min(), face.first());
            assert!((0..4).all(|k| {
                differing(hex::CORNERS[face[k] as usize], hex::CORNERS[face[(k + 1) % 4] as usize]) == 1
            }));
        }
    }

    #[test]
    fn tables_between_corners_edges_and_faces_agree() {
        for a in 0..8 {
            for b in 0..8 {
                let apart = hex::apart(a, b);
                assert_eq!(apart, differing(hex::CORNERS[a], hex::CORNERS[b]));
                let (edge, face) = (hex::EDGE_BETWEEN[a][b], hex::FACE_ACROSS[a][b]);
                assert_eq!((edge != hex::NONE, face != hex::NONE), (apart == 1, apart == 2));
                let has = |nodes: &[u8]| nodes.contains(&(a as u8)) && nodes.contains(&(b as u8));
                assert!(edge == hex::NONE || has(&hex::EDGES[usize::from(edge)]));
                assert!(face == hex::NONE || has(&hex::FACES[usize::from(face)]));
            }
        }
        for k in 0..8u8 {
            let faces = hex::FACES_AT[usize::from(k)].map(|(f, following)| {
                let face = hex::FACES[usize::from(f)];
                let at = face.iter().position(|&c| c == k).expect("a face at the corner");
                assert_eq!(following, [1, 2, 3].map(|turn| face[(at + turn) % 4]));
                f
            });
            let edges = hex::EDGES_AT[usize::from(k)];
            assert!(faces[0] < faces[1] && faces[1] < faces[2] && edges[0] < edges[1] && edges[1] < edges[2]);
            assert!(edges.iter().all(|&e| hex::EDGES[usize::from(e)].contains(&k)));
        }
        for (e, faces) in hex::FACES_AT_EDGE.iter().enumerate() {
            assert!(faces[0] < faces[1] && faces[1] != hex::NONE);
            assert!(faces.iter().all(|&f| hex::EDGES_OF_FACE[usize::from(f)].contains(&(e as u8))));
        }
    }

    #[test]
    fn the_first_half_of_the_symmetries_keeps_orientation() {
        let keeps = |s: &[u8; 8]| {
            let [x, y, z] = [1, 3, 4].map(|k: usize| {
                let to = |i: usize| {
                    i32::from(hex::CORNERS[s[k] as usize][i]) - i32::from(hex::CORNERS[s[0] as usize][i])
                };
                [to(0), to(1), to(2)]
            });
            let cross = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
            (0..3).map(|i| cross[i] * z[i]).sum::<i32>() == 1
        };
        assert!(hex::SYMMETRIES[..24].iter().all(keeps));
        assert!(!hex::SYMMETRIES[24..].iter().any(keeps));
        let turns = |s: &[u8; 4]| (s[1] + 4 - s[0]) % 4 == 1;
        assert!(quad::SYMMETRIES[..4].iter().all(turns) && !quad::SYMMETRIES[4..].iter().any(turns));
    }

    #[test]
    fn corner_at_inverts_the_corners_coordinates() {
        for (k, [x, y, z]) in (0u8..).zip(hex::CORNERS) {
            assert_eq!(hex::CORNER_AT[usize::from(x + 2 * y + 4 * z)], k);
        }
    }
}
