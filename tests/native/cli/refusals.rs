//! What the command line refuses, with which words and which exit code.

use tempfile::TempDir;

use super::{fail, files, folder_holding, folder_with, hexmill, json, succeed};

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

/// Checks that the command line is told to make no sense, in a message with `part` in it.
#[track_caller]
fn misused(args: &[&str], part: &str) {
    let folder = folder_holding("in.obj", SQUARE);
    let run = hexmill(&folder, args);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(run.stderr.starts_with("error: ") && run.stderr.contains(part), "{}", run.stderr);
    assert_eq!(files(&folder), ["in.obj"]);
}

#[test]
fn output_is_required() {
    misused(&["refine", "in.obj"], "--output <OUT>");
}

#[test]
fn options_must_exist() {
    misused(&["refine", "in.obj", "-o", "out.obj", "--edge-lenght", "1"], "--edge-length");
}

#[test]
fn edge_length_must_be_positive() {
    misused(&["refine", "in.obj", "-o", "out.obj", "--edge-length=-1"], "give a number above 0");
    misused(&["refine", "in.obj", "-o", "out.obj", "--edge-length", "nan"], "give a number above 0");
}

#[test]
fn options_must_be_within_their_range() {
    for (option, value, part) in [
        ("--gradation", "3", "invalid value '3' for '--gradation <G>': give a number above 1, at most 2"),
        ("--gradation", "1", "above 1, at most 2"),
        ("--gradation", "nan", "above 1, at most 2"),
        (
            "--curvature",
            "181",
            "invalid value '181' for '--curvature <DEG>': give a number above 0, at most 180",
        ),
        (
            "--levels",
            "40",
            "invalid value '40' for '--levels <N>': give a whole number from 0 to 30, of hexes to 20",
        ),
        ("--levels", "255", "give a whole number from 0 to 30, of hexes to 20"),
        (
            "--levels",
            "-1",
            "invalid value '-1' for '--levels <N>': give a whole number from 0 to 30, of hexes to 20",
        ),
        ("--levels", "13", "--levels is 13, but --max-levels 12; give fewer levels"),
        (
            "--max-levels",
            "31",
            "invalid value '31' for '--max-levels <N>': give a whole number from 0 to 30, of hexes to 20",
        ),
        ("--max-quads", "1073741825", "1073741825 is not in 1..=1073741824"),
        ("--max-quads", "0", "0 is not in 1..=1073741824"),
        ("--threads", "1025", "1025 is not in 1..=1024"),
        ("--threads", "many", "invalid value 'many' for '--threads <N>'"),
    ] {
        misused(&["refine", "in.obj", "-o", "out.obj", &format!("{option}={value}")], part);
        // A number below 0 is a value, not an option.
        misused(&["refine", "in.obj", "-o", "out.obj", option, value], part);
    }
    misused(
        &["refine", "in.obj", "-o", "out.obj", "--levels=3", "--max-levels=2"],
        "--levels is 3, but --max-levels 2",
    );
    for angle in ["0", "180", "nan"] {
        let wanted =
            format!("invalid value '{angle}' for '--feature-angle <DEG>': give a number above 0, below 180");
        misused(&["hex", "in.obj", "-o", "out.vtu", "-e=1", "--feature-angle", angle], &wanted);
    }
}

/// Checks that a command line is told to write over a file that it needs, and that the file stays as it is.
#[track_caller]
fn overwrites(args: &[&str], part: &str) {
    let folder = folder_holding("in.obj", SQUARE);
    std::fs::create_dir(folder.path().join("sub")).unwrap();
    let before = files(&folder);
    let run = hexmill(&folder, args);
    assert_eq!(run.code, Some(2), "{args:?}: {}", run.stderr);
    assert!(run.stderr.starts_with("error: ") && run.stderr.contains(part), "{}", run.stderr);
    assert!(run.stderr.contains("For more information, try '--help'"), "{}", run.stderr);
    assert_eq!(files(&folder), before);
    assert_eq!(std::fs::read_to_string(folder.path().join("in.obj")).unwrap(), SQUARE);
}

#[test]
fn no_file_is_both_read_and_written() {
    for input in ["in.obj", "./in.obj", "sub/../in.obj"] {
        overwrites(&["refine", input, "-o", "in.obj"], "--output and the input are the same file: in.obj");
        overwrites(&["refine", "in.obj", "-o", input], "--output and the input are the same file");
        overwrites(&["convert", input, "-o", "in.obj"], "--output and the input are the same file");
        overwrites(&["check", input, "--report", "in.obj"], "--report and the mesh are the same file");
    }
    overwrites(
        &["refine", "in.obj", "-o", "out.obj", "--report", "in.obj"],
        "--report and the input are the same file",
    );
    overwrites(
        &["refine", "missing.obj", "-o", "in.obj", "-r", "points:in.obj,1:level=2"],
        "--output and a region's file are the same file",
    );
    overwrites(
        &["check", "missing.obj", "--surface", "in.obj", "--report", "in.obj"],
        "--report and --surface are the same file",
    );
}

