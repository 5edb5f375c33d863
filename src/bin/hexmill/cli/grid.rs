//! `hexmill grid`.

use hexmill::geometry::Aabb;
use hexmill::io::{self, Document};
use hexmill::mesh::{GridOptions, hex_grid};

use super::args::GridArgs;
use super::failure::Failure;
use super::files::{check_outputs, format_for_hexes, format_to_read, load, save};
use super::progress::Progress;
use super::tell::print;

/// Makes a grid of hexes around a mesh.
pub(crate) fn run(args: &GridArgs, quiet: bool) -> Result<(), Failure> {
    let format = format_for_hexes(&args.output)?;
    format_to_read(&args.input)?;
    check_outputs(&[("the input", args.input.as_path())], &[("--output", args.output.as_path())])?;
    let progress = Progress::new(quiet);
    let around = progress.stage("read", || load(&args.input))?.document;
    let options = GridOptions {
        spacing: args.spacing,
        margin: args.margin,
        fitted: args.fit,
        max_hexes: args.max_hexes.unwrap_or(DEFAULT_LIMIT),
    };
    let bounds = Aabb::around(around.mesh.positions());
    let grid = progress
        .stage("grid", || hex_grid(bounds, &options))
        .map_err(|e| Failure::refused(e.code(), format!("{}: {e}", args.input.display())))?;
    let (nodes, hexes) = (grid.positions.len(), grid.hexes.len());
    let bytes = progress
        .stage("encode", || io::write(&Document::from(grid), format))
        .map_err(|e| Failure::write(&args.output, &e))?;
    progress.stage("write", || save(&args.output, &bytes))?;
    progress.finish();
    if quiet {
        return Ok(());
    }
    print(&format!("{}: {nodes} nodes, {hexes} hexes, {} bytes\n", args.output.display(), bytes.len()))
}

/// Hexes that are made unless more are asked for: some gigabytes.
const DEFAULT_LIMIT: u64 = 16_000_000;
