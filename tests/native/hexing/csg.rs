//! Random parts: boxes, cylinders and spheres, united with and cut out of each other.

use boolmesh::prelude::{Manifold, OpType, compute_boolean};
use glam::DQuat;
use hexmill::geometry::Point;
use hexmill::mesh::{NodeId, PolygonMesh};

use super::meshes::Numbers;

/// A closed surface of triangles.
struct Surface {
    points: Vec<Point>,
    triangles: Vec<[usize; 3]>,
}

/// The part of number `seed`: a box of edges 2 to 4 with two to five features, turned about if `seed` is odd.
pub fn random_part(seed: u64) -> PolygonMesh {
    let numbers = &mut Numbers(seed.wrapping_mul(0xD134_2543_DE82_EF95));
    let size = point(numbers, 2.0, 4.0);
    let mut part = manifold(&cuboid(Point::ZERO, size));
    for _ in 0..2 + below(numbers, 4) {
        let tool = manifold(&random_tool(numbers, size));
        let operation = if below(numbers, 3) == 0 { OpType::Add } else { OpType::Subtract };
        let cut = compute_boolean(&part, &tool, operation).expect("boolean operations of solids");
        // A tool may have taken all.
        if !cut.hs.is_empty() {
            part = cut;
        }
    }
    let turn = if seed % 2 == 1 {
        let axis = point(numbers, -1.0, 1.0).normalize_or(Point::Z);
        DQuat::from_axis_angle(axis, between(numbers, 0.2, 1.4))
    } else {
        DQuat::IDENTITY
    };
    let positions = part.ps.iter().map(|p| turn * Point::new(p.x, p.y, p.z)).collect();
    let mut mesh = PolygonMesh { positions, ..PolygonMesh::default() };
    for triangle in part.hs.chunks_exact(3) {
        mesh.push_face([0, 1, 2].map(|k| NodeId::new(triangle[k].tail)));
    }
    mesh
}

/// At least `min`, less than `max`.
fn between(numbers: &mut Numbers, min: f64, max: f64) -> f64 {
    min + numbers.next() * (max - min)
}

fn below(numbers: &mut Numbers, count: usize) -> usize {
    between(numbers, 0.0, count as f64) as usize
}

fn point(numbers: &mut Numbers, min: f64, max: f64) -> Point {
    Point::from(std::array::from_fn::<_, 3, _>(|_| between(numbers, min, max)))
}

/// A box, a cylinder along an axis or a sphere that reaches into the box from zero to `size`.
fn random_tool(numbers: &mut Numbers, size: Point) -> Surface {
    let center = point(numbers, 0.0, 1.0) * size;
    let radius = between(numbers, 0.4, 0.9);
    match below(numbers, 4) {
        0 => sphere(center, radius),
        1 | 2 => cylinder(center, below(numbers, 3), radius, size.max_element() + 1.0),
        _ => {
            let half = point(numbers, 0.4, 1.0);
            cuboid(center - half, center + half)
        }
    }
}

fn manifold(surface: &Surface) -> Manifold {
    let points: Vec<f64> = surface.points.iter().flat_map(|p| p.to_array()).collect();
    Manifold::new(&points, surface.triangles.as_flattened()).expect("tools are closed")
}

fn cuboid(min: Point, max: Point) -> Surface {
    let points = (0..8)
        .map(|k| Point::from([0, 1, 2].map(|axis| if k >> axis & 1 == 1 { max[axis] } else { min[axis] })));
    let quads = [[0, 4, 6, 2], [1, 3, 7, 5], [0, 1, 5, 4], [2, 6, 7, 3], [0, 2, 3, 1], [4, 5, 7, 6]];
    let triangles = quads.into_iter().flat_map(|[a, b, c, d]| [[a, b, c], [a, c, d]]).collect();
    Surface { points: points.collect(), triangles }
}

/// Corners of a circle.
const SIDES: usize = 32;

/// The unit vector at corner `k` of a circle.
fn spoke(k: usize) -> [f64; 2] {
    let angle = std::f64::consts::TAU * k as f64 / SIDES as f64;
    [libm::cos(angle), libm::sin(angle)]
}

/// A cylinder of `length` along an axis.
fn cylinder(center: Point, axis: usize, radius: f64, length: f64) -> Surface {
    let place = |k: usize, end: f64| {
        let [x, y] = spoke(k);
        let mut p = center;
        p[(axis + 1) % 3] += radius * x;
        p[(axis + 2) % 3] += radius * y;
        p[axis] += 0.5 * length * end;
        p
    };
    let mut points: Vec<Point> =
        (0..SIDES).map(|k| place(k, -1.0)).chain((0..SIDES).map(|k| place(k, 1.0))).collect();
    let mut caps = [center; 2];
    caps[0][axis] -= 0.5 * length;
    caps[1][axis] += 0.5 * length;
    points.extend(caps);
    let [bottom, top] = [2 * SIDES, 2 * SIDES + 1];
    let around = (0..SIDES).map(|k| (k, (k + 1) % SIDES));
    let triangles = around.flat_map(|(a, b)| {
        [[a, b, b + SIDES], [a, b + SIDES, a + SIDES], [bottom, b, a], [top, a + SIDES, b + SIDES]]
    });
    Surface { points, triangles: triangles.collect() }
}

/// A sphere of meridians and parallels.
fn sphere(center: Point, radius: f64) -> Surface {
    const PARALLELS: usize = SIDES / 2 - 1;
    let mut points = Vec::new();
    for parallel in 1..=PARALLELS {
        let [z, ring] = spoke(parallel);
        for [x, y] in (0..SIDES).map(spoke) {
            points.push(center + radius * Point::new(ring * x, ring * y, z));
        }
    }
    let [top, bottom] = [points.len(), points.len() + 1];
    points.extend([center + radius * Point::Z, center - radius * Point::Z]);
    let mut triangles = Vec::new();
    for (a, b) in (0..SIDES).map(|k| (k, (k + 1) % SIDES)) {
        triangles.push([top, a, b]);
        for low in (0..PARALLELS - 1).map(|parallel| parallel * SIDES) {
            triangles.push([low + a, low + SIDES + a, low + SIDES + b]);
            triangles.push([low + a, low + SIDES + b, low + b]);
        }
        let last = (PARALLELS - 1) * SIDES;
        triangles.push([bottom, last + b, last + a]);
    }
    Surface { points, triangles }
}
