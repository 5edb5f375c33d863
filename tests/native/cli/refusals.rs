//! What the command line refuses, with which words and which exit code.

use super::{fail, files, folder_holding, folder_with, hexmill};

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
        &["refine", "in.obj", "-o", "out.stl"],
        "out.stl: the extension names no mesh format; use one of .obj,",
    );
    misused(&["convert", "in", "-o", "out.obj"], "in: the extension names no mesh format");
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
