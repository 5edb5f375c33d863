//! What is wrong with a file is told by a code, the line and the words.

use hexmill::io::{AnyMesh, Format};
use hexmill::mesh::{Group, NodeId};

use super::round_trip::read;

/// Checks that a text is refused with a code, at a line, with these words in the message.
fn check(format: Format, text: &str, code: &str, line: Option<u64>, words: &str) {
    let error = read(text.as_bytes(), format).expect_err(text);
    assert_eq!((error.code, error.line), (code, line), "{error}\n{text}");
    assert!(error.to_string().contains(words), "{error}\n{text}");
}

#[test]
fn medit() {
    let check = |text: &str, code, line, words| check(Format::Medit, text, code, line, words);
    let head = "MeshVersionFormatted 2\nDimension 3\nVertices\n3\n0 0 0 0\n1 0 0 0\n0 1 0 0\n";
    check("", "not-this-format", Some(1), "MeshVersionFormatted");
    check("solid x\n", "not-this-format", Some(1), "begins with 'solid'");
    check("\u{1}\0\0\0\u{2}\0\0\0", "unsupported-encoding", None, ".meshb");
    check("MeshVersionFormatted 7\n", "unsupported-version", Some(1), "version 7");
    check("MeshVersionFormatted 2\nDimension 4\n", "syntax", Some(2), "dimension is 4");
    check("MeshVersionFormatted 2\nVertices\n9999999999\n0 0 0 0", "truncated", Some(3), "room for");
    check("MeshVersionFormatted 2\nVertices\n-1\n", "bad-number", Some(3), "cannot be negative");
    check("MeshVersionFormatted 2\nVertices\n1\n0 0 zero 0\n", "bad-number", Some(4), "'zero'");
    check("MeshVersionFormatted 2\nTriangles\n1\n1 2 3 0\n", "syntax", Some(3), "before the Vertices");
    check(head, "no-cells", None, "neither faces nor hexahedra");
    check(&format!("{head}Triangles\n1\n1 2 4 0\n"), "node-out-of-range", Some(10), "node 4");
    check(&format!("{head}Triangles\n2\n1 2 3 0\n1 2"), "truncated", Some(11), "cut short");
    check(&format!("{head}Triangles\n1\n0 1 2 0\n"), "node-out-of-range", Some(10), "numbered 1 to 3");
    check(&format!("{head}Tetrahedra\n1\n1 2 3 3 0\n"), "unsupported-cell", Some(9), "tetrahedra");
    check(&format!("{head}Triangles\n1\n1 2 3 0\nRidges\n1\n1\n"), "node-out-of-range", None, "0 edges");
    check(&format!("{head}Triangles\n1\n1 2 3 0\n{{}}\n"), "syntax", Some(11), "name of a section");
    let not_finite = format!("{}Triangles\n1\n1 2 3 0\n", head.replace("1 0 0 0", "inf 0 0 0"));
    check(&not_finite, "coordinate-not-finite", Some(6), "node 2 has a coordinate that is NaN");
}

#[test]
fn medit_takes_what_real_files_hold() {
    let text = "\u{feff}MeshVersionFormatted\n1\n# a comment\nDimension\n2\nVertices 4\n0 0 1 1. 0 1\n1.D0 1e+0 1\n0 1 1\n\
                RequiredVertices\n2\n1 2\nTangents\n1\n0.5 -.5\nQuadrilaterals 1\n1 2 3 4 -7 # last\nEnd\njunk";
    let document = read(text.as_bytes(), Format::Medit).unwrap();
    assert_eq!(document.tags.of(0).unwrap().number, Some(-7));
    let AnyMesh::Polygons(mesh) = document.mesh else { panic!("not a surface") };
    assert_eq!(mesh.positions[2].to_array(), [1.0, 1.0, 0.0]);
}

