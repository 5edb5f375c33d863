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

/// Of the nodes on faces any may be missing. An element ends where its line does without a comma, unless the next line has just
/// the nodes that are missing.
#[test]
fn elements_of_abaqus_may_lack_nodes_on_faces() {
    let places = |n: usize| Point::new((n % 3) as f64, (n / 3 % 3) as f64, (n / 9) as f64);
    let mut nodes = String::from("*NODE\n");
    for n in 0..27 {
        let p = places(n);
        nodes += &format!("{}, {}, {}, {}\n", n + 1, p.x, p.y, p.z);
    }
    // Corners, edges, the node inside, faces.
    const HEX: [u32; 27] =
        [1, 3, 9, 7, 19, 21, 27, 25, 2, 6, 8, 4, 20, 24, 26, 22, 10, 12, 18, 16, 14, 5, 23, 11, 15, 17, 13];
    let element = |number: u32, count: usize, breaks: &[usize], end: &str| {
        let mut text = number.to_string();
        for (place, node) in HEX[..count].iter().enumerate() {
            text += if breaks.contains(&place) { end } else { ", " };
            text += &node.to_string();
        }
        text + "\n"
    };
    let read_elements = |elements: &str| {
        let text = format!("{nodes}*ELEMENT, TYPE=C3D27R, ELSET=block\n{elements}*ELSET, ELSET=b\n1\n");
        read(text.as_bytes(), Format::Inp)
    };
    for count in 21..=27 {
        for (breaks, end) in [(vec![15], ",\n"), (vec![15], "\n"), (vec![8, 16, 20], ",\n"), (vec![], "")] {
            let again = element(1, count, &breaks, end) + &element(2, count, &breaks, end);
            let document = read_elements(&again).expect("two hexes");
            assert_eq!((document.linearized, hexes(&document).hexes.len()), (2, 2), "{count} {breaks:?}");
            // Nodes that the elements lack are of no cell, and stay.
            assert_eq!(hexes(&document).positions.len(), 8 + 27 - count, "{count} {breaks:?}");
            assert_eq!(hexes(&document).positions.last(), Some(&places(26)));
        }
    }
    let broken_late = element(1, 27, &[7, 15, 23], "\n") + &element(2, 27, &[7, 15, 23], "\n");
    assert_eq!(read_elements(&broken_late).expect("two hexes").linearized, 2);
    for count in [8, 20] {
        let error = read_elements(&element(1, count, &[15], ",\n")).expect_err("too few nodes");
        assert_eq!(error.code, "cell-size");
        assert!(error.message.ends_with(&format!("has {count} nodes; its type needs 21")), "{error}");
    }
    let error =
        read_elements(&element(1, 27, &[15], ",\n").replace("13\n", "13, 1\n")).expect_err("too many");
    assert!(error.message.contains("more than the 27 nodes"), "{error}");
    let all: Vec<usize> = (0..20).chain(20..26).collect();
    let points: Vec<Point> = (0..27).map(places).collect();
    let error = read(vtk(&points, &[(&all, 29)]).as_bytes(), Format::Vtk).expect_err("VTK has all of them");
    assert_eq!(error.code, "cell-size");
}

/// A hex of the second order with faces of it, as libMeshb numbers their nodes: corners, edges, faces, inside.
#[test]
fn hexes_of_the_second_order_in_medit_files_are_read_as_linear_ones() {
    let mut file = String::from("MeshVersionFormatted 2\nDimension 3\nVertices\n27\n");
    for n in 0..27 {
        file += &format!("{} {} {} 0\n", n % 3, n / 3 % 3, n / 9);
    }
    let hex = "HexahedraQ2\n1\n1 3 9 7 19 21 27 25 2 6 8 4 10 12 18 16 20 24 26 22 5 11 15 17 13 23 14 6\n";
    let quad = "QuadrilateralsQ2\n1\n1 3 9 7 2 6 8 4 5 4\n";
    let lines = "EdgesP2\n1\n1 3 2 8\n";
    let order = "HexahedraQ2Ordering\n8\n0 0 0\n2 0 0\n2 2 0\n0 2 0\n0 0 2\n2 0 2\n2 2 2\n0 2 2\n";
    let of = |parts: &[&str]| read((file.clone() + &parts.concat() + "End\n").as_bytes(), Format::Medit);
    for parts in [&[quad, lines, hex][..], &[hex, quad], &[order, quad, hex], &[hex, order, quad]] {
        let document = of(parts).expect("a hex");
        let found = hexes(&document);
        assert_eq!((document.linearized, document.dropped_faces, found.positions.len()), (1, 0, 8));
        assert_eq!(found.hexes, [[0, 1, 3, 2, 4, 5, 7, 6].map(NodeId)]);
        assert_eq!(found.positions[7], Point::splat(2.0));
        assert_eq!(document.tags.of(0).and_then(|set| set.number), Some(6));
        assert_eq!(found.groups.tags().sets[0].number, Some(4));
    }
    let refused = |parts: &[&str]| of(parts).expect_err("not read");
    assert_eq!(refused(&[quad]).code, "unsupported-cell");
    assert_eq!(refused(&[hex, &order.replace("0 0 2\n", "0 0 1\n")]).code, "unsupported-feature");
    assert_eq!(refused(&[hex, "HexahedraQ2Ordering\n1\n0 0 0\n"]).code, "unsupported-feature");
    assert_eq!(refused(&[hex, "QuadrilateralsQ2Ordering\n2\n0 0\n2 1\n"]).code, "unsupported-feature");
    assert_eq!(refused(&["HexahedraQ2\n99\n1 2 3\n"]).code, "truncated");
    assert_eq!(refused(&[&hex.replace("26 22", "26 28")]).code, "node-out-of-range");
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
