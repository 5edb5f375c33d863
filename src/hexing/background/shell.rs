//! The background of a thin shell: a layer of hexes from side to side, on quads in the middle between these.
//!
//! 1. The two sides are found (`sides`).
//! 2. Of a grid around the shell, cells are told apart by the side they are nearer to. Between them are quads, which make a manifold.
//! 3. Those beyond the rim are left out; the rest are smoothed, in the middle between the sides.
//! 4. Each is a hex from side to side, however thin.
//!
//! Not in the paper, and nothing like the sweep of a face: a shell may be curved both ways, and closed.

use super::grid::{AlignedGrid, BackgroundError, grid_around};
use super::middle::quads_between;
use super::sides::Sides;
use crate::geometry::{Point, area_vector};
use crate::mesh::quality::{Certainty, is_positive};
use crate::mesh::topology::Bins;
use crate::mesh::{HexMesh, NodeId, QuadMesh};
use crate::optimize::{Constraints, OptimizeOptions, optimize};
use crate::solid::SolidModel;
use crate::{Cancelled, Monitor, parallel};

/// Cells whose box comes so near to the solid, as a share of the cell, are around it: those whose faces may be in the middle.
const AROUND: f64 = 1.01;

/// And there are no more than so many for a hex.
const CELLS: u64 = 8;

/// The sides of a shell.
#[derive(Debug)]
pub struct Shell {
    sides: Sides,
}

impl Shell {
    /// Finds the sides of a thin solid; `None` if it is no shell.
    ///
    /// # Errors
    /// If the monitor stops it.
    pub fn of(solid: &SolidModel, monitor: &dyn Monitor) -> Result<Option<Self>, Cancelled> {
        Ok(Sides::of(solid, monitor)?.map(|sides| Self { sides }))
    }

    /// The hexes, a layer with edges about as long as the grid's along the shell: conforming, and a manifold with boundary.
    ///
    /// # Errors
    /// See [`BackgroundError`].
    pub fn mesh(
        &self,
        solid: &SolidModel,
        options: &AlignedGrid,
        monitor: &dyn Monitor,
    ) -> Result<HexMesh, BackgroundError> {
        let max_hexes = options.max_hexes.saturating_mul(CELLS);
        let grid = grid_around(solid, &AlignedGrid { max_hexes, ..*options }, AROUND, monitor)?;
        let middle = quads_between(&self.sides, &grid, options.edge_length, monitor)?;
        let layers = (self.sides.thickness / options.edge_length).round().max(1.0);
        let hexes = layers * middle.quads.len() as f64;
        if hexes > options.max_hexes as f64 {
            return Err(BackgroundError::TooManyHexes { hexes, limit: options.max_hexes });
        }
        let mut mesh = self.thickened(&middle, layers as usize, monitor)?;
        untangle(&mut mesh, monitor)?;
        Ok(mesh)
    }

    /// Hexes from side to side on each quad, in layers.
    fn thickened(
        &self,
        middle: &QuadMesh,
        layers: usize,
        monitor: &dyn Monitor,
    ) -> Result<HexMesh, Cancelled> {
        let corners = middle.quads.as_flattened();
        let count = middle.positions.len();
        let at = Bins::monitored(count, corners.len(), |k| corners[k].index(), monitor)?;
        let way = |n: usize| {
            let around = at.at(n).iter().map(|&k| middle.quads[k as usize / 4]);
            let normals = around.map(|quad| area_vector(&quad.map(|n| middle.positions[n.index()])));
            let thickness = self.sides.distances(middle.positions[n]).iter().sum::<f64>();
            normals.sum::<Point>().normalize_or_zero() * thickness
        };
        let ways = parallel::try_collect(count, monitor, way)?;
        let position = |k: usize| {
            let (n, share) = (k % count, (k / count) as f64 / layers as f64);
            middle.positions[n] + ways[n] * (share - 0.5)
        };
        let quads = middle.quads.len();
        let hex = |k: usize| {
            let at = |corner: usize, layer: usize| {
                NodeId::new(middle.quads[k % quads][corner].index() + layer * count)
            };
            [0, 1, 2, 3, 4, 5, 6, 7].map(|corner| at(corner % 4, k / quads + corner / 4))
        };
        let positions = parallel::try_collect(count * (layers + 1), monitor, position)?;
        let hexes = parallel::try_collect(quads * layers, monitor, hex)?;
        Ok(HexMesh { positions, hexes, ..HexMesh::default() })
    }
}

