//! `hexmill convert`.

use hexmill::io;

use super::args::ConvertArgs;
use super::failure::Failure;
use super::files::{check_outputs, format_to_read, format_to_write, load, save, warn_of_losses};
use super::progress::Progress;
use super::tell::print;
use super::words::counted;

/// Reads a mesh and writes it in another format.
pub(crate) fn run(args: &ConvertArgs, quiet: bool) -> Result<(), Failure> {
    let format = format_to_write(&args.output)?;
    format_to_read(&args.input)?;
    check_outputs(&[("the input", &args.input)], &[("--output", &args.output)])?;
    let progress = Progress::new(quiet);
    let loaded = progress.stage("read", || load(&args.input))?;
    loaded.warn_of_dropped(quiet);
    let document = loaded.document;
    let bytes = progress
        .stage("encode", || io::write(&document, format))
        .map_err(|e| Failure::write(&args.output, &e))?;
    progress.stage("write", || save(&args.output, &bytes))?;
    progress.finish();
    warn_of_losses(&args.output, &document, format, quiet);
    if quiet {
        return Ok(());
    }
    let (nodes, cells) = (document.mesh.node_count(), document.mesh.cell_count());
    let (nodes, cells) = (counted(nodes, "node", "nodes"), counted(cells, "cell", "cells"));
    print(&format!("{}: {nodes}, {cells}, {} bytes\n", args.output.display(), bytes.len()))
}
