//! Surfaces that bound no solid, and those that can be mended.

use super::super::testing::{both, cuboid, cylinder, holed, moved, polygons, turned, voxels};
use super::made;
use super::*;
use crate::Cancelled;

#[track_caller]
fn check_refused(surface: &PolygonMesh, expected: &str) {
    let error = SolidModel::new(surface, &SolidOptions::default(), &Silent).map(|_| ()).unwrap_err();
    assert_eq!(error.to_string(), expected);
}

#[test]
fn no_faces_and_one() {
    check_refused(
        &PolygonMesh::default(),
        "the surface has no faces; give a closed surface of triangles or polygons",
    );
    check_refused(
        &polygons(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]], &[[0, 1, 2]]),
        "the surface is open: 3 edges belong to one face only, the first at [0.5, 0, 0] of face 0; close the holes",
    );
}

#[test]
fn numbers_that_are_none() {
    let mut nan = cuboid([1, 1, 1]);
    nan.positions[3].y = f64::NAN;
    let error = SolidModel::new(&nan, &SolidOptions::default(), &Silent).map(|_| ()).unwrap_err();
    assert!(
        matches!(error, SolidError::Broken(crate::mesh::Defect::NotFinite { node: NodeId(3) })),
        "{error}"
    );
    for options in [
        SolidOptions { feature_angle: f64::NAN, ..SolidOptions::default() },
        SolidOptions { corner_angle: 180.0, ..SolidOptions::default() },
        SolidOptions { edge_length: Some(0.0), ..SolidOptions::default() },
        SolidOptions { hole_size: -1.0, ..SolidOptions::default() },
    ] {
        let error = SolidModel::new(&cuboid([1, 1, 1]), &options, &Silent).map(|_| ()).unwrap_err();
        assert!(matches!(error, SolidError::Option { .. }), "{error}");
    }
}

#[test]
fn coordinates_that_tell_no_sizes() {
    for (scale, by) in [(1e-100, 0.0), (1e100, 0.0), (4.0, 1e16), (1e50, 1e61)] {
        let cube = moved(cuboid([1, 1, 1]), |p| p * scale + by);
        let error = SolidModel::new(&cube, &SolidOptions::default(), &Silent).map(|_| ()).unwrap_err();
        assert!(matches!(error, SolidError::Extent { .. }), "{error}");
    }
    for (scale, by) in [(1e-50, 0.0), (1e50, 0.0), (1.0, 1e9)] {
        let (solid, _) = made(&moved(cuboid([1, 1, 1]), |p| p * scale + by), &SolidOptions::default());
        assert!((solid.volume() / scale.powi(3) - 1.0).abs() < 1e-6);
    }
}

#[test]
fn parts_that_touch_at_an_edge_or_a_wall_of_another_kind() {
    check_refused(
        &voxels([2, 2, 1], |[x, y, _]| x == y),
        "1 edge belongs to more than two faces, the first at [1, 1, 0.5] of the faces 1, 3, 6, 8; \
         separate the parts that touch there, or unite them",
    );
    let beside = moved(cuboid([1, 1, 1]), |p| p * 0.5 + Point::new(1.0, 0.2, 0.3));
    let error = SolidModel::new(&both(cuboid([1, 1, 1]), &beside), &SolidOptions::default(), &Silent);
    assert!(matches!(error.map(|_| ()).unwrap_err(), SolidError::SelfIntersection { .. }));
}

#[test]
fn parts_that_cross() {
    for by in [Point::splat(0.5), Point::new(0.5, 0.25, 0.125), Point::new(0.0, 0.0, 0.5)] {
        let across = moved(cuboid([1, 1, 1]), |p| p + by);
        let made = SolidModel::new(&both(cuboid([1, 1, 1]), &across), &SolidOptions::default(), &Silent);
        match made.map(|_| ()).unwrap_err() {
            SolidError::SelfIntersection { pairs, at, faces } => {
                assert!(pairs > 1 && faces[0].0 < 6 && faces[1].0 >= 6, "{pairs} {faces:?}");
                assert!(at.cmpge(by - 1e-9).all() && at.cmple(Point::ONE + 1e-9).all(), "{at} is in both");
            }
            other => panic!("{other}"),
        }
    }
    // A cylinder whose mantle is pulled through itself.
    let pulled = moved(cylinder(12), |p| if p.x > 0.9 { Point::new(-1.5, p.y, p.z) } else { p });
    let error = SolidModel::new(&pulled, &SolidOptions::default(), &Silent).map(|_| ()).unwrap_err();
    assert!(matches!(error, SolidError::SelfIntersection { .. }), "{error}");
}

