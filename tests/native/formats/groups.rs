//! Groups of faces in files of hexes.

use hexmill::io::{AnyMesh, Document, Format, read, write};
use hexmill::mesh::topology::side_nodes;
use hexmill::mesh::{FaceGroups, Group, HexMesh, TagSet, Tags, check_hexes};

use super::round_trip::{FORMATS, kept, without_given};
use super::worlds::{document, hex_grid, some_sets};

/// Two cubes along x: sides 2 * 6 ..., with the faces x = 0, x = 2 and y = 0 in groups.
fn two_cubes(sets: [TagSet; 3]) -> HexMesh {
    let grid = hex_grid(2);
    let hexes = grid.hexes[..2].to_vec();
    // Sides ascending: y = 0 and x = 0 of the first, y = 0 and x = 2 of the second.
    let of_element = vec![2, 0, 2, 1];
    let groups = FaceGroups::new(vec![2, 5, 6 + 2, 6 + 3], Tags { sets: sets.to_vec(), of_element });
    HexMesh { hexes, groups: groups.expect("ascending"), ..grid }
}

fn hexes(document: &Document) -> &HexMesh {
    let AnyMesh::Hexes(mesh) = &document.mesh else { panic!("hexes became a surface") };
    mesh
}

/// The groups by side, as far as a format keeps tag sets.
fn groups_of(mesh: &HexMesh, format: Format) -> Vec<(u32, TagSet)> {
    let (sides, tags) = (mesh.groups.sides(), mesh.groups.tags());
    (0..).zip(sides).map(|(k, &side)| (side, kept(tags.of(k).expect("a set"), format))).collect()
}

fn named(name: &str, number: i64) -> TagSet {
    TagSet { groups: vec![Group::new(name, number)], number: Some(number), ..TagSet::default() }
}

/// The names of a set.
fn joined(set: &TagSet) -> String {
    set.groups.iter().map(Group::to_string).collect::<Vec<_>>().join("+")
}

#[test]
fn groups_read_back_from_every_format() {
    let mut many = named("walls", 3);
    many.groups.push(Group::new("no_slip", 8));
    let worlds = [
        [named("inlet", 1), named("outlet", 2), many],
        // The same numbers and names as the hexes' own.
        [named("deck", 2), named("wetted", 4), named("other", 9)],
    ];
    for sets in worlds {
        let mesh = two_cubes(sets);
        for (of_hexes, tagged) in [(vec![], false), (some_sets(), true)] {
            let mut of_hexes: Vec<TagSet> = of_hexes;
            of_hexes
                .iter_mut()
                .flat_map(|set| &mut set.groups)
                .for_each(|g| g.name = g.name.replace(' ', "_"));
            let written = document(AnyMesh::Hexes(mesh.clone()), of_hexes);
            for format in FORMATS {
                let again = read(&write(&written, format).unwrap(), format).unwrap();
                assert_eq!(groups_of(hexes(&again), format), groups_of(&mesh, format), "{format}");
                assert_eq!(hexes(&again).hexes, mesh.hexes, "{format}");
                assert_eq!(again.dropped_faces, 0, "{format}");
                let sets = |document: &Document| -> Vec<TagSet> {
                    (0..2).map(|h| kept(document.tags.of(h).unwrap_or(&TagSet::default()), format)).collect()
                };
                let found = sets(&again).into_iter().zip(sets(&written));
                let found: Vec<TagSet> =
                    found.map(|(set, written)| without_given(set, &written, format)).collect();
                assert_eq!(found, sets(&written), "{format}");
                assert_eq!(again.tags.of_element.is_empty(), !tagged, "{format}");
                if matches!(format, Format::Vtu | Format::Vtk) {
                    assert_eq!((again.level, again.parent), (written.level.clone(), written.parent.clone()));
                }
            }
        }
    }
}

