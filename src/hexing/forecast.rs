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

/// What is told of a mesh before it is made.
#[derive(Clone, Debug, PartialEq)]
pub struct SolidForecast {
    /// About how many hexes there will be.
    pub hexes: f64,
    /// The regions that overlap no part of the solid, by their places among the options'. They refine nothing.
    pub idle_regions: Vec<u32>,
}

/// About how many hexes [`hex_solid`](super::hex_solid) makes: as many as cells of the edge length, and more in regions.
/// What curvature, or something that was missed, has refined is not counted, nor an octree instead of what was chosen, nor edges
/// that become shorter for a distance that was asked for.
/// Regions that overlap are counted each; those a sixteenth of their size from the solid or less count as meeting it.
///
/// # Errors
/// If an option or a region is out of range, or the monitor stops it.
pub fn forecast_hexes(
    solid: &SolidModel,
    options: &HexingOptions,
    monitor: &dyn Monitor,
) -> Result<SolidForecast, HexingError> {
    validate(options)?;
    let mut forecast =
        SolidForecast { hexes: estimate_hexes(solid, options.edge_length), idle_regions: Vec::new() };
    for (k, region) in (0..).zip(&options.regions) {
        let more = 8_f64.powi(levels(region.target, options.edge_length)) - 1.0;
        let cell = options.edge_length.powi(3);
        let Covered { volume, is_met } = covered(solid, region, options.edge_length, monitor)?;
        forecast.hexes += more * volume / cell;
        if !is_met {
            forecast.idle_regions.push(k);
        }
    }
    Ok(forecast)
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

/// What of a solid is in a region.
struct Covered {
    volume: f64,
    is_met: bool,
}

/// Looks at places all over the box that region and solid share.
fn covered(
    solid: &SolidModel,
    region: &Region,
    edge_length: f64,
    monitor: &dyn Monitor,
) -> Result<Covered, HexingError> {
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
        return Ok(Covered { volume: 0.0, is_met: false });
    }
    let step = (within.max - within.min) / PLACES as f64;
    let at = |place: usize| {
        let at = [place % PLACES, place / PLACES % PLACES, place / PLACES / PLACES].map(|k| k as f64);
        let part = within.min + step * Point::from(at);
        (
            SizedElement { corners: corners(part, step), longest: edge_length, level: 0, root: None },
            part + 0.5 * step,
        )
    };
    let is_covered = |place: usize| {
        let (element, middle) = at(place);
        field.wants(&element) && solid.contains(middle)
    };
    let covered = parallel::try_filter(PLACES.pow(3), monitor, is_covered)?.len();
    let reach = 0.5 * step.length();
    let idle = field.idle_regions(PLACES.pow(3), monitor, |place| {
        let (element, middle) = at(place);
        (solid.signed_distance(middle) <= reach).then_some(element)
    })?;
    Ok(Covered { volume: covered as f64 * step.element_product(), is_met: idle.is_empty() })
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Silent;
    use crate::sizing::Shape;
    use crate::solid::testing::{solid, voxels};

    /// Of a box with a hollow inside: what is in the hollow alone meets nothing, nor does what meets a corner of the box's box
    /// and not the box.
    #[test]
    fn regions_that_meet_nothing_are_told() {
        let hollow = solid(&voxels([3, 3, 3], |cube| cube != [1; 3]));
        let ball = |center: f64, radius: f64| Region {
            shape: Shape::Sphere { center: Point::splat(center), radius },
            target: Target::Level(1),
        };
        let regions = vec![
            ball(1.5, 0.3),
            ball(1.5, 1.35),
            ball(3.9, 1.2),
            ball(3.9, 1.6),
            ball(0.3, 3e-3),
            ball(9.0, 1.0),
        ];
        let options = HexingOptions { edge_length: 0.3, regions, ..HexingOptions::default() };
        assert_eq!(forecast_hexes(&hollow, &options, &Silent).unwrap().idle_regions, [0, 2, 5]);
    }
}
