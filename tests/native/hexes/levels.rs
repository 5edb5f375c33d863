//! Refinement level by level: a caller's sizes, graded 3-refinement, sets that need no families.

use hexmill::Silent;
use hexmill::geometry::Point;
use hexmill::mesh::{HexMesh, check_hexes, mesh_hash};
use hexmill::refine::hex::{HexOptions, HexPlan, HexRefinement, Method, RefinedHexes, refine_hexes};
use hexmill::sizing::{Region, Shape, Target};

use super::acceptance::{Boundary, World, block, judged};
use super::meshes::{Numbers, cells, cubes, cylinder};

fn options(method: Method, regions: Vec<Region>) -> HexOptions {
    HexOptions { method, regions, ..HexOptions::default() }
}

fn ball(center: [f64; 3], radius: f64, level: u8) -> Region {
    Region { shape: Shape::Sphere { center: center.into(), radius }, target: Target::Level(level) }
}

fn hash(refined: &RefinedHexes) -> String {
    mesh_hash(&refined.mesh.positions, &refined.mesh.hexes).to_string()
}

/// Refines until no candidate is longer than `size` says for its middle.
fn by_sizes(input: &HexMesh, method: Method, size: impl Fn(Point) -> f64) -> RefinedHexes {
    let options = options(method, Vec::new());
    let mut refinement = HexRefinement::new(input, &options, &Silent).expect("a mesh");
    loop {
        let candidates = refinement.candidates(&Silent).unwrap();
        let targets: Vec<f64> = candidates.centers.iter().map(|&p| size(p)).collect();
        if !refinement.advance(Some(&targets), &Silent).expect("a few hexes") {
            return refinement.finish(&Silent).expect("a few hexes");
        }
    }
}

#[test]
fn a_callers_sizes_do_what_regions_do() {
    // The level of Methods I and II counts from hexes of one half, that of 3-refinement from whole ones.
    for (method, level, size) in
        [(Method::One, 2, 0.26), (Method::Two, 2, 0.26), (Method::Auto, 2, 0.26), (Method::Three, 1, 0.34)]
    {
        let inside = |p: Point| p.to_array().iter().all(|&x| x > 1.0 && x < 3.0);
        let by_sizes = by_sizes(&cubes(4), method, |p| if inside(p) { size } else { f64::INFINITY });
        let regions = options(method, vec![block([1.0; 3], [3.0; 3], level)]);
        let by_regions = refine_hexes(&cubes(4), &regions, &Silent).expect("a few hexes");
        assert_eq!(hash(&by_sizes), hash(&by_regions), "{method:?}");
        assert!(by_sizes.mesh.hexes.len() > 64);
    }
}

#[test]
fn candidates_are_the_elements_of_the_last_level() {
    let (input, options) = (cubes(2), options(Method::Auto, Vec::new()));
    let mut refinement = HexRefinement::new(&input, &options, &Silent).expect("a mesh");
    let first = refinement.candidates(&Silent).unwrap();
    assert_eq!((first.centers[0], first.longest.clone()), (Point::splat(0.5), vec![1.0; 8]));
    let mut targets = vec![f64::INFINITY; 8];
    targets[0] = 0.9;
    assert!(refinement.advance(Some(&targets), &Silent).expect("one hex"));
    let second = refinement.candidates(&Silent).unwrap();
    assert_eq!((second.centers[0], second.longest), (Point::splat(0.25), vec![0.5; 8]));
    let code = |refinement: &mut HexRefinement, targets: &[f64]| {
        refinement.advance(Some(targets), &Silent).expect_err("it is refused").code()
    };
    assert_eq!(code(&mut refinement, &[1.0; 7]), "target-count");
    for wrong in [0.0, -1.0, f64::NAN] {
        assert_eq!(code(&mut refinement, &[wrong; 8]), "target-out-of-range");
    }
    assert!(!refinement.advance(Some(&[0.5; 8]), &Silent).expect("nothing to do"));
    assert!(!refinement.advance(None, &Silent).expect("nothing to do"));
}

/// Hexes that share a node differ by one level at most.
fn assert_graded(refined: &RefinedHexes) {
    let mut levels = vec![[u8::MAX, 0]; refined.mesh.positions.len()];
    for (hex, &level) in refined.mesh.hexes.iter().zip(&refined.level) {
        for n in hex {
            let [least, most] = &mut levels[n.index()];
            (*least, *most) = ((*least).min(level), (*most).max(level));
        }
    }
    assert!(levels.iter().all(|[least, most]| most - least <= 1));
}

#[test]
fn levels_of_3_refinement_are_graded() {
    let at = |level, radius| ball([1.3, 0.9, 1.1], radius, level);
    for (level, regions) in
        [(2, vec![at(2, 0.05)]), (3, vec![at(3, 0.01)]), (2, vec![at(1, 0.5), at(2, 0.3)])]
    {
        let world = World {
            name: format!("cylinder, level {level}"),
            input: cylinder(),
            regions,
            boundary: Boundary::Cylinder,
            least: [0.0; 2],
        };
        let found = judged(&world, Method::Three);
        assert_eq!(found.refined.level.iter().max(), Some(&level));
        assert_eq!(found.refined.stages.len(), usize::from(level));
        assert_graded(&found.refined);
        assert!(found.refined.added.closure.balance > 0, "neighbours are refined for the grading");
        println!("{}: {} hexes, worst {:.3}", world.name, found.refined.level.len(), found.worst);
        assert!(found.worst > 0.15, "{}: {}", world.name, found.worst);
    }
}

