//! Grids with random nodes.

use super::*;

/// Moves every node by up to `amount`: inside anywhere, on the boundary along its planes and ridges.
fn shaken(positions: &[Point], n: u32, amount: f64, seed: u64) -> Vec<Point> {
    let mut noise = Noise(seed);
    let far = f64::from(n);
    let free = |x: f64| if x == 0.0 || x == far { 0.0 } else { 1.0 };
    positions
        .iter()
        .map(|p| *p + amount * noise.point() * Point::new(free(p.x), free(p.y), free(p.z)))
        .collect()
}

#[test]
fn tangled_grids_become_positive_and_stay_on_their_planes() {
    for (n, amount, seed) in [(6, 0.8, 1), (6, 1.0, 2), (8, 0.7, 3), (8, 0.9, 4), (10, 0.8, 5)] {
        let (input, hexes) = grid(n);
        let mut positions = shaken(&input, n, amount, seed);
        let before = measured(&positions, &hexes).report().unwrap();
        assert!(before.not_positive > hexes.len() / 4, "{before:?}");
        let report = optimized(&input, &mut positions, &hexes, &vec![true; input.len()]);
        assert_eq!(report.inverted, [], "seed {seed}");
        let after = measured(&positions, &hexes).report().unwrap();
        assert_eq!((after.not_positive, after.undecided), (0, 0), "seed {seed}");
        assert!(after.scaled_jacobian.summary.min > 0.3, "seed {seed}: {:?}", after.scaled_jacobian.summary);
        assert!(
            (after.total_volume - f64::from(n.pow(3))).abs() < 1e-9,
            "seed {seed}: {}",
            after.total_volume
        );
        assert!(report.off_boundary < 1e-12);
        for (p, q) in input.iter().zip(&positions) {
            for i in 0..3 {
                let on_plane = p[i] == 0.0 || p[i] == f64::from(n);
                assert!(!on_plane || (p[i] - q[i]).abs() < 1e-12, "seed {seed}: {p} went to {q}");
            }
        }
    }
}

#[test]
fn nodes_that_are_not_movable_do_not_move() {
    let (input, hexes) = grid(6);
    let start = shaken(&input, 6, 0.5, 9);
    let movable: Vec<bool> = input.iter().map(|p| p.x < 3.0).collect();
    let mut positions = start.clone();
    let report = optimized(&input, &mut positions, &hexes, &movable);
    let moved = start.iter().zip(&positions).filter(|(p, q)| p != q).count();
    assert!(moved > 0 && moved == report.moved);
    assert!((0..start.len()).all(|i| movable[i] || start[i] == positions[i]));
    assert_eq!(report.cells, 6 * 6 * 3);
}

#[test]
fn a_turned_grid_stays_on_its_oblique_planes() {
    let (input, hexes) = grid(6);
    let turn = glam::DQuat::from_axis_angle(Point::new(1.0, 2.0, -0.5).normalize(), 0.7);
    let turned = |points: &[Point]| -> Vec<Point> { points.iter().map(|&p| turn * p).collect() };
    let mut positions = turned(&shaken(&input, 6, 0.8, 11));
    let report = optimized(&turned(&input), &mut positions, &hexes, &vec![true; input.len()]);
    assert_eq!(report.inverted, []);
    for (p, q) in input.iter().zip(&positions) {
        let back = turn.inverse() * *q;
        for i in 0..3 {
            assert!((p[i] != 0.0 && p[i] != 6.0) || (p[i] - back[i]).abs() < 1e-12, "{p} went to {back}");
        }
    }
    assert!((measured(&positions, &hexes).total_volume - 216.0).abs() < 1e-9);
}

/// Flattened through itself: every cell of a slab is inverted.
#[test]
fn a_fold_is_pulled_out() {
    let (input, hexes) = grid(8);
    let mut positions = input.clone();
    for (p, q) in input.iter().zip(&mut positions) {
        if (1.0..8.0).contains(&p.x) && (1.0..8.0).contains(&p.y) && (3.0..5.0).contains(&p.z) {
            q.z = 8.0 - p.z + 0.3 * (p.z - 4.0);
        }
    }
    assert!(measured(&positions, &hexes).report().unwrap().not_positive > 0);
    let report = optimized(&input, &mut positions, &hexes, &vec![true; input.len()]);
    assert_eq!(report.inverted, []);
    assert!(report.worst_after.unwrap() > 0.5, "{report:?}");
}

#[test]
fn what_cannot_be_untangled_is_listed() {
    let (mut positions, hexes) = grid(2);
    // Two corners of the domain, which are fixed, change places.
    positions.swap(0, 2);
    let input = grid(2).0;
    let report = optimized(&input, &mut positions, &hexes, &[true; 27]);
    assert!(!report.inverted.is_empty());
    let quality = measured(&positions, &hexes);
    let listed: Vec<usize> = report.inverted.iter().map(|h| h.index()).collect();
    let found = quality.positive.iter().enumerate();
    let found: Vec<usize> =
        found.filter(|(_, c)| **c != hexmill::mesh::quality::Certainty::Positive).map(|(h, _)| h).collect();
    assert_eq!(listed, found);
}
