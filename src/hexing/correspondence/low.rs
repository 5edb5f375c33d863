//! Steps far lower than edges are long, such as the walls of engravings.
//!
//! ```text
//!   ----------+                 Top and foot of a step need two rows of nodes, and quads as narrow between them, or paths
//!             |   low           that lead along one of them only. As long as the step is this low, no node that lies above
//!             +----------       it or below it is far from the solid: what it parts may be one surface.
//! ```

use super::boundary::Boundary;
use super::network::Network;
use super::reduction::{CurveFate, LostCurve, Reason};
use crate::hexing::steps::step_height;
use crate::solid::SurfaceId;

/// Steps lower than this many edges, those there or the mean if that is less, are given up: of a solid that is 48 edges
/// long that is a quarter of a percent.
const LOW: f64 = 0.125;

/// Steps that are shorter than this many of these edges are specks: their curves are too short for the edges anyhow.
const LEAST: f64 = 0.5;

/// Curves around a step that are shorter than so many times its height are its ends: others, such as the rim of a plate that
/// it crosses, go on there from the top to the foot.
const END: f64 = 2.0;

/// Gives up all curves of low steps, where somebody drew them: of a free form they are no more than creases.
pub(super) fn give_up_low(network: &mut Network, boundary: &Boundary) {
    let solid = network.solid;
    if solid.is_free_form() {
        return;
    }
    let mean = boundary.lengths.iter().sum::<f64>() / boundary.lengths.len() as f64;
    for surface in solid.surfaces() {
        let Some(height) = step_height(solid, surface) else { continue };
        let place = network.point_along(surface.curves[0], 0.0);
        let edge = boundary.length_near(place).min(mean);
        if height < LOW * edge && surface.area >= LEAST * edge * height {
            for &curve in &surface.curves {
                let is_end = solid.curves()[curve.index()].length < END * height;
                match network.is_kept(curve) {
                    true if is_end => network.contract(curve, Reason::Low),
                    true => network.suppress(curve, Reason::Low),
                    false => {}
                }
            }
        }
    }
}

/// The surfaces at both sides of the top and foot of low steps: they are one.
pub(super) fn united(network: &Network) -> Vec<[SurfaceId; 2]> {
    let is_low = |lost: &&LostCurve| lost.reason == Reason::Low && lost.fate == CurveFate::Suppressed;
    let low = network.lost.iter().filter(is_low);
    low.map(|lost| network.solid.curves()[lost.curve.index()].sides).collect()
}
