//! The 2-refinement templates of a quad (Ebeida et al., figure 1; Schneiders 1996).
//!
//! ```text
//!   3---m2---2      local node 0..4   the corners r0..r3
//!   |        |      local node 4..8   the edge nodes m0..m3, m_i between r_i and r_{i+1}
//!   m3  c   m1      local node 8      the face node c
//!   |        |
//!   0---m0---1      (the picture of `mesh::numbering`)
//!
//!   SPLIT (1 -> 4), also template 2   template 1, active node r0
//!   3---m2---2                        3--------2
//!   |   |    |                        | \      |
//!   m3--c---m1                        m3  c    |      quads  r0 m0 c m3
//!   |   |    |                        |  / \   |             m0 r1 r2 c
//!   0---m0---1                        0---m0---1             m3 c r2 r3
//! ```
//!
//! Every child of the 1 -> 4 split is written as (corner, edge node, face node, edge node). The nodes of an
//! element of level 1 or deeper therefore alternate: **local nodes 1 and 3 are its edge nodes**, and its
//! edges all join an edge node to a node that is none. Only edge nodes can be active, so template 1 is used
//! in two orientations and template 2 in one.

/// A node of a template: what it divides, as a local number (see the module's picture).
pub type LocalNode = u8;

/// The local number of edge node `m_i`.
pub const EDGE_NODE: [LocalNode; 4] = [4, 5, 6, 7];
/// The local number of the face node.
pub const FACE_NODE: LocalNode = 8;

/// The quads of a template, each by its four local nodes, in order around it.
pub type Cells<const N: usize> = [[LocalNode; 4]; N];

/// 1 -> 4, and template 2: quad `i` is at corner `i`.
pub const SPLIT: Cells<4> = {
    let mut cells = [[0; 4]; 4];
    let mut i = 0;
    while i < 4 {
        cells[i] = [i as LocalNode, EDGE_NODE[i], FACE_NODE, EDGE_NODE[(i + 3) % 4]];
        i += 1;
    }
    cells
};

/// Template 1 with the active node at corner 0.
const ONE_ACTIVE: Cells<3> = [[0, 4, 8, 7], [4, 1, 2, 8], [7, 8, 2, 3]];

/// Template 1 by the local number of its active node.
pub const TEMPLATE_1: [Cells<3>; 4] =
    [rotated(ONE_ACTIVE, 0), rotated(ONE_ACTIVE, 1), rotated(ONE_ACTIVE, 2), rotated(ONE_ACTIVE, 3)];

/// The template turned by `turns` corners.
const fn rotated<const N: usize>(mut cells: Cells<N>, turns: u8) -> Cells<N> {
    let mut c = 0;
    while c < N {
        let mut k = 0;
        while k < 4 {
            cells[c][k] = match cells[c][k] {
                corner @ 0..4 => (corner + turns) % 4,
                edge @ 4..8 => 4 + (edge - 4 + turns) % 4,
                face => face,
            };
            k += 1;
        }
        c += 1;
    }
    cells
}

/// The nodes that stand for the nine local nodes, placed into the template's quads.
#[inline(always)]
pub fn place<T: Copy, const N: usize>(cells: &Cells<N>, nodes: &[T; 9]) -> [[T; 4]; N] {
    let mut placed = [[nodes[0]; 4]; N];
    for (quad, cell) in placed.iter_mut().zip(cells) {
        for (node, &local) in quad.iter_mut().zip(cell) {
            *node = nodes[usize::from(local)];
        }
    }
    placed
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Positions of the nine local nodes on the unit square.
    const SQUARE: [[f64; 2]; 9] = [
        [0.0, 0.0],
        [1.0, 0.0],
        [1.0, 1.0],
        [0.0, 1.0],
        [0.5, 0.0],
        [1.0, 0.5],
        [0.5, 1.0],
        [0.0, 0.5],
        [0.5, 0.5],
    ];

    fn area(quad: [[f64; 2]; 4]) -> f64 {
        (0..4).map(|k| (quad[k], quad[(k + 1) % 4])).map(|(p, q)| p[0] * q[1] - q[0] * p[1]).sum::<f64>()
            / 2.0
    }

    /// Angles at the corners, in degrees.
    fn angles(quad: [[f64; 2]; 4]) -> [f64; 4] {
        std::array::from_fn(|k| {
            let [p, a, b] = [quad[k], quad[(k + 1) % 4], quad[(k + 3) % 4]];
            let (u, v) = ([a[0] - p[0], a[1] - p[1]], [b[0] - p[0], b[1] - p[1]]);
            f64::atan2(u[0] * v[1] - u[1] * v[0], u[0] * v[0] + u[1] * v[1]).to_degrees()
        })
    }

    /// Directed edges that only one quad of the template has: its outline.
    fn outline(cells: &[[LocalNode; 4]]) -> Vec<(LocalNode, LocalNode)> {
        let edges: Vec<_> = cells.iter().flat_map(|c| (0..4).map(|k| (c[k], c[(k + 1) % 4]))).collect();
        let mut outer: Vec<_> = edges.iter().copied().filter(|&(a, b)| !edges.contains(&(b, a))).collect();
        outer.sort_unstable();
        outer
    }

    #[test]
    fn every_template_tiles_the_square_with_angles_from_45_to_135_degrees() {
        let all = TEMPLATE_1.iter().map(|t| t.as_slice()).chain([SPLIT.as_slice()]);
        for cells in all {
            let quads: Vec<_> = cells.iter().map(|c| c.map(|n| SQUARE[n as usize])).collect();
            assert!((quads.iter().map(|&q| area(q)).sum::<f64>() - 1.0).abs() < 1e-15);
            for angle in quads.iter().flat_map(|&q| angles(q)) {
                assert!((44.999_999..135.000_001).contains(&angle), "{angle} in {cells:?}");
            }
        }
    }

    #[test]
    fn template_1_splits_exactly_the_edges_at_its_active_node() {
        for (active, cells) in TEMPLATE_1.iter().enumerate() {
            let next = |i: usize| (i + 1) % 4;
            let split = |i: usize| i == active || next(i) == active;
            let mut expected: Vec<_> = (0..4)
                .flat_map(|i| {
                    let (a, b, m) = (i as u8, next(i) as u8, EDGE_NODE[i]);
                    if split(i) { vec![(a, m), (m, b)] } else { vec![(a, b)] }
                })
                .collect();
            expected.sort_unstable();
            assert_eq!(outline(cells), expected);
        }
    }

    #[test]
    fn children_alternate_edge_nodes_and_others() {
        for child in SPLIT {
            assert!(child[0] < 4 && child[2] == FACE_NODE);
            assert!(EDGE_NODE.contains(&child[1]) && EDGE_NODE.contains(&child[3]));
        }
    }
}
