use super::*;
use crate::sizing::{Shape, Target};
use glam::DQuat;

fn element(corners: [[f64; 3]; 4]) -> SizedElement {
    let corners = corners.map(Point::from);
    let longest = (0..4).map(|k| corners[k].distance(corners[(k + 1) % 4])).fold(0.0, f64::max);
    SizedElement { corners, longest, level: 0, root: FaceId(0) }
}

/// The square of the given side with its least corner at x, y in the plane at height z.
fn square(x: f64, y: f64, z: f64, side: f64) -> SizedElement {
    element([[x, y, z], [x + side, y, z], [x + side, y + side, z], [x, y + side, z]])
}

fn field_of(regions: &[Region], gradation: f64) -> SizeField {
    let options = SizeOptions { edge_length: None, curvature: None, gradation, regions };
    SizeField::new(&PolygonMesh::default(), options).unwrap()
}

/// A field that refines what overlaps `shape`, whatever its size.
fn inside(shape: Shape) -> SizeField {
    field_of(&[Region { shape, target: Target::Level(9) }], 2.0)
}

fn cuboid(min: [f64; 3], max: [f64; 3]) -> Shape {
    Shape::Box { min: min.into(), max: max.into(), rotation: DQuat::IDENTITY }
}

fn sphere(center: [f64; 3], radius: f64) -> Shape {
    Shape::Sphere { center: center.into(), radius }
}

/// The squares of a grid of `n` by `n` that `field` refines, as i, j.
fn refined(field: &SizeField, n: u32, place: impl Fn(f64, f64) -> [f64; 3]) -> Vec<(u32, u32)> {
    let cells = (0..n).flat_map(|j| (0..n).map(move |i| (i, j)));
    cells
        .filter(|&(i, j)| {
            let corner = |di: u32, dj: u32| place(f64::from(i + di), f64::from(j + dj));
            field.wants(&element([corner(0, 0), corner(1, 0), corner(1, 1), corner(0, 1)]))
        })
        .collect()
}

#[test]
fn small_regions_inside_a_large_element_are_found() {
    let big = square(0.0, 0.0, 0.0, 100.0);
    assert!(inside(sphere([30.0, 70.0, 0.0], 0.01)).wants(&big), "no corner and no side near");
    assert!(inside(sphere([30.0, 70.0, 0.5], 0.6)).wants(&big), "only its underside");
    assert!(!inside(sphere([30.0, 70.0, 0.5], 0.4)).wants(&big), "hovers above");
    assert!(inside(cuboid([10.0, 50.0, -1.0], [90.0, 50.001, 1.0])).wants(&big), "a thin wall");
    assert!(inside(cuboid([10.0, 50.0, -1.0], [90.0, 50.0, 1.0])).wants(&big), "a wall without thickness");
    assert!(inside(cuboid([10.0, 50.0, 0.0], [10.0, 50.0, 0.0])).wants(&big), "a point");
    let needle =
        Shape::Cylinder { from: [40.0, 40.0, -9.0].into(), to: [41.0, 43.0, 9.0].into(), radius: 1e-6 };
    assert!(inside(needle).wants(&big));
    assert!(!inside(sphere([1e9, 0.0, 0.0], 10.0)).wants(&big), "far away");
}

/// Boxes that end on grid lines refine the squares inside and none beside, wherever their top and bottom
/// are: around the plane, flush with it, or without any thickness.
#[test]
fn boxes_along_grid_lines_refine_what_is_inside() {
    let heights = [(-1.0, 1.0), (0.0, 1.0), (-1.0, 0.0), (0.0, 0.0)];
    for (i0, i1, j0, j1) in (0..5 * 5 * 5 * 5).map(|c| (c % 5, c / 5 % 5, c / 25 % 5, c / 125)) {
        if i0 >= i1 || j0 >= j1 {
            continue;
        }
        for (below, above) in heights {
            let thirds = |x: u32| f64::from(x) / 3.0;
            let shape = cuboid([thirds(i0), thirds(j0), below], [thirds(i1), thirds(j1), above]);
            let expected: Vec<_> = (j0..j1).flat_map(|j| (i0..i1).map(move |i| (i, j))).collect();
            let exact = refined(&inside(shape.clone()), 4, |x, y| [x / 3.0, y / 3.0, 0.0]);
            assert_eq!(exact, expected, "{shape:?}");
            let as_f32 = refined(&inside(shape.clone()), 4, |x, y| {
                [x / 3.0, y / 3.0, 1e-5].map(|x| f64::from(x as f32))
            });
            assert_eq!(as_f32, expected, "coordinates rounded, the plane a little off: {shape:?}");
        }
    }
}

