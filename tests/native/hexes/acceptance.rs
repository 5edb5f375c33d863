//! What refinement of hexes must reach: worlds through the public pipeline, each with its bounds, and the judge.

use hexmill::Silent;
use hexmill::geometry::{BilinearQuad, Point};
use hexmill::io::{AnyMesh, Format, read};
use hexmill::mesh::quality::{Certainty, hex_quality};
use hexmill::mesh::topology::hex_boundary;
use hexmill::mesh::{HexMesh, Volumes, check_hexes};
use hexmill::refine::hex::{HexOptions, HexPlan, Method, RefinedHexes, refine_hexes};
use hexmill::sizing::{Region, Shape, Target};

use super::meshes::{Numbers, RADIUS, around, ball, cubes, cylinder, hull, i_beam, twisted};

/// A mesh, what is to be refined, and what must come of it.
pub struct World {
    pub name: String,
    pub input: HexMesh,
    pub regions: Vec<Region>,
    /// Where the boundary is.
    pub boundary: Boundary,
    /// The least scaled Jacobians that will do, for Methods I and II: a little below what is reached.
    pub least: [f64; 2],
}

/// The boundary of a world's mesh.
#[derive(Clone, Copy, PartialEq)]
pub enum Boundary {
    /// In planes: the volume is kept.
    Planar,
    /// On the cylinder of radius [`RADIUS`] about z, between planes.
    Cylinder,
    /// On the sphere of radius [`RADIUS`].
    Sphere,
    /// On bilinear faces; the volume changes by this share at most.
    Bilinear(f64),
}

/// What came of a world.
pub struct Judged {
    pub refined: RefinedHexes,
    /// The least scaled Jacobian.
    pub worst: f64,
    pub mean: f64,
}

/// A box to be refined to a level.
pub fn block(min: [f64; 3], max: [f64; 3], level: u8) -> Region {
    let shape = Shape::Box { min: min.into(), max: max.into(), rotation: Default::default() };
    Region { shape, target: Target::Level(level) }
}

/// Refines a world and holds the result to what every result must be: conforming, positive, on the boundary.
pub fn judged(world: &World, method: Method) -> Judged {
    let options = HexOptions { method, regions: world.regions.clone(), ..HexOptions::default() };
    let refined =
        refine_hexes(&world.input, &options, &Silent).unwrap_or_else(|e| panic!("{}: {e}", world.name));
    told_before(&world.name, &world.input, &options, &refined);
    let defects = check_hexes(&refined.mesh);
    assert!(defects.is_empty(), "{}, {method:?}: {defects:?}", world.name);
    let quality = hex_quality(&refined.mesh);
    assert!(quality.positive.iter().all(|&sure| sure == Certainty::Positive), "{}, {method:?}", world.name);
    world.boundary.judge(&world.input, &refined.mesh, &world.name);
    let worst = quality.scaled_jacobian.iter().copied().fold(f32::INFINITY, f32::min).into();
    let mean =
        quality.scaled_jacobian.iter().map(|&j| f64::from(j)).sum::<f64>() / quality.positive.len() as f64;
    Judged { refined, worst, mean }
}

/// What is made is what the plan has told, unless hexes stayed inside out.
pub fn told_before(name: &str, input: &HexMesh, options: &HexOptions, refined: &RefinedHexes) {
    let plan = HexPlan::new(input, options, &Silent).unwrap_or_else(|error| panic!("{name}: {error}"));
    if refined.added.repairs == 0 {
        assert_eq!(plan.added(), refined.added, "{name}");
        assert_eq!(plan.forecast().hexes, refined.mesh.hexes.len(), "{name}");
    }
}

impl Judged {
    /// How many times as many elements are refined, at levels from 1 on, as were asked for.
    pub fn growth(&self) -> f64 {
        let added = self.refined.added;
        // Elements refined at a conflict have siblings, which were not asked for either.
        let more = added.closure.method + 8 * (added.conflicts + added.repairs);
        let refined: usize = self.refined.stages.iter().skip(1).map(|stage| stage.refined).sum();
        if refined == 0 { 1.0 } else { refined as f64 / (refined - more) as f64 }
    }
}

/// How much the refined sets of many random worlds may grow with Method II, in the mean.
pub const MOST_GROWTH: f64 = 1.03;

