//! `hexmill hex`.

use super::{folder_holding, hexmill, json, succeed};

/// A cube of edge 2.
const CUBE: &str = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nv 0 0 2\nv 2 0 2\nv 2 2 2\nv 0 2 2\n\
    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

#[test]
fn a_cube_is_filled_with_cubes_and_keeps_its_surfaces_as_groups() {
    let folder = folder_holding("cube.obj", CUBE);
    let stdout = succeed(&folder, &["hex", "cube.obj", "-o", "cube.msh", "-e", "0.5", "--report", "r.json"]);
    assert!(stdout.starts_with("cube.msh: 125 nodes, 64 hexes"), "{stdout}");
    assert!(stdout.contains("captured 8 of 8 corners, 12 of 12 curves, 6 of 6 surfaces"), "{stdout}");
    let report = json(&folder, "r.json");
    let result = &report["hexing"]["attempts"][0];
    assert_eq!(result["core"]["euler"], 2);
    assert!(result["worst"].as_f64().unwrap() > 1.0 - 1e-9, "{result}");
    assert!(result["distance"]["surfaceToMesh"]["max"].as_f64().unwrap() < 1e-12, "{result}");
    let checked = succeed(&folder, &["check", "cube.msh", "--report", "c.json"]);
    assert!(checked.contains("no defects"), "{checked}");
    assert_eq!(json(&folder, "c.json")["mesh"]["groupedFaces"], 96);
}

#[test]
fn what_bounds_no_solid_is_refused() {
    let open = CUBE.replace("f 5 6 7 8\n", "");
    let folder = folder_holding("open.obj", &open);
    let refused = |folder, args: &[&str]| {
        let run = hexmill(folder, args);
        assert_eq!((run.code, run.stdout.as_str()), (Some(1), ""), "{args:?}");
        run.stderr
    };
    let error = refused(&folder, &["hex", "open.obj", "-o", "out.vtu", "-e", "0.5"]);
    assert!(error.contains("open.obj: the surface is open: 4 edges belong to one face only"), "{error}");
    let folder = folder_holding("cube.obj", CUBE);
    let error = refused(&folder, &["hex", "cube.obj", "-o", "out.vtu", "-e", "0.00001"]);
    assert!(error.starts_with("error[too-many-hexes]: cube.obj: about"), "{error}");
}
