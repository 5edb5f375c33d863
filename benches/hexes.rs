//! Refinement of hexes from end to end, beside the octree alone: hexes made per second.
//!
//! `cargo bench --bench hexes`; a shell refined in cubes, Methods I and II, 0.1 M and 1 M hexes. "plan" is the octree
//! with its closure and forecast, "mesh" everything.

#[path = "shell.rs"]
mod shell;

use std::hint::black_box;
use std::time::Instant;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use hexmill::Silent;
use hexmill::refine::hex::{HexPlan, Method, refine_hexes};
use shell::{cubes, shell};

/// Meshes of more hexes are made once, since smoothing takes minutes.
const REPEATED: usize = 300_000;

fn hexes(c: &mut Criterion) {
    let mut group = c.benchmark_group("hexes");
    group.sample_size(10);
    for (name, n, level) in shell::SIZES {
        let input = cubes(n);
        for method in [Method::One, Method::Two] {
            let options = shell(n, level, method);
            let plan = || HexPlan::new(&input, &options, &Silent).expect("a shell in cubes");
            let hexes = plan().forecast().hexes;
            println!("{name}, {method:?}: {hexes} hexes");
            group.throughput(Throughput::Elements(hexes as u64));
            group.bench_function(BenchmarkId::new(format!("plan, {method:?}"), name), |b| {
                b.iter(|| black_box(plan()));
            });
            let mesh = || refine_hexes(&input, &options, &Silent).expect("a shell in cubes");
            if hexes < REPEATED {
                group.bench_function(BenchmarkId::new(format!("mesh, {method:?}"), name), |b| {
                    b.iter(|| black_box(mesh()));
                });
            } else {
                let start = Instant::now();
                black_box(mesh());
                println!("mesh, {method:?}, {name}: {:.1} s, once", start.elapsed().as_secs_f64());
            }
        }
    }
    group.finish();
}

criterion_group!(benches, hexes);
criterion_main!(benches);
