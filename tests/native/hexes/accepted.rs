//! The worlds of `acceptance`: all random sets of one level, and of the others as many and as fine as is quick;
//! `examples/acceptance.rs` does all of them.

use std::collections::BTreeSet;

use hexmill::mesh::numbering::hex::{CORNER_AT, SYMMETRIES};
use hexmill::refine::hex::{Added, Method};
use rayon::prelude::*;

use super::acceptance::{Boundary, Judged, World, block, judged, named, octants, random_on_beam, random_set};
use super::meshes::i_beam;

const BOTH: [Method; 2] = [Method::One, Method::Two];

/// Refines the worlds with a method; returns the sum of what was refined besides what was asked for.
fn accept(method: Method, worlds: &[World]) -> Added {
    let found: Vec<Added> = worlds
        .par_iter()
        .map(|world| {
            let Judged { refined, worst, mean } = judged(world, method);
            println!(
                "{}, {method:?}: {} hexes, worst {worst:.3}, mean {mean:.3}",
                world.name,
                refined.level.len()
            );
            let least = world.least[usize::from(method == Method::Two)];
            assert!(worst >= least, "{}, {method:?}: {worst}", world.name);
            refined.added
        })
        .collect();
    let mut sum = Added::default();
    for added in found {
        sum.closure.method += added.closure.method;
        sum.conflicts += added.conflicts;
        sum.repairs += added.repairs;
    }
    sum
}

#[test]
fn random_sets() {
    let one_level = (0..100).map(|seed| random_set(4, seed, 100, 1));
    let two_levels = (0..100).step_by(9).map(|seed| random_set(4, seed, 100, 2));
    let worlds: Vec<World> = one_level.chain(two_levels).collect();
    let [one, two] = BOTH.map(|method| accept(method, &worlds));
    assert!(one.closure.method > 0, "Method I fills up");
    assert_eq!(two.closure.method, 0);
}

#[test]
fn one_of_each_kind_of_octants_around_a_node() {
    let image = |mask: u32, symmetry: [u8; 8]| -> u32 {
        let moved = |octant: usize| CORNER_AT[usize::from(symmetry[usize::from(CORNER_AT[octant])])];
        (0..8).filter(|octant| mask >> octant & 1 == 1).map(|octant| 1 << moved(octant)).sum()
    };
    let least = |mask: u32| SYMMETRIES.iter().map(|&symmetry| image(mask, symmetry)).min();
    let kinds: BTreeSet<u32> = (1..255).filter_map(least).collect();
    assert_eq!(kinds.len(), 20);
    let worlds: Vec<World> = kinds.into_iter().map(octants).collect();
    let added = accept(Method::Two, &worlds);
    assert!(added.conflicts > 0, "some cannot be separated");
    assert_eq!(added.repairs, 0);
}

#[test]
fn random_sets_on_the_beam() {
    let worlds = [8, 30].map(|seed| random_on_beam(seed, 40));
    let [one, two] = BOTH.map(|method| accept(method, &worlds));
    assert_eq!((one.conflicts, one.repairs, two.closure.method), (0, 0, 0));
    assert!(two.conflicts > 0);
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
    let added = accept(Method::Two, &worlds.collect::<Vec<_>>());
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
    let added = accept(Method::Two, &[world]);
    assert!(added.conflicts > 0);
}

#[test]
fn named_worlds() {
    let worlds = named(1);
    let [one, two] = BOTH.map(|method| accept(method, &worlds));
    assert_eq!((one.conflicts, one.repairs, two.closure.method), (0, 0, 0));
}
