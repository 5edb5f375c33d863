//! Groups of faces between hexes are kept where they are and inherited, as those of boundary faces are.

use std::collections::BTreeMap;

use hexmill::Silent;
use hexmill::geometry::Point;
use hexmill::mesh::quality::{Certainty, hex_quality};
use hexmill::mesh::topology::{HexFaces, Side, hex_of, side_nodes};
use hexmill::mesh::{FaceGroups, HexMesh, TagSet, Tags, check_hexes};
use hexmill::refine::hex::{HexOptions, Method, refine_hexes};
use hexmill::sizing::{Region, Target};
use rayon::prelude::*;

use super::acceptance::{block, random_set, told_before};
use super::meshes::{Numbers, RADIUS, cubes, cylinder};

const METHODS: [Method; 3] = [Method::One, Method::Two, Method::Three];

/// Gives groups to sides of a mesh between hexes, told from the lesser one.
fn grouped(mesh: &HexMesh, mut group: impl FnMut(Point, Side) -> Option<u32>) -> HexMesh {
    let faces = HexFaces::of(mesh.positions.len(), &mesh.hexes);
    let inner = faces.ids().filter(|&f| !faces.is_boundary(f)).map(|f| faces.sides(f)[0]);
    let mut labels: Vec<(Side, u32)> =
        inner.filter_map(|side| Some((side, group(middle(mesh, side), side)?))).collect();
    labels.sort_unstable();
    on(mesh, labels)
}

fn on(mesh: &HexMesh, labels: Vec<(Side, u32)>) -> HexMesh {
    let (sides, of_element): (Vec<Side>, Vec<u32>) = labels.into_iter().unzip();
    let count = of_element.iter().max().map_or(0, |&most| most + 1);
    let sets = (0..count).map(|k| TagSet { groups: vec![format!("group {k}").into()], ..TagSet::default() });
    let groups = FaceGroups::new(sides, Tags { sets: sets.collect(), of_element });
    HexMesh { groups: groups.expect("sorted"), ..mesh.clone() }
}

fn corners(mesh: &HexMesh, side: Side) -> [Point; 4] {
    side_nodes(&mesh.hexes, side).map(|n| mesh.positions[n.index()])
}

fn middle(mesh: &HexMesh, side: Side) -> Point {
    corners(mesh, side).into_iter().sum::<Point>() / 4.0
}

/// Twice the area of a side, along its normal.
fn area(mesh: &HexMesh, side: Side) -> Point {
    let [a, b, c, d] = corners(mesh, side);
    (c - a).cross(d - b)
}

/// What each group covers: the absolute area and, by the sides that it is told from, the signed one.
fn areas(mesh: &HexMesh) -> BTreeMap<u32, (f64, Point)> {
    let mut areas: BTreeMap<u32, (f64, Point)> = BTreeMap::new();
    for (side, group) in mesh.groups.labels() {
        let (size, sum) = areas.entry(group).or_default();
        *size += area(mesh, side).length() / 2.0;
        *sum += area(mesh, side) / 2.0;
    }
    areas
}

/// Refines, and holds the result to what every result must be: its groups lie between hexes, each child of a face in
/// its plane and within it. Returns the mesh and its least scaled Jacobian.
fn refine(name: &str, input: &HexMesh, regions: &[Region], method: Method) -> (HexMesh, f64) {
    let target = |target| if method == Method::Three { Target::Level(1) } else { target };
    let regions = regions.iter().map(|region| Region { target: target(region.target), ..region.clone() });
    let options = HexOptions { method, regions: regions.collect(), ..HexOptions::default() };
    let refined = refine_hexes(input, &options, &Silent);
    let refined = refined.unwrap_or_else(|error| panic!("{name}, {method:?}: {error}"));
    told_before(&format!("{name}, {method:?}"), input, &options, &refined);
    let refined = refined.mesh;
    assert_eq!(check_hexes(&refined), [], "{name}, {method:?}");
    let quality = hex_quality(&refined);
    assert!(quality.positive.iter().all(|&sure| sure == Certainty::Positive), "{name}, {method:?}");
    let faces = HexFaces::of(refined.positions.len(), &refined.hexes);
    for (side, _) in refined.groups.labels() {
        let face = faces.of_hex[hex_of(side).index()][side as usize % 6];
        assert_eq!(faces.sides(face).len(), 2, "{name}, {method:?}: side {side}");
    }
    let worst = quality.scaled_jacobian.iter().copied().fold(f32::INFINITY, f32::min);
    (refined, worst.into())
}

