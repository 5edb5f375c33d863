use super::*;
use crate::mesh::topology::surface_report;

fn polygons(positions: &[[f64; 3]], faces: &[&[u32]]) -> PolygonMesh {
    let positions = positions.iter().map(|&p| Point::from(p)).collect();
    let mut mesh = PolygonMesh { positions, ..Default::default() };
    for face in faces {
        mesh.push_face(face.iter().map(|&n| NodeId(n)));
    }
    mesh
}

/// `n` by `m` unit squares in the plane z = 0; node (i, j) is `j * (n + 1) + i`.
fn grid(n: u32, m: u32) -> QuadMesh {
    let at = |i: u32, j: u32| NodeId(j * (n + 1) + i);
    let positions = (0..=m).flat_map(|j| (0..=n).map(move |i| Point::new(f64::from(i), f64::from(j), 0.0)));
    let cells = (0..m).flat_map(|j| (0..n).map(move |i| (i, j)));
    QuadMesh {
        positions: positions.collect(),
        quads: cells.map(|(i, j)| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]).collect(),
    }
}

fn kinds(defects: &[Defect]) -> Vec<&'static str> {
    defects.iter().map(Defect::kind).collect()
}

#[test]
fn a_grid_is_without_defect() {
    assert_eq!(check_quads(&grid(5, 4)), []);
    assert_eq!(hanging_nodes(&grid(5, 4)), []);
    assert_eq!(check_quads(&QuadMesh::default()), []);
    assert_eq!(check_polygons(&PolygonMesh::default()), []);
}

#[test]
fn tells_faces_that_are_no_polygons_and_stops() {
    let square = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];
    let mesh = polygons(&square, &[&[0, 1, 2, 3], &[0, 1], &[1, 2, 9], &[]]);
    let expected = [
        Defect::TooFewNodes { face: FaceId(1), count: 2 },
        Defect::NodeOutOfRange { face: FaceId(2), node: NodeId(9), nodes: 4 },
        Defect::TooFewNodes { face: FaceId(3), count: 0 },
    ];
    assert_eq!(check_polygons(&mesh), expected);
    assert!(expected.iter().all(Defect::is_error));
}

#[test]
fn tells_offsets_that_do_not_add_up() {
    let square = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];
    let whole = polygons(&square, &[&[0, 1, 2], &[0, 2, 3]]);
    for (offsets, face) in
        [(vec![], 0), (vec![1, 3, 6], 0), (vec![0, 3], 0), (vec![0, 4, 3, 6], 1), (vec![0, 3, 7], 1)]
    {
        let mesh = PolygonMesh { offsets, ..whole.clone() };
        assert_eq!(check_polygons(&mesh), [Defect::BrokenOffsets { face: FaceId(face) }]);
    }
}

#[test]
fn tells_repeated_nodes_in_small_and_large_faces() {
    let mut mesh = grid(1, 1);
    mesh.quads[0] = [0, 1, 1, 2].map(NodeId);
    let found = check_quads(&mesh);
    assert_eq!(found[0], Defect::RepeatedNode { face: FaceId(0), node: NodeId(1) });
    assert!(found.contains(&Defect::UnusedNode { node: NodeId(3) }));

    let round = |i: u32| [f64::from(i).cos(), f64::from(i).sin(), 0.0];
    let circle: Vec<_> = (0..40).map(round).collect();
    let mut face: Vec<u32> = (0..40).collect();
    face.push(17);
    let found = check_polygons(&polygons(&circle, &[&face]));
    assert_eq!(found[0], Defect::RepeatedNode { face: FaceId(0), node: NodeId(17) });
}

#[test]
fn tells_coordinates_that_are_no_numbers() {
    let mut mesh = grid(2, 1);
    mesh.positions[4].y = f64::NAN;
    mesh.positions[1].z = f64::INFINITY;
    let found = check_quads(&mesh);
    assert_eq!(found[0], Defect::NotFinite { node: NodeId(1) });
    assert_eq!(found[1], Defect::NotFinite { node: NodeId(4) });
}

#[test]
fn tells_faces_with_the_same_nodes_however_they_are_written() {
    let mut mesh = grid(2, 1);
    let [a, b, c, d] = mesh.quads[0];
    mesh.quads.push([c, b, a, d]);
    mesh.quads.push([a, c, b, d]);
    let same: Vec<_> = check_quads(&mesh).into_iter().filter(|d| d.kind() == "sameNodes").collect();
    let pair = |f| Defect::SameNodes { faces: [FaceId(0), FaceId(f)] };
    assert_eq!(same, [pair(2), pair(3)]);
}

#[test]
fn tells_faces_without_area_at_any_scale() {
    for scale in [1e-150, 1.0, 1e150] {
        let mut mesh = grid(2, 1);
        mesh.positions.iter_mut().for_each(|p| *p *= scale);
        assert_eq!(check_quads(&mesh), []);
        mesh.positions[3] = mesh.positions[0];
        mesh.positions[4] = mesh.positions[1];
        let flat = Defect::ZeroArea { face: FaceId(0) };
        assert!(check_quads(&mesh).contains(&flat), "scale {scale}");
    }
}

