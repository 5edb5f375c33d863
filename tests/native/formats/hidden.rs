//! Cells that VTK's files hide, or have of another piece, and arrays that are of other cells.

use hexmill::io::{AnyMesh, Document, Format, ReadError};

use super::round_trip::read;

/// Each dataset with the same eight cells in two layers of four; the last with faces alone.
fn datasets() -> Vec<String> {
    let place = |n: usize| format!("{} {} {} ", n % 3, n / 3 % 3, n / 9);
    let points: String = (0..27).map(place).collect();
    let hex = |n: usize| {
        let first = n % 2 + n / 2 % 2 * 3 + n / 4 * 9;
        [0, 1, 4, 3, 9, 10, 13, 12].map(|step| (first + step).to_string()).join(" ")
    };
    let hexes: String = (0..8).map(|n| format!("8 {}\n", hex(n))).collect();
    let flat: String = (0..15).map(|n| format!("{} {} 0 ", n % 5, n / 5)).collect();
    let quad = |n: usize| [0, 1, 6, 5].map(|step| (n % 4 + n / 4 * 5 + step).to_string()).join(" ");
    let quads: String = (0..8).map(|n| format!("4 {}\n", quad(n))).collect();
    vec![
        "STRUCTURED_POINTS\nDIMENSIONS 3 3 3\n".to_owned(),
        "RECTILINEAR_GRID\nDIMENSIONS 3 3 3\nX_COORDINATES 3 float\n0 1 2\nY_COORDINATES 3 float\n0 1 2\n\
         Z_COORDINATES 3 float\n0 1 2\n"
            .to_owned(),
        format!("STRUCTURED_GRID\nDIMENSIONS 3 3 3\nPOINTS 27 float\n{points}\n"),
        format!(
            "UNSTRUCTURED_GRID\nPOINTS 27 float\n{points}\nCELLS 8 72\n{hexes}CELL_TYPES 8\n{}\n",
            "12 ".repeat(8)
        ),
        "STRUCTURED_POINTS\nDIMENSIONS 5 3 1\n".to_owned(),
        format!("POLYDATA\nPOINTS 15 float\n{flat}\nPOLYGONS 8 40\n{quads}"),
    ]
}

fn legacy(dataset: &str, cell_data: &str) -> Result<Document, ReadError> {
    let text = format!("# vtk DataFile Version 3.0\nt\nASCII\nDATASET {dataset}{cell_data}");
    read(text.as_bytes(), Format::Vtk)
}

/// The numbers of the cells' tags.
fn numbers(document: &Document) -> Vec<i64> {
    let number = |cell| document.tags.of(cell).and_then(|set| set.number).expect("a number");
    (0..document.mesh.cell_count()).map(number).collect()
}

#[test]
fn cells_that_are_hidden_or_of_another_piece_are_left_out() {
    for dataset in datasets() {
        let cells = |arrays: &str| {
            let data = format!("CELL_DATA 8\nFIELD f 2\n{arrays}\nTag 1 8 int\n1 2 3 4 5 6 7 8\n");
            legacy(&dataset, &data)
        };
        let whole = cells("vtkGhostType 1 8 unsigned_char\n0 2 4 8 16 0 0 0").expect("cells");
        assert_eq!((numbers(&whole).len(), whole.hidden), (8, 0), "{dataset}");
        assert!(whole.dropped_arrays.is_empty(), "{:?}", whole.dropped_arrays);
        for ghosts in
            ["vtkGhostType 1 8 unsigned_char\n0 32 0 0 1 0 35 2", "vtkGhostLevels 1 8 int\n0 1 0 0 2 0 1 0"]
        {
            let document = cells(ghosts).expect("cells");
            assert_eq!(numbers(&document), [1, 3, 4, 6, 8], "{dataset}");
            assert_eq!(document.hidden, 3);
            assert!(document.dropped_arrays.is_empty(), "{:?}", document.dropped_arrays);
            // Nodes that no cell uses stay, as those of any file do.
            assert_eq!(document.mesh.positions(), whole.mesh.positions(), "{dataset}");
        }
        let error = cells("vtkGhostType 1 8 unsigned_char\n32 1 32 1 32 33 32 1").expect_err("no cells");
        assert_eq!(error.code, "no-cells");
        assert!(error.message.contains("are hidden or of another piece"), "{error}");
        // What is no array of whole numbers, one a cell, says nothing of cells.
        let document = cells("vtkGhostType 1 8 float\n0.5 1 1 1 1 1 1 1").expect("cells");
        assert_eq!((document.hidden, document.dropped_arrays), (0, vec!["vtkGhostType".to_owned()]));
    }
}

