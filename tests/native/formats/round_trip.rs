//! What is written reads back: the same bits, cells and tags, as far as the format can say them.

use hexmill::geometry::Point;
use hexmill::io::{AnyMesh, Document, Format, ReadError, inp, medit, msh, stl, vtk, vtu};
use hexmill::mesh::{FaceId, Group, HexMesh, NodeId, PolygonMesh, TagSet};
use proptest::prelude::*;

use super::worlds::{as_read, document, hex_grid, mixed_polygons, quad_grid, some_sets, triangles_and_quads};

/// Writes a document and reads it again.
pub fn through(document: &Document, format: Format) -> Result<Document, ReadError> {
    let bytes = match format {
        Format::Vtu => vtu::write(document),
        Format::Vtk => vtk::write(document),
        Format::Msh => msh::write(document),
        Format::Inp => inp::write(document),
        Format::Medit => medit::write(document),
        Format::Obj | Format::Stl | Format::Glb => unreachable!("not tested here"),
    };
    read(&bytes.unwrap(), format)
}

/// Reads a file of a format that has a reader here.
pub fn read(bytes: &[u8], format: Format) -> Result<Document, ReadError> {
    match format {
        Format::Vtu => vtu::read(bytes),
        Format::Vtk => vtk::read(bytes),
        Format::Msh => msh::read(bytes),
        Format::Inp => inp::read(bytes),
        Format::Medit => medit::read(bytes),
        Format::Stl => stl::read(bytes),
        Format::Obj | Format::Glb => unreachable!("not tested here"),
    }
}

pub const FORMATS: [Format; 5] = [Format::Vtu, Format::Vtk, Format::Msh, Format::Inp, Format::Medit];

/// What a format keeps of a tag set.
pub fn kept(set: &TagSet, format: Format) -> TagSet {
    match format {
        Format::Vtk | Format::Medit => TagSet { number: set.number, ..TagSet::default() },
        // An input deck lists each element set once, so that the order of an element's groups is the file's.
        Format::Inp => sorted(set),
        _ => set.clone(),
    }
}

/// A set that was read without the numbers that MSH and INP give to the names of `written` that have none.
pub fn without_given(mut read: TagSet, written: &TagSet, format: Format) -> TagSet {
    if matches!(format, Format::Msh | Format::Inp) {
        for (read, written) in read.groups.iter_mut().zip(&written.groups) {
            read.number = read.number.filter(|_| written.number.is_some());
        }
    }
    read
}

fn sorted(set: &TagSet) -> TagSet {
    let mut sorted = set.clone();
    sorted.groups.sort_by(|a, b| a.name.cmp(&b.name));
    sorted
}

/// The order in which a format lists the cells.
fn order(document: &Document, format: Format) -> Vec<usize> {
    let count = cells(document).len();
    let mut order: Vec<usize> = (0..count).collect();
    if format == Format::Medit {
        order.sort_by_key(|&cell| cells(document)[cell].len());
    }
    order
}

fn cells(document: &Document) -> Vec<&[NodeId]> {
    match &document.mesh {
        AnyMesh::Polygons(mesh) => mesh.faces().collect(),
        AnyMesh::Quads(mesh) => mesh.quads.iter().map(|quad| &quad[..]).collect(),
        AnyMesh::Hexes(mesh) => mesh.hexes.iter().map(|hex| &hex[..]).collect(),
    }
}

fn positions(document: &Document) -> &[Point] {
    match &document.mesh {
        AnyMesh::Polygons(mesh) => &mesh.positions,
        AnyMesh::Quads(mesh) => &mesh.positions,
        AnyMesh::Hexes(mesh) => &mesh.positions,
    }
}

/// Checks that `read` is `written` as far as the format goes.
fn check_same(written: &Document, read: &Document, format: Format) {
    let (wanted, found) = (positions(written), positions(read));
    assert_eq!(wanted.len(), found.len(), "{format}");
    for (node, (a, b)) in wanted.iter().zip(found).enumerate() {
        for axis in 0..3 {
            // An input deck has 20 characters for a number: 13 digits at least.
            let tolerance = if format == Format::Inp { 1e-12 * a[axis].abs() } else { 0.0 };
            assert!((a[axis] - b[axis]).abs() <= tolerance, "{format}: node {node}: {a} became {b}");
        }
    }
    let (wanted, found) = (cells(written), cells(read));
    assert_eq!(wanted.len(), found.len(), "{format}");
    let keeps_columns = matches!(format, Format::Vtu | Format::Vtk);
    for (place, cell) in order(written, format).into_iter().enumerate() {
        assert_eq!(wanted[cell], found[place], "{format}: cell {cell}");
        let set = written.tags.of(cell).map(|set| kept(set, format));
        let found = read.tags.of(place).map(|set| kept(set, format));
        let set = set.unwrap_or_default();
        assert_eq!(without_given(found.unwrap_or_default(), &set, format), set, "{format}");
        if keeps_columns {
            assert_eq!(written.level.get(cell), read.level.get(place), "{format}");
            assert_eq!(written.parent.get(cell), read.parent.get(place), "{format}");
        }
    }
}

