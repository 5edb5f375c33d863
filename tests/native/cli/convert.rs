//! `hexmill convert`.

use hexmill::io::obj;

use super::{files, folder_with, succeed};

#[test]
fn obj_to_obj_keeps_everything() {
    let folder = folder_with("quads/rook.obj");
    let stdout = succeed(&folder, &["convert", "rook.obj", "-o", "copy.obj"]);
    let [rook, copy] = ["rook.obj", "copy.obj"].map(|file| std::fs::read(folder.path().join(file)).unwrap());
    assert_eq!(obj::read(&rook).unwrap(), obj::read(&copy).unwrap());
    assert_eq!(stdout, format!("copy.obj: 768 nodes, 777 cells, {} bytes\n", copy.len()));
}

#[test]
fn a_file_can_be_converted_onto_itself() {
    let folder = folder_with("quads/helmet.obj");
    succeed(&folder, &["convert", "helmet.obj", "-o", "helmet.obj", "--quiet"]);
    assert_eq!(files(&folder), ["helmet.obj"]);
    let bytes = std::fs::read(folder.path().join("helmet.obj")).unwrap();
    assert_eq!(obj::read(&bytes).unwrap().mesh.cell_count(), 58);
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
