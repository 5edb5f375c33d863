//! `hexmill refine`: what it writes, and its record.

use hexmill::io::{Document, obj};
use hexmill::mesh::{Group, PolygonMesh, check_polygons};
use serde_json::json;
use tempfile::TempDir;

use super::{files, folder_holding, folder_with, hexmill, json, succeed};

/// The surface in an OBJ file of `folder`.
fn surface(folder: &TempDir, file: &str) -> PolygonMesh {
    let document: Document = obj::read(&std::fs::read(folder.path().join(file)).unwrap()).unwrap();
    document.into_surface().unwrap()
}

#[test]
fn levels_divide_every_quad() {
    let folder = folder_with("quads/pawn.obj");
    let stdout = succeed(&folder, &["refine", "pawn.obj", "-o", "out.obj", "--levels", "2"]);
    let mesh = surface(&folder, "out.obj");
    assert_eq!(mesh.face_count(), 588 * 16);
    assert!(mesh.is_all_quad());
    assert_eq!(check_polygons(&mesh), []);
    assert!(stdout.starts_with("out.obj: 9457 nodes, 9408 quads\n  9408 of level 2\n"), "{stdout}");
    assert_eq!(files(&folder), ["out.obj", "pawn.obj"]);
}

#[test]
fn features_that_are_lost_are_counted() {
    let folder = folder_with("creases/cube_creases0.obj");
    let args = ["refine", "cube_creases0.obj", "-o", "out.obj", "--levels", "1", "--report", "r.json"];
    let stdout = succeed(&folder, &args);
    let told = "  0 polylines, 2 creases and 0 corners of the input do not go over to the mesh\n";
    assert!(stdout.contains(told), "{stdout}");
    let counts = json!({"polylines": 0, "creases": 2, "corners": 0});
    assert_eq!(json(&folder, "r.json")["droppedFeatures"], counts);
}

#[test]
fn regions_that_meet_nothing_are_told() {
    let folder = folder_with("quads/pawn.obj");
    let regions = ["--region", "sphere:90,0,0,1:level=2", "--region", "box:-9,-9,-9,9,9,9:level=1"];
    let args = ["refine", "pawn.obj", "-o", "out.obj", "--report", "r.json"];
    let stdout = succeed(&folder, &[&args[..], &regions[..]].concat());
    let told = "  region sphere:90,0,0,1:level=2 meets nothing of the input and refines nothing\n";
    assert!(stdout.contains(told), "{stdout}");
    assert_eq!(json(&folder, "r.json")["idleRegions"], json!(["sphere:90,0,0,1:level=2"]));
}

#[test]
fn triangles_and_polygons_become_quads() {
    for (model, file) in [("solids/spot.obj", "spot.obj"), ("quads/bishop.obj", "bishop.obj")] {
        let folder = folder_with(model);
        let corners = surface(&folder, file).corners.len();
        succeed(&folder, &["refine", file, "-o", "out.obj", "--levels", "1"]);
        let mesh = surface(&folder, "out.obj");
        assert!(mesh.is_all_quad());
        assert_eq!(mesh.face_count(), corners, "{model}: a quad for each corner of the input");
    }
}

#[test]
fn edge_length_bounds_every_edge() {
    let folder = folder_with("quads/torus_creases0.obj");
    succeed(&folder, &["refine", "torus_creases0.obj", "-o", "out.obj", "--edge-length", "0.2"]);
    let mesh = surface(&folder, "out.obj");
    let length = |a: usize, b: usize| mesh.positions[a].distance(mesh.positions[b]);
    let edges = mesh.faces().flat_map(|f| (0..4).map(|i| length(f[i].index(), f[(i + 1) % 4].index())));
    let longest = edges.fold(0.0, f64::max);
    assert!(longest <= 0.2 && longest > 0.05, "{longest}");
}