fn formats_for(mesh: &AnyMesh) -> impl Iterator<Item = Format> {
    let has_polygons = matches!(mesh, AnyMesh::Polygons(mesh) if mesh.faces().any(|face| face.len() > 4));
    FORMATS.into_iter().filter(move |format| !has_polygons || matches!(format, Format::Vtu | Format::Vtk))
}

#[test]
fn grids_read_back_from_every_format() {
    for mesh in [
        AnyMesh::Quads(quad_grid(7)),
        AnyMesh::Polygons(mixed_polygons()),
        AnyMesh::Polygons(triangles_and_quads()),
        AnyMesh::Hexes(hex_grid(3)),
    ] {
        for mut sets in [vec![], some_sets()] {
            for set in sets.iter_mut().flat_map(|set| &mut set.groups) {
                set.name = set.name.replace(' ', "_");
            }
            let written = document(mesh.clone(), sets);
            for format in formats_for(&mesh) {
                check_same(&written, &through(&written, format).unwrap(), format);
            }
        }
    }
}

#[test]
fn vtu_reads_back_as_the_same_document() {
    for mesh in [AnyMesh::Quads(quad_grid(5)), AnyMesh::Hexes(hex_grid(2))] {
        let written = document(mesh, some_sets());
        assert_eq!(through(&written, Format::Vtu).unwrap(), as_read(&written));
    }
}

#[test]
fn arrays_of_several_compressed_blocks_read_back() {
    // 401 x 401 nodes take 3.9 MB of coordinates: four blocks.
    let written = document(AnyMesh::Quads(quad_grid(400)), some_sets());
    assert_eq!(through(&written, Format::Vtu).unwrap(), as_read(&written));
}

#[test]
fn bytes_are_the_same_for_any_number_of_threads() {
    let written = document(AnyMesh::Quads(quad_grid(200)), some_sets());
    let files = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| [vtu::write, vtk::write, msh::write, inp::write, medit::write].map(|w| w(&written)))
    };
    assert_eq!(files(1), files(2));
    assert_eq!(files(1), files(5));
}

#[test]
fn sharp_edges_and_corners_pass_through_medit() {
    let mut mesh = triangles_and_quads();
    mesh.features.polylines = vec![vec![NodeId(0), NodeId(1)], vec![NodeId(2), NodeId(5)]];
    mesh.features.creases = vec![([NodeId(2), NodeId(5)], 10.0), ([NodeId(3), NodeId(6)], 10.0)];
    mesh.features.corners = vec![(NodeId(7), 10.0)];
    let read = through(&document(AnyMesh::Polygons(mesh.clone()), vec![]), Format::Medit).unwrap();
    let AnyMesh::Polygons(read) = read.mesh else { panic!("the surface became hexes") };
    assert_eq!(read.features.creases, mesh.features.creases);
    assert_eq!(read.features.corners, mesh.features.corners);
    // The crease that was no polyline has become an edge, too.
    assert_eq!(read.features.polylines[..2], mesh.features.polylines);
    assert_eq!(read.features.polylines[2..], [vec![NodeId(3), NodeId(6)]]);
}

#[test]
fn sets_without_numbers_get_some_and_keep_their_names() {
    let named = |name: &str, number| TagSet { groups: vec![name.into()], number, ..TagSet::default() };
    let sets = vec![named("a", None), named("b", Some(1)), named("c", Some(1)), TagSet::default()];
    let written = document(AnyMesh::Quads(quad_grid(2)), sets.clone());
    for format in [Format::Vtu, Format::Msh] {
        let read = through(&written, format).unwrap();
        let found: Vec<&TagSet> = (0..4).map(|cell| read.tags.of(cell).unwrap()).collect();
        for (set, found) in sets.iter().zip(&found) {
            let names = |set: &TagSet| -> Vec<String> { set.groups.iter().map(|g| g.name.clone()).collect() };
            assert_eq!(names(set), names(found), "{format}");
        }
        assert_eq!(found[1].number, Some(1), "{format}");
        assert_eq!(*found[3], TagSet::default(), "{format}");
        let numbers = [0, 1, 2].map(|cell: usize| found[cell].number.unwrap());
        assert!(numbers[0] != numbers[1] && numbers[1] != numbers[2] && numbers[0] != numbers[2], "{format}");
    }
}

#[test]
fn polygons_of_five_nodes_are_refused_where_they_have_no_place() {
    let mesh = document(AnyMesh::Polygons(mixed_polygons()), vec![]);
    for error in [msh::write(&mesh), inp::write(&mesh), medit::write(&mesh)].map(Result::unwrap_err) {
        assert_eq!(error.code, "format-holds-no-polygons");
        assert!(error.message.contains("face 4 has 5 nodes"), "{error}");
    }
}