/// Refines a mesh of cubes: each group covers what it did, face by face of the input, and looks the same way.
fn of_cubes(name: &str, input: &HexMesh, regions: &[Region], method: Method) -> f64 {
    let (refined, worst) = refine(name, input, regions, method);
    let (before, after) = (areas(input), areas(&refined));
    assert!(before.keys().eq(after.keys()), "{name}, {method:?}: {before:?} became {after:?}");
    for (group, (size, sum)) in &before {
        let (new_size, new_sum) = after[group];
        let is_kept = (size - new_size).abs() <= 1e-9 * size && sum.distance(new_sum) <= 1e-9 * size;
        assert!(is_kept, "{name}, {method:?}, group {group}: {size} {sum} became {new_size} {new_sum}");
    }
    let known: BTreeMap<[i64; 3], u32> =
        input.groups.labels().map(|(side, group)| (key(middle(input, side)), group)).collect();
    for (side, group) in refined.groups.labels() {
        let (at, normal) = (middle(&refined, side), area(&refined, side).normalize());
        let axis = (0..3).find(|&axis| normal[axis].abs() > 1.0 - 1e-9);
        let axis = axis.unwrap_or_else(|| panic!("{name}, {method:?}: side {side} has left its plane"));
        let mut of_face = at.floor() + Point::splat(0.5);
        of_face[axis] = at[axis].round();
        assert!((at[axis] - of_face[axis]).abs() < 1e-9, "{name}, {method:?}: side {side} at {at}");
        assert_eq!(known.get(&key(of_face)), Some(&group), "{name}, {method:?}: side {side} at {at}");
    }
    worst
}

/// The middle of a face of unit cubes, in halves.
fn key(middle: Point) -> [i64; 3] {
    (middle * 2.0).round().to_array().map(|x| x as i64)
}

/// Cells of a cube of `count`³ unit cubes, by their bits.
fn cells(count: usize, bits: u32) -> Vec<Region> {
    let at = |k: usize| [k % count, k / count % count, k / (count * count)].map(|x| x as f64);
    let chosen = (0..count.pow(3)).filter(|k| bits >> k & 1 == 1);
    chosen.map(|k| block(at(k), at(k).map(|x| x + 1.0), 2)).collect()
}

/// All sets of 2 x 2 x 2 cubes are refined, with a plane between them of which all is in a group, or some.
#[test]
fn any_faces_of_a_plane_between_any_of_eight_cubes() {
    let planes: Vec<HexMesh> = (1..16u32)
        .map(|chosen| {
            let bit = |p: Point| u32::from(p.y > 1.0) + 2 * u32::from(p.z > 1.0);
            let is_in = |p: Point| p.x == 1.0 && chosen >> bit(p) & 1 == 1;
            grouped(&cubes(2), |p, _| is_in(p).then_some(u32::from(p.z > 1.0 && chosen % 2 == 0)))
        })
        .collect();
    let worlds = (0..256u32).flat_map(|mask| {
        let others = [14, (7 * mask) % 14];
        others.map(|plane| (mask, plane as usize))
    });
    let worlds: Vec<(u32, usize)> = worlds.collect();
    let worst = worlds.par_iter().map(|&(mask, plane)| {
        METHODS.map(|method| {
            of_cubes(&format!("set {mask}, faces {}", plane + 1), &planes[plane], &cells(2, mask), method)
        })
    });
    let worst = worst.reduce(|| [1.0; 3], |a, b| [0, 1, 2].map(|k| f64::min(a[k], b[k])));
    println!("{worst:?}");
    assert!(worst[0] >= 0.43 && worst[1] >= 0.20 && worst[2] > 0.0, "{worst:?}");
}