#[test]
fn vtk() {
    let check = |text: &str, code, line, words| check(Format::Vtk, text, code, line, words);
    let head = "# vtk DataFile Version 3.0\ntitle\nASCII\n";
    let grid = format!("{head}DATASET UNSTRUCTURED_GRID\nPOINTS 3 double\n0 0 0 1 0 0 0 1 0\n");
    check("", "not-this-format", Some(1), "# vtk DataFile Version");
    check("# vtk DataFile Version 3.0\ntitle\nBASE64\n", "syntax", Some(3), "ASCII or BINARY");
    check(&format!("{head}DATASET TABLE\n"), "unsupported-feature", Some(4), "'TABLE'");
    check(&format!("{grid}DATASET POLYDATA\n"), "syntax", Some(7), "second dataset");
    check(&format!("{head}POINTS 1000000000000 double\n0 0 0"), "truncated", Some(4), "room for");
    check(&format!("{head}POINTS 1 dozen\n0 0 0"), "syntax", Some(4), "'dozen'");
    check(&format!("{grid}CELLS 1 4\n3 0 1 2\nCELL_TYPES 1\n10\n"), "unsupported-cell", None, "tetrahedron");
    check(&format!("{grid}CELLS 1 4\n3 0 1 3\nCELL_TYPES 1\n5\n"), "node-out-of-range", None, "node 3");
    check(&format!("{grid}CELLS 1 4\n4 0 1 2\nCELL_TYPES 1\n9\n"), "inconsistent", Some(8), "ends before");
    check(&format!("{grid}CELLS 2 4\n3 0 1 2\nCELL_TYPES 1\n5\n"), "inconsistent", Some(8), "says it has 2");
    check(&format!("{grid}CELLS 1 4\n3 0 1 2\n"), "inconsistent", None, "0 cell types for 1 cells");
    check(&format!("{grid}CELLS 1 3\n2 0 1\nCELL_TYPES 1\n5\n"), "cell-size", None, "it needs 3");
    check(&format!("{grid}TRIANGLE_STRIPS 1 4\n3 0 1 2\n"), "unsupported-cell", Some(8), "strips");
    check(&format!("{grid}WHAT 1\n"), "syntax", Some(7), "'WHAT'");
    let offsets = "CELLS 2 3\nOFFSETS vtktypeint64\n1 3\nCONNECTIVITY vtktypeint64\n0 1 2\n";
    check(&format!("{grid}{offsets}"), "inconsistent", Some(11), "do not begin with 0");
    check(&format!("{head}POINTS 2 float\n0 0 0\n0 0 1e999\n"), "coordinate-not-finite", Some(6), "node 1");
}

#[test]
fn vtk_steps_over_what_says_nothing_of_the_mesh() {
    let text = "# vtk DataFile Version 4.2\nt\nASCII\nDATASET POLYDATA\nFIELD FieldData 1\nTIME 1 1 double\n0.5\n\
        POINTS 4 float\n0 0 0 1 0 0 1 1 0 0 1 0\nMETADATA\nINFORMATION 0\n\nLINES 1 3\n2 0 2\nPOLYGONS 1 5\n4 0 1 2 3\n\
        POINT_DATA 4\nNORMALS n float\n0 0 1 0 0 1 0 0 1 0 0 1\nSCALARS Tag int\nLOOKUP_TABLE t\n9 9 9 9\nLOOKUP_TABLE t 1\n\
        0 0 0 1\nCELL_DATA 2\nFIELD f 3\nnames 1 2 string\nfirst%20one\nsecond\nTag 1 2 int\n5 6\nLevel 1 2 unsigned_char\n1 2\n";
    let document = read(text.as_bytes(), Format::Vtk).unwrap();
    assert_eq!(document.tags.of(0).unwrap().number, Some(6));
    assert_eq!(document.level, [2]);
    let AnyMesh::Polygons(mesh) = document.mesh else { panic!("not a surface") };
    assert_eq!(mesh.features.polylines, [vec![NodeId(0), NodeId(2)]]);
}

