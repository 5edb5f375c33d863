//! Curvature of cylinders, balls, saddles, and what does not count.

use std::f64::consts::PI;

use super::{OPTIONS, SizeField, SizeOptions, SizedElement};
use crate::Silent;
use crate::geometry::Point;
use crate::mesh::{FaceId, NodeId, PolygonMesh};
use crate::sizing::curvature::turn_per_length;

/// A grid of n by m quads, or twice as many triangles, whose nodes are the images of (0..=n, 0..=m).
fn sheet(n: u32, m: u32, triangles: bool, at: impl Fn(f64, f64) -> Point) -> PolygonMesh {
    let mut mesh = PolygonMesh::default();
    for j in 0..=m {
        mesh.positions.extend((0..=n).map(|i| at(f64::from(i), f64::from(j))));
    }
    for j in 0..m {
        for i in 0..n {
            let [a, b, c, d] =
                [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(u, v)| NodeId((j + v) * (n + 1) + i + u));
            if triangles {
                mesh.push_face([a, b, c]);
                mesh.push_face([a, c, d]);
            } else {
                mesh.push_face([a, b, c, d]);
            }
        }
    }
    mesh
}

/// Part of a pipe: 8 of 36 facets around, 3 along.
fn pipe(radius: f64, triangles: bool) -> PolygonMesh {
    sheet(8, 3, triangles, |i, j| {
        let angle = i * PI / 18.0;
        Point::new(radius * angle.cos(), radius * angle.sin(), 0.7 * j)
    })
}

/// Degrees per unit of length on a circle of this radius.
fn degrees_per_length(radius: f64) -> f64 {
    (1.0 / radius).to_degrees()
}

fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance * expected, "{found} is not {expected}");
}

#[test]
fn pipes_turn_once_around() {
    for radius in [0.1, 2.0, 50.0] {
        for triangles in [false, true] {
            let turns = turn_per_length(&pipe(radius, triangles), &Silent).unwrap();
            let per_quad = if triangles { 2 } else { 1 };
            for (f, &turn) in turns.iter().enumerate() {
                let column = f / per_quad % 8;
                if (1..7).contains(&column) {
                    assert_near(turn, degrees_per_length(radius), 0.01);
                } else {
                    assert!(turn <= 1.01 * degrees_per_length(radius), "no more at the rim");
                }
            }
        }
    }
}

#[test]
fn orientation_of_single_faces_changes_nothing() {
    let mesh = pipe(2.0, false);
    let mut mixed = PolygonMesh { positions: mesh.positions.clone(), ..Default::default() };
    for (f, face) in mesh.faces().enumerate() {
        let mut face = face.to_vec();
        if f % 3 == 0 {
            face.reverse();
        }
        mixed.push_face(face);
    }
    let (straight, mixed) =
        (turn_per_length(&mesh, &Silent).unwrap(), turn_per_length(&mixed, &Silent).unwrap());
    for (a, b) in straight.iter().zip(&mixed) {
        assert_near(*b, *a, 1e-9);
    }
}

#[test]
fn balls_and_saddles_turn_everywhere() {
    let radius = 3.0;
    let patch = |i: f64, j: f64| {
        let (x, y) = ((i - 4.0) * 0.1, (j - 4.0) * 0.1);
        Point::new(x, y, (radius * radius - x * x - y * y).sqrt())
    };
    let saddle = |i: f64, j: f64| {
        let (x, y) = ((i - 4.0) * 0.1, (j - 4.0) * 0.1);
        Point::new(x, y, (x * x - y * y) / (2.0 * radius))
    };
    for triangles in [false, true] {
        let per_quad = if triangles { 2 } else { 1 };
        let middle = per_quad * (4 * 8 + 4);
        let ball = turn_per_length(&sheet(8, 8, triangles, patch), &Silent).unwrap()[middle];
        assert_near(ball, degrees_per_length(radius), 0.05);
        let saddle = turn_per_length(&sheet(8, 8, triangles, saddle), &Silent).unwrap()[middle];
        assert_near(saddle, degrees_per_length(radius), 0.05);
    }
}

/// Two squares that meet at an edge, turned by `angle` degrees.
fn hinge(angle: f64) -> PolygonMesh {
    let (s, c) = angle.to_radians().sin_cos();
    sheet(2, 1, false, |i, j| if i < 1.5 { Point::new(i, j, 0.0) } else { Point::new(1.0 + c, j, s) })
}

#[test]
fn sharp_edges_creases_and_rims_do_not_count() {
    assert!(turn_per_length(&hinge(39.0), &Silent).unwrap().iter().all(|&turn| (turn - 19.5).abs() < 1e-9));
    assert_eq!(turn_per_length(&hinge(41.0), &Silent).unwrap(), [0.0; 2]);
    assert_eq!(turn_per_length(&hinge(0.0), &Silent).unwrap(), [0.0; 2]);
    let mut creased = hinge(20.0);
    creased.features.creases.push(([NodeId(4), NodeId(1)], 2.0));
    assert_eq!(turn_per_length(&creased, &Silent).unwrap(), [0.0; 2]);
}

#[test]
fn a_large_plane_next_to_a_fillet_stays_flat() {
    // A plane 10 long, then a fillet of radius 1 in 9 facets of 10 degrees.
    let mesh = sheet(10, 1, false, |i, j| {
        let angle = ((i - 1.0).max(0.0) * 10.0_f64).to_radians();
        Point::new(if i < 0.5 { -10.0 } else { angle.sin() }, 5.0 * j, 1.0 - angle.cos())
    });
    let turns = turn_per_length(&mesh, &Silent).unwrap();
    assert!(turns[0] * 10.0 <= 5.01, "the plane shares one edge's turn: {}", turns[0] * 10.0);
    assert_near(turns[4], degrees_per_length(1.0), 0.01);
}

#[test]
fn elements_are_refined_until_an_edge_spans_the_angle() {
    let mesh = pipe(2.0, false);
    let field = SizeField::new(&mesh, SizeOptions { curvature: Some(5.0), ..OPTIONS }, &Silent).unwrap();
    let longest_allowed = 5.0 / degrees_per_length(2.0);
    let wants = |longest: f64, f: u32| {
        let corners = [Point::ZERO; 4];
        field.wants(&SizedElement { corners, longest, level: 1, root: Some(FaceId(f)) })
    };
    assert!(wants(longest_allowed * 1.02, 3) && !wants(longest_allowed * 0.98, 3));
    assert!(!field.is_idle_from(1) && field.is_idle_from(4));
}
