//! Writing and reading again gives the same document.

use std::collections::HashMap;

use hexmill::geometry::Point;
use hexmill::io::{AnyMesh, Document, obj};
use hexmill::mesh::{Features, Group, HexMesh, NodeId, PolygonMesh, QuadMesh, TagSet, Tags};
use proptest::collection::vec;
use proptest::option;
use proptest::prelude::*;

/// Any finite double, the odd ones among them.
fn coordinate() -> impl Strategy<Value = f64> {
    use proptest::num::f64::{NEGATIVE, NORMAL, POSITIVE, SUBNORMAL, ZERO};
    prop_oneof![POSITIVE | NEGATIVE | NORMAL | SUBNORMAL | ZERO, -10.0..10.0, (-9..9_i32).prop_map(f64::from)]
}

fn point() -> impl Strategy<Value = Point> {
    [coordinate(), coordinate(), coordinate()].prop_map(Point::from_array)
}

/// Names that OBJ can hold: in one line, and for groups in one word.
fn tag_set() -> impl Strategy<Value = TagSet> {
    let line = "[a-zä#\\\\.]([a-z é#/.-]{0,6}[a-z#])?";
    let word = "[a-zü][a-z#é/.-]{0,6}";
    (option::of(line), vec(word, 0..3), option::of(line))
        .prop_map(|(object, groups, material)| TagSet {
            object,
            groups: groups.into_iter().map(Group::from).collect(),
            material,
            number: None,
        })
        .prop_filter("a '\\' at the end continues the line", |set| {
            !set.object.iter().chain(&set.material).any(|name| name.ends_with('\\'))
        })
}

/// Tags as a reader makes them: distinct sets in the order of first use, none if all faces have no names.
fn tags_of(faces: Vec<TagSet>) -> Tags {
    if faces.iter().all(|set| *set == TagSet::default()) {
        return Tags::default();
    }
    let mut tags = Tags::default();
    let mut seen = HashMap::new();
    for set in faces {
        let next = tags.sets.len() as u32;
        let index = *seen.entry(set.clone()).or_insert(next);
        if index == next {
            tags.sets.push(set);
        }
        tags.of_element.push(index);
    }
    tags
}

fn features(nodes: u32) -> impl Strategy<Value = Features> {
    let node = move || (0..nodes).prop_map(NodeId);
    let sharpness = || 0.0..10.0;
    (
        vec(vec(node(), 2..5), 0..3),
        vec(([node(), node()], sharpness()), 0..3),
        vec((node(), sharpness()), 0..3),
        option::of(any::<i32>()),
    )
        .prop_map(|(polylines, creases, corners, interpolate_boundary)| Features {
            polylines,
            creases,
            corners,
            interpolate_boundary,
        })
}

fn document() -> impl Strategy<Value = Document> {
    (vec(point(), 1..20), vec(tag_set(), 1..4))
        .prop_flat_map(|(positions, sets)| {
            let nodes = positions.len() as u32;
            let face = (vec((0..nodes).prop_map(NodeId), 3..7), 0..sets.len());
            (Just(positions), Just(sets), vec(face, 0..12), features(nodes))
        })
        .prop_map(|(positions, sets, faces, features)| {
            let mut mesh = PolygonMesh { positions, features, ..PolygonMesh::default() };
            for (face, _) in &faces {
                mesh.push_face(face.iter().copied());
            }
            mesh.tags = tags_of(faces.into_iter().map(|(_, set)| sets[set].clone()).collect());
            Document::from(mesh)
        })
}

/// A document's coordinates, bit by bit, since -0 equals 0.
fn bits(document: &Document) -> Vec<[u64; 3]> {
    let AnyMesh::Polygons(mesh) = &document.mesh else { panic!("no surface") };
    mesh.positions.iter().map(|p| p.to_array().map(f64::to_bits)).collect()
}

proptest! {
    #[test]
    fn write_then_read_is_the_identity(document in document()) {
        let bytes = obj::write(&document).unwrap();
        let back = obj::read(&bytes).unwrap_or_else(|e| panic!("{e}\n{}", String::from_utf8_lossy(&bytes)));
        prop_assert_eq!(&back, &document, "{}", String::from_utf8_lossy(&bytes));
        prop_assert_eq!(bits(&back), bits(&document));
    }
}

#[test]
fn quads_are_written_as_faces() {
    let mesh = QuadMesh {
        positions: vec![Point::ZERO, Point::X, Point::new(1.0, 0.25, 0.0), Point::Y],
        quads: vec![[0, 1, 2, 3].map(NodeId)],
    };
    let bytes = obj::write(&Document::from(mesh)).unwrap();
    assert_eq!(
        String::from_utf8(bytes).unwrap(),
        "# hexmill\nv 0 0 0\nv 1 0 0\nv 1 0.25 0\nv 0 1 0\nf 1 2 3 4\n"
    );
}

#[test]
fn names_that_obj_cannot_hold_are_changed() {
    let mut mesh = PolygonMesh { positions: vec![Point::ZERO; 3], ..PolygonMesh::default() };
    mesh.push_face([0, 1, 2].map(NodeId));
    let set = TagSet {
        object: Some("two\nlines\\".into()),
        groups: vec!["two words".into(), "#1".into()],
        material: None,
        number: Some(-7),
    };
    mesh.tags = tags_of(vec![set]);
    let text = String::from_utf8(obj::write(&Document::from(mesh)).unwrap()).unwrap();
    assert!(text.ends_with("o two lines\ng two_words _1 tag_-7\nf 1 2 3\n"), "{text}");
}

#[test]
fn hexes_are_refused() {
    let error = obj::write(&Document::from(HexMesh::default())).unwrap_err();
    assert_eq!(error.code(), "format-holds-no-hexes");
    assert_eq!(error.to_string(), "obj: OBJ holds no hexes: write VTU, VTK, MSH, INP or MEDIT");
}

#[test]
fn a_node_at_no_place_is_refused() {
    let mesh = PolygonMesh { positions: vec![Point::ZERO, Point::NAN], ..PolygonMesh::default() };
    let error = obj::write(&Document::from(mesh)).unwrap_err();
    assert_eq!(error.code(), "coordinate-not-finite");
    assert_eq!(
        error.to_string(),
        "obj: node 1 stands at [NaN, NaN, NaN], which is not finite: mend the mesh first"
    );
}
