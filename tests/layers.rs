//! Keeps the arrow: a module uses what stands before it in the order below, never what stands after.
#![cfg(not(target_arch = "wasm32"))]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use proc_macro2::{Punct, Spacing, TokenStream, TokenTree};

/// Modules by rank. A module may use modules of a lower rank and itself, none of its own rank or higher.
const RANKS: [&[&str]; 10] = [
    &["geometry", "monitor", "parallel"],
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

/// What a source names by paths.
#[derive(Default)]
struct Named {
    /// Modules at the root of the library.
    modules: BTreeSet<String>,
    /// What no path can be checked for.
    complaints: Vec<String>,
}

/// What the source of the module `path` names in the library: with `crate::` or with as many `super::` as lead out of
/// the room, in a `use` or anywhere else. Comments and strings name nothing. The command line is a crate of its own,
/// that sees the library as `hexmill::`.
fn named(path: &[String], source: &str) -> Named {
    let tokens = source.parse().expect("the source is Rust");
    let root = if path[0] == "bin" { "hexmill" } else { "crate" };
    let mut named = Named::default();
    walk(tokens, path, root, &mut named);
    named
}

fn walk(tokens: TokenStream, path: &[String], root: &str, named: &mut Named) {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let mut at = 0;
    while at < tokens.len() {
        match &tokens[at..] {
            [TokenTree::Ident(word), TokenTree::Ident(name), TokenTree::Group(body), ..] if word == "mod" => {
                walk(body.stream(), &[path, &[name.to_string()]].concat(), root, named);
                at += 3;
            }
            [TokenTree::Punct(hash), TokenTree::Group(attribute), ..] if hash.as_char() == '#' => {
                if attribute.stream().into_iter().next().is_some_and(|t| t.to_string() == "path") {
                    named.complaints.push("uses #[path]".to_owned());
                }
                walk(attribute.stream(), path, root, named);
                at += 2;
            }
            [TokenTree::Ident(word), ..] if word == root => {
                name_from(&tokens[at + 1..], &[], named);
                at += 1;
            }
            [TokenTree::Ident(word), ..] if word == "super" => {
                let above = &path[..path.len() - 1];
                name_from(&tokens[at + 1..], above, named);
                // The rest of a chain is of this path.
                at += 1;
                while matches!(&tokens[at..], [TokenTree::Punct(_), TokenTree::Punct(_), TokenTree::Ident(w), ..] if w == "super")
                {
                    at += 3;
                }
            }
            [TokenTree::Group(group), ..] => {
                walk(group.stream(), path, root, named);
                at += 1;
            }
            _ => at += 1,
        }
    }
}

/// Follows the tokens of a path that has led to the module `base`.
fn name_from(tokens: &[TokenTree], base: &[String], named: &mut Named) {
    if let Some(room) = base.first() {
        named.modules.insert(room.clone());
    }
    let is_colon = |token: &TokenTree| matches!(token, TokenTree::Punct(p) if p.as_char() == ':');
    match tokens {
        [a, b, TokenTree::Ident(word), rest @ ..] if is_colon(a) && is_colon(b) && word == "super" => {
            name_from(rest, base.split_last().map_or(&[], |(_, above)| above), named);
        }
        [a, b, next, ..] if is_colon(a) && is_colon(b) => match next {
            TokenTree::Group(list) => name_list(list.stream(), base, named),
            TokenTree::Ident(word) if base.is_empty() && word != "self" => {
                named.modules.insert(word.to_string());
            }
            _ if base.is_empty() => named.complaints.push(format!("takes {next} from the root")),
            _ => {}
        },
        [TokenTree::Ident(word), ..] if base.is_empty() && word == "as" => {
            named.complaints.push("gives the root another name".to_owned());
        }
        _ => {}
    }
}

/// Follows the items of a list in a `use`.
fn name_list(list: TokenStream, base: &[String], named: &mut Named) {
    let tokens: Vec<TokenTree> = list.into_iter().collect();
    for item in tokens.split(|token| matches!(token, TokenTree::Punct(p) if p.as_char() == ',')) {
        let colon = || TokenTree::Punct(Punct::new(':', Spacing::Alone));
        name_from(&[&[colon(), colon()], item].concat(), base, named);
    }
}

/// One line of complaint for each use that goes against the arrow, in the source of the module `path`.
fn violations(path: &str, source: &str) -> Vec<String> {
    let path: Vec<String> = path.split('/').map(str::to_owned).collect();
    let (ranks, module) = (ranks(), path[0].as_str());
    let rank = ranks[module];
    let Named { modules, complaints } = named(&path, source);
    let others = modules.iter().map(String::as_str);
    let others = others.filter(|&name| name != module && !ROOT_EXPORTS.contains(&name));
    let bent = others.filter_map(|name| match ranks.get(name) {
        Some(&other) if other < rank => None,
        Some(_) => Some(format!("{module} uses {name}, which stands after it or beside it")),
        None => Some(format!("{module} uses {name}, which has no rank")),
    });
    bent.chain(complaints.iter().map(|complaint| format!("{module} {complaint}"))).collect()
}

/// The modules below `src`, by their paths there, and their sources.
fn modules() -> Vec<(String, String)> {
    let src = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = Vec::new();
    sources(&src, &mut files);
    let module = |file: PathBuf| {
        let inside = file.strip_prefix(&src).expect("below src").with_extension("");
        let path = inside.to_string_lossy().replace('\\', "/");
        let text = fs::read_to_string(&file).expect("readable source");
        (path.strip_suffix("/mod").unwrap_or(&path).to_owned(), text)
    };
    let modules: Vec<_> = files.into_iter().map(module).filter(|(path, _)| path != "lib").collect();
    assert!(modules.len() > 10, "only {} modules found", modules.len());
    modules
}

#[test]
fn imports_follow_the_arrow() {
    let mut bad = Vec::new();
    for (path, text) in modules() {
        let room = path.split('/').next().expect("a name");
        assert!(ranks().contains_key(room), "module {room} has no rank in {}", file!());
        bad.extend(violations(&path, &text).into_iter().map(|v| format!("{path}: {v}")));
    }
    assert!(bad.is_empty(), "against the arrow:\n{}", bad.join("\n"));
}

/// What names rayon, beside tests: the loop that all others go down to, and the pools.
const KNOW_THE_THREADS: [&str; 3] = ["parallel/blocks", "web/pool", "bin/hexmill/cli/making"];

#[test]
fn all_loops_over_threads_go_through_one_room() {
    let names_rayon =
        |text: &str| text.lines().any(|l| !l.trim_start().starts_with("//") && l.contains("rayon"));
    let others = modules().into_iter().filter(|(path, _)| !path.ends_with("tests"));
    let others: Vec<String> = others.filter(|(_, text)| names_rayon(text)).map(|(path, _)| path).collect();
    assert_eq!(
        BTreeSet::from_iter(others),
        KNOW_THE_THREADS.map(str::to_owned).into(),
        "use `parallel` instead"
    );
}

#[test]
fn the_check_sees_a_bent_arrow() {
    for (path, source) in [
        ("mesh", "use crate::refine::QuadOptions;"),
        ("io", "use crate::{geometry::Point, scene::Camera};"),
        ("io", "use crate::{\n    mesh::{NodeId, QuadMesh},\n    scene,\n};"),
        ("mesh/quad", "fn f() { let x = crate::refine::x(); }"),
        ("mesh/quad", "fn f() -> Vec<crate :: refine :: X> { g!(1, crate::mesh::x) }"),
        ("mesh/quad", "fn f() { println!(\"// {}\", crate::refine::X); }"),
        ("mesh/quad", "/* crate::io */ type X = [crate::refine::X; 2];"),
        ("mesh/quad", "use super::super::refine::X;"),
        ("mesh/quad", "fn f() { super::super::refine::x() }"),
        ("mesh/topology/edges", "use super::super::super::refine::X;"),
        ("mesh/topology/edges", "use super::{super::{super::refine, quad}, uses};"),
        ("mesh/quad", "mod tests { use super::super::super::refine::X; }"),
        ("mesh", "pub(in super::refine) fn f() {}"),
        ("mesh/quad", "#[path = \"../refine/quad.rs\"] mod other;"),
        ("mesh/quad", "#[path = \"../refine/quad.rs\"]\nmod other {}"),
        ("mesh/quad", "use crate as root;"),
        ("mesh/quad", "use crate::*;"),
        ("mesh/quad", "use crate::{self as root, geometry::Point};"),
        ("mesh/quad", "use super::super::{self as root};"),
        ("mesh/quad", "use crate::unheard_of::X;"),
        ("refine/quad", "#[doc = \"x\"] use crate::io::Format;"),
        ("bin/hexmill/cli/check", "fn f() { hexmill::web::x() }"),
    ] {
        assert_eq!(violations(path, source).len(), 1, "{path}: {source}: {:?}", violations(path, source));
    }
}

#[test]
fn the_check_lets_a_straight_arrow_pass() {
    for (path, source) in [
        ("io", "use crate::mesh::NodeId; // crate::scene"),
        ("io", "/// crate::scene\nfn f() { g(\"crate::scene\", 'c', crate::mesh::x) }"),
        ("refine", "use crate::{Cancelled, Monitor};"),
        ("mesh/topology/edges", "use super::super::quad::X; use super::super::super::geometry::Point;"),
        (
            "mesh/quad",
            "mod tests { use super::*; use super::super::id::NodeId; use crate::geometry::Point; }",
        ),
        ("mesh/quad", "use self::refine::X; fn super_refine() { refine::x() }"),
        ("bin/hexmill/cli/check", "use crate::cli::args; use hexmill::{io, mesh::QuadMesh}; use super::io;"),
    ] {
        assert_eq!(violations(path, source), [""; 0], "{path}: {source}");
    }
}
