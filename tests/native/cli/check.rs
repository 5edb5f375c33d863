//! `hexmill check`.

use super::{folder_holding, folder_with, hexmill, json, succeed};

#[test]
fn a_closed_surface_has_no_defects() {
    let folder = folder_with("solids/3holes.obj");
    let stdout = succeed(&folder, &["check", "3holes.obj", "--report", "r.json"]);
    assert!(
        stdout.contains("components 1, boundary loops 0 (0 edges), Euler number -4, manifold, orientable"),
        "{stdout}"
    );
    assert!(stdout.contains("no defects"), "{stdout}");
    let report = json(&folder, "r.json");
    assert_eq!(report["command"], "check");
    assert_eq!(report["mesh"]["triangles"], 3982);
    assert_eq!(report["mesh"]["topology"]["euler"], -4);
    assert_eq!(report["mesh"]["defects"]["list"].as_array().unwrap().len(), 0);
    assert!(report["mesh"]["quality"].is_null(), "quality is that of quads");
    assert!(report.get("options").is_none());
}

#[test]
fn a_mesh_that_does_not_conform_is_refused() {
    let square = "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nv 1 0 0\nv 1 -1 0\nv 0 -1 0\nf 1 2 3 4\nf 7 6 5 1\n";
    let folder = folder_holding("hanging.obj", square);
    let run = hexmill(&folder, &["check", "hanging.obj", "--report", "r.json"]);
    assert_eq!(run.code, Some(1));
    assert!(
        run.stderr
            .starts_with("error[mesh-not-conforming]: hanging.obj: is not a conforming mesh: node 4 hangs"),
        "{}",
        run.stderr
    );
    assert!(run.stdout.contains("  error: node 4 hangs inside the edge"), "{}", run.stdout);
    let report = json(&folder, "r.json");
    assert_eq!(report["mesh"]["defects"]["conforming"], false);
    let list = report["mesh"]["defects"]["list"].as_array().unwrap();
    assert_eq!(list.iter().filter(|defect| defect["kind"] == "hangingNode").count(), 1);
}

#[test]
fn notes_are_no_reason_to_refuse() {
    let folder = folder_holding("loose.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 9 9 9\nf 1 2 3\n");
    let stdout = succeed(&folder, &["check", "loose.obj"]);
    assert!(stdout.contains("  note: node 3 is used by no face"), "{stdout}");
}

#[test]
fn distance_to_the_surface_both_ways() {
    let folder = folder_with("quads/pawn.obj");
    succeed(&folder, &["refine", "pawn.obj", "-o", "fine.obj", "--levels", "2"]);
    let stdout = succeed(&folder, &["check", "fine.obj", "--surface", "pawn.obj", "--report", "r.json"]);
    assert!(stdout.contains("distance to the surface: mean "), "{stdout}");
    let distance = &json(&folder, "r.json")["distance"];
    for way in ["meshToSurface", "surfaceToMesh"] {
        let (max, mean) = (distance[way]["max"].as_f64().unwrap(), distance[way]["mean"].as_f64().unwrap());
        // The quads of the model are flat to its six digits.
        assert!(mean <= max && max < 1e-6, "{way}: {distance}");
    }
}

#[test]
fn a_part_is_far_from_the_whole_one_way_alone() {
    let folder = folder_with("quads/helmet.obj");
    let text = std::fs::read_to_string(folder.path().join("helmet.obj")).unwrap();
    let faces: Vec<&str> = text.lines().filter(|line| line.starts_with("f ")).collect();
    let part: String = text
        .lines()
        .filter(|line| line.starts_with("v "))
        .chain(faces[..10].iter().copied())
        .fold(String::new(), |all, line| all + line + "\n");
    std::fs::write(folder.path().join("part.obj"), part).unwrap();
    succeed(&folder, &["check", "part.obj", "--surface", "helmet.obj", "--report", "r.json"]);
    let distance = &json(&folder, "r.json")["distance"];
    assert!(distance["meshToSurface"]["max"].as_f64().unwrap() < 1e-12, "{distance}");
    assert!(distance["surfaceToMesh"]["max"].as_f64().unwrap() > 0.5, "{distance}");
}
