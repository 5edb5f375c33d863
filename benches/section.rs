//! Looking into a hex mesh: what a move of the cutting plane costs before the graphics card.
//!
//! `cargo bench --bench section`; cubes of 0.5 M and 1 M hexes. `cells and faces` is the pass over the mesh that tells
//! what is shown; `draw data` is all that a frame of a moving plane needs: that pass, normals and triangles. To compare
//! with: a frame at 60 Hz has 16.7 ms.

use std::hint::black_box;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use glam::DVec3;
use hexmill::geometry::{Aabb, Point};
use hexmill::mesh::{GridOptions, hex_grid};
use hexmill::scene::{Cut, Hexes, Section};

fn cube(side: u32) -> (Vec<f64>, Vec<u32>) {
    let bounds = Aabb { min: Point::ZERO, max: Point::splat(f64::from(side)) };
    let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 1 << 24 };
    let mesh = hex_grid(bounds, &options).expect("a small grid");
    let nodes = mesh.positions.iter().flat_map(|p| p.to_array()).collect();
    (nodes, mesh.hexes.iter().flatten().map(|n| n.0).collect())
}

fn section(c: &mut Criterion) {
    let mut group = c.benchmark_group("section");
    group.sample_size(10);
    for side in [80, 100] {
        let (nodes, corners) = cube(side);
        let name = format!("{:.1}M", f64::from(side).powi(3) / 1e6);
        group.throughput(Throughput::Elements(u64::from(side).pow(3)));
        group.bench_function(BenchmarkId::new("load", &name), |b| {
            b.iter(|| Hexes::new(black_box(&nodes), black_box(&corners)).expect("hexes"));
        });
        let hexes = Hexes::new(&nodes, &corners).expect("hexes");
        let oblique = DVec3::new(1.0, 0.6, 0.3);
        let plane = Section::new(oblique, oblique.dot(Point::splat(f64::from(side) / 2.0)));
        let cut = Cut { section: plane, ..Cut::default() };
        println!("{name}: {} faces are shown", hexes.shown(&cut).faces.len());
        group.bench_function(BenchmarkId::new("cells and faces", &name), |b| {
            b.iter(|| black_box(hexes.shown(black_box(&cut))));
        });
        group.bench_function(BenchmarkId::new("draw data", &name), |b| {
            b.iter(|| {
                let (surface, cells) = hexes.surface(black_box(&cut));
                black_box((surface.normals(), surface.triangles(0..surface.face_count()), cells))
            });
        });
    }
    group.finish();
}

criterion_group!(benches, section);
criterion_main!(benches);