/// A face of a hidden hex is a face of no hex; where all hexes are hidden, faces make a surface.
#[test]
fn hidden_hexes_have_no_faces() {
    let points: String = (0..12).map(|n| format!("{} {} {} ", n % 3, n / 3 % 2, n / 6)).collect();
    let dataset = format!(
        "UNSTRUCTURED_GRID\nPOINTS 12 float\n{points}\nCELLS 4 28\n8 0 1 4 3 6 7 10 9\n8 1 2 5 4 7 8 11 10\n4 0 3 9 6\n\
         4 2 8 11 5\nCELL_TYPES 4\n12 12 9 9\n"
    );
    let of = |ghosts: &str| {
        let data = format!(
            "CELL_DATA 4\nSCALARS Tag int\nLOOKUP_TABLE default\n1 1 7 8\nSCALARS vtkGhostType \
                            unsigned_char\nLOOKUP_TABLE default\n{ghosts}\n"
        );
        legacy(&dataset, &data).expect("cells")
    };
    let document = of("32 0 0 0");
    let AnyMesh::Hexes(mesh) = &document.mesh else { panic!("not hexes") };
    assert_eq!((mesh.hexes.len(), mesh.groups.sides().len()), (1, 1));
    assert_eq!((document.hidden, document.dropped_faces), (1, 1));
    assert_eq!(document.dropped_groups, ["7"]);
    let document = of("32 32 0 0");
    assert!(matches!(document.mesh, AnyMesh::Polygons(_)));
    assert_eq!((numbers(&document), document.hidden), (vec![7, 8], 2));
}

#[test]
fn pieces_hide_cells_of_their_own() {
    let array = |name: &str, kind: &str, each: u32, values: &str| {
        format!(
            "<DataArray Name=\"{name}\" type=\"{kind}\" NumberOfComponents=\"{each}\">{values}</DataArray>"
        )
    };
    let piece = |ghosts: Option<&str>, tags: &str| {
        let ghosts = ghosts.map_or(String::new(), |values| array("vtkGhostType", "UInt8", 1, values));
        format!(
            "<Piece NumberOfPoints=\"6\" NumberOfCells=\"2\"><CellData>{}{ghosts}</CellData><Points>{}</Points>\
             <Cells>{}{}{}</Cells></Piece>",
            array("Tag", "Int32", 1, tags),
            array("Points", "Float64", 3, "0 0 0 1 0 0 2 0 0 0 1 0 1 1 0 2 1 0"),
            array("connectivity", "Int64", 1, "0 1 4 3 1 2 5 4"),
            array("offsets", "Int64", 1, "4 8"),
            array("types", "UInt8", 1, "9 9"),
        )
    };
    let of = |pieces: &[String]| {
        let text = format!(
            "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid>{}</UnstructuredGrid></VTKFile>",
            pieces.concat()
        );
        read(text.as_bytes(), Format::Vtu)
    };
    let pieces =
        [piece(None, "1 2"), piece(Some("32 0"), "3 4"), piece(None, "5 6"), piece(Some("0 1"), "7 8")];
    let document = of(&pieces).expect("quads");
    assert_eq!((numbers(&document), document.hidden), (vec![1, 2, 4, 5, 6, 7], 2));
    assert!(document.dropped_arrays.is_empty(), "{:?}", document.dropped_arrays);
    assert_eq!(of(&[piece(Some("1 1"), "1 2")]).expect_err("no cells").code, "no-cells");
    let error = of(&[piece(Some("1 1 1"), "1 2")]).expect_err("another length");
    assert_eq!((error.code, error.line), ("inconsistent", Some(1)));
}

/// As VTU, whose arrays have to be as long as their piece says.
#[test]
fn arrays_of_another_length_than_the_cells_are_refused() {
    for dataset in datasets() {
        let before = 4 + dataset.lines().count() as u64;
        for (data, line, words) in [
            (
                "CELL_DATA 7\nSCALARS Tag int 1\nLOOKUP_TABLE default\n1 1 1 1 2 2 2\n",
                1,
                "'Tag' holds 7 numbers",
            ),
            ("CELL_DATA 9\nFIELD f 1\nTag 1 9 int\n1 1 1 1 2 2 2 3 3\n", 2, "'Tag' holds 9 numbers"),
            (
                "CELL_DATA 8\nFIELD f 1\nvtkGhostType 1 1 unsigned_char\n32\n",
                2,
                "'vtkGhostType' holds 1 numbers",
            ),
            ("CELL_DATA 1\nSCALARS Level int\nLOOKUP_TABLE default\n0\n", 1, "'Level' holds 1 numbers"),
        ] {
            let error = legacy(&dataset, data).expect_err(data);
            assert_eq!(
                (error.code, error.line),
                ("inconsistent", Some(before + line)),
                "{error}\n{dataset}{data}"
            );
            assert!(error.message.contains(words) && error.message.ends_with("there are 8 cells"), "{error}");
        }
        // Arrays of nodes, and those that nobody reads, may be of any length.
        let others = "POINT_DATA 2\nSCALARS Tag int\nLOOKUP_TABLE default\n1 2\nCELL_DATA 3\nSCALARS heat int\n\
                      LOOKUP_TABLE default\n1 2 3\n";
        assert_eq!(legacy(&dataset, others).expect("cells").dropped_arrays, ["Tag", "heat"]);
    }
}
