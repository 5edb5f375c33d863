//! `hexmill check`.

use super::{folder_holding, folder_with, hexmill, json, succeed};

#[test]
fn a_closed_surface_has_no_defects() {
    let folder = folder_with("solids/3holes.obj");
    let stdout = succeed(&folder, &["check", "3holes.obj", "--threads", "1", "--report", "r.json"]);
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

/// A cube of edge 2 in eight hexes, as VTK writes it; `mirrored` turns the last one inside out.
fn eight_hexes(mirrored: bool) -> String {
    let mut text =
        String::from("# vtk DataFile Version 3.0\n\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 27 double\n");
    for m in 0..27 {
        text += &format!("{} {} {}\n", m % 3, m / 3 % 3, m / 9);
    }
    text += "CELLS 8 72\n";
    for m in 0..8 {
        let base = m % 2 + 3 * (m / 2 % 2) + 9 * (m / 4);
        let bottom = [0, 1, 4, 3].map(|n| (base + n).to_string()).join(" ");
        let top = [9, 10, 13, 12].map(|n| (base + n).to_string()).join(" ");
        text +=
            &if mirrored && m == 7 { format!("8 {top} {bottom}\n") } else { format!("8 {bottom} {top}\n") };
    }
    text + "CELL_TYPES 8\n" + &"12\n".repeat(8)
}

#[test]
fn hexes_are_checked_measured_and_hashed() {
    let folder = folder_holding("cube.vtk", &eight_hexes(false));
    let stdout = succeed(&folder, &["check", "cube.vtk", "--report", "r.json"]);
    for part in [
        "cube.vtk: 27 nodes, 8 hexes",
        "components 1, boundary surfaces 1 (24 faces), Euler number 1, manifold",
        "volume 8, of a hex 1 to 1",
        "no defects",
        "hash ",
    ] {
        assert!(stdout.contains(part), "{stdout}");
    }
    let mesh = &json(&folder, "r.json")["mesh"];
    assert_eq!((&mesh["hexes"], &mesh["faces"]), (&8.into(), &0.into()));
    assert_eq!(mesh["topology"]["boundaryFaces"], 24);
    assert_eq!(mesh["volume"]["total"], 8.0);

    std::fs::write(folder.path().join("shell.obj"), "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4\n")
        .unwrap();
    succeed(&folder, &["check", "cube.vtk", "--surface", "shell.obj", "--report", "d.json"]);
    let distance = &json(&folder, "d.json")["distance"];
    assert_eq!(distance["meshToSurface"]["max"], 2.0, "the far side of the boundary");
    assert_eq!(
        distance["meshToSurface"]["samples"],
        26 + 3 * 48 + 48,
        "nodes, sides and diagonals of the boundary"
    );
}

#[test]
fn a_hex_that_is_inside_out_is_an_error() {
    let folder = folder_holding("cube.vtk", &eight_hexes(true));
    let run = hexmill(&folder, &["check", "cube.vtk"]);
    assert_eq!(run.code, Some(1));
    assert!(run.stderr.contains("hex 7 is inside out at 8 corners (counted from 0)"), "{}", run.stderr);
    assert!(run.stdout.contains("hexes 3 and 7 lie on the same side of their face"), "{}", run.stdout);
}
