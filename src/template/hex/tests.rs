use std::collections::{BTreeMap, BTreeSet};

use super::*;
use crate::mesh::quality::scaled_jacobian;

const ALL: [(&Template, usize, usize); 7] = [
    (&SPLIT, 8, 27),
    (&QUARTER, 7, 23),
    (&SLAB, 2, 12),
    (&COLUMN, 3, 14),
    (&CORNER, 4, 15),
    (&THIRDS, 27, 64),
    (&THIRTEEN, 13, 32),
];

fn point(at: [f64; 3]) -> Point {
    Point::from_array(at)
}

/// A template placed in the unit cube by a symmetry, with the points and ids of its nodes.
struct Placed {
    points: BTreeMap<u32, Point>,
    cells: Vec<[u32; 8]>,
}

impl Placed {
    fn new(template: &Template, symmetry: u8) -> Self {
        let frame = in_frame(&[0, 1, 2, 3, 4, 5, 6, 7].map(NodeId), symmetry);
        let corners = frame.map(|n| point(CORNERS[n.index()].map(f64::from)));
        let mut next = 8;
        let firsts: Vec<u32> = template
            .parts()
            .iter()
            .map(|part| {
                next += u32::from(part.count);
                next - u32::from(part.count)
            })
            .collect();
        let numbers = template.number(&frame, |k| NodeId(firsts[k]));
        let points = (0..template.node_count())
            .map(|local| (numbers[local].0, template.point(local as LocalNode, &corners)))
            .collect();
        let cells = template.place(&numbers, symmetry).map(|cell| cell.map(|n| n.0)).collect();
        Self { points, cells }
    }

    fn corners(&self, cell: &[u32; 8]) -> [Point; 8] {
        cell.map(|n| self.points[&n])
    }

    /// Faces that one cell alone has.
    fn outside(&self) -> Vec<[u32; 4]> {
        let mut uses: BTreeMap<[u32; 4], Vec<[u32; 4]>> = BTreeMap::new();
        for cell in &self.cells {
            for face in FACES.map(|face| face.map(|k| cell[usize::from(k)])) {
                let mut key = face;
                key.sort_unstable();
                uses.entry(key).or_default().push(face);
            }
        }
        for faces in uses.values().filter(|faces| faces.len() > 1) {
            assert_eq!(faces.len(), 2, "{faces:?}");
            let at = faces[1].iter().position(|&n| n == faces[0][0]).expect("the same nodes");
            assert!((0..4).all(|k| faces[0][k] == faces[1][(at + 4 - k) % 4]), "opposite walks {faces:?}");
        }
        uses.into_values().filter(|faces| faces.len() == 1).map(|faces| faces[0]).collect()
    }
}

/// The Jacobian determinant at a point of the reference hex.
fn jacobian(p: &[Point; 8], at: [f64; 3]) -> f64 {
    let slope = |axis: usize| -> Point {
        (0..8)
            .map(|k| {
                let along = |a: usize| if CORNERS[k][a] == 1 { at[a] } else { 1.0 - at[a] };
                let others: f64 = (0..3).filter(|&a| a != axis).map(along).product();
                p[k] * if CORNERS[k][axis] == 1 { others } else { -others }
            })
            .sum()
    };
    slope(0).cross(slope(1)).dot(slope(2))
}

/// The volume of a hex: two Gauss points an axis are exact.
fn volume(p: &[Point; 8]) -> f64 {
    let gauss = [0.5 - 0.75f64.sqrt() / 3.0, 0.5 + 0.75f64.sqrt() / 3.0];
    let points =
        gauss.into_iter().flat_map(|x| gauss.map(|y| [x, y])).flat_map(|[x, y]| gauss.map(|z| [x, y, z]));
    points.map(|at| jacobian(p, at)).sum::<f64>() / 8.0
}

