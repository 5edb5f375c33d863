//! Backgrounds refined where the solid or the user wants smaller cells (section 4.3).
//!
//! 1. Points of the boundary where smaller cells are wanted, by level (`demand`).
//! 2. Conforming refinement around them ([`refine::hex`](crate::refine::hex)), as far that the transitions to coarser
//!    cells are two of these away from the boundary: by halves, or by thirds where halves would spread too far. What is cut
//!    away around the solid need not keep its shape: transitions have room up to the rim of the background.
//!
//! Any background can be refined so; an octree is an aligned grid, coarser than wanted, with its boundary refined.

use super::demand::Demands;
use super::grid::{AlignedGrid, BackgroundError, grid_of_blocks, grid_to_refine};
use crate::Monitor;
use crate::mesh::HexMesh;
use crate::refine::hex::{HexBlocks, HexOptions, HexPlan, HexRefineError, Method};
use crate::sizing::{Region, Shape, Target};
use crate::solid::SolidModel;

/// Where cells of a background are to be smaller. Levels count from its cells.
#[derive(Clone, Copy, Debug, Default)]
pub struct Wanted<'a> {
    /// How many levels finer all cells at the boundary are.
    pub boundary_level: u8,
    /// Degrees that the boundary may turn along an edge, 15 to 20 usually; `None`: as it likes.
    pub curvature: Option<f64>,
    /// Are cells to be smaller in thin walls and narrow gaps, and at short curves?
    pub details: bool,
    /// How many levels finer than the boundary's cells may become for these two.
    pub levels: u8,
    /// Where else cells are to be smaller.
    pub regions: &'a [Region],
    /// Are the cells of a grid that are not all finer at the boundary refined in blocks of eight? Then they are halved, and
    /// others stay as they are.
    pub in_blocks: bool,
}

/// What [`octree`] is to make.
#[derive(Clone, Copy, Debug)]
pub struct Octree<'a> {
    /// The grid: its edge length is that of cells that nothing wants smaller.
    pub grid: AlignedGrid,
    /// Where they are to be smaller.
    pub wanted: Wanted<'a>,
}

/// A background of cells of several levels.
#[derive(Clone, Debug, PartialEq)]
pub struct OctreeMesh {
    /// The mesh.
    pub mesh: HexMesh,
    /// How many times the background was refined to make each hex.
    pub level: Vec<u8>,
}

/// How many cells of the level before stand between the boundary and them.
const BAND: f64 = 2.0;

/// Refines a grid around the solid.
///
/// # Errors
/// See [`BackgroundError`].
pub fn octree(
    solid: &SolidModel,
    options: &Octree<'_>,
    monitor: &dyn Monitor,
) -> Result<OctreeMesh, BackgroundError> {
    let AlignedGrid { edge_length, max_hexes, .. } = options.grid;
    let wanted = &options.wanted;
    let regions = regions(solid, edge_length, wanted, monitor)?;
    if regions.is_empty() || wanted.boundary_level > 0 || !wanted.in_blocks {
        let mesh = grid_to_refine(solid, &options.grid, wanted.boundary_level, monitor)?;
        return refined_in(mesh, None, regions, wanted.boundary_level, max_hexes, monitor);
    }
    let (mesh, blocks) = grid_of_blocks(solid, &options.grid, monitor)?;
    refined_in(mesh, Some(blocks), regions, wanted.boundary_level, max_hexes, monitor)
}

/// Refines a background whose edges are about `edge_length` long, to no more than `max_hexes`: a conforming mesh.
pub(in super::super) fn refined(
    background: HexMesh,
    solid: &SolidModel,
    edge_length: f64,
    wanted: &Wanted<'_>,
    max_hexes: u64,
    monitor: &dyn Monitor,
) -> Result<OctreeMesh, BackgroundError> {
    let regions = regions(solid, edge_length, wanted, monitor)?;
    refined_in(background, None, regions, wanted.boundary_level, max_hexes, monitor)
}

