//! The counts of section 3: exact for blocks and for any set.

use hexmill::refine::hex::{Method, NO_ELEMENT, NO_OCTANT};

use super::judge::{families, interface_faces, judge_stage, worst};
use super::{refine, refine_where};

/// Inside the middle block of `k` in `n` cells along each axis.
fn middle(n: usize, k: usize) -> impl Fn([f64; 3]) -> bool {
    let (low, high) = ((n - k) as f64 / 2.0, (n + k) as f64 / 2.0);
    move |p| p.iter().all(|&x| x > low && x < high)
}

#[test]
fn a_block_in_a_grid_has_the_papers_counts() {
    for (n, k) in [(8, 4), (12, 4), (12, 8), (6, 2)] {
        let mesh = families([n / 2; 3]);
        let (n3, k3, k2) = (n * n * n, k * k * k, k * k);
        for (method, expected) in [
            (Method::One, n3 + 7 * k3 + 42 * k2 + 60 * k + 24),
            (Method::Two, n3 + 7 * k3 + 42 * k2),
            (Method::Auto, n3 + 7 * k3 + 42 * k2),
            (Method::Three, n3 + 26 * k3 + 78 * k2),
        ] {
            let (stage, refined) = refine_where(&mesh, method, middle(n, k));
            assert_eq!(refined.iter().filter(|&&r| r).count(), k3, "no growth");
            assert_eq!(stage.mesh.hexes.len(), expected, "{method:?} {n} {k}");
            assert_eq!(stage.report.interface_faces, 6 * k2);
            judge_stage(&mesh, &stage.mesh);
            let least = match method {
                Method::One => 0.32,
                Method::Three => 0.10,
                _ => 0.13,
            };
            let found = worst(&stage.mesh);
            assert!(found > least, "{method:?} {n} {k}: worst {found}");
        }
    }
}

#[test]
fn the_first_figures_are_1896_and_1632() {
    let mesh = families([4; 3]);
    assert_eq!(refine_where(&mesh, Method::One, middle(8, 4)).0.mesh.hexes.len(), 1896);
    assert_eq!(refine_where(&mesh, Method::Two, middle(8, 4)).0.mesh.hexes.len(), 1632);
}

#[test]
fn four_quarters_make_the_composite() {
    let mesh = families([1, 1, 2]);
    for method in [Method::One, Method::Two] {
        let (stage, _) = refine_where(&mesh, method, |[_, _, z]| z > 2.0);
        assert_eq!(stage.report.interface_faces, 4);
        judge_stage(&mesh, &stage.mesh);
        let whole = if method == Method::One { 4 } else { 0 };
        assert_eq!(stage.report.transition, 28 + whole);
        assert_eq!(stage.layer_nodes.len(), 58 + if method == Method::One { 9 } else { 0 });
    }
}

#[test]
fn children_are_numbered_family_by_family_and_stand_at_their_corners() {
    let mesh = families([4; 3]);
    let (stage, refined) = refine_where(&mesh, Method::Two, middle(8, 4));
    let parents: Vec<u32> = (0..512u32).filter(|&h| refined[h as usize]).collect();
    let after = &stage.mesh;
    let kept = 512 - parents.len();
    for h in 0..after.hexes.len() {
        let from = stage.from[h] as usize;
        if h < kept {
            assert_eq!((after.octant[h], after.element[h]), (mesh.octant[from], mesh.element[from]));
        } else if h < stage.first_transition {
            let child = h - kept;
            assert_eq!(after.element[h] as usize, child);
            assert_eq!((stage.from[h], usize::from(after.octant[h])), (parents[child / 8], child % 8));
            let corner = after.hexes[h][child % 8];
            let there = after.positions[corner.index()];
            let nearest = super::judge::center(after, h).distance(there);
            let parent = super::judge::center(&mesh, from);
            let centre = super::judge::center(after, h);
            assert!(centre.distance(parent) > 0.0 && nearest < there.distance(parent));
            assert_eq!(after.level[h], 2);
        } else {
            assert_eq!((after.octant[h], after.element[h], after.level[h]), (NO_OCTANT, NO_ELEMENT, 1));
        }
        assert_eq!(after.root[h], mesh.root[from]);
    }
}

#[test]
fn levels_nest() {
    for (method, expected) in [(Method::One, None), (Method::Two, Some(1632 + 7 * 64 + 7 * 96))] {
        let mesh = families([4; 3]);
        let (first, _) = refine_where(&mesh, method, middle(8, 4));
        judge_stage(&mesh, &first.mesh);
        let is_middle = |h: usize| {
            let p = super::judge::center(&first.mesh, h);
            first.mesh.level[h] == 2 && p.to_array().iter().all(|&x| x > 3.0 && x < 5.0)
        };
        let wanted: Vec<bool> = (0..first.mesh.hexes.len()).map(is_middle).collect();
        assert_eq!(wanted.iter().filter(|&&w| w).count(), 64);
        let (second, refined) = refine(&first.mesh, wanted, method);
        judge_stage(&first.mesh, &second.mesh);
        let grown = refined.iter().filter(|&&r| r).count();
        assert_eq!(grown, 64);
        let faces = interface_faces(&first.mesh, &refined);
        assert_eq!(faces, 96);
        if let Some(expected) = expected {
            assert_eq!(second.mesh.hexes.len(), expected);
        }
        assert_eq!(second.mesh.level.iter().max(), Some(&3));
        assert!(worst(&second.mesh) > 0.1, "{}", worst(&second.mesh));
    }
}