#[test]
fn the_report_tells_what_is_in_the_output() {
    let folder = folder_with("quads/bishop.obj");
    let region = "sphere:0.96,-1.74,0.05,0.1:level=3";
    let args =
        ["refine", "bishop.obj", "-o", "out.obj", "--region", region, "--report", "r.json", "--threads", "2"];
    succeed(&folder, &args);
    let report = json(&folder, "r.json");
    let mesh = surface(&folder, "out.obj");

    assert_eq!(report["schema"], "hexmill-report/1");
    assert_eq!(report["version"], env!("CARGO_PKG_VERSION"));
    assert_eq!(report["command"], "refine");
    assert_eq!(report["threads"], 2);
    assert_eq!((&report["input"]["file"], &report["input"]["format"]), (&json!("bishop.obj"), &json!("obj")));
    assert_eq!((&report["input"]["nodes"], &report["input"]["faces"]), (&json!(917), &json!(968)));
    assert_eq!(report["options"]["regions"], json!([region]));
    assert_eq!(report["options"]["maxLevels"], 12);
    assert_eq!(report["output"]["bytes"], std::fs::metadata(folder.path().join("out.obj")).unwrap().len());
    assert_eq!(report["mesh"]["nodes"], mesh.positions.len());
    assert_eq!(report["mesh"]["quads"], mesh.face_count());
    assert_eq!(report["mesh"]["defects"]["conforming"], true);
    assert_eq!(report["mesh"]["topology"]["faces"], mesh.face_count());

    let levels = report["mesh"]["levels"].as_array().unwrap();
    let cells: u64 = levels.iter().map(|level| level["cells"].as_u64().unwrap()).sum();
    assert_eq!(cells, mesh.face_count() as u64);
    assert_eq!(levels.last().unwrap()["level"], 3);

    let jacobian = &report["mesh"]["quality"]["scaledJacobian"];
    assert!(jacobian["min"].as_f64().unwrap() <= jacobian["mean"].as_f64().unwrap());
    let counts = jacobian["histogram"]["counts"].as_array().unwrap();
    assert_eq!(counts.iter().map(|n| n.as_u64().unwrap()).sum::<u64>(), mesh.face_count() as u64);

    let stages: Vec<&str> =
        report["stages"].as_array().unwrap().iter().map(|s| s["stage"].as_str().unwrap()).collect();
    assert_eq!((stages[0], stages[stages.len() - 1]), ("read", "check"));
    let spent: f64 =
        report["stages"].as_array().unwrap().iter().map(|s| s["seconds"].as_f64().unwrap()).sum();
    assert!(spent > 0.0 && spent <= report["seconds"].as_f64().unwrap());
    if cfg!(target_os = "linux") {
        assert!(report["peakMemoryBytes"].as_u64().unwrap() > 1 << 20);
    }
}

#[test]
fn the_hash_in_the_report_is_the_mesh_s_and_check_finds_it_again() {
    let folder = folder_with("quads/helmet.obj");
    succeed(&folder, &["refine", "helmet.obj", "-o", "out.obj", "--levels", "2", "--report", "r.json"]);
    succeed(&folder, &["check", "out.obj", "--report", "c.json"]);
    let hash = &json(&folder, "r.json")["mesh"]["hash"];
    assert_eq!(hash.as_str().unwrap().len(), 32);
    assert_eq!(hash, &json(&folder, "c.json")["mesh"]["hash"]);
}

#[test]
fn the_result_does_not_depend_on_the_threads() {
    let folder = folder_with("solids/spot.obj");
    let run = |threads: &str| {
        let (out, report) = (format!("{threads}.obj"), format!("{threads}.json"));
        let region = "sphere:0,0.6,0.5,0.4:level=4";
        let args =
            ["refine", "spot.obj", "-o", &out, "-r", region, "--threads", threads, "--report", &report, "-q"];
        assert_eq!(succeed(&folder, &args), "", "quiet");
        let hash = json(&folder, &report)["mesh"]["hash"].clone();
        (hash, std::fs::read(folder.path().join(out)).unwrap())
    };
    let one = run("1");
    assert!(one == run("2"));
    assert!(one == run("4"));
}

/// The deepest level, and the number of quads, of the torus refined with `args`.
#[track_caller]
fn torus(args: &[&str]) -> (u64, u64) {
    let folder = folder_with("quads/torus_creases0.obj");
    std::fs::write(folder.path().join("probe.obj"), "v 1.25 -0.35 0.51\n").unwrap();
    std::fs::write(folder.path().join("wall.obj"), "v 1 -1 -1\nv 1 1 -1\nv 1 1 1\nv 1 -1 1\nf 1 2 3 4\n")
        .unwrap();
    let fixed = ["refine", "torus_creases0.obj", "-o", "out.obj", "--report", "r.json"];
    succeed(&folder, &[&fixed, args].concat());
    let mesh = &json(&folder, "r.json")["mesh"];
    assert_eq!(mesh["defects"]["counts"], json!([]));
    let deepest = mesh["levels"].as_array().unwrap().last().unwrap()["level"].as_u64().unwrap();
    (deepest, mesh["quads"].as_u64().unwrap())
}

#[test]
fn every_kind_of_region_refines_there_and_not_everywhere() {
    for region in [
        "box:0.9,-0.5,-0.5,1.5,0.5,0.5:level=3",
        "box:0.9,-0.1,-0.9,1.5,0.1,0.9,0,45,0:level=3",
        "box:0.9,-0.1,-0.9,1.5,0.1,0.9,0,0,1,1:level=3",
        "sphere:1.25,0,0.5,0.3:level=3",
        "cylinder:1.25,-1,0.5,1.25,1,0.5,0.2:level=3",
        "points:probe.obj,0.1:level=3",
        "surface:wall.obj,0.05:level=3",
    ] {
        let (deepest, quads) = torus(&["--region", region]);
        assert_eq!(deepest, 3, "{region}");
        assert!(quads > 4 * 32 && quads < 64 * 32, "{region}: {quads}");
    }
}

