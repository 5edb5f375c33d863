//! Real models: all that ship are read, with the counts that their sources state.

use std::path::{Path, PathBuf};

use hexmill::io::obj;
use hexmill::mesh::{NodeId, PolygonMesh};

/// The folder of the models that ship with the project.
fn shipped() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/models")
}

fn read(path: &Path) -> PolygonMesh {
    let bytes = std::fs::read(path).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    let document = obj::read(&bytes).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
    document.into_surface().expect("OBJ gives surfaces")
}

/// Every OBJ file in the folders of `root`.
fn models_in(root: &Path) -> Vec<PathBuf> {
    let entries = |folder: &Path| std::fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path());
    let mut files: Vec<PathBuf> =
        entries(root).flat_map(|folder| entries(&folder).collect::<Vec<_>>()).collect();
    files.retain(|file| file.extension().is_some_and(|e| e == "obj"));
    files.sort();
    files
}

/// Nodes, faces and creases of a shipped model.
#[track_caller]
fn check(model: &str, nodes: usize, faces: usize, creases: usize) {
    let mesh = read(&shipped().join(model));
    assert_eq!(
        (mesh.positions.len(), mesh.face_count(), mesh.features.creases.len()),
        (nodes, faces, creases)
    );
}

#[test]
fn opensubdiv_shapes() {
    check("quads/bishop.obj", 917, 968, 224);
    check("quads/car.obj", 1642, 1575, 314);
    check("quads/helmet.obj", 72, 58, 38);
    check("quads/pawn.obj", 601, 588, 120);
    check("quads/rook.obj", 768, 777, 280);
    check("quads/torus_creases0.obj", 32, 32, 8);
}

#[test]
fn cinolib_shapes() {
    check("quads/bamboo_pen.obj", 1146, 1160, 0);
    check("solids/3holes.obj", 1987, 3982, 0);
}

#[test]
fn solids() {
    check("solids/spot.obj", 2930, 5856, 0);
    check("solids/bunny.obj", 3485, 6966, 0);
    check("solids/MFCAD_3-3-3-3-3-23.obj", 1322, 2676, 0);
    check("solids/nist_ctc_01_asme1_ap242-e1.obj", 12296, 24628, 0);
}

#[test]
fn creases_and_the_boundary_rule_of_a_shape() {
    let features = read(&shipped().join("creases/cube_creases0.obj")).features;
    let edge = |a, b| [NodeId(a), NodeId(b)];
    assert_eq!(features.creases, [(edge(0, 1), 2.0), (edge(1, 3), 2.0)]);
    assert_eq!(features.interpolate_boundary, Some(2));
}

#[test]
fn every_shipped_model_survives_writing() {
    let models = models_in(&shipped());
    assert!(models.len() >= 13, "{} models in {}", models.len(), shipped().display());
    for path in models {
        let document = hexmill::io::Document::from(read(&path));
        let bytes = obj::write(&document).unwrap();
        assert_eq!(obj::read(&bytes).unwrap(), document, "{}", path.display());
    }
}

/// Models that may not ship are read where a folder of them is named.
#[test]
fn models_elsewhere() {
    let Some(folder) = std::env::var_os("HEXMILL_MODELS") else { return };
    let models = models_in(Path::new(&folder));
    assert!(!models.is_empty(), "HEXMILL_MODELS={} has no OBJ files in its folders", folder.display());
    for path in models {
        assert!(read(&path).face_count() > 0, "{}", path.display());
    }
}
