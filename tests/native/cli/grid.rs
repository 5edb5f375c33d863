//! `hexmill grid`.

use super::{fail, folder_holding, json, succeed};

/// A triangle that spans 2 by 1 by 1.
const TRIANGLE: &str = "v 0 0 0\nv 2 0 0\nv 1 1 1\nf 1 2 3\n";

#[test]
fn a_grid_around_a_surface_conforms() {
    let folder = folder_holding("part.obj", TRIANGLE);
    let stdout =
        succeed(&folder, &["grid", "part.obj", "--spacing", "0.5", "--margin", "0.5", "-o", "box.vtu"]);
    assert!(stdout.starts_with("box.vtu: 175 nodes, 96 hexes, "), "{stdout}");
    let checked = succeed(&folder, &["check", "box.vtu", "--report", "r.json"]);
    assert!(checked.contains("no defects"), "{checked}");
    let mesh = &json(&folder, "r.json")["mesh"];
    assert_eq!(mesh["volume"]["total"], 12.0);
    assert_eq!(mesh["bounds"]["min"][0], -0.5);
}

#[test]
fn a_fitted_grid_ends_where_the_margin_does() {
    let folder = folder_holding("part.obj", TRIANGLE);
    succeed(&folder, &["grid", "part.obj", "--spacing", "0.7", "--margin", "0.5", "--fit", "-o", "box.vtk"]);
    succeed(&folder, &["check", "box.vtk", "--report", "r.json"]);
    let mesh = &json(&folder, "r.json")["mesh"];
    assert_eq!(mesh["hexes"], 5 * 3 * 3);
    let volume = mesh["volume"]["total"].as_f64().expect("a volume");
    assert!((volume - 12.0).abs() < 1e-12, "{volume}");
}

#[test]
fn what_cannot_be_made_is_refused() {
    let folder = folder_holding("part.obj", TRIANGLE);
    fail(
        &folder,
        &["grid", "part.obj", "--spacing", "0.001", "-o", "box.vtu"],
        1,
        "error[too-many-hexes]: part.obj: 2000 by 1000 by 1000 hexes are more than the limit of 16000000; raise the \
         spacing or the limit",
    );
    fail(
        &folder,
        &["grid", "part.obj", "--spacing", "0.5", "--margin=-1", "-o", "box.vtu"],
        1,
        "error[margin-out-of-range]: part.obj: the margin is -1; give 0 or a positive number",
    );
}