#[test]
fn tells_where_three_sheets_meet_and_where_normals_disagree() {
    let points = [[0., 0., 0.], [0., 1., 0.], [1., 0., 0.], [-1., 0., 0.], [0., 0., 1.]];
    let book = polygons(&points, &[&[0, 1, 2], &[1, 0, 3], &[0, 1, 4]]);
    let faces = [0, 1, 2].map(FaceId).to_vec();
    let edge = [0, 1].map(NodeId);
    assert_eq!(check_polygons(&book), [Defect::NonManifoldEdge { edge, faces }]);

    let twisted = polygons(&points, &[&[0, 1, 2], &[0, 1, 3]]);
    let found = check_polygons(&twisted);
    assert_eq!(found[0], Defect::Disagreement { edge, faces: [FaceId(0), FaceId(1)] });
    assert_eq!(found[1..], [Defect::UnusedNode { node: NodeId(4) }]);
    assert!(!found.iter().any(Defect::is_error), "a matter of what is modelled");
}

#[test]
fn tells_fans_that_share_a_node_alone() {
    let points = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [-1., 0., 0.], [-1., -1., 0.]];
    let bow = polygons(&points, &[&[0, 1, 2], &[0, 3, 4]]);
    assert_eq!(check_polygons(&bow), [Defect::NonManifoldNode { node: NodeId(0), fans: 2 }]);
}

/// ```text
/// 2---5---4      the right face was not split where the left ones meet
/// | 1 |   |
/// 6---7 2 |
/// | 0 |   |
/// 0---1---3
/// ```
#[test]
fn tells_a_node_that_hangs_in_a_neighbours_edge() {
    let points = [
        [0., 0., 0.],
        [1., 0., 0.],
        [0., 2., 0.],
        [2., 0., 0.],
        [2., 2., 0.],
        [1., 2., 0.],
        [0., 1., 0.],
        [1., 1., 0.],
    ];
    let mesh = polygons(&points, &[&[0, 1, 7, 6], &[6, 7, 5, 2], &[1, 3, 4, 5]]);
    let expected = Defect::HangingNode { node: NodeId(7), edge: [5, 1].map(NodeId) };
    assert!(expected.is_error());
    let found = check_polygons(&mesh);
    assert!(found.contains(&expected), "{found:?}");
    assert_eq!(hanging_nodes(&mesh), [expected]);
}

#[test]
fn finds_a_node_that_hangs_between_sheets_only_when_asked_for_all_edges() {
    // Two whole faces share the edge 0-1; two half faces meet it at node 2.
    let points = [
        [0., 0., 0.],
        [0., 2., 0.],
        [0., 1., 0.],
        [1., 0., 0.],
        [1., 2., 0.],
        [-1., 0., 0.],
        [-1., 2., 0.],
        [0., 0., 1.],
        [0., 1., 1.],
        [0., 2., 1.],
    ];
    let faces: [&[u32]; 4] = [&[0, 3, 4, 1], &[1, 6, 5, 0], &[0, 2, 8, 7], &[2, 1, 9, 8]];
    let mesh = polygons(&points, &faces);
    let expected = Defect::HangingNode { node: NodeId(2), edge: [1, 0].map(NodeId) };
    assert!(!kinds(&check_polygons(&mesh)).contains(&"hangingNode"));
    assert_eq!(hanging_nodes(&mesh), [expected]);
}

#[test]
fn defects_speak_and_serialise_with_their_ids() {
    let edge = [3, 7].map(NodeId);
    let defect = Defect::NonManifoldEdge { edge, faces: [1, 2, 9].map(FaceId).to_vec() };
    assert_eq!(defect.to_string(), "3 faces meet at the edge 3\u{2013}7: 1, 2, 9 (counted from 0)");
    let json = serde_json::to_string(&defect).unwrap();
    assert_eq!(json, r#"{"kind":"nonManifoldEdge","edge":[3,7],"faces":[1,2,9]}"#);
}

#[test]
fn a_summary_counts_by_kind_and_puts_errors_first() {
    let unused = |n| Defect::UnusedNode { node: NodeId(n) };
    let hanging = Defect::HangingNode { node: NodeId(1), edge: [0, 2].map(NodeId) };
    let counts = summary(&[unused(4), hanging, unused(5), unused(6)]);
    let words: Vec<_> = counts.iter().map(ToString::to_string).collect();
    assert_eq!(
        words,
        [
            "node 1 hangs inside the edge 0\u{2013}2 (counted from 0)",
            "node 4 is used by no face (counted from 0; and 2 more like it)"
        ]
    );
    assert_eq!(counts[1].count, 3);
    assert_eq!(counts[0].severity, Severity::Error);
}

#[test]
fn kinds_are_those_of_the_json() {
    let node = NodeId(0);
    let face = FaceId(0);
    let all = [
        Defect::BrokenOffsets { face },
        Defect::TooFewNodes { face, count: 0 },
        Defect::NodeOutOfRange { face, node, nodes: 0 },
        Defect::NotFinite { node },
        Defect::RepeatedNode { face, node },
        Defect::SameNodes { faces: [face; 2] },
        Defect::HangingNode { node, edge: [node; 2] },
        Defect::UnusedNode { node },
        Defect::NonManifoldEdge { edge: [node; 2], faces: vec![] },
        Defect::NonManifoldNode { node, fans: 2 },
        Defect::Disagreement { edge: [node; 2], faces: [face; 2] },
        Defect::ZeroArea { face },
    ];
    for defect in all {
        assert_eq!(serde_json::to_value(&defect).unwrap()["kind"], defect.kind());
    }
}

#[test]
fn reports_the_kind_of_a_surface() {
    let plane = grid(3, 2);
    let report = surface_report(&plane, &Edges::of_quads(&plane));
    assert_eq!((report.nodes, report.edges, report.faces), (12, 17, 6));
    assert_eq!((report.boundary_edges, report.boundary_loops, report.euler), (10, 1, 1));
    assert!(
        report.is_manifold() && !report.is_closed_manifold() && report.orientable && report.two_colourable
    );
}