#[test]
fn sheets_without_thickness() {
    let square = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]];
    let expected =
        "the part of the surface at [0, 0, 0] (face 0) encloses no volume; remove it or give it a thickness";
    check_refused(&polygons(&square, &[[0, 1, 2], [0, 2, 3], [2, 1, 0], [3, 2, 0]]), expected);
    // The two sides are cut otherwise.
    check_refused(&polygons(&square, &[[0, 1, 2], [0, 2, 3], [1, 0, 3], [1, 3, 2]]), expected);
}

#[test]
fn a_surface_of_one_side() {
    // The projective plane of six points.
    let faces = [
        [0, 1, 2],
        [0, 2, 3],
        [0, 3, 4],
        [0, 4, 5],
        [0, 5, 1],
        [1, 2, 4],
        [2, 3, 5],
        [3, 4, 1],
        [4, 5, 2],
        [5, 1, 3],
    ];
    let points = [0.0, 1.0, 2.0, 3.0, 4.0, 5.0].map(|t: f64| [t, t * t, t * t * t]);
    let error = SolidModel::new(&polygons(&points, &faces), &SolidOptions::default(), &Silent)
        .map(|_| ())
        .unwrap_err();
    assert!(matches!(error, SolidError::OneSided { .. }), "{error}");
}

#[test]
fn a_stop_is_heard() {
    struct Stop;
    impl crate::Monitor for Stop {
        fn progress(&self, _: crate::Stage, _: f64) {}
        fn cancelled(&self) -> bool {
            true
        }
    }
    let error = SolidModel::new(&cuboid([1, 1, 1]), &SolidOptions::default(), &Stop).map(|_| ()).unwrap_err();
    assert_eq!(error, SolidError::Cancelled(Cancelled));
}

#[test]
fn inside_out_is_turned() {
    let (solid, report) = made(&turned(&holed()), &SolidOptions::default());
    assert_eq!((report.turned_triangles, solid.volume()), (report.triangles, 16.0));
}

#[test]
fn points_that_nearly_meet_are_welded() {
    // Each face has its own points; move them by up to a ten-millionth of the diagonal.
    let mut loose = holed();
    for (i, p) in loose.positions.iter_mut().enumerate() {
        *p += Point::from([1, 3, 5].map(|k| ((i * k * 7919) % 101) as f64 / 101.0 - 0.5)) * 4e-7;
    }
    let (solid, report) = made(&loose, &SolidOptions::default());
    assert_eq!(report.points, 48);
    assert_eq!(report.welded_points + report.close_points + report.points, loose.positions.len());
    assert_eq!((solid.corners().len(), solid.surfaces().len(), solid.euler_number()), (16, 10, 0));
}

#[test]
fn faces_given_twice_and_walls_between_parts_go() {
    let mut twice = cuboid([1, 1, 1]);
    let first = twice.face(0).to_vec();
    twice.push_face(first);
    let (_, report) = made(&twice, &SolidOptions::default());
    assert_eq!((report.duplicate_triangles, report.wall_triangles, report.triangles), (2, 0, 12));
    // Two tetrahedra on the two sides of a triangle.
    let points = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., 0., 1.], [0., 0., -1.]];
    let [above, below] =
        [[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], [[0, 1, 2], [1, 0, 4], [2, 1, 4], [0, 2, 4]]];
    let (solid, report) = made(&polygons(&points, &[above, below].concat()), &SolidOptions::default());
    assert_eq!((report.duplicate_triangles, report.wall_triangles, report.bodies), (0, 2, 1));
    assert!((solid.volume() - 1.0 / 3.0).abs() < 1e-15 && solid.contains(Point::new(0.1, 0.1, 0.0)));
}

/// A cube, and before its faces some more, with points of their own.
fn after(points: &[[f64; 3]], faces: &[&[u32]]) -> PolygonMesh {
    let mut mesh = PolygonMesh::default();
    mesh.positions.extend(points.iter().map(|&p| Point::from(p)));
    faces.iter().for_each(|face| mesh.push_face(face.iter().map(|&n| NodeId(n))));
    both(mesh, &cuboid([1, 1, 1]))
}

