//! `hexmill refine` of a hex mesh.

use hexmill::io::{self, AnyMesh, Document, Format};
use hexmill::refine::hex::{Added, HexOptions, HexPlan, HexRefineError};

use super::args::RefineArgs;
use super::failure::Failure;
use super::files::{Loaded, save};
use super::progress::Progress;
use super::refine::in_words;
use super::report::{
    Counts, FileReport, HexRefinementReport, InputReport, MeshReport, OptionsReport, Report,
    peak_memory_bytes,
};

/// Refines the hexes of `document`, which was read from `loaded`, writes and reports.
pub(super) fn run(
    args: &RefineArgs,
    quiet: bool,
    loaded: &Loaded,
    document: Document,
    format: Format,
    progress: Progress,
) -> Result<(), Failure> {
    let Document { mesh: AnyMesh::Hexes(mut mesh), tags, .. } = document else { unreachable!("hexes") };
    mesh.tags = tags;
    let options = options(args)?;
    let input = InputReport::new(loaded, Counts::of_hexes(&mesh));
    let refused = |error: HexRefineError| refused(args, &error);
    let plan = HexPlan::new(&mesh, &options, &progress).map_err(refused)?;
    drop(mesh);
    if !quiet {
        eprint!("{}", plan_in_words(&plan));
    }
    let refined = plan.carry_out(&progress).map_err(refused)?;
    let capped = refined.capped;
    let work =
        HexRefinementReport { added: refined.added, turned: refined.turned, levels: refined.stages.clone() };
    let document = Document::from(refined);

    let bytes = progress
        .stage("encode", || io::write(&document, format))
        .map_err(|e| Failure::write(&args.output, &e))?;
    progress.stage("write", || save(&args.output, &bytes))?;
    let output = FileReport::new(&args.output, format, bytes.len() as u64);
    drop(bytes);

    let AnyMesh::Hexes(mesh) = &document.mesh else { unreachable!("refinement of hexes makes hexes") };
    let mut measured = progress.stage("measure", || MeshReport::of_hexes(mesh, &document.level, capped));
    if args.report.is_some() {
        progress.stage("check", || measured.check_hexes(mesh));
    }
    let mut report = Report::new("refine", input, measured);
    report.options = Some(options_report(args, &options));
    report.refinement = Some(work);
    report.output = Some(output);
    (report.stages, report.seconds) = progress.finish();
    report.peak_memory_bytes = peak_memory_bytes();
    if !quiet {
        print!("{}", in_words(args, &report));
    }
    args.report.as_deref().map_or(Ok(()), |path| report.save(path))
}

/// The options; those for surfaces alone are refused.
fn options(args: &RefineArgs) -> Result<HexOptions, Failure> {
    let of_surfaces = [
        ("--curvature", args.curvature.is_some()),
        ("--keep-coarse", args.keep_coarse),
        ("--max-quads", args.max_quads.is_some()),
    ];
    if let Some((option, _)) = of_surfaces.iter().find(|(_, given)| *given) {
        let message = format!("{option} is for surfaces; {} holds hexes", args.input.display());
        return Err(Failure::Usage(message));
    }
    let default = HexOptions::default();
    Ok(HexOptions {
        method: args.method.map_or(default.method, Into::into),
        edge_length: args.edge_length,
        levels: args.levels,
        regions: args.regions.iter().map(|region| region.load()).collect::<Result<_, _>>()?,
        gradation: args.gradation.unwrap_or(default.gradation),
        max_levels: args.max_levels.unwrap_or(default.max_levels),
        max_hexes: args.max_hexes.unwrap_or(default.max_hexes),
    })
}

/// The options, with regions as they were given: their files may be large.
fn options_report(args: &RefineArgs, options: &HexOptions) -> OptionsReport {
    OptionsReport {
        edge_length: options.edge_length,
        levels: options.levels,
        regions: args.regions.iter().map(|region| region.text.clone()).collect(),
        curvature: None,
        gradation: options.gradation,
        keep_coarse: false,
        max_levels: options.max_levels,
        max_quads: None,
        max_hexes: Some(options.max_hexes),
        method: Some(options.method),
    }
}

/// What will be done, told before it is.
fn plan_in_words(plan: &HexPlan) -> String {
    let Added { closure, .. } = plan.added();
    let reasons = [
        (closure.families, "to complete families of eight"),
        (closure.balance, "to grade levels by one"),
        (closure.method, "for the method's templates"),
    ];
    let mut lines = vec![format!("octree of {} hexes, before transitions", plan.octree_hexes())];
    let told = reasons.iter().filter(|(count, _)| *count > 0);
    lines.extend(told.map(|(count, why)| format!("  {count} elements are refined {why}")));
    lines.join("\n") + "\n"
}

/// The mesh was not refined, or the options make no sense.
fn refused(args: &RefineArgs, error: &HexRefineError) -> Failure {
    match error {
        HexRefineError::Option { .. } | HexRefineError::Sizing(_) => Failure::Usage(error.to_string()),
        _ => Failure::refused(error.code(), format!("{}: {error}", args.input.display())),
    }
}
