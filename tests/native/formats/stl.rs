//! STL, which is only read: both kinds, what real files hold, and what is wrong with others.

use std::fmt::Write;

use hexmill::io::{self, AnyMesh, Document, Format, ReadError, stl::read};
use hexmill::mesh::PolygonMesh;

/// Four facets by the coordinates of their vertices.
pub const TETRAHEDRON: [[[f32; 3]; 3]; 4] = {
    let [o, x, y, z] = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 0.1]];
    [[o, y, x], [o, x, z], [x, y, z], [y, o, z]]
};

/// An ASCII file of one solid.
pub fn ascii(facets: &[[[f32; 3]; 3]]) -> String {
    let mut text = "solid a part\n".to_owned();
    for facet in facets {
        text += " facet normal 0 0 1\n  outer loop\n";
        for [x, y, z] in facet {
            writeln!(text, "   vertex {x} {y} {z}").unwrap();
        }
        text += "  endloop\n endfacet\n";
    }
    text + "endsolid a part\n"
}

/// A binary file.
pub fn binary(facets: &[[[f32; 3]; 3]]) -> Vec<u8> {
    let mut bytes = b"solid in name only".to_vec();
    bytes.resize(80, b' ');
    bytes.extend((facets.len() as u32).to_le_bytes());
    for facet in facets {
        bytes.extend([0; 12]);
        bytes.extend(facet.as_flattened().iter().flat_map(|x| x.to_le_bytes()));
        bytes.extend([0; 2]);
    }
    bytes
}

fn surface(document: Document) -> PolygonMesh {
    let AnyMesh::Polygons(mesh) = document.mesh else { panic!("not a surface") };
    mesh
}

#[test]
fn both_kinds_hold_the_same_mesh() {
    let text = ascii(&TETRAHEDRON);
    let document = read(text.as_bytes()).unwrap();
    assert!((0..4).all(|f| document.tags.of(f).unwrap().object.as_deref() == Some("a part")));
    let binary = surface(read(&binary(&TETRAHEDRON)).unwrap());
    let ascii = surface(document);
    assert_eq!(ascii.corners, binary.corners);
    let corners: Vec<u32> = ascii.corners.iter().map(|n| n.0).collect();
    assert_eq!(
        corners,
        [0, 1, 2, 0, 2, 3, 2, 1, 3, 1, 0, 3],
        "nodes are welded, in the order of their first use"
    );
    assert_eq!(ascii.positions[3].z, 0.1);
    assert_eq!(binary.positions[3].z, f64::from(0.1_f32));
}

#[test]
fn the_content_tells_the_kind() {
    for bytes in
        [ascii(&TETRAHEDRON).into_bytes(), binary(&TETRAHEDRON), b"\xEF\xBB\xBFSOLID\nFACET".to_vec()]
    {
        assert_eq!(io::detect(&bytes).ok(), Some(Format::Stl));
    }
    let error = io::write(&read(&binary(&TETRAHEDRON)).unwrap(), Format::Stl).unwrap_err();
    assert_eq!(error.code, "format-not-written");
}

#[test]
fn solids_have_names() {
    let solid = |name: &str| ascii(&TETRAHEDRON[..1]).replace("a part", name);
    let tags = |text: String| read(text.as_bytes()).unwrap().tags;
    assert_eq!(tags(solid("")), Default::default());
    let tags = tags(solid("") + &solid("b") + &solid("c") + &solid("b"));
    let objects: Vec<Option<&str>> = (0..4).map(|f| tags.of(f).unwrap().object.as_deref()).collect();
    assert_eq!(objects, [None, Some("b"), Some("c"), Some("b")]);
}

#[test]
fn what_other_programs_write_is_taken() {
    let text =
        ascii(&TETRAHEDRON).to_uppercase().replace('\n', "\r\n").replace("0 0 1\r", "-nan(ind) nan inf\r");
    assert_eq!(surface(read(text.as_bytes()).unwrap()).face_count(), 4);
    let mut bytes = binary(&TETRAHEDRON);
    bytes.extend(b"\nmade by nobody");
    bytes[..5].copy_from_slice(b"COLOR");
    assert_eq!(surface(read(&bytes).unwrap()).face_count(), 4);
}

#[track_caller]
fn check(result: Result<Document, ReadError>, code: &str, line: Option<u64>, words: &str) {
    let error = result.expect_err(words);
    assert_eq!((error.code, error.line), (code, line), "{error}");
    assert!(error.to_string().contains(words), "{error}");
}

#[test]
fn what_is_wrong_is_told_with_its_place() {
    let check_text = |from: &str, to: &str, code, line, words| {
        check(read(ascii(&TETRAHEDRON).replacen(from, to, 1).as_bytes()), code, Some(line), words);
    };
    check_text("vertex 0 1 0", "vertex 0 one 0", "bad-number", 5, "'one' stands where a coordinate should");
    check_text("vertex 0 1 0", "vertex 0 nan 0", "coordinate-not-finite", 5, "is NaN");
    check_text("endloop", "vertex", "syntax", 7, "'vertex' stands where endloop should");
    check_text("endfacet", "", "syntax", 9, "'facet' stands where endfacet should");
    check_text("endsolid a part\n", "", "truncated", 30, "facet or endsolid");
    check_text("facet normal", "triangle", "syntax", 2, "'triangle'");
    check(read(b"solid nothing\nendsolid"), "no-cells", None, "no facets");
    check(read(b""), "not-this-format", Some(1), "the file is empty");
    check(read(b"solit"), "not-this-format", Some(1), "'solit', not with solid");

    let mut bytes = binary(&TETRAHEDRON);
    bytes[84 + 50 + 12 + 24..][..4].copy_from_slice(&f32::INFINITY.to_le_bytes());
    check(read(&bytes), "coordinate-not-finite", None, "byte 170: vertex 2 of facet 1");
    let mut bytes = binary(&TETRAHEDRON);
    bytes[83] = 0xFF;
    check(read(&bytes), "truncated", None, "(byte 80) is 4278190084");
    // Whatever its head says: cut short, and with something after its facets.
    let bytes = binary(&TETRAHEDRON);
    check(read(&bytes[..bytes.len() - 1]), "truncated", None, "(byte 80) is 4");
    let whole = read(&bytes).unwrap();
    assert_eq!(surface(read(&[&bytes[..], b"more"].concat()).unwrap()), surface(whole));
}
