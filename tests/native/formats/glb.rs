//! GLB: the structure that the specification asks for. (The Khronos validator was run by hand.)

use hexmill::geometry::Point;
use hexmill::io::glb::{GlbOptions, write, write_with};
use hexmill::io::{AnyMesh, Document};
use serde_json::Value;

use super::worlds::{document, hex_grid, mixed_polygons, quad_grid, some_sets};

/// The JSON and the data of a GLB whose headers hold.
fn open(bytes: &[u8]) -> (Value, &[u8]) {
    let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
    assert_eq!((&bytes[..4], word(4), word(8)), (&b"glTF"[..], 2, bytes.len()));
    let json = word(12);
    assert_eq!((&bytes[16..20], json % 4), (&b"JSON"[..], 0));
    let data = &bytes[28 + json..];
    assert_eq!((&bytes[24 + json..28 + json], word(20 + json)), (&b"BIN\0"[..], data.len()));
    (serde_json::from_slice(&bytes[20..20 + json]).unwrap(), data)
}

fn counts(json: &Value) -> Vec<u64> {
    let accessors = json["accessors"].as_array().unwrap();
    accessors.iter().map(|accessor| accessor["count"].as_u64().unwrap()).collect()
}

#[test]
fn quads_become_two_triangles_each_and_keep_their_edges() {
    let quads = document(AnyMesh::Quads(quad_grid(4)), vec![]);
    let bytes = write(&quads).unwrap();
    let (json, data) = open(&bytes);
    // 25 nodes, 16 quads, 40 edges.
    assert_eq!(counts(&json), [25, 16 * 6, 40 * 2]);
    assert_eq!(data.len(), 25 * 12 + 16 * 24 + 40 * 8);
    assert_eq!(json["meshes"][0]["primitives"][1]["mode"], 1);
    let without = write_with(&quads, GlbOptions { edges: false }).unwrap();
    assert_eq!(counts(&open(&without).0), [25, 16 * 6]);
}

#[test]
fn hexes_are_shown_by_their_boundary() {
    let bytes = write(&document(AnyMesh::Hexes(hex_grid(3)), vec![])).unwrap();
    // 54 faces of 27 cubes; the 8 inner nodes are left out.
    assert_eq!(counts(&open(&bytes).0), [56, 54 * 6, 108 * 2]);
}

#[test]
fn polygons_are_cut_into_triangles_by_tag_set() {
    let bytes = write(&document(AnyMesh::Polygons(mixed_polygons()), some_sets())).unwrap();
    let (json, _) = open(&bytes);
    // Sets in turn: a triangle and a quad, a quad and a pentagon, a quad.
    assert_eq!(counts(&json)[1..4], [3 + 6, 6 + 9, 6]);
    assert_eq!(json["materials"][0]["name"], "wetted, port side, object:hull, material:steel");
    assert_eq!(json["materials"][3]["name"], "edges");
}

#[test]
fn coordinates_far_from_the_origin_keep_their_digits() {
    let mut grid = quad_grid(8);
    let far = Point::new(4.0e6, -2.5e6, 1.0e4);
    grid.positions.iter_mut().for_each(|point| *point += far);
    let wanted = grid.positions.clone();
    let bytes = write(&Document::from(grid)).unwrap();
    let (json, data) = open(&bytes);
    let center: Vec<f64> = serde_json::from_value(json["nodes"][1]["translation"].clone()).unwrap();
    for (point, chunk) in wanted.iter().zip(data.chunks_exact(12)) {
        for axis in 0..3 {
            let local = f32::from_le_bytes(chunk[4 * axis..4 * axis + 4].try_into().unwrap());
            assert!((f64::from(local) + center[axis] - point[axis]).abs() < 1e-7);
        }
    }
}

#[test]
fn the_box_of_the_positions_is_exact() {
    let bytes = write(&document(AnyMesh::Quads(quad_grid(5)), vec![])).unwrap();
    let (json, data) = open(&bytes);
    let numbers: Vec<f32> =
        data[..36 * 12].chunks_exact(4).map(|c| f32::from_le_bytes(c.try_into().unwrap())).collect();
    for axis in 0..3 {
        let along = || numbers.iter().skip(axis).step_by(3).copied();
        assert_eq!(json["accessors"][0]["min"][axis], f64::from(along().fold(f32::MAX, f32::min)));
        assert_eq!(json["accessors"][0]["max"][axis], f64::from(along().fold(f32::MIN, f32::max)));
    }
}

#[test]
fn nothing_to_show_is_refused() {
    let empty = Document::from(hexmill::mesh::QuadMesh::default());
    assert_eq!(write(&empty).unwrap_err().code, "no-cells");
}
