//! Named worlds: concave sets, touching sets, sets at the boundary, cells that are no cubes.

use std::f64::consts::TAU;

use hexmill::refine::hex::{Method, StageMesh};

use super::judge::{families, grid, judge_stage, worst};
use super::{refine_where, refined_once};

const BOTH: [Method; 2] = [Method::One, Method::Two];

/// A box's cells by whole coordinates.
fn within(p: [f64; 3], low: [f64; 3], high: [f64; 3]) -> bool {
    (0..3).all(|a| p[a] > low[a] && p[a] < high[a])
}

#[test]
fn an_l_through_the_domain() {
    let mesh = families([4; 3]);
    for method in BOTH {
        let l = |p: [f64; 3]| within(p, [2.0, 2.0, 0.0], [6.0, 6.0, 8.0]) && !(p[0] > 4.0 && p[1] > 4.0);
        let (stage, refined) = refine_where(&mesh, method, l);
        assert_eq!(refined.iter().filter(|&&r| r).count(), 96, "{method:?} adds nothing");
        judge_stage(&mesh, &stage.mesh);
        assert!(worst(&stage.mesh) > 0.13, "{method:?} {}", worst(&stage.mesh));
    }
}

#[test]
fn an_l_prism_within_the_domain() {
    let mesh = families([4; 3]);
    let l = |p: [f64; 3]| within(p, [2.0; 3], [6.0, 6.0, 4.0]) && !(p[0] > 4.0 && p[1] > 4.0);
    let (stage, refined) = refine_where(&mesh, Method::Two, l);
    assert_eq!(refined.iter().filter(|&&r| r).count(), 24, "nothing is added");
    judge_stage(&mesh, &stage.mesh);
    assert!(worst(&stage.mesh) > 0.05, "{}", worst(&stage.mesh));
}

#[test]
fn two_boxes_that_touch_at_a_vertex_make_960_hexes() {
    let mesh = families([4; 3]);
    let boxes = |p| within(p, [2.0; 3], [4.0; 3]) || within(p, [4.0; 3], [6.0; 3]);
    let (stage, refined) = refine_where(&mesh, Method::Two, boxes);
    assert_eq!(refined.iter().filter(|&&r| r).count(), 16);
    assert_eq!(stage.mesh.hexes.len(), 960);
    judge_stage(&mesh, &stage.mesh);
    assert!(worst(&stage.mesh) > 0.1, "{}", worst(&stage.mesh));
}

#[test]
fn two_boxes_that_touch_at_an_edge() {
    let mesh = families([4; 3]);
    let boxes = |p| within(p, [2.0; 3], [4.0, 4.0, 6.0]) || within(p, [4.0, 4.0, 2.0], [6.0, 6.0, 6.0]);
    let (stage, refined) = refine_where(&mesh, Method::Two, boxes);
    assert_eq!(refined.iter().filter(|&&r| r).count(), 32);
    assert!(stage.report.pinched_edges > 0);
    judge_stage(&mesh, &stage.mesh);
    assert!(worst(&stage.mesh) > 0.0, "{}", worst(&stage.mesh));
}

#[test]
fn sets_at_the_boundary_stay_on_it() {
    let mesh = families([3; 3]);
    let corner = |p| within(p, [0.0; 3], [2.0; 3]);
    let side = |p| within(p, [0.0, 2.0, 2.0], [2.0, 4.0, 4.0]);
    let edge = |p| within(p, [0.0, 0.0, 2.0], [2.0, 2.0, 4.0]);
    let slab = |p| within(p, [0.0; 3], [6.0, 6.0, 2.0]);
    let bar = |p| within(p, [2.0, 2.0, 0.0], [4.0, 4.0, 6.0]);
    let across = |p| within(p, [0.0; 3], [2.0, 2.0, 6.0]) || within(p, [2.0, 2.0, 0.0], [4.0, 4.0, 6.0]);
    let sets: [&dyn Fn([f64; 3]) -> bool; 6] = [&corner, &side, &edge, &slab, &bar, &across];
    for (k, set) in sets.into_iter().enumerate() {
        for method in BOTH {
            let (stage, refined) = refine_where(&mesh, method, set);
            judge_stage(&mesh, &stage.mesh);
            let asked = (0..216).filter(|&h| set(super::judge::center(&mesh, h).to_array())).count();
            if method == Method::Two || k < 5 {
                assert_eq!(refined.iter().filter(|&&r| r).count(), asked, "set {k}, {method:?}");
            }
            assert!(worst(&stage.mesh) > 0.0, "set {k}, {method:?}: {}", worst(&stage.mesh));
        }
    }
}

#[test]
fn regions_apart_from_each_other() {
    let mesh = families([6, 4, 4]);
    let two = |p| within(p, [2.0; 3], [4.0; 3]) || within(p, [8.0, 2.0, 2.0], [10.0, 6.0, 6.0]);
    for method in BOTH {
        let (stage, refined) = refine_where(&mesh, method, two);
        assert_eq!(refined.iter().filter(|&&r| r).count(), 40);
        judge_stage(&mesh, &stage.mesh);
    }
    let (stage, _) = refine_where(&mesh, Method::Two, two);
    assert_eq!(stage.mesh.hexes.len(), 768 + 7 * 40 + 7 * (24 + 16 * 2 + 8 * 4));
}

