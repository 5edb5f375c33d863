//! The command line of hexmill: reads files, calls the library, writes files and tells how it went.

mod allocator;
mod args;
mod check;
mod convert;
mod failure;
mod files;
mod grid;
mod hex;
mod making;
mod memory;
mod mesh_report;
mod plan;
mod progress;
mod quad;
mod refine;
mod refine_hexes;
mod refine_surface;
mod region;
mod report;
mod tell;
mod words;

use std::process::ExitCode;

use clap::Parser;

pub(crate) use allocator::Allocator;
use allocator::{give_back_at_once, keep_pages};
use args::{Cli, Command};

/// Does what the arguments ask for.
pub fn run() -> ExitCode {
    files::remove_unfinished_when_interrupted();
    let cli = Cli::parse();
    if matches!(cli.command, Command::Hex(_)) {
        give_back_at_once()
    } else {
        keep_pages()
    }
    let done = match cli.command {
        Command::Refine(args) if args.plan => plan::run(&args, cli.quiet),
        Command::Refine(args) => refine::run(&args, cli.quiet),
        Command::Hex(args) => hex::run(&args, cli.quiet),
        Command::Check(args) => check::run(&args, cli.quiet),
        Command::Convert(args) => convert::run(&args, cli.quiet),
        Command::Grid(args) => grid::run(&args, cli.quiet),
        Command::Quad(args) => quad::run(&args, cli.quiet),
    };
    match done {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            tell::tell(&format!("{failure}\n"));
            failure.exit_code()
        }
    }
}
