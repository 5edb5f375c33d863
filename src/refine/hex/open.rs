//! Opens the layer of a pillow before it is divided: untangles and smooths its hexes and those beside it.
//!
//! The layer has an eighth of the hexes that it is divided into, and a step there goes as far as many among these. So it
//! gets its thickness here, and smoothing the divided hexes has little more to do than their insides.

use super::local::Local;
use super::pillow::Pillow;
use crate::optimize::{Constraints, OptimizeOptions, SMOOTHING};
use crate::{Cancelled, Monitor, Stage};

/// The stage that this file reports.
const OPENING: Stage = Stage("opening");

/// Every cell is to get better, in shape alone: what the layer is divided into has other worst corners.
const OPTIONS: OptimizeOptions =
    OptimizeOptions { target: 1.0, courses: 1, smooth_sweeps: 4, ..OptimizeOptions::DEFAULT };

/// Moves the layer's nodes, if none of them is on the boundary, and says if that is so. At the boundary layers often stand
/// between ridges with no room to open, and what they leave to the next stage is then worse.
pub(super) fn open(pillow: &mut Pillow, monitor: &dyn Monitor) -> Result<bool, Cancelled> {
    let monitor = &Opening(monitor);
    monitor.0.checkpoint(OPENING, 0.0)?;
    let Pillow { positions, hexes, layer, .. } = pillow;
    let mut moves = vec![false; positions.len()];
    layer.iter().flat_map(|hex| hex.hex).for_each(|n| moves[n.index()] = true);
    let hex = |h: usize| hexes.get(h).copied().unwrap_or_else(|| layer[h - hexes.len()].hex);
    let mut local = Local::at(positions, (hexes.len() + layer.len(), hex), &moves, monitor)?;
    let is_inside = local.is_inside(&local.faces(monitor)?);
    if is_inside {
        local.optimize(&Constraints::none(local.node_count()), &OPTIONS, monitor)?;
        local.write_back(positions);
    }
    Ok(is_inside)
}

/// Tells the progress of smoothing as that of a stage of its own: smoothing is yet to come.
struct Opening<'a>(&'a dyn Monitor);

impl Monitor for Opening<'_> {
    fn progress(&self, stage: Stage, fraction: f64) {
        if stage == SMOOTHING {
            self.0.progress(OPENING, fraction);
        }
    }

    fn cancelled(&self) -> bool {
        self.0.cancelled()
    }
}

#[cfg(test)]
mod tests {
    use super::super::interface::Interface;
    use super::super::pillow::pillow;
    use super::super::stage::StageMesh;
    use super::*;
    use crate::Silent;
    use crate::geometry::{Aabb, Point};
    use crate::mesh::quality::scaled_jacobian;
    use crate::mesh::{GridOptions, HexMesh, NodeId, hex_grid};

    fn pillow_around(mesh: &HexMesh, is_in: impl Fn(Point) -> bool) -> Pillow {
        let middle = |hex: &[NodeId; 8]| hex.iter().map(|n| mesh.positions[n.index()]).sum::<Point>() / 8.0;
        let refined: Vec<bool> = mesh.hexes.iter().map(|hex| is_in(middle(hex))).collect();
        let mesh = StageMesh::of_mesh(mesh, &Silent).unwrap();
        let mut interface = Interface::new(mesh.whole(), &refined, &Silent).unwrap();
        pillow(&mesh.positions, &mut interface, &Silent).unwrap()
    }

    fn worst(pillow: &Pillow) -> f64 {
        let hexes = pillow.hexes.iter().copied().chain(pillow.layer.iter().map(|hex| hex.hex));
        let jacobians = hexes.map(|hex| scaled_jacobian(&hex.map(|n| pillow.positions[n.index()])));
        jacobians.fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn a_layer_inside_is_opened_and_one_at_the_boundary_stays() {
        let grid = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 216 };
        let mesh = hex_grid(Aabb { min: Point::ZERO, max: Point::splat(6.0) }, &grid).unwrap();
        // An L of cells in the middle.
        let is_in = |p: Point| p.min_element() > 2.0 && p.max_element() < 4.0 && p.x.min(p.y) < 3.0;
        let mut inside = pillow_around(&mesh, is_in);
        let before = worst(&inside);
        assert!(open(&mut inside, &Silent).unwrap());
        assert!(worst(&inside) > before, "{} after {before}", worst(&inside));
        let mut through = pillow_around(&mesh, |p| p.x.min(p.y) < 3.0);
        let before = through.positions.clone();
        assert!(!open(&mut through, &Silent).unwrap());
        assert_eq!(through.positions, before);
    }
}
