//! `hexmill grid`.

use hexmill::geometry::Aabb;
use hexmill::io::{self, Document};
use hexmill::mesh::{GridError, GridOptions, hex_grid};
use hexmill::refine::hex::HexOptions;

use super::args::GridArgs;
use super::failure::Failure;
use super::files::{check_outputs, format_for_hexes, format_to_read, load, save};
use super::memory::Limit;
use super::progress::Progress;
use super::tell::print;
use super::words::counted;

/// Makes a grid of hexes around a mesh.
pub(crate) fn run(args: &GridArgs, quiet: bool) -> Result<(), Failure> {
    let format = format_for_hexes(&args.output)?;
    format_to_read(&args.input)?;
    check_outputs(&[("the input", args.input.as_path())], &[("--output", args.output.as_path())])?;
    let progress = Progress::new(quiet);
    let around = progress.stage("read", || load(&args.input))?.document;
    let limit = Limit::new(args.max_hexes.unwrap_or(DEFAULT_LIMIT), HexOptions::MOST_HEXES, BYTES_PER_HEX);
    let options =
        GridOptions { spacing: args.spacing, margin: args.margin, fitted: args.fit, max_hexes: limit.cells };
    let bounds = Aabb::around(around.mesh.positions());
    let grid = progress
        .stage("grid", || hex_grid(bounds, &options))
        .map_err(|error| refused(args, &limit, &error))?;
    let (nodes, hexes) = (grid.positions.len(), grid.hexes.len());
    let bytes = progress
        .stage("encode", || io::write(&Document::from(grid), format))
        .map_err(|e| Failure::write(&args.output, &e))?;
    progress.stage("write", || save(&args.output, &bytes))?;
    progress.finish();
    if quiet {
        return Ok(());
    }
    let (nodes, hexes) = (counted(nodes, "node", "nodes"), counted(hexes, "hex", "hexes"));
    print(&format!("{}: {nodes}, {hexes}, {} bytes\n", args.output.display(), bytes.len()))
}

/// The grid was not made.
fn refused(args: &GridArgs, limit: &Limit, error: &GridError) -> Failure {
    let file = args.input.display().to_string();
    let for_memory = match error {
        GridError::TooManyHexes { counts, .. } => {
            limit.exceeded(&file, counts.iter().product::<f64>() as u64, "hexes", "raise the spacing")
        }
        _ => None,
    };
    for_memory.unwrap_or_else(|| Failure::refused(error.code(), format!("{file}: {error}")))
}

/// Peak memory of the command in bytes a hex: a grid of 12.8 M hexes takes 96 of them as VTU.
const BYTES_PER_HEX: u64 = 110;

/// Hexes that are made unless more are asked for: some gigabytes.
const DEFAULT_LIMIT: u64 = 16_000_000;