#[test]
fn vtu() {
    let check = |text: &str, code, line, words| check(Format::Vtu, text, code, line, words);
    let file = |attributes: &str, inner: &str| {
        format!(
            "<VTKFile type=\"UnstructuredGrid\" {attributes}>\n<UnstructuredGrid>\n{inner}\n</UnstructuredGrid>\n</VTKFile>"
        )
    };
    let piece = |points: &str, connectivity: &str, offsets: &str, types: &str| {
        let array = |name: &str, kind: &str, text: &str| {
            format!(
                "<DataArray type=\"{kind}\" Name=\"{name}\" NumberOfComponents=\"{}\">{text}</DataArray>\n",
                if name == "p" { 3 } else { 1 }
            )
        };
        format!(
            "<Piece NumberOfPoints=\"3\" NumberOfCells=\"1\">\n<Points>\n{}</Points>\n<Cells>\n{}{}{}</Cells>\n</Piece>",
            array("p", "Float64", points),
            array("connectivity", "Int32", connectivity),
            array("offsets", "Int32", offsets),
            array("types", "UInt8", types)
        )
    };
    let points = "0 0 0 1 0 0 0 1 0";
    check("", "not-this-format", Some(1), "no VTKFile element");
    check("<html>", "not-this-format", Some(1), "'html'");
    check("<VTKFile type=\"PolyData\">", "unsupported-feature", Some(1), "'PolyData'");
    check("<VTKFile type=\"UnstructuredGrid\"><a></b>", "syntax", Some(1), "not well formed");
    check("<VTKFile type=\"UnstructuredGrid\">\n", "truncated", Some(2), "cut short");
    check(&file("header_type=\"UInt8\"", ""), "unsupported-encoding", Some(1), "UInt8");
    check(&file("compressor=\"vtkLZ4DataCompressor\"", ""), "unsupported-encoding", Some(1), "LZ4");
    check(&file("", ""), "no-cells", None, "");
    check(&file("", "<Piece NumberOfPoints=\"x\"/>"), "bad-number", Some(3), "NumberOfPoints is 'x'");
    check(&file("", "<Piece NumberOfPoints=\"1\"/>"), "bad-number", Some(3), "NumberOfCells is missing");
    check(
        &file("", &piece("0 0 0 1 0 0", "0 1 2", "3", "5")),
        "inconsistent",
        Some(5),
        "the array 'p' holds 6 numbers, but NumberOfPoints is 3, with 3 for each",
    );
    check(&file("", &piece("0 0 0\n1 0 O", "0 1 2", "3", "5")), "bad-number", Some(6), "'O'");
    let nan = file("", &piece("0 0 0\n1 0 0\n0 NaN 0", "0 1 2", "3", "5"));
    check(&nan, "coordinate-not-finite", Some(7), "node 2 has");
    check(&file("", &piece(points, "0 1 3", "3", "5")), "node-out-of-range", Some(8), "node 3");
    check(&file("", &piece(points, "0 1 2", "4", "5")), "inconsistent", None, "its offset is wrong");
    check(
        &file("", &piece(points, "0 1 2", "3 6", "5")),
        "inconsistent",
        Some(9),
        "'offsets' holds 2 numbers",
    );
    check(&file("", &piece(points, "0 1 2", "3", "13")), "unsupported-cell", None, "wedge");
    let appended = "<Piece NumberOfPoints=\"1\" NumberOfCells=\"0\"><Points>\n\
        <DataArray type=\"Float32\" Name=\"p\" NumberOfComponents=\"3\" format=\"appended\" offset=\"0\"/></Points></Piece>";
    check(&file("", appended), "truncated", Some(4), "no appended data");
    let binary = appended.replace("appended", "binary").replace("/></P", ">AAA!AAAA</DataArray></P");
    check(&file("", &binary), "syntax", Some(4), "not base64");
}

