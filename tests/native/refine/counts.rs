//! How many quads and nodes there are follows from the forest and the templates, by counting alone.

use std::collections::BTreeSet;

use hexmill::Silent;
use hexmill::forest::QuadForest;
use hexmill::geometry::Point;
use hexmill::mesh::{NodeId, PolygonMesh};
use hexmill::refine::{QuadOptions, QuadRefinement};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::Index;

use super::judge::{assert_conforming, edge_uses, polygon_faces};
use super::random::{coin, shuffled};
use super::worlds::{cube, grid, ring, three_sheets};

/// Quads around a node of valence `n`: node 0 in the middle.
fn fan(n: u32) -> PolygonMesh {
    let mut mesh = PolygonMesh::default();
    mesh.positions.push(Point::ZERO);
    for k in 0..n {
        let angle = f64::from(k) / f64::from(n) * std::f64::consts::TAU;
        let next = (f64::from(k) + 0.5) / f64::from(n) * std::f64::consts::TAU;
        mesh.positions.push(Point::new(angle.cos(), angle.sin(), 0.0));
        mesh.positions.push(Point::new(2.0 * next.cos(), 2.0 * next.sin(), 0.0));
    }
    for k in 0..n {
        mesh.push_face([0, 1 + 2 * k, 2 + 2 * k, 1 + 2 * ((k + 1) % n)].map(NodeId));
    }
    mesh
}

/// `n` by `m` quads around a torus: a closed surface whose nodes may not be two-colourable.
fn torus(n: u32, m: u32) -> PolygonMesh {
    let node = |i: u32, j: u32| NodeId(i % n * m + j % m);
    let mut mesh = PolygonMesh::default();
    for i in 0..n {
        for j in 0..m {
            let [u, v] =
                [(i, n), (j, m)].map(|(k, count)| f64::from(k) / f64::from(count) * std::f64::consts::TAU);
            mesh.positions.push(Point::new((3.0 + v.cos()) * u.cos(), (3.0 + v.cos()) * u.sin(), v.sin()));
            mesh.push_face([node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)]);
        }
    }
    mesh
}

/// A quad on an edge of some face, with two nodes of its own: where two faces meet, a third.
fn add_flap(mesh: &mut PolygonMesh, corner: &Index) {
    let corner = corner.index(mesh.corners.len());
    let (a, b) = (mesh.corners[corner], mesh.corners[corner / 4 * 4 + (corner + 1) % 4]);
    let lifted = Point::Z * (2.0 + mesh.positions.len() as f64 / 16.0);
    let new = [NodeId::new(mesh.positions.len()), NodeId::new(mesh.positions.len() + 1)];
    let ends = [b, a].map(|n| mesh.positions[n.index()] + lifted);
    mesh.positions.extend(ends);
    mesh.push_face([a, b, new[0], new[1]]);
}

/// Quads with random faces taken away and others added.
fn surfaces() -> impl Strategy<Value = PolygonMesh> {
    let closed = prop_oneof![Just(cube()), (3..6_u32, 3..6_u32).prop_map(|(n, m)| torus(n, m))];
    let open = prop_oneof![
        (3..8_u32).prop_map(fan),
        (1..4_u32, 1..4_u32).prop_map(|(n, m)| grid(n, m)),
        Just(ring()),
        Just(three_sheets()),
    ];
    let whole = prop_oneof![closed, open];
    (whole, vec(any::<Index>(), 0..4), vec(any::<Index>(), 0..4), any::<u64>()).prop_map(
        |(whole, without, flaps, seed)| {
            let gone: BTreeSet<usize> = without.iter().map(|face| face.index(whole.face_count())).collect();
            let gone = if gone.len() < whole.face_count() { gone } else { BTreeSet::new() };
            let mut mesh = PolygonMesh { positions: whole.positions.clone(), ..PolygonMesh::default() };
            for (_, face) in whole.faces().enumerate().filter(|(f, _)| !gone.contains(f)) {
                mesh.push_face(face.iter().copied());
            }
            flaps.iter().for_each(|corner| add_flap(&mut mesh, corner));
            shuffled(&mesh, seed)
        },
    )
}

