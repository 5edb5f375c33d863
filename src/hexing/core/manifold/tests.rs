use super::super::compact;
use super::super::testing::{Stop, cubes, noise, refined_cubes};
use super::*;
use crate::Silent;
use crate::mesh::check_hexes;

/// Mends a set of cells that lie on their sides as deep as `world` says, and checks what came of it.
fn mended(cells: &Cells<'_>, is_inside: impl Fn(usize) -> bool, world: usize) {
    let mut inside: Vec<bool> = (0..cells.len()).map(is_inside).collect();
    let depth: Vec<f64> =
        (0..cells.len()).map(|c| noise(c, world) * if inside[c] { -1.0 } else { 1.0 }).collect();
    let repairs = make_manifold(cells, &depth, &mut inside, &Silent).unwrap();
    let kept: Vec<u32> = (0..cells.len() as u32).filter(|&c| inside[c as usize]).collect();
    assert_eq!(check_hexes(&compact(cells.mesh, &kept)), [], "world {world}");
    assert!(repairs.rounds <= 12, "world {world}: {repairs:?}");
    let again = make_manifold(cells, &depth, &mut inside, &Silent).unwrap();
    assert_eq!(again.flips, 0, "world {world}: nothing is left to do");
}

/// All sets of cells of a block within `counts` cubes.
fn all_of_a_block(counts: [u32; 3], first: [u32; 3], block: [u32; 3]) {
    let mesh = cubes(counts);
    let cells = Cells::of(&mesh, &Silent).unwrap();
    let bit = |cell: usize| {
        let cell = cell as u32;
        let at = [cell % counts[0], cell / counts[0] % counts[1], cell / counts[0] / counts[1]];
        let [x, y, z]: [Option<u32>; 3] =
            std::array::from_fn(|i| at[i].checked_sub(first[i]).filter(|&c| c < block[i]));
        Some(x? + block[0] * (y? + block[1] * z?))
    };
    for world in 0..1usize << (block[0] * block[1] * block[2]) {
        mended(&cells, |cell| bit(cell).is_some_and(|bit| world >> bit & 1 == 1), world);
    }
}

#[test]
fn all_sets_of_small_blocks_become_manifolds() {
    all_of_a_block([4, 4, 4], [1, 1, 1], [2, 2, 2]);
    all_of_a_block([4, 4, 5], [1, 1, 1], [2, 2, 3]);
}

#[test]
fn sets_at_the_boundary_of_the_mesh_become_manifolds_too() {
    all_of_a_block([3, 3, 3], [0, 0, 0], [2, 2, 2]);
    all_of_a_block([2, 2, 2], [0, 0, 0], [2, 2, 2]);
    all_of_a_block([2, 2, 3], [0, 0, 0], [2, 2, 3]);
}

#[test]
fn sets_of_cells_of_many_valences_become_manifolds() {
    let mesh = refined_cubes();
    let cells = Cells::of(&mesh, &Silent).unwrap();
    for world in 0..24 {
        let share = 0.2 + 0.025 * world as f64;
        mended(&cells, |cell| noise(cell, world + 1000) < share, world);
    }
}

#[test]
fn what_is_shallow_gives_way() {
    let mesh = cubes([4, 4, 3]);
    let cells = Cells::of(&mesh, &Silent).unwrap();
    // Two columns that touch at their edges, and one between them.
    let [a, b, between] = [5, 10, 6];
    let check = |depths: [f64; 3], expected: [bool; 3]| {
        let of_column = |c: usize| [a, b, between].iter().position(|&column| column == c % 16);
        let depth: Vec<f64> = (0..48).map(|c| of_column(c).map_or(1.0, |k| depths[k])).collect();
        let mut inside: Vec<bool> = depth.iter().map(|&d| d < 0.0).collect();
        make_manifold(&cells, &depth, &mut inside, &Silent).unwrap();
        assert!((0..48).all(|c| inside[c] == of_column(c).is_some_and(|k| expected[k])));
    };
    check([-0.6, -0.6, 0.5], [true, true, true]);
    check([-0.3, -0.6, 0.5], [false, true, false]);
}

#[test]
fn shallow_cells_that_stand_out_or_are_missing_alone_change_sides() {
    let mesh = cubes([5, 5, 5]);
    let at = |[x, y, z]: [usize; 3]| x + 5 * (y + 5 * z);
    let cells = Cells::of(&mesh, &Silent).unwrap();
    let is_block =
        |c: usize| (1..4).contains(&(c % 5)) && (1..4).contains(&(c / 5 % 5)) && (1..3).contains(&(c / 25));
    let (knob, dent) = (at([2, 2, 3]), at([2, 2, 1]));
    for (deep, stays) in [(0.1, false), (0.4, true)] {
        let mut inside: Vec<bool> =
            (0..cells.len()).map(|c| (is_block(c) && c != dent) || c == knob).collect();
        let depth: Vec<f64> = inside.iter().map(|&is_in| if is_in { -deep } else { deep }).collect();
        make_manifold(&cells, &depth, &mut inside, &Silent).unwrap();
        assert_eq!((inside[knob], inside[dent]), (stays, !stays));
    }
}

#[test]
fn work_stops_when_the_monitor_says_so() {
    let mesh = cubes([2, 2, 2]);
    let cells = Cells::of(&mesh, &Silent).unwrap();
    assert_eq!(make_manifold(&cells, &[-1.0; 8], &mut [true; 8], &Stop), Err(Cancelled));
}
