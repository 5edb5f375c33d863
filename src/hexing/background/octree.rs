//! An aligned grid, refined where the solid or the user wants smaller cells.
//!
//! 1. An aligned grid, coarser than the edge length wanted if asked for.
//! 2. Points of the boundary where smaller cells are wanted, by level (`demand`).
//! 3. Conforming refinement around them ([`refine::hex`](crate::refine::hex)), as far that the transitions to coarser
//!    cells are two of these away from the boundary.

use super::demand::Demands;
use super::grid::{AlignedGrid, BackgroundError, grid};
use crate::Monitor;
use crate::mesh::HexMesh;
use crate::refine::hex::{HexOptions, refine_hexes};
use crate::sizing::{Region, Shape, Target};
use crate::solid::SolidModel;

/// What [`octree`] is to make.
#[derive(Clone, Copy, Debug)]
pub struct Octree<'a> {
    /// The grid: its edge length is that of cells that nothing wants smaller.
    pub grid: AlignedGrid,
    /// How many levels finer than the grid all cells at the boundary are.
    pub boundary_level: u8,
    /// Degrees that the boundary may turn along an edge, 15 to 20 usually; `None`: as it likes.
    pub curvature: Option<f64>,
    /// Are cells to be smaller in thin walls and narrow gaps, and at short curves?
    pub details: bool,
    /// How many levels finer than the boundary's cells may become for that.
    pub levels: u8,
    /// Where else cells are to be smaller; levels count from the grid's cells.
    pub regions: &'a [Region],
}

/// A background of cells of several levels.
#[derive(Clone, Debug, PartialEq)]
pub struct OctreeMesh {
    /// The mesh.
    pub mesh: HexMesh,
    /// How many times the grid was refined to make each hex.
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
    let &Octree { grid: coarse, boundary_level, curvature, details, levels, regions } = options;
    let mesh = grid(solid, &coarse, monitor)?;
    let edge_of = |level: u8| coarse.edge_length / f64::from(1u32 << level.min(31));
    let demands = Demands { edge_length: edge_of(boundary_level), curvature, details, finest: levels };
    let mut wanted = regions.to_vec();
    wanted.extend((1..=boundary_level).map(|level| {
        let (positions, triangles) = (solid.points().to_vec(), solid.triangles().to_vec());
        let distance = BAND * edge_of(level - 1);
        Region { shape: Shape::Surface { positions, triangles, distance }, target: Target::Level(level) }
    }));
    let by_level = demands.points(solid, monitor)?;
    wanted.extend((boundary_level + 1..).zip(by_level).filter(|(_, points)| !points.is_empty()).map(
        |(level, points)| {
            let radius = BAND * edge_of(level - 1);
            Region { shape: Shape::Points { points, radius }, target: Target::Level(level) }
        },
    ));
    let options = HexOptions { regions: wanted, max_hexes: coarse.max_hexes, ..HexOptions::default() };
    let refined = refine_hexes(&mesh, &options, monitor)?;
    Ok(OctreeMesh { mesh: refined.mesh, level: refined.level })
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::Silent;
    use crate::geometry::Point;
    use crate::mesh::check_hexes;
    use crate::solid::testing::{cylinder, solid, voxels};

    fn options(edge_length: f64) -> Octree<'static> {
        Octree {
            grid: AlignedGrid::new(edge_length),
            boundary_level: 0,
            curvature: None,
            details: false,
            levels: 2,
            regions: &[],
        }
    }

    fn center(mesh: &HexMesh, hex: usize) -> Point {
        mesh.hexes[hex].iter().map(|n| mesh.positions[n.index()]).sum::<Point>() / 8.0
    }

    #[test]
    fn without_demands_it_is_the_grid() {
        let solid = solid(&cylinder(24));
        let plain = grid(&solid, &AlignedGrid::new(0.4), &Silent).unwrap();
        let made = octree(&solid, &options(0.4), &Silent).unwrap();
        assert_eq!((made.mesh.hexes.len(), made.level.iter().max()), (plain.hexes.len(), Some(&0)));
    }

    #[test]
    fn cells_at_the_boundary_are_finer_than_those_inside() {
        let solid = solid(&voxels([8, 8, 8], |_| true));
        let made = octree(&solid, &Octree { boundary_level: 1, ..options(1.0) }, &Silent).unwrap();
        assert_eq!(check_hexes(&made.mesh), []);
        let depth = |h: usize| solid.signed_distance(center(&made.mesh, h)).abs();
        let coarse: Vec<usize> = (0..made.level.len()).filter(|&h| made.level[h] == 0).collect();
        assert!(!coarse.is_empty() && coarse.iter().all(|&h| depth(h) > 0.5), "transitions are away from it");
    }

    #[test]
    fn a_thin_wall_and_a_curved_surface_are_refined() {
        // A block with a wall of half an edge.
        let wall = solid(&voxels([8, 8, 4], |[x, _, z]| z < 2 || x == 5));
        let made = octree(&wall, &Octree { details: true, ..options(2.0) }, &Silent).unwrap();
        assert_eq!(check_hexes(&made.mesh), []);
        let finest_near = |made: &OctreeMesh, at: Point| {
            let near = (0..made.level.len()).filter(|&h| center(&made.mesh, h).distance(at) < 1.0);
            near.map(|h| made.level[h]).max()
        };
        assert_eq!(finest_near(&made, Point::new(5.5, 4.0, 3.0)), Some(2));
        let round = solid(&cylinder(64));
        let curved =
            octree(&round, &Octree { curvature: Some(20.0), levels: 1, ..options(0.6) }, &Silent).unwrap();
        assert_eq!(check_hexes(&curved.mesh), []);
        assert_eq!(finest_near(&curved, Point::new(1.0, 0.0, 1.0)), Some(1));
    }
}