/// The quads of a template on a face of the reference hex, as sets of what their nodes divide there: the corner, the
/// edge by its ends, or a node within the face with the corner it is next to; `to` renames the corners.
fn pattern(template: &Template, face: usize, to: impl Fn(u8) -> u8) -> BTreeSet<Vec<Vec<u8>>> {
    let placed = Placed::new(template, 0);
    let corners = FACES[face];
    let within = |at: &Point| {
        (0..3).all(|axis| {
            let shared = CORNERS[usize::from(corners[0])][axis];
            let same = corners.iter().all(|&c| CORNERS[usize::from(c)][axis] == shared);
            !same || at[axis] == f64::from(shared)
        })
    };
    let name = |n: u32| -> Vec<u8> {
        if n < 8 {
            return vec![to(n as u8)];
        }
        let at = placed.points[&n].to_array();
        let edge = (0..12u8).find(|&edge| lies_in(at, edge));
        let ends = edge.map(|edge| EDGES[usize::from(edge)]);
        let near = to(nearest_corner(at));
        match ends {
            Some(ends) => {
                let mut ends = ends.map(&to);
                ends.sort_unstable();
                let part = template.parts().iter().find(|part| Some(part.side) == edge).expect("a part");
                if part.count == 1 { ends.to_vec() } else { vec![ends[0], ends[1], near] }
            }
            None => {
                let part = template.parts().iter().find(|part| usize::from(part.side) == 12 + face);
                let alone = part.expect("a part").count == 1;
                if alone { vec![u8::MAX] } else { vec![u8::MAX, near] }
            }
        }
    };
    let on_face = placed.outside().into_iter().filter(|quad| quad.iter().all(|n| within(&placed.points[n])));
    on_face
        .map(|quad| {
            let mut names: Vec<Vec<u8>> = quad.into_iter().map(name).collect();
            names.sort_unstable();
            names
        })
        .collect()
}

/// The symmetry that permutes the corners as told, for renaming.
fn renaming(zero: u8, one: u8, four: u8) -> impl Fn(u8) -> u8 {
    let symmetry = SYMMETRIES[usize::from(symmetry_to(zero, one, four).expect("two neighbours of a corner"))];
    move |corner| symmetry[usize::from(corner)]
}

#[test]
fn templates_have_the_papers_counts() {
    for (template, cells, nodes) in ALL {
        assert_eq!((template.cell_count(), template.node_count()), (cells, nodes));
        let placed = Placed::new(template, 0);
        assert_eq!(placed.points.len(), nodes, "distinct nodes");
        let used: BTreeSet<u32> = placed.cells.iter().flatten().copied().collect();
        assert_eq!(used.len(), nodes, "no unused node");
    }
}

#[test]
fn every_template_in_every_symmetry_fills_the_cube_with_positive_cells() {
    for (template, ..) in ALL {
        for symmetry in 0..48 {
            let placed = Placed::new(template, symmetry);
            let mut total = 0.0;
            for cell in &placed.cells {
                let corners = placed.corners(cell);
                for step in 0..125 {
                    let at = [step % 5, step / 5 % 5, step / 25].map(|k| f64::from(k) / 4.0);
                    assert!(jacobian(&corners, at) > 1e-3, "{cell:?} at {at:?}, symmetry {symmetry}");
                }
                total += volume(&corners);
            }
            assert!((total - 1.0).abs() < 1e-12, "volume {total}");
        }
    }
}

#[test]
fn outer_quads_lie_on_the_cubes_faces_and_inner_ones_serve_two_cells() {
    for (template, ..) in ALL {
        let placed = Placed::new(template, 0);
        for quad in placed.outside() {
            let on_a_face = (0..3).any(|axis| {
                [0.0, 1.0].iter().any(|&side| quad.iter().all(|n| placed.points[n][axis] == side))
            });
            assert!(on_a_face, "{quad:?}");
        }
    }
}

