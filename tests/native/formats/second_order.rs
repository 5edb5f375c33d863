//! Hexes of the second order: every format has its own order of their nodes, told here by the corners between which
//! each stands, as the formats' documents have it.

use hexmill::geometry::{Aabb, Point};
use hexmill::io::{Document, Format, write};
use hexmill::mesh::{FaceGroups, GridOptions, HexMesh, SecondOrder, SecondOrderHex, TagSet, Tags, hex_grid};

/// The corners around each node on an edge, then on a face.
struct Order {
    edges: [[usize; 2]; 12],
    faces: [[usize; 4]; 6],
    /// Which of the nodes after those on edges is inside.
    inside: usize,
}

const VTK: Order = Order {
    edges: [[0, 1], [1, 2], [2, 3], [3, 0], [4, 5], [5, 6], [6, 7], [7, 4], [0, 4], [1, 5], [2, 6], [3, 7]],
    faces: [[0, 3, 7, 4], [1, 2, 6, 5], [0, 1, 5, 4], [3, 2, 6, 7], [0, 1, 2, 3], [4, 5, 6, 7]],
    inside: 6,
};

const GMSH: Order = Order {
    edges: [[0, 1], [0, 3], [0, 4], [1, 2], [1, 5], [2, 3], [2, 6], [3, 7], [4, 5], [4, 7], [5, 6], [6, 7]],
    faces: [[0, 3, 2, 1], [0, 1, 5, 4], [0, 4, 7, 3], [1, 2, 6, 5], [2, 3, 7, 6], [4, 5, 6, 7]],
    inside: 6,
};

const ABAQUS: Order = Order {
    edges: VTK.edges,
    faces: [[0, 1, 2, 3], [4, 7, 6, 5], [0, 4, 5, 1], [1, 5, 6, 2], [2, 6, 7, 3], [3, 7, 4, 0]],
    inside: 0,
};

/// Two hexes side by side, no two nodes of which are alike, the first's first face in a group.
pub fn mesh() -> HexMesh {
    let bounds = Aabb { min: Point::ZERO, max: Point::new(4.0, 2.0, 2.0) };
    let options = GridOptions { spacing: 2.0, margin: 0.0, fitted: false, max_hexes: 10 };
    let mut mesh = hex_grid(bounds, &options).expect("a grid");
    let bottom = TagSet { groups: vec!["bottom".into()], ..TagSet::default() };
    let tags = Tags { sets: vec![bottom], of_element: vec![0] };
    mesh.groups = FaceGroups::new(vec![0], tags).expect("one side");
    mesh
}

pub fn document(hex: SecondOrderHex) -> Document {
    let mesh = mesh();
    let second_order = Some(SecondOrder::straight(&mesh, hex));
    Document { second_order, ..Document::from(mesh) }
}

/// Checks that the nodes of a hex stand where they belong.
fn expect_order(nodes: &[Point], order: &Order, what: &str) {
    let mean = |of: &[usize]| of.iter().map(|&c| nodes[c]).sum::<Point>() / of.len() as f64;
    let mut wanted: Vec<Point> = nodes[..8].to_vec();
    wanted.extend(order.edges.iter().map(|edge| mean(edge)));
    if nodes.len() == 27 {
        let mut rest: Vec<Point> = order.faces.iter().map(|face| mean(face)).collect();
        rest.insert(order.inside, mean(&[0, 1, 2, 3, 4, 5, 6, 7]));
        wanted.extend(rest);
    }
    assert_eq!(nodes, wanted, "{what}");
}

/// The numbers of a line that are written with blanks or commas between them.
fn numbers(line: &str) -> Vec<f64> {
    let words = line.split([' ', ',']).filter(|word| !word.is_empty());
    words.map(|word| word.parse().expect("a number")).collect()
}

/// The text of a document in a format.
fn text(hex: SecondOrderHex, format: Format) -> String {
    String::from_utf8(write(&document(hex), format).expect("the format takes it")).expect("text")
}

pub const KINDS: [(SecondOrderHex, usize); 2] = [(SecondOrderHex::Hex20, 20), (SecondOrderHex::Hex27, 27)];

