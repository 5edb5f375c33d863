//! Whole small files, so that no change of the bytes goes unseen.

use hexmill::geometry::Point;
use hexmill::io::{AnyMesh, Document, inp, medit, msh, vtk, vtu};
use hexmill::mesh::{NodeId, QuadMesh, TagSet, Tags};

use super::worlds::document;

/// Two quads side by side, one in the group `left` and one in none.
fn two_quads() -> Document {
    let mesh = QuadMesh {
        positions: [[0.0, 0.0], [0.5, 0.0], [1e-7, 1.0], [0.5, 1.0], [1.0 / 3.0, 0.0], [1e21, 1.0]]
            .map(|[x, y]| Point::new(x, y, 0.0))
            .to_vec(),
        quads: vec![[0, 1, 3, 2].map(NodeId), [1, 4, 5, 3].map(NodeId)],
    };
    let left = TagSet { groups: vec!["left".into()], number: Some(3), ..TagSet::default() };
    let mut document = document(AnyMesh::Quads(mesh), vec![]);
    document.tags = Tags { sets: vec![left, TagSet::default()], of_element: vec![0, 1] };
    document
}

fn check(found: Vec<u8>, expected: &str) {
    assert_eq!(String::from_utf8(found).unwrap(), expected);
}

#[test]
fn vtk_file() {
    check(
        vtk::write(&two_quads()).unwrap(),
        "# vtk DataFile Version 3.0\nhexmill\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 6 double\n0.0 0.0 0.0\n0.5 0.0 0.0\n\
         1e-7 1.0 0.0\n0.5 1.0 0.0\n0.3333333333333333 0.0 0.0\n1e+21 1.0 0.0\nCELLS 2 10\n4 0 1 3 2\n4 1 4 5 3\n\
         CELL_TYPES 2\n9\n9\nCELL_DATA 2\nSCALARS Level int 1\nLOOKUP_TABLE default\n0\n1\nSCALARS Parent unsigned_int 1\n\
         LOOKUP_TABLE default\n0\n0\nSCALARS Tag int 1\nLOOKUP_TABLE default\n3\n0\n",
    );
}

#[test]
fn msh_file() {
    check(
        msh::write(&two_quads()).unwrap(),
        "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"untagged\"\n2 3 \"left\"\n$EndPhysicalNames\n\
         $Entities\n0 0 2 0\n1 0.0 0.0 0.0 1e+21 1.0 0.0 1 3 0\n2 0.0 0.0 0.0 1e+21 1.0 0.0 1 1 0\n$EndEntities\n\
         $Nodes\n1 6 1 6\n2 1 0 6\n1\n2\n3\n4\n5\n6\n0.0 0.0 0.0\n0.5 0.0 0.0\n1e-7 1.0 0.0\n0.5 1.0 0.0\n\
         0.3333333333333333 0.0 0.0\n1e+21 1.0 0.0\n$EndNodes\n$Elements\n2 2 1 2\n2 1 3 1\n1 1 2 4 3\n2 2 3 1\n2 2 5 6 4\n\
         $EndElements\n",
    );
}

#[test]
fn inp_file() {
    let mut quads = two_quads();
    if let AnyMesh::Quads(mesh) = &mut quads.mesh {
        mesh.positions[0].z = -1.234_567_890_123_456_7e-300;
    }
    check(
        inp::write(&quads).unwrap(),
        "*HEADING\nhexmill\n*NODE\n1, 0.0, 0.0, -1.234567890123e-300\n2, 0.5, 0.0, 0.0\n3, 1e-7, 1.0, 0.0\n4, 0.5, 1.0, 0.0\n\
         5, 0.3333333333333333, 0.0, 0.0\n6, 1e+21, 1.0, 0.0\n*ELEMENT, TYPE=S4\n1, 1, 2, 4, 3\n2, 2, 5, 6, 4\n\
         *ELSET, ELSET=left\n1\n*ELSET, ELSET=TAG_3\n1\n",
    );
}

#[test]
fn medit_file() {
    check(
        medit::write(&two_quads()).unwrap(),
        "MeshVersionFormatted 2\nDimension 3\n# reference 3: left\n\nVertices\n6\n0.0 0.0 0.0 0\n0.5 0.0 0.0 0\n\
         1e-7 1.0 0.0 0\n0.5 1.0 0.0 0\n0.3333333333333333 0.0 0.0 0\n1e+21 1.0 0.0 0\n\nQuadrilaterals\n2\n1 2 4 3 3\n\
         2 5 6 4 0\n\nEnd\n",
    );
}

#[test]
fn vtu_head() {
    let bytes = vtu::write(&two_quads()).unwrap();
    let head = "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" \
        header_type=\"UInt64\" compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n<FieldData>\n\
        <DataArray type=\"UInt8\" Name=\"TagNames\" NumberOfTuples=\"32\" format=\"appended\" offset=\"0\"/>\n</FieldData>\n\
        <Piece NumberOfPoints=\"6\" NumberOfCells=\"2\">\n<Points>\n";
    assert_eq!(String::from_utf8_lossy(&bytes[..head.len()]), head);
    assert!(bytes.ends_with(b"\n</AppendedData>\n</VTKFile>\n"));
}

#[test]
fn sets_of_an_input_deck_have_sixteen_elements_a_line() {
    let set = TagSet { groups: vec!["Wing".into()], ..TagSet::default() };
    let other = TagSet { groups: vec!["WING".into(), "2nd part".into()], ..TagSet::default() };
    let bytes = inp::write(&document(AnyMesh::Quads(super::worlds::quad_grid(6)), vec![set, other])).unwrap();
    let text = String::from_utf8(bytes).unwrap();
    let sets = "*ELSET, ELSET=Wing\n1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31\n33, 35\n*ELSET, ELSET=WING_2\n";
    assert!(text.contains(sets), "{text}");
    assert!(text.contains("*ELSET, ELSET=_2nd_part\n2, 4, "), "{text}");
}
