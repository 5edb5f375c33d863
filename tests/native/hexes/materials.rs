//! Faces between hexes of different tags stay where they are, in every stage of every method.

use std::collections::BTreeMap;

use hexmill::Silent;
use hexmill::geometry::Point;
use hexmill::mesh::quality::{Certainty, hex_quality};
use hexmill::mesh::topology::{HexFaces, hex_of};
use hexmill::mesh::{HexMesh, TagSet, Tags, Volumes, check_hexes};
use hexmill::refine::hex::{HexOptions, HexPlan, Method, RefinedHexes, refine_hexes};
use hexmill::sizing::{Region, Target};
use rayon::prelude::*;

use super::acceptance::{block, random_set, told_before};
use super::meshes::{Numbers, RADIUS, cells, cubes, cylinder};

const METHODS: [Method; 3] = [Method::One, Method::Two, Method::Three];

/// Gives materials to the hexes of a mesh, by their middles.
fn tagged(mesh: HexMesh, mut material: impl FnMut(Point) -> u32) -> HexMesh {
    let middle = |hex: &[_; 8]| {
        let corners = hex.map(|n: hexmill::mesh::NodeId| mesh.positions[n.index()]);
        corners.into_iter().sum::<Point>() / 8.0
    };
    let of_element: Vec<u32> = mesh.hexes.iter().map(|hex| material(middle(hex))).collect();
    let count = of_element.iter().max().map_or(0, |&most| most + 1);
    let set = |k| TagSet { groups: vec![format!("material {k}").into()], ..TagSet::default() };
    HexMesh { tags: Tags { sets: (0..count).map(set).collect(), of_element }, ..mesh }
}

/// The volume of each material.
fn volumes(mesh: &HexMesh) -> BTreeMap<u32, f64> {
    let mut hexes: BTreeMap<u32, Vec<_>> = BTreeMap::new();
    for (hex, &material) in mesh.hexes.iter().zip(&mesh.tags.of_element) {
        hexes.entry(material).or_default().push(*hex);
    }
    let of = |hexes| HexMesh { positions: mesh.positions.clone(), hexes, ..HexMesh::default() };
    hexes.into_iter().map(|(m, hexes)| (m, Volumes::of(&of(hexes)).expect("hexes").total)).collect()
}

/// The corners of the faces between materials.
fn between(mesh: &HexMesh) -> Vec<[Point; 4]> {
    let faces = HexFaces::of(mesh.positions.len(), &mesh.hexes);
    let material = |side| mesh.tags.of_element[hex_of(side).index()];
    let is_between = |sides: &[u32]| matches!(*sides, [a, b] if material(a) != material(b));
    let inner = faces.ids().filter(|&f| is_between(faces.sides(f)));
    inner.map(|f| faces.nodes[f.index()].map(|n| mesh.positions[n.index()])).collect()
}

/// Refines, and holds the result to what every result must be. Returns its least scaled Jacobian too.
fn refine(name: &str, input: &HexMesh, regions: &[Region], method: Method) -> (RefinedHexes, f64) {
    let options = HexOptions { method, regions: regions.to_vec(), ..HexOptions::default() };
    let refined = refine_hexes(input, &options, &Silent);
    let refined = refined.unwrap_or_else(|error| panic!("{name}, {method:?}: {error}"));
    assert_eq!(check_hexes(&refined.mesh), [], "{name}, {method:?}");
    told_before(&format!("{name}, {method:?}"), input, &options, &refined);
    let quality = hex_quality(&refined.mesh);
    assert!(quality.positive.iter().all(|&sure| sure == Certainty::Positive), "{name}, {method:?}");
    let worst = quality.scaled_jacobian.iter().copied().fold(f32::INFINITY, f32::min);
    (refined, worst.into())
}

/// Refines a mesh whose materials meet in planes: each keeps its volume.
fn planar(name: &str, input: &HexMesh, regions: &[Region], method: Method) -> (RefinedHexes, f64) {
    let (refined, worst) = refine(name, input, regions, method);
    let (before, after) = (volumes(input), volumes(&refined.mesh));
    let is_kept = |m: &u32| (before[m] - after[m]).abs() <= 1e-9 * before[m];
    let added = refined.added;
    println!(
        "{name}, {method:?}: {} hexes, worst {worst:.3}, {} conflicts, {} repairs",
        refined.mesh.hexes.len(),
        added.conflicts,
        added.repairs
    );
    assert!(before.keys().all(is_kept), "{name}, {method:?}: {before:?} became {after:?}");
    (refined, worst)
}

