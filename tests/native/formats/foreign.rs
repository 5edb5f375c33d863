//! Files that VTK, meshio and Gmsh wrote (`tests/fixtures/make_fixtures.py`).

use hexmill::geometry::Point;
use hexmill::io::{self, AnyMesh, Format};
use hexmill::mesh::NodeId;

use super::round_trip::read;

macro_rules! fixtures {
    ($($name:literal)*) => { [$(($name, include_bytes!(concat!("../../fixtures/", $name)).as_slice())),*] };
}

/// Every fixture by its name.
pub fn all() -> impl Iterator<Item = (&'static str, &'static [u8], Format)> {
    let files = fixtures![
        "vtk_ascii.vtu" "vtk_binary.vtu" "vtk_binary_zlib.vtu" "vtk_binary_big.vtu" "vtk_appended_raw.vtu"
        "vtk_appended_raw_zlib.vtu" "vtk_appended_base64.vtu" "vtk_appended_base64_zlib_big.vtu"
        "meshio_ascii.vtu" "meshio_binary.vtu" "meshio_uncompressed.vtu" "vtk_lz4.vtu" "vtk_lzma.vtu"
        "vtk_42_ascii.vtk" "vtk_42_binary.vtk" "vtk_42_polydata.vtk" "vtk_51_ascii.vtk" "vtk_51_binary.vtk"
        "vtk_51_polydata_binary.vtk" "meshio_42_binary.vtk" "meshio_51_ascii.vtk" "gmsh_surface.vtk"
        "gmsh_solid.vtk"
        "gmsh_surface_22_ascii.msh" "gmsh_surface_22_binary.msh" "gmsh_surface_41_ascii.msh"
        "gmsh_surface_41_binary.msh" "gmsh_solid_22_ascii.msh" "gmsh_solid_22_binary.msh"
        "gmsh_solid_41_ascii.msh" "gmsh_solid_41_binary.msh" "meshio_solid_41_binary.msh"
        "gmsh_surface.inp" "gmsh_solid.inp" "meshio_surface.inp" "meshio_solid.inp"
        "meshio_surface.mesh" "meshio_solid.mesh"
        "vtk_structured_points_ascii.vtk" "vtk_structured_points_binary.vtk" "vtk_structured_rectilinear_ascii.vtk"
        "vtk_structured_rectilinear_binary.vtk" "vtk_structured_grid_ascii.vtk" "vtk_structured_grid_binary.vtk"
        "gmsh_hex20.msh" "gmsh_hex27.msh" "gmsh_hex20.inp" "gmsh_hex27.vtk" "meshio_hex27.vtu"
    ];
    files.into_iter().map(|(name, bytes)| {
        let extension = name.rsplit('.').next().unwrap();
        (name, bytes, Format::from_extension(extension).unwrap())
    })
}

/// What the tags of a fixture say: the number, the name, or nothing where the writer had no place for it.
fn tag_of(name: &str, wanted: i64) -> (Option<i64>, Option<&'static str>) {
    let label = |one, two| if wanted == 1 { one } else { two };
    match name {
        _ if name.ends_with(".msh") && name.starts_with("gmsh") => {
            (Some(wanted), Some(label("one", "the other")))
        }
        _ if name.ends_with(".inp") && name.starts_with("gmsh") => (None, Some(label("one", "the_other"))),
        _ if name.ends_with(".inp") || name == "meshio_solid_41_binary.msh" => (None, None),
        _ => (Some(wanted), None),
    }
}

fn surface_points() -> Vec<Point> {
    let node = |k: u32| (f64::from(k % 3), f64::from(k / 3));
    (0..9).map(node).map(|(x, y)| Point::new(x / 2.0, y / 4.0, x * y / 8.0)).collect()
}

fn solid_points() -> Vec<Point> {
    let node = |k: u32| (f64::from(k % 3), f64::from(k / 3 % 2), f64::from(k / 6));
    (0..12).map(node).map(|(x, y, z)| Point::new(x, y / 2.0, z / 4.0)).collect()
}

