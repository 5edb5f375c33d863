//! The worlds of `acceptance`: all random sets, of one level and of two, all stars of octants, all sets on the beam, and the
//! named worlds as fine as is quick; `examples/acceptance.rs` tells more of them, and has the named ones in full.

use hexmill::refine::hex::{Added, Method};
use rayon::prelude::*;

use super::acceptance::{
    Boundary, MOST_GROWTH, World, block, judged, named, octants, random_on_beam, random_set, warped,
};
use super::meshes::i_beam;

const BOTH: [Method; 2] = [Method::One, Method::Two];

/// Refines the worlds with a method; returns the sum of what was refined besides what was asked for, and how much the refined
/// sets grew in the mean.
fn accept(method: Method, worlds: &[World]) -> (Added, f64) {
    let of_world = |world: &World| {
        let found = judged(world, method);
        println!(
            "{}, {method:?}: {} hexes, worst {:.3}, mean {:.3}",
            world.name,
            found.refined.level.len(),
            found.worst,
            found.mean
        );
        let least = world.least[usize::from(method == Method::Two)];
        assert!(found.worst >= least, "{}, {method:?}: {}", world.name, found.worst);
        (found.refined.added, found.growth())
    };
    let found: Vec<(Added, f64)> = worlds.par_iter().map(of_world).collect();
    let mut sum = Added::default();
    for (added, _) in &found {
        sum.closure.method += added.closure.method;
        sum.conflicts += added.conflicts;
        sum.repairs += added.repairs;
    }
    (sum, found.iter().map(|(_, growth)| growth).sum::<f64>() / found.len() as f64)
}

/// All random sets of so many levels.
fn random_sets(method: Method, levels: u8) {
    let worlds: Vec<World> = (0..100).map(|seed| random_set(4, seed, 100, levels)).collect();
    let (added, growth) = accept(method, &worlds);
    if method == Method::One {
        assert!(added.closure.method > 0, "Method I fills up");
    } else {
        assert_eq!(added.closure.method, 0);
        assert!(growth <= MOST_GROWTH, "{growth}");
    }
}

#[test]
fn random_sets_of_one_level_by_method_one() {
    random_sets(Method::One, 1);
}

#[test]
fn random_sets_of_one_level_by_method_two() {
    random_sets(Method::Two, 1);
}

#[test]
fn random_sets_of_two_levels_by_method_one() {
    random_sets(Method::One, 2);
}

#[test]
fn random_sets_of_two_levels_by_method_two() {
    random_sets(Method::Two, 2);
}

/// All sets of octants around a node, but none and all.
fn stars(method: Method) -> Added {
    let worlds: Vec<World> = (1..255).map(octants).collect();
    accept(method, &worlds).0
}

#[test]
fn octants_around_a_node_by_method_one() {
    stars(Method::One);
}

#[test]
fn octants_around_a_node_by_method_two() {
    let added = stars(Method::Two);
    assert!(added.conflicts > 0, "some cannot be separated");
    assert_eq!(added.repairs, 0);
}

fn on_the_beam(method: Method) -> Added {
    let worlds: Vec<World> = (0..40).map(|seed| random_on_beam(seed, 40)).collect();
    accept(method, &worlds).0
}

#[test]
fn random_sets_on_the_beam_by_method_one() {
    let added = on_the_beam(Method::One);
    assert_eq!((added.conflicts, added.repairs), (0, 0));
}

#[test]
fn random_sets_on_the_beam_by_method_two() {
    let added = on_the_beam(Method::Two);
    assert_eq!(added.closure.method, 0);
    assert!(added.conflicts > 0);
}

#[test]
fn nothing_is_added_at_the_foot_of_the_web() {
    // One cell of the beam's web or flange beside the foot of the web: the interface runs along an inner ridge that is the
    // coarse side's beyond the end of the run, so that the refined side leaves it, along the interface's own plane.
    let beside = [[1.0, 0.0], [3.0, 0.0], [2.0, 1.0]];
    let worlds = beside.into_iter().flat_map(|[x, y]| {
        [6.0, 7.0].map(|z| {
            let regions = [[2.0, 0.0, z], [x, y, z]].map(|at| block(at, at.map(|x| x + 1.0), 2)).into();
            let (name, least) = (format!("foot of the web and {x} {y} {z}"), [0.43, 0.25]);
            World { name, input: i_beam(), regions, boundary: Boundary::Planar, least }
        })
    });
    let (added, _) = accept(Method::Two, &worlds.collect::<Vec<_>>());
    assert_eq!((added.conflicts, added.repairs), (0, 0));
}

#[test]
fn more_is_refined_where_neither_side_can_leave_a_ridge() {
    // Along the beam's inner ridge the refined set is the web and the flange below it, then all around the ridge: beyond
    // one end of the run the ridge is the coarse side's, beyond the other the refined side's.
    let cells = [[2.0, 0.0, 4.0], [2.0, 1.0, 4.0], [2.0, 0.0, 5.0], [2.0, 1.0, 5.0], [1.0, 0.0, 5.0]];
    let regions = cells.map(|at| block(at, at.map(|x| x + 1.0), 2)).into();
    let least = [0.43, 0.20];
    let world = World { name: "ridge".into(), input: i_beam(), regions, boundary: Boundary::Planar, least };
    let (added, _) = accept(Method::Two, &[world]);
    assert!(added.conflicts > 0);
}

#[test]
fn named_worlds() {
    let worlds = named(1);
    let [one, two] = BOTH.map(|method| accept(method, &worlds).0);
    assert_eq!((one.conflicts, one.repairs, two.closure.method), (0, 0, 0));
}

#[test]
fn warped_worlds() {
    for (world, least_in_thirds) in warped() {
        let bounds = [world.least[0], world.least[1], least_in_thirds];
        for (method, least) in [Method::One, Method::Two, Method::Three].into_iter().zip(bounds) {
            let found = judged(&world, method);
            assert!(found.worst >= least, "{}, {method:?}: {}", world.name, found.worst);
        }
    }
}
