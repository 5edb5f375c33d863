//! Refines the worlds that refinement of hexes is held to, in full, and prints what came of them.
//!
//! `cargo run --release --example acceptance` runs 100 random sets of one and of two levels in 8 x 8 x 8 cells, all 254
//! sets of octants around a node, 40 sets on an I-beam, and the named worlds, with Methods I and II, and worlds with warped
//! faces with 3-refinement too; it fails where a bound does not hold. `-- silence` tells how long a large refinement goes without asking whether to stop; `-- sets`, `-- octants`, `-- beam`, `-- named` or `-- warped` run some of it; `-- write FOLDER` writes the named worlds as VTU files.

#[path = "../tests/native/hexes/acceptance.rs"]
mod acceptance;
mod listening;
#[path = "../tests/native/hexes/meshes.rs"]
mod meshes;
#[path = "../benches/shell.rs"]
mod shell;

use std::time::Instant;

use acceptance::{Judged, MOST_GROWTH, World, judged, named, octants, random_on_beam, random_set, warped};
use hexmill::io::{Document, Format, write};
use hexmill::refine::hex::{Method, refine_hexes};
use listening::Listening;
use rayon::prelude::*;

const METHODS: [Method; 2] = [Method::One, Method::Two];

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let arguments: Vec<String> = std::env::args().skip(1).collect();
    let chosen = arguments.first().map(String::as_str);
    let runs = |part: &str| chosen.is_none_or(|chosen| chosen == part);
    let mut failed = 0;
    if runs("sets") {
        for levels in [1, 2] {
            failed += sets(&format!("100 sets of {levels} levels"), 100, MOST_GROWTH, |seed| {
                random_set(4, seed, 100, levels)
            });
        }
    }
    if runs("octants") {
        failed +=
            sets("254 sets of octants around a node", 254, f64::INFINITY, |seed| octants(seed as u32 + 1));
    }
    if runs("beam") {
        failed += sets("40 sets on the I-beam", 40, f64::INFINITY, |seed| random_on_beam(seed, 40));
    }
    if runs("named") || chosen == Some("write") {
        for world in named(3) {
            for (method, least) in METHODS.into_iter().zip(world.least) {
                let start = Instant::now();
                let Judged { refined, worst, mean } = judged(&world, method);
                let fails = if worst < least { "  FAILS" } else { "" };
                println!(
                    "{}, {method:?}: {} hexes, worst {worst:.3}, mean {mean:.3}, {:?}, {:.1} s{fails}",
                    world.name,
                    refined.mesh.hexes.len(),
                    refined.added,
                    start.elapsed().as_secs_f64()
                );
                failed += usize::from(worst < least);
                if let (Some("write"), Some(folder)) = (chosen, arguments.get(1)) {
                    let bytes = write(&Document::from(refined), Format::Vtu)?;
                    let name = format!("{} {method:?}.vtu", world.name).replace([' ', ',', '\''], "-");
                    std::fs::write(std::path::Path::new(folder).join(name), bytes)?;
                }
            }
        }
    }
    if runs("warped") {
        for (world, least_in_thirds) in warped() {
            let bounds = [world.least[0], world.least[1], least_in_thirds];
            for (method, least) in [Method::One, Method::Two, Method::Three].into_iter().zip(bounds) {
                let Judged { refined, worst, mean } = judged(&world, method);
                let fails = if worst < least { "  FAILS" } else { "" };
                let hexes = refined.mesh.hexes.len();
                println!(
                    "{}, {method:?}: {hexes} hexes, worst {worst:.3}, mean {mean:.3}{fails}",
                    world.name
                );
                failed += usize::from(worst < least);
            }
        }
    }
    if chosen == Some("silence") {
        silence();
    }
    if failed > 0 { Err(format!("{failed} bounds do not hold").into()) } else { Ok(()) }
}

/// What came of one world.
struct Found {
    worst: f64,
    least: f64,
    growth: f64,
    /// Elements that were refined for the method, conflicts and repairs.
    added: [usize; 3],
}

/// Refines many worlds by both methods; returns how many are worse than their bound. Method II may let the refined sets
/// become `grown` times as large, in the mean.
fn sets(name: &str, count: u64, grown: f64, world: impl Fn(u64) -> World + Sync) -> usize {
    let mut failed = 0;
    for (k, method) in METHODS.into_iter().enumerate() {
        let start = Instant::now();
        let found: Vec<Found> =
            (0..count).into_par_iter().map(|seed| find(&world(seed), method, k)).collect();
        let worst = found.iter().map(|found| found.worst).fold(f64::INFINITY, f64::min);
        let growth = found.iter().map(|found| found.growth).sum::<f64>() / found.len() as f64;
        let [filled, conflicts, repairs] = [0, 1, 2].map(|k| found.iter().map(|f| f.added[k]).sum::<usize>());
        println!(
            "{name}, {method:?}: worst {worst:.3}, mean growth {growth:.3}; added: method {filled}, conflicts \
             {conflicts}, repairs {repairs}; {:.1} s",
            start.elapsed().as_secs_f64()
        );
        failed += found.iter().filter(|found| found.worst < found.least).count();
        if method == Method::Two && growth > grown {
            println!("{name}, {method:?}: the refined set grows by more than {grown}  FAILS");
            failed += 1;
        }
    }
    failed
}

fn find(world: &World, method: Method, k: usize) -> Found {
    let judged = judged(world, method);
    let (worst, least, added) = (judged.worst, world.least[k], judged.refined.added);
    if worst < least {
        println!("{}, {method:?}: worst {worst:.3}  FAILS", world.name);
    }
    let added = [added.closure.method, added.conflicts, added.repairs];
    Found { worst, least, growth: judged.growth(), added }
}

/// Refines shells, at last one in many cubes.
fn silence() {
    for (name, n, level) in shell::SIZES.into_iter().chain([("many cubes", 60, 2)]) {
        let input = shell::cubes(n);
        for method in [Method::One, Method::Two, Method::Three] {
            let level = if method == Method::Three { level / 2 + 1 } else { level };
            let listening = Listening::new();
            let options = shell::shell(n, level, method);
            let hexes =
                refine_hexes(&input, &options, &listening).expect("a shell in cubes").mesh.hexes.len();
            let [asked, _] = listening.longest();
            println!("{name}, {method:?}: {hexes} hexes, {asked}");
        }
    }
}
