//! What cannot be reckoned with, or would be too large, is told before the work.

use std::sync::atomic::{AtomicUsize, Ordering};

use hexmill::geometry::Point;
use hexmill::mesh::{HexMesh, check_hexes};
use hexmill::refine::hex::{HexOptions, HexPlan, HexRefineError, Method, refine_hexes};
use hexmill::sizing::{Region, Shape, Target};
use hexmill::{Monitor, Silent, Stage};

use super::acceptance::block;
use super::meshes::cubes;

/// Cubes of this size, this far along all axes.
fn placed(scale: f64, offset: f64) -> HexMesh {
    let mut mesh = cubes(4);
    mesh.positions.iter_mut().for_each(|p| *p = *p * scale + Point::splat(offset));
    mesh
}

fn options(method: Method, regions: Vec<Region>) -> HexOptions {
    HexOptions { method, regions, max_levels: 20, ..HexOptions::default() }
}

#[test]
fn sizes_and_offsets_beyond_the_digits_are_told() {
    for (scale, offset, code, words) in [
        (1e200, 0.0, "mesh-extent", "the mesh measures 6.9"),
        (1e-200, 0.0, "mesh-extent", "sizes from 1e-60 to 1e60 can be refined: scale the mesh"),
        (1.0, 1e80, "mesh-extent", "reaches 1e80 from the origin"),
        (1.0, 1e16, "too-few-digits", "edges of level 0 would be at most 2e0 long"),
        (1e-20, 1.0, "too-few-digits", "move the mesh towards the origin"),
    ] {
        let error = refine_hexes(&placed(scale, offset), &HexOptions::default(), &Silent).unwrap_err();
        assert_eq!(error.code(), code, "{error}");
        assert!(error.to_string().contains(words), "{error}");
    }
}

#[test]
fn sizes_within_the_limits_are_refined_alike() {
    for method in [Method::One, Method::Two, Method::Three, Method::Auto] {
        let made = |scale: f64| {
            let region = block([1.1 * scale; 3], [1.9 * scale; 3], 1);
            let refined = refine_hexes(&placed(scale, 0.0), &options(method, vec![region]), &Silent);
            let refined = refined.unwrap_or_else(|error| panic!("{scale:e} {method:?}: {error}"));
            assert!(check_hexes(&refined.mesh).is_empty(), "{scale:e} {method:?}");
            refined.mesh.hexes
        };
        let expected = made(1.0);
        for scale in [1e-60, 1e-50, 1e50, 1e59] {
            assert_eq!(made(scale), expected, "{scale:e} {method:?}");
        }
    }
}

#[test]
fn levels_beyond_the_digits_are_told() {
    let region = block([1e12 + 0.1; 3], [1e12 + 0.10001; 3], 20);
    let error = refine_hexes(&placed(1.0, 1e12), &options(Method::Auto, vec![region]), &Silent).unwrap_err();
    assert!(matches!(error, HexRefineError::TooFewDigits { level: 7, longest: 0.007_812_5, .. }), "{error}");
}

/// Counts how many levels are asked for.
struct Levels(AtomicUsize);

impl Monitor for Levels {
    fn progress(&self, stage: Stage, _: f64) {
        self.0.fetch_add(usize::from(stage.0 == "refine"), Ordering::Relaxed);
    }
    fn cancelled(&self) -> bool {
        false
    }
}

#[test]
fn more_hexes_than_the_limit_are_told_before_they_are_made() {
    let ball = Shape::Sphere { center: Point::splat(2.0), radius: 1.9 };
    let all = Shape::Sphere { center: Point::splat(2.0), radius: 9.0 };
    let surface = Shape::Surface {
        positions: vec![Point::ZERO, Point::X * 4.0, Point::Y * 4.0],
        triangles: vec![[0, 1, 2]],
        distance: 1.2,
    };
    let points = Shape::Points { points: vec![Point::splat(2.0)], radius: 1.9 };
    for method in [Method::One, Method::Two, Method::Three, Method::Auto] {
        let most = if method == Method::Three { 6 } else { 8 };
        for shape in [&ball, &all, &surface, &points] {
            for target in [Target::Level(30), Target::Size(1e-9)] {
                let options = options(method, vec![Region { shape: shape.clone(), target }]);
                let levels = Levels(AtomicUsize::new(0));
                let error = HexPlan::new(&cubes(4), &options, &levels).map(drop).unwrap_err();
                assert!(
                    matches!(error, HexRefineError::TooManyHexes { level, hexes, limit } if level <= most && hexes > limit),
                    "{error}"
                );
                let levels = levels.0.into_inner();
                assert!(levels <= 2, "{method:?} {shape:?} {target:?}: {levels} levels");
            }
        }
        let everywhere = HexOptions { levels: Some(20), ..options(method, Vec::new()) };
        let fine = HexOptions { edge_length: Some(1e-9), ..options(method, Vec::new()) };
        for options in [everywhere, fine] {
            let levels = Levels(AtomicUsize::new(0));
            let error = HexPlan::new(&cubes(4), &options, &levels).map(drop).unwrap_err();
            assert_eq!((error.code(), levels.0.into_inner()), ("too-many-hexes", 1));
        }
    }
}
