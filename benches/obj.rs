//! The OBJ reader and writer: bytes per second on one thread.
//!
//! `cargo bench --bench obj`; a quad sheet of 100 MB with six decimals a coordinate, as exporters write it.

use std::fmt::Write;
use std::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use hexmill::io::obj;

/// Nodes along a side of the sheet.
const SIDE: usize = 1290;

fn sheet() -> String {
    let mut text = String::new();
    for node in 0..SIDE * SIDE {
        // Digits that do not repeat; the shape does not matter.
        let x = (node as f64 * 0.618_033_988_75).fract();
        let y = (node as f64 * 0.754_877_666_25).fract();
        writeln!(text, "v {:.6} {:.6} {:.6}", 10.0 * x, -100.0 * y, x * y).expect("text takes text");
    }
    for row in 0..SIDE - 1 {
        for column in 1..SIDE {
            let a = row * SIDE + column;
            writeln!(text, "f {} {} {} {}", a, a + 1, a + SIDE + 1, a + SIDE).expect("text takes text");
        }
    }
    text
}

fn read_and_write(c: &mut Criterion) {
    let text = sheet();
    let document = obj::read(text.as_bytes()).expect("the sheet is OBJ");
    let written = obj::write(&document).expect("the sheet is finite");
    let mut group = c.benchmark_group("obj");
    group.sample_size(10);
    group.throughput(Throughput::Bytes(text.len() as u64));
    group.bench_function("read", |b| b.iter(|| obj::read(black_box(text.as_bytes()))));
    group.throughput(Throughput::Bytes(written.len() as u64));
    group.bench_function("write", |b| b.iter(|| obj::write(black_box(&document))));
    group.finish();
}

criterion_group!(benches, read_and_write);
criterion_main!(benches);
