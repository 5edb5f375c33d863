//! `hexmill refine` of hexes: what it tells, and what it refuses.

use serde_json::json;
use tempfile::TempDir;

use super::{Run, folder_holding, hexmill, json, succeed};

/// A folder with a grid of 4 by 4 by 4 cubes of length 1, from 0 to 4: `grid.vtu`.
pub(super) fn folder_with_grid() -> TempDir {
    let folder = folder_holding("part.obj", "v 0 0 0\nv 4 4 0\nv 0 4 4\nf 1 2 3\n");
    succeed(&folder, &["grid", "part.obj", "--spacing", "1", "-o", "grid.vtu"]);
    folder
}

/// Refines the grid; what will be made is told on stderr before.
fn refine(folder: &TempDir, more: &[&str]) -> Run {
    hexmill(folder, &[&["refine", "grid.vtu", "-o", "fine.vtu", "--report", "r.json"], more].concat())
}

fn refined(folder: &TempDir, more: &[&str]) -> Run {
    let run = refine(folder, more);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    run
}

#[test]
fn what_is_refined_unasked_is_told_before_the_work_and_recorded() {
    let folder = folder_with_grid();
    let run = refined(&folder, &["--method", "two", "--region", "box:1,1,1,3,3,3:level=2"]);
    let told = "  56 elements are refined that nothing asks for, so that elements are in families or blocks of eight\n";
    assert!(run.stderr.contains(told), "{}", run.stderr);
    assert!(run.stdout.contains("  672 hexes are transitions of the last level\n"), "{}", run.stdout);
    let record = json(&folder, "r.json");
    assert_eq!(record["mesh"]["hexes"], 1632);
    assert_eq!(record["refinement"]["added"]["base"], 56);
    assert_eq!(record["options"]["growth"], "allow");
    assert!(record["refinement"]["forecast"]["bytes"].as_u64() > Some(1632 * 100));
}

#[test]
fn regions_that_meet_no_hex_are_told() {
    let folder = folder_with_grid();
    let Run { stdout, .. } = refined(&folder, &["--region", "sphere:9,9,9,0.1:level=3"]);
    let told = "  region sphere:9,9,9,0.1:level=3 meets nothing of the input and refines nothing\n";
    assert!(stdout.contains(told), "{stdout}");
    assert_eq!(json(&folder, "r.json")["idleRegions"], json!(["sphere:9,9,9,0.1:level=3"]));
}

#[test]
fn hexes_that_were_turned_are_told() {
    let cube = "MeshVersionFormatted 2\nDimension 3\nVertices\n8\n0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n0 0 1 0\n\
                1 0 1 0\n1 1 1 0\n0 1 1 0\nHexahedra\n1\n5 6 7 8 1 2 3 4 0\nEnd\n";
    let folder = folder_holding("cube.mesh", cube);
    let run = hexmill(&folder, &["refine", "cube.mesh", "-o", "fine.vtu", "--levels", "1"]);
    let told = "  1 hex of the input was numbered inside out, and turned\n";
    assert!(run.stdout.contains(told), "{} {}", run.stdout, run.stderr);
}

