//! Hexes of the second order in files: their corners are read, the other nodes left out.

use hexmill::geometry::Point;
use hexmill::io::{AnyMesh, Document, Format, write};
use hexmill::mesh::check::check_hexes;
use hexmill::mesh::{Group, HexMesh, NodeId};

use super::round_trip::read;
use super::second_order::{KINDS, document, mesh};

fn hexes(document: &Document) -> &HexMesh {
    let AnyMesh::Hexes(mesh) = &document.mesh else { panic!("not hexes") };
    mesh
}

#[test]
fn what_is_written_reads_back_as_linear_hexes() {
    for (kind, _) in KINDS {
        for format in Format::ALL.into_iter().filter(|format| format.takes_second_order()) {
            let again = read(&write(&document(kind), format).expect("a file"), format).expect("hexes");
            let (found, wanted) = (hexes(&again), mesh());
            assert_eq!((&found.positions, &found.hexes), (&wanted.positions, &wanted.hexes), "{format}");
            assert_eq!(found.groups.sides(), wanted.groups.sides(), "{format}");
            let names = &found.groups.tags().sets[0].groups;
            assert!(format == Format::Vtk || names[0].name == "bottom", "{format}: {names:?}");
            assert_eq!((again.linearized, again.dropped_faces), (2, 0), "{format}");
            assert!(again.second_order.is_none() && again.dropped_groups.is_empty(), "{format}");
            let linear = read(&write(&again, format).expect("a file"), format).expect("hexes");
            assert_eq!((linear.linearized, hexes(&linear)), (0, found), "{format}");
        }
    }
}

/// Two boxes with quads of nine nodes and lines of three beside their hexes.
#[test]
fn a_file_of_gmsh_keeps_its_groups() {
    let bytes = include_bytes!("../../fixtures/gmsh_boxes_hex27.msh");
    let document = read(bytes, Format::Msh).expect("hexes");
    let found = hexes(&document);
    assert_eq!((found.hexes.len(), found.positions.len(), document.linearized), (16, 5 * 3 * 3, 16));
    assert_eq!(check_hexes(found), []);
    let sides_in = |name: &str| {
        let tags = found.groups.tags();
        let is_in = |&&set: &&u32| tags.sets[set as usize].groups.iter().any(|group| group.name == name);
        tags.of_element.iter().filter(is_in).count()
    };
    assert_eq!((sides_in("bottom"), sides_in("between")), (8, 4));
    assert_eq!(document.dropped_groups, ["edge"]);
    let in_box = |set: u32| document.tags.of_element.iter().filter(|&&of| of == set).count();
    assert_eq!(document.tags.sets.len(), 2);
    assert_eq!((in_box(0), in_box(1)), (8, 8));
}

/// The nodes of a hex of the second order with straight edges from `x` on, in VTK's order.
fn hex20(x: f64) -> [Point; 20] {
    const EDGES: [[usize; 2]; 12] =
        [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]];
    let corner = |c: usize| {
        let at = |bit: bool| f64::from(u8::from(bit));
        Point::new(x + at(matches!(c % 4, 1 | 2)), at(c % 4 > 1), at(c > 3))
    };
    std::array::from_fn(|k| match k.checked_sub(8) {
        None => corner(k),
        Some(edge) => corner(EDGES[edge][0]).midpoint(corner(EDGES[edge][1])),
    })
}

fn vtk(points: &[Point], cells: &[(&[usize], u8)]) -> String {
    let mut text = format!(
        "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS {} double\n",
        points.len()
    );
    points.iter().for_each(|p| text += &format!("{} {} {}\n", p.x, p.y, p.z));
    let size: usize = cells.iter().map(|(nodes, _)| nodes.len() + 1).sum();
    text += &format!("CELLS {} {size}\n", cells.len());
    for (nodes, _) in cells {
        let nodes: Vec<String> = nodes.iter().map(usize::to_string).collect();
        text += &format!("{} {}\n", nodes.len(), nodes.join(" "));
    }
    text += &format!("CELL_TYPES {}\n", cells.len());
    cells.iter().for_each(|(_, kind)| text += &format!("{kind}\n"));
    text
}

