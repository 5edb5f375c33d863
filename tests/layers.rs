//! Keeps the arrow: a module uses what stands before it in the order below, never what stands after.
#![cfg(not(target_arch = "wasm32"))]

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// Modules by rank. A module may use modules of a lower rank and itself, none of its own rank or higher.
const RANKS: [&[&str]; 10] = [
    &["geometry", "monitor"],
    &["mesh"],
    &["template", "sizing", "solid", "graph"],
    &["forest"],
    &["optimize"],
    &["refine"],
    &["hexing"],
    &["io", "scene"],
    &["render"],
    &["web", "bin"],
];

/// What `monitor` exports at the root of the crate.
const ROOT_EXPORTS: [&str; 4] = ["Cancelled", "Monitor", "Silent", "Stage"];

fn ranks() -> BTreeMap<&'static str, usize> {
    RANKS.iter().enumerate().flat_map(|(rank, names)| names.iter().map(move |&n| (n, rank))).collect()
}

fn sources(folder: &Path, out: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).expect("a readable folder").flatten() {
        let path = entry.path();
        if path.is_dir() {
            sources(&path, out);
        } else if path.extension().is_some_and(|e| e == "rs") {
            out.push(path);
        }
    }
}

/// The modules of the library that code names by `prefix`, comments aside.
fn modules_named(source: &str, prefix: &str) -> Vec<String> {
    let code: String = source.lines().map(|line| line.split("//").next().unwrap_or_default()).collect();
    let mut names = Vec::new();
    for (at, _) in code.match_indices(prefix) {
        let rest = &code[at + prefix.len()..];
        let items: Vec<&str> = match rest.strip_prefix('{') {
            Some(inner) => top_level_items(inner),
            None => vec![rest],
        };
        let name = |item: &str| -> String {
            item.trim().chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect()
        };
        names.extend(items.into_iter().map(name).filter(|n| !n.is_empty()));
    }
    names
}

/// The items of a use list up to its closing brace, split at the commas that stand in no inner braces.
fn top_level_items(list: &str) -> Vec<&str> {
    let (mut depth, mut start, mut items) = (0, 0, Vec::new());
    for (at, c) in list.char_indices() {
        match c {
            '{' => depth += 1,
            '}' if depth == 0 => {
                items.push(&list[start..at]);
                return items;
            }
            '}' => depth -= 1,
            ',' if depth == 0 => {
                items.push(&list[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    items
}

/// One line of complaint for each use that goes against the arrow.
fn violations(module: &str, source: &str) -> Vec<String> {
    let ranks = ranks();
    let rank = ranks[module];
    // The command line is a crate of its own, that sees the library from outside.
    let prefix = if module == "bin" { "hexmill::" } else { "crate::" };
    modules_named(source, prefix)
        .into_iter()
        .filter(|name| name != module && !ROOT_EXPORTS.contains(&name.as_str()))
        .filter_map(|name| match ranks.get(name.as_str()) {
            Some(&other) if other < rank => None,
            Some(_) => Some(format!("{module} uses {name}, which stands after it or beside it")),
            None => Some(format!("{module} uses {name}, which has no rank")),
        })
        .collect()
}

#[test]
fn imports_follow_the_arrow() {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    sources(&src, &mut files);
    let mut checked = 0;
    let mut bad = Vec::new();
    for file in files {
        let inside = file.strip_prefix(&src).expect("below src");
        let first = inside.components().next().expect("a name").as_os_str().to_string_lossy().into_owned();
        let module = first.trim_end_matches(".rs");
        if module == "lib" {
            continue;
        }
        assert!(ranks().contains_key(module), "module {module} has no rank in {}", file!());
        let text = fs::read_to_string(&file).expect("readable source");
        bad.extend(violations(module, &text).into_iter().map(|v| format!("{}: {v}", inside.display())));
        checked += 1;
    }
    assert!(checked > 10, "only {checked} files found");
    assert!(bad.is_empty(), "against the arrow:\n{}", bad.join("\n"));
}

#[test]
fn the_check_sees_a_bent_arrow() {
    assert_eq!(violations("mesh", "use crate::refine::QuadOptions;").len(), 1);
    assert_eq!(violations("io", "use crate::{geometry::Point, scene::Camera};").len(), 1);
    assert_eq!(violations("io", "use crate::{\n    mesh::{NodeId, QuadMesh},\n    scene,\n};").len(), 1);
    assert_eq!(violations("io", "use crate::mesh::NodeId; // crate::scene").len(), 0);
    assert_eq!(violations("refine", "use crate::{Cancelled, Monitor};").len(), 0);
}
