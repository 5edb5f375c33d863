//! Cells and faces in several groups, each with a number of its own.

use hexmill::io::{AnyMesh, Document, Format, losses, read, write};
use hexmill::mesh::{Group, HexMesh, TagSet, Tags, check_hexes};

use super::worlds::hex_grid;

const HEXES: [&str; 2] = ["1 2 5 4 7 8 11 10", "2 3 6 5 8 9 12 11"];

/// The nodes of two cubes, as lines of a file.
fn nodes() -> String {
    let node = |n: u32| format!("{} {} {} {}\n", n + 1, n % 3, n / 3 % 2, n / 6);
    (0..12).map(node).collect()
}

/// A file of version 2.2 with these lines of elements.
fn version_2(names: &[&str], elements: &[String]) -> Vec<u8> {
    let elements: String = elements.iter().zip(1..).map(|(line, k)| format!("{k} {line}\n")).collect();
    let count = elements.lines().count();
    format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n{}\n{}\n$EndPhysicalNames\n$Nodes\n12\n{}$EndNodes\n\
         $Elements\n{count}\n{elements}$EndElements\n",
        names.len(),
        names.join("\n"),
        nodes()
    )
    .into_bytes()
}

/// Two cubes: the first in the groups `fluid` and `zone`, the second in `zone` and in one without a name; the face x = 0 in
/// two groups with the names and numbers of the cubes'.
fn two_cubes() -> Document {
    let [first, second] = HEXES;
    let lines = [
        format!("5 2 10 1 {first}"),
        format!("5 2 20 1 {first}"),
        format!("5 2 20 2 {second}"),
        format!("5 2 4000 2 {second}"),
        "3 2 10 7 1 4 10 7".to_owned(),
        "3 2 5 7 1 4 10 7".to_owned(),
    ];
    let names = ["3 10 \"fluid\"", "3 20 \"zone\"", "2 10 \"inlet\"", "2 5 \"zone\""];
    read(&version_2(&names, &lines), Format::Msh).expect("repeated elements are one")
}

fn hexes(document: &Document) -> &HexMesh {
    let AnyMesh::Hexes(mesh) = &document.mesh else { panic!("not hexes") };
    mesh
}

/// What each cube and the face are in, by names and numbers, sorted.
fn groups(document: &Document) -> [Vec<(String, Option<i64>)>; 3] {
    let of = |set: &TagSet| {
        let own = set.number.filter(|_| set.groups.iter().all(|group| group.number != set.number));
        let mut all: Vec<(String, Option<i64>)> =
            set.groups.iter().map(|group| (group.name.clone(), group.number)).collect();
        all.extend(own.map(|number| (String::new(), Some(number))));
        all.sort();
        all
    };
    let faces = hexes(document).groups.tags();
    [document.tags.of(0), document.tags.of(1), faces.of(0)].map(|set| of(set.expect("tagged")))
}

#[test]
fn an_element_that_comes_once_for_each_group_is_one_cell() {
    let document = two_cubes();
    assert_eq!(hexes(&document).hexes.len(), 2);
    assert!(check_hexes(hexes(&document)).is_empty());
    let named = |name: &str, number| (name.to_owned(), Some(number));
    let expected = [
        vec![named("fluid", 10), named("zone", 20)],
        vec![named("", 4000), named("zone", 20)],
        vec![named("inlet", 10), named("zone", 5)],
    ];
    assert_eq!(groups(&document), expected);
}

#[test]
fn an_element_that_comes_twice_in_one_group_stays_two() {
    let [first, second] = HEXES;
    let line = |group: i32, entity: i32, nodes: &str| format!("5 2 {group} {entity} {nodes}");
    for repeated in [line(20, 1, first), line(10, 1, first), line(10, 2, first)] {
        let is_same_group = repeated != line(20, 1, first);
        let lines = [line(10, 1, first), repeated, line(10, 2, second)];
        let document = read(&version_2(&["3 10 \"fluid\""], &lines), Format::Msh).unwrap();
        let kinds: Vec<&str> = check_hexes(hexes(&document)).iter().map(|defect| defect.kind()).collect();
        assert_eq!(kinds.contains(&"sameHexes"), is_same_group, "{kinds:?}");
    }
}

