//! `hexmill convert`.

use hexmill::io::obj;

use super::{folder_holding, folder_with, hexmill, succeed};

#[test]
fn obj_to_obj_keeps_everything() {
    let folder = folder_with("quads/rook.obj");
    let stdout = succeed(&folder, &["convert", "rook.obj", "-o", "copy.obj"]);
    let [rook, copy] = ["rook.obj", "copy.obj"].map(|file| std::fs::read(folder.path().join(file)).unwrap());
    assert_eq!(obj::read(&rook).unwrap(), obj::read(&copy).unwrap());
    assert_eq!(stdout, format!("copy.obj: 768 nodes, 777 cells, {} bytes\n", copy.len()));
}

#[test]
fn every_format_keeps_nodes_and_faces() {
    let folder = folder_with("quads/bishop.obj");
    // MEDIT and MSH list faces by their kind, so their order may change.
    let read = |file: &str| {
        let bytes = std::fs::read(folder.path().join(file)).unwrap();
        let mesh = obj::read(&bytes).unwrap().into_surface().unwrap();
        let mut faces: Vec<_> = mesh.faces().map(<[_]>::to_vec).collect();
        faces.sort();
        (mesh.positions, faces)
    };
    for extension in ["vtu", "vtk", "msh", "inp", "mesh"] {
        let file = format!("there.{extension}");
        succeed(&folder, &["convert", "bishop.obj", "-o", &file]);
        succeed(&folder, &["convert", &file, "-o", "back.obj"]);
        assert!(read("back.obj") == read("bishop.obj"), "{extension}");
    }
}

#[test]
fn hexes_of_the_second_order_become_linear_with_a_warning() {
    let folder = folder_holding("two.inp", include_str!("../../fixtures/gmsh_hex20.inp"));
    let run = hexmill(&folder, &["convert", "two.inp", "-o", "two.vtu"]);
    assert_eq!(run.code, Some(0), "{}", run.stderr);
    let told = "warning: two.inp: 2 hexes of the second order are read as linear: the nodes on edges, on faces and inside \
                are left out\n";
    assert_eq!(run.stderr, told);
    let run = hexmill(&folder, &["convert", "two.inp", "-o", "two.vtu", "--quiet"]);
    assert_eq!(run.stderr, "");
    assert_eq!(hexmill(&folder, &["check", "two.vtu"]).code, Some(0));
}

#[test]
fn glb_is_only_written() {
    let folder = folder_with("quads/helmet.obj");
    succeed(&folder, &["convert", "helmet.obj", "-o", "helmet.glb"]);
    assert!(std::fs::read(folder.path().join("helmet.glb")).unwrap().starts_with(b"glTF"));
    let run = hexmill(&folder, &["convert", "helmet.glb", "-o", "back.obj"]);
    assert_eq!(run.code, Some(2));
    assert!(
        run.stderr.contains("helmet.glb: GLB files are only written; use one of .obj, .stl"),
        "{}",
        run.stderr
    );
}

#[cfg(unix)]
#[test]
fn the_output_may_be_read_by_whom_new_files_may_be_read() {
    use std::os::unix::fs::PermissionsExt;
    let folder = folder_with("quads/helmet.obj");
    succeed(&folder, &["convert", "helmet.obj", "-o", "copy.obj"]);
    std::fs::write(folder.path().join("plain"), "").unwrap();
    let mode = |file: &str| std::fs::metadata(folder.path().join(file)).unwrap().permissions().mode();
    assert_eq!(mode("copy.obj"), mode("plain"));
}

#[cfg(unix)]
#[test]
fn a_link_is_followed() {
    let folder = folder_with("quads/helmet.obj");
    std::fs::write(folder.path().join("target.obj"), "").unwrap();
    std::os::unix::fs::symlink("target.obj", folder.path().join("link.obj")).unwrap();
    succeed(&folder, &["convert", "helmet.obj", "-o", "link.obj"]);
    assert!(folder.path().join("link.obj").is_symlink());
    assert!(std::fs::metadata(folder.path().join("target.obj")).unwrap().len() > 1000);
}