/// The least scaled Jacobian that will do, as for boundaries (`acceptance`).
fn least(method: Method) -> f64 {
    if method == Method::One { 0.43 } else { 0.20 }
}

/// The regions for a method: to 3-refinement level 1 is what level 2 is to the others, which refine whole families.
fn for_method(method: Method, regions: &[Region]) -> Vec<Region> {
    let target = |target| if method == Method::Three { Target::Level(1) } else { target };
    regions.iter().map(|region| Region { target: target(region.target), ..region.clone() }).collect()
}

#[test]
fn two_boxes_keep_the_plane_between_them() {
    let input = tagged(cells([2, 1, 1], |_| true, |p| p), |p| u32::from(p.x > 1.0));
    let regions = [block([1.0, 0.0, 0.0], [1.1, 0.1, 0.1], 2)];
    for method in METHODS {
        let (refined, worst) = planar("two boxes", &input, &regions, method);
        assert!(worst >= least(method), "{method:?}: {worst}");
        assert!(between(&refined.mesh).as_flattened().iter().all(|p| (p.x - 1.0).abs() < 1e-12));
    }
}

#[test]
fn what_is_refined_is_one_material() {
    let input = tagged(cubes(4), |p| u32::from(p.x > 2.0));
    let inside = tagged(cubes(4), |p| u32::from((p - Point::splat(2.0)).abs().max_element() < 1.0));
    let half = [block([2.0, 0.0, 0.0], [4.0; 3], 2)];
    let cube = [block([1.0; 3], [3.0; 3], 2)];
    let around = [block([0.0; 3], [4.0, 4.0, 1.0], 2), block([0.0; 3], [4.0, 1.0, 4.0], 2)];
    for method in METHODS {
        for (name, input, regions) in [
            ("half", &input, &half[..]),
            ("inside", &inside, &cube),
            ("beside", &inside, &around),
            ("beside half", &input, &[block([2.0; 3], [3.0; 3], 2)]),
        ] {
            let (_, worst) = planar(name, input, &for_method(method, regions), method);
            assert!(worst >= least(method), "{name}, {method:?}: {worst}");
        }
    }
}

/// A material for each side of one, two or three planes along the axes; where two planes meet there are three materials or
/// four.
fn random_split(mesh: HexMesh, cells: u32, numbers: &mut Numbers) -> HexMesh {
    let planes: Vec<(usize, f64)> = (0..1 + (3.0 * numbers.next()) as usize)
        .map(|_| ((3.0 * numbers.next()) as usize, 1.0 + (f64::from(cells - 1) * numbers.next()).floor()))
        .collect();
    let joins = numbers.next() < 0.5;
    tagged(mesh, |p| {
        let sides = planes.iter().map(|&(axis, at)| u32::from(p[axis] > at));
        // The first plane ends at the second, or each cuts all of it.
        let bits: u32 = sides.enumerate().map(|(k, side)| side << k).sum();
        if joins && bits & 1 == 1 { 1 } else { bits }
    })
}

fn random(count: u64, step: u64, levels: u8) {
    let worlds: Vec<(String, HexMesh, Vec<Region>)> = (0..count)
        .step_by(step as usize)
        .map(|seed| {
            let world = random_set(3, seed, count, levels);
            let input = random_split(world.input, 3, &mut Numbers(77 + seed));
            (world.name, input, world.regions)
        })
        .collect();
    let cases: Vec<_> = worlds.iter().flat_map(|world| METHODS.map(|method| (world, method))).collect();
    let worst: Vec<(Method, f64)> = cases
        .par_iter()
        .map(|((name, input, regions), method)| {
            let regions = for_method(*method, regions);
            (*method, planar(name, input, &regions, *method).1)
        })
        .collect();
    for method in METHODS {
        let worst = worst.iter().filter(|(m, _)| *m == method).map(|w| w.1).fold(1.0, f64::min);
        println!("{method:?}: {worst:.3}");
        assert!(worst >= least(method), "{method:?}: {worst}");
    }
}

#[test]
fn random_sets_across_planes() {
    random(100, 9, 1);
}

