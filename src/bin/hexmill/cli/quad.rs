//! `hexmill quad`.

use std::path::Path;

use hexmill::hexing::face::{PlanarQuads, RegionOptions, quad_planar_faces};
use hexmill::io::{self, Document};

use super::args::QuadArgs;
use super::failure::Failure;
use super::files::{check_outputs, format_of, load, save};
use super::mesh_report::{Counts, MeshReport, quality_table};
use super::progress::Progress;
use super::report::{FaceReport, FileReport, InputReport, Report, peak_memory_bytes};

/// Meshes planar faces with quads alone.
pub(crate) fn run(args: &QuadArgs, quiet: bool) -> Result<(), Failure> {
    let format = format_of(&args.output)?;
    format_of(&args.input)?;
    let report = args.report.as_deref().map(|path| ("--report", path));
    let outputs: Vec<_> = std::iter::once(("--output", args.output.as_path())).chain(report).collect();
    check_outputs(&[("the input", args.input.as_path())], &outputs)?;
    let progress = Progress::new(quiet);

    let mut loaded = progress.stage("read", || load(&args.input))?;
    let holes = Document::from(hexmill::mesh::PolygonMesh::default());
    let faces = std::mem::replace(&mut loaded.document, holes).into_surface().ok_or_else(|| {
        let message = format!("{}: it holds hexes; give a planar face of polygons", args.input.display());
        Failure::refused("not-a-face", message)
    })?;
    let options = options(args);
    let refused = |e: hexmill::hexing::face::FaceError| {
        Failure::refused(e.code(), format!("{}: {e}", args.input.display()))
    };
    let before = Counts::of_polygons(&faces);
    let PlanarQuads { mesh, off_curve, dropped } =
        quad_planar_faces(&faces, &options, &progress).map_err(refused)?;

    let document = Document::from(mesh);
    let bytes = progress
        .stage("encode", || io::write(&document, format))
        .map_err(|e| Failure::write(&args.output, &e))?;
    progress.stage("write", || save(&args.output, &bytes))?;
    let output = FileReport::new(&args.output, format, bytes.len() as u64);
    let mut mesh = progress.stage("measure", || MeshReport::of(&document, 0));
    if args.report.is_some() {
        progress.stage("check", || mesh.check(&document.mesh));
    }
    let mut report = Report::new("quad", InputReport::new(&loaded, before), mesh);
    let RegionOptions { edge_length, max_quads } = options;
    report.face = Some(FaceReport { edge_length, max_quads, off_curve, dropped_polylines: dropped });
    report.output = Some(output);
    (report.stages, report.seconds) = progress.finish();
    report.peak_memory_bytes = peak_memory_bytes();
    if !quiet {
        print!("{}", in_words(&args.output, &report));
    }
    args.report.as_deref().map_or(Ok(()), |path| report.save(path))
}

fn options(args: &QuadArgs) -> RegionOptions {
    let default = RegionOptions::new(args.edge_length);
    RegionOptions { max_quads: args.max_quads.unwrap_or(default.max_quads), ..default }
}

/// What was made, for people.
fn in_words(path: &Path, report: &Report) -> String {
    let mut lines = vec![format!("{}: {}", path.display(), report.mesh.counts.in_words())];
    if let Some(face) = &report.face {
        if !face.off_curve.is_empty() {
            lines.push(format!("  {} nodes are off their curves: lower --edge-length", face.off_curve.len()));
        }
        if !face.dropped_polylines.is_empty() {
            lines.push(format!(
                "  {} polylines lie along the outline or another one, or outside",
                face.dropped_polylines.len()
            ));
        }
    }
    lines.extend(report.mesh.quality.as_ref().map(quality_table));
    lines.push(format!("  hash {}, {:.2} s", report.mesh.hash, report.seconds));
    lines.join("\n") + "\n"
}
