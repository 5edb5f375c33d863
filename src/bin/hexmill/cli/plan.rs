//! `hexmill refine --plan`: what a refinement would make, and nothing made.

use hexmill::io::{AnyMesh, Document};
use hexmill::refine::hex::{Added, HexForecast};
use hexmill::refine::{Estimate, QuadOptions};
use serde::Serialize;

use super::args::RefineArgs;
use super::failure::Failure;
use super::files::{check_outputs, format_to_read, load, save};
use super::making::use_threads;
use super::mesh_report::Counts;
use super::progress::{Progress, StageSeconds};
use super::refine::deepest;
use super::report::{InputReport, OptionsReport, peak_memory_bytes};
use super::tell::print;
use super::{refine_hexes, refine_surface};

/// The version of the record's form.
const SCHEMA: &str = "hexmill-plan/1";

/// The record of a plan, documented in `docs/report.md`.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
struct Record {
    schema: &'static str,
    version: &'static str,
    command: &'static str,
    input: InputReport,
    options: OptionsReport,
    plan: Plan,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    idle_regions: Vec<String>,
    threads: usize,
    stages: Vec<StageSeconds>,
    seconds: f64,
    peak_memory_bytes: Option<u64>,
}

/// What would be made.
#[derive(Serialize)]
#[serde(untagged)]
pub(super) enum Plan {
    /// Of a surface. `bytes` are the command's.
    Quads(QuadPlan),
    /// Of hexes.
    Hexes(HexesPlan),
}

/// Quads that would be made.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct QuadPlan {
    pub(super) quads: u64,
    pub(super) nodes: u64,
    pub(super) levels: u8,
    /// Are these figures exact?
    pub(super) exact: bool,
    pub(super) bytes: u64,
}

/// Hexes that would be made, and what would be refined that is not asked for.
#[derive(Serialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct HexesPlan {
    #[serde(flatten)]
    pub(super) forecast: HexForecast,
    pub(super) added: Added,
    /// Elements that would be larger than asked for.
    pub(super) capped: usize,
    /// Nodes that stand where others do.
    pub(super) coincident_nodes: usize,
}

/// A plan with what it is of.
pub(super) struct Planned {
    pub(super) before: Counts,
    pub(super) options: OptionsReport,
    pub(super) plan: Plan,
    /// The regions that overlap no part of the input, as they were given.
    pub(super) idle_regions: Vec<String>,
    pub(super) in_words: String,
}

/// Reads, plans and reports.
pub(super) fn run(args: &RefineArgs, quiet: bool) -> Result<(), Failure> {
    deepest(args, QuadOptions::default().max_levels)?;
    let regions = args.regions.iter().filter_map(|region| Some(("a region's file", region.file()?)));
    let inputs: Vec<_> = std::iter::once(("the input", args.input.as_path())).chain(regions).collect();
    format_to_read(&args.input)?;
    let report = args.working.report.as_deref();
    let outputs: Vec<_> = report.map(|path| ("--report", path)).into_iter().collect();
    check_outputs(&inputs, &outputs)?;
    args.working.threads.map_or(Ok(()), use_threads)?;
    let progress = Progress::new(quiet);

    let mut loaded = progress.stage("read", || load(&args.input))?;
    loaded.warn_of_dropped(quiet);
    let document: Document = loaded.take_document();
    let planned = match document.mesh {
        AnyMesh::Hexes(_) => refine_hexes::plan(args, document, &progress),
        _ => refine_surface::plan(args, document, &progress),
    };
    let Planned { before, options, plan, idle_regions, mut in_words } = planned?;
    for region in &idle_regions {
        in_words += &format!("  region {region} meets nothing of the input and refines nothing\n");
    }
    let (stages, seconds) = progress.finish();
    if let Some(path) = report {
        let record = Record {
            schema: SCHEMA,
            version: env!("CARGO_PKG_VERSION"),
            command: "refine",
            input: InputReport::new(&loaded, before),
            options,
            plan,
            idle_regions,
            threads: hexmill::parallel::thread_count(),
            stages,
            seconds,
            peak_memory_bytes: peak_memory_bytes(),
        };
        let mut text = serde_json::to_vec_pretty(&record).expect("a record has no maps and no odd keys");
        text.push(b'\n');
        save(path, &text)?;
    }
    if quiet { Ok(()) } else { print(&in_words) }
}

impl QuadPlan {
    /// From the library's estimate, with what the command takes for each quad.
    pub(super) fn new(estimate: &Estimate, bytes_per_quad: u64) -> Self {
        let Estimate { quads, nodes, levels, exact, .. } = *estimate;
        Self { quads, nodes, levels, exact, bytes: quads.saturating_mul(bytes_per_quad) }
    }
}
