//! The JSON part of a GLB.

use serde_json::{Value, json};

use super::shape::Shape;
use crate::io::tag_numbers::{has_no_names, labels};
use crate::mesh::{TagSet, Tags};

/// Constants of glTF.
const FLOAT: u32 = 5126;
const UNSIGNED_INT: u32 = 5125;
const ARRAY_BUFFER: u32 = 34962;
const ELEMENT_ARRAY_BUFFER: u32 = 34963;
const TRIANGLES: u32 = 4;
const LINES: u32 = 1;

/// Turns the Z axis of the mesh up, which in glTF is the Y axis: a quarter turn about X, x y z w.
const Z_UP: [f64; 4] = [-std::f64::consts::FRAC_1_SQRT_2, 0.0, 0.0, std::f64::consts::FRAC_1_SQRT_2];

/// Linear colours of the tag sets, in turn: the untagged grey first.
const COLOURS: [[f64; 3]; 8] = [
    [0.60, 0.62, 0.65],
    [0.20, 0.40, 0.70],
    [0.80, 0.42, 0.12],
    [0.22, 0.55, 0.27],
    [0.65, 0.18, 0.20],
    [0.42, 0.30, 0.62],
    [0.75, 0.62, 0.15],
    [0.15, 0.55, 0.58],
];

const EDGE_COLOUR: [f64; 3] = [0.02, 0.02, 0.03];

/// The JSON of `shape`, whose buffer holds the positions, the triangles set by set, and the edges.
pub(super) fn json_of(shape: &Shape, tags: &Tags) -> Value {
    let (low, high) = range(&shape.positions);
    let positions_size = 12 * shape.positions.len();
    let triangle_count: usize = shape.triangles.values().map(Vec::len).sum();
    let indices_size = 12 * triangle_count + 8 * shape.edges.len();
    let mut accessors = vec![json!({
        "bufferView": 0, "componentType": FLOAT, "count": shape.positions.len(), "type": "VEC3",
        "min": low, "max": high,
    })];
    let (mut primitives, mut materials) = (Vec::new(), Vec::new());
    let mut offset = 0;
    let mut add = |mode: u32, count: usize, material: Value| {
        primitives.push(json!({
            "attributes": { "POSITION": 0 }, "indices": accessors.len(), "mode": mode,
            "material": materials.len(),
        }));
        accessors.push(json!({
            "bufferView": 1, "byteOffset": offset, "componentType": UNSIGNED_INT, "count": count,
            "type": "SCALAR",
        }));
        materials.push(material);
        offset += 4 * count;
    };
    for (&set, triangles) in &shape.triangles {
        add(TRIANGLES, 3 * triangles.len(), set_material(tags, set));
    }
    if !shape.edges.is_empty() {
        add(LINES, 2 * shape.edges.len(), material("edges", EDGE_COLOUR));
    }
    json!({
        "asset": { "version": "2.0", "generator": "hexmill" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [
            { "name": "Z up", "rotation": Z_UP, "children": [1] },
            { "name": "mesh", "translation": shape.center.to_array(), "mesh": 0 },
        ],
        "meshes": [{ "primitives": primitives }],
        "materials": materials,
        "accessors": accessors,
        "bufferViews": [
            { "buffer": 0, "byteLength": positions_size, "target": ARRAY_BUFFER },
            {
                "buffer": 0, "byteOffset": positions_size, "byteLength": indices_size,
                "target": ELEMENT_ARRAY_BUFFER,
            },
        ],
        "buffers": [{ "byteLength": positions_size + indices_size }],
    })
}

/// The least and the greatest of each coordinate.
fn range(positions: &[[f32; 3]]) -> ([f32; 3], [f32; 3]) {
    let mut low = [f32::INFINITY; 3];
    let mut high = [f32::NEG_INFINITY; 3];
    for position in positions {
        for axis in 0..3 {
            low[axis] = low[axis].min(position[axis]);
            high[axis] = high[axis].max(position[axis]);
        }
    }
    (low, high)
}

fn set_material(tags: &Tags, set: u32) -> Value {
    let index = set as usize;
    match tags.sets.get(index) {
        None => material("mesh", COLOURS[0]),
        Some(tagged) if *tagged == TagSet::default() => material("untagged", COLOURS[0]),
        Some(tagged) => material(&name(tagged), COLOURS[1 + index % (COLOURS.len() - 1)]),
    }
}

fn name(set: &TagSet) -> String {
    if has_no_names(set) {
        return format!("tag {}", set.number.unwrap_or(0));
    }
    // The number of a set with names says no more than these.
    let words = labels(set).into_iter().filter(|label| !label.name.is_empty() || label.number != set.number);
    words.map(|label| label.to_string()).collect::<Vec<String>>().join(", ")
}

/// A dull material that is seen from both sides.
fn material(name: &str, [r, g, b]: [f64; 3]) -> Value {
    json!({
        "name": name,
        "doubleSided": true,
        "pbrMetallicRoughness": {
            "baseColorFactor": [r, g, b, 1.0], "metallicFactor": 0.0, "roughnessFactor": 0.8,
        },
    })
}
