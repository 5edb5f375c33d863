//! Times one refinement on the processor at hand: what `npm run bench` runs beside the same work in wasm.
//!
//! `cargo run --release --example throughput -- MESH OPTIONS.json THREADS RUNS` prints a line of JSON: the best of RUNS in
//! seconds, of hexes those spent in smoothing too, the cells made, and the peak memory of the process beyond the loaded mesh.

use std::error::Error;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use hexmill::io::{AnyMesh, detect, read};
use hexmill::mesh::mesh_hash;
use hexmill::refine::hex::refine_hexes;
use hexmill::refine::refine_quads;
use hexmill::{Monitor, Silent, Stage};
use serde_json::json;

/// The command line's allocator. `wasm-pack test` builds every example for the web, where there is none.
#[cfg(not(target_arch = "wasm32"))]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let [mesh, options, threads, runs] = arguments.as_slice() else {
        return Err("wanted: MESH OPTIONS.json THREADS RUNS".into());
    };
    let bytes = std::fs::read(mesh)?;
    let input = read(&bytes, detect(&bytes)?)?.mesh;
    drop(bytes);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.parse()?).build()?;
    let before = peak_memory();

    let mut best: Option<Run> = None;
    for _ in 0..runs.parse::<u32>()? {
        let run = pool.install(|| refined(&input, options)).map_err(|error| error as Box<dyn Error>)?;
        if best.as_ref().is_none_or(|best| run.time < best.time) {
            best = Some(run);
        }
    }
    let Run { time, smoothing, cells, hash } = best.ok_or("RUNS is 0")?;
    let peak_bytes = peak_memory().zip(before).map(|(after, before)| after - before);
    println!(
        "{}",
        json!({
            "seconds": time.as_secs_f64(), "smoothing": smoothing.as_secs_f64(), "cells": cells, "hash": hash,
            "peakBytes": peak_bytes,
        })
    );
    Ok(())
}

/// One refinement.
struct Run {
    time: Duration,
    smoothing: Duration,
    cells: usize,
    hash: String,
}

fn refined(input: &AnyMesh, options: &str) -> Result<Run, Box<dyn Error + Send + Sync>> {
    let start = Instant::now();
    match input {
        AnyMesh::Polygons(surface) => {
            let refined = refine_quads(surface, &serde_json::from_str(options)?, &Silent)?;
            let (time, mesh) = (start.elapsed(), refined.mesh);
            let hash = mesh_hash(&mesh.positions, &mesh.quads).to_string();
            Ok(Run { time, smoothing: Duration::ZERO, cells: mesh.quads.len(), hash })
        }
        AnyMesh::Hexes(hexes) => {
            let clock = Clock(Mutex::new((None, Duration::ZERO)));
            let refined = refine_hexes(hexes, &serde_json::from_str(options)?, &clock)?;
            let (time, mesh) = (start.elapsed(), refined.mesh);
            let hash = mesh_hash(&mesh.positions, &mesh.hexes).to_string();
            let (_, smoothing) = clock.0.into_inner().map_err(|_| "a thread panicked")?;
            Ok(Run { time, smoothing, cells: mesh.hexes.len(), hash })
        }
        AnyMesh::Quads(_) => Err("quads are read as polygons".into()),
    }
}

/// Sums up the time that is spent in smoothing: since when it goes on, and how long it took before.
struct Clock(Mutex<(Option<Instant>, Duration)>);

impl Monitor for Clock {
    fn progress(&self, stage: Stage, fraction: f64) {
        let Ok(mut clock) = self.0.lock() else { return };
        let smooths = matches!(stage.0, "opening" | "untangling" | "smoothing");
        match clock.0 {
            Some(since) if !smooths || fraction >= 1.0 && stage.0 != "untangling" => {
                clock.1 += since.elapsed();
                clock.0 = None;
            }
            None if smooths && fraction < 1.0 => clock.0 = Some(Instant::now()),
            _ => {}
        }
    }

    fn cancelled(&self) -> bool {
        false
    }
}

/// The most memory that this process has had so far, in bytes, where the system tells.
fn peak_memory() -> Option<u64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM:"))?;
    line.split_whitespace().nth(1)?.parse::<u64>().ok().map(|kib| kib * 1024)
}
