//! Groups of boundary faces are inherited: by what the faces divide, within their borders.

use std::collections::BTreeMap;

use hexmill::Silent;
use hexmill::geometry::Point;
use hexmill::mesh::topology::{HexFaces, side_nodes};
use hexmill::mesh::{FaceGroups, HexMesh, TagSet, Tags, check_hexes};
use hexmill::refine::hex::{HexOptions, Method, RefinedHexes, refine_hexes};
use hexmill::sizing::Region;

use super::acceptance::{block, named};
use super::meshes::{Numbers, cells, cubes, cylinder, i_beam};

/// Gives groups to the boundary faces of a mesh, by their middles and outward normals.
fn grouped(mesh: &HexMesh, group: impl Fn(Point, Point) -> Option<u32>) -> HexMesh {
    let faces = HexFaces::of(mesh.positions.len(), &mesh.hexes);
    let boundary = faces.ids().filter(|&f| faces.is_boundary(f)).map(|f| faces.sides(f)[0]);
    let mut labels: Vec<(u32, u32)> = boundary
        .filter_map(|side| {
            let [a, b, c, d] = side_nodes(&mesh.hexes, side).map(|n| mesh.positions[n.index()]);
            let normal = (c - a).cross(d - b).normalize();
            Some((side, group((a + b + c + d) / 4.0, normal)?))
        })
        .collect();
    labels.sort_unstable();
    let (sides, of_element): (Vec<u32>, Vec<u32>) = labels.into_iter().unzip();
    let count = of_element.iter().max().map_or(0, |&most| most + 1);
    let sets = (0..count).map(|k| TagSet { groups: vec![format!("group {k}").into()], ..TagSet::default() });
    let groups = FaceGroups::new(sides, Tags { sets: sets.collect(), of_element });
    HexMesh { groups: groups.expect("sorted"), ..mesh.clone() }
}

/// The area of each group and of the boundary faces that are in none.
fn areas(mesh: &HexMesh) -> BTreeMap<Option<u32>, f64> {
    let group: BTreeMap<u32, u32> = mesh.groups.labels().collect();
    let faces = HexFaces::of(mesh.positions.len(), &mesh.hexes);
    let mut areas = BTreeMap::new();
    for f in faces.ids().filter(|&f| faces.is_boundary(f)) {
        let side = faces.sides(f)[0];
        let [a, b, c, d] = side_nodes(&mesh.hexes, side).map(|n| mesh.positions[n.index()]);
        *areas.entry(group.get(&side).copied()).or_insert(0.0) += (c - a).cross(d - b).length() / 2.0;
    }
    areas
}

/// Refines, checks that each group has the area it had, and that its faces still look the way `group` says.
fn check(
    name: &str,
    input: &HexMesh,
    regions: Vec<Region>,
    method: Method,
    group: impl Fn(Point, Point) -> Option<u32>,
) -> RefinedHexes {
    let input = grouped(input, &group);
    let refined = refine_hexes(&input, &HexOptions { method, regions, ..HexOptions::default() }, &Silent);
    let refined = refined.unwrap_or_else(|error| panic!("{name}, {method:?}: {error}"));
    assert_eq!(check_hexes(&refined.mesh), [], "{name}, {method:?}");
    let (before, after) = (areas(&input), areas(&refined.mesh));
    assert!(before.keys().eq(after.keys()), "{name}, {method:?}: {before:?} became {after:?}");
    for (group, area) in &before {
        assert!((after[group] - area).abs() <= 1e-9 * area, "{name}, {method:?}: {before:?}, {after:?}");
    }
    assert_eq!(refined.mesh.groups, grouped(&refined.mesh, &group).groups, "{name}, {method:?}");
    refined
}

const METHODS: [Method; 3] = [Method::One, Method::Two, Method::Three];

/// Which of six sides a boundary face of a box looks to.
fn side_of(_: Point, normal: Point) -> Option<u32> {
    let axis = (0..3).find(|&axis| normal[axis].abs() > 0.9)? as u32;
    Some(2 * axis + u32::from(normal[axis as usize] > 0.0))
}

#[test]
fn six_sides_of_a_cube_stay_what_they_are() {
    let regions = || vec![block([0.0; 3], [1.5, 1.0, 1.0], 2), block([2.1, 0.0, 0.0], [2.9, 0.9, 3.0], 2)];
    for method in METHODS {
        let refined = check("cube", &cubes(3), regions(), method, side_of);
        assert!(!areas(&refined.mesh).contains_key(&None));
        assert!(refined.mesh.hexes.len() > 8 * 27);
    }
}

