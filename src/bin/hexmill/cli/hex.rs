//! `hexmill hex`.

use std::path::Path;

use hexmill::hexing::background::BackgroundError;
use hexmill::hexing::{
    FitCounts, HexedSolid, HexingError, HexingOptions, HexingReport, ResultReport, SecondOrderReport,
    hex_solid,
};
use hexmill::io::Document;
use hexmill::refine::hex::HexRefineError;
use hexmill::solid::SolidError;

use super::args::HexArgs;
use super::failure::Failure;
use super::files::{format_for_hexes, format_for_second_order, load};
use super::making::Made;
use super::memory::{ADVICE, Limit};
use super::mesh_report::{Counts, quality_table};
use super::progress::Progress;
use super::report::{OptionsReport, Report, SolidOptions};
use super::words::counted;

/// Peak memory of the command in bytes a hex, about: models of 44 to 62 thousand hexes took 520 to 890, and 1,470 where
/// the solid itself is a good part of it.
const BYTES_PER_HEX: u64 = 1000;

/// Reads a closed surface, fills it with hexes, writes and reports.
pub(crate) fn run(args: &HexArgs, quiet: bool) -> Result<(), Failure> {
    let format = match args.second_order {
        Some(_) => format_for_second_order(&args.making.output)?,
        None => format_for_hexes(&args.making.output)?,
    };
    let regions = args.regions.iter().filter_map(|region| Some(("a region's file", region.file()?)));
    let inputs: Vec<_> = std::iter::once(("the input", args.input.as_path())).chain(regions).collect();
    args.making.prepare(&inputs)?;
    let mut options = options(args)?;
    let told = options_report(args, &options);
    let limit = Limit::new(options.max_hexes, HexingOptions::MOST_HEXES, BYTES_PER_HEX);
    options.max_hexes = limit.cells;
    let progress = Progress::new(quiet);

    let mut loaded = progress.stage("read", || load(&args.input))?;
    let surface = loaded.take_document().into_surface().ok_or_else(|| {
        let message = "holds hexes, but a closed surface is wanted; refine hexes with hexmill refine";
        Failure::refused("surface-needed", format!("{}: {message}", args.input.display()))
    })?;
    let before = Counts::of_polygons(&surface);
    let refused = |error: HexingError| refused(&args.input, &limit, &error);
    let hexed = hex_solid(surface, &options, &progress).map_err(refused)?;
    let idle = hexed.idle_regions(&options.regions, &progress).map_err(refused)?;
    let HexedSolid { mesh, second_order, report: work, .. } = hexed;

    let document = Document { second_order, ..Document::from(mesh) };
    let made = Made { command: "hex", input: (&loaded, before), document: &document, capped: None };
    let idle_regions = idle.iter().map(|&k| args.regions[k as usize].text.clone()).collect();
    let report = args.making.write(&made, format, &progress, quiet)?;
    let report = Report { options: Some(told), hexing: Some(work), idle_regions, ..report };
    args.making.close(report, &progress, quiet, in_words)
}

fn options(args: &HexArgs) -> Result<HexingOptions, Failure> {
    let default = HexingOptions::default();
    Ok(HexingOptions {
        edge_length: args.edge_length,
        regions: args.regions.iter().map(|region| region.load()).collect::<Result<_, _>>()?,
        background: args.background.into(),
        curvature: args.curvature,
        feature_angle: args.feature_angle,
        max_distance: args.max_distance,
        max_levels: args.max_levels.unwrap_or(default.max_levels),
        max_hexes: args.max_hexes.unwrap_or(default.max_hexes),
        second_order: args.second_order.map(Into::into),
    })
}

fn options_report(args: &HexArgs, options: &HexingOptions) -> OptionsReport {
    OptionsReport::Hexing(SolidOptions {
        edge_length: options.edge_length,
        regions: args.regions.iter().map(|region| region.text.clone()).collect(),
        background: options.background,
        curvature: options.curvature,
        feature_angle: options.feature_angle,
        max_distance: options.max_distance,
        max_levels: options.max_levels,
        max_hexes: options.max_hexes,
        second_order: options.second_order,
    })
}

/// The solid was not meshed, or the options make no sense.
fn refused(path: &Path, limit: &Limit, error: &HexingError) -> Failure {
    let file = path.display();
    let too_many = |hexes: u64| {
        let raise = || Failure::refused(error.code(), format!("{file}: {error} (--max-hexes)"));
        limit.exceeded(&file.to_string(), hexes, "hexes", ADVICE).unwrap_or_else(raise)
    };
    match error {
        HexingError::Option { .. }
        | HexingError::Solid(SolidError::Option { .. })
        | HexingError::Background(BackgroundError::Refine(
            HexRefineError::Option { .. } | HexRefineError::Sizing(_),
        )) => Failure::Usage(error.to_string()),
        HexingError::Background(BackgroundError::TooManyHexes { hexes, .. }) => too_many(*hexes as u64),
        HexingError::Background(BackgroundError::Refine(HexRefineError::TooManyHexes { hexes, .. })) => {
            too_many(*hexes)
        }
        _ => Failure::refused(error.code(), format!("{file}: {error}")),
    }
}

