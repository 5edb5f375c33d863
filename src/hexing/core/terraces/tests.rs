use std::f64::consts::SQRT_2;

use super::super::manifold::make_manifold;
use super::super::testing::{Stop, cubes, noise, refined_cubes};
use super::super::{boundary_euler, compact};
use super::*;
use crate::Silent;
use crate::mesh::{HexMesh, check_hexes};

/// All creases of the boundary.
fn creases(cells: &Cells<'_>, inside: &[bool]) -> i64 {
    let leveller = Leveller { cells, depth: &[], shallow: Vec::new(), normals: Vec::new() };
    let edges = distinct(cells.mesh.hexes.iter().flat_map(ends_of_edges).collect());
    edges.into_iter().map(|edge| leveller.creases(edge, |cell| inside[cell])).sum()
}

/// A plate of 6 x 6 x 2 cells with a plateau, or a pit, of 3 x 3 x 1, all cells as deep.
struct Plate {
    mesh: HexMesh,
    /// The cells of the plateau or pit.
    patch: Vec<usize>,
    is_pit: bool,
    deep: f64,
}

impl Plate {
    fn new(is_pit: bool) -> Self {
        let mesh = cubes([8, 8, 6]);
        let z = if is_pit { 2.5 } else { 3.5 };
        let is_patch = |p: Point| (2.0..5.0).contains(&p.x) && (2.0..5.0).contains(&p.y) && p.z == z;
        let centers = Self::centers(&mesh);
        let patch = (0..centers.len()).filter(|&cell| is_patch(centers[cell])).collect();
        Self { mesh, patch, is_pit, deep: 0.3 }
    }

    fn centers(mesh: &HexMesh) -> Vec<Point> {
        let cells = Cells::of(mesh, &Silent).unwrap();
        (0..cells.len()).map(|cell| cells.barycentre(cell)).collect()
    }

    /// Moves, and the cells of the patch that are in then. Others stay.
    fn levelled(&self, outward: impl Fn(usize) -> Option<Point> + Sync) -> (usize, Vec<usize>) {
        let cells = Cells::of(&self.mesh, &Silent).unwrap();
        let is_plate =
            |p: Point| (1.0..7.0).contains(&p.x) && (1.0..7.0).contains(&p.y) && (1.0..3.0).contains(&p.z);
        let centers = Self::centers(&self.mesh);
        let is_in = |cell: usize| {
            if self.patch.contains(&cell) { !self.is_pit } else { is_plate(centers[cell]) }
        };
        let mut inside: Vec<bool> = (0..cells.len()).map(is_in).collect();
        let depth: Vec<f64> = inside.iter().map(|&is| if is { -self.deep } else { self.deep }).collect();
        let of_patch = |cell: usize| outward(cell).filter(|_| self.patch.contains(&cell));
        let moves = level(&cells, &depth, of_patch, &mut inside, &Silent).unwrap();
        (moves, self.patch.iter().copied().filter(|&cell| inside[cell]).collect())
    }
}

#[test]
fn plateaus_and_pits_are_levelled() {
    assert_eq!(Plate::new(false).levelled(|_| Some(Point::Z)), (1, vec![]));
    let pit = Plate::new(true);
    assert_eq!(pit.levelled(|_| Some(Point::Z)), (1, pit.patch.clone()));
}

#[test]
fn what_is_deep_or_turned_away_or_to_stay_stays() {
    for is_pit in [false, true] {
        let mut plate = Plate::new(is_pit);
        let before = if is_pit { vec![] } else { plate.patch.clone() };
        assert_eq!(plate.levelled(|_| None), (0, before.clone()));
        assert_eq!(plate.levelled(|_| Some(Point::NEG_Z)), (0, before.clone()));
        let askew = |degrees: f64| {
            let [s, c] = [libm::sin(degrees.to_radians()), libm::cos(degrees.to_radians())];
            Point::new(s / SQRT_2, s / SQRT_2, c)
        };
        assert_eq!(plate.levelled(|_| Some(askew(51.0))), (0, before.clone()));
        assert_eq!(plate.levelled(|_| Some(askew(49.0))).0, 1);
        plate.deep = 1.1;
        assert_eq!(plate.levelled(|_| Some(Point::Z)), (0, before));
    }
}

/// A cell that is to stay does not keep the others.
#[test]
fn parts_of_terraces_move() {
    let plateau = Plate::new(false);
    let corner = plateau.patch[0];
    let (moves, left) = plateau.levelled(|cell| (cell != corner).then_some(Point::Z));
    assert_eq!((moves, left), (1, vec![corner]));
}

/// What is saved is held against how far the cells are then on the wrong side.
#[test]
fn far_moves_are_to_save_more() {
    let mesh = cubes([20, 20, 4]);
    let cells = Cells::of(&mesh, &Silent).unwrap();
    // A strip along a plate, 18 long: 72 creases beside it, and 4 upright ones at its ends.
    for (deep, width, moves) in [(0.9, 5, 1), (0.9, 6, 0), (0.7, 8, 1), (0.7, 9, 0)] {
        let is_strip = |p: Point| p.z == 2.5 && p.y > 3.0 && p.y < 3.0 + f64::from(width);
        let is_in = |cell: usize| {
            let p = cells.barycentre(cell);
            (p.z < 2.0 || is_strip(p)) && p.x > 1.0 && p.x < 19.0 && p.y > 1.0 && p.y < 19.0
        };
        let mut inside: Vec<bool> = (0..cells.len()).map(is_in).collect();
        let depth: Vec<f64> = inside.iter().map(|&is| if is { -deep } else { deep }).collect();
        let outward = |cell: usize| is_strip(cells.barycentre(cell)).then_some(Point::Z);
        let made = level(&cells, &depth, outward, &mut inside, &Silent).unwrap();
        assert_eq!(made, moves, "{deep} {width}");
    }
}

