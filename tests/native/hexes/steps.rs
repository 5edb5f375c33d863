//! Domains whose boundary goes in steps: at their corners no copy of a node is free to go where the layer needs it.

use hexmill::mesh::HexMesh;
use hexmill::refine::hex::Method;
use hexmill::sizing::{Region, Shape, Target};
use rayon::prelude::*;

use super::acceptance::{Boundary, World, block, judged};
use super::meshes::{Numbers, cells};

const METHODS: [Method; 2] = [Method::Two, Method::Three];

/// To 3-refinement level 1 is what level 2 is to Method II, which refines whole families.
fn level(method: Method) -> u8 {
    if method == Method::Three { 1 } else { 2 }
}

/// Unit cubes within a ball.
fn ball(size: usize, radius: f64) -> HexMesh {
    let middle = 0.5 * size as f64;
    let is_near = |cell: [usize; 3]| {
        cell.iter().map(|&c| (c as f64 + 0.5 - middle).powi(2)).sum::<f64>() < radius * radius
    };
    cells([size; 3], is_near, |p| p)
}

/// The least scaled Jacobian and the hexes of a world of which nothing has to be repaired, so that its forecast is right.
fn unrepaired(name: String, input: HexMesh, regions: Vec<Region>, method: Method) -> (f64, usize) {
    let least = [0.0; 2];
    let world = World { name, input, regions, boundary: Boundary::Planar, least };
    let made = judged(&world, method);
    assert_eq!(made.refined.added.repairs, 0, "{}, {method:?}", world.name);
    (made.worst, made.refined.mesh.hexes.len())
}

/// Layers of cubes from below, of two rows: `R` is refined, `c` is coarse. The first row of each is the furthest back.
fn pictured(picture: &[&str], method: Method) -> (HexMesh, Vec<Region>) {
    let at = |[x, y, z]: [usize; 3]| picture[2 * z + 1 - y].as_bytes()[x];
    let size = [picture[0].len(), 2, picture.len() / 2];
    let all = (0..size.iter().product()).map(|k| [k % size[0], k / size[0] % 2, k / size[0] / 2]);
    let inside = |cell: [usize; 3]| {
        let min = cell.map(|c| c as f64);
        block(min.map(|c| c + 0.3), min.map(|c| c + 0.7), level(method))
    };
    let regions = all.filter(|&cell| at(cell) == b'R').map(inside).collect();
    (cells(size, |cell| at(cell) != b'.', |p| p), regions)
}

/// Pictures of two by two by two cubes.
const SMALL: [[&str; 4]; 6] = [
    // The refined side would leave the end of a concave ridge in line with it.
    ["..", "c.", "c.", "RR"],
    // It would have to leave one face of the interface and stay in the plane of its own.
    ["Rc", "c.", "RR", "c."],
    ["RR", "cR", "Rc", "c."],
    ["cc", "R.", "cc", "Rc"],
    // It leaves two concave ridges that meet.
    [".R", ".c", "cR", "cR"],
    ["c.", "Rc", "c.", "RR"],
];

#[test]
fn the_ends_of_concave_ridges() {
    for (number, picture) in SMALL.iter().enumerate() {
        for method in METHODS {
            let (input, regions) = pictured(picture, method);
            let (worst, hexes) = unrepaired(format!("picture {number}"), input, regions, method);
            println!("{number}, {method:?}: {hexes} hexes, worst {worst:.3}");
        }
    }
}

/// Where transition hexes stay inside out one coarse hex beside them is refined, not all that they touch.
#[test]
fn a_tangle_calls_for_one_hex() {
    let (input, regions) = pictured(&[".cc", "cc.", ".RR", "cc.", ".c.", "cc."], Method::Three);
    let name = "a bent bar".into();
    let world = World { name, input, regions, boundary: Boundary::Planar, least: [0.0; 2] };
    let made = judged(&world, Method::Three);
    assert!(made.refined.added.repairs <= 1, "{:?}", made.refined.added);
    assert!(made.worst > 0.1, "{}", made.worst);
}

#[test]
fn random_balls_in_a_ball_of_cubes() {
    let seeds: Vec<u64> = (0..24).collect();
    let all = seeds.into_par_iter().flat_map_iter(|seed| METHODS.map(|method| (seed, method)));
    let worst = all.map(|(seed, method)| {
        let mut numbers = Numbers(2 * seed + 1);
        let sphere = |numbers: &mut Numbers| {
            let center = [0, 1, 2].map(|_| 6.0 * numbers.next());
            let shape = Shape::Sphere { center: center.into(), radius: 0.4 + numbers.next() };
            Region { shape, target: Target::Level(level(method)) }
        };
        let regions = (0..1 + seed % 3).map(|_| sphere(&mut numbers)).collect();
        let (worst, hexes) = unrepaired(format!("balls {seed}"), ball(6, 2.9), regions, method);
        println!("{seed}, {method:?}: {hexes} hexes, worst {worst:.3}");
        worst
    });
    let worst = worst.reduce(|| f64::INFINITY, f64::min);
    assert!(worst >= 0.17, "{worst}");
}

#[test]
fn a_ball_at_the_side_of_a_ball_of_cubes() {
    let sphere = Shape::Sphere { center: [3.0, 3.0, 4.0].into(), radius: 1.2 };
    let regions = vec![Region { shape: sphere, target: Target::Level(1) }];
    let (worst, hexes) = unrepaired("a ball".into(), ball(14, 6.9), regions, Method::Three);
    assert!(hexes <= 2_600, "{hexes} hexes; there were 3,430 when tangles were repaired");
    assert!(worst >= 0.3, "{worst}");
}