#[test]
fn random_sets_of_two_levels_across_planes() {
    random(10, 5, 2);
}

#[test]
fn three_materials_meet_at_a_line() {
    let input = tagged(cubes(4), |p| if p.x < 2.0 { 0 } else { 1 + u32::from(p.y > 2.0) });
    let regions = [
        vec![block([1.0, 1.0, 1.0], [3.0, 3.0, 2.0], 2)],
        vec![block([2.0, 2.0, 1.0], [3.0, 3.0, 2.0], 2)],
        vec![block([1.0, 1.0, 0.0], [2.0, 2.0, 2.0], 2), block([2.0, 1.0, 2.0], [3.0, 3.0, 3.0], 2)],
        vec![block([1.0, 1.0, 0.0], [2.0, 2.0, 2.0], 2), block([1.5, 1.5, 1.0], [2.5, 2.5, 2.0], 3)],
    ];
    for method in METHODS {
        for (k, regions) in regions.iter().enumerate() {
            let regions = for_method(method, regions);
            let (refined, worst) = planar(&format!("line {k}"), &input, &regions, method);
            assert!(worst >= least(method), "{k}, {method:?}: {worst}");
            let on_line = |p: &Point| (p.x - 2.0).abs() < 1e-12 && (p.y - 2.0).abs() < 1e-12;
            assert!(between(&refined.mesh).as_flattened().iter().any(on_line));
        }
    }
}

/// The radius of the inner cylinder of [`cylinder_in_cylinder`].
const INNER: f64 = 1.5;

/// The cylinder, whose ring's inner layer is moved to end at a cylinder too, where materials meet.
fn cylinder_in_cylinder() -> HexMesh {
    let mut input = cylinder();
    let is_core = |p: &Point| p.x.abs().max(p.y.abs()) < 1.001;
    let is_out = |p: &Point| p.truncate().length() > RADIUS - 1e-9;
    for p in input.positions.iter_mut().filter(|p| !is_core(p) && !is_out(p)) {
        let [x, y] = (p.truncate().normalize() * INNER).to_array();
        (p.x, p.y) = (x, y);
    }
    tagged(input, |p| u32::from(p.truncate().length() > 0.5 * (INNER + RADIUS) - 0.1))
}

#[test]
fn a_cylinder_between_materials_is_kept() {
    let input = cylinder_in_cylinder();
    let chord = between(&input).into_iter().map(|[a, b, c, d]| a.distance(c).max(b.distance(d)));
    let chord = chord.fold(0.0, f64::max);
    let sagitta = INNER - (INNER * INNER - chord * chord / 4.0).sqrt();
    let ball = |center: [f64; 3], radius, level| Region {
        shape: hexmill::sizing::Shape::Sphere { center: center.into(), radius },
        target: Target::Level(level),
    };
    let worlds = [
        ("a wedge", vec![block([0.3, -3.0, 0.4], [3.0, 3.0, 1.1], 2), ball([1.5, 0.0, 0.75], 0.3, 3)]),
        ("the core", vec![block([-0.6, -0.6, -1.0], [0.6, 0.6, 4.0], 2)]),
        ("inside", vec![block([-1.0, -1.0, 0.0], [1.0, 1.0, 1.4], 2)]),
        ("at a place", vec![ball([INNER, 0.1, 1.2], 0.1, 2)]),
    ];
    for method in METHODS {
        for (name, regions) in &worlds {
            let regions = for_method(method, regions);
            let (refined, worst) = refine(name, &input, &regions, method);
            let radii = between(&refined.mesh).into_iter().flatten().map(|p| p.truncate().length());
            let [low, high] = radii.fold([f64::INFINITY, 0.0], |[l, h], r| [l.min(r), h.max(r)]);
            println!("{name}, {method:?}: {} hexes, worst {worst:.3}, {low} to {high}", refined.level.len());
            assert!(
                low >= INNER - sagitta - 1e-9 && high <= INNER + 1e-9,
                "{name}, {method:?}: {low}, {high}"
            );
            let least = if method == Method::One { 0.25 } else { 0.15 };
            assert!(worst >= least, "{name}, {method:?}: {worst}");
        }
    }
}

