//! Real models, refined with a sphere three levels deep.

use std::fs;
use std::path::{Path, PathBuf};

use hexmill::Silent;
use hexmill::io::{AnyMesh, Format, read};
use hexmill::mesh::PolygonMesh;
use hexmill::mesh::check::check_quads;
use hexmill::refine::{QuadOptions, refine_quads};
use hexmill::sizing::{Region, Shape, Target};

use super::judge::{assert_conforming, euler, polygon_faces, quad_faces};

fn models() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models");
    let quads = fs::read_dir(root.join("quads")).expect("the models").flatten().map(|e| e.path());
    let mut all: Vec<PathBuf> = quads.filter(|p| p.extension().is_some_and(|e| e == "obj")).collect();
    all.push(root.join("solids/spot.obj"));
    all.sort();
    all
}

fn load(path: &Path) -> PolygonMesh {
    let bytes = fs::read(path).expect("a readable model");
    match read(&bytes, Format::Obj).expect("a valid model").mesh {
        AnyMesh::Polygons(mesh) => mesh,
        other => panic!("{} is no surface: {other:?}", path.display()),
    }
}

/// A ball around the model's first node, as deep as `level`.
fn ball(mesh: &PolygonMesh, level: u8) -> QuadOptions {
    let center = mesh.positions[mesh.corners[0].index()];
    let shape = Shape::Sphere { center, radius: 0.2 * mesh.bounds().diagonal() };
    QuadOptions { regions: vec![Region { shape, target: Target::Level(level) }], ..QuadOptions::default() }
}

#[test]
fn every_model_refines_three_levels_deep_and_conforms() {
    let models = models();
    assert!(models.len() >= 8, "only {} models found", models.len());
    for path in models {
        let input = load(&path);
        let refined = refine_quads(&input, &ball(&input, 3), &Silent).expect("a refined model");
        assert_eq!(refined.level.iter().max(), Some(&3), "{}", path.display());
        assert!(refined.level.contains(&1), "{} is refined all over", path.display());
        assert_eq!(euler(quad_faces(&refined.mesh)), euler(polygon_faces(&input)));
        assert_conforming(&input, &refined);
        let errors: Vec<_> = check_quads(&refined.mesh).into_iter().filter(|d| d.is_error()).collect();
        assert_eq!(errors, [], "{}", path.display());
    }
}

#[test]
fn coarse_quads_are_kept_where_the_model_can_be_two_coloured() {
    let mut kept = 0;
    for path in models() {
        let input = load(&path);
        let options = QuadOptions { keep_coarse: true, ..ball(&input, 3) };
        match refine_quads(&input, &options, &Silent) {
            Ok(refined) => {
                assert!(refined.level.contains(&0));
                assert_conforming(&input, &refined);
                kept += 1;
            }
            Err(error) => assert!(error.code().starts_with("keep-coarse-"), "{error}"),
        }
    }
    assert!(kept >= 3, "only {kept} models kept coarse quads");
}