#[test]
fn turned_boxes_along_the_lines_of_a_turned_grid() {
    let rotation = DQuat::from_axis_angle(Point::new(1.0, 2.0, 3.0).normalize(), 0.7);
    let (min, max) = (Point::new(1.0, 1.0, 0.0), Point::new(3.0, 2.0, 1.0));
    let center = min.midpoint(max);
    let field = inside(Shape::Box { min, max, rotation });
    let turned = |x: f64, y: f64| (center + rotation * (Point::new(x, y, 0.0) - center)).to_array();
    assert_eq!(refined(&field, 4, turned), [(1, 1), (2, 1)]);
    assert_eq!(refined(&field, 4, |x, y| [x, y, 50.0]), []);
}

/// ```text
/// +---+---+---+    a wall without thickness along the grid line x = 1, from y = 1 to y = 2, standing on
/// |   |   |   |    the plane: the squares on both sides, none at its ends
/// +---I---+---+
/// | # I # |   |
/// +---I---+---+
/// |   |   |   |
/// +---+---+---+
/// ```
#[test]
fn walls_without_thickness_along_a_grid_line_refine_both_sides() {
    for z in [(-1.0, 1.0), (0.0, 1.0), (0.0, 0.0)] {
        let wall = cuboid([1.0, 1.0, z.0], [1.0, 2.0, z.1]);
        assert_eq!(refined(&inside(wall), 3, |x, y| [x, y, 0.0]), [(0, 1), (1, 1)], "{z:?}");
    }
}

#[test]
fn points_refine_the_elements_that_hold_them() {
    let at = |p: [f64; 3], radius| inside(Shape::Points { points: vec![p.into()], radius });
    let flat = |x: f64, y: f64| [x, y, 0.0];
    assert_eq!(refined(&at([0.5, 1.5, 0.0], 0.0), 3, flat), [(0, 1)]);
    assert_eq!(refined(&at([1.0, 1.5, 0.0], 0.0), 3, flat), [(0, 1), (1, 1)], "on an edge");
    assert_eq!(refined(&at([1.0, 1.0, 0.0], 0.0), 3, flat), [(0, 0), (1, 0), (0, 1), (1, 1)], "on a node");
    assert_eq!(refined(&at([0.5, 0.5, 0.2], 0.0), 3, flat), [], "off the plane");
    assert_eq!(refined(&at([0.5, 0.5, 0.2], 0.6), 3, flat), [(0, 0), (1, 0), (0, 1)], "by its radius");
    let cloud = (0..1000).map(|i| Point::new(1.1, 1.1 + f64::from(i) / 1250.0, 0.0)).collect();
    assert_eq!(refined(&inside(Shape::Points { points: cloud, radius: 0.05 }), 3, flat), [(1, 1)]);
}

