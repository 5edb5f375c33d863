//! `hexmill hex`.

use serde_json::json;

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
    let result = &report["hexing"]["result"];
    assert_eq!((&result["euler"], &result["solidEuler"]), (&json!(2), &json!(2)));
    let body = &report["hexing"]["bodies"][0];
    assert_eq!((&body["choice"]["kind"], &body["choice"]["gridCapture"]), (&json!("grid"), &json!(1.0)));
    assert_eq!(body["directions"][0]["surfaceCapture"], 1.0);
    assert_eq!((&body["kept"], &body["attempts"][0]["hexes"]), (&json!(0), &json!(64)));
    assert!(result["worst"].as_f64().unwrap() > 1.0 - 1e-9, "{result}");
    assert!(result["distance"]["surfaceToMesh"]["max"].as_f64().unwrap() < 1e-12, "{result}");
    let checked = succeed(&folder, &["check", "cube.msh", "--report", "c.json"]);
    assert!(checked.contains("no defects"), "{checked}");
    assert_eq!(json(&folder, "c.json")["mesh"]["groupedFaces"], 96);
}

/// Loads and supports go by the names that the part had.
#[test]
fn surfaces_keep_the_names_that_the_input_has_for_them() {
    let named = CUBE.replace("f 5 6 7 8\n", "g inlet upper\nusemtl steel\nf 5 6 7 8\ng rest\n");
    let folder = folder_holding("cube.obj", &named);
    succeed(&folder, &["hex", "cube.obj", "-o", "cube.msh", "-e", "0.5", "--report", "r.json"]);
    let [bottom, side] = [vec![], vec!["rest", "material:steel"]];
    let top = vec!["inlet", "upper", "material:steel"];
    let of_surfaces = [&bottom, &top, &side, &side, &side, &side];
    assert_eq!(json(&folder, "r.json")["hexing"]["solid"]["surfaceGroups"], json!(of_surfaces));
    let mesh = std::fs::read_to_string(folder.path().join("cube.msh")).unwrap();
    for name in ["surface-1", "surface-6", "inlet", "upper", "rest", "material:steel"] {
        assert_eq!(mesh.matches(&format!("\"{name}\"")).count(), 1, "{name}");
    }
    // Numbers of surfaces are theirs alone.
    let number = |name: &str| {
        let line = mesh.lines().find(|line| line.ends_with(&format!("\"{name}\""))).unwrap();
        line.split(' ').nth(1).unwrap().to_owned()
    };
    assert_eq!(number("surface-2"), "2");
    assert!(!["1", "2", "3", "4", "5", "6"].contains(&&*number("inlet")));
}

#[test]
fn the_record_has_the_options_as_they_were_given() {
    let folder = folder_holding("cube.obj", CUBE);
    let options = |given: &[&str]| {
        let arguments = ["hex", "cube.obj", "-o", "cube.vtu", "-e", "0.5", "--report", "r.json"];
        succeed(&folder, &[&arguments, given].concat());
        json(&folder, "r.json")["options"].clone()
    };
    let default = json!({
        "edgeLength": 0.5, "regions": [], "background": "auto", "curvature": null, "featureAngle": 35.0,
        "maxDistance": null, "maxLevels": 2, "maxHexes": 4_000_000, "secondOrder": null,
    });
    assert_eq!(options(&[]), default);
    let region = "sphere:0,0,0,0.5:h=0.25";
    let given = [
        ["--region", region],
        ["--background", "octree"],
        ["--curvature", "15"],
        ["--feature-angle", "40"],
        ["--max-distance", "0.1"],
        ["--max-levels", "1"],
        ["--max-hexes", "50000"],
        ["--second-order", "hex20"],
    ];
    let expected = json!({
        "edgeLength": 0.5, "regions": [region], "background": "octree", "curvature": 15.0, "featureAngle": 40.0,
        "maxDistance": 0.1, "maxLevels": 1, "maxHexes": 50_000, "secondOrder": "hex20",
    });
    assert_eq!(options(&given.concat()), expected);
}

