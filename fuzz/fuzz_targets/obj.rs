//! Feeds any bytes to the OBJ reader. What it takes must be a mesh, and the same after writing.
//!
//! `cargo +nightly fuzz run obj fuzz/corpus/obj fuzz/seeds/obj -- -max_total_time=20`
#![no_main]

use hexmill::io::{AnyMesh, Document, obj};
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    match obj::read(bytes) {
        Ok(document) => {
            check(&document);
            let written = obj::write(&document).expect("a surface with finite coordinates can be written");
            let back = obj::read(&written).expect("what was written can be read");
            assert_eq!(back.mesh, document.mesh);
        }
        Err(error) => {
            assert!(error.code().starts_with("obj-") && !error.message.is_empty());
            assert!(error.line.is_none_or(|line| line <= bytes.len() as u64 + 1));
        }
    }
});

/// Checks what the types promise.
fn check(document: &Document) {
    let AnyMesh::Polygons(mesh) = &document.mesh else { panic!("OBJ gives surfaces") };
    let nodes = mesh.positions.len();
    assert!(mesh.positions.iter().all(|p| p.is_finite()));
    assert!(mesh.corners.iter().all(|n| n.index() < nodes));
    assert!(mesh.faces().all(|f| f.len() >= 3));
    assert!(mesh.features.polylines.iter().all(|l| l.len() >= 2 && l.iter().all(|n| n.index() < nodes)));
    assert!(mesh.features.creases.iter().flat_map(|(edge, _)| edge).all(|n| n.index() < nodes));
    assert!(mesh.features.corners.iter().all(|(n, _)| n.index() < nodes));
    let tags = &document.tags;
    assert!(tags.of_element.is_empty() || tags.of_element.len() == mesh.face_count());
    assert!(tags.of_element.iter().all(|&set| (set as usize) < tags.sets.len()));
}
