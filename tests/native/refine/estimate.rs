//! Estimates against the results that they foretell.

use hexmill::geometry::Point;
use hexmill::mesh::PolygonMesh;
use hexmill::refine::{QuadOptions, RefineError, estimate_quads, refine_quads};
use hexmill::sizing::{Region, Shape, Target};
use hexmill::{Cancelled, Silent};

use super::results::StopAt;
use super::worlds::{cube, grid, mixed_strip};

fn sphere(center: [f64; 3], radius: f64, target: Target) -> Region {
    Region { shape: Shape::Sphere { center: Point::from(center), radius }, target }
}

/// The estimate's quads over the result's.
fn ratio(input: &PolygonMesh, options: &QuadOptions) -> f64 {
    let estimate = estimate_quads(input, options, &Silent).expect("valid input");
    let refined = refine_quads(input, options, &Silent).expect("valid input");
    assert_eq!(estimate.levels, *refined.level.iter().max().unwrap());
    if estimate.exact {
        assert_eq!(estimate.nodes, refined.mesh.positions.len() as u64);
    }
    estimate.quads as f64 / refined.mesh.quads.len() as f64
}

#[test]
fn small_results_are_counted_exactly() {
    for input in [cube(), grid(3, 2), mixed_strip()] {
        let options = QuadOptions {
            regions: vec![sphere([0.5, 0.5, 0.0], 0.6, Target::Level(4))],
            ..QuadOptions::default()
        };
        assert_eq!(ratio(&input, &options), 1.0);
        assert_eq!(ratio(&input, &QuadOptions::default()), 1.0);
    }
}

#[test]
fn uniform_results_are_foretold_exactly() {
    for keep_coarse in [false, true] {
        let options = QuadOptions { levels: Some(5), keep_coarse, ..QuadOptions::default() };
        assert_eq!(ratio(&grid(20, 17), &options), 1.0);
    }
}

#[test]
fn large_adaptive_results_are_foretold_within_15_percent() {
    let by_level = sphere([10.0, 9.0, 0.0], 6.0, Target::Level(6));
    let by_size = sphere([10.0, 9.0, 0.0], 6.0, Target::Size(0.02));
    for region in [by_level, by_size] {
        let options = QuadOptions { regions: vec![region], ..QuadOptions::default() };
        let ratio = ratio(&grid(20, 17), &options);
        assert!((0.85..1.15).contains(&ratio), "estimate over result: {ratio}");
    }
}

/// Meshes of more faces than are sampled, with regions that follow one column of them.
#[test]
fn patterns_in_the_order_of_faces_do_not_mislead() {
    for column in 0..3 {
        let x = f64::from(column);
        let shape = Shape::Box {
            min: Point::new(x + 0.1, 0.0, 0.0),
            max: Point::new(x + 0.9, 200.0, 0.0),
            rotation: Default::default(),
        };
        let regions = vec![Region { shape, target: Target::Level(5) }];
        let options = QuadOptions { regions, ..QuadOptions::default() };
        let ratio = ratio(&grid(200, 200), &options);
        assert!((0.85..1.1).contains(&ratio), "estimate over result: {ratio} in column {column}");
    }
}

#[test]
fn an_absurd_request_is_estimated_at_once_and_refused_before_it_is_made() {
    let options = QuadOptions { edge_length: Some(1e-8), max_levels: 27, ..QuadOptions::default() };
    let estimate = estimate_quads(&grid(20, 20), &options, &Silent).expect("an estimate");
    assert!(estimate.quads > 1_000_000_000_000_000 && !estimate.exact);
    let refusal = refine_quads(&grid(20, 20), &options, &Silent).expect_err("too large");
    assert!(matches!(refusal, RefineError::TooManyQuads { limit: 64_000_000, .. }), "{refusal}");
    assert_eq!(refusal.code(), "too-many-quads");
}

#[test]
fn an_estimate_can_be_cancelled_anywhere() {
    let region = sphere([10.0, 9.0, 0.0], 6.0, Target::Level(9));
    let options = QuadOptions { regions: vec![region], ..QuadOptions::default() };
    // At every question at first, then further apart.
    let (mut stopped, mut call) = (0, 0);
    loop {
        match estimate_quads(&grid(60, 60), &options, &StopAt::call(call)) {
            Err(error) => {
                assert_eq!(error, RefineError::Cancelled(Cancelled));
                stopped += 1;
                call += 1 + call / 8;
            }
            Ok(estimate) => {
                assert!(!estimate.exact, "a sample was to be followed");
                break;
            }
        }
    }
    assert!(stopped > 40, "asked only {stopped} times");
}

#[test]
fn regions_that_meet_nothing_are_told() {
    let near = |k: u32| sphere([f64::from(k % 4), 1.0, 0.0], 0.3, Target::Level(2));
    let far = |k: u32| sphere([f64::from(k), 1.0, 9.0], 0.3, Target::Size(0.1));
    // The last one touches the grid from outside.
    let beside = Region {
        shape: Shape::Box {
            min: Point::new(4.0, 0.0, -1.0),
            max: Point::new(5.0, 2.0, 1.0),
            rotation: Default::default(),
        },
        target: Target::Level(3),
    };
    for count in [2, 20] {
        let mut regions: Vec<Region> = (0..count).flat_map(|k| [near(k), far(k)]).collect();
        regions.push(beside.clone());
        let options = QuadOptions { regions, ..QuadOptions::default() };
        let idle = estimate_quads(&grid(4, 2), &options, &Silent).expect("valid input").idle_regions;
        let expected: Vec<u32> = (0..count).map(|k| 2 * k + 1).chain([2 * count]).collect();
        assert_eq!(idle, expected);
    }
}