#[test]
fn surfaces_refine_what_they_cut_or_come_near() {
    // A wall across the plane at x = 1.5, from y = -9 to y = 1.5.
    let positions =
        [[1.5, -9.0, -1.0], [1.5, 1.5, -1.0], [1.5, 1.5, 1.0], [1.5, -9.0, 1.0]].map(Point::from).to_vec();
    let wall = |distance| Shape::Surface {
        positions: positions.clone(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        distance,
    };
    let flat = |x: f64, y: f64| [x, y, 0.0];
    assert_eq!(refined(&inside(wall(0.0)), 3, flat), [(1, 0), (1, 1)]);
    assert_eq!(refined(&inside(wall(0.4)), 3, flat), [(1, 0), (1, 1)]);
    let near = [(0, 0), (1, 0), (2, 0), (0, 1), (1, 1), (2, 1), (1, 2)];
    assert_eq!(refined(&inside(wall(0.55)), 3, flat), near, "past its end by a ball, not by a box");
}

#[test]
fn cylinders_stand_on_the_plane() {
    let stub = |z0: f64, z1: f64| Shape::Cylinder {
        from: [2.0, 2.0, z0].into(),
        to: [2.0, 2.0, z1].into(),
        radius: 0.9,
    };
    let flat = |x: f64, y: f64| [x, y, 0.0];
    let expected = [(1, 1), (2, 1), (1, 2), (2, 2)];
    for (z0, z1) in [(0.0, 3.0), (3.0, 0.0), (-3.0, 0.0), (-1.0, 1.0)] {
        assert_eq!(refined(&inside(stub(z0, z1)), 4, flat), expected);
    }
    assert_eq!(refined(&inside(stub(0.1, 3.0)), 4, flat), []);
    let lying = Shape::Cylinder { from: [-9.0, 1.5, 1.0].into(), to: [9.0, 1.5, 1.0].into(), radius: 1.0 };
    assert_eq!(refined(&inside(lying), 4, flat), [], "touches along a line");
}

#[test]
fn lengths_levels_and_the_edge_length() {
    let size = |size| Region { shape: sphere([0.0; 3], 1.0), target: Target::Size(size) };
    let unit = square(0.0, 0.0, 0.0, 1.0);
    assert!(field_of(&[size(0.9)], 2.0).wants(&unit));
    assert!(!field_of(&[size(1.0)], 2.0).wants(&unit), "not longer than its target");
    assert!(field_of(&[size(1e-300)], 2.0).wants(&unit));

    let level = |n| Region { shape: sphere([0.0; 3], 1.0), target: Target::Level(n) };
    let at = |level| SizedElement { level, ..unit };
    let field = field_of(&[level(2), level(0)], 2.0);
    assert_eq!([0, 1, 2].map(|l| field.wants(&at(l))), [true, true, false]);
    assert!(!field.is_idle_from(1) && field.is_idle_from(2));

    let field = field_of(&[size(0.5), size(0.25), level(3), size(2.0)], 2.0);
    assert_eq!(field.target(&unit), Demand { length: 0.25, level: 3 });
    assert_eq!(field.target(&square(5.0, 0.0, 0.0, 1.0)), Demand::NONE);
    assert!(!field.is_idle_from(200));

    let options = SizeOptions { edge_length: Some(0.1), curvature: None, gradation: 2.0, regions: &[] };
    let everywhere = SizeField::new(&PolygonMesh::default(), options).unwrap();
    assert!(!everywhere.wants(&square(0.1, 0.2, 0.0, 0.1)), "0.1 by another rounding");
    assert!(everywhere.wants(&square(0.1, 0.2, 0.0, 0.101)));
}

#[test]
fn sizes_grow_away_from_a_region_at_the_gradation() {
    let region = |shape| [Region { shape, target: Target::Size(0.1) }];
    let shapes = [
        sphere([0.0; 3], 1.0),
        cuboid([-1.0; 3], [1.0; 3]),
        Shape::Cylinder { from: [0.0, 0.0, -1.0].into(), to: [0.0, 0.0, 1.0].into(), radius: 1.0 },
        Shape::Points { points: vec![Point::ZERO], radius: 1.0 },
        Shape::Surface {
            positions: [[0.0, -5.0, -1.0], [0.0, 5.0, -1.0], [0.0, 0.0, 9.0]].map(Point::from).to_vec(),
            triangles: vec![[0, 1, 2]],
            distance: 1.0,
        },
    ];
    for shape in shapes {
        // Squares at x = 1 + d whose nearest points are at the middle of a side.
        let field = field_of(&region(shape.clone()), 1.25);
        for d in [0.1, 0.5, 2.0, 10.0] {
            let allowed = 0.1 + 0.25 * d;
            let at = |side: f64| square(1.0 + d, -side / 2.0, 0.0, side);
            assert!(!field.wants(&at(allowed * 0.999)), "{shape:?} at {d}");
            assert!(field.wants(&at(allowed * 1.01)), "{shape:?} at {d}");
        }
        assert!(field.wants(&square(0.0, 0.0, 0.0, 0.11)));
        assert!(!field_of(&region(shape), 2.0).wants(&square(1.1, -9.0, 0.0, 18.0)), "balance sees to it");
    }
}

#[test]
fn curvature_refines_faces_that_turn() {
    // Two squares meeting at 30 degrees: each turns 30 degrees over a length of 1.
    let (c, s) = (libm::cos(30f64.to_radians()), libm::sin(30f64.to_radians()));
    let points = [
        [0., 0., 0.],
        [1., 0., 0.],
        [1., 1., 0.],
        [0., 1., 0.],
        [1. + c, 0., s],
        [1. + c, 1., s],
        [5., 5., 5.],
        [6., 5., 5.],
        [5., 6., 5.],
    ];
    let mut mesh = PolygonMesh { positions: points.map(Point::from).to_vec(), ..Default::default() };
    for face in [[0, 1, 2, 3].as_slice(), &[1, 4, 5, 2], &[6, 7, 8]] {
        mesh.push_face(face.iter().map(|&n| crate::mesh::NodeId(n)));
    }
    let options = |curvature| SizeOptions { edge_length: None, curvature, gradation: 2.0, regions: &[] };
    let field = SizeField::new(&mesh, options(Some(10.0))).unwrap();
    assert!(!field.is_idle_from(50));
    let on = |root, side| SizedElement { root: FaceId(root), ..square(0.0, 0.0, 0.0, side) };
    assert!(field.wants(&on(0, 0.34)) && field.wants(&on(1, 0.34)));
    assert!(!field.wants(&on(0, 0.33)) && !field.wants(&on(2, 1e9)));
    mesh.offsets.truncate(2);
    mesh.corners.truncate(4);
    assert!(SizeField::new(&mesh, options(Some(10.0))).unwrap().is_idle_from(0), "a flat mesh");
}

#[test]
fn refuses_regions_that_make_no_sense() {
    let surface =
        |triangles, distance| Shape::Surface { positions: vec![Point::ZERO; 3], triangles, distance };
    let cylinder = |to: Point, radius| Shape::Cylinder { from: Point::ZERO, to, radius };
    let turned = |rotation| Shape::Box { min: Point::ZERO, max: Point::ONE, rotation };
    let cases = [
        (sphere([0.0, f64::NAN, 0.0], 1.0), "region-not-finite", "a coordinate of the centre is NaN"),
        (sphere([0.0; 3], 0.0), "region-not-positive", "the radius is 0; give a positive number"),
        (sphere([0.0; 3], f64::INFINITY), "region-not-finite", "the radius is inf"),
        (cuboid([0.0, 2.0, 0.0], [1.0; 3]), "region-min-above-max", "min y is 2, above max y, 1; swap them"),
        (cuboid([0.0; 3], [1.0, f64::INFINITY, 1.0]), "region-not-finite", "a coordinate of max is inf"),
        (turned(DQuat::from_xyzw(0.0, 0.0, 0.0, 2.0)), "region-rotation-invalid", "a quaternion of length 2"),
        (turned(DQuat::from_xyzw(0.0, 0.0, 0.0, f64::NAN)), "region-rotation-invalid", "length NaN"),
        (cylinder(Point::ZERO, 1.0), "region-without-axis", "from and to are the same point"),
        (cylinder(Point::Z, -1.0), "region-not-positive", "the radius is -1"),
        (Shape::Points { points: vec![], radius: 1.0 }, "region-without-points", "there are no points"),
        (
            Shape::Points { points: vec![Point::NAN], radius: 1.0 },
            "region-not-finite",
            "a coordinate of a point",
        ),
        (
            Shape::Points { points: vec![Point::ONE], radius: -1.0 },
            "region-negative",
            "the radius is -1; give 0 or more",
        ),
        (surface(vec![], 0.0), "region-without-triangles", "there are no triangles"),
        (
            surface(vec![[0, 1, 3]], 0.0),
            "region-node-out-of-range",
            "triangle 0 names node 3, but there are only 3",
        ),
        (surface(vec![[0, 1, 2]], f64::NAN), "region-not-finite", "the distance is NaN"),
    ];
    let good = Region { shape: sphere([0.0; 3], 1.0), target: Target::Level(1) };
    let try_one = |region: Region| {
        let regions = [good.clone(), region];
        let options = SizeOptions { edge_length: None, curvature: None, gradation: 2.0, regions: &regions };
        SizeField::new(&PolygonMesh::default(), options).unwrap_err()
    };
    for (shape, code, words) in cases {
        let error = try_one(Region { shape: shape.clone(), target: Target::Level(1) });
        assert_eq!(error.code(), code, "{error}");
        assert!(error.to_string().starts_with(&format!("region 2 ({}): ", shape.kind())), "{error}");
        assert!(error.to_string().contains(words), "{error}");
    }
    for size in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let error = try_one(Region { target: Target::Size(size), ..good.clone() });
        assert!(error.to_string().contains("the size is"), "{error}");
    }
}

