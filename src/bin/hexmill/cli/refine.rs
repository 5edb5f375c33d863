//! `hexmill refine`.

use std::path::Path;

use hexmill::io::{AnyMesh, Document};
use hexmill::refine::QuadOptions;

use super::args::{Making, RefineArgs};
use super::failure::Failure;
use super::files::{format_for_hexes, format_to_write, load};
use super::making::Made;
use super::mesh_report::{Counts, quality_table};
use super::progress::Progress;
use super::report::{DroppedFeatures, HexRefinementReport, OptionsReport, Report};
use super::words::counted;
use super::{refine_hexes, refine_surface};

/// What a refinement made, and of what.
pub(super) struct Refined {
    pub(super) before: Counts,
    pub(super) document: Document,
    /// Elements that are larger than asked for.
    pub(super) capped: usize,
    pub(super) options: OptionsReport,
    /// Of hexes.
    pub(super) work: Option<HexRefinementReport>,
    /// Of a surface.
    pub(super) dropped: Option<DroppedFeatures>,
    /// The regions that overlap no part of the input, as they were given.
    pub(super) idle_regions: Vec<String>,
}

/// Reads, refines, writes and reports.
pub(crate) fn run(args: &RefineArgs, quiet: bool) -> Result<(), Failure> {
    let output = args.output.clone().expect("an output is required but for a plan");
    let making = Making { output, working: args.working.clone() };
    let format = format_to_write(&making.output)?;
    // More than surfaces may have, whose limit is the higher one, is told before the file is read.
    deepest(args, QuadOptions::default().max_levels)?;
    let regions = args.regions.iter().filter_map(|region| Some(("a region's file", region.file()?)));
    let inputs: Vec<_> = std::iter::once(("the input", args.input.as_path())).chain(regions).collect();
    making.prepare(&inputs)?;
    let progress = Progress::new(quiet);

    let mut loaded = progress.stage("read", || load(&args.input))?;
    loaded.warn_of_dropped(quiet);
    let document = loaded.take_document();
    let refined = match document.mesh {
        AnyMesh::Hexes(_) => {
            format_for_hexes(&making.output)?;
            refine_hexes::refine(args, document, quiet, &progress)
        }
        _ => refine_surface::refine(args, document, &progress),
    };
    let Refined { before, document, capped, options, work, dropped, idle_regions } = refined?;

    let made =
        Made { command: "refine", input: (&loaded, before), document: &document, capped: Some(capped) };
    let report = making.write(&made, format, &progress, quiet)?;
    let (options, dropped_features) = (Some(options), dropped);
    let report = Report { options, refinement: work, dropped_features, idle_regions, ..report };
    making.close(report, &progress, quiet, in_words)
}

/// The deepest level: as given, or `default`. Refuses more levels than that.
pub(super) fn deepest(args: &RefineArgs, default: u8) -> Result<u8, Failure> {
    let most = args.max_levels.unwrap_or(default);
    match args.levels.filter(|&levels| levels > most) {
        None => Ok(most),
        Some(levels) => Err(Failure::Usage(format!(
            "--levels is {levels}, but --max-levels {most}; give fewer levels, or raise --max-levels"
        ))),
    }
}

/// What was made, for people.
fn in_words(path: &Path, report: &Report) -> String {
    let mesh = &report.mesh;
    let levels: Vec<String> =
        mesh.levels.iter().map(|count| format!("{} of level {}", count.cells, count.level)).collect();
    let mut lines =
        vec![format!("{}: {}", path.display(), mesh.counts.in_words()), format!("  {}", levels.join(", "))];
    if let Some(capped) = mesh.capped.filter(|&capped| capped > 0) {
        lines.push(format!(
            "  {} larger than asked for: raise --max-levels, now {}",
            counted(capped, "element is", "elements are"),
            report.options.as_ref().map_or(0, OptionsReport::max_levels)
        ));
    }
    lines.extend(report.refinement.iter().flat_map(|work| work.in_words(mesh.counts.hexes)));
    if let Some(DroppedFeatures { polylines, creases, corners }) = report.dropped_features {
        lines.push(format!(
            "  {}, {} and {} of the input do not go over to the mesh",
            counted(polylines, "polyline", "polylines"),
            counted(creases, "crease", "creases"),
            counted(corners, "corner", "corners")
        ));
    }
    lines.extend(report.idle_in_words());
    lines.extend(mesh.quality.as_ref().map(quality_table));
    lines.push(format!("  hash {}, {:.2} s", mesh.hash, report.seconds));
    lines.join("\n") + "\n"
}
