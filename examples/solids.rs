//! Meshes solids, and prints a table of how well and how fast.
//!
//! `cargo run --release --example solids -- FOLDER [CELLS] [NAME...]` meshes every OBJ file of FOLDER, or those whose
//! names hold a NAME, with edges of 1/CELLS (48) of the longest side on one thread. `-- parts [COUNT] [CELLS] [FIRST]` does
//! so with COUNT (200) random parts from the FIRST (0) on at a coarse edge length (CELLS is 12), and fails if one is not
//! meshed. `-- silence FOLDER [CELLS] [NAME...]` tells of each file how long meshing goes without asking whether to stop, and
//! without telling how far it is.

#[path = "../tests/native/hexing/csg.rs"]
mod csg;
mod listening;
#[path = "../tests/native/hexes/meshes.rs"]
#[allow(dead_code)]
mod meshes;

use std::borrow::Cow;
use std::error::Error;
use std::path::{Path, PathBuf};
use std::time::Instant;

use hexmill::Silent;
use hexmill::hexing::{AttemptReport, Background, BodyReport, HexingOptions, ResultReport, hex_solid};
use hexmill::io::{Format, read};
use hexmill::mesh::quality::aspect;
use hexmill::mesh::{PolygonMesh, check_hexes};
use listening::Listening;

/// The command line's allocator. `wasm-pack test` builds every example for the web, where there is none.
#[cfg(not(target_arch = "wasm32"))]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

type Failure = Box<dyn Error + Send + Sync>;

fn main() -> Result<(), Failure> {
    let mut arguments = std::env::args().skip(1);
    let source = arguments
        .next()
        .ok_or("wanted: [silence] FOLDER [CELLS] [NAME...], or parts [COUNT] [CELLS] [FIRST]")?;
    let rest: Vec<String> = arguments.collect();
    if source == "silence" {
        return silence(&rest);
    }
    let number = |k: usize, default: f64| rest.get(k).map_or(Ok(default), |text| text.parse::<f64>());
    let mut table = Table::new()?;
    if source == "parts" {
        let cells = number(1, 12.0)?;
        let first = number(2, 0.0)? as u64;
        for seed in first..first + number(0, 200.0)? as u64 {
            table.row(&format!("part {seed}"), cells, || Ok(csg::random_part(seed)));
        }
    } else {
        let cells = number(0, 48.0)?;
        for file in files(&source, rest.get(1..).unwrap_or_default())? {
            table.row(&name_of(&file), cells, || loaded(&file));
        }
    }
    if table.failed > 0 { Err(format!("{} solids failed", table.failed).into()) } else { Ok(()) }
}

/// Meshes the solids of a folder on one thread, and tells of each the longest silences.
fn silence(arguments: &[String]) -> Result<(), Failure> {
    let folder = arguments.first().ok_or("wanted: silence FOLDER [CELLS] [NAME...]")?;
    let cells = arguments.get(1).map_or(Ok(48.0), |text| text.parse::<f64>())?;
    let pool = one_thread()?;
    for file in files(folder, arguments.get(2..).unwrap_or_default())? {
        let surface = loaded(&file)?;
        let listening = Listening::new();
        let options = options(&surface, cells);
        let hexed = pool.install(|| hex_solid(&surface, &options, &listening))?;
        println!("{}: {} hexes", name_of(&file), hexed.mesh.hexes.len());
        for (what, silence) in ["asked", "told"].into_iter().zip(listening.longest()) {
            println!("  {what}: {silence}");
        }
    }
    Ok(())
}

fn one_thread() -> Result<rayon::ThreadPool, rayon::ThreadPoolBuildError> {
    rayon::ThreadPoolBuilder::new().num_threads(1).build()
}

fn loaded(file: &Path) -> Result<PolygonMesh, Failure> {
    read(&std::fs::read(file)?, Format::Obj)?.into_surface().ok_or("no surface".into())
}

fn name_of(file: &Path) -> Cow<'_, str> {
    file.file_stem().unwrap_or_default().to_string_lossy()
}

/// Edges of so many in the longest side.
fn options(surface: &PolygonMesh, cells: f64) -> HexingOptions {
    let bounds = surface.bounds();
    let edge_length = (bounds.max - bounds.min).max_element() / cells;
    HexingOptions { edge_length, ..HexingOptions::default() }
}