/// Refines a background, whose hexes may stand in blocks, in the regions.
#[inline(never)] // Compiled once for all that call it.
fn refined_in(
    background: HexMesh,
    blocks: Option<HexBlocks>,
    regions: Vec<Region>,
    boundary_level: u8,
    max_hexes: u64,
    monitor: &dyn Monitor,
) -> Result<OctreeMesh, BackgroundError> {
    if regions.is_empty() {
        let level = vec![0; background.hexes.len()];
        return Ok(OctreeMesh { mesh: background, level });
    }
    let all_halved = 8 * background.hexes.len();
    let is_in_groups = boundary_level > 0 || blocks.is_some();
    let mut options = HexOptions { regions, max_hexes, ..HexOptions::default() };
    if !is_in_groups && all_halved as u64 > max_hexes {
        // Where halves spread over more than what thirds take, they need not be followed further.
        options.method = Method::Three;
        let fewest = fewest_hexes(HexPlan::fewest_hexes(&background, &options, monitor))?;
        options = HexOptions { max_hexes: max_hexes.min(fewest), method: Method::default(), ..options };
    }
    let plan = match HexPlan::of_conforming(&background, blocks.as_ref(), &options, monitor) {
        Ok(plan) if plan.tree_hexes() < all_halved => plan,
        // All of the boundary is wanted finer, in halves.
        plan if boundary_level > 0 => plan?,
        plan => {
            options = HexOptions { max_hexes, method: Method::Three, ..options };
            of_fewer(plan, HexPlan::of_conforming(&background, None, &options, monitor))?
        }
    };
    // They may be as large as the solid, and are not needed any more.
    drop(options);
    let refined = plan.carry_out(monitor)?;
    Ok(OctreeMesh { mesh: refined.mesh, level: refined.level })
}

/// The fewest hexes of a refinement, as far as they can be told.
fn fewest_hexes(hexes: Result<usize, HexRefineError>) -> Result<u64, HexRefineError> {
    match hexes {
        Ok(hexes) => Ok(hexes as u64),
        Err(HexRefineError::Cancelled(cancelled)) => Err(cancelled.into()),
        Err(_) => Ok(u64::MAX),
    }
}

/// The plan of fewer hexes: where the cells to be halved are not in groups of two by two, all of the background would have
/// to be, while any of them can be cut in 27 (section 4.3.2).
fn of_fewer<'a>(
    halved: Result<HexPlan<'a>, HexRefineError>,
    thirds: Result<HexPlan<'a>, HexRefineError>,
) -> Result<HexPlan<'a>, HexRefineError> {
    match (halved, thirds) {
        (Err(HexRefineError::Cancelled(cancelled)), _) | (_, Err(HexRefineError::Cancelled(cancelled))) => {
            Err(cancelled.into())
        }
        (Ok(halved), Ok(thirds)) => {
            Ok(if thirds.forecast().hexes < halved.forecast().hexes { thirds } else { halved })
        }
        (Err(_), Ok(thirds)) => Ok(thirds),
        (halved, Err(_)) => halved,
    }
}