/// Borders of groups in the middle of a flat side are kept, though nothing but the groups tells of them.
#[test]
fn groups_end_where_they_did_on_flat_sides() {
    let patches = |middle: Point, normal: Point| match side_of(middle, normal)? {
        4 if middle.x < 2.0 && middle.y < 1.0 => Some(0),
        4 if middle.x < 2.0 => Some(1),
        1 if middle.z > 1.0 => Some(2),
        _ => None,
    };
    let mut numbers = Numbers(7);
    let mut worlds = vec![
        ("at a border", vec![block([0.0; 3], [2.0, 1.0, 1.0], 2)]),
        ("across borders", vec![block([1.0, 0.0, 0.0], [2.6, 2.0, 1.6], 2)]),
        ("two levels", vec![block([0.0; 3], [2.0, 2.0, 1.0], 2), block([1.0, 0.5, 0.0], [2.0, 1.0, 0.4], 3)]),
    ];
    for _ in 0..2 {
        let cells = (0..27).map(|k| [k % 3, k / 3 % 3, k / 9].map(f64::from));
        let chosen: Vec<[f64; 3]> = cells.filter(|_| numbers.next() < 0.4).collect();
        worlds.push(("random", chosen.into_iter().map(|at| block(at, at.map(|x| x + 1.0), 2)).collect()));
    }
    for (name, regions) in worlds {
        for method in METHODS {
            check(name, &cubes(3), regions.clone(), method, patches);
        }
    }
}

/// A border that turns on a flat side keeps its corner, by however few degrees it turns.
#[test]
fn borders_keep_their_corners_on_flat_sides() {
    for degrees in [5.0_f64, 25.0, 35.0] {
        // The plane between two halves is bent at y = 2; the sides stay flat.
        let bend = |y: f64| degrees.to_radians().tan() * (y - 2.0).max(0.0);
        let place = |p: Point| Point::new(p.x + bend(p.y) * (1.0 - (p.x - 2.0).abs() / 2.0), p.y, p.z);
        let input = cells([4, 4, 4], |_| true, place);
        let halves = |middle: Point, normal: Point| match side_of(middle, normal)? {
            4 => Some(u32::from(middle.x > 2.0 + bend(middle.y))),
            _ => None,
        };
        let regions =
            [block([1.0, 1.0, 0.0], [3.0, 2.0, 1.0], 2), block([2.0, 1.0, 0.0], [4.0, 4.0, 1.0], 2)];
        for (region, method) in regions.iter().flat_map(|region| METHODS.map(|method| (region, method))) {
            check(&format!("turn of {degrees}"), &input, vec![region.clone()], method, halves);
        }
    }
}

#[test]
fn groups_of_beams_and_cylinders_are_kept() {
    // The flanges' undersides and the web, and the beam's ends.
    let of_beam = |_: Point, normal: Point| side_of(normal, normal).filter(|&side| side != 5);
    let regions = named(1).swap_remove(0).regions;
    for method in [Method::One, Method::Two] {
        check("I-beam", &i_beam(), regions.clone(), method, of_beam);
    }
    // Curved areas change; the groups must only be told apart as they were.
    let of_cylinder = |middle: Point, normal: Point| match normal.z {
        z if z > 0.9 => Some(0),
        z if z < -0.9 => None,
        _ => Some(if middle.z > 1.5 { 1 } else { 2 }),
    };
    let input = grouped(&cylinder(), of_cylinder);
    for method in METHODS {
        let regions = vec![block([0.3, -3.0, 1.0], [3.0, 3.0, 2.0], 2)];
        let options = HexOptions { method, regions, ..HexOptions::default() };
        let refined = refine_hexes(&input, &options, &Silent).expect("a cylinder").mesh;
        assert_eq!(refined.groups, grouped(&refined, of_cylinder).groups, "{method:?}");
    }
}

#[test]
fn hexes_that_are_turned_take_their_groups_along() {
    let mut mesh = grouped(&cubes(2), side_of);
    let expected = refine_hexes(&mesh, &HexOptions { levels: Some(1), ..HexOptions::default() }, &Silent);
    let mirrored: Vec<u32> = vec![0, 3];
    for &h in &mirrored {
        mesh.hexes[h as usize].rotate_left(4);
    }
    let renumbered = mesh.groups.labels().map(|(side, label)| match side {
        side if mirrored.contains(&(side / 6)) && side % 6 < 2 => (side ^ 1, label),
        side => (side, label),
    });
    let mut labels: Vec<(u32, u32)> = renumbered.collect();
    labels.sort_unstable();
    let (sides, of_element) = labels.into_iter().unzip();
    let sets = mesh.groups.tags().sets.clone();
    mesh.groups = FaceGroups::new(sides, Tags { sets, of_element }).expect("sorted");
    let refined = refine_hexes(&mesh, &HexOptions { levels: Some(1), ..HexOptions::default() }, &Silent);
    assert_eq!(refined.expect("cubes").mesh, expected.expect("cubes").mesh);
}

#[test]
fn groups_of_what_is_no_face_are_refused() {
    let mut mesh = cubes(2);
    let tags = |count: usize| Tags { sets: vec![TagSet::default()], of_element: vec![0; count] };
    // Face x = 1 of the first cube is face x = 0 of the second.
    for (sides, kind) in [(vec![48], "noSuchFace"), (vec![3, 6 + 5], "faceGroupedTwice")] {
        let count = sides.len();
        mesh.groups = FaceGroups::new(sides, tags(count)).expect("ascending");
        assert_eq!(check_hexes(&mesh).iter().map(|d| d.kind()).collect::<Vec<_>>(), [kind]);
        let refused = refine_hexes(&mesh, &HexOptions::default(), &Silent).unwrap_err();
        assert_eq!(refused.code(), "mesh-invalid");
    }
}
