//! `hexmill refine`.

use std::path::Path;

use hexmill::io::{AnyMesh, Document};
use hexmill::mesh::PolygonMesh;
use hexmill::refine::QuadOptions;

use super::args::RefineArgs;
use super::deliver::Delivery;
use super::failure::Failure;
use super::files::{check_outputs, format_of, load};
use super::mesh_report::{Counts, quality_table};
use super::progress::Progress;
use super::report::{HexRefinementReport, OptionsReport, Report, peak_memory_bytes};
use super::threads::use_threads;
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
}

/// Reads, refines, writes and reports.
pub(crate) fn run(args: &RefineArgs, quiet: bool) -> Result<(), Failure> {
    let format = format_of(&args.output)?;
    format_of(&args.input)?;
    check_levels(args)?;
    check_files(args)?;
    use_threads(args.threads)?;
    let progress = Progress::new(quiet);

    let mut loaded = progress.stage("read", || load(&args.input))?;
    loaded.warn_of_dropped_faces(quiet);
    let empty = Document::from(PolygonMesh::default());
    let document = std::mem::replace(&mut loaded.document, empty);
    let refined = match document.mesh {
        AnyMesh::Hexes(_) => refine_hexes::refine(args, document, quiet, &progress),
        _ => refine_surface::refine(args, document, &progress),
    };
    let Refined { before, document, capped, options, work } = refined?;

    let delivery = Delivery {
        command: "refine",
        input: (&loaded, before),
        document: &document,
        capped,
        output: &args.output,
        format,
        is_checked: args.report.is_some(),
    };
    let mut report = delivery.write(&progress)?;
    (report.options, report.refinement) = (Some(options), work);
    (report.stages, report.seconds) = progress.finish();
    report.peak_memory_bytes = peak_memory_bytes();
    if !quiet {
        print!("{}", in_words(&args.output, &report));
    }
    args.report.as_deref().map_or(Ok(()), |path| report.save(path))
}

/// Refuses outputs that are inputs, or each other.
fn check_files(args: &RefineArgs) -> Result<(), Failure> {
    let regions = args.regions.iter().filter_map(|region| Some(("a region's file", region.file()?)));
    let inputs: Vec<_> = std::iter::once(("the input", args.input.as_path())).chain(regions).collect();
    let report = args.report.as_deref().map(|path| ("--report", path));
    let outputs: Vec<_> = std::iter::once(("--output", args.output.as_path())).chain(report).collect();
    check_outputs(&inputs, &outputs)
}

/// Refuses more levels than there may be.
fn check_levels(args: &RefineArgs) -> Result<(), Failure> {
    let most = args.max_levels.unwrap_or(QuadOptions::default().max_levels);
    match args.levels.filter(|&levels| levels > most) {
        None => Ok(()),
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
    if mesh.capped > 0 {
        lines.push(format!(
            "  {} elements are larger than asked for: raise --max-levels, now {}",
            mesh.capped,
            report.options.as_ref().map_or(0, |o| o.max_levels)
        ));
    }
    lines.extend(mesh.quality.as_ref().map(quality_table));
    lines.push(format!("  hash {}, {:.2} s", mesh.hash, report.seconds));
    lines.join("\n") + "\n"
}
