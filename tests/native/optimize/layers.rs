//! Refined parts of grids, pillowed.

use super::pillow::{World, pillowed};
use super::*;

fn smoothed(mut world: World) -> (OptimizeReport, World) {
    let input = world.positions.clone();
    let report = optimized(&input, &mut world.positions, &world.hexes, &world.movable);
    (report, world)
}

/// Optimises and holds the worst scaled Jacobian of the mesh against `least`.
fn reaches(least: f64, n: usize, refined: impl Fn([usize; 3]) -> bool) {
    let (report, world) = smoothed(pillowed(n, refined));
    assert_eq!(report.inverted, []);
    let quality = measured(&world.positions, &world.hexes).report().unwrap();
    assert_eq!((quality.not_positive, quality.undecided), (0, 0));
    assert!(f64::from(quality.scaled_jacobian.summary.min) >= least, "{report:?}");
    assert!((quality.total_volume - (n * n * n) as f64).abs() < 1e-9, "{}", quality.total_volume);
}

#[test]
fn a_box_inside() {
    reaches(0.55, 8, |c| c.iter().all(|x| (1..3).contains(x)));
}

#[test]
fn an_l_through_the_domain() {
    reaches(0.65, 8, |c| c[0] < 2 || c[1] < 2);
}

#[test]
fn an_l_prism_inside() {
    let inside = |c: [usize; 3]| c.iter().all(|x| (1..3).contains(x));
    reaches(0.52, 8, |c| inside(c) && !(c[0] == 2 && c[1] == 2));
}

#[test]
fn a_box_in_the_corner_of_the_domain() {
    reaches(0.55, 8, |c| c.iter().all(|x| *x < 2));
}

/// Does a set of octants, one bit each by x + 2y + 4z, touch itself at faces alone, and so do the others?
fn is_manifold(set: u32) -> bool {
    let joined = |inside: bool| {
        let octants: Vec<u32> = (0..8).filter(|o| (set >> o & 1 == 1) == inside).collect();
        let mut reached: Vec<u32> = octants.first().copied().into_iter().collect();
        for at in 0..octants.len() {
            let Some(&from) = reached.get(at) else { return false };
            for to in [from ^ 1, from ^ 2, from ^ 4] {
                if octants.contains(&to) && !reached.contains(&to) {
                    reached.push(to);
                }
            }
        }
        true
    };
    // Around an edge from the middle outwards, two octants across must not stand alone.
    let pinched = |[a, b, c, d]: [u32; 4]| {
        let [a, b, c, d] = [a, b, c, d].map(|o| set >> o & 1);
        a == d && b == c && a != b
    };
    let edges = [[0, 1, 2, 3], [4, 5, 6, 7], [0, 1, 4, 5], [2, 3, 6, 7], [0, 2, 4, 6], [1, 3, 5, 7]];
    joined(true) && joined(false) && !edges.into_iter().any(pinched)
}

#[test]
fn every_way_in_which_cells_meet_at_a_node() {
    let sets: Vec<u32> = (1..255).filter(|&set| is_manifold(set)).collect();
    assert!(sets.len() > 20, "{}", sets.len());
    for set in sets {
        reaches(0.48, 8, |c| {
            c.iter().all(|x| (1..3).contains(x))
                && set >> (c[0] - 1 + 2 * (c[1] - 1) + 4 * (c[2] - 1)) & 1 == 1
        });
    }
}

#[test]
fn the_box_has_as_many_hexes_as_the_formula() {
    let world = pillowed(8, |c| c.iter().all(|x| (1..3).contains(x)));
    assert_eq!(world.hexes.len(), 512 + 7 * 64 + 42 * 16);
}
