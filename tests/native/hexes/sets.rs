//! Random sets.

use hexmill::refine::hex::{Method, StageMesh};

use super::judge::{families, grid, interface_faces, judge_stage, worst};
use super::meshes::Numbers;
use super::{refine, refine_where, refined_once};

/// A random set of families.
fn random_families(mesh: &StageMesh, share: f64, numbers: &mut Numbers) -> Vec<bool> {
    let families = mesh.element.iter().max().map_or(0, |&e| e as usize / 8 + 1);
    let chosen: Vec<bool> = (0..families).map(|_| numbers.next() < share).collect();
    mesh.element.iter().map(|&e| chosen[e as usize / 8]).collect()
}

#[test]
fn random_families_are_joined_with_hardly_any_growth() {
    let mesh = families([4; 3]);
    let (mut asked, mut done) = (0, 0);
    for seed in 0..60 {
        let mut numbers = Numbers(seed);
        let wanted = random_families(&mesh, 0.05 + 0.015 * seed as f64, &mut numbers);
        let count = |set: &[bool]| set.iter().filter(|&&r| r).count();
        let (stage, refined) = refine(&mesh, wanted.clone(), Method::Two);
        asked += count(&wanted);
        done += count(&refined);
        let expected = 512 + 7 * count(&refined) + 7 * interface_faces(&mesh, &refined);
        assert_eq!(stage.mesh.hexes.len(), expected, "seed {seed}");
        judge_stage(&mesh, &stage.mesh);
    }
    let growth = done as f64 / asked as f64;
    assert!(growth < 1.05, "{asked} hexes became {done}");
}

#[test]
fn random_families_are_joined_by_method_one_without_inversion() {
    let mesh = families([4; 3]);
    for seed in 0..20 {
        let mut numbers = Numbers(seed);
        let wanted = random_families(&mesh, 0.02 + 0.01 * seed as f64, &mut numbers);
        let (stage, _) = refine(&mesh, wanted, Method::One);
        judge_stage(&mesh, &stage.mesh);
        let found = worst(&stage.mesh);
        assert!(found > 0.30, "seed {seed}: {found}");
    }
}

#[test]
fn random_hexes_are_joined_by_3_refinement() {
    let mesh = grid([5; 3], |_| true, |p| p);
    for seed in 0..40 {
        let mut numbers = Numbers(seed);
        let share = 0.05 + 0.022 * seed as f64;
        let wanted: Vec<bool> = mesh.hexes.iter().map(|_| numbers.next() < share).collect();
        let (stage, refined) = refine(&mesh, wanted, Method::Three);
        let count = refined.iter().filter(|&&r| r).count();
        let expected = 125 + 26 * count + 13 * interface_faces(&mesh, &refined);
        assert_eq!(stage.mesh.hexes.len(), expected, "seed {seed}");
        judge_stage(&mesh, &stage.mesh);
    }
}

#[test]
fn sets_without_families_take_method_two_where_their_faces_can_be_grouped() {
    // Input hexes: no families. A block of even size can be grouped, one of odd size cannot.
    let mesh = grid([6; 3], |_| true, |p| p);
    let block = |size: f64| move |p: [f64; 3]| p.iter().all(|&x| x > 1.0 && x < 1.0 + size);
    let (even, _) = refine_where(&mesh, Method::Auto, block(4.0));
    assert_eq!(even.mesh.hexes.len(), 216 + 7 * 64 + 7 * 96);
    judge_stage(&mesh, &even.mesh);
    let (odd, _) = refine_where(&mesh, Method::Auto, block(3.0));
    assert_eq!(odd.mesh.hexes.len(), 216 + 26 * 27 + 13 * 54);
    judge_stage(&mesh, &odd.mesh);
    let set: Vec<bool> = (0..216).map(|h| block(3.0)(super::judge::center(&mesh, h).to_array())).collect();
    let refusal = hexmill::refine::hex::stage(&mesh, &set, Method::Two, &hexmill::Silent);
    assert!(
        matches!(refusal, Err(hexmill::refine::hex::StageError::NotCouplable(hexes)) if !hexes.is_empty())
    );
}

#[test]
fn threads_do_not_change_the_result() {
    let mesh = refined_once(&families([4, 4, 3]));
    let mut numbers = Numbers(7);
    let wanted = random_families(&mesh, 0.4, &mut numbers);
    let with = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("threads");
        pool.install(|| refine(&mesh, wanted.clone(), Method::Two))
    };
    assert!(with(1) == with(4));
}