#[test]
fn no_file_is_written_twice() {
    for report in ["out.obj", "./out.obj", "sub/../out.obj"] {
        overwrites(
            &["refine", "in.obj", "-o", "out.obj", "--report", report],
            "--report and --output are the same file",
        );
    }
}

#[cfg(unix)]
#[test]
fn a_link_to_the_input_is_the_input() {
    let folder = folder_holding("in.obj", SQUARE);
    std::os::unix::fs::symlink("in.obj", folder.path().join("link.obj")).unwrap();
    let run = hexmill(&folder, &["convert", "in.obj", "-o", "link.obj"]);
    assert_eq!(run.code, Some(2), "{}", run.stderr);
    assert!(run.stderr.contains("are the same file: link.obj"), "{}", run.stderr);
}

/// The input is no OBJ, but that is not found out: the outputs are looked at first.
#[test]
fn outputs_that_cannot_be_written_are_found_before_the_work() {
    let folder = folder_holding("in.obj", "this is not OBJ");
    std::fs::create_dir(folder.path().join("sub.obj")).unwrap();
    std::fs::write(folder.path().join("out.obj"), "an older file").unwrap();
    let missing = "cannot be written: no such file or directory; check the path";
    let directory = "cannot be written: is a directory; check the file and its folder";
    for (args, message) in [
        (vec!["refine", "in.obj", "-o", "away/out.obj"], format!("away/out.obj: {missing}")),
        (vec!["refine", "in.obj", "-o", "sub.obj"], format!("sub.obj: {directory}")),
        (
            vec!["refine", "in.obj", "-o", "out.obj", "--report", "away/r.json"],
            format!("away/r.json: {missing}"),
        ),
        (vec!["refine", "in.obj", "-o", "out.obj", "--report", "sub.obj"], format!("sub.obj: {directory}")),
        (vec!["convert", "in.obj", "-o", "away/out.obj"], format!("away/out.obj: {missing}")),
        (vec!["check", "in.obj", "--report", "away/r.json"], format!("away/r.json: {missing}")),
    ] {
        fail(&folder, &args, 1, &format!("error[file-not-written]: {message}"));
    }
    assert_eq!(files(&folder), ["in.obj", "out.obj", "sub.obj"]);
    assert_eq!(std::fs::read_to_string(folder.path().join("out.obj")).unwrap(), "an older file");
}

#[test]
fn threads_must_be_positive() {
    misused(&["refine", "in.obj", "-o", "out.obj", "--threads", "0"], "1..=1024");
}

#[test]
fn regions_must_be_well_formed() {
    misused(
        &["refine", "in.obj", "-o", "out.obj", "-r", "sphere:0,0,0:h=1"],
        "a sphere is sphere:cx,cy,cz,r",
    );
    misused(&["refine", "in.obj", "-o", "out.obj", "-r", "cone:0,0,0:h=1"], "there is no region 'cone'");
}

#[test]
fn extensions_must_be_known() {
    misused(
        &["refine", "in.obj", "-o", "out.step"],
        "out.step: the extension names no mesh format; use one of .obj,",
    );
    misused(&["convert", "in", "-o", "out.obj"], "in: the extension names no mesh format");
}

#[test]
fn outputs_that_cannot_hold_the_mesh_are_refused_before_the_work() {
    misused(
        &["refine", "in.obj", "-o", "out.stl"],
        "out.stl: STL files are only read; use one of .obj, .vtu",
    );
    misused(
        &["hex", "in.obj", "-o", "out.obj", "-e", "1"],
        "out.obj: OBJ files hold no hexes; use one of .vtu",
    );
    misused(&["grid", "in.obj", "-o", "out.stl", "--spacing", "1"], "out.stl: STL files are only read");
    let folder = folder_with("quads/helmet.obj");
    succeed(&folder, &["grid", "helmet.obj", "-o", "box.vtu", "--spacing", "0.2"]);
    let run = hexmill(&folder, &["refine", "box.vtu", "-o", "out.obj", "--levels", "1"]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(2), ""));
    assert!(run.stderr.contains("out.obj: OBJ files hold no hexes"), "{}", run.stderr);
}

#[test]
fn negative_sizes_are_refused_as_sizes() {
    misused(&["refine", "in.obj", "-o", "out.obj", "--edge-length", "-1"], "give a number above 0");
}

