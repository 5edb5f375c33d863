//! `hexmill refine` of a surface.

use hexmill::io::Document;
use hexmill::refine::{QuadOptions, RefineError, estimate_quads, idle_regions, refine_quads};

use super::args::RefineArgs;
use super::failure::Failure;
use super::memory::{ADVICE, Limit};
use super::mesh_report::Counts;
use super::plan::{Plan, Planned, QuadPlan};
use super::progress::Progress;
use super::refine::{Refined, deepest};
use super::report::{DroppedFeatures, OptionsReport, RefinementOptions};
use super::words::counted;

/// Peak memory of the command in bytes a quad: encoding takes more than refinement does. Measured with 1.5 million quads
/// were 176 (VTU) to 308 (MSH), and up to 341 with a report.
const BYTES_PER_QUAD: u64 = 350;

/// Refines the faces of `document`.
pub(super) fn refine(args: &RefineArgs, document: Document, progress: &Progress) -> Result<Refined, Failure> {
    refuse_options_of_hexes(args)?;
    let surface = document.into_surface().expect("the document holds faces");
    let dropped = DroppedFeatures::of(&surface.features);
    let mut options = options(args)?;
    let told = options_report(args, &options);
    let limit = Limit::new(options.max_quads, QuadOptions::MOST_QUADS, BYTES_PER_QUAD);
    options.max_quads = limit.cells;
    let refined =
        refine_quads(&surface, &options, progress).map_err(|error| refused(args, &limit, &error))?;
    let idle = idle_regions(&surface, &options, progress).map_err(|error| refused(args, &limit, &error))?;
    Ok(Refined {
        before: Counts::of_polygons(&surface),
        capped: refined.capped,
        document: Document::from(refined),
        options: told,
        work: None,
        dropped,
        idle_regions: idle.iter().map(|&k| args.regions[k as usize].text.clone()).collect(),
    })
}

/// Tells what would be made of the faces of `document`.
pub(super) fn plan(args: &RefineArgs, document: Document, progress: &Progress) -> Result<Planned, Failure> {
    refuse_options_of_hexes(args)?;
    let surface = document.into_surface().expect("the document holds faces");
    let options = options(args)?;
    let limit = Limit::new(options.max_quads, QuadOptions::MOST_QUADS, BYTES_PER_QUAD);
    let estimate =
        estimate_quads(&surface, &options, progress).map_err(|error| refused(args, &limit, &error))?;
    let plan = QuadPlan::new(&estimate, BYTES_PER_QUAD);
    let mut in_words = format!(
        "{}{} and {}, {} deep, in about {:.0} MB\n",
        if plan.exact { "" } else { "about " },
        counted(plan.quads, "quad", "quads"),
        counted(plan.nodes, "node", "nodes"),
        counted(plan.levels, "level", "levels"),
        (plan.bytes as f64 / 1e6).ceil()
    );
    if plan.quads > limit.cells {
        in_words += &format!("  more than the limit of {}, which would be refused\n", limit.cells);
    }
    let idle = estimate.idle_regions.iter().map(|&k| args.regions[k as usize].text.clone());
    Ok(Planned {
        before: Counts::of_polygons(&surface),
        options: options_report(args, &options),
        idle_regions: idle.collect(),
        in_words,
        plan: Plan::Quads(plan),
    })
}

fn refuse_options_of_hexes(args: &RefineArgs) -> Result<(), Failure> {
    if !(args.method.is_some() || args.no_growth || args.max_hexes.is_some()) {
        return Ok(());
    }
    let file = args.input.display();
    Err(Failure::Usage(format!(
        "--method, --no-growth and --max-hexes are for hexes; {file} holds a surface"
    )))
}

/// The surface was not refined, or the options make no sense.
fn refused(args: &RefineArgs, limit: &Limit, error: &RefineError) -> Failure {
    let for_memory = match error {
        RefineError::TooManyQuads { quads, .. } => {
            limit.exceeded(&args.input.display().to_string(), *quads, "quads", ADVICE)
        }
        _ => None,
    };
    for_memory.unwrap_or_else(|| Failure::refine(&args.input, error))
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
        max_levels: deepest(args, default.max_levels)?,
        max_quads: args.max_quads.unwrap_or(default.max_quads),
    })
}

/// The options, with regions as they were given: their files may be large.
fn options_report(args: &RefineArgs, options: &QuadOptions) -> OptionsReport {
    OptionsReport::Refinement(RefinementOptions {
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
        growth: None,
    })
}