#[test]
fn regions_by_size_reach_it() {
    // Edges of the torus are up to 1.04 long: three halvings bring them under 0.2.
    assert_eq!(torus(&["-r", "sphere:1.25,0,0.5,0.3:h=0.2"]).0, 3);
}

#[test]
fn levels_can_be_capped_and_what_that_leaves_is_told() {
    let folder = folder_with("quads/torus_creases0.obj");
    let args = ["refine", "torus_creases0.obj", "-o", "out.obj", "-e", "0.01", "--max-levels", "2"];
    let stdout = succeed(&folder, &args);
    assert!(stdout.contains("512 elements are larger than asked for: raise --max-levels, now 2"), "{stdout}");
}

#[test]
fn curvature_refines() {
    let folder = folder_with("quads/pawn.obj");
    let stdout = succeed(&folder, &["refine", "pawn.obj", "-o", "out.obj", "--curvature", "5"]);
    assert!(stdout.contains(" of level 3\n"), "{stdout}");
}

#[test]
fn coarse_quads_can_be_kept() {
    let region = "sphere:1.25,0,0.5,0.2:level=2";
    let folder = folder_with("quads/torus_creases0.obj");
    let args = [
        "refine",
        "torus_creases0.obj",
        "-o",
        "out.obj",
        "-r",
        region,
        "--keep-coarse",
        "--report",
        "r.json",
    ];
    succeed(&folder, &args);
    let report = json(&folder, "r.json");
    assert_eq!(report["options"]["keepCoarse"], true);
    assert_eq!(report["mesh"]["levels"][0]["level"], 0);
}

#[test]
fn names_are_carried_to_the_quads() {
    let folder = folder_with("quads/helmet.obj");
    let text = std::fs::read_to_string(folder.path().join("helmet.obj")).unwrap();
    let named = text.replacen("\nf ", "\no shell\ng front\nusemtl steel\nf ", 1);
    std::fs::write(folder.path().join("helmet.obj"), named).unwrap();
    succeed(&folder, &["refine", "helmet.obj", "-o", "out.obj", "--levels", "1"]);
    let mesh = surface(&folder, "out.obj");
    assert_eq!(mesh.tags.of_element.len(), mesh.face_count());
    let set = mesh.tags.of(mesh.face_count() - 1).unwrap();
    assert_eq!((set.object.as_deref(), set.material.as_deref()), (Some("shell"), Some("steel")));
    assert_eq!(set.groups, ["front"].map(Group::from));
}

#[test]
fn an_output_that_is_there_is_replaced() {
    let folder = folder_with("quads/helmet.obj");
    std::fs::write(folder.path().join("out.obj"), "an older file").unwrap();
    succeed(&folder, &["refine", "helmet.obj", "-o", "out.obj"]);
    assert_eq!(surface(&folder, "out.obj").face_count(), 58);
}

#[test]
fn help_shows_worked_examples() {
    let folder = tempfile::tempdir().unwrap();
    let help = succeed(&folder, &["refine", "--help"]);
    for example in ["--edge-length 2", "--region sphere:0,0,0,10:h=0.5", "surface:shock.obj,1.5:h=0.25"] {
        assert!(help.contains(example), "{example}");
    }
    // The examples' options are all known: each runs as far as its missing input.
    let examples = help[help.find("Examples:").unwrap()..].replace("\\\n", " ");
    let lines: Vec<&str> = examples.lines().map(str::trim).filter(|l| l.starts_with("hexmill ")).collect();
    assert_eq!(lines.len(), 9, "{lines:?}");
    for line in lines {
        let args: Vec<&str> = line.split_whitespace().skip(1).collect();
        let run = hexmill(&folder, &args);
        assert_eq!(run.code, Some(1), "{line}: {}", run.stderr);
        let refusal = format!("error[file-not-read]: {}: cannot be read", args[1]);
        assert!(run.stderr.starts_with(&refusal), "{}", run.stderr);
    }
}

#[test]
fn groups_of_boundary_faces_go_through() {
    let mesh = "MeshVersionFormatted 2\nDimension 3\nVertices\n8\n0 0 0 0\n1 0 0 0\n1 1 0 0\n0 1 0 0\n0 0 1 0\n1 0 1 0\n\
                1 1 1 0\n0 1 1 0\nHexahedra\n1\n1 2 3 4 5 6 7 8 3\nQuadrilaterals\n2\n1 2 3 4 7\n2 3 8 5 9\nEnd\n";
    let folder = folder_holding("cube.mesh", mesh);
    let run =
        hexmill(&folder, &["refine", "cube.mesh", "-o", "fine.msh", "--levels", "1", "--report", "r.json"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    assert!(run.stderr.contains("warning: cube.mesh: 1 face beside the hexes is left out"), "{}", run.stderr);
    let report = json(&folder, "r.json");
    assert_eq!((&report["input"]["groupedFaces"], &report["mesh"]["groupedFaces"]), (&1.into(), &4.into()));
    let stdout = succeed(&folder, &["check", "fine.msh"]);
    assert!(stdout.contains("8 hexes, 4 faces in groups"), "{stdout}");
}
