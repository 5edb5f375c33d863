//! `hexmill quad`.

use super::{fail, folder_holding, json, succeed};

/// A plate of 2 by 1 in the plane y = 3 with a square hole, as four polygons, and a line across one side.
const PLATE: &str = "v 0 3 0\nv 2 3 0\nv 2 3 1\nv 0 3 1\nv 0.8 3 0.3\nv 1.2 3 0.3\nv 1.2 3 0.7\nv 0.8 3 0.7\n\
    v 0.4 3 0\nv 0.4 3 1\n\
    f 1 9 2 6 5\nf 2 3 7 6\nf 3 10 4 8 7\nf 4 1 5 8\nl 9 10\n";

#[test]
fn a_planar_face_becomes_quads_in_its_plane() {
    let folder = folder_holding("face.obj", PLATE);
    let stdout = succeed(
        &folder,
        &["quad", "face.obj", "--edge-length", "0.1", "-o", "quads.vtu", "--report", "r.json"],
    );
    assert!(stdout.starts_with("quads.vtu: ") && stdout.contains(" quads\n"), "{stdout}");
    let report = json(&folder, "r.json");
    assert_eq!((&report["command"], &report["face"]["edgeLength"]), (&"quad".into(), &0.1.into()));
    assert_eq!(report["face"]["droppedPolylines"], serde_json::json!([]));
    let mesh = &report["mesh"];
    assert_eq!(mesh["defects"]["conforming"], true);
    assert_eq!((&mesh["topology"]["boundaryLoops"], &mesh["topology"]["euler"]), (&2.into(), &0.into()));
    assert!(mesh["quality"]["scaledJacobian"]["min"].as_f64().unwrap() > 0.5, "{mesh}");
    assert_eq!(
        (&mesh["bounds"]["min"], &mesh["bounds"]["max"]),
        (&serde_json::json!([0.0, 3.0, 0.0]), &serde_json::json!([2.0, 3.0, 1.0]))
    );
    let checked = succeed(&folder, &["check", "quads.vtu"]);
    assert!(checked.contains("no defects"), "{checked}");
}

#[test]
fn faces_that_cannot_be_meshed_are_refused() {
    let folder = folder_holding("face.obj", PLATE);
    fail(
        &folder,
        &["quad", "face.obj", "--edge-length", "0.0001", "-o", "quads.vtu"],
        1,
        "error[too-many-quads]: face.obj: the mesh would have about 184000000 quads, more than the limit of 16000000; \
         raise the edge length or the limit",
    );
    let bent = folder_holding("face.obj", &PLATE.replace("v 2 3 1", "v 2 3.1 1"));
    let args = ["quad", "face.obj", "--edge-length", "0.1", "-o", "quads.vtu"];
    let run = super::hexmill(&bent, &args);
    assert_eq!(run.code, Some(1));
    assert!(run.stderr.starts_with("error[not-planar]: face.obj: point "), "{}", run.stderr);
    let crossed = folder_holding("face.obj", "v 0 0 0\nv 3 0 0\nv 1 1 0\nv 2 1 0\nf 1 2 3 4\n");
    let run = super::hexmill(&crossed, &args);
    assert!(run.stderr.starts_with("error[outline-crosses-itself]: face.obj: "), "{}", run.stderr);
    let usage = super::hexmill(&folder, &["quad", "face.obj", "--edge-length=-1", "-o", "quads.vtu"]);
    assert_eq!(usage.code, Some(2));
}