#[test]
fn names_and_numbers_of_several_groups_read_back() {
    let document = two_cubes();
    for format in [Format::Msh, Format::Vtu, Format::Inp] {
        let once = read(&write(&document, format).unwrap(), format).unwrap();
        assert_eq!(groups(&once), groups(&document), "{format}");
        let msh = read(&write(&once, Format::Msh).unwrap(), Format::Msh).unwrap();
        assert_eq!(groups(&msh), groups(&document), "{format}");
    }
    let text = String::from_utf8(write(&document, Format::Msh).unwrap()).unwrap();
    let names =
        "$PhysicalNames\n4\n3 10 \"fluid\"\n3 20 \"zone\"\n2 5 \"zone\"\n2 10 \"inlet\"\n$EndPhysicalNames\n";
    assert!(text.contains(names), "{text}");
    for entity in ["1 0.0 0.0 0.0 2.0 1.0 1.0 2 10 5 0\n", "2 10 20 0\n", "2 20 4000 0\n"] {
        assert!(text.contains(entity), "{text}");
    }
}

#[test]
fn formats_with_one_number_a_cell_tell_what_they_lose() {
    let document = two_cubes();
    for format in [Format::Vtk, Format::Medit, Format::Vtu] {
        let told = losses(&document, format);
        assert_eq!(told.len(), 2, "{format}: {told:?}");
        assert!(told[0].starts_with("hexes in several groups"), "{}", told[0]);
        assert!(told[0].contains("fluid + zone, zone + 4000"), "{}", told[0]);
        assert!(told[1].starts_with("faces of hexes in several groups"), "{}", told[1]);
        // Each combination has a number of its own.
        let again = read(&write(&document, format).unwrap(), format).unwrap();
        let number = |hex: usize| again.tags.of(hex).and_then(|set| set.number);
        assert_eq!([number(0), number(1)], [Some(10), Some(20)], "{format}");
    }
    for format in [Format::Msh, Format::Inp] {
        assert!(losses(&document, format).is_empty(), "{format}");
    }
    let plain = Document::from(hex_grid(2));
    assert!(Format::ALL.iter().all(|&format| losses(&plain, format).is_empty()));
}

#[test]
fn numbers_that_msh_cannot_hold_are_told() {
    let mut document = two_cubes();
    let set = |groups: Vec<Group>, number| TagSet { groups, number: Some(number), ..TagSet::default() };
    document.tags.sets = vec![set(vec![Group::new("far", 1 << 40)], 1 << 40), set(vec![], -7)];
    let told = losses(&document, Format::Msh);
    assert!(told.len() == 1 && told[0].ends_with(": -7, far (1099511627776)"), "{told:?}");
    let again = read(&write(&document, Format::Msh).unwrap(), Format::Msh).unwrap();
    assert_eq!(groups(&again)[0], [("far".to_owned(), Some(1))]);
    assert_eq!(groups(&again)[1], [(String::new(), Some(2))]);
}

#[test]
fn a_face_under_two_references_is_in_both_groups() {
    let node = |line: &str| format!("{} 0\n", line.split_once(' ').expect("a number").1);
    let nodes: String = nodes().lines().map(node).collect();
    let [first, second] = HEXES;
    let text = format!(
        "MeshVersionFormatted 2\nDimension 3\nVertices\n12\n{nodes}Hexahedra\n2\n{first} 1\n{second} 99999999999\n\
         Quadrilaterals\n2\n1 4 10 7 3\n10 7 1 4 5\nEnd\n"
    );
    let document = read(text.as_bytes(), Format::Medit).unwrap();
    let [_, wide, both] = groups(&document);
    assert_eq!(both, [(String::new(), Some(3)), (String::new(), Some(5))]);
    assert_eq!(wide, [(String::new(), Some(99_999_999_999))]);
    assert_eq!(losses(&document, Format::Medit).len(), 1);
    for format in [Format::Medit, Format::Vtu, Format::Vtk, Format::Inp] {
        let again = read(&write(&document, format).unwrap(), format).unwrap();
        assert_eq!(again.tags.of(1).and_then(|set| set.number), Some(99_999_999_999), "{format}");
    }
}

/// A number without a name that comes after a name of the same elements would be read as the name's.
#[test]
fn numbers_without_names_stay_apart_from_names_in_input_decks() {
    let named = |name: &str| Group::from(name);
    let set = |groups: Vec<Group>, number| TagSet { groups, number, ..TagSet::default() };
    let sets = vec![set(vec![named("v")], None), set(vec![named("b"), named("v")], Some(27))];
    let mut document = Document::from(hex_grid(1));
    document.tags = Tags { sets: sets.clone(), of_element: vec![1] };
    let again = read(&write(&document, Format::Inp).unwrap(), Format::Inp).unwrap();
    assert_eq!(again.tags.of(0), Some(&sets[1]));
}
