//! Uniform and adaptive refinement of quads: quads made per second.
//!
//! `cargo bench --bench refine`; one and two threads, 1 M and 4 M quads.

mod cases;

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};

use cases::{cases, on, pool};

fn refinement(c: &mut Criterion) {
    let mut group = c.benchmark_group("refine-quads");
    group.sample_size(10);
    for (name, mesh, options) in cases() {
        for threads in [1, 2] {
            let pool = pool(threads);
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