#[test]
fn vtu_pieces_are_put_together() {
    let piece = |tag: u32| {
        format!(
            "<Piece NumberOfPoints=\"3\" NumberOfCells=\"1\"><Points><DataArray type=\"Float32\" NumberOfComponents=\"3\">\
             {tag} 0 0 1 0 0 0 1 0</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\">0 1 2</DataArray>\
             <DataArray type=\"Int64\" Name=\"offsets\">3</DataArray><DataArray type=\"UInt8\" Name=\"types\">5</DataArray></Cells>\
             <CellData><DataArray type=\"Float32\" Name=\"Tag\">{tag}</DataArray></CellData></Piece>"
        )
    };
    let file = format!(
        "<?xml version=\"1.0\"?><VTKFile type=\"UnstructuredGrid\"><UnstructuredGrid>{}{}</UnstructuredGrid></VTKFile>",
        piece(7),
        piece(8)
    );
    let document = read(file.as_bytes(), Format::Vtu).unwrap();
    let AnyMesh::Polygons(mesh) = &document.mesh else { panic!("not a surface") };
    assert_eq!(mesh.face(1), [3, 4, 5].map(NodeId));
    assert_eq!([0, 1].map(|face| document.tags.of(face).unwrap().number), [Some(7), Some(8)]);
}

#[test]
fn msh() {
    let check = |text: &str, code, line, words| check(Format::Msh, text, code, line, words);
    let head = |version: &str| format!("$MeshFormat\n{version} 0 8\n$EndMeshFormat\n");
    let nodes = "$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n";
    check("", "not-this-format", Some(1), "empty");
    check("$NOD\n1\n", "not-this-format", Some(1), "version 1");
    check("# vtk", "not-this-format", Some(1), "$MeshFormat");
    check(&head("4.0"), "unsupported-version", Some(2), "'4.0'");
    check(&head("3"), "unsupported-version", Some(2), "4.1 or 2.2");
    check("$MeshFormat\n4.1 1 16\n", "unsupported-encoding", Some(2), "data size 16");
    check("$MeshFormat\n4.1 0 8\n$Nodes\n", "syntax", Some(3), "$EndMeshFormat");
    check(&format!("{}$Nodes\n3\n1 0 0 0\n$EndNodes\n", head("2.2")), "bad-number", Some(7), "'$EndNodes'");
    check(&format!("{}$Nodes\n500000000000\n", head("2.2")), "truncated", Some(5), "room for");
    check(&format!("{}{nodes}", head("2.2")), "no-cells", None, "");
    let element = |element: &str| format!("{}{nodes}$Elements\n1\n{element}\n$EndElements\n", head("2.2"));
    check(&element("1 2 2 0 0 1 2 4"), "node-out-of-range", None, "element 1 names node 4");
    check(&element("1 4 2 0 0 1 2 3 3"), "unsupported-cell", Some(12), "tetrahedron (Gmsh type 4)");
    check(&element("1 9 2 0 0 1 2 3 1 2 3"), "unsupported-cell", Some(12), "has an element of second order");
    let nan = |version: &str, nodes: &str| format!("{}$Nodes\n{nodes}\n$EndNodes\n", head(version));
    let first = nan("2.2", "2\n7 0 0 0\n9 0 nan 0");
    check(&first, "coordinate-not-finite", Some(7), "node 9 has a coordinate");
    let second = nan("4.1", "1 2 1 2\n3 1 0 2\n7\n9\n0 0 0\n0 -inf 0");
    check(&second, "coordinate-not-finite", Some(10), "node 9 has a coordinate");
    check(&element("1 2 2 0 0 1 2"), "bad-number", Some(13), "'$EndElements'");
    let twice = nodes.replace("\n2 1", "\n1 1");
    check(&format!("{}{twice}", head("2.2")), "duplicate-number", Some(7), "node 1 comes twice");
    let names = "$PhysicalNames\n1\n2 1 wing\n$EndPhysicalNames\n";
    check(&format!("{}{names}", head("4.1")), "syntax", Some(7), "double quotes");
}