/// With all that the process holds besides. Memory that was freed has to go back to the system for that.
#[test]
#[cfg(target_os = "linux")]
fn a_solid_takes_less_than_a_kilobyte_a_hex() {
    let folder = folder_holding("cube.obj", CUBE);
    let edge_length = (2.0 / 36.0).to_string();
    let arguments = ["--threads", "1", "--report", "r.json"];
    succeed(&folder, &[&["hex", "cube.obj", "-o", "cube.vtu", "-e", &edge_length], &arguments[..]].concat());
    let report = json(&folder, "r.json");
    assert_eq!(report["mesh"]["hexes"], 36 * 36 * 36);
    let peak = report["peakMemoryBytes"].as_u64().unwrap();
    assert!(peak < 1000 * 36 * 36 * 36, "{peak}");
}

/// What the solid in a file is refused with; nothing is written.
fn refused(surface: &str, edge_length: &str) -> String {
    let folder = folder_holding("part.obj", surface);
    let run = hexmill(&folder, &["hex", "part.obj", "-o", "out.vtu", "-e", edge_length]);
    assert_eq!((run.code, run.stdout.as_str()), (Some(1), ""), "{}", run.stderr);
    assert!(!folder.path().join("out.vtu").exists());
    run.stderr
}

/// The cube, scaled and moved along x; the second of two in a file.
fn with_another(scale: f64, along_x: f64) -> String {
    let mut text = CUBE.to_owned();
    for line in CUBE.lines() {
        let mut words = line.split(' ');
        let kind = words.next().unwrap();
        let numbers = words.map(|word| word.parse::<f64>().unwrap());
        let words: Vec<String> = match kind {
            "v" => numbers
                .enumerate()
                .map(|(k, x)| (x * scale + if k == 0 { along_x } else { 0.0 }).to_string())
                .collect(),
            _ => numbers.map(|number| (number + 8.0).to_string()).collect(),
        };
        text += &format!("{kind} {}\n", words.join(" "));
    }
    text
}

#[test]
fn what_bounds_no_solid_is_refused_with_its_place() {
    let open = refused(&CUBE.replace("f 5 6 7 8\n", ""), "0.5");
    assert!(
        open.starts_with("error[surface-open]: part.obj: the surface is open: 4 edges belong to one"),
        "{open}"
    );
    let triangle = refused("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", "0.5");
    assert!(triangle.contains("[surface-open]") && triangle.contains("3 edges"), "{triangle}");
    // A fin on one edge of the cube.
    let fin = refused(&format!("{CUBE}v 0 0 3\nf 5 6 9\n"), "0.5");
    assert!(fin.contains("[surface-non-manifold]") && fin.contains("at [1, 0, 2]"), "{fin}");
    let crossing = refused(&with_another(1.0, 1.0), "0.5");
    assert!(crossing.contains("[surface-self-intersecting]"), "{crossing}");
    let flat = refused(&CUBE.replace(" 2\nv", " 0\nv").replace("0 2 2\nf", "0 2 0\nf"), "0.5");
    assert!(flat.contains("[surface-without-volume]"), "{flat}");
    let nan = refused(&CUBE.replace("v 2 2 2", "v 2 nan 2"), "0.5");
    assert!(nan.contains("line 7"), "{nan}");
    let text = refused("This is a letter, not a surface.\n", "0.5");
    assert!(text.starts_with("error["), "{text}");
    let empty = refused("# nothing\n", "0.5");
    assert!(empty.contains("[obj-no-vertices]"), "{empty}");
}

#[test]
fn edge_lengths_that_fit_no_solid_are_refused_at_once() {
    for edge_length in ["0.001", "0.00001", "1e-300"] {
        let error = refused(CUBE, edge_length);
        assert!(error.starts_with("error[too-many-hexes]: part.obj: about"), "{error}");
    }
    let error = refused(CUBE, "50");
    assert!(
        error.starts_with("error[edge-length-too-large]: part.obj: an edge length of 50 is too"),
        "{error}"
    );
    let folder = folder_holding("part.obj", CUBE);
    for edge_length in ["0", "-1", "nan", "inf"] {
        let run = hexmill(&folder, &["hex", "part.obj", "-o", "out.vtu", "-e", edge_length]);
        assert_eq!(run.code, Some(2), "{}", run.stderr);
    }
}

