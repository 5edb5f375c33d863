//! The command line, run as users run it.

mod check;
mod convert;
mod grid;
mod hex;
mod interrupt;
mod plan;
mod quad;
mod refine;
mod refine_hexes;
mod refusals;

use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;
use tempfile::TempDir;

/// What a run of the program gave.
struct Run {
    code: Option<i32>,
    stdout: String,
    stderr: String,
}

/// Runs `hexmill` in `folder`.
fn hexmill(folder: &TempDir, args: &[&str]) -> Run {
    let output: Output = Command::new(env!("CARGO_BIN_EXE_hexmill"))
        .args(args)
        .current_dir(folder)
        .output()
        .expect("the program can be started");
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("the program writes UTF-8");
    Run { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
}

/// Runs `hexmill`, which must succeed without a word on stderr, and returns its stdout.
#[track_caller]
fn succeed(folder: &TempDir, args: &[&str]) -> String {
    let run = hexmill(folder, args);
    assert_eq!((run.code, run.stderr.as_str()), (Some(0), ""), "{args:?}");
    run.stdout
}

/// Runs `hexmill`, which must end with `code` and say `message` on stderr, and print nothing else.
#[track_caller]
fn fail(folder: &TempDir, args: &[&str], code: i32, message: &str) {
    let run = hexmill(folder, args);
    assert_eq!((run.code, run.stderr.trim_end()), (Some(code), message), "{args:?}");
    assert_eq!(run.stdout, "", "{args:?}");
}

/// A folder with a copy of the shipped model `name` in it, under its file name.
fn folder_with(name: &str) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder for the test");
    let model = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models").join(name);
    std::fs::copy(&model, folder.path().join(model.file_name().unwrap())).expect("the model ships");
    folder
}

/// A folder with a file of this text in it.
fn folder_holding(file: &str, text: &str) -> TempDir {
    let folder = tempfile::tempdir().expect("a folder for the test");
    std::fs::write(folder.path().join(file), text).expect("the folder takes files");
    folder
}

/// The JSON in a file of `folder`.
fn json(folder: &TempDir, file: &str) -> Value {
    let text = std::fs::read(folder.path().join(file)).expect("the report was written");
    serde_json::from_slice(&text).expect("a report is JSON")
}

/// The names of the files in `folder`, sorted.
fn files(folder: &TempDir) -> Vec<String> {
    let name = |entry: std::io::Result<std::fs::DirEntry>| entry.unwrap().file_name().into_string().unwrap();
    let mut names: Vec<String> = std::fs::read_dir(folder).unwrap().map(name).collect();
    names.sort();
    names
}