impl Boundary {
    fn judge(self, input: &HexMesh, refined: &HexMesh, name: &str) {
        if self == Self::Planar {
            let [before, after] = [input, refined].map(|mesh| Volumes::of(mesh).expect("hexes").total);
            assert!((after - before).abs() <= 1e-9 * before, "{name}: the volume {before} became {after}");
            return;
        }
        if let Self::Bilinear(share) = self {
            let [before, after] = [input, refined].map(|mesh| Volumes::of(mesh).expect("hexes").total);
            let off = off_faces(input, refined);
            assert!(off <= ON_FACES, "{name}: a node is {off} off");
            assert!((after - before).abs() <= share * before, "{name}: the volume {before} became {after}");
            return;
        }
        let off = |p: Point| match self {
            Self::Sphere => RADIUS - p.length(),
            _ => RADIUS - p.truncate().length(),
        };
        let curved = |face: &[Point; 4]| face.iter().all(|&p| off(p).abs() < 1e-9);
        let chord = boundary_faces(input)
            .into_iter()
            .filter(curved)
            .map(|[a, b, c, d]| a.distance(c).max(b.distance(d)));
        let chord = chord.fold(0.0, f64::max);
        let sagitta = RADIUS - (RADIUS * RADIUS - chord * chord / 4.0).sqrt();
        for p in boundary_faces(refined).into_iter().flatten() {
            let on_cap = self == Self::Cylinder && (p.z.abs() < 1e-9 || (p.z - 3.0).abs() < 1e-9);
            let off = off(p);
            assert!(
                off >= -1e-9 && (on_cap || off <= sagitta),
                "{name}: {p} is {off} inside; sagitta {sagitta}"
            );
        }
    }
}

/// How far boundary nodes may be off bilinear faces: rounding.
const ON_FACES: f64 = 1e-12;

fn boundary_faces(mesh: &HexMesh) -> Vec<[Point; 4]> {
    hex_boundary(&mesh.hexes).iter().map(|(face, _)| face.map(|n| mesh.positions[n.index()])).collect()
}

/// How far the boundary nodes of a mesh are from another mesh's boundary faces, at most.
fn off_faces(input: &HexMesh, refined: &HexMesh) -> f64 {
    let faces: Vec<BilinearQuad> =
        boundary_faces(input).into_iter().map(|corners| BilinearQuad { corners }).collect();
    let off = |p: Point| {
        let distances = faces.iter().map(|face| face.point(face.closest(p)).distance(p));
        distances.fold(f64::INFINITY, f64::min)
    };
    boundary_faces(refined).into_iter().flatten().map(off).fold(0.0, f64::max)
}

/// Which of `n` cubes an axis are refined, and with two levels which of their octants again. The share grows with the
/// seed from hardly any to nearly all.
fn random_blocks(n: u32, seed: u64, of: u64, levels: u8) -> Vec<Region> {
    let mut numbers = Numbers(seed);
    let share = 0.05 + 0.9 * seed as f64 / of as f64;
    let mut regions = Vec::new();
    for cube in 0..n * n * n {
        let at = [cube % n, cube / n % n, cube / n / n].map(f64::from);
        if numbers.next() >= share {
            continue;
        }
        regions.push(block(at, at.map(|x| x + 1.0), 2));
        for octant in 0..8 {
            let at = [0, 1, 2].map(|axis| at[axis] + f64::from(octant >> axis & 1) / 2.0);
            if levels == 2 && numbers.next() < share {
                regions.push(block(at, at.map(|x| x + 0.5), 3));
            }
        }
    }
    regions
}

/// A random set in `2 n` cells an axis, refined once or twice.
pub fn random_set(n: u32, seed: u64, of: u64, levels: u8) -> World {
    World {
        name: format!("random set {seed} of {levels} levels in {} cells an axis", 2 * n),
        input: cubes(n),
        regions: random_blocks(n, seed, of, levels),
        boundary: Boundary::Planar,
        least: [if levels == 1 { 0.62 } else { 0.55 }, 0.225],
    }
}

/// Some of the eight families around a node, by the bits of `mask`.
pub fn octants(mask: u32) -> World {
    let chosen = (0..8).filter(|k| mask >> k & 1 == 1);
    let blocks = chosen.map(|k| {
        let at = [0, 1, 2].map(|axis| 1.0 + f64::from(k >> axis & 1));
        block(at, at.map(|x| x + 1.0), 2)
    });
    World {
        name: format!("octants {mask:#010b}"),
        input: cubes(4),
        regions: blocks.collect(),
        boundary: Boundary::Planar,
        least: [0.68, 0.225],
    }
}

/// Random sets on the I-beam.
pub fn random_on_beam(seed: u64, of: u64) -> World {
    let mut numbers = Numbers(1000 + seed);
    let input = i_beam();
    let share = 0.05 + 0.6 * seed as f64 / of as f64;
    let cells = input.hexes.iter().map(|hex| input.positions[hex[0].index()].to_array());
    let regions =
        cells.filter(|_| numbers.next() < share).map(|at| block(at, at.map(|x| x + 1.0), 2)).collect();
    World {
        name: format!("random set {seed} on the I-beam"),
        input,
        regions,
        boundary: Boundary::Planar,
        least: [0.63, 0.195],
    }
}