#[test]
fn what_can_be_mended_is_mended_and_told() {
    let inside_out: String = CUBE
        .lines()
        .map(|line| match line.strip_prefix("f ") {
            Some(nodes) => {
                let turned: Vec<&str> = nodes.split(' ').rev().collect();
                format!("f {}\n", turned.join(" "))
            }
            None => format!("{line}\n"),
        })
        .collect();
    let folder = folder_holding("cube.obj", &inside_out);
    let stdout = succeed(&folder, &["hex", "cube.obj", "-o", "cube.vtu", "-e", "1"]);
    assert!(stdout.contains("27 nodes, 8 hexes"), "{stdout}");
    assert!(stdout.contains("mended: 12 triangles turned outward"), "{stdout}");
}

/// A triangle that is there again, turned, of a corner of the cube; a fin; and lines of which two edges are none of the cube.
#[test]
fn what_was_dropped_and_lines_beside_the_surface_are_told() {
    for (more, told) in [
        ("f 4 1 5\nf 4 5 8\nf 5 1 4\n", "mended: 1 triangle dropped for being there twice"),
        (
            "v -1 0 1\nf 1 5 9\nf 9 5 1\n",
            "mended: 2 triangles of inner walls or of sheets without thickness dropped",
        ),
        (
            "f 4 1 5 8\nl 1 7\nl 2 8\nl 1 2\n",
            "2 edges of the file's lines are none of the surface, and no features",
        ),
    ] {
        let cube = CUBE.replace("f 4 1 5 8\n", "");
        let side = if more.starts_with("v ") { "f 4 1 5 8\n" } else { "" };
        let folder = folder_holding("cube.obj", &format!("{cube}{side}{more}"));
        let stdout = succeed(&folder, &["hex", "cube.obj", "-o", "cube.vtu", "-e", "0.5"]);
        assert!(stdout.contains("125 nodes, 64 hexes") && stdout.contains(told), "{stdout}");
    }
}

#[test]
fn bodies_are_groups_and_shells_within_are_voids() {
    let arguments = ["hex", "two.obj", "-o", "two.msh", "-e", "0.5", "--report", "r.json"];
    let folder = folder_holding("two.obj", &with_another(0.5, 3.0));
    let stdout = succeed(&folder, &arguments);
    assert!(stdout.contains(&format!("{} nodes, {} hexes", 125 + 27, 64 + 8)), "{stdout}");
    assert!(stdout.contains("captured 16 of 16 corners, 24 of 24 curves, 12 of 12 surfaces"), "{stdout}");
    let report = json(&folder, "r.json");
    assert_eq!(report["hexing"]["bodies"].as_array().unwrap().len(), 2);
    assert_eq!(report["hexing"]["result"]["euler"], 4);
    let mesh = std::fs::read_to_string(folder.path().join("two.msh")).unwrap();
    for name in ["body-1", "body-2", "surface-1", "surface-12"] {
        assert!(mesh.contains(&format!("\"{name}\"")), "{name}");
    }
    // Half as large and in the middle of the other.
    let within = with_another(0.5, 0.0).replace("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n",
        "v 0.5 0.5 0.5\nv 1.5 0.5 0.5\nv 1.5 1.5 0.5\nv 0.5 1.5 0.5\nv 0.5 0.5 1.5\nv 1.5 0.5 1.5\nv 1.5 1.5 1.5\nv 0.5 1.5 1.5\n");
    let folder = folder_holding("two.obj", &within);
    let stdout = succeed(&folder, &arguments);
    assert!(stdout.contains(&format!("{} hexes", 64 - 8)), "{stdout}");
    assert_eq!(json(&folder, "r.json")["hexing"]["solid"]["voids"], 1);
}

#[test]
fn a_body_that_is_too_thin_is_told_where_there_are_others() {
    let folder = folder_holding("two.obj", &with_another(0.01, 3.0));
    let stdout = succeed(&folder, &["hex", "two.obj", "-o", "two.vtu", "-e", "0.5"]);
    assert!(stdout.contains("64 hexes"), "{stdout}");
    assert!(stdout.contains("1 body was lost, since no hex lies within it, the largest at 3.01"), "{stdout}");
    succeed(&folder, &["hex", "two.obj", "-o", "two.msh", "-e", "0.5"]);
    let mesh = std::fs::read_to_string(folder.path().join("two.msh")).unwrap();
    assert!(mesh.contains("\"body-1\"") && !mesh.contains("\"body-2\""), "no group without hexes");
}