/// What was made, for people.
fn in_words(path: &Path, report: &Report) -> String {
    let mesh = &report.mesh;
    let mut lines = vec![format!("{}: {}", path.display(), mesh.counts.in_words())];
    lines.extend(report.hexing.iter().flat_map(work_in_words).map(|line| format!("  {line}")));
    lines.extend(report.idle_in_words());
    lines.extend(mesh.quality.as_ref().map(quality_table));
    lines.push(format!("  hash {}, {:.2} s", mesh.hash, report.seconds));
    lines.join("\n") + "\n"
}

/// What was done, and what the mesh does not show.
fn work_in_words(work: &HexingReport) -> Vec<String> {
    let result = work.result();
    let ResultReport { features, euler, solid_euler, distance, lost_bodies, crossings, .. } = result;
    let mended = work.solid.mended();
    let mut lines = Vec::new();
    if work.solid.voids > 0 {
        let voids =
            counted(work.solid.voids, "shell within a body is a void", "shells within bodies are voids");
        lines.push(voids);
    }
    if !mended.is_empty() {
        lines.push(format!("mended: {}", mended.join(", ")));
    }
    if work.solid.unmatched_edges > 0 {
        let unmatched = counted(
            work.solid.unmatched_edges,
            "edge of the file's lines is none of the surface, and no feature",
            "edges of the file's lines are none of the surface, and no features",
        );
        lines.push(unmatched);
    }
    let kinds = [("corners", features.corners), ("curves", features.curves), ("surfaces", features.surfaces)];
    let captured = kinds.map(|(kind, n)| format!("{} of {} {kind}", n.captured, n.found)).join(", ");
    lines.push(format!("captured {captured}"));
    let kinds = [
        ("curve shrank to a corner", "curves shrank to corners", &features.contracted),
        ("curve was lost", "curves were lost", &features.suppressed),
        ("surface was lost", "surfaces were lost", &features.lost_surfaces),
        (
            "body was lost, since no hex lies within it",
            "bodies were lost, since no hex lies within them",
            lost_bodies,
        ),
        (
            "surface has faces that go through others: make hexes there smaller",
            "surfaces have faces that go through others: make hexes there smaller",
            crossings,
        ),
    ];
    for (one, many, lost) in kinds.into_iter().filter(|(.., lost)| !lost.is_empty()) {
        let largest = lost.iter().max_by(|a, b| a.size.total_cmp(&b.size));
        let [x, y, z] = largest.map_or([0.0; 3], |lost| lost.place);
        lines.push(format!("{}, the largest at {x}, {y}, {z}", counted(lost.len(), one, many)));
    }
    if euler != solid_euler {
        lines.push(format!(
            "the boundary's Euler number is {euler}, the solid's {solid_euler}: parts or holes smaller than the edges \
             were lost; lower the edge length"
        ));
    }
    let kept = work.bodies.iter().filter_map(|body| body.attempts[body.kept?].mesh.as_ref());
    let off: Vec<&FitCounts> = kept.map(|mesh| &mesh.fit).filter(|fit| fit.off > 0).collect();
    if let Some(farthest) = off.iter().max_by(|a, b| a.farthest.total_cmp(&b.farthest)) {
        let [x, y, z] = farthest.place.unwrap_or_default();
        let nodes = counted(
            off.iter().map(|fit| fit.off).sum::<usize>(),
            "node is off its corner, curve or surface",
            "nodes are off their corner, curve or surface",
        );
        lines.push(format!("{nodes}, the farthest by {:.6e} at {x}, {y}, {z}", farthest.farthest));
    }
    lines.push(format!("distance to the solid: {}", distance.mesh_to_surface.in_words()));
    lines.push(format!("distance from the solid: {}", distance.surface_to_mesh.in_words()));
    if let Some(asked) = result.max_distance.filter(|_| result.is_too_far()) {
        lines.push(format!(
            "that is more than the {asked} asked for: lower the edge length, or raise --max-levels"
        ));
    }
    if let Some(SecondOrderReport { nodes, on_solid, yielded, .. }) = work.second_order {
        lines.push(format!(
            "{nodes} nodes beside the corners, {on_solid} of them on the solid, {yielded} off it for the sake of their hexes"
        ));
    }
    lines
}
