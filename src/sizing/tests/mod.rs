//! Tests of sizing, against samples and by properties.

mod curvature;
mod field;
mod hexes;
mod json;
mod overlap;
mod validation;

use super::{Region, Shape, SizeField, SizeOptions, SizedElement, Target};
use crate::Silent;
use crate::geometry::{Point, closest_on_triangle};
use crate::mesh::{FaceId, NodeId, PolygonMesh};

/// An element of level 0 in input face 0.
fn element(corners: [Point; 4]) -> SizedElement {
    let longest = (0..4).map(|i| corners[i].distance(corners[(i + 1) % 4])).fold(0.0, f64::max);
    SizedElement { corners, longest, level: 0, root: Some(FaceId(0)) }
}

/// The unit square at (x, y, z), in the plane of x and y.
fn square(x: f64, y: f64, z: f64) -> SizedElement {
    element([[0., 0.], [1., 0.], [1., 1.], [0., 1.]].map(|[u, v]| Point::new(x + u, y + v, z)))
}

/// The four children of an element, as refinement makes them.
fn children(parent: &SizedElement) -> [SizedElement; 4] {
    let q = parent.corners;
    let center = (q[0] + q[1] + q[2] + q[3]) / 4.0;
    let middle = |i: usize| q[i % 4].midpoint(q[(i + 1) % 4]);
    [0, 1, 2, 3].map(|i| SizedElement {
        level: parent.level + 1,
        ..element([q[i], middle(i), center, middle(i + 3)])
    })
}

/// A mesh of one face.
fn one_face(corners: [Point; 4]) -> PolygonMesh {
    let mut mesh = PolygonMesh { positions: corners.to_vec(), ..Default::default() };
    mesh.push_face([0, 1, 2, 3].map(NodeId));
    mesh
}

const OPTIONS: SizeOptions<'static> =
    SizeOptions { edge_length: None, curvature: None, gradation: 2.0, regions: &[] };

fn field(mesh: &PolygonMesh, regions: &[Region], gradation: f64) -> SizeField {
    SizeField::new(mesh, SizeOptions { gradation, regions, ..OPTIONS }, &Silent).expect("valid options")
}

/// True if an element that is to be refined wherever it overlaps `shape` is to be refined.
fn overlaps(shape: &Shape, element: &SizedElement) -> bool {
    let region = Region { shape: shape.clone(), target: Target::Level(9) };
    field(&one_face(element.corners), &[region], 2.0).wants(element)
}

/// The distance of `p` from a shape; 0 inside.
fn distance(shape: &Shape, p: Point) -> f64 {
    match shape {
        Shape::Box { min, max, rotation } => {
            let local = rotation.inverse() * (p - min.midpoint(*max));
            (local.abs() - (*max - *min) * 0.5).max(Point::ZERO).length()
        }
        Shape::Sphere { center, radius } => (p.distance(*center) - radius).max(0.0),
        Shape::Cylinder { from, to, radius } => {
            let axis = (*to - *from).normalize();
            let along = (p - from.midpoint(*to)).dot(axis);
            let across = (p - from.midpoint(*to) - axis * along).length();
            (along.abs() - from.distance(*to) * 0.5).max(0.0).hypot((across - radius).max(0.0))
        }
        Shape::Points { points, radius } => {
            (points.iter().map(|q| q.distance(p)).fold(f64::INFINITY, f64::min) - radius).max(0.0)
        }
        Shape::Surface { positions, triangles, distance } => {
            let gap = |t: &[u32; 3]| closest_on_triangle(p, t.map(|n| positions[n as usize])).distance(p);
            (triangles.iter().map(gap).fold(f64::INFINITY, f64::min) - distance).max(0.0)
        }
    }
}