/// Moves the nodes of hexes that are not positive, as quads that are folded make them, until they are.
fn untangle(mesh: &mut HexMesh, monitor: &dyn Monitor) -> Result<(), Cancelled> {
    let corners = |hex: &[NodeId; 8]| hex.map(|n| mesh.positions[n.index()]);
    let is_bad = |h: usize| is_positive(&corners(&mesh.hexes[h])) != Certainty::Positive;
    let bad = parallel::try_filter(mesh.hexes.len(), monitor, is_bad)?;
    if bad.is_empty() {
        return Ok(());
    }
    let mut moves = vec![false; mesh.positions.len()];
    bad.iter().flat_map(|&h| mesh.hexes[h as usize]).for_each(|n| moves[n.index()] = true);
    let free = Constraints::none(moves.len());
    optimize(&mut mesh.positions, &mesh.hexes, &moves, &free, &OptimizeOptions::default(), monitor)?;
    Ok(())
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::Silent;
    use crate::mesh::topology::{HexTopology, hex_report};
    use crate::mesh::{PolygonMesh, check_hexes};
    use crate::solid::testing::{bent, hollow_ball, solid, voxels};

    fn meshed(surface: &PolygonMesh, edge_length: f64) -> (SolidModel, HexMesh) {
        let solid = solid(surface);
        let shell = Shell::of(&solid, &Silent).unwrap().unwrap();
        let mesh = shell.mesh(&solid, &AlignedGrid::new(edge_length), &Silent).unwrap();
        (solid, mesh)
    }

    /// Conforming, a manifold of the solid's kind, and positive.
    fn check(solid: &SolidModel, mesh: &HexMesh) {
        let defects = check_hexes(mesh);
        assert!(defects.is_empty(), "{} {:?}", defects.len(), &defects[..defects.len().min(3)]);
        let report = hex_report(&HexTopology::of(mesh));
        assert!(report.is_manifold(), "{report:?}");
        assert_eq!(2 * report.euler, solid.euler_number());
        let corners = |hex: &[NodeId; 8]| hex.map(|n| mesh.positions[n.index()]);
        assert!(mesh.hexes.iter().all(|hex| is_positive(&corners(hex)) == Certainty::Positive));
    }

    #[test]
    fn shells_however_thin_have_a_layer_and_thick_ones_more() {
        for (thickness, layers) in [(1e-4, 1), (0.05, 1), (1.0, 1), (1.6, 2), (2.6, 3)] {
            let saddle = bent(24, thickness, |x, y| 0.02 * (x * x - y * y));
            let (solid, mesh) = meshed(&saddle, 1.0);
            check(&solid, &mesh);
            let quads = mesh.hexes.len() / layers;
            let height = |hex: &[NodeId; 8]| {
                let at = |k: usize| mesh.positions[hex[k].index()];
                (0..4).map(|k| at(k).distance(at(k + 4))).sum::<f64>() / 4.0
            };
            let mean = mesh.hexes.iter().map(height).sum::<f64>() / mesh.hexes.len() as f64;
            assert!((mean * layers as f64 / thickness - 1.0).abs() < 0.02, "{thickness} {mean}");
            assert!((500..1000).contains(&quads), "{quads}");
        }
    }

    #[test]
    fn closed_shells_and_shells_with_holes_have_no_gaps() {
        let (ball, mesh) = meshed(&hollow_ball(10, 5.0, 0.2), 0.8);
        check(&ball, &mesh);
        assert_eq!(ball.euler_number(), 4);
        let pierced = voxels([24, 24, 1], |[x, y, _]| !((6..11).contains(&x) && (8..15).contains(&y)));
        let dome = |p: Point| {
            let (x, y) = (p.x - 12.0, p.y - 12.0);
            Point::new(x, y, 0.2 * p.z - 0.015 * (x * x + y * y))
        };
        let (dome, mesh) = meshed(&crate::solid::testing::moved(pierced, dome), 1.0);
        check(&dome, &mesh);
        assert_eq!(dome.euler_number(), 0);
    }
}
