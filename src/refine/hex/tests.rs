//! Small worlds whose boundary is free.

use std::collections::BTreeSet;

use proptest::prelude::*;
use rayon::prelude::*;

use super::{Added, HexBlocks, HexOptions, HexPlan, Method};
use crate::Silent;
use crate::geometry::Point;
use crate::mesh::numbering::hex::{CORNER_AT, SYMMETRIES};
use crate::mesh::quality::scaled_jacobian;
use crate::mesh::{Defect, HexMesh, NodeId, check_hexes};
use crate::sizing::{Region, Shape, Target};

/// Those of so many cubes a side that are there, and their places.
fn cubes(count: usize, is_there: impl Fn([usize; 3]) -> bool) -> (HexMesh, Vec<[usize; 3]>) {
    const CORNERS: [[usize; 3]; 8] =
        [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
    let all = (0..count.pow(3)).map(|cube| [cube % count, cube / count % count, cube / count.pow(2)]);
    let places: Vec<[usize; 3]> = all.filter(|&at| is_there(at)).collect();
    let mut mesh = HexMesh::default();
    let mut number = vec![None; (count + 1).pow(3)];
    for at in &places {
        mesh.hexes.push(CORNERS.map(|corner| {
            let [x, y, z] = [0, 1, 2].map(|k| at[k] + corner[k]);
            *number[x + (count + 1) * (y + (count + 1) * z)].get_or_insert_with(|| {
                mesh.positions.push(Point::new(x as f64, y as f64, z as f64));
                NodeId::new(mesh.positions.len() - 1)
            })
        }));
    }
    (mesh, places)
}

/// Refines hexes of a mesh once, and says what was refined besides, and what is wrong with the result.
fn refined(
    mesh: &HexMesh,
    is_wanted: impl Fn(usize) -> bool,
    method: Method,
    blocks: Option<&HexBlocks>,
) -> (Added, Vec<Defect>) {
    let middle = |h: usize| mesh.hexes[h].iter().map(|n| mesh.positions[n.index()]).sum::<Point>() / 8.0;
    let points: Vec<Point> = (0..mesh.hexes.len()).filter(|&h| is_wanted(h)).map(middle).collect();
    let asked = points.len();
    let shape = Shape::Points { points, radius: 0.1 };
    let regions = vec![Region { shape, target: Target::Level(1) }];
    let options = HexOptions { method, regions, ..HexOptions::default() };
    let plan = HexPlan::of_conforming(mesh, blocks, &options, &Silent).unwrap();
    let made = plan.carry_out(&Silent).unwrap();
    let corners = |hex: &[NodeId; 8]| hex.map(|n| made.mesh.positions[n.index()]);
    let worst = made.mesh.hexes.iter().map(|hex| scaled_jacobian(&corners(hex))).fold(1.0, f64::min);
    assert!(worst > 0.0, "{worst}");
    let refined = made.stages.first().map_or(0, |stage| stage.refined);
    assert_eq!(refined, asked + made.added.growth());
    (made.added, check_hexes(&made.mesh))
}

/// What each of two by two by two cells is, in the order of its corner.
type World = [u8; 8];

const AWAY: u8 = 0;
const COARSE: u8 = 1;
const REFINED: u8 = 2;

/// All worlds with coarse cells and refined ones, one for each symmetry.
fn worlds() -> Vec<World> {
    let all = (0..3usize.pow(8)).map(|code| std::array::from_fn(|k| (code / 3usize.pow(k as u32) % 3) as u8));
    let has_both = |world: &World| [COARSE, REFINED].iter().all(|kind| world.contains(kind));
    let least = |world: World| {
        let image = |symmetry: &[u8; 8]| symmetry.map(|k| world[usize::from(k)]);
        SYMMETRIES.iter().map(image).min().expect("there is the identity")
    };
    all.filter(has_both).map(least).collect::<BTreeSet<World>>().into_iter().collect()
}

/// In how many worlds nothing is refined but what is to be: of cells that are one cube, or a block of eight. The others.
fn looked_at(side: usize, method: Method) -> (usize, Vec<World>) {
    let at_corner = |bits: [usize; 3]| CORNER_AT[bits[0] + 2 * bits[1] + 4 * bits[2]];
    let cell = |at: [usize; 3]| at_corner(at.map(|x| x / side));
    let is_grown = |world: &World| {
        let (mesh, places) = cubes(2 * side, |at| world[usize::from(cell(at))] != AWAY);
        if !check_hexes(&mesh).is_empty() {
            return None;
        }
        let block = places.iter().map(|&at| u32::from(cell(at))).collect();
        let octant = places.iter().map(|at| at_corner(at.map(|x| x % side))).collect();
        let blocks = (side > 1).then_some(HexBlocks { block, octant });
        let is_wanted = |h: usize| world[usize::from(cell(places[h]))] == REFINED;
        let (added, defects) = refined(&mesh, is_wanted, method, blocks.as_ref());
        assert_eq!(defects, [], "{world:?}");
        Some((*world, added.growth() > 0))
    };
    let seen: Vec<(World, bool)> = worlds().par_iter().filter_map(is_grown).collect();
    let grown: Vec<World> = seen.iter().filter(|(_, grown)| *grown).map(|(world, _)| *world).collect();
    (seen.len() - grown.len(), grown)
}

#[test]
fn cells_of_any_small_world_are_cut_in_thirds_up_to_a_free_boundary() {
    assert_eq!(looked_at(1, Method::Three), (125, vec![]));
}

#[test]
fn blocks_of_any_small_world_are_halved_up_to_a_free_boundary() {
    assert_eq!(looked_at(2, Method::Auto), (125, vec![]));
}

/// How far columns of the stairs end below the one before, along both axes.
type Drops = [[usize; 4]; 4];

/// Refines cubes of stairs that are lower from column to column along both axes. The boundary is free to move, and parts
/// of it might touch where what is between a step and its cubes gets thin; nothing else may be wrong.
fn refine_stairs(drops: &Drops, is_wanted: impl Fn(usize) -> bool) -> Vec<Defect> {
    let drop = |x: usize, y: usize| drops[..=x].iter().flat_map(|row| &row[..=y]).sum::<usize>() / 3;
    let (mesh, places) = cubes(4, |[x, y, z]| z + drop(x, y) < 4);
    assert_eq!(check_hexes(&mesh), []);
    let place = |h: usize| places[h][0] + 4 * places[h][1] + 16 * places[h][2];
    refined(&mesh, |h| is_wanted(place(h)), Method::Three, None).1
}

fn is_touch(defect: &Defect) -> bool {
    matches!(defect, Defect::HangingNode { .. } | Defect::HangingNodeInFace { .. })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Stairs with any cells refined.
    #[test]
    fn stairs_are_refined_up_to_a_free_boundary(
        drops in prop::array::uniform4(prop::array::uniform4(0usize..2)),
        wanted in prop::collection::vec(prop::bool::weighted(0.3), 64),
    ) {
        let mut defects = refine_stairs(&drops, |place| wanted[place]);
        defects.retain(|defect| !is_touch(defect));
        prop_assert_eq!(defects, []);
    }
}

/// Steps so close to each other that they would touch if what is between them were smoothed in all courses.
#[test]
fn close_parts_of_a_free_boundary_do_not_touch() {
    let drops = [[0, 1, 1, 0], [1, 0, 1, 0], [1, 1, 1, 0], [1, 1, 0, 0]];
    let wanted = [0, 1, 4, 7, 11, 24, 25, 26, 37, 38, 40, 45, 49, 52, 53, 56];
    assert_eq!(refine_stairs(&drops, |place| wanted.contains(&place)), []);
}
