//! A forest of octrees and its balance alone: leaves made per second, nodes numbered.
//!
//! `cargo bench --bench forest`; one and two threads, 0.1 M and 1 M leaves. To compare with: p4est makes and
//! balances 6 M octants a second and core without numbering nodes, 1.4 M with.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use hexmill::Silent;
use hexmill::forest::HexForest;
use hexmill::geometry::{Aabb, Point};
use hexmill::mesh::{GridOptions, HexMesh, NodeId, hex_grid};
use rayon::prelude::*;

/// `n` unit cubes an axis.
fn grid(n: u32) -> HexMesh {
    let bounds = Aabb { min: Point::ZERO, max: Point::splat(f64::from(n)) };
    let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 1 << 24 };
    hex_grid(bounds, &options).expect("a small grid")
}

/// Refines `levels` times what the sphere of radius 0.35 about the grid's middle, in units of the grid, passes;
/// balances.
fn shell(input: &HexMesh, levels: usize) -> HexForest {
    let side = input.positions[input.positions.len() - 1].x;
    let all: Vec<u32> = (0..input.hexes.len() as u32).collect();
    let mut forest = HexForest::new(input);
    forest.split_base(&all, &Silent).expect("nobody stops it");
    for depth in 0..levels {
        forest.make(depth, &Silent).expect("nobody stops it");
        let passes = |element: &[NodeId; 8]| {
            let outside =
                |n: &NodeId| (forest.positions[n.index()] / side).distance(Point::splat(0.5)) > 0.35;
            let count = element.iter().filter(|&n| outside(n)).count();
            !matches!(count, 0 | 8)
        };
        let elements = forest.levels[depth].elements.par_iter().enumerate();
        let marked: Vec<u32> = elements.filter(|(_, e)| passes(e)).map(|(k, _)| k as u32).collect();
        forest.split(depth, &marked, &Silent).expect("nobody stops it");
    }
    forest.close(None, u64::MAX, &Silent).expect("nobody stops it");
    forest.make(levels, &Silent).expect("nobody stops it");
    forest
}

fn forest(c: &mut Criterion) {
    let mut group = c.benchmark_group("forest");
    group.sample_size(10);
    for (name, n, levels) in [("0.1M", 8, 3), ("1M", 12, 4)] {
        let input = grid(n);
        for threads in [1, 2] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
            let leaves = pool.install(|| shell(&input, levels)).leaf_count() as u64;
            println!("{name}: {leaves} leaves");
            group.throughput(Throughput::Elements(leaves));
            group.bench_function(BenchmarkId::new(name, threads), |b| {
                b.iter(|| pool.install(|| black_box(shell(&input, levels))));
            });
        }
    }
    group.finish();
}

criterion_group!(benches, forest);
criterion_main!(benches);