#[test]
fn both_outer_sides_of_a_quarter_show_the_same_three_quads() {
    let side = pattern(&QUARTER, 2, |corner| corner);
    let other = pattern(&QUARTER, 5, renaming(0, 3, 4));
    assert_eq!(side.len(), 3);
    assert_eq!(other.len(), 3);
    // The side x = 0, its edge node renamed from corner 3 to corner 1.
    assert_eq!(pattern(&QUARTER, 5, move |c| [0, 3, 2, 1, 4, 7, 6, 5][usize::from(c)]), side);
    assert_eq!(pattern(&QUARTER, 3, |c| c).len(), 5);
    assert_eq!(pattern(&QUARTER, 4, |c| c).len(), 4);
    assert_eq!(pattern(&QUARTER, 0, |c| c).len(), 1);
    assert_eq!(pattern(&QUARTER, 1, |c| c), pattern(&SPLIT, 1, |c| c));
}

#[test]
fn the_corner_template_matches_the_sides_of_quarters() {
    // C at the edge node 5, its second axis down to the coarse face and its first towards the parent's corner 4.
    for (one, four) in [(4, 1), (1, 4)] {
        let symmetry = symmetry_to(5, one, four).expect("neighbours of 5");
        let images = SYMMETRIES[usize::from(symmetry)];
        let to = |corner: u8| images[usize::from(corner)];
        let face = (0..6)
            .find(|&f| {
                let mut corners = FACES[f].map(to);
                corners.sort_unstable();
                corners == [0, 1, 4, 5]
            })
            .expect("the face towards the quarter");
        assert_eq!(pattern(&CORNER, face, to), pattern(&QUARTER, 2, |c| c));
    }
}

#[test]
fn every_side_of_the_thirteen_shows_the_same_four_quads() {
    let side = pattern(&THIRTEEN, 2, |c| c);
    assert_eq!(side.len(), 4);
    for (face, zero, one) in [(3, 0, 1), (4, 0, 1), (5, 0, 1)].map(|(f, a, b): (usize, u8, u8)| (f, a, b)) {
        // Rename the side's corners to those of the side y = 0, from both ends.
        let [a, b] = match face {
            3 => [1, 2],
            4 => [2, 3],
            _ => [3, 0],
        };
        for [from_a, from_b] in [[a, b], [b, a]] {
            let to = |c: u8| {
                let above = c / 4 * 4;
                let below = c % 4;
                above
                    + if below == from_a {
                        zero
                    } else if below == from_b {
                        one
                    } else {
                        below + 8
                    }
            };
            assert_eq!(pattern(&THIRTEEN, face, to), side, "side {face}");
        }
    }
    assert_eq!(pattern(&THIRTEEN, 0, |c| c).len(), 1);
    assert_eq!(pattern(&THIRTEEN, 1, |c| c), pattern(&THIRDS, 1, |c| c));
}

#[test]
fn layer_templates_match_on_faces_with_the_same_refined_nodes() {
    // A face with one refined node, of B and of C: the same three quads.
    let of_column = pattern(&COLUMN, 0, |c| c);
    assert_eq!(of_column.len(), 3);
    assert_eq!(pattern(&CORNER, 0, |c| c), of_column);
    // A face with a refined edge, of A and of B: the same two.
    let of_slab = pattern(&SLAB, 2, |c| c);
    assert_eq!(of_slab.len(), 2);
    assert_eq!(pattern(&COLUMN, 2, |c| [0, 4, 7, 3, 1, 5, 6, 2][usize::from(c)]), of_slab);
}