#[test]
fn the_two_sides_of_a_concave_ridge() {
    // An L-shaped domain: the set is one arm, and the interface runs down the domain's inner ridge.
    let domain = grid([4, 4, 3], |[x, y, _]| x < 2 || y < 2, |p| p.map(|x| 2.0 * x));
    let mesh = refined_once(&domain);
    let arms: [&dyn Fn([f64; 3]) -> bool; 3] =
        [&|p| p[0] > 4.0, &|p| p[1] > 4.0 || p[0] < 4.0, &|p| p[1] < 4.0 && p[0] < 4.0];
    for arm in arms {
        for method in BOTH {
            let (stage, _) = refine_where(&mesh, method, arm);
            judge_stage(&mesh, &stage.mesh);
            assert!(worst(&stage.mesh) > 0.0, "{method:?}: {}", worst(&stage.mesh));
        }
    }
}

/// A cylinder of an o-grid: a square core of 2 x 2 cells in a ring of 8 x 2.
fn cylinder() -> StageMesh {
    let square = |k: usize| {
        let k = k % 8;
        [(0.0, 0.0), (1.0, 0.0), (2.0, 0.0), (2.0, 1.0), (2.0, 2.0), (1.0, 2.0), (0.0, 2.0), (0.0, 1.0)][k]
    };
    let mut nodes: Vec<[f64; 3]> = Vec::new();
    let mut hexes: Vec<[usize; 8]> = Vec::new();
    let node = |nodes: &mut Vec<[f64; 3]>, p: [f64; 3]| {
        let same = |q: &[f64; 3]| (0..3).all(|a| (q[a] - p[a]).abs() < 1e-9);
        nodes.iter().position(same).unwrap_or_else(|| {
            nodes.push(p);
            nodes.len() - 1
        })
    };
    let ring = |k: usize, layer: usize, z: f64| {
        let (x, y) = square(k);
        let angle = TAU * (k % 8) as f64 / 8.0 - 3.0 * TAU / 8.0;
        let t = layer as f64 / 2.0;
        let (cx, cy) = ((x - 1.0) * 0.6, (y - 1.0) * 0.6);
        [cx * (1.0 - t) + 2.0 * angle.cos() * t, cy * (1.0 - t) + 2.0 * angle.sin() * t, z]
    };
    for z in 0..3 {
        let heights = [f64::from(z), f64::from(z + 1)];
        for (x, y) in [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(x, y)| (f64::from(x), f64::from(y))) {
            let quad = [(x, y), (x + 1.0, y), (x + 1.0, y + 1.0), (x, y + 1.0)];
            let hex: Vec<usize> = heights
                .iter()
                .flat_map(|&h| quad.map(|(x, y)| [(x - 1.0) * 0.6, (y - 1.0) * 0.6, h]))
                .map(|p| node(&mut nodes, p))
                .collect();
            hexes.push(hex.try_into().expect("eight nodes"));
        }
        for k in 0..8 {
            for layer in 0..2 {
                let quad = [(k, layer), (k, layer + 1), (k + 1, layer + 1), (k + 1, layer)];
                let hex: Vec<usize> = heights
                    .iter()
                    .flat_map(|&h| quad.map(|(k, l)| ring(k, l, h)))
                    .map(|p| node(&mut nodes, p))
                    .collect();
                hexes.push(hex.try_into().expect("eight nodes"));
            }
        }
    }
    let positions = nodes.into_iter().map(hexmill::geometry::Point::from_array).collect();
    let hexes = hexes.into_iter().map(|hex| hex.map(hexmill::mesh::NodeId::new)).collect();
    StageMesh::of_input(positions, hexes)
}

#[test]
fn a_cylinder_of_an_o_grid() {
    let mesh = refined_once(&cylinder());
    let half = |p: [f64; 3]| p[2] > 1.0 && p[2] < 2.0;
    let core = |p: [f64; 3]| p[0].abs() < 0.6 && p[1].abs() < 0.6;
    let wedge = |p: [f64; 3]| p[0] > 0.0;
    let sets: [&dyn Fn([f64; 3]) -> bool; 3] = [&half, &core, &wedge];
    for (k, set) in sets.into_iter().enumerate() {
        for method in BOTH {
            let (stage, _) = refine_where(&mesh, method, set);
            judge_stage(&mesh, &stage.mesh);
            assert!(worst(&stage.mesh) > 0.0, "set {k}, {method:?}: {}", worst(&stage.mesh));
        }
    }
}

#[test]
fn cells_that_are_no_cubes() {
    // A sheared and stretched box keeps its planes.
    let shear = |[x, y, z]: [f64; 3]| [2.0 * x + 0.6 * y, 1.5 * y + 0.4 * z, 2.5 * z + 0.3 * x];
    let mesh = refined_once(&grid([4; 3], |_| true, shear));
    for method in [Method::One, Method::Two, Method::Three] {
        let set: Vec<bool> =
            mesh.root.iter().map(|&r| [r % 4, r / 4 % 4, r / 16].iter().all(|&i| i == 1 || i == 2)).collect();
        let (stage, _) = super::refine(&mesh, set, method);
        judge_stage(&mesh, &stage.mesh);
        assert!(worst(&stage.mesh) > 0.0, "{method:?}: {}", worst(&stage.mesh));
    }
}
