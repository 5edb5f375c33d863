//! `hexmill refine`.

use hexmill::io::{self, AnyMesh, Document};
use hexmill::mesh::{PolygonMesh, check_quads};
use hexmill::refine::{QuadOptions, refine_quads};

use super::args::RefineArgs;
use super::failure::Failure;
use super::files::{check_outputs, format_of, load, save};
use super::progress::Progress;
use super::refine_hexes;
use super::report::{Counts, FileReport, InputReport, MeshReport, OptionsReport, Report, peak_memory_bytes};

/// Reads, refines, writes and reports.
pub(crate) fn run(args: &RefineArgs, quiet: bool) -> Result<(), Failure> {
    let output_format = format_of(&args.output)?;
    format_of(&args.input)?;
    check_levels(args)?;
    let regions = args.regions.iter().filter_map(|region| Some(("a region's file", region.file()?)));
    let inputs: Vec<_> = std::iter::once(("the input", args.input.as_path())).chain(regions).collect();
    let report = args.report.as_deref().map(|path| ("--report", path));
    let outputs: Vec<_> = std::iter::once(("--output", args.output.as_path())).chain(report).collect();
    check_outputs(&inputs, &outputs)?;
    use_threads(args.threads)?;
    let progress = Progress::new(quiet);

    let mut loaded = progress.stage("read", || load(&args.input))?;
    let empty = Document::from(PolygonMesh::default());
    let document = std::mem::replace(&mut loaded.document, empty);
    if matches!(document.mesh, AnyMesh::Hexes(_)) {
        return refine_hexes::run(args, quiet, &loaded, document, output_format, progress);
    }
    if args.method.is_some() || args.max_hexes.is_some() {
        let message =
            format!("--method and --max-hexes are for hexes; {} holds a surface", args.input.display());
        return Err(Failure::Usage(message));
    }
    let surface = document.into_surface().expect("hexes were taken above");
    let input = InputReport::new(&loaded, Counts::of_polygons(&surface));
    let options = options(args)?;
    let refined =
        refine_quads(&surface, &options, &progress).map_err(|e| Failure::refine(&args.input, &e))?;
    drop(surface);
    let capped = refined.capped;
    let document = Document::from(refined);

    let bytes = progress
        .stage("encode", || io::write(&document, output_format))
        .map_err(|e| Failure::write(&args.output, &e))?;
    progress.stage("write", || save(&args.output, &bytes))?;
    let output = FileReport::new(&args.output, output_format, bytes.len() as u64);
    drop(bytes);

    let AnyMesh::Quads(mesh) = &document.mesh else { unreachable!("refinement makes quads") };
    let mut measured = progress.stage("measure", || MeshReport::of_quads(mesh, &document.level, capped));
    if args.report.is_some() {
        progress.stage("check", || measured.check(mesh, check_quads));
    }
    let mut report = Report::new("refine", input, measured);
    report.options = Some(options_report(args, &options));
    report.output = Some(output);
    (report.stages, report.seconds) = progress.finish();
    report.peak_memory_bytes = peak_memory_bytes();
    if !quiet {
        print!("{}", in_words(args, &report));
    }
    args.report.as_deref().map_or(Ok(()), |path| report.save(path))
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

/// Makes the library's work run on `threads` threads.
fn use_threads(threads: Option<u16>) -> Result<(), Failure> {
    let Some(threads) = threads else { return Ok(()) };
    rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads)).build_global().map_err(|error| {
        Failure::refused(
            "threads-not-started",
            format!("{threads} threads cannot be started: {error}; give fewer"),
        )
    })
}

fn options(args: &RefineArgs) -> Result<QuadOptions, Failure> {
    let default = QuadOptions::default();
    Ok(QuadOptions {
        edge_length: args.edge_length,
        levels: args.levels,
        regions: args.regions.iter().map(|region| region.load()).collect::<Result<_, _>>()?,
        curvature: args.curvature,
        gradation: args.gradation.unwrap_or(default.gradation),
        keep_coarse: args.keep_coarse,
        max_levels: args.max_levels.unwrap_or(default.max_levels),
        max_quads: args.max_quads.unwrap_or(default.max_quads),
    })
}

/// The options, with regions as they were given: their files may be large.
fn options_report(args: &RefineArgs, options: &QuadOptions) -> OptionsReport {
    OptionsReport {
        edge_length: options.edge_length,
        levels: options.levels,
        regions: args.regions.iter().map(|region| region.text.clone()).collect(),
        curvature: options.curvature,
        gradation: options.gradation,
        keep_coarse: options.keep_coarse,
        max_levels: options.max_levels,
        max_quads: Some(options.max_quads),
        max_hexes: None,
        method: None,
    }
}

/// What was made, for people.
pub(super) fn in_words(args: &RefineArgs, report: &Report) -> String {
    let mesh = &report.mesh;
    let levels: Vec<String> =
        mesh.levels.iter().map(|count| format!("{} of level {}", count.cells, count.level)).collect();
    let mut lines = vec![
        format!("{}: {}", args.output.display(), mesh.counts.in_words()),
        format!("  {}", levels.join(", ")),
    ];
    if mesh.capped > 0 {
        lines.push(format!(
            "  {} elements are larger than asked for: raise --max-levels, now {}",
            mesh.capped,
            report.options.as_ref().map_or(0, |o| o.max_levels)
        ));
    }
    lines.extend(mesh.quality.as_ref().map(super::report::quality_table));
    lines.push(format!("  hash {}, {:.2} s", mesh.hash, report.seconds));
    lines.join("\n") + "\n"
}