/// Any hexes may be of any material, and groups of four across them be refined without families.
#[test]
fn any_cells_are_materials() {
    (0..24).into_par_iter().for_each(|seed| {
        let mut numbers = Numbers(99 + seed);
        let world = random_set(3, 3 * seed, 72, 1);
        let count = world.input.hexes.len();
        let of_element: Vec<u32> = (0..count).map(|_| (3.0 * numbers.next()) as u32).collect();
        let sets = tagged(cubes(1), |_| 2).tags.sets;
        let input = HexMesh { tags: Tags { sets, of_element }, ..world.input };
        for method in METHODS {
            planar(&world.name, &input, &for_method(method, &world.regions), method);
        }
        let split = random_split(cubes(6), 6, &mut numbers);
        let at = [0, 1, 2].map(|_| (4.0 * numbers.next()).floor());
        let size = [0, 1, 2].map(|_| 2.0 + 2.0 * (2.0 * numbers.next()).floor());
        let region = block(at, [0, 1, 2].map(|k| at[k] + size[k]), 1);
        planar("automatic", &split, &[region], Method::Auto);
    });
}

/// Cubes of materials that meet in steps.
fn stepped(cells: u32, name: &str) -> HexMesh {
    let most = f64::from(cells);
    let mut numbers = Numbers(7);
    tagged(cubes(cells), |p| {
        let is_far = u32::from(p.x + p.y > most);
        match name {
            "stairs" => is_far,
            "corners" => u32::from(p.x + p.y + p.z > 1.5 * most),
            "ball" => u32::from(p.distance(Point::splat(0.5 * most)) < 0.35 * most),
            "three" => is_far + 2 * u32::from(p.z + 0.5 * p.x > 0.6 * most),
            _ => (3.0 * numbers.next()) as u32,
        }
    })
}

/// The refined set does not walk along the steps: little is refined beyond what one material takes, and nothing for hexes
/// inside out.
#[test]
fn materials_that_meet_in_steps_take_few_more_hexes() {
    let balls = [(4.0, 4.0, 4.0, 1.5), (3.3, 4.6, 3.9, 2.2)].map(|(x, y, z, radius)| Region {
        shape: hexmill::sizing::Shape::Sphere { center: [x, y, z].into(), radius },
        target: Target::Level(2),
    });
    let names = ["stairs", "corners", "ball", "three", "random"];
    let worlds: Vec<_> = names.iter().flat_map(|name| balls.iter().map(move |ball| (*name, ball))).collect();
    worlds.into_par_iter().for_each(|(name, ball)| {
        let (input, of_one) = (stepped(8, name), cubes(8));
        for method in METHODS {
            let regions = for_method(method, std::slice::from_ref(ball));
            let options = HexOptions { method, regions: regions.clone(), ..HexOptions::default() };
            let of_one = HexPlan::new(&of_one, &options, &Silent).expect("a plan").forecast().hexes;
            let (refined, worst) = planar(name, &input, &regions, method);
            let growth = refined.mesh.hexes.len() as f64 / of_one as f64;
            let most = match (method, name) {
                (Method::One, _) => 1.0,
                (_, "random") => 1.3,
                _ => 1.21,
            };
            assert!(growth <= most, "{name}, {method:?}: {growth} times the hexes that one material takes");
            assert_eq!(refined.added.repairs, 0, "{name}, {method:?}");
            assert!(worst >= least(method), "{name}, {method:?}: {worst}");
        }
    });
}

/// Where the sides of a set cannot be parted, more is refined there, and not all of the input so that it is in families.
#[test]
fn sets_of_the_input_between_materials_stay_small() {
    let ball = Region {
        shape: hexmill::sizing::Shape::Sphere { center: [3.6, 4.6, 3.5].into(), radius: 1.2 },
        target: Target::Level(1),
    };
    for name in ["stairs", "corners", "ball", "three", "random"] {
        let (refined, worst) = planar(name, &stepped(8, name), std::slice::from_ref(&ball), Method::Auto);
        let (hexes, added) = (refined.mesh.hexes.len(), refined.added);
        println!("{name}: {hexes} hexes, worst {worst:.3}, {added:?}");
        assert_eq!(added.repairs, 0, "{name}");
        assert!(hexes < 2_000, "{name}: {hexes} hexes; 4,096 are all refined once");
        assert!(worst >= least(Method::Two), "{name}: {worst}");
    }
}