/// The nodes of a cell, and its tag.
type Cell = (&'static [u32], i64);

const SURFACE: [Cell; 5] =
    [(&[0, 1, 4, 3], 1), (&[1, 2, 5, 4], 1), (&[3, 4, 7, 6], 2), (&[4, 5, 8], 2), (&[4, 8, 7], 2)];
const SOLID: [Cell; 2] = [(&[0, 1, 4, 3, 6, 7, 10, 9], 1), (&[1, 2, 5, 4, 7, 8, 11, 10], 2)];

#[test]
fn every_fixture_holds_its_mesh() {
    for (name, bytes, format) in all().filter(|(name, ..)| !name.contains("_lz")) {
        let document = read(bytes, format).unwrap_or_else(|error| panic!("{name}: {error}"));
        assert_eq!(document.linearized, if name.contains("_hex2") { 2 } else { 0 }, "{name}");
        let (points, cells, wanted): (_, Vec<Vec<NodeId>>, &[Cell]) = match &document.mesh {
            AnyMesh::Hexes(mesh) => {
                (&mesh.positions, mesh.hexes.iter().map(|h| h.to_vec()).collect(), &SOLID)
            }
            AnyMesh::Polygons(mesh) => (&mesh.positions, mesh.faces().map(<[_]>::to_vec).collect(), &SURFACE),
            AnyMesh::Quads(_) => panic!("{name}: readers make polygons"),
        };
        let expected = if wanted.len() == 2 { solid_points() } else { surface_points() };
        assert_eq!(*points, expected, "{name}");
        assert_eq!(cells.len(), wanted.len(), "{name}");
        for (nodes, tag) in wanted {
            // Gmsh numbers the elements of a version 2 file anew, so the order may be another.
            let nodes: Vec<NodeId> = nodes.iter().map(|&node| NodeId(node)).collect();
            let place = cells.iter().position(|cell| *cell == nodes);
            let place = place.unwrap_or_else(|| panic!("{name} lacks {nodes:?}"));
            let set = document.tags.of(place).cloned().unwrap_or_default();
            let (number, label) = tag_of(name, *tag);
            assert_eq!(set.number, number, "{name}");
            assert!(
                label.is_none_or(|label| set.groups.iter().any(|group| group.name == label)),
                "{name}: {set:?}"
            );
        }
    }
}

#[test]
fn compressions_that_are_not_read_are_told() {
    for (name, bytes, format) in all().filter(|(name, ..)| name.contains("_lz")) {
        let error = read(bytes, format).unwrap_err();
        assert_eq!(error.code, "unsupported-encoding", "{name}");
        assert!(error.to_string().starts_with("line 2: the data are compressed by vtkLZ"), "{error}");
    }
}

#[test]
fn the_format_is_told_by_the_content() {
    for (name, bytes, format) in all() {
        assert_eq!(io::detect(bytes).ok(), Some(format), "{name}");
    }
    for obj in ["v 0 0 0\n", "\u{feff}# made by\r\n\r\nmtllib a.mtl\n", "  o part\n", "f 1 2 3"] {
        assert_eq!(io::detect(obj.as_bytes()).ok(), Some(Format::Obj), "{obj:?}");
    }
}

#[test]
fn content_of_no_format_is_refused_by_name() {
    let refused = |bytes: &[u8]| io::detect(bytes).expect_err("no format");
    for bytes in [b"".as_slice(), b"# only a comment", b"Dear reader,\n", b"<svg/>", b"\xFF\xFEv\0 \0"] {
        let error = refused(bytes);
        assert_eq!(error.code, "format-unknown");
        assert!(error.message.contains(".obj") && error.message.contains(".vtu"), "{error}");
        assert!(!error.message.contains("glb"), "GLB is not read: {error}");
    }
    assert!(refused(b"\x89PNG\r\n").message.contains("PNG"));
    assert!(refused(b"solid part\n").message.contains("STL"));
}

/// Arrays that say nothing of cells here are told by name, each once, in the file's order: those of one number a cell and
/// of several, of nodes, and tags that are not the first choice.
#[test]
fn arrays_that_are_not_read_are_named() {
    let vtk = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS 4 double\n0 0 0 1 0 0 1 1 0 0 1 0\n\
               CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n9\nCELL_DATA 1\nSCALARS MaterialIds int 1\nLOOKUP_TABLE default\n5\n\
               SCALARS stress double 1\nLOOKUP_TABLE default\n0.5\nVECTORS flux double\n1 2 3\nSCALARS Tag int 1\n\
               LOOKUP_TABLE default\n7\nPOINT_DATA 4\nFIELD data 2\nheat 1 4 double\n1 2 3 4\nstress 1 4 double\n1 2 3 4\n";
    let document = io::read(vtk.as_bytes(), Format::Vtk).expect("a quad");
    assert_eq!(document.tags.of(0).and_then(|set| set.number), Some(7));
    assert_eq!(document.dropped_arrays, ["MaterialIds", "stress", "flux", "heat"]);
    let array = |name: &str, kind: &str, each: u32, values: &str| {
        format!(
            "<DataArray Name=\"{name}\" type=\"{kind}\" NumberOfComponents=\"{each}\">{values}</DataArray>"
        )
    };
    let piece = format!(
        "<Piece NumberOfPoints=\"4\" NumberOfCells=\"1\"><PointData>{}</PointData><CellData>{}{}{}</CellData><Points>{}</Points>\
         <Cells>{}{}{}</Cells></Piece>",
        array("heat", "Float64", 1, "1 2 3 4"),
        array("Tag", "Float64", 1, "0.5"),
        array("flux", "Float64", 3, "1 2 3"),
        array("Level", "UInt8", 1, "0"),
        array("Points", "Float64", 3, "0 0 0 1 0 0 1 1 0 0 1 0"),
        array("connectivity", "Int64", 1, "0 1 2 3"),
        array("offsets", "Int64", 1, "4"),
        array("types", "UInt8", 1, "9"),
    );
    let vtu = format!(
        "<VTKFile type=\"UnstructuredGrid\" byte_order=\"LittleEndian\"><UnstructuredGrid>{piece}{piece}</UnstructuredGrid></VTKFile>"
    );
    let document = io::read(vtu.as_bytes(), Format::Vtu).expect("two quads");
    assert_eq!(document.dropped_arrays, ["Tag", "flux", "heat"]);
    assert_eq!(document.level, [0, 0]);
    // What is written here is read here.
    for format in [Format::Vtu, Format::Vtk] {
        let again = io::read(&io::write(&document, format).expect("a file"), format).expect("the same");
        assert!(again.dropped_arrays.is_empty(), "{format}: {:?}", again.dropped_arrays);
    }
}
