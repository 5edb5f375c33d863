//! Options and regions that are refused.

use glam::DQuat;

use super::{OPTIONS, Region, Shape, SizeField, SizeOptions, Target, one_face, square};
use crate::Silent;
use crate::geometry::Point;

fn refusal(options: SizeOptions<'_>) -> (&'static str, String) {
    let mesh = one_face(square(0.0, 0.0, 0.0).corners);
    let error = SizeField::new(&mesh, options, &Silent).expect_err("options out of range");
    (error.code(), error.to_string())
}

fn check(options: SizeOptions<'_>, code: &str, words: &[&str]) {
    let (found, message) = refusal(options);
    assert_eq!(found, code, "{message}");
    for word in words {
        assert!(message.contains(word), "'{word}' is missing in: {message}");
    }
}

#[test]
fn options_out_of_range() {
    for length in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let options = SizeOptions { edge_length: Some(length), ..OPTIONS };
        check(options, "edge-length-out-of-range", &[&length.to_string(), "positive"]);
    }
    for angle in [0.0, -5.0, 180.5, f64::NAN] {
        let options = SizeOptions { curvature: Some(angle), ..OPTIONS };
        check(options, "curvature-out-of-range", &[&angle.to_string(), "180"]);
    }
    for gradation in [1.0, 0.5, 2.1, f64::NAN, f64::INFINITY] {
        let options = SizeOptions { gradation, ..OPTIONS };
        check(options, "gradation-out-of-range", &[&gradation.to_string(), "at most 2"]);
    }
}

#[test]
fn regions_out_of_range() {
    let nan = Point::new(0.0, f64::NAN, 0.0);
    let turned = |rotation| Shape::Box { min: Point::ZERO, max: Point::ONE, rotation };
    let surface = |triangles| Shape::Surface { positions: vec![Point::ZERO; 3], triangles, distance: 0.0 };
    let cases = [
        (Shape::Sphere { center: nan, radius: 1.0 }, "region-not-finite", "center"),
        (Shape::Sphere { center: Point::ZERO, radius: 0.0 }, "region-radius-out-of-range", "radius is 0"),
        (Shape::Sphere { center: Point::ZERO, radius: f64::INFINITY }, "region-radius-out-of-range", "inf"),
        (Shape::Cylinder { from: Point::ZERO, to: nan, radius: 1.0 }, "region-not-finite", "to has"),
        (
            Shape::Cylinder { from: Point::ZERO, to: Point::X, radius: -2.0 },
            "region-radius-out-of-range",
            "-2",
        ),
        (
            Shape::Box { min: Point::ONE, max: Point::ZERO, rotation: DQuat::IDENTITY },
            "region-box-inverted",
            "lesser coordinates",
        ),
        (turned(DQuat::from_xyzw(0.0, 0.0, 0.0, 0.0)), "region-rotation-invalid", "[0, 0, 0, 1]"),
        (turned(DQuat::from_xyzw(0.0, f64::NAN, 0.0, 1.0)), "region-rotation-invalid", "NaN"),
        (Shape::Points { points: vec![], radius: 1.0 }, "region-empty", "no points"),
        (Shape::Points { points: vec![nan], radius: 1.0 }, "region-not-finite", "points"),
        (Shape::Points { points: vec![Point::ZERO], radius: -1.0 }, "region-radius-out-of-range", "-1"),
        (surface(vec![]), "region-empty", "no triangles"),
        (
            surface(vec![[0, 1, 2], [0, 3, 1]]),
            "region-index-out-of-range",
            "triangle 1 (counted from 0) has the node 3",
        ),
    ];
    let sound =
        Region { shape: Shape::Sphere { center: Point::ZERO, radius: 1.0 }, target: Target::Level(1) };
    for (shape, code, word) in cases {
        let regions = [sound.clone(), Region { shape, target: Target::Level(1) }];
        check(SizeOptions { regions: &regions, ..OPTIONS }, code, &["region 1", word]);
    }
    for size in [0.0, -1.0, f64::NAN] {
        let regions = [Region { target: Target::Size(size), ..sound.clone() }];
        check(
            SizeOptions { regions: &regions, ..OPTIONS },
            "region-size-out-of-range",
            &["region 0", "size"],
        );
    }
}

#[test]
fn quaternions_of_any_length_are_turns() {
    let mesh = one_face(square(0.0, 0.0, 0.0).corners);
    for length in [1e-200, 0.999, 1e200] {
        let rotation = DQuat::from_xyzw(0.0, 0.0, length, length);
        let shape = Shape::Box { min: Point::new(-3.0, 0.4, -1.0), max: Point::new(3.0, 0.6, 1.0), rotation };
        let field = super::field(&mesh, &[Region { shape, target: Target::Level(1) }], 2.0);
        assert!(field.wants(&square(-0.5, 2.0, 0.0)), "a quarter turn stands the bar up");
        assert!(!field.wants(&square(2.0, 0.0, 0.0)));
    }
}
