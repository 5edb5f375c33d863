//! `hexmill refine --plan`: what would be made is told, and nothing is made.

use serde_json::json;

use super::refine_hexes::folder_with_grid;
use super::{folder_holding, hexmill, json, succeed};

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";

#[test]
fn hexes_are_told_as_they_will_be() {
    let folder = folder_with_grid();
    let options =
        ["--method", "two", "--region", "box:1,1,1,3,3,3:level=2", "--region", "sphere:9,9,9,1:h=1"];
    let stdout =
        succeed(&folder, &[&["refine", "grid.vtu", "--plan", "--report", "p.json"], &options[..]].concat());
    let told = "1632 hexes to be made, with 672 transition hexes, in less than 100 MB\n";
    assert!(stdout.starts_with(told), "{stdout}");
    let unasked = "  56 elements are refined that nothing asks for, so that elements are in families or blocks of eight\n";
    assert!(stdout.contains(unasked), "{stdout}");
    let idle = "  region sphere:9,9,9,1:h=1 meets nothing of the input and refines nothing\n";
    assert!(stdout.ends_with(idle), "{stdout}");
    let plan = json(&folder, "p.json");
    assert_eq!((plan["schema"].as_str(), plan["command"].as_str()), (Some("hexmill-plan/1"), Some("refine")));
    assert_eq!(plan["idleRegions"], json!(["sphere:9,9,9,1:h=1"]));

    let made =
        [&["refine", "grid.vtu", "-o", "fine.vtu", "--report", "r.json", "--quiet"], &options[..]].concat();
    succeed(&folder, &made);
    let record = json(&folder, "r.json");
    let forecast = &record["refinement"]["forecast"];
    for field in ["hexes", "transition", "bytes", "stages"] {
        assert_eq!(plan["plan"][field], forecast[field], "{field}");
    }
    assert_eq!(plan["plan"]["added"], record["refinement"]["added"]);
    assert_eq!((&plan["options"], &plan["input"]), (&record["options"], &record["input"]));
    assert_eq!((&plan["plan"]["capped"], &plan["plan"]["coincidentNodes"]), (&json!(0), &json!(0)));
}

#[test]
fn quads_are_told_as_they_will_be() {
    let folder = folder_holding("square.obj", SQUARE);
    let stdout = succeed(&folder, &["refine", "square.obj", "--plan", "--levels", "1", "--report", "p.json"]);
    assert_eq!(stdout, "4 quads and 9 nodes, 1 level deep, in about 1 MB\n");
    let plan = json(&folder, "p.json");
    assert_eq!((&plan["plan"]["quads"], &plan["plan"]["exact"]), (&json!(4), &json!(true)));
    let stdout = succeed(&folder, &["refine", "square.obj", "--plan", "--levels", "9"]);
    assert!(stdout.starts_with("about 262144 quads and "), "{stdout}");
    let limited = ["refine", "square.obj", "--plan", "--levels", "9", "--max-quads", "1000"];
    assert!(succeed(&folder, &limited).ends_with("  more than the limit of 1000, which would be refused\n"));
    assert_eq!(succeed(&folder, &["refine", "square.obj", "--plan", "--quiet"]), "");
}

#[test]
fn nothing_is_written_but_the_record() {
    let folder = folder_holding("square.obj", SQUARE);
    succeed(&folder, &["refine", "square.obj", "--plan", "--levels", "2"]);
    assert_eq!(std::fs::read_dir(folder.path()).expect("a folder").count(), 1);
    let both = hexmill(&folder, &["refine", "square.obj", "--plan", "-o", "out.vtu"]);
    assert_eq!(both.code, Some(2), "{}", both.stderr);
    let neither = hexmill(&folder, &["refine", "square.obj"]);
    assert_eq!(neither.code, Some(2), "{}", neither.stderr);
    let over_itself = hexmill(&folder, &["refine", "square.obj", "--plan", "--report", "square.obj"]);
    assert_eq!(over_itself.code, Some(2), "{}", over_itself.stderr);
    let of_hexes = hexmill(&folder, &["refine", "square.obj", "--plan", "--method", "two"]);
    assert_eq!(of_hexes.code, Some(2), "{}", of_hexes.stderr);
}
