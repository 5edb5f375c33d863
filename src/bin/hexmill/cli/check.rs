//! `hexmill check`.

use std::path::Path;

use hexmill::io::{AnyMesh, Document};
use hexmill::mesh::check::{DefectCount, Severity};
use hexmill::mesh::topology::hex_boundary;
use hexmill::mesh::{Distances, Quads, Triangles, Volumes};

use super::args::CheckArgs;
use super::failure::Failure;
use super::files::{check_outputs, format_to_read, load};
use super::making::use_threads;
use super::mesh_report::{MeshReport, Topology, quality_table};
use super::progress::Progress;
use super::region::{load_triangles, triangles_of};
use super::report::{InputReport, Report, peak_memory_bytes};
use super::tell::print;
use super::words::counted;

/// Reads a mesh, looks it over and tells; refuses a mesh that does not conform.
pub(crate) fn run(args: &CheckArgs, quiet: bool) -> Result<(), Failure> {
    format_to_read(&args.mesh)?;
    args.working.threads.map_or(Ok(()), use_threads)?;
    let surface = args.surface.as_deref().map(|path| ("--surface", path));
    let inputs: Vec<_> = std::iter::once(("the mesh", args.mesh.as_path())).chain(surface).collect();
    let outputs: Vec<_> = args.working.report.iter().map(|path| ("--report", path.as_path())).collect();
    check_outputs(&inputs, &outputs)?;
    let progress = Progress::new(quiet);
    let mut loaded = progress.stage("read", || load(&args.mesh))?;
    loaded.warn_of_dropped(quiet);
    let document = loaded.take_document();
    let mut mesh = progress.stage("measure", || MeshReport::of(&document, None));
    progress.stage("check", || mesh.check(&document.mesh));
    let mut report = Report::new("check", InputReport::new(&loaded, mesh.counts), mesh);
    report.distance = match &args.surface {
        Some(path) => {
            let (positions, triangles) = progress.stage("read", || load_triangles(path))?;
            let surface = Triangles { positions: &positions, triangles: &triangles };
            Some(distances(document, surface, &args.mesh, &progress)?)
        }
        None => None,
    };
    (report.stages, report.seconds) = progress.finish();
    report.peak_memory_bytes = peak_memory_bytes();
    args.working.report.as_deref().map_or(Ok(()), |path| report.save(path))?;
    if !quiet {
        print(&in_words(args, &report))?;
    }
    verdict(args, &report)
}

/// Distances between the faces of a document, or the boundary of its hexes, and a surface.
fn distances(
    document: Document,
    surface: Triangles<'_>,
    path: &Path,
    progress: &Progress,
) -> Result<Distances, Failure> {
    let measured = if let AnyMesh::Hexes(mesh) = &document.mesh {
        let quads: Vec<_> = hex_boundary(&mesh.hexes).into_iter().map(|(quad, _)| quad).collect();
        Distances::of_quads(Quads { positions: &mesh.positions, quads: &quads }, surface, progress)
    } else {
        let faces = document.into_surface().expect("hexes are told apart here");
        let triangles = triangles_of(&faces, path)?;
        let mesh = Triangles { positions: &faces.positions, triangles: &triangles };
        Distances::between(mesh, surface, progress)
    };
    Ok(measured.expect("nothing stops the command line"))
}

/// Refuses a mesh that does not conform.
fn verdict(args: &CheckArgs, report: &Report) -> Result<(), Failure> {
    let refused = report.mesh.defects.as_ref().filter(|defects| !defects.conforming);
    let Some(worst) = refused.and_then(|defects| defects.counts.first()) else { return Ok(()) };
    let message = format!("{}: is not a conforming mesh: {worst}; mend the mesh", args.mesh.display());
    Err(Failure::refused("mesh-not-conforming", message))
}

fn in_words(args: &CheckArgs, report: &Report) -> String {
    let mesh = &report.mesh;
    let mut lines = vec![format!("{}: {}", args.mesh.display(), mesh.counts.in_words())];
    lines.extend(mesh.topology.as_ref().map(topology_line));
    if let Some(Volumes { total, min, max }) = mesh.volume {
        lines.push(format!("  volume {total}, of a hex {min} to {max}"));
    }
    lines.extend(mesh.quality.as_ref().map(quality_table));
    if let Some(defects) = &mesh.defects {
        lines.extend(defects.counts.iter().map(defect_line));
        if defects.counts.is_empty() {
            lines.push("  no defects".to_owned());
        }
    }
    if let Some(distance) = &report.distance {
        lines.push(format!("  distance to the surface: {}", distance.mesh_to_surface.in_words()));
        lines.push(format!("  distance from the surface: {}", distance.surface_to_mesh.in_words()));
    }
    lines.push(format!("  hash {}", mesh.hash));
    lines.join("\n") + "\n"
}

fn topology_line(topology: &Topology) -> String {
    match topology {
        Topology::Surface(t) => format!(
            "  components {}, boundary loops {} ({}), Euler number {}, {}, {}",
            t.components,
            t.boundary_loops,
            counted(t.boundary_edges, "edge", "edges"),
            t.euler,
            if t.is_manifold() { "manifold" } else { "not manifold" },
            if t.orientable { "orientable" } else { "not orientable" },
        ),
        Topology::Solid(t) => format!(
            "  components {}, boundary surfaces {} ({}), Euler number {}, {}",
            t.components,
            t.boundary_components,
            counted(t.boundary_faces, "face", "faces"),
            t.euler,
            if t.is_manifold() { "manifold" } else { "not manifold" },
        ),
    }
}

fn defect_line(defect: &DefectCount) -> String {
    let severity = match defect.severity {
        Severity::Error => "error",
        Severity::Note => "note",
    };
    format!("  {severity}: {defect}")
}
