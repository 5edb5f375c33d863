//! Times one refinement on the processor at hand: what `npm run bench` runs beside the same work in wasm.
//!
//! `cargo run --release --example throughput -- SURFACE.obj OPTIONS.json THREADS RUNS` prints a line of JSON: the
//! best of RUNS in seconds, the quads made, and the peak memory of the process beyond the loaded surface.

use std::error::Error;
use std::time::{Duration, Instant};

use hexmill::Silent;
use hexmill::io::{AnyMesh, Format, read};
use hexmill::mesh::mesh_hash;
use hexmill::refine::{QuadOptions, refine_quads};

/// The command line's allocator. `wasm-pack test` builds every example for the web, where there is none.
#[cfg(not(target_arch = "wasm32"))]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [surface, options, threads, runs] = arguments.as_slice() else {
        return Err("wanted: SURFACE.obj OPTIONS.json THREADS RUNS".into());
    };
    let AnyMesh::Polygons(input) = read(&std::fs::read(surface)?, Format::Obj)?.mesh else {
        return Err(format!("{surface} holds no surface").into());
    };
    let options: QuadOptions = serde_json::from_str(options)?;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build()?;
    let before = peak_memory();

    let mut best = Duration::MAX;
    let (mut quads, mut hash) = (0, String::new());
    for _ in 0..runs.parse::<u32>()? {
        let start = Instant::now();
        let refined = pool.install(|| refine_quads(&input, &options, &Silent))?;
        best = best.min(start.elapsed());
        quads = refined.mesh.quads.len();
        hash = mesh_hash(&refined.mesh.positions, &refined.mesh.quads).to_string();
    }
    let bytes = peak_memory().zip(before).map(|(after, before)| after - before);
    println!(
        "{}",
        serde_json::json!({ "seconds": best.as_secs_f64(), "quads": quads, "hash": hash, "peakBytes": bytes })
    );
    Ok(())
}

/// The most memory that this process has had so far, in bytes, where the system tells.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse::<u64>().ok().map(|kib| kib * 1024)
}
