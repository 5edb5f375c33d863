//! The rule of overlap: more than a touch, shapes of no thickness, samples, motions, subdivision.

use glam::DQuat;
use proptest::prelude::*;

use super::{Shape, children, distance, element, overlaps, square};
use crate::geometry::samples::{of_hull, point, points, rotation};
use crate::geometry::{Point, closest_on_segment};
use crate::sizing::overlap::TOUCH;

fn cuboid(min: [f64; 3], max: [f64; 3]) -> Shape {
    Shape::Box { min: min.into(), max: max.into(), rotation: DQuat::IDENTITY }
}

/// Which squares of a grid of 5 by 5, at height `z`, overlap the shape; rows from the top, as one reads.
fn picture(shape: &Shape, z: f64) -> [String; 5] {
    [4, 3, 2, 1, 0].map(|y| {
        let row = (0..5).map(|x| overlaps(shape, &square(f64::from(x), f64::from(y), z)));
        row.map(|hit| if hit { '#' } else { '.' }).collect()
    })
}

const CROSS_OF_FOUR: [&str; 5] = [".....", ".....", ".##..", ".##..", "....."];
const ONE: [&str; 5] = [".....", ".....", "..#..", ".....", "....."];
const NONE: [&str; 5] = ["....."; 5];

#[test]
fn faces_on_edges_leave_the_neighbours_alone() {
    assert_eq!(picture(&cuboid([2., 2., -1.], [3., 3., 1.]), 0.0), ONE);
    let nearly = TOUCH * 0.4;
    assert_eq!(picture(&cuboid([2. - nearly, 2. - nearly, -1.], [3. + nearly, 3. + nearly, 1.]), 0.0), ONE);
    let quarter_turned = Shape::Box {
        min: [2., 2., -1.].into(),
        max: [3., 3., 1.].into(),
        rotation: DQuat::from_xyzw(0., 0., 1., 1.),
    };
    assert_eq!(picture(&quarter_turned, 0.0), ONE);
}

#[test]
fn a_square_in_a_face_of_the_box_overlaps_it() {
    assert_eq!(picture(&cuboid([2., 2., 0.], [3., 3., 1.]), 0.0), ONE);
    assert_eq!(picture(&cuboid([2., 2., -1.], [3., 3., 0.]), 0.0), ONE);
    assert_eq!(picture(&cuboid([2., 2., 0.01], [3., 3., 1.]), 0.0), NONE);
}

#[test]
fn flat_shapes_refine_what_they_lie_in() {
    assert_eq!(picture(&cuboid([2., 2., 0.], [3., 3., 0.]), 0.0), ONE, "a rectangle in the plane");
    assert_eq!(picture(&cuboid([2.3, 2.1, -1.], [2.3, 2.9, 1.]), 0.0), ONE, "a wall across it");
    assert_eq!(picture(&cuboid([2.3, 2.6, 0.], [2.3, 2.6, 0.]), 0.0), ONE, "a point");
    assert_eq!(picture(&cuboid([2., 2., 0.], [2., 2., 0.]), 0.0), CROSS_OF_FOUR, "a node");
    let disc = Shape::Cylinder { from: [2.5, 2.5, 0.].into(), to: [2.5, 2.5, 0.].into(), radius: 0.1 };
    assert_eq!(picture(&disc, 0.0), ONE);
}

#[test]
fn points_without_radius_refine_what_holds_them() {
    let at = |x: f64, y: f64| Shape::Points { points: vec![[x, y, 0.].into()], radius: 0.0 };
    assert_eq!(picture(&at(2.4, 2.7), 0.0), ONE);
    assert_eq!(picture(&at(2., 2.), 0.0), CROSS_OF_FOUR);
    assert_eq!(picture(&at(2.5, 2.), 0.0), [".....", ".....", "..#..", "..#..", "....."]);
    assert_eq!(picture(&at(2.4, 2.7), 0.01), NONE);
}

#[test]
fn surfaces_without_distance_refine_what_touches_them() {
    let wall = |x: f64| Shape::Surface {
        positions: [[x, 2.2, -1.], [x, 2.8, -1.], [x, 2.5, 2.]].map(Point::from).to_vec(),
        triangles: vec![[0, 1, 2]],
        distance: 0.0,
    };
    assert_eq!(picture(&wall(2.5), 0.0), ONE);
    assert_eq!(picture(&wall(2.0), 0.0), [".....", ".....", ".##..", ".....", "....."]);
    let floor = Shape::Surface {
        positions: [[2.1, 2.1, 0.], [2.9, 2.1, 0.], [2.5, 2.9, 0.]].map(Point::from).to_vec(),
        triangles: vec![[0, 1, 2]],
        distance: 0.0,
    };
    assert_eq!(picture(&floor, 0.0), ONE, "in the plane of the squares");
}

