//! Untangling and smoothing of transition layers: hexes around movable nodes per second.
//!
//! `cargo bench --bench optimize`; one and two threads.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use hexmill::Silent;
use hexmill::mesh::QuadMesh;
use hexmill::mesh::topology::hex_boundary;
use hexmill::optimize::{BoundarySurface, Constraints, OptimizeOptions, OptimizeReport, optimize};

#[path = "../tests/native/optimize/pillow.rs"]
mod pillow;

use pillow::{World, pillowed};

/// Optimises a copy of the world on a pool of `threads` threads.
fn on(pool: &rayon::ThreadPool, world: &World, constraints: &Constraints) -> OptimizeReport {
    let mut positions = world.positions.clone();
    let options = OptimizeOptions::default();
    pool.install(|| optimize(&mut positions, &world.hexes, &world.movable, constraints, &options, &Silent))
        .expect("never cancelled")
}

fn optimization(c: &mut Criterion) {
    let mut group = c.benchmark_group("optimize");
    group.sample_size(10);
    for n in [16, 32] {
        // The middle half of the grid.
        let world = pillowed(n, |c| c.iter().all(|x| (n / 8..3 * n / 8).contains(x)));
        let quads = hex_boundary(&world.hexes).into_iter().map(|(quad, _)| quad).collect();
        let boundary = QuadMesh { positions: world.positions.clone(), quads };
        let surface = BoundarySurface::new(&boundary, 30.0);
        let constraints = Constraints::of_hexes(&world.positions, &world.hexes, &surface);
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            let cells = on(&pool, &world, &constraints).cells;
            group.throughput(Throughput::Elements(cells as u64));
            group.bench_function(BenchmarkId::new(format!("box-{}k", cells / 1000), threads), |b| {
                b.iter(|| black_box(on(&pool, &world, &constraints)));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, optimization);
criterion_main!(benches);