/// Faces that go may be the only ones at their points.
#[test]
fn points_of_faces_that_go_go_too() {
    let fin = [[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [-1.0, 0.0, 0.5]];
    let sheet = fin.map(|[x, y, z]| [x - 3.0, y, z]);
    for (points, faces, degenerate, walls) in [
        (fin, &[&[0, 0, 2][..]][..], 1, 0),
        (sheet, &[&[2, 0, 2], &[1, 1, 0]], 2, 0),
        (fin, &[&[0, 1, 2], &[2, 1, 0]], 0, 2),
        (sheet, &[&[0, 1, 2], &[1, 0, 2]], 0, 2),
    ] {
        let (solid, report) = made(&after(&points, faces), &SolidOptions::default());
        assert_eq!((report.degenerate_triangles, report.wall_triangles), (degenerate, walls));
        assert_eq!((report.points, solid.points().len(), solid.volume()), (8, 8, 1.0));
    }
}

#[test]
fn points_of_no_face_tell_nothing() {
    for stray in [2e6, 1e80] {
        let mut cube = cuboid([1, 1, 1]);
        cube.positions.push(Point::splat(stray));
        let (solid, report) = made(&cube, &SolidOptions::default());
        assert_eq!((report.points, solid.corners().len(), solid.volume()), (8, 8, 1.0));
    }
}

/// In whatever order its corners are given, and whichever way round.
#[test]
fn faces_given_twice_otherwise_go() {
    let cube = cuboid([1, 1, 1]);
    let with = |copies: &[Vec<NodeId>]| {
        let mut mesh = cube.clone();
        copies.iter().for_each(|face| mesh.push_face(face.iter().copied()));
        mesh
    };
    for face in 0..6 {
        for start in 0..4 {
            let mut copy = cube.face(face).to_vec();
            copy.rotate_left(start);
            let back: Vec<NodeId> = copy.iter().rev().copied().collect();
            for copy in [copy, back] {
                let (solid, report) = made(&with(std::slice::from_ref(&copy)), &SolidOptions::default());
                assert_eq!((report.duplicate_triangles, report.wall_triangles), (2, 0), "{copy:?}");
                assert_eq!((report.triangles, solid.volume()), (12, 1.0));
            }
        }
    }
    // All of it, turned, as for both sides of the surface.
    let back: Vec<Vec<NodeId>> = cube.faces().map(|face| face.iter().rev().copied().collect()).collect();
    let (solid, report) = made(&with(&back), &SolidOptions::default());
    assert_eq!((report.duplicate_triangles, report.triangles, solid.volume()), (12, 12, 1.0));
    // Two of one corner's faces, turned, whose common edge has four triangles of which two go.
    let (_, report) = made(&with(&back[..2]), &SolidOptions::default());
    assert_eq!((report.duplicate_triangles, report.wall_triangles), (4, 0));
}

#[test]
fn small_holes_are_filled_and_others_refused() {
    let mut open = PolygonMesh { positions: cuboid([3, 3, 3]).positions, ..PolygonMesh::default() };
    cuboid([3, 3, 3]).faces().skip(1).for_each(|face| open.push_face(face.iter().copied()));
    let options = SolidOptions { hole_size: 0.3, ..SolidOptions::default() };
    let (solid, report) = made(&open, &options);
    let hole = FilledHole { at: Point::new(0.0, 0.5, 0.5), edges: 4 };
    assert_eq!((report.filled_holes, solid.volume()), (vec![hole], 27.0));
    let error = SolidModel::new(&open, &SolidOptions::default(), &Silent).map(|_| ()).unwrap_err();
    assert!(matches!(error, SolidError::Open { edges: 4, .. }), "{error}");
}

#[test]
fn flat_triangles_are_flipped_away() {
    // A cube whose top shares only the ends of an edge with the front, which has a node between; a triangle without
    // area closes the gap.
    let mut cube = cuboid([1, 1, 1]);
    let corner = |x: f64, y: f64, z: f64| Point::new(x, y, z);
    let front = [[0., 0., 0.], [1., 0., 0.], [1., 0., 1.], [0.4, 0., 1.], [0., 0., 1.]].map(Point::from);
    let is_front = |face: &[NodeId]| face.iter().all(|n| cube.positions[n.index()].y == 0.0);
    let mut mesh = PolygonMesh { positions: cube.positions.clone(), ..PolygonMesh::default() };
    cube.faces().filter(|f| !is_front(f)).for_each(|f| mesh.push_face(f.iter().copied()));
    for polygon in [&front[..], &[corner(1., 0., 1.), corner(0., 0., 1.), corner(0.4, 0., 1.)]] {
        let first = mesh.positions.len() as u32;
        mesh.positions.extend(polygon);
        mesh.push_face((first..mesh.positions.len() as u32).map(NodeId));
    }
    cube = mesh;
    let (solid, report) = made(&cube, &SolidOptions::default());
    assert_eq!(report.flipped_triangles, 1);
    assert_eq!((solid.corners().len(), solid.curves().len(), solid.surfaces().len()), (8, 12, 6));
    assert!(solid.normals().iter().all(|n| (n.length() - 1.0).abs() < 1e-12));
}

#[test]
fn points_that_parts_share_are_split() {
    let touching = voxels([2, 2, 2], |c| c == [0, 0, 0] || c == [1, 1, 1]);
    let (solid, report) = made(&touching, &SolidOptions::default());
    assert_eq!((report.split_points, report.bodies, report.points), (1, 2, 16));
    assert_eq!((solid.corners().len(), solid.euler_number()), (16, 4));
}
