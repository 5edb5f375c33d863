//! Surfaces that are steps between parallel ones, such as the walls of engravings.

use crate::solid::{SolidModel, Surface};

/// How far the surfaces on both sides of a step may be from parallel, in degrees.
const PARALLEL: f64 = 20.0;

/// How high a surface is, if it is a step between parallel ones: as high as a strip of its area with so much around it.
pub(super) fn step_height(solid: &SolidModel, surface: &Surface) -> Option<f64> {
    let curves = || surface.curves.iter().map(|curve| &solid.curves()[curve.index()]);
    let around: f64 = curves().map(|curve| curve.length).sum();
    // The boundary turns one way at the top, and back at the foot.
    let turn: f64 = curves().map(|curve| curve.length * (curve.interior_angle - 180.0)).sum();
    (around > 0.0 && turn.abs() < PARALLEL * around).then_some(2.0 * surface.area / around)
}