#[test]
fn legacy_vtk_has_vtks_order() {
    for ((hex, size), types) in KINDS.into_iter().zip([["25", "25", "23"], ["29", "29", "28"]]) {
        let file = text(hex, Format::Vtk);
        let lines: Vec<&str> = file.lines().collect();
        let start = |word: &str| 1 + lines.iter().position(|line| line.starts_with(word)).expect("a section");
        let (points, cells, kinds) = (start("POINTS"), start("CELLS"), start("CELL_TYPES"));
        let point = |node: f64| Point::from_slice(&numbers(lines[points + node as usize]));
        for line in &lines[cells..cells + 2] {
            let numbers = numbers(line);
            assert_eq!((numbers[0], numbers.len()), (size as f64, size + 1));
            expect_order(&numbers[1..].iter().map(|&node| point(node)).collect::<Vec<_>>(), &VTK, "VTK");
        }
        assert_eq!(lines[kinds..kinds + 3], types, "two hexes and a face in a group");
        // The nodes of the face: corners, edges in turn, the middle.
        let face: Vec<Point> = numbers(lines[cells + 2])[1..].iter().map(|&node| point(node)).collect();
        for k in 0..4 {
            assert_eq!(face[4 + k], face[k].midpoint(face[(k + 1) % 4]));
        }
        assert!(face.iter().all(|p| p.z == 0.0) && face.len() == if size == 20 { 8 } else { 9 });
    }
}

#[test]
fn msh_has_gmshs_order() {
    for ((hex, size), kind) in KINDS.into_iter().zip(["17", "12"]) {
        let file = text(hex, Format::Msh);
        let lines: Vec<&str> = file.lines().collect();
        let at = |word: &str| lines.iter().position(|line| *line == word).expect("a section");
        let nodes = at("$Nodes") + 2;
        let count = numbers(lines[nodes])[3] as usize;
        let point = |node: f64| Point::from_slice(&numbers(lines[nodes + count + node as usize]));
        let mut found = 0;
        for (k, line) in lines.iter().enumerate().skip(at("$Elements") + 2) {
            let numbers_of = numbers(if line.starts_with('$') { "" } else { line });
            if numbers_of.len() == size + 1 {
                let nodes: Vec<Point> = numbers_of[1..].iter().map(|&node| point(node)).collect();
                expect_order(&nodes, &GMSH, "Gmsh");
                found += 1;
            }
            if numbers_of.len() == 4 && numbers_of[0] == 3.0 {
                assert_eq!(lines[k].split(' ').nth(2), Some(kind));
            }
        }
        assert_eq!(found, 2);
    }
}

#[test]
fn inp_has_abaqus_order() {
    for ((hex, size), kind) in KINDS.into_iter().zip(["C3D20", "C3D27"]) {
        let file = text(hex, Format::Inp);
        // A line that ends with a comma goes on.
        let file = file.replace(",\n", ", ");
        let mut lines = file.lines().skip_while(|line| *line != "*NODE").skip(1);
        let points: Vec<Point> = lines
            .by_ref()
            .map_while(|line| (!line.starts_with('*')).then(|| numbers(line)))
            .map(|n| Point::from_slice(&n[1..]))
            .collect();
        assert!(file.contains(&format!("*ELEMENT, TYPE={kind}\n")));
        let elements: Vec<Vec<f64>> =
            lines.map_while(|line| (!line.starts_with('*')).then(|| numbers(line))).collect();
        assert_eq!(elements.len(), 2);
        for element in elements {
            assert_eq!(element.len(), size + 1);
            let nodes: Vec<Point> = element[1..].iter().map(|&node| points[node as usize - 1]).collect();
            expect_order(&nodes, &ABAQUS, "Abaqus");
        }
    }
    let longest = text(SecondOrderHex::Hex27, Format::Inp).lines().map(|line| line.split(',').count()).max();
    assert!(longest <= Some(17), "16 numbers a line, and a comma");
}

#[test]
fn vtu_takes_them_glb_draws_them_and_medit_refuses() {
    for (hex, size) in KINDS {
        let vtu = write(&document(hex), Format::Vtu).expect("VTU takes them");
        let head = String::from_utf8_lossy(&vtu);
        let nodes = 12 + 20 + if size == 27 { 11 + 2 } else { 0 };
        assert!(head.contains(&format!("NumberOfPoints=\"{nodes}\" NumberOfCells=\"3\"")));
        let straight = Document { second_order: None, ..document(hex) };
        assert_eq!(write(&document(hex), Format::Glb), write(&straight, Format::Glb));
        let error = write(&document(hex), Format::Medit).unwrap_err();
        assert_eq!(error.code(), "format-holds-no-second-order");
    }
}