/// Hexes that the options allow, but memory does not.
#[test]
#[cfg(target_os = "linux")]
fn more_hexes_than_memory_holds_are_refused_before_the_work() {
    let folder = folder_holding("part.obj", CUBE);
    let command = format!(
        "ulimit -v 4000000 && exec '{}' hex part.obj -o out.vtu -e 0.004 --max-hexes 200000000",
        env!("CARGO_BIN_EXE_hexmill")
    );
    let run = std::process::Command::new("sh").args(["-c", &command]).current_dir(folder.path()).output();
    let run = run.unwrap();
    let error = String::from_utf8(run.stderr).unwrap();
    assert_eq!(run.status.code(), Some(1), "{error}");
    assert!(error.starts_with("error[memory-exceeded]: part.obj: the mesh would have 12"), "{error}");
    assert!(error.contains("GB, of which") && error.contains("raise the edge length"), "{error}");
    assert!(!folder.path().join("out.vtu").exists());
}

#[test]
fn shells_within_bodies_are_told_and_counted_as_turned_where_they_were() {
    // Of each, the six quads of the inner cube look into the void, as they should, or out of it.
    let inner = "v 0.5 0.5 0.5\nv 1.5 0.5 0.5\nv 1.5 1.5 0.5\nv 0.5 1.5 0.5\nv 0.5 0.5 1.5\nv 1.5 0.5 1.5\nv 1.5 1.5 1.5\n\
        v 0.5 1.5 1.5\n";
    let outward = "f 12 11 10 9\nf 13 14 15 16\nf 9 10 14 13\nf 10 11 15 14\nf 11 12 16 15\nf 12 9 13 16\n";
    let inward: String = outward
        .lines()
        .map(|line| {
            let nodes: Vec<&str> = line.split_whitespace().skip(1).collect();
            let [a, b, c, d] = nodes[..] else { unreachable!("quads") };
            format!("f {d} {c} {b} {a}\n")
        })
        .collect();
    for (faces, mended) in [(inward.as_str(), None), (outward, Some("mended: 12 triangles turned outward"))] {
        let folder = folder_holding("void.obj", &format!("{CUBE}{inner}{faces}"));
        let stdout = succeed(&folder, &["hex", "void.obj", "-o", "void.vtu", "-e", "0.5"]);
        assert!(stdout.contains("1 shell within a body is a void"), "{stdout}");
        assert_eq!(stdout.contains("mended"), mended.is_some(), "{stdout}");
        assert!(mended.is_none_or(|mended| stdout.contains(mended)), "{stdout}");
    }
}

/// A plate whose rim has a step far lower than its edges.
#[test]
fn curves_that_shrank_and_nodes_that_are_off_are_told_with_their_place() {
    let rim = [[0.0, 0.0], [4.0, 0.0], [4.0, 1.0], [2.0, 1.0], [2.0, 1.02], [0.0, 1.02]];
    let nodes: String =
        [0.0, 1.0].iter().flat_map(|z| rim.map(|[x, y]| format!("v {x} {y} {z}\n"))).collect();
    let walls: String = (1..=6)
        .map(|k| {
            let next = k % 6 + 1;
            format!("f {k} {next} {} {}\n", next + 6, k + 6)
        })
        .collect();
    let folder = folder_holding("step.obj", &format!("{nodes}f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n{walls}"));
    let stdout = succeed(&folder, &["hex", "step.obj", "-o", "step.vtu", "-e", "0.12"]);
    assert!(stdout.contains("captured 10 of 12 corners, 16 of 18 curves, 8 of 8 surfaces"), "{stdout}");
    assert!(stdout.contains("2 curves shrank to corners, the largest at 2, 1.01, 1"), "{stdout}");
    assert!(stdout.contains("1 node is off its corner, curve or surface, the farthest by 4."), "{stdout}");
}

#[test]
fn a_smaller_turn_than_the_finest_levels_allow_gets_these() {
    let folder = folder_holding("drum.obj", &drum());
    let levels = |degrees: &str| {
        let arguments = ["hex", "drum.obj", "-o", "drum.vtu", "-e", "0.5", "--curvature", degrees];
        succeed(&folder, &[&arguments[..], &["--max-levels", "1", "--report", "r.json"]].concat());
        json(&folder, "r.json")["hexing"]["bodies"][0]["attempts"][0]["levels"].take()
    };
    let [coarse, fine, finest] = ["90", "12", "0.1"].map(levels);
    assert!(fine.as_array().unwrap().len() > coarse.as_array().unwrap().len(), "{fine} {coarse}");
    assert_eq!(fine, finest);
}

