//! `hexmill refine` of a hex mesh.

use hexmill::io::{AnyMesh, Document};
use hexmill::refine::hex::{Added, HexForecast, HexOptions, HexPlan, HexRefineError};

use super::args::RefineArgs;
use super::failure::Failure;
use super::memory::Limit;
use super::mesh_report::Counts;
use super::progress::Progress;
use super::refine::Refined;
use super::report::{HexRefinementReport, OptionsReport};
use super::tell::tell;

/// Refines the hexes of `document`; tells before what will be done, unless `quiet`.
pub(super) fn refine(
    args: &RefineArgs,
    document: Document,
    quiet: bool,
    progress: &Progress,
) -> Result<Refined, Failure> {
    let Document { mesh: AnyMesh::Hexes(mut mesh), tags, .. } = document else { unreachable!("hexes") };
    mesh.tags = tags;
    let mut options = options(args)?;
    let told = options_report(args, &options);
    let limit = Limit::new(options.max_hexes, HexOptions::MOST_HEXES, HexForecast::BYTES_PER_HEX);
    options.max_hexes = limit.cells;
    let before = Counts::of_hexes(&mesh);
    let refused = |error: HexRefineError| refused(args, &limit, &error);
    let plan = HexPlan::new(&mesh, &options, progress).map_err(refused)?;
    drop(mesh);
    if !quiet {
        tell(&plan_in_words(&plan));
    }
    let forecast = plan.forecast().clone();
    let refined = plan.carry_out(progress).map_err(refused)?;
    let work = HexRefinementReport {
        forecast,
        added: refined.added,
        turned: refined.turned,
        levels: refined.stages.clone(),
    };
    Ok(Refined {
        before,
        capped: refined.capped,
        document: Document::from(refined),
        options: told,
        work: Some(work),
        dropped: None,
        idle_regions: Vec::new(),
    })
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
    let (Added { closure, conflicts, .. }, forecast) = (plan.added(), plan.forecast());
    let reasons = [
        (closure.families, "to complete families of eight"),
        (closure.balance, "to grade levels by one"),
        (closure.method, "for the method's templates"),
        (conflicts, "where the interface touches itself"),
    ];
    let mut lines = vec![format!(
        "{} hexes to be made, with {} transition hexes, in about {:.0} MB",
        forecast.hexes,
        forecast.transition,
        (forecast.bytes as f64 / 1e6).ceil()
    )];
    let told = reasons.iter().filter(|(count, _)| *count > 0);
    lines.extend(told.map(|(count, why)| format!("  {count} elements are refined {why}")));
    lines.join("\n") + "\n"
}

/// The mesh was not refined, or the options make no sense.
fn refused(args: &RefineArgs, limit: &Limit, error: &HexRefineError) -> Failure {
    let file = args.input.display().to_string();
    let special = match error {
        HexRefineError::Option { .. } | HexRefineError::Sizing(_) => Some(Failure::Usage(error.to_string())),
        HexRefineError::TooManyHexes { hexes, .. } => limit.exceeded(&file, *hexes, "hexes"),
        _ => None,
    };
    special.unwrap_or_else(|| Failure::refused(error.code(), format!("{file}: {error}")))
}
