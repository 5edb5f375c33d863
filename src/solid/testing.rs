//! Small solids for tests.

use super::{SolidModel, SolidOptions};
use crate::Silent;
use crate::geometry::Point;
use crate::mesh::{NodeId, PolygonMesh};

/// The solid inside `surface`, with the usual options.
#[track_caller]
pub(crate) fn solid(surface: &PolygonMesh) -> SolidModel {
    SolidModel::new(surface, &SolidOptions::default(), &Silent).expect("it bounds a solid").0
}

/// The boundary of the unit cubes, among `size` of them along each axis from the origin, that are `full`: quads, outward,
/// with points for each quad alone.
pub(crate) fn voxels(size: [i32; 3], full: impl Fn([i32; 3]) -> bool) -> PolygonMesh {
    let mut mesh = PolygonMesh::default();
    let holds = |c: [i32; 3]| (0..3).all(|a| (0..size[a]).contains(&c[a])) && full(c);
    let [nx, ny, nz] = size;
    for c in (0..nx * ny * nz).map(|i| [i % nx, i / nx % ny, i / nx / ny]).filter(|&c| holds(c)) {
        for (axis, side) in (0..3).flat_map(|axis| [(axis, 0), (axis, 1)]) {
            let mut other = c;
            other[axis] += 2 * side - 1;
            if holds(other) {
                continue;
            }
            // Around the axis, so that the normal looks along it.
            let mut around = [[0, 0], [1, 0], [1, 1], [0, 1]].map(|[u, v]| {
                let mut p = c;
                p[axis] += side;
                p[(axis + 1) % 3] += u;
                p[(axis + 2) % 3] += v;
                Point::from(p.map(f64::from))
            });
            if side == 0 {
                around.reverse();
            }
            let first = mesh.positions.len() as u32;
            mesh.positions.extend(around);
            mesh.push_face((first..first + 4).map(NodeId));
        }
    }
    mesh
}

/// A box of `size`, of unit quads.
pub(crate) fn cuboid(size: [i32; 3]) -> PolygonMesh {
    voxels(size, |_| true)
}

/// A box of 3 x 3 x 2 with a square hole through its middle.
pub(crate) fn holed() -> PolygonMesh {
    voxels([3, 3, 2], |[x, y, _]| (x, y) != (1, 1))
}

/// An L of three cubes.
pub(crate) fn ell() -> PolygonMesh {
    voxels([2, 2, 1], |[x, y, _]| (x, y) != (1, 1))
}

/// A prism along z of height 2 over a regular polygon of `n` corners on the unit circle.
pub(crate) fn cylinder(n: u32) -> PolygonMesh {
    let mut mesh = PolygonMesh::default();
    for z in [0.0, 2.0] {
        mesh.positions.extend((0..n).map(|i| {
            let (y, x) = libm::sincos(std::f64::consts::TAU * f64::from(i) / f64::from(n));
            Point::new(x, y, z)
        }));
    }
    mesh.push_face((0..n).rev().map(NodeId));
    mesh.push_face((n..2 * n).map(NodeId));
    for i in 0..n {
        let j = (i + 1) % n;
        mesh.push_face([i, j, n + j, n + i].map(NodeId));
    }
    mesh
}

/// A shell of so many quads along x and y, each 1 wide, in the middle of which z is a `height` of x and y; both are 0 in its middle.
pub(crate) fn bent(count: i32, thickness: f64, height: impl Fn(f64, f64) -> f64) -> PolygonMesh {
    moved(voxels([count, count, 1], |_| true), |p| {
        let [x, y] = [p.x, p.y].map(|c| c - 0.5 * f64::from(count));
        let slope = |dx: f64, dy: f64| (height(x + dx, y + dy) - height(x - dx, y - dy)) / 2e-6;
        let normal = Point::new(-slope(1e-6, 0.0), -slope(0.0, 1e-6), 1.0).normalize();
        Point::new(x, y, height(x, y)) + normal * (thickness * (p.z - 0.5))
    })
}

/// What is between two spheres around the origin, of quads as those of a cube's sides.
pub(crate) fn hollow_ball(count: i32, radius: f64, thickness: f64) -> PolygonMesh {
    let hollow = voxels([count; 3], |at| at.iter().any(|&c| c == 0 || c == count - 1));
    moved(hollow, |p| {
        let p = p - Point::splat(0.5 * f64::from(count));
        let inwards = 0.5 * f64::from(count) - p.abs().max_element();
        p.normalize() * (radius - thickness * inwards)
    })
}

/// Turns a profile of (radius, height), from axis to axis, around z in `n` steps.
pub(crate) fn lathe(profile: &[[f64; 2]], n: u32) -> PolygonMesh {
    let mut mesh = PolygonMesh::default();
    for &[r, z] in profile {
        mesh.positions.extend((0..n).map(|i| {
            let (y, x) = libm::sincos(std::f64::consts::TAU * f64::from(i) / f64::from(n));
            Point::new(r * x, r * y, z)
        }));
    }
    let last = profile.len() as u32 - 1;
    mesh.push_face((0..n).rev().map(NodeId));
    mesh.push_face((last * n..(last + 1) * n).map(NodeId));
    for ring in 0..last {
        for i in 0..n {
            let j = (i + 1) % n;
            mesh.push_face([i, j, n + j, n + i].map(|k| NodeId(ring * n + k)));
        }
    }
    mesh
}

/// Both surfaces in one.
pub(crate) fn both(mut a: PolygonMesh, b: &PolygonMesh) -> PolygonMesh {
    let first = a.positions.len() as u32;
    a.positions.extend(&b.positions);
    b.faces().for_each(|face| a.push_face(face.iter().map(|n| NodeId(n.0 + first))));
    a
}

/// The surface with its points elsewhere.
pub(crate) fn moved(mut surface: PolygonMesh, to: impl Fn(Point) -> Point) -> PolygonMesh {
    surface.positions.iter_mut().for_each(|p| *p = to(*p));
    surface
}

/// The surface with its faces turned around.
pub(crate) fn turned(surface: &PolygonMesh) -> PolygonMesh {
    let mut turned = PolygonMesh { positions: surface.positions.clone(), ..PolygonMesh::default() };
    surface.faces().for_each(|face| turned.push_face(face.iter().rev().copied()));
    turned
}

/// The surface of triangles or polygons over `positions`.
pub(crate) fn polygons<const N: usize>(positions: &[[f64; 3]], faces: &[[u32; N]]) -> PolygonMesh {
    let mut mesh =
        PolygonMesh { positions: positions.iter().copied().map(Point::from).collect(), ..Default::default() };
    faces.iter().for_each(|face| mesh.push_face(face.map(NodeId)));
    mesh
}