#[test]
fn round_shapes_that_touch_an_edge_from_outside_do_not_overlap() {
    let ball = Shape::Sphere { center: [2.5, 2.5, 0.].into(), radius: 0.5 };
    assert_eq!(picture(&ball, 0.0), ONE);
    let pin = Shape::Cylinder { from: [2.5, 2.5, -1.].into(), to: [2.5, 2.5, 1.].into(), radius: 0.5 };
    assert_eq!(picture(&pin, 0.0), ONE);
    let lying = Shape::Cylinder { from: [2., 2.5, 0.].into(), to: [3., 2.5, 0.].into(), radius: 0.5 };
    assert_eq!(picture(&lying, 0.0), ONE);
}

#[test]
fn small_shapes_inside_a_large_square_overlap_it() {
    let large =
        element([[-1e3, -1e3, 0.], [1e3, -1e3, 0.], [1e3, 1e3, 0.], [-1e3, 1e3, 0.]].map(Point::from));
    let at = Point::new(123.0, 456.0, 0.0);
    let small = [
        Shape::Sphere { center: at, radius: 1e-6 },
        Shape::Box { min: at - 1e-6, max: at + 1e-6, rotation: DQuat::from_xyzw(0.5, 0.5, 0.5, 0.5) },
        Shape::Cylinder { from: at, to: at + Point::Z * 1e-6, radius: 1e-6 },
        Shape::Points { points: vec![at], radius: 1e-6 },
        Shape::Surface {
            positions: vec![at, at + Point::Z, at + 1e-6],
            triangles: vec![[0, 1, 2]],
            distance: 0.0,
        },
    ];
    for shape in small {
        assert!(overlaps(&shape, &large), "{shape:?}");
    }
}

#[test]
fn what_a_twisted_quad_encloses_overlaps_it() {
    let twisted = element([[0., 0., 0.], [1., 0., 1.], [1., 1., 0.], [0., 1., 1.]].map(Point::from));
    let inside = Point::new(0.5, 0.5, 0.5);
    let in_between = [
        Shape::Sphere { center: inside, radius: 0.05 },
        Shape::Box { min: inside - 0.05, max: inside + 0.05, rotation: DQuat::IDENTITY },
        Shape::Cylinder { from: inside - 0.05, to: inside + 0.05, radius: 0.05 },
    ];
    for shape in in_between {
        assert!(overlaps(&shape, &twisted), "{shape:?}");
    }
}

/// The shape made smaller by `by` on all sides, if it is thick enough.
fn eroded(shape: &Shape, by: f64) -> Option<Shape> {
    let mut smaller = shape.clone();
    let thick = match &mut smaller {
        Shape::Box { min, max, .. } => {
            (*min, *max) = (*min + by, *max - by);
            min.cmple(*max).all()
        }
        Shape::Cylinder { from, to, radius } => {
            let step = (*to - *from).normalize() * by;
            let long = from.distance(*to) > 2.0 * by;
            (*from, *to, *radius) = (*from + step, *to - step, *radius - by);
            long && *radius > 0.0
        }
        Shape::Sphere { radius, .. } | Shape::Points { radius, .. } => {
            *radius -= by;
            *radius > 0.0
        }
        Shape::Surface { distance, .. } => {
            *distance -= by;
            *distance > 0.0
        }
    };
    thick.then_some(smaller)
}

fn any_shape() -> impl Strategy<Value = Shape> {
    let radius = || 0.01..1.2_f64;
    prop_oneof![
        (point(1.5), point(1.0), rotation()).prop_map(|(middle, half, rotation)| Shape::Box {
            min: middle - half.abs(),
            max: middle + half.abs(),
            rotation,
        }),
        (point(1.5), radius()).prop_map(|(center, radius)| Shape::Sphere { center, radius }),
        (points::<2>(1.5), radius()).prop_map(|([from, to], radius)| Shape::Cylinder { from, to, radius }),
        (points::<5>(2.0), 0.0..0.5_f64)
            .prop_map(|(points, radius)| Shape::Points { points: points.to_vec(), radius }),
        (points::<6>(2.0), 0.0..0.5_f64).prop_map(|(positions, distance)| Shape::Surface {
            positions: positions.to_vec(),
            triangles: vec![[0, 1, 2], [3, 4, 5]],
            distance,
        }),
    ]
}

