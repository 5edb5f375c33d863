use std::collections::{BTreeMap, BTreeSet};

use super::{HexForest, NodeKind};
use crate::Silent;
use crate::forest::testing::{grid, key_of, o_grid, refined_once, split};
use crate::mesh::numbering::hex::{EDGES, FACES};
use crate::mesh::{EdgeId, FaceId, HexId, HexMesh, NodeId, check_hexes};

/// All leaves of one level as a mesh.
fn level_mesh(forest: &HexForest, depth: usize) -> HexMesh {
    let elements = &forest.levels[depth].elements;
    let mut used: Vec<NodeId> = elements.as_flattened().to_vec();
    used.sort_unstable();
    used.dedup();
    let new = |n: NodeId| NodeId::new(used.binary_search(&n).unwrap());
    HexMesh {
        positions: used.iter().map(|n| forest.positions[n.index()]).collect(),
        hexes: elements.iter().map(|h| h.map(new)).collect(),
        ..HexMesh::default()
    }
}

/// Refines everything `times` times beyond the first.
fn uniform(input: &HexMesh, times: usize) -> HexForest {
    let mut forest = refined_once(input);
    for depth in 0..times {
        let all: Vec<u32> = (0..forest.levels[depth].elements.len() as u32).collect();
        split(&mut forest, depth, &all);
    }
    forest
}

#[test]
fn uniform_levels_conform_and_keep_the_volume() {
    for input in [grid(2), o_grid(3, 2)] {
        let volume = crate::mesh::Volumes::of(&input).unwrap().total;
        let forest = uniform(&input, 2);
        assert_eq!(forest.levels.len(), 3);
        for depth in 0..3 {
            let mesh = level_mesh(&forest, depth);
            assert_eq!(mesh.hexes.len(), input.hexes.len() << (3 * (depth + 1)));
            assert_eq!(check_hexes(&mesh), []);
            let now = crate::mesh::Volumes::of(&mesh).unwrap().total;
            assert!((now - volume).abs() < 1e-12 * volume, "{now} of {volume}");
        }
    }
}

#[test]
fn nodes_are_what_their_kind_says() {
    let forest = uniform(&grid(1), 1);
    let at = |n: NodeId| key_of(forest.positions[n.index()]);
    for (parent, level) in [(&forest.base, &forest.levels[0]), (&forest.levels[0], &forest.levels[1])] {
        for (k, &e) in parent.refined.iter().enumerate() {
            let corners = parent.elements[e as usize].map(at);
            for i in 0..8 {
                for j in 0..8 {
                    let node = at(level.elements[8 * k + i][j]);
                    // Twice the node is the sum of the parent's corners i and j.
                    assert_eq!(
                        [0, 1, 2].map(|a| 2 * node[a]),
                        [0, 1, 2].map(|a| corners[i][a] + corners[j][a])
                    );
                    assert_eq!(NodeKind::of(i, j) == NodeKind::Corner, i == j);
                }
            }
        }
    }
    let count = |kind| (0..64).filter(|m| NodeKind::of(m / 8, m % 8) == kind).count();
    assert_eq!([NodeKind::Edge, NodeKind::Face, NodeKind::Volume].map(count), [24, 24, 8]);
}

/// Splits that come one element at a time, in an odd order, give the mesh that one split of all gives.
#[test]
fn nodes_are_shared_whatever_the_order_of_the_splits() {
    let input = o_grid(3, 1);
    let mut forest = refined_once(&input);
    let count = forest.levels[0].elements.len() as u32;
    for e in 0..count {
        split(&mut forest, 0, &[(e * 7 + 3) % count]);
        if e % 3 == 0 {
            let last = forest.levels[1].elements.len() as u32 - 1;
            split(&mut forest, 1, &[last]);
        }
    }
    for depth in 0..2 {
        assert_eq!(check_hexes(&level_mesh(&forest, depth)), []);
    }
    let whole = uniform(&input, 1);
    assert_eq!(level_mesh(&forest, 1).positions.len(), level_mesh(&whole, 1).positions.len());
    let distinct: BTreeSet<[i64; 3]> = forest.positions.iter().map(|&p| key_of(p)).collect();
    assert_eq!(distinct.len(), forest.positions.len(), "a node was made twice");
}

/// What is stored of edges and faces is what elements have there.
#[test]
fn edges_and_faces_are_those_of_the_elements() {
    let mut forest = uniform(&o_grid(3, 2), 1);
    split(&mut forest, 1, &[5, 77, 300]);
    for level in [&forest.base, &forest.levels[0], &forest.levels[1]] {
        let mut at_edge: BTreeMap<BTreeSet<NodeId>, EdgeId> = BTreeMap::new();
        let mut at_face: BTreeMap<BTreeSet<NodeId>, FaceId> = BTreeMap::new();
        for (element, sides) in level.elements.iter().zip(&level.sides) {
            for (edge, local) in sides.edges.iter().zip(EDGES) {
                let nodes = BTreeSet::from(local.map(|k| element[usize::from(k)]));
                assert_eq!(BTreeSet::from(level.edges.ends[edge.index()]), nodes);
                assert_eq!(*at_edge.entry(nodes).or_insert(*edge), *edge, "an edge has one number");
            }
            for (face, local) in sides.faces.iter().zip(FACES) {
                let nodes = BTreeSet::from(local.map(|k| element[usize::from(k)]));
                let stored = level.faces.nodes[face.index()];
                assert_eq!(BTreeSet::from(stored), nodes);
                assert_eq!(*at_face.entry(nodes).or_insert(*face), *face, "a face has one number");
                for k in 0..4 {
                    let edge = level.faces.edges[face.index()][k];
                    let ends = BTreeSet::from([stored[k], stored[(k + 1) % 4]]);
                    assert_eq!(BTreeSet::from(level.edges.ends[edge.index()]), ends);
                }
            }
        }
    }
}

#[test]
fn roots_are_inherited() {
    let mut forest = uniform(&grid(2), 1);
    split(&mut forest, 1, &[8 * 64 - 1, 0]);
    assert_eq!(forest.levels[0].root(13), HexId(1));
    assert_eq!(forest.levels[1].root(8 * 13), HexId(1));
    assert_eq!(forest.levels[2].family_roots(), [7, 0].map(HexId));
}

/// The deepest level is made when somebody asks for it, and no sooner: then it is as if it had been made at once.
#[test]
fn the_deepest_level_is_made_when_it_is_asked_for() {
    let input = grid(2);
    let (mut late, mut early) = (HexForest::new(&input), refined_once(&input));
    late.split_base(&[0, 1, 2, 3, 4, 5, 6, 7], &Silent).unwrap();
    assert_eq!((late.positions.len(), late.levels[0].elements.len(), late.levels[0].len()), (27, 0, 64));
    for part in [&[1, 5][..], &[], &[63, 2, 3]] {
        late.split(0, part, &Silent).unwrap();
        split(&mut early, 0, part);
        assert_eq!(late.levels[0].elements, early.levels[0].elements);
    }
    assert_eq!((late.positions.len(), late.levels[1].elements.len(), late.leaf_count()), (125, 0, 99));
    late.make(1, &Silent).unwrap();
    assert_eq!(check_hexes(&level_mesh(&late, 1)), []);
    assert_eq!(level_mesh(&late, 1).positions.len(), level_mesh(&early, 1).positions.len());
    // What is split where a deeper level is there is made at once.
    late.split(1, &[8], &Silent).unwrap();
    late.split(0, &[7], &Silent).unwrap();
    assert_eq!((late.levels[1].elements.len(), late.levels[2].elements.len()), (8 * 6, 0));
}