/// The named worlds; `levels` finer than their coarsest form where they are governed by surfaces.
pub fn named(fine: u8) -> Vec<World> {
    let planar = |name: &str, input: HexMesh, regions: Vec<Region>, least| World {
        name: name.into(),
        input,
        regions,
        boundary: Boundary::Planar,
        least,
    };
    let beam = planar(
        "I-beam refined twice at two places",
        i_beam(),
        vec![
            block([1.0, 0.0, 1.0], [4.0, 2.0, 3.0], 2),
            block([2.0, 0.0, 1.5], [3.0, 1.5, 2.5], 3),
            block([0.0, 4.0, 5.0], [2.0, 5.0, 8.0], 2),
            block([0.0, 4.0, 6.0], [1.0, 5.0, 7.0], 3),
        ],
        [0.68, 0.345],
    );
    let ball_at = |center: [f64; 3], radius, level| Region {
        shape: Shape::Sphere { center: center.into(), radius },
        target: Target::Level(level),
    };
    let curved = |name: &str, input, regions, boundary, least| World {
        name: name.into(),
        input,
        regions,
        boundary,
        least,
    };
    let (positions, triangles) = hull();
    let water = around(&positions, 1.0, 1.0);
    let governing = Region {
        shape: Shape::Surface { positions, triangles, distance: 0.0 },
        target: Target::Level(1 + fine),
    };
    let bytes = include_bytes!("../../../examples/models/solids/bunny.obj");
    let AnyMesh::Polygons(bunny) = read(bytes, Format::Obj).expect("an example").mesh else {
        unreachable!("a surface")
    };
    let size = bunny.bounds().diagonal();
    let box_of_bunny = around(&bunny.positions, size / 8.0, size / 16.0);
    let points = Region {
        shape: Shape::Points { points: bunny.positions, radius: 0.0 },
        target: Target::Level(1 + fine),
    };
    vec![
        beam,
        curved(
            "cylinder, a wedge",
            cylinder(),
            vec![block([0.3, -3.0, 0.4], [3.0, 3.0, 1.1], 2), ball_at([2.0, 0.0, 0.75], 0.3, 3)],
            Boundary::Cylinder,
            [0.63, 0.445],
        ),
        curved(
            "cylinder, the core",
            cylinder(),
            vec![block([-0.6, -0.6, -1.0], [0.6, 0.6, 4.0], 2)],
            Boundary::Cylinder,
            [0.54, 0.42],
        ),
        curved(
            "ball, at the surface",
            ball(),
            vec![ball_at([2.0, 0.3, 0.3], 0.6, 2), ball_at([2.0, 0.3, 0.3], 0.2, 3)],
            Boundary::Sphere,
            [0.645, 0.425],
        ),
        curved(
            "ball, half of it",
            ball(),
            vec![block([0.1, -3.0, -3.0], [3.0; 3], 2)],
            Boundary::Sphere,
            [0.62, 0.615],
        ),
        planar("submarine in a box of water", water, vec![governing], [0.64, 0.46]),
        planar("bunny's points in a box", box_of_bunny, vec![points], [0.645, 0.445]),
    ]
}

/// Worlds with warped boundary faces, and the least scaled Jacobian that will do for Method III. Their volume changes by
/// what the chords of finer faces leave out.
pub fn warped() -> Vec<(World, f64)> {
    let world = |name: &str, input, regions, volume, [one, two, three]: [f64; 3]| {
        let (boundary, least) = (Boundary::Bilinear(volume), [one, two]);
        (World { name: name.into(), input, regions, boundary, least }, three)
    };
    let turned = || twisted([3, 3, 3], 0.18);
    let at_side = |level| vec![block([1.1, -0.1, 1.4], [1.4, 0.1, 1.6], level)];
    let edge = vec![block([0.9, 0.9, 0.2], [1.9, 1.9, 0.8], 2)];
    let column = vec![block([-2.0, 0.3, 1.2], [2.0, 2.0, 3.8], 2)];
    let on_ball = Region {
        shape: Shape::Sphere { center: Point::new(2.0, 0.3, 0.3), radius: 0.6 },
        target: Target::Level(2),
    };
    vec![
        world("twisted box, at a side", turned(), at_side(2), 2e-4, [0.68, 0.46, 0.25]),
        world("twisted box, at a side, thrice", turned(), at_side(3), 2e-4, [0.69, 0.455, 0.355]),
        world("twisted box, at an edge", turned(), edge, 3e-4, [0.69, 0.465, 0.375]),
        world("twisted column", twisted([2, 2, 6], 0.3), column, 5e-4, [0.67, 0.49, 0.36]),
        world("ball of warped faces", ball(), vec![on_ball], 1.5e-3, [0.65, 0.435, 0.365]),
    ]
}
