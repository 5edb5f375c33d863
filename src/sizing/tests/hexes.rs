//! Hexes ask the same questions as quads.

use glam::DQuat;
use proptest::prelude::*;

use super::{OPTIONS, Region, Shape, SizeField, SizeOptions, SizedElement, Target, distance};
use crate::geometry::Point;
use crate::geometry::samples::{point, rotation};
use crate::mesh::numbering::hex::{CORNERS, EDGES};
use crate::mesh::{HexMesh, NodeId};
use crate::sizing::SizingError;
use crate::sizing::overlap::TOUCH;

/// The hex with the given corners, of level 0.
fn hex(corners: [Point; 8]) -> SizedElement<8> {
    let lengths = EDGES.map(|[a, b]| corners[usize::from(a)].distance(corners[usize::from(b)]));
    SizedElement { corners, longest: lengths.into_iter().fold(0.0, f64::max), level: 0, root: None }
}

/// The unit cube at (x, y, z).
fn cube(x: f64, y: f64, z: f64) -> SizedElement<8> {
    hex(CORNERS.map(|c| Point::new(x, y, z) + Point::from(c.map(f64::from))))
}

fn mesh(element: &SizedElement<8>) -> HexMesh {
    let hexes = vec![std::array::from_fn(NodeId::new)];
    HexMesh { positions: element.corners.to_vec(), hexes, ..HexMesh::default() }
}

fn wants(shape: &Shape, target: Target, gradation: f64, element: &SizedElement<8>) -> bool {
    let regions = [Region { shape: shape.clone(), target }];
    let options = SizeOptions { gradation, regions: &regions, ..OPTIONS };
    SizeField::of_hexes(&mesh(element), options).expect("valid options").wants(element)
}

fn overlaps(shape: &Shape, element: &SizedElement<8>) -> bool {
    wants(shape, Target::Level(9), 2.0, element)
}

/// The cubes of a grid of 5 x 5 x 5 that overlap the shape, as x, y, z.
fn picture(shape: &Shape) -> Vec<[usize; 3]> {
    let all = (0..125).map(|m| [m % 5, m / 5 % 5, m / 25]);
    let met = |at: &[usize; 3]| {
        let [x, y, z] = at.map(|c| c as f64);
        overlaps(shape, &cube(x, y, z))
    };
    all.filter(met).collect()
}

fn cuboid(min: [f64; 3], max: [f64; 3]) -> Shape {
    Shape::Box { min: min.into(), max: max.into(), rotation: DQuat::IDENTITY }
}

/// The cubes from `from` up to, but without, `to`.
fn block(from: [usize; 3], to: [usize; 3]) -> Vec<[usize; 3]> {
    let all = (0..125).map(|m| [m % 5, m / 5 % 5, m / 25]);
    all.filter(|at| (0..3).all(|i| (from[i]..to[i]).contains(&at[i]))).collect()
}

#[test]
fn boxes_along_the_grid_leave_their_neighbours_alone() {
    assert_eq!(picture(&cuboid([1., 2., 2.], [3., 3., 4.])), block([1, 2, 2], [3, 3, 4]));
    assert_eq!(picture(&cuboid([0., 0., 0.], [5., 5., 5.])), block([0; 3], [5; 3]));
    assert_eq!(picture(&cuboid([2.2, 2.2, 2.2], [2.3, 2.3, 2.3])), block([2; 3], [3; 3]));
}

#[test]
fn shapes_of_no_thickness_refine_what_they_lie_in() {
    assert_eq!(picture(&cuboid([2., 2., 2.], [3., 3., 2.])), block([2, 2, 1], [3, 3, 3]), "a face");
    assert_eq!(picture(&cuboid([2., 2., 2.], [2., 2., 2.])), block([1; 3], [3; 3]), "a node");
    let at = |p: [f64; 3]| Shape::Points { points: vec![p.into()], radius: 0.0 };
    assert_eq!(picture(&at([2.4, 1.7, 3.5])), block([2, 1, 3], [3, 2, 4]), "a governing point");
    assert_eq!(picture(&at([2., 1.5, 3.5])), block([1, 1, 3], [3, 2, 4]), "in a face");
}

#[test]
fn balls_and_drums_in_symmetric_places() {
    let ball = |radius| Shape::Sphere { center: Point::splat(2.5), radius };
    assert_eq!(picture(&ball(0.5)), block([2; 3], [3; 3]), "it touches its cube's faces from inside");
    let star = picture(&ball(0.6));
    assert_eq!(star.len(), 7, "and the six beside it: {star:?}");
    let drum = Shape::Cylinder { from: Point::new(2.5, 2.5, 1.), to: Point::new(2.5, 2.5, 4.), radius: 0.4 };
    assert_eq!(picture(&drum), block([2, 2, 1], [3, 3, 4]));
}

/// The governing surface of the paper's figure 15: a closed surface, of which the cubes that it passes are refined.
#[test]
fn a_closed_surface_refines_what_it_passes() {
    let [a, b] = [0.5, 4.5];
    let positions = CORNERS.map(|c| Point::from(c.map(|c| if c == 0 { a } else { b }))).to_vec();
    let triangles = crate::mesh::numbering::hex::FACES
        .iter()
        .flat_map(|f| {
            let [p, q, r, s] = f.map(u32::from);
            [[p, q, r], [p, r, s]]
        })
        .collect();
    let shell = Shape::Surface { positions, triangles, distance: 0.0 };
    let expected: Vec<_> =
        block([0; 3], [5; 3]).into_iter().filter(|at| at.iter().any(|&c| c == 0 || c == 4)).collect();
    assert_eq!(picture(&shell), expected);
}