#[test]
fn groups_without_numbers_get_some_and_keep_their_names() {
    let of = |name: &str| TagSet { groups: vec![name.into()], ..TagSet::default() };
    let mesh = two_cubes([of("a"), of("b"), of("c")]);
    for format in [Format::Vtu, Format::Msh] {
        let again = read(&write(&Document::from(mesh.clone()), format).unwrap(), format).unwrap();
        let names: Vec<String> =
            groups_of(hexes(&again), format).into_iter().map(|(_, set)| joined(&set)).collect();
        assert_eq!(names, ["c", "a", "c", "b"], "{format}");
    }
}

/// Each face between hexes looks the way that it did, and in a format in which one can come from both sides it comes once.
#[test]
fn groups_between_hexes_read_back_from_every_format() {
    let none = || TagSet::default();
    for side in [3, 6 + 5] {
        let mesh = two_cubes([none(), none(), none()]);
        let tags = Tags { sets: vec![named("baffle", 5)], of_element: vec![0] };
        let mesh = HexMesh { groups: FaceGroups::new(vec![side], tags).expect("one"), ..mesh };
        assert!(check_hexes(&mesh).iter().all(|defect| defect.kind() == "unusedNode"));
        for format in FORMATS {
            let again = read(&write(&Document::from(mesh.clone()), format).unwrap(), format).unwrap();
            assert_eq!(groups_of(hexes(&again), format), groups_of(&mesh, format), "{format}");
            assert_eq!((again.dropped_faces, again.dropped_groups.len()), (0, 0), "{format}");
        }
    }
    let twice = "*SURFACE, NAME=left\n1, S4\n*SURFACE, NAME=right\n2, S6\n";
    let mesh = two_cubes([none(), none(), none()]);
    let hex = |h: usize| mesh.hexes[h].map(|n| (n.0 + 1).to_string()).join(", ");
    let part = format!("*NODE\n{}*ELEMENT, TYPE=C3D8\n1, {}\n2, {}\n", nodes(", ", ""), hex(0), hex(1));
    let document = read(format!("{part}{twice}").as_bytes(), Format::Inp).unwrap();
    let both = TagSet { groups: vec!["left".into(), "right".into()], ..TagSet::default() };
    assert_eq!(groups_of(hexes(&document), Format::Inp), [(3, both)]);
}

/// The nodes of the corners of two cubes as lines, each after its number, joined by `between`.
fn nodes(between: &str, end: &str) -> String {
    let grid = hex_grid(2);
    let line = |(n, p): (usize, &hexmill::geometry::Point)| {
        format!("{}{between}{}{between}{}{between}{}{end}\n", n + 1, 2.0 * p.x, 2.0 * p.y, 2.0 * p.z)
    };
    grid.positions.iter().enumerate().map(line).collect()
}

/// Nodes of hex 0, of its sides and of one that is none, from 1.
fn side(hexes: &[[hexmill::mesh::NodeId; 8]], side: u32, between: &str) -> String {
    side_nodes(hexes, side).map(|n| (n.0 + 1).to_string()).join(between)
}

#[test]
fn msh_2_elements_in_several_groups_come_together() {
    let mesh = two_cubes([(); 3].map(|()| TagSet::default()));
    let hex = |h: usize| mesh.hexes[h].map(|n| (n.0 + 1).to_string()).join(" ");
    let quad = |s: u32| side(&mesh.hexes, s, " ");
    let text = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n2 7 \"inlet\"\n2 8 \"all\"\n0 3 \"tip\"\n1 4 \"axis\"\n$EndPhysicalNames\n\
         $Nodes\n27\n{}$EndNodes\n$Elements\n8\n1 3 2 7 1 {}\n2 3 2 8 1 {}\n3 3 2 8 2 {}\n4 3 2 9 2 {}\n5 3 2 8 2 1 2 5 9\n\
         6 2 2 8 2 1 2 4\n7 5 2 1 1 {}\n8 5 2 1 1 {}\n$EndElements\n",
        nodes(" ", ""),
        quad(5),
        quad(5),
        quad(9),
        quad(3),
        hex(0),
        hex(1)
    );
    let document = read(text.as_bytes(), Format::Msh).unwrap();
    let groups = vec![Group::new("inlet", 7), Group::new("all", 8)];
    let both = TagSet { groups, number: Some(7), ..TagSet::default() };
    let between = TagSet { number: Some(9), ..TagSet::default() };
    assert_eq!(groups_of(hexes(&document), Format::Msh), [(3, between), (5, both), (9, named("all", 8))]);
    // The quad that is none of their faces, and the triangle; no points nor curves.
    assert_eq!(document.dropped_faces, 2);
    assert_eq!(document.dropped_groups, ["all", "tip", "axis"]);
    assert_eq!(document.tags.of(1).unwrap().number, Some(1));
}