#[test]
fn nodes_that_are_not_welded_are_told() {
    let cube =
        |x: u32| format!("{x} 0 0\n{0} 0 0\n{0} 1 0\n{x} 1 0\n{x} 0 1\n{0} 0 1\n{0} 1 1\n{x} 1 1\n", x + 1);
    let cells = "CELLS 2 18\n8 0 1 2 3 4 5 6 7\n8 8 9 10 11 12 13 14 15\nCELL_TYPES 2\n12\n12\n";
    let mesh = format!(
        "# vtk DataFile Version 3.0\ntwo\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 16 double\n{}{}{cells}",
        cube(0),
        cube(1)
    );
    let folder = folder_holding("two.vtk", &mesh);
    let run = hexmill(&folder, &["refine", "two.vtk", "-o", "fine.vtu", "--levels", "1"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stderr.contains("warning: 4 nodes stand exactly where others do; "), "{}", run.stderr);
}

#[test]
fn arrays_that_are_left_out_are_told() {
    let mesh = "# vtk DataFile Version 3.0\none\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 8 double\n0 0 0\n1 0 0\n1 1 0\n\
                0 1 0\n0 0 1\n1 0 1\n1 1 1\n0 1 1\nCELLS 1 9\n8 0 1 2 3 4 5 6 7\nCELL_TYPES 1\n12\nCELL_DATA 1\n\
                SCALARS stress double 1\nLOOKUP_TABLE default\n0.5\nVECTORS flux double\n1 2 3\n";
    let folder = folder_holding("one.vtk", mesh);
    let run = hexmill(&folder, &["refine", "one.vtk", "-o", "fine.vtu", "--levels", "1"]);
    let told = "warning: one.vtk: these arrays are no tags of cells, and are left out: stress, flux\n";
    assert_eq!(run.stderr.matches(told).count(), 1, "{}", run.stderr);
    let run = hexmill(&folder, &["refine", "one.vtk", "-o", "fine.vtu", "--levels", "1", "--quiet"]);
    assert_eq!(run.stderr, "");
}

#[test]
fn cells_that_the_file_hides_are_told() {
    let mesh = "# vtk DataFile Version 3.0\ntwo\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 3 2 2\nCELL_DATA 2\n\
                SCALARS vtkGhostType unsigned_char\nLOOKUP_TABLE default\n0 32\n";
    let folder = folder_holding("two.vtk", mesh);
    let run = hexmill(&folder, &["refine", "two.vtk", "-o", "fine.vtu", "--levels", "1"]);
    let told = "warning: two.vtk: 1 cell is left out, as hidden or of another piece (vtkGhostType)\n";
    assert_eq!((run.code, run.stderr.matches(told).count()), (Some(0), 1), "{}", run.stderr);
    assert!(
        run.stderr.contains(": 8 hexes") || run.stdout.contains("8 hexes"),
        "{}{}",
        run.stdout,
        run.stderr
    );
    let run = hexmill(&folder, &["check", "two.vtk", "--quiet"]);
    assert!(!run.stderr.contains("vtkGhostType"), "{}", run.stderr);
}

#[test]
fn growth_is_refused_if_that_is_wanted() {
    let folder = folder_with_grid();
    let regions = ["--region", "box:1,1,1,2,2,2:level=2", "--region", "box:2,2,1,3,3,2:level=2"];
    let touching = [&regions[..], &["--method", "one"]].concat();
    refined(&folder, &touching);
    let run = refine(&folder, &[&touching[..], &["--no-growth"]].concat());
    assert_eq!(run.code, Some(1));
    let told = "would be refined so that all are in families of eight, the first around 0.5, 0.5, 0.5; ";
    assert!(run.stderr.contains(told), "{}", run.stderr);
    let run = refine(&folder, &[&touching[..], &["--no-growth", "--levels", "1"]].concat());
    assert_eq!(run.code, Some(1));
    assert!(run.stderr.contains("error[growth-refused]: grid.vtu: "), "{}", run.stderr);
    let told = "would be refined for the method's templates, the first around";
    assert!(run.stderr.contains(told), "{}", run.stderr);
}

#[test]
fn limits_are_told_by_the_options_names() {
    let folder = folder_with_grid();
    for (more, code, message) in [
        (
            &["--levels", "12"][..],
            2,
            "--levels is 12, but --max-levels 8; give fewer levels, or raise --max-levels",
        ),
        (&["--levels", "21", "--max-levels", "30"], 2, "--levels is 21; for hexes give at most 20"),
        (&["--levels", "1", "--max-levels", "30"], 2, "--max-levels is 30; for hexes give at most 20"),
        (
            &["--levels", "2", "--max-hexes", "1000"],
            1,
            "error[too-many-hexes]: grid.vtu: level 2 would bring the mesh to 4096 hexes or more, over the limit of \
             1000; ask for a larger edge length, fewer levels or smaller regions, or raise the limit (--max-hexes)",
        ),
    ] {
        let run = refine(&folder, more);
        assert_eq!(run.code, Some(code));
        assert!(run.stderr.contains(message), "{}", run.stderr);
    }
}