type Edge = [NodeId; 2];

/// The edges of an element; those at its local nodes 1 and 3, its edge nodes, are all of them.
fn edges(element: &[NodeId; 4]) -> [Edge; 4] {
    std::array::from_fn(|k| {
        let (a, b) = (element[k], element[(k + 1) % 4]);
        [a.min(b), a.max(b)]
    })
}

/// The quads and nodes that a balanced forest becomes: 1, 3 or 4 quads an element by its active nodes; a node for each
/// edge that an element divides, and for each element that is divided.
fn predicted(input: &PolygonMesh, forest: &QuadForest) -> (usize, usize) {
    let used: BTreeSet<NodeId> = input.corners.iter().copied().collect();
    let mut nodes = used.len() + edge_uses(polygon_faces(input)).len() + input.face_count();
    let mut quads = 0;
    for level in &forest.levels {
        let (refined, left): (Vec<usize>, Vec<usize>) =
            (0..level.elements.len()).partition(|e| level.refined.contains(&(*e as u32)));
        let active: BTreeSet<NodeId> =
            refined.iter().flat_map(|&e| [level.elements[e][1], level.elements[e][3]]).collect();
        let mut divided: BTreeSet<Edge> = refined.iter().flat_map(|&e| edges(&level.elements[e])).collect();
        nodes += refined.len();
        for e in left {
            let element = &level.elements[e];
            match [1, 3].iter().filter(|&&k| active.contains(&element[k])).count() {
                0 => quads += 1,
                count => {
                    quads += [3, 4][count - 1];
                    nodes += 1;
                }
            }
            let at_active = |edge: &Edge| edge.iter().any(|n| active.contains(n));
            divided.extend(edges(element).iter().filter(|edge| at_active(edge)));
        }
        nodes += divided.len();
    }
    (quads, nodes)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(400))]

    #[test]
    fn quads_and_nodes_are_those_predicted(
        input in surfaces(), levels in 1..=3_usize, percent in 3..60_u64, seed: u64,
    ) {
        let options = QuadOptions::default();
        let mut refinement = QuadRefinement::new(&input, &options, &Silent).unwrap();
        let all = vec![f64::MIN_POSITIVE; input.face_count()];
        prop_assert!(refinement.advance(Some(&all), &Silent).unwrap());
        let mut forest = QuadForest::refined_once(&input, &Silent).unwrap();
        for depth in 0..levels {
            let count = forest.levels[depth].elements.len();
            let marked: Vec<u32> = (0..count as u32)
                .filter(|&e| coin(seed, depth, Point::splat(f64::from(e)), percent))
                .collect();
            let mut targets = vec![f64::INFINITY; count];
            marked.iter().for_each(|&e| targets[e as usize] = f64::MIN_POSITIVE);
            let deeper = refinement.advance(Some(&targets), &Silent).unwrap();
            prop_assert_eq!(deeper, !marked.is_empty());
            if !deeper {
                break;
            }
            forest.split(depth, &marked, &Silent).unwrap();
        }
        forest.balance(&Silent).unwrap();
        let refined = refinement.finish(&Silent).unwrap();
        let found = (refined.mesh.quads.len(), refined.mesh.positions.len());
        prop_assert_eq!(found, predicted(&input, &forest));
        assert_conforming(&input, &refined);
    }
}

/// What the strategy is to make: closed, open and non-manifold surfaces, and nodes of odd valences.
#[test]
fn the_surfaces_are_of_all_kinds() {
    use proptest::strategy::ValueTree;
    use proptest::test_runner::TestRunner;

    let mut runner = TestRunner::deterministic();
    let mut kinds = BTreeSet::new();
    for _ in 0..200 {
        let mesh = surfaces().new_tree(&mut runner).unwrap().current();
        let uses = edge_uses(polygon_faces(&mesh));
        let has = |wanted: fn(usize) -> bool| uses.values().any(|&n| wanted(n));
        kinds.insert((has(|n| n == 1), has(|n| n > 2)));
    }
    assert!(
        kinds.contains(&(false, false)) && kinds.contains(&(true, false)) && kinds.contains(&(true, true))
    );
}