/// All that is wanted, as regions.
fn regions(
    solid: &SolidModel,
    edge_length: f64,
    wanted: &Wanted<'_>,
    monitor: &dyn Monitor,
) -> Result<Vec<Region>, BackgroundError> {
    let &Wanted { boundary_level, curvature, details, levels, regions, .. } = wanted;
    let edge_of = |level: u8| edge_length / f64::from(1u32 << level.min(31));
    let mut all = regions.to_vec();
    all.extend((1..=boundary_level).map(|level| {
        let (positions, triangles) = (solid.points().to_vec(), solid.triangles().to_vec());
        let distance = BAND * edge_of(level - 1);
        Region { shape: Shape::Surface { positions, triangles, distance }, target: Target::Level(level) }
    }));
    if curvature.is_some() || details {
        let demands = Demands { edge_length: edge_of(boundary_level), curvature, details, finest: levels };
        let by_level = demands.points(solid, monitor)?;
        all.extend((boundary_level + 1..).zip(by_level).filter(|(_, points)| !points.is_empty()).map(
            |(level, points)| {
                let radius = BAND * edge_of(level - 1);
                Region { shape: Shape::Points { points, radius }, target: Target::Level(level) }
            },
        ));
    }
    Ok(all)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::grid::grid;
    use super::*;
    use crate::Silent;
    use crate::geometry::Point;
    use crate::mesh::check_hexes;
    use crate::mesh::topology::hex_boundary;
    use crate::solid::testing::{cylinder, solid, voxels};

    fn made(solid: &SolidModel, edge_length: f64, wanted: Wanted<'_>) -> OctreeMesh {
        octree(solid, &Octree { grid: AlignedGrid::new(edge_length), wanted }, &Silent).unwrap()
    }

    fn center(mesh: &HexMesh, hex: usize) -> Point {
        mesh.hexes[hex].iter().map(|n| mesh.positions[n.index()]).sum::<Point>() / 8.0
    }

    #[test]
    fn without_demands_it_is_the_grid() {
        let solid = solid(&cylinder(24));
        let plain = grid(&solid, &AlignedGrid::new(0.4), &Silent).unwrap();
        let made = made(&solid, 0.4, Wanted::default());
        assert_eq!((made.mesh.hexes.len(), made.level.iter().max()), (plain.hexes.len(), Some(&0)));
    }

    #[test]
    fn cells_at_the_boundary_are_finer_than_those_inside() {
        let solid = solid(&voxels([8, 8, 8], |_| true));
        let made = made(&solid, 1.0, Wanted { boundary_level: 1, ..Wanted::default() });
        assert_eq!(check_hexes(&made.mesh), []);
        let depth = |h: usize| solid.signed_distance(center(&made.mesh, h)).abs();
        let coarse: Vec<usize> = (0..made.level.len()).filter(|&h| made.level[h] == 0).collect();
        assert!(!coarse.is_empty() && coarse.iter().all(|&h| depth(h) > 0.5), "transitions are away from it");
    }

    #[test]
    fn cells_inside_have_all_neighbours_and_few_are_outside() {
        let solid = solid(&cylinder(40));
        for edge_length in [0.25, 0.4] {
            let made = made(&solid, edge_length, Wanted { boundary_level: 1, ..Wanted::default() });
            let rim: std::collections::BTreeSet<_> =
                hex_boundary(&made.mesh.hexes).iter().flat_map(|(face, _)| *face).collect();
            let is_inside = |h: &usize| solid.contains(center(&made.mesh, *h));
            let inside: Vec<usize> = (0..made.level.len()).filter(is_inside).collect();
            assert!(inside.iter().all(|&h| made.mesh.hexes[h].iter().all(|n| !rim.contains(n))));
            let far = (0..made.level.len()).map(|h| solid.signed_distance(center(&made.mesh, h)));
            let far = far.fold(0.0, f64::max) / edge_length;
            assert!(far < 1.75, "{far}");
        }
    }

    #[test]
    fn what_is_refined_in_one_place_stays_coarse_elsewhere() {
        let solid = solid(&voxels([8, 8, 8], |_| true));
        let shape = Shape::Sphere { center: Point::ZERO, radius: 0.5 };
        let regions = [Region { shape, target: Target::Level(1) }];
        let made = made(&solid, 1.0, Wanted { regions: &regions, ..Wanted::default() });
        assert_eq!(check_hexes(&made.mesh), []);
        let plain = grid(&solid, &AlignedGrid::new(1.0), &Silent).unwrap().hexes.len();
        let fine = made.level.iter().filter(|&&level| level == 1).count();
        assert!((27..400).contains(&fine) && made.mesh.hexes.len() < 2 * plain, "{fine} {plain}");
    }

    /// In a plain grid cells stand in blocks of eight, so that they can be halved in one place alone.
    #[test]
    fn cells_of_a_plain_grid_are_halved_in_blocks() {
        let solid = solid(&voxels([9, 9, 9], |_| true));
        for at in [[4.5, 4.5, 4.5], [0.0, 3.0, 9.0], [5.0, 0.5, 0.5]] {
            let shape = Shape::Points { points: vec![Point::from(at)], radius: 1.0 };
            let regions = [Region { shape, target: Target::Level(1) }];
            let made = made(&solid, 1.0, Wanted { regions: &regions, in_blocks: true, ..Wanted::default() });
            assert_eq!(check_hexes(&made.mesh), []);
            let count = |level| made.level.iter().filter(|&&l| l == level).count();
            assert_eq!(count(1) % 64, 0, "whole blocks, each cell in eight");
            assert!(count(1) <= 64 * 27 && count(0) > 13 * 13 * 13 / 2, "{} {}", count(1), count(0));
        }
    }

    #[test]
    fn a_thin_wall_and_a_curved_surface_are_refined() {
        // A block with a wall of half an edge.
        let wall = solid(&voxels([8, 8, 4], |[x, _, z]| z < 2 || x == 5));
        let walled = made(&wall, 2.0, Wanted { details: true, levels: 2, ..Wanted::default() });
        assert_eq!(check_hexes(&walled.mesh), []);
        let finest_near = |made: &OctreeMesh, at: Point| {
            let near = (0..made.level.len()).filter(|&h| center(&made.mesh, h).distance(at) < 1.0);
            near.map(|h| made.level[h]).max()
        };
        assert_eq!(finest_near(&walled, Point::new(5.5, 4.0, 3.0)), Some(2));
        let round = solid(&cylinder(64));
        let curved = made(&round, 0.6, Wanted { curvature: Some(20.0), levels: 1, ..Wanted::default() });
        assert_eq!(check_hexes(&curved.mesh), []);
        assert_eq!(finest_near(&curved, Point::new(1.0, 0.0, 1.0)), Some(1));
    }
}
