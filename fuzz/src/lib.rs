//! What all readers promise, whatever the bytes.

use hexmill::io::{self, AnyMesh, Document, Format};

#[path = "../../tests/fixtures/valid.rs"]
mod valid;

/// Reads `bytes`: what is taken must be a mesh, and the same after writing, as far as the format holds it.
pub fn read_and_write(format: Format, bytes: &[u8]) {
    let document = match io::read(bytes, format) {
        Ok(document) => document,
        Err(error) => {
            assert!(!error.code().is_empty() && !error.message.is_empty());
            assert!(error.line.is_none_or(|line| line > 0 && line <= bytes.len() as u64 + 1));
            return;
        }
    };
    valid::assert_valid(&document);
    // Some formats hold no polygons of five nodes and more.
    let Ok(written) = io::write(&document, format) else { return };
    let back = io::read(&written, format).expect("what was written can be read");
    assert_eq!(sizes(&back), sizes(&document));
    if format == Format::Obj {
        assert_eq!(back.mesh, document.mesh);
    }
}

/// Numbers of nodes and of cells, and whether these are hexes.
fn sizes(document: &Document) -> (usize, usize, bool) {
    let mesh = &document.mesh;
    (mesh.node_count(), mesh.cell_count(), matches!(mesh, AnyMesh::Hexes(_)))
}