#[test]
fn layer_templates_are_selected_by_their_refined_nodes() {
    let mut counts = BTreeMap::new();
    for refined in 0..=255u8 {
        let kind = match select(refined) {
            Selected::Stay => "stay",
            Selected::None => continue,
            Selected::Face(s) => {
                assert!((0..8).all(|k| (refined >> SYMMETRIES[usize::from(s)][k] & 1 == 1) == (k >= 4)));
                "face"
            }
            Selected::Edge(s) => {
                let box_edge = [0, 4].map(|k: usize| refined >> SYMMETRIES[usize::from(s)][k] & 1);
                let expected = u8::from(refined.count_ones() == 2);
                assert_eq!(box_edge, [expected; 2]);
                "edge"
            }
            Selected::Node(s) => {
                let expected = u8::from(refined.count_ones() == 1);
                assert_eq!(refined >> SYMMETRIES[usize::from(s)][0] & 1, expected);
                "node"
            }
        };
        *counts.entry(kind).or_insert(0) += 1;
    }
    assert_eq!(counts, BTreeMap::from([("stay", 1), ("face", 6), ("edge", 24), ("node", 16)]));
}

/// The least scaled Jacobian of a template's cells in a box of unit base.
fn worst_at(template: &Template, height: f64) -> f64 {
    let corners = CORNERS.map(|c| point(c.map(f64::from)) * Point::new(1.0, 1.0, height));
    let cells = template.cells().iter().map(|cell| cell.map(|local| template.point(local, &corners)));
    cells.map(|cell| scaled_jacobian(&cell)).fold(1.0, f64::min)
}

#[test]
fn the_quarters_table_of_heights_is_true() {
    let mut plain = QUARTER.at().to_vec();
    let moved = [
        [0.5, 0.0, 0.5],
        [1.0, 0.0, 0.5],
        [0.0, 0.5, 0.5],
        [0.0, 1.0, 0.5],
        [1.0, 1.0, 0.25],
        [1.0, 1.0, 0.7],
        [1.0, 0.5, 0.375],
        [1.0, 0.5, 0.75],
        [0.5, 1.0, 0.8],
        [0.5, 0.5, 0.8],
    ];
    plain[13..].copy_from_slice(&moved);
    let nodes: [[f64; 3]; 15] = plain[8..].try_into().expect("15 nodes");
    let cells: [[LocalNode; 8]; 7] = QUARTER.cells().try_into().expect("7 cells");
    let plain = Template::new(nodes, cells);
    let heights = [0.35, 0.5, 0.7, 1.0, 1.5];
    for (template, told) in
        [(&QUARTER, [0.241, 0.334, 0.444, 0.496, 0.367]), (&plain, [0.234, 0.310, 0.382, 0.436, 0.308])]
    {
        for (height, told) in heights.into_iter().zip(told) {
            let found = worst_at(template, height);
            assert!((found - told).abs() < 5e-4, "{found} at {height}, told {told}");
        }
    }
}

#[test]
fn cells_faces_in_each_face_of_the_hex_are_those_that_lie_there() {
    for (template, ..) in ALL {
        for symmetry in 0..48 {
            let placed = Placed::new(template, symmetry);
            for (side, &corners) in FACES.iter().enumerate() {
                let axis = (0..3).find(|&axis| {
                    corners
                        .iter()
                        .all(|&k| CORNERS[usize::from(k)][axis] == CORNERS[usize::from(corners[0])][axis])
                });
                let axis = axis.expect("a face is at one coordinate");
                let at = f64::from(CORNERS[usize::from(corners[0])][axis]);
                let on = |cell: &[u32; 8], face: [u8; 4]| {
                    face.iter().all(|&k| (placed.points[&cell[usize::from(k)]][axis] - at).abs() < 1e-12)
                };
                let mut wanted = Vec::new();
                for (c, cell) in placed.cells.iter().enumerate() {
                    let faces = (0..6u8).filter(|&f| on(cell, FACES[usize::from(f)]));
                    wanted.extend(faces.map(|f| (c, f)));
                }
                let mut found: Vec<(usize, u8)> = template.faces_on(symmetry, side as u8).collect();
                found.sort_unstable();
                assert_eq!(found, wanted, "symmetry {symmetry}, side {side}");
            }
        }
    }
}
