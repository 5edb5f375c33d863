//! Uniform and adaptive refinement of quads: quads made per second.
//!
//! `cargo bench --bench refine`; one and two threads, 1 M and 4 M quads.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use hexmill::Silent;
use hexmill::geometry::Point;
use hexmill::mesh::{NodeId, PolygonMesh};
use hexmill::refine::{QuadOptions, RefinedQuads, refine_quads};
use hexmill::sizing::{Region, Shape, Target};

/// An `n` by `n` torus-free sheet of unit squares, slightly bent.
fn sheet(n: u32) -> PolygonMesh {
    let mut mesh = PolygonMesh::default();
    for y in 0..=n {
        mesh.positions.extend((0..=n).map(|x| {
            let (x, y) = (f64::from(x), f64::from(y));
            Point::new(x, y, 0.01 * x * y)
        }));
    }
    for y in 0..n {
        for x in 0..n {
            let node = |dx, dy| NodeId((y + dy) * (n + 1) + x + dx);
            mesh.push_face([node(0, 0), node(1, 0), node(1, 1), node(0, 1)]);
        }
    }
    mesh
}

/// Refines on a pool of `threads` threads.
fn on(pool: &rayon::ThreadPool, mesh: &PolygonMesh, options: &QuadOptions) -> RefinedQuads {
    pool.install(|| refine_quads(mesh, options, &Silent)).expect("within limits")
}

fn uniform(levels: u8) -> QuadOptions {
    QuadOptions { levels: Some(levels), ..QuadOptions::default() }
}

/// A ball that covers about a third of the sheet, `levels` deep.
fn adaptive(levels: u8) -> QuadOptions {
    let shape = Shape::Sphere { center: Point::new(16.0, 16.0, 2.5), radius: 10.0 };
    let region = Region { shape, target: Target::Level(levels) };
    QuadOptions { regions: vec![region], ..QuadOptions::default() }
}

fn refinement(c: &mut Criterion) {
    let cases = [("uniform-1M", 32, uniform(5)), ("uniform-4M", 32, uniform(6))]
        .into_iter()
        .chain([("adaptive-1M", 32, adaptive(6)), ("adaptive-4M", 32, adaptive(7))]);
    let mut group = c.benchmark_group("refine-quads");
    group.sample_size(10);
    for (name, n, options) in cases {
        let mesh = sheet(n);
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            let quads = on(&pool, &mesh, &options).mesh.quads.len() as u64;
            group.throughput(Throughput::Elements(quads));
            group.bench_function(BenchmarkId::new(name, threads), |b| {
                b.iter(|| black_box(on(&pool, &mesh, &options)));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, refinement);
criterion_main!(benches);