/// Planes, parts of planes that end inside, a bend, and two that cross, in a box with regions at, across and beside them.
#[test]
fn sheets_that_end_inside_bend_and_cross() {
    type Group = fn(Point) -> Option<u32>;
    let sheets: [(&str, Group); 6] = [
        ("plane", |p| (p.x == 2.0).then_some(0)),
        ("half plane", |p| (p.x == 2.0 && p.y < 2.0).then_some(0)),
        ("patch", |p| (p.x == 2.0 && (1.0..3.0).contains(&p.y) && (1.0..3.0).contains(&p.z)).then_some(0)),
        ("bend", |p| ((p.x == 2.0 && p.y < 2.0) || (p.y == 2.0 && p.x < 2.0)).then_some(0)),
        ("bend of patches", |p| {
            let is_near = p.z > 1.0 && p.x > 1.0 && p.y > 1.0;
            (is_near && ((p.x == 2.0 && p.y < 2.0) || (p.y == 2.0 && p.x < 2.0)))
                .then_some(u32::from(p.x == 2.0))
        }),
        ("cross", |p| if p.x == 2.0 { Some(0) } else { (p.y == 2.0 && p.z > 2.0).then_some(1) }),
    ];
    let regions = [
        ("across", vec![block([1.0; 3], [3.0; 3], 2)]),
        ("at it", vec![block([2.0, 1.0, 1.0], [3.0, 3.0, 3.0], 2)]),
        ("beside", vec![block([3.0, 0.0, 0.0], [4.0, 4.0, 2.0], 2)]),
        ("its end", vec![block([1.0, 1.5, 1.0], [3.0, 2.5, 2.0], 2)]),
        ("two levels", vec![block([1.0; 3], [3.0; 3], 2), block([1.5; 3], [2.5; 3], 3)]),
    ];
    let worlds: Vec<_> = sheets.iter().flat_map(|sheet| regions.iter().map(move |r| (sheet, r))).collect();
    worlds.par_iter().for_each(|((sheet, group), (place, regions))| {
        let input = grouped(&cubes(4), |p, _| group(p));
        for method in METHODS {
            let name = format!("{sheet}, {place}");
            let worst = of_cubes(&name, &input, regions, method);
            println!("{name}, {method:?}: worst {worst:.3}");
            assert!(worst >= if method == Method::One { 0.43 } else { 0.15 }, "{name}, {method:?}: {worst}");
        }
    });
}

/// Any faces between any cells: no manifold, with corners, ends and crossings everywhere.
#[test]
fn any_faces_between_cells() {
    let worst = (0..40u64).into_par_iter().map(|seed| {
        let mut numbers = Numbers(1234 + seed);
        let world = random_set(3, 2 * seed, 80, 1);
        let share = [0.05, 0.15, 0.4][seed as usize % 3];
        let group = |numbers: &mut Numbers| (numbers.next() < share).then(|| (2.0 * numbers.next()) as u32);
        let input = grouped(&world.input, |_, _| group(&mut numbers));
        // One of the groups is told from the other hexes.
        let faces = HexFaces::of(input.positions.len(), &input.hexes);
        let mut labels: Vec<(Side, u32)> = input.groups.labels().collect();
        for (side, _) in labels.iter_mut().filter(|(_, group)| *group == 1) {
            *side = faces.sides(faces.of_hex[hex_of(*side).index()][*side as usize % 6])[1];
        }
        labels.sort_unstable();
        let input = on(&input, labels);
        METHODS.map(|method| of_cubes(&format!("{} of {share}", world.name), &input, &world.regions, method))
    });
    let worst = worst.reduce(|| [1.0; 3], |a, b| [0, 1, 2].map(|k| f64::min(a[k], b[k])));
    println!("{worst:?}");
}

/// A cylinder of faces within a cylinder, all around or in part: nodes stay on its chords.
#[test]
fn a_curved_sheet_is_kept() {
    let mesh = cylinder();
    let is_core = |p: Point| p.x.abs().max(p.y.abs()) < 1.001;
    let is_around = |p: Point| p.truncate().abs().max_element() > 0.999 && is_core(p);
    for (part, is_all) in [("all", true), ("half", false)] {
        let input = grouped(&mesh, |p, side| {
            let normal = area(&mesh, side).normalize();
            let is_wall = normal.z.abs() < 0.1 && is_around(p) && p.truncate().length() < 0.9 * RADIUS;
            (is_wall && (is_all || p.x + p.y > 0.0)).then_some(0)
        });
        assert!(!input.groups.is_empty());
        let regions = [block([0.3, -3.0, 1.0], [3.0, 3.0, 2.0], 2)];
        for method in METHODS {
            let (refined, worst) = refine(part, &input, &regions, method);
            let (before, after) = (areas(&input)[&0].0, areas(&refined)[&0].0);
            println!("{part}, {method:?}: {} faces, worst {worst:.3}", refined.groups.sides().len());
            assert!((before - after).abs() <= 1e-9 * before, "{part}, {method:?}: {before}, {after}");
            assert!(worst >= 0.15, "{part}, {method:?}: {worst}");
        }
    }
}
