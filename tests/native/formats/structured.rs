//! Structured datasets of legacy VTK files: the same nodes and cells, whichever way they are told.

use hexmill::geometry::Point;
use hexmill::io::{AnyMesh, Document, Format, ReadError};
use hexmill::mesh::check::check_hexes;
use proptest::prelude::*;

use super::round_trip::read;

/// Nodes along each axis, where the first of them stands and how far apart they are.
#[derive(Clone, Debug)]
struct World {
    dimensions: [usize; 3],
    origin: [f64; 3],
    spacing: [f64; 3],
}

const NAMES: [&str; 3] = ["STRUCTURED_POINTS", "RECTILINEAR_GRID", "STRUCTURED_GRID"];

impl World {
    fn coordinate(&self, axis: usize, place: usize) -> f64 {
        self.origin[axis] + place as f64 * self.spacing[axis]
    }

    fn points(&self) -> Vec<Point> {
        let [x, y, z] = self.dimensions;
        let place = |n: usize| [n % x, n / x % y, n / x / y];
        let at = |n: usize| Point::from(std::array::from_fn(|axis| self.coordinate(axis, place(n)[axis])));
        (0..x * y * z).map(at).collect()
    }

    fn cell_count(&self) -> usize {
        self.dimensions.iter().map(|&size| (size - 1).max(1)).product()
    }

    /// A file with the dataset called `name` and a tag for each cell: its number.
    fn file(&self, name: &str, binary: bool) -> Vec<u8> {
        let kind = if binary { "BINARY" } else { "ASCII" };
        let words = |numbers: &[f64]| numbers.iter().map(f64::to_string).collect::<Vec<_>>().join(" ");
        let data = |numbers: &[f64]| {
            if binary {
                numbers.iter().flat_map(|number| number.to_be_bytes()).collect()
            } else {
                words(numbers).into_bytes()
            }
        };
        let [x, y, z] = self.dimensions;
        let mut file =
            format!("# vtk DataFile Version 3.0\nt\n{kind}\nDATASET {name}\nDIMENSIONS {x} {y} {z}\n")
                .into_bytes();
        match name {
            "STRUCTURED_POINTS" => {
                let (origin, spacing) = (words(&self.origin), words(&self.spacing));
                file.extend(format!("ORIGIN {origin}\nSPACING {spacing}\n").into_bytes());
            }
            "RECTILINEAR_GRID" => {
                for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
                    let size = self.dimensions[axis];
                    let numbers: Vec<f64> = (0..size).map(|place| self.coordinate(axis, place)).collect();
                    file.extend(format!("{name}_COORDINATES {size} double\n").into_bytes());
                    file.extend(data(&numbers));
                    file.push(b'\n');
                }
            }
            _ => {
                let points = self.points();
                let numbers: Vec<f64> = points.iter().flat_map(|p| p.to_array()).collect();
                file.extend(format!("POINTS {} double\n", points.len()).into_bytes());
                file.extend(data(&numbers));
                file.push(b'\n');
            }
        }
        let numbers: Vec<f64> = (1..=self.cell_count()).map(|cell| cell as f64).collect();
        file.extend(
            format!("CELL_DATA {}\nSCALARS Tag double 1\nLOOKUP_TABLE default\n", numbers.len()).bytes(),
        );
        file.extend(data(&numbers));
        file.push(b'\n');
        file
    }
}

/// The lower corner and the upper corner of each cell, and its number of nodes.
fn boxes(document: &Document) -> Vec<(Point, Point, usize)> {
    let positions = document.mesh.positions();
    let cells: Vec<Vec<_>> = match &document.mesh {
        AnyMesh::Hexes(mesh) => mesh.hexes.iter().map(|hex| hex.to_vec()).collect(),
        AnyMesh::Polygons(mesh) => mesh.faces().map(<[_]>::to_vec).collect(),
        AnyMesh::Quads(_) => panic!("readers make polygons"),
    };
    let around = |nodes: Vec<hexmill::mesh::NodeId>| {
        let points = || nodes.iter().map(|node| positions[node.index()]);
        let (min, max) = (points().reduce(Point::min), points().reduce(Point::max));
        (min.expect("nodes"), max.expect("nodes"), nodes.len())
    };
    cells.into_iter().map(around).collect()
}

proptest! {
    #[test]
    fn all_datasets_hold_the_same(
        dimensions in prop::array::uniform3(1_usize..5),
        origin in prop::array::uniform3(-10.0_f64..10.0),
        spacing in prop::array::uniform3(0.1_f64..3.0),
    ) {
        let world = World { dimensions, origin, spacing };
        let axes = dimensions.iter().filter(|&&size| size > 1).count();
        for (name, binary) in NAMES.into_iter().flat_map(|name| [(name, false), (name, true)]) {
            let result = read(&world.file(name, binary), Format::Vtk);
            if axes < 2 {
                prop_assert_eq!(result.expect_err("no cells").code, "no-cells");
                continue;
            }
            let document = result.expect("cells");
            prop_assert_eq!(document.mesh.positions(), world.points());
            prop_assert_eq!(document.mesh.cell_count(), world.cell_count());
            if let AnyMesh::Hexes(mesh) = &document.mesh {
                prop_assert_eq!(check_hexes(mesh), []);
            }
            let [x, y, _] = dimensions.map(|size| (size - 1).max(1));
            for (cell, (min, max, size)) in boxes(&document).into_iter().enumerate() {
                let place = [cell % x, cell / x % y, cell / x / y];
                let corner = |step: usize| std::array::from_fn(|axis| {
                    world.coordinate(axis, (place[axis] + step).min(dimensions[axis] - 1))
                });
                prop_assert_eq!((min, max), (Point::from(corner(0)), Point::from(corner(1))));
                prop_assert_eq!(size, 1 << axes);
                let number = document.tags.of(cell).and_then(|set| set.number);
                prop_assert_eq!(number, Some(cell as i64 + 1));
            }
        }
    }
}

