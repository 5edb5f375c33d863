//! What the reader takes, statement by statement.

use hexmill::geometry::Point;
use hexmill::io::{Document, obj};
use hexmill::mesh::{Group, NodeId, PolygonMesh};

/// The document of `text`.
fn read(text: &str) -> Document {
    obj::read(text.as_bytes()).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// The surface of `text`.
fn surface(text: &str) -> PolygonMesh {
    read(text).into_surface().expect("a surface")
}

/// The faces of `text` after three vertices, as lists of node numbers.
fn faces(text: &str) -> Vec<Vec<u32>> {
    let mesh = surface(&format!("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n{text}"));
    mesh.faces().map(|f| f.iter().map(|n| n.0).collect()).collect()
}

/// The coordinates in `v` lines of `text`.
fn positions(text: &str) -> Vec<[f64; 3]> {
    surface(text).positions.iter().map(|p| p.to_array()).collect()
}

fn nodes<const N: usize>(ids: [u32; N]) -> Vec<NodeId> {
    ids.map(NodeId).to_vec()
}

#[test]
fn all_index_forms() {
    for corners in ["1 2 3", "1/1 2/2 3/3", "1//1 2//2 3//3", "1/9/8 2/7/6 3/5/4", "-4 -3 -2", "+1 2 03"] {
        assert_eq!(faces(&format!("f {corners}")), [[0, 1, 2]], "{corners}");
    }
    assert_eq!(faces("f 1/ 2// -2/-1/-9"), [[0, 1, 2]], "empty and negative attributes");
    assert_eq!(faces("fo 1 2 3"), [[0, 1, 2]], "the old name of f");
}

#[test]
fn polygons_of_any_size() {
    assert_eq!(
        faces("f 1 2 3\nf 1 2 3 4\nf 1 2 3 4 1 2 3"),
        [vec![0, 1, 2], vec![0, 1, 2, 3], vec![0, 1, 2, 3, 0, 1, 2]]
    );
}

#[test]
fn a_face_may_stand_before_its_vertices() {
    let mesh = surface("f 1 2 3\nv 0 0 0\nf 3 2 1\nv 1 0 0\nv 0 1 0\n");
    assert_eq!(mesh.corners, nodes([0, 1, 2, 2, 1, 0]));
}

#[test]
fn negative_indices_count_back_from_their_own_line() {
    let mesh = surface("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 0 0\nf -3 -2 -1\n");
    assert_eq!(mesh.corners, nodes([0, 1, 2, 1, 2, 3]));
}

#[test]
fn weights_and_colours_are_dropped() {
    let expected = [[1.0, 2.0, 3.0]];
    for rest in ["", " 1.0", " 0.1 0.2 0.3", " 1.0 0.1 0.2 0.3"] {
        assert_eq!(positions(&format!("v 1 2 3{rest}")), expected, "{rest}");
    }
}

#[test]
fn numbers_in_all_their_forms() {
    assert_eq!(positions("v +1 -.5 2."), [[1.0, -0.5, 2.0]]);
    assert_eq!(positions("v 1e3 1E-3 -1.5e+2"), [[1000.0, 0.001, -150.0]]);
    assert_eq!(positions("v 1.0D+00 2d-1 -3D2"), [[1.0, 0.2, -300.0]], "Fortran exponents");
    assert_eq!(positions("v 007 -0 1e-400"), [[7.0, -0.0, 0.0]]);
    assert_eq!(positions("v 1.7976931348623157e308 5e-324 0"), [[f64::MAX, 5e-324, 0.0]]);
}

#[test]
fn numbers_are_rounded_correctly() {
    for text in
        ["9007199254740993", "8.5", "0.1", "2.2250738585072011e-308", "123456789012345678901234567890"]
    {
        let expected: f64 = text.parse().unwrap();
        assert_eq!(positions(&format!("v {text} 0 0"))[0][0].to_bits(), expected.to_bits(), "{text}");
    }
}

#[test]
fn numbers_that_take_the_slow_way_are_rounded_correctly() {
    let half_of_ulp = "1.00000000000000011102230246251565404236316680908203125";
    for text in [
        half_of_ulp.to_owned(),
        format!("{half_of_ulp}{}1", "0".repeat(2000)),
        format!("{half_of_ulp}{}", "0".repeat(2000)),
    ] {
        let expected: f64 = text.parse().unwrap();
        assert_eq!(positions(&format!("v {text} -{text}d0 0"))[0], [expected, -expected, 0.0], "{text}");
    }
    for text in [
        "000123.4500d-7",
        ".5D1",
        "5.D-1",
        "-0d0",
        "0.000d99999999999999999999",
        "17d+12",
        "2.2250738585072011d-308",
    ] {
        let expected: f64 = text.to_lowercase().replace('d', "e").parse().unwrap();
        assert_eq!(positions(&format!("v {text} 0 0"))[0][0].to_bits(), expected.to_bits(), "{text}");
    }
}

#[test]
fn line_ends_of_every_system() {
    let lines = ["v 0 0 0", "v 1 0 0", "v 0 1 0", "", "f 1 2 3"];
    for end in ["\n", "\r\n", "\r"] {
        assert_eq!(surface(&lines.join(end)).corners, nodes([0, 1, 2]), "{end:?}");
    }
    assert_eq!(surface("v 0 0 0\rv 1 0 0\r\nv 0 1 0\nf 1 2 3\r\r").corners, nodes([0, 1, 2]));
}

#[test]
fn continued_lines() {
    for end in ["\n", "\r\n", "\r"] {
        assert_eq!(faces(&format!("f 1 2 \\{end} 3 4{end}")), [[0, 1, 2, 3]], "{end:?}");
        assert_eq!(faces(&format!("f 1 2\\{end}3\\{end}\\{end}4")), [[0, 1, 2, 3]], "{end:?}");
    }
    assert_eq!(faces("vt 0 \\\n 1\nmtllib a.mtl \\\n b.mtl\nf 1 2 3"), [[0, 1, 2]], "skipped statements");
    assert_eq!(faces("# C:\\models\\\nf 1 2 3"), [[0, 1, 2]], "a comment does not go on");
}

#[test]
fn comments_blanks_and_a_byte_order_mark() {
    let mesh = surface("\u{feff}v 0 0 0 # first\n\t v\t1 0  0\n#v 9 9 9\n v 0 1 0 \n\nf 1 2 3 #\n");
    assert_eq!(mesh.corners, nodes([0, 1, 2]));
    assert_eq!(mesh.positions.len(), 3);
}

#[test]
fn appearance_and_unknown_words_are_skipped() {
    let text =
        "mtllib a.mtl\nvt 0 x\nvn\nvp 1\ns off\np 1\nlod 1\nmg 0\nshadow_obj a\nmy_tool_mark 1 2\nf 1 2 3";
    assert_eq!(faces(text), [[0, 1, 2]]);
}

#[test]
fn polylines() {
    let mesh = surface("v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3\nl -1/1 1/2");
    assert_eq!(mesh.features.polylines, [nodes([0, 1, 2]), nodes([2, 0])]);
    assert_eq!(mesh.face_count(), 0);
}

#[test]
fn sharpness_tags() {
    let mesh = surface(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nt crease 2/1/0 0 1 2.5\nt crease 4/2/0 0 1 1 2 1 3\n\
         t corner 1/1/0 2 10\nt corner 2/1 0 1 4\nt interpolateboundary 1/0/0 2\n\
         t facevaryinginterpolateboundary 1/0/0 1\nt smoothtriangles 0/0/1 catmark",
    );
    let [a, b, c] = [0, 1, 2].map(NodeId);
    assert_eq!(mesh.features.creases, [([a, b], 2.5), ([a, b], 1.0), ([b, c], 3.0)]);
    assert_eq!(mesh.features.corners, [(c, 10.0), (a, 4.0), (b, 4.0)]);
    assert_eq!(mesh.features.interpolate_boundary, Some(2));
}

#[test]
fn names_become_tags() {
    let document = read(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no part one # 2\ng wall left # a comment\nf 1 2 3\n\
         usemtl Material #25\nf 1 2 3\ng\no\nusemtl\nf 1 2 3\no part one # 2\ng wall left\nf 1 2 3",
    );
    assert_eq!(document.tags.of_element, [0, 1, 2, 0, 1]);
    let [none, wall, steel] = &document.tags.sets[..] else { panic!("{:?}", document.tags.sets) };
    assert_eq!((&none.object, none.groups.len(), &none.material), (&None, 0, &None));
    assert_eq!((wall.object.as_deref(), &wall.material), (Some("part one # 2"), &None));
    assert_eq!(wall.groups, ["wall", "left"].map(Group::from));
    assert_eq!(steel.material.as_deref(), Some("Material #25"));
}

#[test]
fn a_file_without_names_has_no_tags() {
    assert_eq!(read("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\ng unused").tags, Default::default());
}

#[test]
fn names_in_other_encodings_are_kept_apart() {
    let file = b"v 0 0 0\nv 1 0 0\nv 0 1 0\ng \xE9t\xE9\nf 1 2 3\ng \xE8t\xE8\nf 1 2 3\ng \xC3\xA9\nf 1 2 3";
    let document = obj::read(file).unwrap();
    let groups: Vec<&str> = document.tags.sets.iter().map(|s| s.groups[0].name.as_str()).collect();
    assert_eq!(groups, ["été", "ètè", "é"]);
}

#[test]
fn a_file_of_points_alone_is_read() {
    let mesh = surface("v 1 2 3\n");
    assert_eq!((mesh.positions, mesh.offsets), (vec![Point::new(1.0, 2.0, 3.0)], vec![0]));
}