#[test]
fn regions_that_meet_nothing_are_told() {
    let folder = folder_holding("cube.obj", CUBE);
    let arguments = ["hex", "cube.obj", "-o", "cube.vtu", "-e", "0.5", "--report", "r.json"];
    let regions = ["-r", "sphere:9,9,9,1:level=1", "-r", "sphere:2,2,2,0.2:level=1"];
    let stdout = succeed(&folder, &[&arguments[..], &regions].concat());
    let told = "region sphere:9,9,9,1:level=1 meets nothing of the input and refines nothing";
    assert!(stdout.contains(told) && stdout.matches("meets nothing").count() == 1, "{stdout}");
    assert_eq!(json(&folder, "r.json")["idleRegions"], json!(["sphere:9,9,9,1:level=1"]));
}

/// Two polygons of 24 sides, and what is between them: a drum.
fn drum() -> String {
    let angles = (0..24).map(|k| f64::from(k) / 24.0 * std::f64::consts::TAU);
    let ring = |z: f64| angles.clone().map(move |a| format!("v {} {} {z}\n", a.cos(), a.sin()));
    let walls = (1..=24).map(|k| {
        let next = k % 24 + 1;
        format!("f {k} {next} {} {}\n", next + 24, k + 24)
    });
    let [bottom, top] = [(1..=24).rev().collect::<Vec<_>>(), (25..=48).collect()].map(|ring: Vec<i32>| {
        let nodes: Vec<String> = ring.iter().map(i32::to_string).collect();
        format!("f {}\n", nodes.join(" "))
    });
    ring(0.0).chain(ring(1.0)).chain(walls).chain([bottom, top]).collect()
}

#[test]
fn a_mesh_that_is_farther_than_was_asked_for_is_told() {
    let folder = folder_holding("drum.obj", &drum());
    let arguments =
        ["hex", "drum.obj", "-o", "drum.vtu", "-e", "0.5", "--max-levels", "0", "--report", "r.json"];
    for (limit, is_too_far) in [(None, false), (Some("0.2"), false), (Some("0.001"), true)] {
        let asked = limit.map_or(vec![], |limit| vec!["--max-distance", limit]);
        let stdout = succeed(&folder, &[&arguments[..], &asked].concat());
        let told = stdout.contains("that is more than the 0.001 asked for: lower the edge length");
        assert_eq!(told, is_too_far, "{stdout}");
        let result = json(&folder, "r.json")["hexing"]["result"].take();
        assert_eq!(result["maxDistance"], json!(limit.map(|limit| limit.parse::<f64>().unwrap())));
        assert!(
            (0.001..0.2).contains(&result["distance"]["surfaceToMesh"]["max"].as_f64().unwrap()),
            "{result}"
        );
    }
}

#[test]
fn backgrounds_and_regions_are_as_they_were_asked_for() {
    let folder = folder_holding("cube.obj", CUBE);
    let hexes = |more: &[&str]| {
        let edge_length: &[&str] = if more.contains(&"-e") { &[] } else { &["-e", "0.5"] };
        let arguments = ["hex", "cube.obj", "-o", "cube.vtu", "--report", "r.json"];
        succeed(&folder, &[&arguments, edge_length, more].concat());
        let report = json(&folder, "r.json")["hexing"].take();
        assert!(report["result"]["worst"].as_f64().unwrap() > 0.1, "{report}");
        let attempt = report["bodies"][0]["attempts"][0].clone();
        (
            attempt["background"].as_str().unwrap().to_owned(),
            attempt["hexes"].as_u64().unwrap(),
            attempt["levels"].clone(),
        )
    };
    assert_eq!(hexes(&["--background", "swept"]), ("swept".into(), 64, json!([64])));
    let (kind, count, levels) = hexes(&["--background", "octree"]);
    assert_eq!(kind, "octree");
    assert!(count >= 64 && levels.as_array().unwrap().len() >= 2, "{count} {levels}");
    for background in ["grid", "swept"] {
        let region = ["--background", background, "-e", "0.25", "--region", "sphere:0,0,0,0.2:level=1"];
        let (kind, count, levels) = hexes(&region);
        assert_eq!((kind.as_str(), levels.as_array().unwrap().len()), (background, 2));
        assert!((513..2000).contains(&count), "{count}");
    }
}
