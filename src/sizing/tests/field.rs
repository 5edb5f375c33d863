//! Targets, grading, and where nothing is left to do.

use proptest::prelude::*;

use super::{
    OPTIONS, Region, Shape, SizeField, SizeOptions, SizedElement, Target, children, distance, element, field,
    one_face, square,
};
use crate::Silent;
use crate::geometry::Point;
use crate::geometry::samples::{of_hull, point, points, rotation};

fn ball(target: Target) -> Region {
    Region { shape: Shape::Sphere { center: Point::new(0.5, 0.5, 0.0), radius: 0.1 }, target }
}

#[test]
fn sizes_and_levels_are_reached_not_passed() {
    let unit = square(0.0, 0.0, 0.0);
    let mesh = one_face(unit.corners);
    let wants = |target, element: &SizedElement| field(&mesh, &[ball(target)], 2.0).wants(element);
    assert!(
        wants(Target::Size(0.99), &unit) && !wants(Target::Size(1.0), &unit),
        "an edge as long as its target stays"
    );
    assert!(wants(Target::Level(1), &unit) && !wants(Target::Level(0), &unit));
    assert!(!wants(Target::Level(3), &SizedElement { level: 3, ..unit }));
    assert!(wants(Target::Level(3), &SizedElement { level: 2, ..unit }));
    let everywhere =
        SizeField::new(&mesh, SizeOptions { edge_length: Some(0.5), ..OPTIONS }, &Silent).unwrap();
    assert!(everywhere.wants(&unit) && !everywhere.wants(&children(&unit)[0]));
}

#[test]
fn rounding_makes_no_edge_too_long() {
    let corners = [[0.2, 0.2], [0.3, 0.2], [0.3, 0.3], [0.2, 0.3]].map(|[x, y]| Point::new(x, y, 0.0));
    let element = element(corners);
    let rounded = std::hint::black_box(0.8) - 0.7;
    assert!(rounded > 0.1 && rounded < 0.100_000_001, "{rounded}");
    let long = SizedElement { longest: rounded, ..element };
    let global =
        SizeField::new(&one_face(corners), SizeOptions { edge_length: Some(0.1), ..OPTIONS }, &Silent)
            .unwrap();
    assert!(!global.wants(&long));
    let region =
        Region { shape: Shape::Sphere { center: corners[0], radius: 1.0 }, target: Target::Size(0.1) };
    assert!(!field(&one_face(corners), &[region], 2.0).wants(&long));
}

#[test]
fn sizes_grow_away_from_a_region() {
    // Target 0.25 at x <= 0; at distance d it is 0.25 + 0.5 d, so unit squares are too long up to d = 1.5.
    let shape = Shape::Box {
        min: Point::splat(-1.0),
        max: Point::new(0.0, 1.0, 1.0),
        rotation: glam::DQuat::IDENTITY,
    };
    let region = Region { shape, target: Target::Size(0.25) };
    let at = |x: f64| square(x, 0.0, 0.0);
    let mesh = one_face(at(0.0).corners);
    let steady = field(&mesh, std::slice::from_ref(&region), 1.5);
    assert!(steady.wants(&at(1.49)) && !steady.wants(&at(1.51)));
    let by_balance = field(&mesh, &[region], 2.0);
    assert!(by_balance.wants(&at(-0.5)) && !by_balance.wants(&at(0.01)));
}

