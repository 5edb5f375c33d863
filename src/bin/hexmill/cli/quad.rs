//! `hexmill quad`.

use std::path::Path;

use hexmill::hexing::face::{PlanarQuads, RegionOptions, quad_planar_faces};
use hexmill::io::Document;

use super::args::QuadArgs;
use super::failure::Failure;
use super::files::{format_to_write, load};
use super::making::Made;
use super::mesh_report::{Counts, quality_table};
use super::progress::Progress;
use super::report::{FaceReport, Report};
use super::words::counted;

/// Meshes planar faces with quads alone.
pub(crate) fn run(args: &QuadArgs, quiet: bool) -> Result<(), Failure> {
    let format = format_to_write(&args.making.output)?;
    args.making.prepare(&[("the input", &args.input)])?;
    let options = options(args);
    let progress = Progress::new(quiet);

    let mut loaded = progress.stage("read", || load(&args.input))?;
    let faces = loaded.take_document().into_surface().ok_or_else(|| {
        let message = "holds hexes, but a planar face of polygons is wanted";
        Failure::refused("not-a-face", format!("{}: {message}", args.input.display()))
    })?;
    let before = Counts::of_polygons(&faces);
    let PlanarQuads { mesh, off_curve, dropped } = quad_planar_faces(&faces, &options, &progress)
        .map_err(|e| Failure::refused(e.code(), format!("{}: {e}", args.input.display())))?;
    drop(faces);

    let made =
        Made { command: "quad", input: (&loaded, before), document: &Document::from(mesh), capped: None };
    let RegionOptions { edge_length, max_quads } = options;
    let face = FaceReport { edge_length, max_quads, off_curve, dropped_polylines: dropped };
    let report = Report { face: Some(face), ..args.making.write(&made, format, &progress, quiet)? };
    args.making.close(report, &progress, quiet, in_words)
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
            let nodes = counted(face.off_curve.len(), "node is off its curve", "nodes are off their curves");
            lines.push(format!("  {nodes}: lower --edge-length"));
        }
        if !face.dropped_polylines.is_empty() {
            lines.push(format!(
                "  {} along the outline or another one, or outside",
                counted(face.dropped_polylines.len(), "polyline lies", "polylines lie")
            ));
        }
    }
    lines.extend(report.mesh.quality.as_ref().map(quality_table));
    lines.push(format!("  hash {}, {:.2} s", report.mesh.hash, report.seconds));
    lines.join("\n") + "\n"
}