#[test]
fn msh_keeps_several_groups_of_an_entity_and_skips_other_sections() {
    let text = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Comments\nanything $Nodes\n$EndComments\n\
        $PhysicalNames\n2\n2 7 \"wing\"\n2 8 \"upper side\"\n$EndPhysicalNames\n\
        $Entities\n1 0 2 0\n1 0 0 0 0\n5 0 0 0 1 1 0 3 7 -8 9 0\n6 0 0 0 1 1 0 0 2 1 -1\n$EndEntities\n\
        $Nodes\n2 4 10 40\n0 1 0 1\n40\n0 1 0\n2 5 1 3\n10\n20\n30\n0 0 0 0.5 0.5\n1 0 0 .5 .5\n1 1 0 .5 .5\n$EndNodes\n\
        $Elements\n3 3 1 9\n0 1 15 1\n1 40\n2 6 2 1\n9 10 20 30\n2 5 3 1\n4 10 20 30 40\n$EndElements\n\
        $Periodic\n0\n$EndPeriodic\n";
    let document = read(text.as_bytes(), Format::Msh).unwrap();
    let AnyMesh::Polygons(mesh) = &document.mesh else { panic!("not a surface") };
    // Element 4 comes before element 9.
    assert_eq!(mesh.face(0), [1, 2, 3, 0].map(NodeId));
    assert_eq!(mesh.positions[2].to_array(), [1.0, 0.0, 0.0]);
    let set = document.tags.of(0).unwrap();
    assert_eq!(
        (set.groups.as_slice(), set.number),
        (&[Group::new("wing", 7), Group::new("upper side", 8), Group::new("", 9)][..], Some(7))
    );
    assert!(document.tags.of(1).unwrap().groups.is_empty());
}

#[test]
fn inp() {
    let check = |text: &str, code, line, words| check(Format::Inp, text, code, line, words);
    let nodes = "*NODE\n1, 0, 0\n2, 1, 0\n3, 0, 1\n";
    check("", "not-this-format", Some(1), "neither *NODE nor *ELEMENT");
    check("*HEADING\nhello\n", "not-this-format", Some(1), "neither");
    check("*NODE\n1, 0, x, 0\n", "bad-number", Some(2), "'x'");
    check("*NODE\n1, 0, 0, 0\n7, 0, nan, 0\n", "coordinate-not-finite", Some(3), "node 7 has");
    check("*NODE\n1, 0, 0\n1, 1, 0\n", "duplicate-number", Some(3), "node 1 comes twice");
    check("*NODE, INPUT=mesh.txt\n", "unsupported-feature", Some(1), "another file");
    check("*NODE, SYSTEM=C\n1, 1, 90\n", "unsupported-feature", Some(1), "cylindrical");
    check("*INCLUDE, INPUT=mesh.inp\n", "unsupported-feature", Some(1), "*INCLUDE");
    check("*NODE\n1\n*NGEN\n1, 5, 1\n", "unsupported-feature", Some(3), "*NGEN");
    check(nodes, "no-cells", None, "");
    check(&format!("{nodes}*ELEMENT\n1, 1, 2, 3\n"), "syntax", Some(5), "lacks its parameter TYPE");
    check(
        &format!("{nodes}*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 3\n"),
        "unsupported-cell",
        Some(5),
        "'C3D4' is a tetrahedron",
    );
    check(
        &format!("{nodes}*ELEMENT, TYPE=C3D10\n"),
        "unsupported-cell",
        Some(5),
        "is an element of second order",
    );
    check(&format!("{nodes}*ELEMENT, TYPE=U17\n"), "unsupported-cell", Some(5), "unknown");
    check(&format!("{nodes}*ELEMENT, TYPE=S3\n1, 1, 2, 4\n"), "node-out-of-range", Some(6), "node 4");
    check(&format!("{nodes}*ELEMENT, TYPE=S3\n1, 1, 2\n*END\n"), "cell-size", Some(6), "has 2 nodes");
    check(
        &format!("{nodes}*ELEMENT, TYPE=S3\n1, 1, 2, 3, 1\n"),
        "cell-size",
        Some(6),
        "more than the 3 nodes",
    );
    let element = format!("{nodes}*ELEMENT, TYPE=S3\n1, 1, 2, 3\n");
    check(&format!("{element}1, 3, 2, 1\n"), "duplicate-number", Some(7), "element 1");
    check(&format!("{element}*ELSET, ELSET=A\nB\n"), "inconsistent", Some(8), "'B'");
    check(&format!("{element}*ELSET, ELSET=A, GENERATE\n1, 5, 0\n"), "syntax", Some(8), "step above 0");
    check(&format!("{element}*ELSET, ELSET=A, INSTANCE=I\n1\n"), "inconsistent", Some(7), "instance 'I'");
    check(&format!("{element}*INSTANCE, NAME=I, PART=P\n"), "inconsistent", Some(7), "part 'P'");
}

