//! Sizing of elements: elements asked per second, on one thread.
//!
//! `cargo bench --bench sizing`; a bent sheet of 250 000 quads, of which each region covers about a third.

use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use glam::DQuat;
use hexmill::Silent;
use hexmill::geometry::Point;
use hexmill::mesh::{FaceId, NodeId, PolygonMesh};
use hexmill::sizing::{Region, Shape, SizeField, SizeOptions, SizedElement, Target};

/// Quads along each side of the sheet.
const SIDE: u32 = 500;

/// The sheet's point at (u, v), both from 0 to 1.
fn sheet(u: f64, v: f64) -> Point {
    Point::new(u, v, 0.1 * (5.0 * u).sin() * (4.0 * v).cos())
}

/// A point of the sheet's node (i, j).
fn node(i: u32, j: u32) -> Point {
    sheet(f64::from(i) / f64::from(SIDE), f64::from(j) / f64::from(SIDE))
}

fn elements() -> Vec<SizedElement> {
    let element = |i, j| {
        let corners = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
        let edges = (0..4).map(|k: usize| corners[k].distance(corners[(k + 1) % 4]));
        SizedElement { corners, longest: edges.fold(0.0, f64::max), level: 9, root: Some(FaceId(0)) }
    };
    (0..SIDE).flat_map(|j| (0..SIDE).map(move |i| element(i, j))).collect()
}

/// The sheet as one face: its own shape does not matter.
fn input() -> PolygonMesh {
    let positions = [node(0, 0), node(SIDE, 0), node(SIDE, SIDE), node(0, SIDE)].to_vec();
    let mut mesh = PolygonMesh { positions, ..PolygonMesh::default() };
    mesh.push_face([0, 1, 2, 3].map(NodeId));
    mesh
}

/// Points of the middle of the sheet, `n` by `n`.
fn middle(n: u32) -> Vec<Point> {
    let at = |k: u32| 0.2 + 0.6 * f64::from(k) / f64::from(n - 1);
    (0..n).flat_map(|j| (0..n).map(move |i| sheet(at(i), at(j)) + Point::Z * 0.01)).collect()
}

/// A surface of `2 (n - 1)²` triangles over the middle of the sheet.
fn surface(n: u32) -> Shape {
    let triangles = (0..n - 1).flat_map(|j| {
        (0..n - 1).flat_map(move |i| {
            let [a, b, c, d] = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(u, v)| (j + v) * n + i + u);
            [[a, b, c], [a, c, d]]
        })
    });
    Shape::Surface { positions: middle(n), triangles: triangles.collect(), distance: 0.02 }
}

fn sizing(c: &mut Criterion) {
    let tilted = DQuat::from_xyzw(0.1, 0.2, 0.3, 0.9).normalize();
    let shapes = [
        (
            "box",
            Shape::Box { min: Point::new(0.2, 0.2, -1.0), max: Point::new(0.8, 0.75, 1.0), rotation: tilted },
        ),
        ("sphere", Shape::Sphere { center: Point::new(0.5, 0.5, 0.0), radius: 0.33 }),
        (
            "cylinder",
            Shape::Cylinder { from: Point::new(0.4, 0.4, -0.5), to: Point::new(0.6, 0.6, 0.5), radius: 0.3 },
        ),
        ("points-10k", Shape::Points { points: middle(100), radius: 0.012 }),
        ("surface-100k", surface(225)),
    ];
    let (input, elements) = (input(), elements());
    let mut group = c.benchmark_group("sizing");
    group.sample_size(10).throughput(Throughput::Elements(elements.len() as u64));
    for (name, shape) in shapes {
        // A level asks each element for its overlap; a slow gradation also for its distance.
        for (kind, target, gradation) in
            [("level", Target::Level(12), 2.0), ("graded", Target::Size(1e-3), 1.05)]
        {
            let region = Region { shape: shape.clone(), target };
            let options = SizeOptions { edge_length: None, curvature: None, gradation, regions: &[region] };
            let field = SizeField::new(&input, options, &Silent).expect("valid options");
            let wanted = |e: &&SizedElement| field.wants(e);
            let count = elements.iter().filter(wanted).count();
            assert!((elements.len() / 5..elements.len() * 2 / 3).contains(&count), "{name}: {count}");
            group.bench_function(format!("{name}/{kind}"), |b| {
                b.iter(|| black_box(&elements).iter().filter(wanted).count());
            });
        }
    }
    group.finish();
}

criterion_group!(benches, sizing);
criterion_main!(benches);