/// Flat quads, twisted quads, quads of any shape.
fn any_quad() -> impl Strategy<Value = [Point; 4]> {
    let convex = (points::<3>(1.0), 0.2..1.0_f64, 0.2..1.0_f64)
        .prop_map(|([a, u, v], s, t)| [a, a + u, a + u * (0.4 + s) + v * (0.4 + t), a + v]);
    prop_oneof![convex, points::<4>(1.0)]
}

/// The shape moved by `rotation` about the origin, then by `step`.
fn moved(shape: &Shape, rotation: DQuat, step: Point) -> Shape {
    let go = |p: Point| rotation * p + step;
    match shape {
        Shape::Box { min, max, rotation: own } => {
            let (middle, half) = (go(min.midpoint(*max)), (*max - *min) * 0.5);
            Shape::Box { min: middle - half, max: middle + half, rotation: rotation * *own }
        }
        Shape::Sphere { center, radius } => Shape::Sphere { center: go(*center), radius: *radius },
        Shape::Cylinder { from, to, radius } => {
            Shape::Cylinder { from: go(*from), to: go(*to), radius: *radius }
        }
        Shape::Points { points, radius } => {
            Shape::Points { points: points.iter().map(|&p| go(p)).collect(), radius: *radius }
        }
        Shape::Surface { positions, triangles, distance } => Shape::Surface {
            positions: positions.iter().map(|&p| go(p)).collect(),
            triangles: triangles.clone(),
            distance: *distance,
        },
    }
}

/// Samples along each edge of the element and over its hull.
const STEPS: u32 = 20;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1500))]

    #[test]
    fn elements_with_a_sample_inside_are_wanted(shape in any_shape(), corners in any_quad()) {
        let element = element(corners);
        // Shrinking moves no point of the element farther than this.
        let margin = 2.0 * TOUCH * element.longest;
        let inside = eroded(&shape, margin)
            .is_some_and(|smaller| of_hull(corners, STEPS).any(|s| distance(&smaller, s) == 0.0));
        prop_assert!(!inside || overlaps(&shape, &element));
    }

    #[test]
    fn wanted_elements_have_samples_near_the_shape(shape in any_shape(), corners in any_quad()) {
        let element = element(corners);
        let nearest = of_hull(corners, STEPS).map(|s| distance(&shape, s)).fold(f64::INFINITY, f64::min);
        // As far as a point of the hull can be from the samples: the diagonals are at most twice the longest edge.
        let spacing = 2.0 * element.longest / f64::from(STEPS);
        prop_assert!(nearest <= spacing || !overlaps(&shape, &element), "the nearest sample is at {nearest}");
    }

    #[test]
    fn motions_change_nothing(
        shape in any_shape(), corners in any_quad(), turn in rotation(), step in point(100.0),
    ) {
        let before = overlaps(&shape, &element(corners));
        let after = overlaps(&moved(&shape, turn, step), &element(corners.map(|p| turn * p + step)));
        prop_assert_eq!(before, after);
    }

    #[test]
    fn the_order_of_the_corners_changes_nothing(shape in any_shape(), corners in any_quad()) {
        let [a, b, c, d] = corners;
        let expected = overlaps(&shape, &element(corners));
        for other in [[b, c, d, a], [c, d, a, b], [d, c, b, a]] {
            prop_assert_eq!(expected, overlaps(&shape, &element(other)));
        }
    }

    #[test]
    fn if_a_child_is_wanted_so_is_its_parent(shape in any_shape(), corners in any_quad()) {
        let parent = element(corners);
        let wanted = overlaps(&shape, &parent);
        // Smaller elements shrink by less: what is a touch of the parent can be more than one of a child.
        let Some(smaller) = eroded(&shape, 2.0 * TOUCH * parent.longest) else { return Ok(()) };
        for child in children(&parent) {
            prop_assert!(wanted || !overlaps(&smaller, &child));
            for grandchild in children(&child) {
                prop_assert!(wanted || !overlaps(&smaller, &grandchild));
            }
        }
    }

    #[test]
    fn a_long_thin_cylinder_is_its_axis(ends in points::<2>(2.0), corners in any_quad()) {
        let shape = Shape::Cylinder { from: ends[0], to: ends[1], radius: 1e-9 };
        let hit = overlaps(&shape, &element(corners));
        let spacing = 2.0 * element(corners).longest / f64::from(STEPS);
        let near = of_hull(corners, STEPS).any(|s| closest_on_segment(s, ends).distance(s) <= spacing);
        prop_assert!(near || !hit);
    }
}