#[test]
fn refuses_options_out_of_range() {
    let good = SizeOptions { edge_length: Some(1.0), curvature: Some(10.0), gradation: 1.5, regions: &[] };
    let code = |options| SizeField::new(&PolygonMesh::default(), options).map_err(|e| e.code()).err();
    assert_eq!(code(good), None);
    for value in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert_eq!(code(SizeOptions { edge_length: Some(value), ..good }), Some("edge-length-invalid"));
        assert_eq!(code(SizeOptions { curvature: Some(value), ..good }), Some("curvature-invalid"));
    }
    for gradation in [1.0, 2.1, f64::NAN] {
        assert_eq!(code(SizeOptions { gradation, ..good }), Some("gradation-out-of-range"));
    }
}

#[cfg(not(target_arch = "wasm32"))]
mod sampled {
    use super::*;
    use crate::geometry::{Ball, Cylinder, OrientedBox};
    use crate::sizing::zone::Zone;
    use proptest::prelude::*;

    fn coordinate() -> impl Strategy<Value = f64> {
        prop_oneof![-1.0..1.0f64, (-2i32..=2).prop_map(|i| f64::from(i) / 2.0)]
    }

    fn point() -> impl Strategy<Value = Point> {
        [coordinate(), coordinate(), coordinate()].prop_map(Point::from)
    }