#[test]
fn only_nodes_that_are_no_corners_are_left_out() {
    // The middle of the first hex's first edge is a corner of the second, which is linear; a last node is of no cell.
    let mut points = hex20(0.0).to_vec();
    points.extend(&hex20(3.0)[1..8]);
    points.push(Point::splat(9.0));
    let first: Vec<usize> = (0..20).collect();
    let second: Vec<usize> = std::iter::once(8).chain(20..27).collect();
    let document = read(vtk(&points, &[(&second, 12), (&first, 25)]).as_bytes(), Format::Vtk).expect("hexes");
    let found = hexes(&document);
    assert_eq!((document.linearized, found.positions.len()), (1, 8 + 1 + 7 + 1));
    assert_eq!(found.positions[8], points[8]);
    assert_eq!(
        found.hexes,
        [[8, 9, 10, 11, 12, 13, 14, 15], [0, 1, 2, 3, 4, 5, 6, 7]].map(|h| h.map(NodeId))
    );
    assert_eq!(check_hexes(found).iter().filter(|defect| defect.kind() == "unusedNode").count(), 1);
}

#[test]
fn element_types_of_abaqus_are_known_by_their_shape() {
    let mut text = String::from("*NODE\n");
    for (number, p) in (1..).zip(hex20(0.0)) {
        text += &format!("{number}, {}, {}, {}\n", p.x, p.y, p.z);
    }
    let numbers = |nodes: &[u32]| nodes.iter().map(u32::to_string).collect::<Vec<_>>().join(", ");
    let all: Vec<u32> = (1..=20).collect();
    for kind in ["C3D20", "C3D20R", "C3D20RH", "c3d20r", "DC3D20"] {
        let text = format!(
            "{text}*ELEMENT, TYPE={kind}, ELSET=block\n1, {},\n{}\n*ELEMENT, TYPE=S8R, ELSET=skin\n2, {}\n",
            numbers(&all[..15]),
            numbers(&all[15..]),
            numbers(&[1, 2, 6, 5, 9, 18, 13, 17])
        );
        let document = read(text.as_bytes(), Format::Inp).expect("a hex");
        let found = hexes(&document);
        assert_eq!((found.positions.len(), document.linearized, document.dropped_faces), (8, 1, 0), "{kind}");
        assert_eq!(document.tags.of(0).expect("a set").groups, [Group::from("block")]);
        assert_eq!(found.groups.tags().sets[0].groups, [Group::from("skin")]);
    }
}

#[test]
fn surfaces_of_the_second_order_are_refused() {
    let points = hex20(0.0);
    let quad: Vec<usize> = vec![0, 1, 2, 3, 8, 9, 10, 11];
    let refused = |text: &str, format: Format| read(text.as_bytes(), format).expect_err("no hexes");
    let error = refused(&vtk(&points, &[(&quad[..4], 9), (&quad, 23)]), Format::Vtk);
    assert_eq!(error.code, "unsupported-cell");
    assert!(error.message.starts_with("cell 1 (counted from 0) is a quad of second order; "), "{error}");
    let nodes: String = (1..=8).map(|n| format!("{n} {n} {} 0\n", n * n)).collect();
    let msh = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n{nodes}$EndNodes\n$Elements\n1\n1 16 2 0 0 1 2 3 4 5 6 7 8\n\
         $EndElements\n"
    );
    assert_eq!(refused(&msh, Format::Msh).code, "unsupported-cell");
    let inp = format!("*NODE\n{}*ELEMENT, TYPE=S8R\n1, 1, 2, 3, 4, 5, 6, 7, 8\n", nodes.replace(' ', ", "));
    let error = refused(&inp, Format::Inp);
    assert_eq!((error.code, error.line), ("unsupported-cell", Some(11)));
}

#[test]
fn nodes_beside_the_corners_are_looked_at() {
    let points = hex20(0.0);
    let mut hex: Vec<usize> = (0..20).collect();
    let refused =
        |hex: &[usize]| read(vtk(&points, &[(hex, 25)]).as_bytes(), Format::Vtk).expect_err("a mistake");
    assert_eq!(refused(&hex[..19]).code, "cell-size");
    hex[19] = 20;
    assert_eq!(refused(&hex).code, "node-out-of-range");
}
