//! Ctrl-C.
#![cfg(unix)]

use std::process::{Command, Stdio};
use std::time::Duration;

use super::{files, folder_with};

#[test]
fn an_interrupted_run_leaves_nothing_behind() {
    let folder = folder_with("quads/pawn.obj");
    // 9.6 million quads: seconds of work.
    let run = Command::new(env!("CARGO_BIN_EXE_hexmill"))
        .args(["refine", "pawn.obj", "-o", "out.obj", "--levels", "7"])
        .current_dir(&folder)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    std::thread::sleep(Duration::from_millis(700));
    let sent = Command::new("kill").args(["-INT", &run.id().to_string()]).status().unwrap();
    assert!(sent.success());
    let output = run.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "interrupted: nothing was written\n");
    assert_eq!(files(&folder), ["pawn.obj"]);
}