#[test]
fn sizes_grade_with_the_distance() {
    let ball = Shape::Sphere { center: Point::splat(0.5), radius: 0.25 };
    // At a distance d no edge is longer than 0.25 + 0.5 d: a unit cube that begins 1.5 away may stay.
    let far = |gap: f64| wants(&ball, Target::Size(0.25), 1.5, &cube(0.75 + gap, 0.0, 0.0));
    assert!(far(0.0) && far(1.49) && !far(1.51));
}

#[test]
fn edges_are_measured_and_levels_end() {
    let unit = cube(0.0, 0.0, 0.0);
    let options = SizeOptions { edge_length: Some(0.25), ..OPTIONS };
    let field = SizeField::of_hexes(&mesh(&unit), options).unwrap();
    assert!(field.wants(&unit) && field.wants(&SizedElement { longest: 0.5, level: 1, ..unit }));
    assert!(!field.wants(&SizedElement { longest: 0.25, level: 2, ..unit }));
    assert!(!field.is_idle_from(1) && field.is_idle_from(2));
}

#[test]
fn hexes_have_no_curvature() {
    let options = SizeOptions { curvature: Some(10.0), ..OPTIONS };
    let error = SizeField::of_hexes(&mesh(&cube(0., 0., 0.)), options).unwrap_err();
    assert_eq!((error.clone(), error.code()), (SizingError::CurvatureOfHexes, "curvature-needs-surface"));
}

proptest! {
    /// What a cube's samples tell of boxes, up to the samples' distance. The samples are those of what is left of the
    /// cube when it is shrunk: a box that a sample of the cube itself lies in may only touch it there.
    #[test]
    fn agrees_with_samples(center in point(2.0), half in point(1.0), turn in rotation()) {
        let shape = Shape::Box { min: center - half.abs(), max: center + half.abs(), rotation: turn };
        let shrunk = |c: usize| 0.5 + (c as f64 / 8.0 - 0.5) * (1.0 - TOUCH);
        let samples = (0..729).map(|m| Point::from([m % 9, m / 9 % 9, m / 81].map(shrunk)));
        let near = samples.map(|p| distance(&shape, p)).fold(f64::INFINITY, f64::min);
        let met = overlaps(&shape, &cube(0.0, 0.0, 0.0));
        prop_assert!(met || near > 0.0, "a sample lies in the box");
        prop_assert!(!met || near <= 3f64.sqrt() / 16.0 + 1e-3, "no sample is near");
    }
}

/// The children of a hex of so many parts along each axis, as trilinear interpolation has them.
fn children(corners: &[Point; 8], parts: usize) -> Vec<[Point; 8]> {
    let at = |t: [f64; 3]| -> Point {
        let weight = |k: usize| -> f64 {
            (0..3).map(|i| if CORNERS[k][i] == 0 { 1.0 - t[i] } else { t[i] }).product()
        };
        (0..8).map(|k| corners[k] * weight(k)).sum()
    };
    let child = |m: usize| {
        let from = [m % parts, m / parts % parts, m / parts / parts];
        CORNERS.map(|c| at([0, 1, 2].map(|i| (from[i] as f64 + f64::from(c[i])) / parts as f64)))
    };
    (0..parts.pow(3)).map(child).collect()
}

proptest! {
    /// What is told to be sure is so: every descendant is wanted finer.
    #[test]
    fn descendants_are_refined_as_often_as_is_sure(
        moves in proptest::collection::vec(point(0.4), 8),
        middle in point(1.0),
        radius in 0.2..4.0_f64,
        kind in 0..5_usize,
        by_level in proptest::bool::ANY,
        parts in 2..4_usize,
    ) {
        let corners: [Point; 8] = std::array::from_fn(|k| Point::from(CORNERS[k].map(f64::from)) + moves[k]);
        let shape = match kind {
            0 => Shape::Sphere { center: middle, radius },
            1 => Shape::Box { min: middle - radius, max: middle + radius, rotation: DQuat::from_xyzw(1., 2., 3., 4.) },
            2 => Shape::Cylinder { from: middle - Point::X * radius, to: middle + Point::splat(radius), radius },
            3 => Shape::Points { points: vec![middle, Point::splat(9.0)], radius },
            _ => Shape::Surface {
                positions: vec![middle, middle + Point::X, middle + Point::Y],
                triangles: vec![[0, 1, 2]],
                distance: radius,
            },
        };
        let target = if by_level { Target::Level(2) } else { Target::Size(0.3) };
        let regions = [Region { shape, target }];
        let options = SizeOptions { regions: &regions, ..OPTIONS };
        let field = SizeField::of_hexes(&mesh(&hex(corners)), options).expect("valid options");
        let mut elements = vec![corners];
        for level in 0..field.sure_levels(&corners, 0, parts as f64) {
            for &corners in &elements {
                let element = SizedElement { level, ..hex(corners) };
                prop_assert!(field.wants(&element), "{element:?}");
            }
            if level < 2 {
                elements = elements.iter().flat_map(|corners| children(corners, parts)).collect();
            } else {
                break;
            }
        }
    }
}
