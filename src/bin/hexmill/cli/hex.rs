//! `hexmill hex`.

use std::path::Path;

use hexmill::hexing::{HexedSolid, HexingError, HexingOptions, hex_solid};
use hexmill::io::Document;

use super::args::HexArgs;
use super::failure::Failure;
use super::files::{format_for_hexes, load};
use super::making::Made;
use super::mesh_report::{Counts, quality_table};
use super::progress::Progress;
use super::report::Report;

/// Reads a closed surface, fills it with hexes, writes and reports.
pub(crate) fn run(args: &HexArgs, quiet: bool) -> Result<(), Failure> {
    let format = format_for_hexes(&args.making.output)?;
    args.making.prepare(&[("the input", &args.input)])?;
    let options = options(args);
    let progress = Progress::new(quiet);

    let mut loaded = progress.stage("read", || load(&args.input))?;
    let surface = loaded.take_document().into_surface().ok_or_else(|| {
        let message = "holds hexes, but a closed surface is wanted; refine hexes with hexmill refine";
        Failure::refused("surface-needed", format!("{}: {message}", args.input.display()))
    })?;
    let before = Counts::of_polygons(&surface);
    let HexedSolid { mesh, report: work, .. } =
        hex_solid(&surface, &options, &progress).map_err(|error| refused(&args.input, &error))?;
    drop(surface);

    let made = Made { command: "hex", input: (&loaded, before), document: &Document::from(mesh), capped: 0 };
    let report = Report { hexing: Some(work), ..args.making.write(&made, format, &progress)? };
    args.making.close(report, &progress, quiet, in_words)
}

fn options(args: &HexArgs) -> HexingOptions {
    HexingOptions {
        edge_length: args.edge_length,
        feature_angle: args.feature_angle,
        max_hexes: args.max_hexes.unwrap_or(HexingOptions::default().max_hexes),
    }
}

/// The solid was not meshed, or the options make no sense.
fn refused(path: &Path, error: &HexingError) -> Failure {
    match error {
        HexingError::Option { .. } => Failure::Usage(error.to_string()),
        _ => Failure::refused(error.code(), format!("{}: {error}", path.display())),
    }
}

/// What was made, for people.
fn in_words(path: &Path, report: &Report) -> String {
    let mesh = &report.mesh;
    let mut lines = vec![format!("{}: {}", path.display(), mesh.counts.in_words())];
    if let Some(work) = &report.hexing {
        let made = work.result();
        let kinds = [
            ("corners", made.features.corners),
            ("curves", made.features.curves),
            ("surfaces", made.features.surfaces),
        ];
        let features = kinds.map(|(kind, n)| format!("{} of {} {kind}", n.captured, n.found)).join(", ");
        lines.push(format!("  captured {features}"));
        if !made.core.has_right_euler() {
            let (ours, wanted) = (made.core.euler, made.core.solid_euler);
            lines.push(format!(
                "  the boundary's Euler number is {ours}, the solid's {wanted}: parts or holes smaller than the edges \
                 were lost; lower the edge length"
            ));
        }
        let distance = &made.distance;
        lines.push(format!("  distance to the solid: {}", distance.mesh_to_surface.in_words()));
        lines.push(format!("  distance from the solid: {}", distance.surface_to_mesh.in_words()));
    }
    lines.extend(mesh.quality.as_ref().map(quality_table));
    lines.push(format!("  hash {}, {:.2} s", mesh.hash, report.seconds));
    lines.join("\n") + "\n"
}
