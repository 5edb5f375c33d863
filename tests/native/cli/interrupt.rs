//! Ctrl-C.
#![cfg(target_os = "linux")]

use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use super::{files, folder_with};

/// Waits until process `id` has a handler for SIGINT: a busy machine may take its time to start it.
fn wait_for_handler(id: u32) {
    const SIGINT: u32 = 2;
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(60) {
        let status = std::fs::read_to_string(format!("/proc/{id}/status")).unwrap_or_default();
        let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap_or("0").trim();
        if u64::from_str_radix(caught, 16).unwrap() & 1 << (SIGINT - 1) != 0 {
            return;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
    panic!("the program does not handle SIGINT");
}

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
    wait_for_handler(run.id());
    std::thread::sleep(Duration::from_millis(300));
    let sent = Command::new("kill").args(["-INT", &run.id().to_string()]).status().unwrap();
    assert!(sent.success());
    let output = run.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(130));
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "interrupted: nothing was written\n");
    assert_eq!(files(&folder), ["pawn.obj"]);
}
