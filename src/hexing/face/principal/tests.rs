//! Principal faces of small solids.

use super::*;
use crate::Silent;
use crate::geometry::Point;
use crate::mesh::{NodeId, PolygonMesh};
use crate::solid::testing::{cuboid, ell, holed, moved, solid, voxels};

fn face(surface: &PolygonMesh, direction: Point, edge_length: f64) -> PrincipalFace {
    principal_face(&solid(surface), direction, &RegionOptions::new(edge_length), 1.0, &Silent).unwrap()
}

fn area(face: &PrincipalFace) -> f64 {
    let at = |n: u32| face.mesh.points[n as usize];
    face.mesh.quads.iter().map(|&[a, b, c, d]| 0.5 * (at(c) - at(a)).perp_dot(at(d) - at(b))).sum()
}

#[test]
fn faces_cover_what_is_seen() {
    for (surface, direction, expected) in [
        (cuboid([3, 2, 1]), Point::Z, 6.0),
        (cuboid([3, 2, 1]), -Point::X, 2.0),
        (holed(), Point::Z, 8.0),
        (holed(), Point::Y, 6.0),
        (ell(), Point::Z, 3.0),
        (cuboid([1, 1, 1]), Point::ONE, 3.0_f64.sqrt()),
    ] {
        let face = face(&surface, direction, 0.2);
        assert!((area(&face) - expected).abs() < 1e-9, "{direction}: {}", area(&face));
        assert!(face.mesh.worst > 0.3, "{direction}: {}", face.mesh.worst);
        let [u, v, w] = face.axes;
        assert!(u.cross(v).distance(w) < 1e-12 && w.dot(direction) > 0.0);
    }
}

#[test]
fn a_step_inside_is_followed_from_both_sides() {
    // A plate with a smaller block on it: seen from above and from below its rim is in the mesh.
    let stepped = voxels([4, 4, 2], |[x, y, z]| z == 0 || (1..3).contains(&x) && (1..3).contains(&y));
    for direction in [Point::Z, -Point::Z] {
        let face = face(&stepped, direction, 0.25);
        let [u, v, _] = face.axes;
        for (x, y) in [(1.0, 1.0), (1.0, 3.0), (3.0, 1.0), (3.0, 3.0)] {
            let p = glam::DVec2::new(Point::new(x, y, 0.0).dot(u), Point::new(x, y, 0.0).dot(v));
            assert!(face.mesh.points.iter().any(|q| q.distance(p) < 1e-9), "{direction}: {p}");
        }
        assert!((area(&face) - 16.0).abs() < 1e-9);
        assert!(face.mesh.worst > 0.999, "{}", face.mesh.worst);
    }
}

#[test]
fn curves_under_small_angles_are_given_up() {
    // A wedge on a plate whose foot runs from a corner at 3 degrees to the edge.
    let mut surface = PolygonMesh::default();
    let t = 0.052;
    let points = [[0.0, 0.0, 0.0], [4.0, 0.0, 0.0], [4.0, 3.0, 0.0], [0.0, 3.0, 0.0]];
    surface.positions.extend(points.map(Point::from));
    surface.positions.extend(points.map(|[x, y, _]| Point::new(x, y, 1.0)));
    surface.positions.extend(
        [[4.0, 4.0 * t, 1.0], [4.0, 4.0 * t, 1.5], [4.0, 3.0, 1.5], [0.0, 3.0, 1.5], [0.0, 0.0, 1.5]]
            .map(Point::from),
    );
    for polygon in [
        vec![3, 2, 1, 0],
        vec![0, 1, 5, 4],
        vec![1, 2, 10, 9, 8, 5],
        vec![2, 3, 11, 10],
        vec![3, 0, 4, 12, 11],
        vec![4, 5, 8],
        vec![4, 8, 9, 12],
        vec![12, 9, 10, 11],
    ] {
        surface.push_face(polygon.into_iter().map(NodeId));
    }
    let face = face(&surface, Point::Z, 0.1);
    assert_eq!(face.given_up, 1);
    assert!((area(&face) - 12.0).abs() < 1e-9);
}

#[test]
fn a_turned_solid_has_the_same_face() {
    let plain = face(&holed(), Point::Z, 0.2);
    let turn = glam::DQuat::from_xyzw(0.3, 0.5, 0.1, 0.8).normalize();
    let mut turned = holed();
    turned.positions.iter_mut().for_each(|p| *p = turn * *p);
    let face = face(&turned, turn * Point::Z, 0.2);
    let count = |face: &PrincipalFace| face.mesh.quads.len() as f64;
    assert!((count(&face) / count(&plain) - 1.0).abs() < 0.1 && face.mesh.worst > 0.3, "{}", face.mesh.worst);
    assert!((area(&face) - 8.0).abs() < 1e-9);
}

/// All of the solid is whole numbers of edges long, and half ones.
#[test]
fn the_last_bits_of_the_edge_length_bring_no_other_face() {
    let quads = |edge_length: f64| face(&holed(), Point::Z, edge_length).mesh.quads;
    for edge_length in [0.1, 1.0 / 3.0, 0.4] {
        let expected = quads(edge_length);
        let mut near = [edge_length; 2];
        for _ in 0..8 {
            near = [near[0].next_down(), near[1].next_up()];
            assert_eq!(near.map(quads), [expected.clone(), expected.clone()], "{near:?}");
        }
    }
}

/// The sides of a wall that is a twentieth of an edge thick fall together within the usual tolerances.
#[test]
fn thin_walls_are_covered() {
    let wall = moved(voxels([2, 2, 1], |[x, y, _]| x == 0 || y == 0), |p| {
        let along = |x: f64| [0.0, 0.05, 7.0][x as usize];
        Point::new(along(p.x), along(p.y), 4.0 * p.z)
    });
    let face = face(&wall, Point::Z, 1.0);
    assert!((area(&face) - (2.0 * 7.0 * 0.05 - 0.05 * 0.05)).abs() < 1e-9, "{}", area(&face));
    assert!(face.mesh.worst > 0.7, "{}", face.mesh.worst);
}