    fn shapes() -> impl Strategy<Value = Shape> {
        prop_oneof![
            (point(), point(), point()).prop_map(|(a, b, turn)| Shape::Box {
                min: a.min(b),
                max: a.max(b),
                rotation: DQuat::from_scaled_axis(3.0 * turn),
            }),
            (point(), 0.01..1.0f64).prop_map(|(center, radius)| Shape::Sphere { center, radius }),
            (point(), point(), 0.01..1.0f64)
                .prop_filter("an axis", |(a, b, _)| a != b)
                .prop_map(|(from, to, radius)| Shape::Cylinder { from, to, radius }),
            (proptest::collection::vec(point(), 1..20), 0.0..0.5f64)
                .prop_map(|(points, radius)| Shape::Points { points, radius }),
            (proptest::collection::vec(point(), 3..20), 0.0..0.5f64).prop_map(|(positions, distance)| {
                let n = positions.len() as u32;
                Shape::Surface { positions, triangles: (2..n).map(|i| [0, i - 1, i]).collect(), distance }
            }),
        ]
    }

    /// Squares, trapezoids and warped quads of any orientation.
    fn elements() -> impl Strategy<Value = SizedElement> {
        (point(), point(), 0.05..1.0f64, 0.0..0.3f64, proptest::array::uniform4(point())).prop_map(
            |(at, turn, side, noise, shift)| {
                let turn = DQuat::from_scaled_axis(3.0 * turn);
                let corner = |k: usize| {
                    let flat = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]][k];
                    (at + side * (turn * Point::from(flat) + noise * shift[k])).to_array()
                };
                element([0, 1, 2, 3].map(corner))
            },
        )
    }

    /// The distance of a point from the shape, by the definition.
    fn distance(shape: &Shape, p: Point) -> f64 {
        match (Zone::new(shape).unwrap(), shape) {
            (Zone::Box(b), _) => OrientedBox::closest_point(&b, p).distance(p),
            (Zone::Ball(b), _) => Ball::closest_point(&b, p).distance(p),
            (Zone::Cylinder(c), _) => Cylinder::closest_point(&c, p).distance(p),
            (_, Shape::Points { points, radius }) => {
                (points.iter().map(|q| q.distance(p)).fold(f64::INFINITY, f64::min) - radius).max(0.0)
            }
            (_, Shape::Surface { positions, triangles, distance }) => {
                let corners = triangles.iter().map(|t| t.map(|n| positions[n as usize]));
                let nearest = corners
                    .map(|t| crate::geometry::Triangle(t).distance_squared(p))
                    .fold(f64::INFINITY, f64::min);
                (nearest.sqrt() - distance).max(0.0)
            }
            _ => unreachable!("zones are of their shape's kind"),
        }
    }

    /// Points all over the two triangles of an element, `n` steps along each side.
    fn samples(element: &SizedElement, n: u32) -> Vec<Point> {
        let [a, b, c, d] = element.corners;
        let fold = (b - a).cross(c - a).dot((c - a).cross(d - a)) < 0.0;
        let halves = if fold { [[a, b, d], [b, c, d]] } else { [[a, b, c], [a, c, d]] };
        let share = |i: u32| f64::from(i) / f64::from(n);
        let steps = || (0..=n).flat_map(move |i| (0..=n - i).map(move |j| (share(i), share(j))));
        halves
            .iter()
            .flat_map(|[a, b, c]| steps().map(move |(s, t)| *a + (*b - *a) * s + (*c - *a) * t))
            .collect()
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(256))]

        #[test]
        fn overlaps_are_what_samples_say(shape in shapes(), element in elements()) {
            let center = element.corners.iter().sum::<Point>() / 4.0;
            let wants = inside(shape.clone()).wants(&element);
            let points = samples(&element, 40);
            // Well inside the shrunk element and in the shape: overlap.
            let shrunk = points.iter().map(|p| center + (*p - center) * (1.0 - 2.0 * TOUCH));
            let hit = shrunk.into_iter().any(|p| distance(&shape, p) == 0.0);
            prop_assert!(wants || !hit, "missed");
            // Nowhere nearer than a touch and a sampling step: none.
            let nearest = points.iter().map(|p| distance(&shape, *p)).fold(f64::INFINITY, f64::min);
            prop_assert!(!wants || nearest < element.longest * (2.0 * TOUCH + 0.04), "found at {nearest}");
        }

        #[test]
        fn distances_are_what_samples_say(shape in shapes(), element in elements()) {
            let (size, growth) = (element.longest / 64.0, 0.5);
            let field = field_of(&[Region { shape: shape.clone(), target: Target::Size(size) }], 1.0 + growth);
            let asked = field.target(&element).length;
            let nearest = |points: &[Point]| points.iter().map(|p| distance(&shape, *p)).fold(f64::INFINITY, f64::min);
            let least = size + growth * nearest(&samples(&element, 40));
            let center = element.corners.iter().sum::<Point>() / 4.0;
            let [a, b, c, d] = element.corners;
            let most = match shape {
                Shape::Points { .. } | Shape::Surface { .. } => size + growth * nearest(&[a, b, c, d, center]),
                _ => least + growth * 0.1 * element.longest,
            };
            if asked.is_finite() {
                let (touch, step) = (2.0 * TOUCH * element.longest, growth * 0.04 * element.longest);
                prop_assert!(asked <= most + touch, "{asked} > {most}");
                prop_assert!(asked >= least - touch - step, "{asked} < {least}");
            } else {
                prop_assert!(most > element.longest, "nothing asked, {most} allowed");
            }
        }

        #[test]
        fn answers_do_not_depend_on_the_first_corner_or_the_side_seen(shape in shapes(), element in elements()) {
            // Far from a tie: a warped quad read from another corner is cut along its other diagonal.
            let normal = (element.corners[2] - element.corners[0]).cross(element.corners[3] - element.corners[1]);
            let flat = |p: Point| p - (p - element.corners[0]).project_onto(normal);
            let corners = element.corners.map(flat);
            let field = inside(shape);
            let answers = crate::mesh::numbering::quad::SYMMETRIES.map(|s| {
                field.wants(&SizedElement { corners: s.map(|k| corners[usize::from(k)]), ..element })
            });
            prop_assert!(answers.iter().all(|a| *a == answers[0]));
        }

        #[test]
        fn answers_do_not_depend_on_scale(shape in shapes(), element in elements(), power in -30i32..30) {
            let scale = 2f64.powi(power);
            let bigger = SizedElement { corners: element.corners.map(|p| p * scale), longest: element.longest * scale, ..element };
            let wants = inside(shape.clone()).wants(&element);
            prop_assert_eq!(wants, inside(scaled(shape, scale)).wants(&bigger));
        }
    }

    fn scaled(shape: Shape, s: f64) -> Shape {
        let all = |points: Vec<Point>| points.into_iter().map(|p| p * s).collect();
        match shape {
            Shape::Box { min, max, rotation } => Shape::Box { min: min * s, max: max * s, rotation },
            Shape::Sphere { center, radius } => Shape::Sphere { center: center * s, radius: radius * s },
            Shape::Cylinder { from, to, radius } => {
                Shape::Cylinder { from: from * s, to: to * s, radius: radius * s }
            }
            Shape::Points { points, radius } => Shape::Points { points: all(points), radius: radius * s },
            Shape::Surface { positions, triangles, distance } => {
                Shape::Surface { positions: all(positions), triangles, distance: distance * s }
            }
        }
    }
}
