//! `hexmill refine` of a hex mesh.

use hexmill::io::{AnyMesh, Document};
use hexmill::mesh::HexMesh;
use hexmill::refine::hex::{Added, Growth, HexForecast, HexOptions, HexPlan, HexRefineError};

use super::args::RefineArgs;
use super::failure::Failure;
use super::memory::{ADVICE, Limit};
use super::mesh_report::Counts;
use super::plan::{HexesPlan, Plan, Planned};
use super::progress::Progress;
use super::refine::{Refined, deepest};
use super::report::{HexRefinementReport, OptionsReport, RefinementOptions};
use super::tell::tell;
use super::words::counted;

/// Peak memory of the command in bytes a hex, about, beside [`BYTES`]: with a record, on two threads, meshes of 0.08 to 4.3
/// million hexes took 170 to 330.
const BYTES_PER_HEX: u64 = 340;

/// What the command takes besides, about: code, stacks, the input, and what an allocator keeps.
const BYTES: u64 = 90_000_000;

/// Refines the hexes of `document`; tells before what will be done, unless `quiet`.
pub(super) fn refine(
    args: &RefineArgs,
    document: Document,
    quiet: bool,
    progress: &Progress,
) -> Result<Refined, Failure> {
    let (mesh, mut options) = (mesh_of(document), options(args)?);
    let told = options_report(args, &options);
    let limit = limited(&mut options);
    let before = Counts::of_hexes(&mesh);
    let refused = |error: HexRefineError| refused(args, &limit, &error);
    let plan = HexPlan::new(&mesh, &options, progress).map_err(refused)?;
    drop(mesh);
    if !quiet {
        tell(&plan_in_words(&plan));
    }
    let (forecast, idle_regions) = (forecast(&plan), idle_regions(args, &plan));
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
        idle_regions,
    })
}

/// Tells what would be made of the hexes of `document`.
pub(super) fn plan(args: &RefineArgs, document: Document, progress: &Progress) -> Result<Planned, Failure> {
    let (mesh, mut options) = (mesh_of(document), options(args)?);
    let told = options_report(args, &options);
    let limit = limited(&mut options);
    let plan = HexPlan::new(&mesh, &options, progress).map_err(|error| refused(args, &limit, &error))?;
    let of_hexes = HexesPlan {
        forecast: forecast(&plan),
        added: plan.added(),
        capped: plan.capped(),
        coincident_nodes: plan.coincident_nodes(),
    };
    Ok(Planned {
        before: Counts::of_hexes(&mesh),
        options: told,
        idle_regions: idle_regions(args, &plan),
        in_words: plan_in_words(&plan),
        plan: Plan::Hexes(of_hexes),
    })
}

/// The hexes of a document.
fn mesh_of(document: Document) -> HexMesh {
    let Document { mesh: AnyMesh::Hexes(mesh), tags, .. } = document else { unreachable!("hexes") };
    HexMesh { tags, ..mesh }
}

/// Lowers the limit of hexes to what free memory holds.
fn limited(options: &mut HexOptions) -> Limit {
    let limit = Limit::new(options.max_hexes, HexOptions::MOST_HEXES, BYTES_PER_HEX);
    options.max_hexes = limit.cells;
    limit
}

/// What will be made, with the memory of the whole command.
fn forecast(plan: &HexPlan) -> HexForecast {
    HexForecast { bytes: bytes(plan.forecast()), ..plan.forecast().clone() }
}

/// The regions that overlap no hex, as they were given.
fn idle_regions(args: &RefineArgs, plan: &HexPlan) -> Vec<String> {
    plan.idle_regions().iter().map(|&k| args.regions[k as usize].text.clone()).collect()
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
    let most = HexOptions::DEEPEST_LEVEL;
    for (option, given) in [("--levels", args.levels), ("--max-levels", args.max_levels)] {
        if let Some(levels) = given.filter(|&levels| levels > most) {
            return Err(Failure::Usage(format!("{option} is {levels}; for hexes give at most {most}")));
        }
    }
    let max_levels = deepest(args, default.max_levels)?;
    Ok(HexOptions {
        method: args.method.map_or(default.method, Into::into),
        growth: if args.no_growth { Growth::Refuse } else { Growth::Allow },
        edge_length: args.edge_length,
        levels: args.levels,
        regions: args.regions.iter().map(|region| region.load()).collect::<Result<_, _>>()?,
        gradation: args.gradation.unwrap_or(default.gradation),
        max_levels,
        max_hexes: args.max_hexes.unwrap_or(default.max_hexes),
    })
}

/// The options, with regions as they were given: their files may be large.
fn options_report(args: &RefineArgs, options: &HexOptions) -> OptionsReport {
    OptionsReport::Refinement(RefinementOptions {
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
        growth: Some(options.growth),
    })
}

/// Peak memory of the command, about.
fn bytes(forecast: &HexForecast) -> u64 {
    BYTES + forecast.hexes as u64 * BYTES_PER_HEX
}

/// Small meshes take far less than what is added for everything besides their hexes.
fn memory_in_words(bytes: u64) -> String {
    let megabytes = (bytes as f64 / 1e6).ceil();
    if megabytes <= 100.0 { "less than 100 MB".into() } else { format!("about {megabytes:.0} MB") }
}

/// What will be done, told before it is.
fn plan_in_words(plan: &HexPlan) -> String {
    let (Added { base, closure, conflicts, .. }, forecast) = (plan.added(), plan.forecast());
    let reasons = [
        (base, "that nothing asks for, so that elements are in families or blocks of eight"),
        (closure.families, "to complete families of eight"),
        (closure.balance, "to grade levels by one"),
        (closure.method, "for the method's templates"),
        (conflicts, "where the interface cannot be separated"),
    ];
    let mut lines = vec![format!(
        "{} to be made, with {}, in {}",
        counted(forecast.hexes, "hex", "hexes"),
        counted(forecast.transition, "transition hex", "transition hexes"),
        memory_in_words(bytes(forecast))
    )];
    let told = reasons.iter().filter(|(count, _)| *count > 0);
    lines.extend(
        told.map(|(count, why)| format!("  {} refined {why}", counted(*count, "element is", "elements are"))),
    );
    let coincident = plan.coincident_nodes();
    if coincident > 0 {
        lines.push(format!(
            "warning: {} exactly where others do; hexes that do not share them are no neighbours: weld them if they are \
             to be",
            counted(coincident, "node stands", "nodes stand")
        ));
    }
    lines.join("\n") + "\n"
}

/// The mesh was not refined, or the options make no sense.
fn refused(args: &RefineArgs, limit: &Limit, error: &HexRefineError) -> Failure {
    let file = args.input.display().to_string();
    let special = match error {
        HexRefineError::Option { .. } | HexRefineError::Sizing(_) => Some(Failure::Usage(error.to_string())),
        HexRefineError::TooManyHexes { hexes, .. } => {
            let raise = || Failure::refused(error.code(), format!("{file}: {error} (--max-hexes)"));
            Some(limit.exceeded(&file, *hexes, "hexes", ADVICE).unwrap_or_else(raise))
        }
        HexRefineError::GrowthRefused { .. } => {
            Some(Failure::refused(error.code(), format!("{file}: {error} (--no-growth, --method)")))
        }
        _ => None,
    };
    special.unwrap_or_else(|| Failure::refused(error.code(), format!("{file}: {error}")))
}
