//! How many hexes a solid will be filled with, told before the work.

use super::background::{BackgroundError, estimate_hexes};
use super::options::{HexingError, HexingOptions, validate};
use crate::geometry::{Aabb, Point};
use crate::mesh::{HexMesh, NodeId};
use crate::refine::hex::HexRefineError;
use crate::sizing::{Region, SizeField, SizeOptions, SizedElement, Target};
use crate::solid::SolidModel;
use crate::{Monitor, parallel};

/// Places along each axis of a region's box that are asked whether they are in the solid.
const PLACES: usize = 16;

/// About how many hexes [`hex_solid`](super::hex_solid) makes: as many as cells of the edge length, and more in regions.
/// What curvature, or something that was missed, has refined is not counted, nor an octree instead of what was chosen.
/// Regions that overlap are counted each.
///
/// # Errors
/// If an option or a region is out of range, or the monitor stops it.
pub fn forecast_hexes(
    solid: &SolidModel,
    options: &HexingOptions,
    monitor: &dyn Monitor,
) -> Result<f64, HexingError> {
    validate(options)?;
    let mut hexes = estimate_hexes(solid, options.edge_length);
    for region in &options.regions {
        let more = 8_f64.powi(levels(region.target, options.edge_length)) - 1.0;
        let cell = options.edge_length.powi(3);
        hexes += more * covered(solid, region, options.edge_length, monitor)? / cell;
    }
    Ok(hexes)
}

/// How many times cells of an edge length are halved for a target.
fn levels(target: Target, edge_length: f64) -> i32 {
    match target {
        Target::Level(level) => level.into(),
        Target::Size(size) => {
            (0..DEEPEST).find(|&level| edge_length * 0.5_f64.powi(level) <= size).unwrap_or(DEEPEST)
        }
    }
}

/// Halved so often no edge is left that could be longer than a size.
const DEEPEST: i32 = 40;

/// The volume of the solid in a region.
fn covered(
    solid: &SolidModel,
    region: &Region,
    edge_length: f64,
    monitor: &dyn Monitor,
) -> Result<f64, HexingError> {
    let regions = std::slice::from_ref(region);
    let sizes = SizeOptions { edge_length: None, curvature: None, gradation: 2.0, regions };
    let cell = HexMesh {
        positions: corners(Point::ZERO, Point::splat(edge_length)).into(),
        hexes: vec![ONE],
        ..HexMesh::default()
    };
    let field = SizeField::of_hexes(&cell, sizes)
        .map_err(|error| BackgroundError::from(HexRefineError::from(error)))?;
    let (about, solids) = (region.shape.bounds(), solid.bounds());
    let within = Aabb { min: about.min.max(solids.min), max: about.max.min(solids.max) };
    if within.is_empty() {
        return Ok(0.0);
    }
    let step = (within.max - within.min) / PLACES as f64;
    let is_covered = |place: usize| {
        let at = [place % PLACES, place / PLACES % PLACES, place / PLACES / PLACES].map(|k| k as f64);
        let part = within.min + step * Point::from(at);
        let element =
            SizedElement { corners: corners(part, step), longest: edge_length, level: 0, root: None };
        field.wants(&element) && solid.contains(part + 0.5 * step)
    };
    let places = parallel::try_filter(PLACES.pow(3), monitor, is_covered)?;
    Ok(places.len() as f64 * step.element_product())
}

/// The corners of a box, numbered as those of a hex.
fn corners(min: Point, size: Point) -> [Point; 8] {
    let square = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    std::array::from_fn(|k| {
        let [x, y] = square[k % 4];
        min + size * Point::new(x, y, (k / 4) as f64)
    })
}

/// A hex of the first eight nodes.
const ONE: [NodeId; 8] =
    [NodeId(0), NodeId(1), NodeId(2), NodeId(3), NodeId(4), NodeId(5), NodeId(6), NodeId(7)];