#[test]
fn inp_surfaces_and_shells_are_groups() {
    let mesh = two_cubes([(); 3].map(|()| TagSet::default()));
    let hex = |h: usize| mesh.hexes[h].map(|n| (n.0 + 1).to_string()).join(", ");
    let part = format!(
        "*NODE\n{}*ELEMENT, TYPE=C3D8, ELSET=solid\n1, {}\n2, {}\n*ELEMENT, TYPE=S4, ELSET=skin\n9, {}\n",
        nodes(", ", ""),
        hex(0),
        hex(1),
        side(&mesh.hexes, 9, ", ")
    );
    let surfaces = "*SURFACE, NAME=bottom, TYPE=ELEMENT\nsolid, S1\n*SURFACE, NAME=left\n1, S6\n2, S6\n99, S1\n\
                    *SURFACE, NAME=points, TYPE=NODE\n1\n*SURFACE, NAME=shell\nskin, SPOS\n\
                    *NSET, NSET=fixed\n1, 2\n*NSET, NSET=FIXED\n3\n*NSET, NSET=_picked, INTERNAL\n1\n";
    let of = |name: &str| TagSet { groups: vec![name.into()], ..TagSet::default() };
    let left = [(5, of("left")), (6 + 5, of("left"))];
    let expected = [(0, of("bottom")), left[0].clone(), (6, of("bottom")), (9, of("skin")), left[1].clone()];
    let document = read(format!("{part}{surfaces}").as_bytes(), Format::Inp).unwrap();
    assert_eq!(groups_of(hexes(&document), Format::Inp), expected);
    // An element that is not there.
    assert_eq!(document.dropped_faces, 1);
    assert_eq!(document.dropped_groups, ["fixed"]);

    // As Abaqus/CAE writes them: sets of instances in the assembly.
    let assembly = format!(
        "*PART, NAME=p\n{part}*SURFACE, NAME=own\nsolid, S2\n*END PART\n*ASSEMBLY, NAME=a\n\
         *INSTANCE, NAME=one, PART=p\n*END INSTANCE\n*INSTANCE, NAME=two, PART=p\n5, 0, 0\n*END INSTANCE\n\
         *ELSET, ELSET=_s_S3, INTERNAL, INSTANCE=two\n1\n*SURFACE, TYPE=ELEMENT, NAME=s\n_s_S3, S3\none.2, S4\n\
         *END ASSEMBLY\n"
    );
    let document = read(assembly.as_bytes(), Format::Inp).unwrap();
    let names: Vec<(u32, String)> = groups_of(hexes(&document), Format::Inp)
        .into_iter()
        .map(|(side, set)| (side, joined(&set)))
        .collect();
    let own = |side: u32| (side, "own".to_owned());
    let expected =
        [own(1), own(7), (9, "s+skin".into()), own(13), (14, "s".into()), own(19), (21, "skin".into())];
    assert_eq!(names, expected);
}

#[test]
fn groups_beyond_the_hexes_are_not_written() {
    let mut mesh = two_cubes([(); 3].map(|()| TagSet::default()));
    mesh.hexes.pop();
    for format in FORMATS {
        assert_eq!(write(&Document::from(mesh.clone()), format).unwrap_err().code, "inconsistent");
    }
}