/// A plate of one layer that goes on in a strip one cell higher keeps this, and a block a gap of this shape: to move the
/// strip would save creases and tear nothing, but there would be none left. Where layers are below it moves.
#[test]
fn single_layers_stay() {
    let mesh = cubes([10, 6, 6]);
    let cells = Cells::of(&mesh, &Silent).unwrap();
    for (is_plate, layers) in [(true, 1.0), (false, 1.0), (true, 2.0), (false, 2.0)] {
        let is_strip = |p: Point| (6.0..9.0).contains(&p.x) && (1.0..5.0).contains(&p.y) && p.z == 3.5;
        let end = if layers > 1.0 { 9.0 } else { 7.0 };
        let is_plate_at = |p: Point| {
            (1.0..end).contains(&p.x) && (1.0..5.0).contains(&p.y) && (3.0 - layers..3.0).contains(&p.z)
        };
        let is_in = |p: Point| (is_strip(p) || is_plate_at(p)) == is_plate;
        let before: Vec<bool> = (0..cells.len()).map(|cell| is_in(cells.barycentre(cell))).collect();
        let mut inside = before.clone();
        let normal = if is_plate { Point::Z } else { Point::NEG_Z };
        let outward = |cell: usize| is_strip(cells.barycentre(cell)).then_some(normal);
        let moves = level(&cells, &vec![0.0; cells.len()], outward, &mut inside, &Silent).unwrap();
        assert_eq!(moves, usize::from(layers > 1.0), "{is_plate} {layers}");
        assert_eq!(moves == 0, inside == before);
    }
}

/// Levels random sets whose boundaries are manifolds, and checks what came of it.
fn random_sets(mesh: &HexMesh, worlds: usize) {
    let cells = Cells::of(mesh, &Silent).unwrap();
    let mut most = 0;
    for world in 0..worlds {
        let share = 0.3 + 0.4 * noise(world, 7);
        let mut inside: Vec<bool> = (0..cells.len()).map(|c| noise(c / 2, world) < share).collect();
        make_manifold(&cells, &vec![0.5; cells.len()], &mut inside, &Silent).unwrap();
        let depth: Vec<f64> = (0..cells.len()).map(|c| 2.4 * noise(c, world + 500) - 1.2).collect();
        let normal = |c: usize| {
            [Point::X, Point::Y, Point::Z][(3.0 * noise(c, world + 900)) as usize]
                * if c.is_multiple_of(2) { 1.0 } else { -1.0 }
        };
        let outward = |c: usize| (noise(c, world + 300) > 0.1).then(|| normal(c));
        let before = (inside.clone(), creases(&cells, &inside), boundary_euler(&cells, &inside));
        let moves = level(&cells, &depth, outward, &mut inside, &Silent).unwrap();
        let kept: Vec<u32> = (0..cells.len() as u32).filter(|&c| inside[c as usize]).collect();
        assert_eq!(check_hexes(&compact(cells.mesh, &kept)), [], "world {world}");
        assert_eq!(boundary_euler(&cells, &inside), before.2, "world {world}");
        let changed: Vec<usize> = (0..cells.len()).filter(|&c| inside[c] != before.0[c]).collect();
        assert!(changed.iter().all(|&c| depth[c].abs() <= DEEPEST && outward(c).is_some()), "world {world}");
        let wrong = |inside: &[bool]| {
            let is_wrong = |&c: &usize| inside[c] != (depth[c] < 0.0);
            (0..cells.len()).filter(is_wrong).map(|c| depth[c] * depth[c]).sum::<f64>()
        };
        let saved = (before.1 - creases(&cells, &inside)) as f64 + wrong(&before.0) - wrong(&inside);
        assert!(saved >= LEAST * moves as f64 - 1e-9, "world {world}: {saved} by {moves}");
        most = most.max(moves);
        assert_eq!(level(&cells, &depth, outward, &mut inside, &Silent), Ok(0), "world {world}");
    }
    assert!(most > 3, "{most}");
}

#[test]
fn random_sets_keep_their_kind() {
    random_sets(&cubes([9, 8, 7]), 200);
}

#[test]
fn sets_of_cells_of_many_valences_keep_their_kind() {
    random_sets(&refined_cubes(), 60);
}

#[test]
fn work_stops_when_the_monitor_says_so() {
    let mesh = cubes([2, 2, 2]);
    let cells = Cells::of(&mesh, &Silent).unwrap();
    let outward = |_| Some(Point::Z);
    assert_eq!(level(&cells, &[-0.5; 8], outward, &mut [true; 8], &Stop), Err(Cancelled));
}
