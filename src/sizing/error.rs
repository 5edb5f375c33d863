//! Why a size field cannot be made; the checks of regions and options.

use super::field::SizeOptions;
use super::{Region, Shape, Target};
use crate::Cancelled;
use crate::geometry::Point;

/// Why a size field cannot be made. Each message holds the value at fault and what to do.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SizingError {
    /// The global edge length is no positive number.
    #[error("the edge length is {0}; give a positive number")]
    EdgeLength(f64),
    /// The angle an edge is out of range.
    #[error("the curvature is {0} degrees an edge; give more than 0 and at most 180")]
    Curvature(f64),
    /// Curvature was asked for in a hex mesh.
    #[error("hexes have no curvature; leave it out, or give the surface as a region")]
    CurvatureOfHexes,
    /// The gradation is out of range.
    #[error("the gradation is {0}; give more than 1 and at most 2")]
    Gradation(f64),
    /// A region has a value that makes no sense.
    #[error("region {index} (of kind {kind}, counted from 0): {fault}")]
    Region {
        /// Which region, from 0.
        index: usize,
        /// The kind of its shape.
        kind: &'static str,
        /// What is wrong with it.
        fault: RegionFault,
    },
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// What is wrong with a region.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RegionFault {
    /// A coordinate is infinite or not a number.
    #[error("{key} has the coordinates {value}; give finite numbers")]
    NotFinite {
        /// The key of the point or points.
        key: &'static str,
        /// The point.
        value: Point,
    },
    /// The target edge length is no positive number.
    #[error("size is {0}; give a positive number")]
    Size(f64),
    /// A radius or distance is out of range.
    #[error("{key} is {value}; give {wanted}")]
    Reach {
        /// The key.
        key: &'static str,
        /// Its value.
        value: f64,
        /// What it may be.
        wanted: &'static str,
    },
    /// A box's least corner is not the least.
    #[error("min is {min} and max {max}; give the lesser coordinates to min")]
    Inverted {
        /// The least corner given.
        min: Point,
        /// The greatest corner given.
        max: Point,
    },
    /// A quaternion that is no rotation.
    #[error("rotation is {0}; give a quaternion [x, y, z, w] other than 0, such as [0, 0, 0, 1] for no turn")]
    Rotation(glam::DQuat),
    /// There are no points or no triangles.
    #[error("there are no {0}; give at least one, or remove the region")]
    Empty(&'static str),
    /// A triangle has a node that is not there.
    #[error(
        "triangle {triangle} (counted from 0) has the node {node}, but there are {nodes} positions; give indices from 0"
    )]
    Index {
        /// The triangle.
        triangle: usize,
        /// The index given.
        node: u32,
        /// How many positions there are.
        nodes: usize,
    },
}

impl SizingError {
    /// A stable name of the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            Self::EdgeLength(_) => "edge-length-out-of-range",
            Self::Curvature(_) => "curvature-out-of-range",
            Self::CurvatureOfHexes => "curvature-needs-surface",
            Self::Gradation(_) => "gradation-out-of-range",
            Self::Cancelled(_) => "cancelled",
            Self::Region { fault, .. } => match fault {
                RegionFault::NotFinite { .. } => "region-not-finite",
                RegionFault::Size(_) => "region-size-out-of-range",
                RegionFault::Reach { .. } => "region-radius-out-of-range",
                RegionFault::Inverted { .. } => "region-box-inverted",
                RegionFault::Rotation(_) => "region-rotation-invalid",
                RegionFault::Empty(_) => "region-empty",
                RegionFault::Index { .. } => "region-index-out-of-range",
            },
        }
    }
}

/// Refuses options and regions that make no sense.
pub(super) fn validate(options: &SizeOptions<'_>) -> Result<(), SizingError> {
    if let Some(length) = options.edge_length.filter(|&l| !is_positive(l)) {
        return Err(SizingError::EdgeLength(length));
    }
    if let Some(angle) = options.curvature.filter(|&a| !(is_positive(a) && a <= 180.0)) {
        return Err(SizingError::Curvature(angle));
    }
    if !(options.gradation > 1.0 && options.gradation <= 2.0) {
        return Err(SizingError::Gradation(options.gradation));
    }
    for (index, region) in options.regions.iter().enumerate() {
        let kind = region.shape.kind();
        validate_region(region).map_err(|fault| SizingError::Region { index, kind, fault })?;
    }
    Ok(())
}

fn validate_region(region: &Region) -> Result<(), RegionFault> {
    match &region.shape {
        Shape::Box { min, max, rotation } => {
            finite("min", &[*min])?;
            finite("max", &[*max])?;
            if min.cmpgt(*max).any() {
                return Err(RegionFault::Inverted { min: *min, max: *max });
            }
            // The length is that of the quaternion scaled to what can be squared.
            let largest = rotation.to_array().into_iter().fold(0.0, |m: f64, x| m.max(x.abs()));
            if !rotation.is_finite() || largest == 0.0 {
                return Err(RegionFault::Rotation(*rotation));
            }
        }
        Shape::Sphere { center, radius } => {
            finite("center", &[*center])?;
            positive("radius", *radius)?;
        }
        Shape::Cylinder { from, to, radius } => {
            finite("from", &[*from])?;
            finite("to", &[*to])?;
            positive("radius", *radius)?;
        }
        Shape::Points { points, radius } => {
            not_empty("points", points.len())?;
            finite("points", points)?;
            not_negative("radius", *radius)?;
        }
        Shape::Surface { positions, triangles, distance } => {
            not_empty("triangles", triangles.len())?;
            finite("positions", positions)?;
            not_negative("distance", *distance)?;
            indices(triangles, positions.len())?;
        }
    }
    match region.target {
        Target::Size(size) if !is_positive(size) => Err(RegionFault::Size(size)),
        Target::Size(_) | Target::Level(_) => Ok(()),
    }
}

fn is_positive(value: f64) -> bool {
    value.is_finite() && value > 0.0
}

fn finite(key: &'static str, points: &[Point]) -> Result<(), RegionFault> {
    match points.iter().find(|p| !p.is_finite()) {
        Some(&value) => Err(RegionFault::NotFinite { key, value }),
        None => Ok(()),
    }
}

fn positive(key: &'static str, value: f64) -> Result<(), RegionFault> {
    if is_positive(value) {
        Ok(())
    } else {
        Err(RegionFault::Reach { key, value, wanted: "a positive number" })
    }
}

fn not_negative(key: &'static str, value: f64) -> Result<(), RegionFault> {
    let wanted = "0 or a positive number";
    if is_positive(value) || value == 0.0 { Ok(()) } else { Err(RegionFault::Reach { key, value, wanted }) }
}

fn not_empty(what: &'static str, count: usize) -> Result<(), RegionFault> {
    if count > 0 { Ok(()) } else { Err(RegionFault::Empty(what)) }
}

fn indices(triangles: &[[u32; 3]], nodes: usize) -> Result<(), RegionFault> {
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&node) = corners.iter().find(|&&node| node as usize >= nodes) {
            return Err(RegionFault::Index { triangle, node, nodes });
        }
    }
    Ok(())
}