#[test]
fn idle_where_all_targets_are_met() {
    let unit = square(0.0, 0.0, 0.0);
    let mesh = one_face(unit.corners);
    let idle = |options: SizeOptions<'_>| -> Vec<bool> {
        let field = SizeField::new(&mesh, options, &Silent).unwrap();
        (0..6).map(|level| field.is_idle_from(level)).collect()
    };
    assert_eq!(idle(OPTIONS), [true; 6]);
    let from = |first: usize| (0..6).map(|level| level >= first).collect::<Vec<_>>();
    assert_eq!(idle(SizeOptions { edge_length: Some(0.25), ..OPTIONS }), from(2));
    assert_eq!(idle(SizeOptions { edge_length: Some(0.24), ..OPTIONS }), from(3));
    assert_eq!(idle(SizeOptions { curvature: Some(10.0), ..OPTIONS }), from(0), "flat");
    assert_eq!(idle(SizeOptions { regions: &[ball(Target::Level(4))], ..OPTIONS }), from(4));
    let both = [ball(Target::Level(1)), ball(Target::Size(0.1))];
    assert_eq!(idle(SizeOptions { regions: &both, ..OPTIONS }), from(4));
}

#[test]
fn a_polygon_of_many_sides_has_children_longer_than_its_edges() {
    let mut mesh = crate::mesh::PolygonMesh::default();
    let n = 64;
    for k in 0..n {
        let angle = std::f64::consts::TAU * f64::from(k) / f64::from(n);
        mesh.positions.push(Point::new(angle.cos(), angle.sin(), 0.0));
    }
    mesh.push_face((0..n).map(crate::mesh::NodeId));
    let field = SizeField::new(&mesh, SizeOptions { edge_length: Some(0.4), ..OPTIONS }, &Silent).unwrap();
    assert!(!field.is_idle_from(1) && !field.is_idle_from(2) && field.is_idle_from(3));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(600))]

    #[test]
    fn graded_sizes_agree_with_sampled_distances(
        corners in points::<4>(1.0), middle in point(3.0), half in point(0.5), turn in rotation(),
        round: bool, size in 0.05..1.0_f64, gradation in 1.1..1.95_f64,
    ) {
        let half = half.abs();
        let shape = if round {
            let up = turn * Point::Z * (half.z + 0.01);
            Shape::Cylinder { from: middle - up, to: middle + up, radius: half.x + 0.01 }
        } else {
            Shape::Box { min: middle - half, max: middle + half, rotation: turn }
        };
        let element = element(corners);
        let gaps = of_hull(corners, 20).map(|p| distance(&shape, p));
        let distance = gaps.fold(f64::INFINITY, f64::min);
        let field = field(&one_face(corners), &[Region { shape, target: Target::Size(size) }], gradation);
        let wanted = field.wants(&element);
        let target_at = |d: f64| size + (gradation - 1.0) * d;
        let slack = 0.01 * element.longest;
        if element.longest > target_at(distance) + slack {
            prop_assert!(wanted, "at {distance}");
        }
        if element.longest < target_at((distance - 2.0 * element.longest / 20.0).max(0.0)) - slack {
            prop_assert!(!wanted, "at {distance}");
        }
    }

    #[test]
    fn many_regions_are_as_many_fields(
        corners in points::<4>(1.0), centers in points::<40>(4.0), level: bool, gradation in 1.2..2.0_f64,
    ) {
        let mesh = one_face(corners);
        let target = if level { Target::Level(3) } else { Target::Size(0.4) };
        let region = |&center: &Point| Region { shape: Shape::Sphere { center, radius: 0.3 }, target };
        let regions: Vec<Region> = centers.iter().map(region).collect();
        let element = element(corners);
        let one_by_one = regions.chunks(1).any(|one| field(&mesh, one, gradation).wants(&element));
        prop_assert_eq!(field(&mesh, &regions, gradation).wants(&element), one_by_one);
    }

    #[test]
    fn idle_means_that_nothing_is_wanted(corners in points::<4>(1.0), size in 0.05..1.0_f64, picks in prop::collection::vec(0_usize..4, 6)) {
        let mesh = one_face(corners);
        let field = SizeField::new(&mesh, SizeOptions { edge_length: Some(size), ..OPTIONS }, &Silent).unwrap();
        let mut at = element(corners);
        for pick in picks {
            at = children(&at)[pick];
            prop_assert!(!(field.is_idle_from(at.level) && field.wants(&at)));
        }
    }
}
