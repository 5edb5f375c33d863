//! Where elements are to be refined: options and regions made ready for many questions.

use super::{Region, Shape, Target};
use crate::geometry::Point;
use crate::mesh::{FaceId, PolygonMesh};

/// An element that asks whether it is to be refined.
#[derive(Clone, Copy, Debug)]
pub struct SizedElement {
    /// The positions of its nodes, in order around it.
    pub corners: [Point; 4],
    /// The length of its longest edge.
    pub longest: f64,
    /// Its refinement level.
    pub level: u8,
    /// The input face that it is part of.
    pub root: FaceId,
}

/// What a size field is made of.
#[derive(Clone, Copy, Debug)]
pub struct SizeOptions<'a> {
    /// No edge longer than this, anywhere.
    pub edge_length: Option<f64>,
    /// Turn of the surface's normal that one edge may span, in degrees.
    pub curvature: Option<f64>,
    /// How much larger an element may be than its neighbour.
    pub gradation: f64,
    /// Where to refine further.
    pub regions: &'a [Region],
}

/// Why a size field cannot be made.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SizingError {}

impl SizingError {
    /// A stable name of the kind of error.
    pub fn code(&self) -> &'static str {
        match *self {}
    }
}

/// Tells which elements are to be refined.
#[derive(Debug)]
pub struct SizeField {
    edge_length: f64,
    regions: Vec<Region>,
}

impl SizeField {
    /// Checks the options and prepares them.
    pub fn new(_input: &PolygonMesh, options: SizeOptions<'_>) -> Result<Self, SizingError> {
        Ok(Self {
            edge_length: options.edge_length.unwrap_or(f64::INFINITY),
            regions: options.regions.to_vec(),
        })
    }

    /// True if no element of this level or deeper is to be refined, whatever its size and place.
    pub fn is_idle_from(&self, level: u8) -> bool {
        self.edge_length.is_infinite()
            && self.regions.iter().all(|r| matches!(r.target, Target::Level(l) if l <= level))
    }

    /// True if the element is to be refined.
    pub fn wants(&self, element: &SizedElement) -> bool {
        element.longest > self.edge_length
            || self.regions.iter().any(|r| {
                let near = match &r.shape {
                    Shape::Sphere { center, radius } => {
                        let mean = element.corners.iter().sum::<Point>() / 4.0;
                        mean.distance(*center) < *radius + element.longest * 0.5
                    }
                    _ => false,
                };
                near && match r.target {
                    Target::Size(s) => element.longest > s,
                    Target::Level(l) => element.level < l,
                }
            })
    }
}