/// Runs `hexmill` with its results going to `output`; gives the exit code and what it says beside them.
#[cfg(target_os = "linux")]
fn printing_to(folder: &TempDir, args: &[&str], output: std::process::Stdio) -> (Option<i32>, String) {
    let mut command = std::process::Command::new(env!("CARGO_BIN_EXE_hexmill"));
    let done = command.args(args).current_dir(folder).stdout(output).output().expect("it starts");
    (done.status.code(), String::from_utf8(done.stderr).expect("UTF-8"))
}

#[cfg(target_os = "linux")]
#[test]
fn a_reader_that_goes_away_is_no_failure_and_a_full_device_is_one() {
    let folder = folder_with("quads/helmet.obj");
    let commands: [&[&str]; 4] = [
        &["refine", "helmet.obj", "-o", "out.vtu", "--report", "r.json"],
        &["check", "helmet.obj", "--report", "s.json"],
        &["convert", "helmet.obj", "-o", "out.vtk"],
        &["grid", "helmet.obj", "-o", "grid.vtu", "--spacing", "0.2"],
    ];
    for args in commands {
        let (reader, writer) = std::io::pipe().expect("a pipe");
        drop(reader);
        assert_eq!(printing_to(&folder, args, writer.into()), (Some(0), String::new()), "{args:?}");
        let full = std::fs::OpenOptions::new().write(true).open("/dev/full").expect("Linux has it");
        let (code, said) = printing_to(&folder, args, full.into());
        assert_eq!(code, Some(1), "{args:?}");
        assert!(said.starts_with("error[output-not-written]: standard output: cannot be written"), "{said}");
    }
    for report in ["r.json", "s.json"] {
        assert!(json(&folder, report)["mesh"].is_object(), "the report comes first");
    }
}

#[test]
fn a_missing_file_is_refused() {
    let folder = folder_holding("other.obj", "");
    let message = "error[file-not-read]: in.obj: cannot be read: no such file or directory; check the path";
    fail(&folder, &["refine", "in.obj", "-o", "out.obj"], 1, message);
}

#[test]
fn a_bad_file_is_refused_with_its_line() {
    let folder = folder_holding("in.obj", "v 0 0 0\nv 1 0 0\nf 1 2\n");
    let message = "error[obj-face-too-short]: in.obj: line 3: face has 2 nodes; a face needs at least 3 — \
                   remove it or write it as an 'l' polyline";
    fail(&folder, &["refine", "in.obj", "-o", "out.obj"], 1, message);
    assert_eq!(files(&folder).len(), 1);
}

#[test]
fn a_surface_without_faces_is_refused() {
    let folder = folder_holding("in.obj", "v 0 0 0\n");
    let message =
        "error[surface-empty]: in.obj: the surface has no faces; give one with at least one polygon";
    fail(&folder, &["refine", "in.obj", "-o", "out.obj"], 1, message);
}

#[test]
fn too_many_quads_are_refused_and_the_output_stays_as_it_was() {
    let folder = folder_with("quads/pawn.obj");
    std::fs::write(folder.path().join("out.obj"), "an older file").unwrap();
    let run =
        hexmill(&folder, &["refine", "pawn.obj", "-o", "out.obj", "--levels", "9", "--max-quads", "1000000"]);
    assert_eq!(run.code, Some(1));
    assert!(run.stderr.starts_with("error[too-many-quads]: pawn.obj: level "), "{}", run.stderr);
    assert_eq!(std::fs::read_to_string(folder.path().join("out.obj")).unwrap(), "an older file");
    assert_eq!(files(&folder).len(), 2, "no temporary file is left");
}

#[test]
fn a_region_s_missing_file_is_refused() {
    let folder = folder_holding("in.obj", SQUARE);
    let message =
        "error[file-not-read]: probes.obj: cannot be read: no such file or directory; check the path";
    fail(&folder, &["refine", "in.obj", "-o", "out.obj", "-r", "points:probes.obj,1:level=2"], 1, message);
}

#[test]
fn a_region_s_surface_needs_faces() {
    let folder = folder_holding("in.obj", SQUARE);
    std::fs::write(folder.path().join("points.obj"), "v 0 0 0\n").unwrap();
    let message = "error[surface-empty]: points.obj: holds no faces; give a mesh with at least one";
    fail(&folder, &["refine", "in.obj", "-o", "out.obj", "-r", "surface:points.obj,1:level=2"], 1, message);
}

#[test]
fn a_folder_that_is_not_there_is_refused() {
    let folder = folder_holding("in.obj", SQUARE);
    let message =
        "error[file-not-written]: away/out.obj: cannot be written: no such file or directory; check the path";
    fail(&folder, &["convert", "in.obj", "-o", "away/out.obj"], 1, message);
}