#[test]
fn documents_that_do_not_hold_together_are_refused() {
    let good = document(AnyMesh::Quads(quad_grid(2)), some_sets());
    let mut short = good.clone();
    short.level.pop();
    let mut beyond = good.clone();
    let mut infinite = good.clone();
    if let (AnyMesh::Quads(beyond), AnyMesh::Quads(infinite)) = (&mut beyond.mesh, &mut infinite.mesh) {
        beyond.quads[1][2] = NodeId(9);
        infinite.positions[3].y = f64::INFINITY;
    }
    for (document, code) in
        [(short, "inconsistent"), (beyond, "node-out-of-range"), (infinite, "coordinate-not-finite")]
    {
        for write in [vtu::write, vtk::write, msh::write, inp::write, medit::write] {
            assert_eq!(write(&document).unwrap_err().code, code);
        }
    }
}

fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![
        3 => -1e3..1e3_f64,
        1 => proptest::num::f64::NORMAL | proptest::num::f64::SUBNORMAL | proptest::num::f64::ZERO,
    ]
}

/// Tag sets with different numbers above 0 and names that every format takes.
fn tag_sets() -> impl Strategy<Value = Vec<TagSet>> {
    let name = || proptest::option::of("[a-z][a-z0-9_]{0,8}");
    let groups = proptest::collection::btree_set("[a-z][a-z0-9_]{0,3}", 0..3);
    let set = (name(), groups, name()).prop_map(|(object, groups, material)| TagSet {
        object,
        groups: groups.into_iter().map(Group::from).collect(),
        material,
        number: None,
    });
    (proptest::collection::vec(set, 0..5), 1..50_i64).prop_map(|(mut sets, first)| {
        let names: Vec<Group> = sets.iter().flat_map(|set| set.groups.clone()).collect();
        for (set, number) in sets.iter_mut().zip(first..) {
            set.number = Some(3 * number);
            // A number beside one name alone is that name's, unless other sets have it without.
            if set.object.is_none()
                && set.material.is_none()
                && let [group] = set.groups.as_mut_slice()
                && names.iter().filter(|name| *name == group).count() == 1
            {
                group.number = set.number;
            }
        }
        sets
    })
}

fn any_mesh(cell: impl Strategy<Value = usize>) -> impl Strategy<Value = AnyMesh> {
    let points = proptest::collection::vec([coordinate(), coordinate(), coordinate()], 8..30);
    let sizes = proptest::collection::vec(cell, 1..12);
    (points, sizes, any::<u32>()).prop_map(|(points, sizes, seed)| {
        let positions: Vec<Point> = points.into_iter().map(Point::from).collect();
        let count = positions.len() as u32;
        let node = |cell: usize, corner: usize| {
            NodeId(seed.wrapping_add(7 * cell as u32).wrapping_add(corner as u32) % count)
        };
        if sizes[0] == 8 {
            let hexes = (0..sizes.len()).map(|cell| std::array::from_fn(|k| node(cell, k))).collect();
            return AnyMesh::Hexes(HexMesh { positions, hexes, ..HexMesh::default() });
        }
        let mut mesh = PolygonMesh { positions, ..PolygonMesh::default() };
        for (cell, &size) in sizes.iter().enumerate() {
            mesh.push_face((0..size).map(|corner| node(cell, corner)));
        }
        AnyMesh::Polygons(mesh)
    })
}

fn any_document(cell: impl Strategy<Value = usize>) -> impl Strategy<Value = Document> {
    (any_mesh(cell), tag_sets(), any::<u32>(), any::<bool>()).prop_map(|(mesh, sets, seed, columns)| {
        let mut document = document(mesh, sets);
        let kinds = document.tags.sets.len().max(1) as u32;
        for (cell, set) in (0..).zip(&mut document.tags.of_element) {
            *set = seed.rotate_left(cell) % kinds;
        }
        for (cell, parent) in (0..).zip(&mut document.parent) {
            *parent = FaceId(seed.rotate_right(cell));
        }
        if !columns {
            document.level.clear();
            document.parent.clear();
        }
        document
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn any_surface_reads_back(document in any_document(3..5_usize)) {
        for format in FORMATS {
            check_same(&document, &through(&document, format).unwrap(), format);
        }
    }

    #[test]
    fn any_polygons_read_back(document in any_document(3..9_usize)) {
        for format in formats_for(&document.mesh) {
            check_same(&document, &through(&document, format).unwrap(), format);
        }
    }

    #[test]
    fn any_hexes_read_back(document in any_document(Just(8))) {
        for format in FORMATS {
            check_same(&document, &through(&document, format).unwrap(), format);
        }
    }
}
