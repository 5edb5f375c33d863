//! VTU.

use hexmill::io::{AnyMesh, vtu};

use super::worlds::{as_read, document, hex_grid, mixed_polygons, quad_grid, some_sets};

#[test]
fn what_is_written_reads_back() {
    for mesh in
        [AnyMesh::Quads(quad_grid(7)), AnyMesh::Polygons(mixed_polygons()), AnyMesh::Hexes(hex_grid(3))]
    {
        for sets in [vec![], some_sets()] {
            let written = document(mesh.clone(), sets);
            let bytes = vtu::write(&written).unwrap();
            assert_eq!(vtu::read(&bytes).unwrap(), as_read(&written));
        }
    }
}
