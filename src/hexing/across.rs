//! Round holes and pins across a direction that are a few edges thick at most: with four cells around its middle a circle
//! becomes eight edges, else as few as four.

use super::extent::Extent;
use crate::geometry::Point;
use crate::solid::{SolidModel, Surface, SurfaceClass};

/// The cosine of 80 degrees: axes farther than that from the direction are across it.
const ACROSS: f64 = 0.17;

/// A surface faces a way if its normals come so near to it.
const FACING: f64 = 0.9;

/// How thick holes and pins are that are looked at, in edge lengths: of thinner ones no cell is left, thicker ones have cells
/// enough.
const THICK: [f64; 2] = [0.8, 3.2];

/// The axis of a surface that is a cylinder of that thickness across the direction, and goes around from its one side to the
/// other.
pub(super) fn axis_across(
    solid: &SolidModel,
    surface: &Surface,
    direction: Point,
    edge_length: f64,
) -> Option<Point> {
    let SurfaceClass::Cylindrical { axis } = surface.class else { return None };
    let thickness = Extent::of_surface(solid, surface, direction).thickness();
    let is_thick = (THICK[0] * edge_length..THICK[1] * edge_length).contains(&thickness);
    let is_across = axis.dot(direction).abs() < ACROSS && is_thick && faces_both(solid, surface, direction);
    is_across.then_some(axis)
}

/// Does a surface face a way and the opposite one?
pub(super) fn faces_both(solid: &SolidModel, surface: &Surface, way: Point) -> bool {
    let faces = |way: Point| surface.triangles.iter().any(|&t| solid.normals()[t as usize].dot(way) > FACING);
    faces(way) && faces(-way)
}