#[test]
fn sets_that_can_be_grouped_need_no_families() {
    let hexes = |input: &HexMesh, method, region: Region| {
        let options = options(method, vec![region]);
        let refined = refine_hexes(input, &options, &Silent).expect("it can be refined");
        assert_eq!(check_hexes(&refined.mesh), []);
        refined.mesh.hexes.len()
    };
    let even = || block([1.0; 3], [3.0; 3], 1);
    assert_eq!(hexes(&cubes(4), Method::Auto, even()), 64 + 7 * 8 + 7 * 24);
    assert_eq!(hexes(&cubes(4), Method::Two, even()), 512, "told by name it makes families first");
    // Three faces cannot be grouped two by two, but four can: whole blocks are refined.
    assert_eq!(hexes(&cubes(5), Method::Auto, block([1.0; 3], [4.0; 3], 1)), 125 + 7 * 64 + 7 * 48);
    assert_eq!(hexes(&cubes(5), Method::Auto, block([2.0; 3], [3.0; 3], 1)), 125 + 7 * 8 + 7 * 24);
    // There are none that have both ends of five.
    let ends = cells([5, 4, 4], |_| true, |p| p);
    assert_eq!(hexes(&ends, Method::Auto, block([0.0, 1.0, 1.0], [5.0, 3.0, 3.0], 1)), 80 * 8);
    // Faces side by side in a group may not fold by more than 30 degrees.
    for (degrees, expected) in [(25.0f64, 64 + 7 * 8 + 7 * 24), (35.0, 512)] {
        let rise = (degrees / 2.0).to_radians().tan();
        let folded = cells([4; 3], |_| true, |p| Point::new(p.x, p.y, p.z - rise * (p.x - 2.0).abs()));
        let middle = Region {
            shape: Shape::Points {
                points: (0..8)
                    .map(|i| [1.5 + f64::from(i & 1), 1.5 + f64::from(i >> 1 & 1), 1.5 + f64::from(i >> 2)])
                    .map(|[x, y, z]| Point::new(x, y, z - rise * 0.5))
                    .collect(),
                radius: 0.0,
            },
            target: Target::Level(1),
        };
        assert_eq!(hexes(&folded, Method::Auto, middle), expected, "{degrees} degrees");
    }
}

#[test]
fn deeper_levels_of_a_grouped_set_are_balanced_down_to_the_input() {
    let regions = vec![block([2.0; 3], [6.0; 3], 1), block([3.5; 3], [4.5; 3], 3)];
    let world = World {
        name: "grouped, three levels".into(),
        input: cubes(8),
        regions,
        boundary: Boundary::Planar,
        least: [0.0; 2],
    };
    let auto = judged(&world, Method::Auto);
    assert_graded(&auto.refined);
    assert_eq!(auto.refined.level.iter().min(), Some(&0), "the input's hexes stay where nothing is wanted");
    assert!(auto.worst > 0.3, "{}", auto.worst);
}

#[test]
fn the_forecast_is_what_is_made() {
    let regions = vec![
        block([1.0; 3], [3.0, 3.0, 2.0], 2),
        block([1.0; 3], [2.0, 3.0, 3.0], 2),
        block([1.5; 3], [2.0; 3], 3),
    ];
    for method in [Method::One, Method::Two, Method::Auto, Method::Three] {
        let options = HexOptions { max_levels: 2, ..options(method, regions.clone()) };
        let plan = HexPlan::new(&cubes(4), &options, &Silent).expect("it can be refined");
        let forecast = plan.forecast().clone();
        let refined = plan.carry_out(&Silent).expect("it can be refined");
        assert_eq!(forecast.hexes, refined.mesh.hexes.len(), "{method:?}");
        let told = forecast.stages.iter().map(|s| (s.refined, s.interface_faces, s.transition));
        let made = refined.stages.iter().map(|s| (s.refined, s.interface_faces, s.transition));
        assert!(told.eq(made), "{method:?}: {forecast:?}, {:?}", refined.stages);
        assert!(forecast.transition > 0 && forecast.bytes > 0);
    }
}

/// Sets that cannot be grouped take whole blocks with them, across the cells of an o-grid too, and not all of the input.
#[test]
fn random_balls_are_refined_in_blocks() {
    let inputs = [
        ("cubes", cubes(9), Boundary::Planar),
        ("cylinder", cylinder(), Boundary::Cylinder),
        ("ball", super::meshes::ball(), Boundary::Sphere),
    ];
    for (name, input, boundary) in inputs {
        let middle = input.positions.iter().sum::<Point>() / input.positions.len() as f64;
        let size = input.positions.iter().map(|p| (*p - middle).abs().max_element()).fold(0.0, f64::max);
        let (mut in_blocks, mut of_all) = (0, 0);
        for seed in 0..8 {
            let mut numbers = Numbers(seed);
            let center = middle.to_array().map(|m| m + 0.8 * size * (2.0 * numbers.next() - 1.0));
            let level = 1 + (seed % 3) as u8;
            let regions = vec![ball(center, 0.2 * size, level)];
            let name = format!("ball {seed} of level {level} in {name}");
            let world = World { name, input: input.clone(), regions, boundary, least: [0.0; 2] };
            let [auto, two] = [Method::Auto, Method::Two].map(|method| judged(&world, method));
            println!(
                "{}: {} hexes, worst {:.3}; of all {}, worst {:.3}",
                world.name,
                auto.refined.mesh.hexes.len(),
                auto.worst,
                two.refined.mesh.hexes.len(),
                two.worst
            );
            in_blocks += auto.refined.mesh.hexes.len();
            of_all += two.refined.mesh.hexes.len();
        }
        println!("{name}: {in_blocks} hexes, {of_all} where all are refined once");
        assert!(10 * in_blocks < 9 * of_all, "{name}: {in_blocks} of {of_all}");
    }
}