fn read_text(dataset: &str) -> Result<Document, ReadError> {
    read(format!("# vtk DataFile Version 3.0\nt\nASCII\nDATASET {dataset}").as_bytes(), Format::Vtk)
}

#[test]
fn points_may_be_told_by_their_extent_and_in_any_order() {
    let points = "STRUCTURED_POINTS\nSPACING 0.5 1 2\nORIGIN 10 0 0\nEXTENT 2 4 -1 0 0 1\n";
    let document = read_text(points).expect("hexes");
    let found = boxes(&document);
    assert_eq!(found.len(), 2);
    assert_eq!(found[0].0, Point::new(11.0, -1.0, 0.0));
    assert_eq!(found[1].1, Point::new(12.0, 0.0, 2.0));
    let old = "STRUCTURED_POINTS\nDIMENSIONS 2 2 2\nASPECT_RATIO 3 3 3\nPOINT_DATA 8\nSCALARS heat float\n\
               LOOKUP_TABLE default\n1 2 3 4 5 6 7 8\n";
    let document = read_text(old).expect("a hex");
    assert_eq!(boxes(&document)[0].1, Point::splat(3.0));
    assert_eq!(document.dropped_arrays, ["heat"]);
}

#[test]
fn what_does_not_fit_is_refused_before_memory_is_taken() {
    let most = (1_usize << 63).to_string();
    for (dataset, code, words) in [
        ("STRUCTURED_POINTS\nDIMENSIONS 2000 2000 2000\n", "too-large", "2000 x 2000 x 2000"),
        ("STRUCTURED_POINTS\nDIMENSIONS 4294967296 4294967296 2\n", "too-large", "more than the"),
        ("STRUCTURED_POINTS\nDIMENSIONS 9223372036854775807 2 2\n", "too-large", "more than the"),
        (
            &format!("STRUCTURED_POINTS\nDIMENSIONS {most} 2 2\n"),
            "bad-number",
            "a dimension should; the number is too large",
        ),
        ("STRUCTURED_POINTS\nDIMENSIONS -99999999999999999999 2 2\n", "bad-number", "too large"),
        (
            "STRUCTURED_POINTS\nDIMENSIONS 2- 2 2\n",
            "bad-number",
            "'2-' stands where a dimension should: a number",
        ),
        ("STRUCTURED_POINTS\nDIMENSIONS -2 2 2\n", "bad-number", "cannot be negative"),
        ("STRUCTURED_POINTS\nDIMENSIONS 2 2\n", "truncated", "cut short"),
        ("STRUCTURED_POINTS\nDIMENSIONS 5 1 1\n", "no-cells", "at least two dimensions"),
        ("STRUCTURED_POINTS\nDIMENSIONS 5 5 0\n", "no-cells", "5 x 5 x 0"),
        ("STRUCTURED_POINTS\nSPACING 1 1 1\n", "syntax", "no DIMENSIONS"),
        ("STRUCTURED_POINTS\nEXTENT 0 4 3 1 0 1\n", "bad-number", "from 3 to 1; it must not go backwards"),
        (
            "STRUCTURED_POINTS\nEXTENT -9223372036854775808 9223372036854775807 0 1 0 1\n",
            "bad-number",
            "9223372036854775807; it is too large",
        ),
        ("STRUCTURED_POINTS\nDIMENSIONS 2 2 2\nORIGIN 0 nan 0\n", "coordinate-not-finite", "node 0"),
        ("STRUCTURED_POINTS\nDIMENSIONS 2 2 2\nCELLS 1 4\n3 0 1 2\n", "syntax", "'CELLS'"),
        (
            "STRUCTURED_GRID\nDIMENSIONS 2 2 2\nPOINTS 1 float\n0 0 0\n",
            "inconsistent",
            "1 points for 8 nodes",
        ),
        ("STRUCTURED_GRID\nDIMENSIONS 2 2 2\nPOINTS 8 float\n0 0 0\n", "truncated", "room for"),
        ("RECTILINEAR_GRID\nDIMENSIONS 2 2 2\n", "inconsistent", "0 coordinates along x for 2 nodes"),
        ("RECTILINEAR_GRID\nX_COORDINATES 4000000000 double\n0 1\n", "truncated", "the coordinates are"),
    ] {
        let text = format!("# vtk DataFile Version 3.0\nt\nASCII\nDATASET {dataset}");
        let (result, held) = super::allocation::most_held(|| read(text.as_bytes(), Format::Vtk));
        let error = result.expect_err(dataset);
        assert_eq!(error.code, code, "{error}\n{dataset}");
        assert!(error.to_string().contains(words), "{error}\n{dataset}");
        assert!(held < 1 << 16, "{held} bytes for {dataset}");
    }
}