/// The OBJ files of a folder, or those whose names hold one of `names`.
fn files(folder: &str, names: &[String]) -> Result<Vec<PathBuf>, Failure> {
    let entries = std::fs::read_dir(folder)?.map(|entry| Ok(entry?.path()));
    let mut files: Vec<PathBuf> = entries.collect::<Result<_, std::io::Error>>()?;
    files.retain(|path| {
        let name = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or_default();
        let is_named = names.is_empty() || names.iter().any(|part| name.contains(part.as_str()));
        path.extension().is_some_and(|extension| extension == "obj") && is_named
    });
    files.sort();
    Ok(files)
}

/// Prints a row for each solid.
struct Table {
    pool: rayon::ThreadPool,
    failed: usize,
}

impl Table {
    fn new() -> Result<Self, Failure> {
        println!(
            "| solid | hexes | worst | mean | aspect | distance, % | Euler | curves | surfaces | tries | seconds |"
        );
        println!("|---|---|---|---|---|---|---|---|---|---|---|");
        Ok(Self { pool: one_thread()?, failed: 0 })
    }

    fn row(&mut self, name: &str, cells: f64, load: impl FnOnce() -> Result<PolygonMesh, Failure> + Send) {
        match self.pool.install(|| load().and_then(|surface| cells_of_row(&surface, cells))) {
            Ok(cells) => println!("| {name} | {} |", cells.join(" | ")),
            Err(error) => {
                println!("| {name} | {error} |");
                self.failed += 1;
            }
        }
    }
}

fn cells_of_row(surface: &PolygonMesh, cells: f64) -> Result<Vec<String>, Failure> {
    let bounds = surface.bounds();
    let start = Instant::now();
    let hexed = hex_solid(surface, &options(surface, cells), &Silent)?;
    let seconds = start.elapsed().as_secs_f64();
    if let Some(defect) = check_hexes(&hexed.mesh).first() {
        return Err(defect.to_string().into());
    }
    let made = hexed.report.result();
    let (curves, surfaces) = (made.features.curves, made.features.surfaces);
    let aspects = hexed.mesh.hexes.iter().map(|hex| aspect(&hex.map(|n| hexed.mesh.positions[n.index()])));
    Ok(vec![
        made.hexes.to_string(),
        format!("{:.3}", made.worst),
        format!("{:.3}", made.mean),
        format!("{:.0}", aspects.fold(1.0, f64::max)),
        format!("{:.3}", 100.0 * made.distance.hausdorff() / (bounds.max - bounds.min).length()),
        euler(made),
        format!("{} of {}", curves.captured, curves.found),
        format!("{} of {}", surfaces.captured, surfaces.found),
        hexed.report.bodies.iter().map(tries).collect::<Vec<_>>().join(", "),
        format!("{seconds:.1}"),
    ])
}

/// The Euler number, and how many bodies are not in the mesh, since they are too thin.
fn euler(made: &ResultReport) -> String {
    let lost = made.lost_bodies.len();
    let lost = if lost > 0 { format!(", bodies lost: {lost}") } else { String::new() };
    format!("{} of {}{lost}", made.euler, made.solid_euler)
}

/// The attempts of a body: of each the background, its levels if there are several, and marks where it was given up; the
/// one that was kept in brackets.
fn tries(body: &BodyReport) -> String {
    let of = |(number, attempt): (usize, &AttemptReport)| {
        let kind = match attempt.background {
            Background::Swept => "S",
            Background::Octree => "O",
            _ => "G",
        };
        let levels = if attempt.levels.len() > 1 { attempt.levels.len().to_string() } else { String::new() };
        let marks =
            [(attempt.keep_thin, "t"), (attempt.features.is_none(), "!"), (attempt.mesh.is_none(), "!")];
        let marks: String = marks.iter().filter(|(is, _)| *is).map(|(_, mark)| *mark).collect();
        let text = format!("{kind}{levels}{marks}");
        if body.kept == Some(number) { format!("[{text}]") } else { text }
    };
    body.attempts.iter().enumerate().map(of).collect::<Vec<_>>().join(" ")
}