#[test]
fn inp_takes_what_real_decks_hold() {
    let text = "** made by hand\n*Heading\nsome words\n*node, nset = all\n 1, 0., 0.\n2, 1.D0, 0.,\n\n3, 1., 1.\n4, 0., 1.\n\
        5, 2., 0.\n6, 2., 1.\n** a comment\n*Element, type=S4R,\nelset=Shell\n10, 1, 2,\n3, 4\n*ELEMENT,TYPE=CPS3\n7, 2, 5, 6\n\
        *ELEMENT, TYPE=T3D2\n99, 1, 2\n*Elset, elset=\"Both\", generate\n1, 20\n*ELSET, ELSET=shell\n7\n*ELSET, ELSET=deep\nboth, 99\n\
        *MATERIAL, NAME=STEEL\n*ELASTIC\n210000., 0.3\n";
    let document = read(text.as_bytes(), Format::Inp).unwrap();
    let AnyMesh::Polygons(mesh) = &document.mesh else { panic!("not a surface") };
    // Element 7 comes before element 10.
    assert_eq!((mesh.face(0), mesh.face(1)), (&[1, 4, 5].map(NodeId)[..], &[0, 1, 2, 3].map(NodeId)[..]));
    for face in 0..2 {
        assert_eq!(document.tags.of(face).unwrap().groups, ["Shell", "Both", "deep"].map(Group::from));
    }
}

#[test]
fn inp_instances_are_moved_and_turned() {
    let text = "*PART, NAME=Plate\n*NODE\n1, 0, 0, 0\n2, 1, 0, 0\n3, 0, 1, 0\n*ELEMENT, TYPE=S3, ELSET=Face\n1, 1, 2, 3\n*END PART\n\
        *ASSEMBLY, NAME=A\n*INSTANCE, NAME=First, PART=plate\n*END INSTANCE\n*INSTANCE, NAME=Second, PART=PLATE\n0., 0., 5.\n\
        0., 0., 0., 0., 0., 1., 90.\n*END INSTANCE\n*NODE\n1, 9, 9, 9\n*ELSET, ELSET=Top, INSTANCE=Second\n1\n*END ASSEMBLY\n";
    let document = read(text.as_bytes(), Format::Inp).unwrap();
    let AnyMesh::Polygons(mesh) = &document.mesh else { panic!("not a surface") };
    assert_eq!((mesh.positions.len(), mesh.face_count()), (6, 2));
    assert!((mesh.positions[4] - hexmill::geometry::Point::new(0.0, 1.0, 5.0)).length() < 1e-15);
    assert_eq!(document.tags.of(0).unwrap().groups, ["Face"].map(Group::from));
    assert_eq!(document.tags.of(1).unwrap().groups, ["Face", "Top"].map(Group::from));
}

#[test]
fn inp_sets_that_name_each_other_stay_small() {
    let mut text = String::from(
        "*NODE\n1, 0, 0\n2, 1, 0\n3, 0, 1\n*ELEMENT, TYPE=S3\n1, 1, 2, 3\n*ELSET, ELSET=A\n1\n*ELSET, ELSET=A\n",
    );
    text.push_str(&"A, A, A, A\n".repeat(100));
    assert_eq!(
        read(text.as_bytes(), Format::Inp).unwrap().tags.of(0).unwrap().groups,
        ["A"].map(Group::from)
    );
}
