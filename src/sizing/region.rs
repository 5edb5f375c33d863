//! Refinement regions: a shape in space and what is wanted inside it.

use serde::{Deserialize, Serialize};

use crate::geometry::Point;

/// Elements that overlap `shape` are refined until they reach `target`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Region {
    /// Where.
    #[serde(flatten)]
    pub shape: Shape,
    /// How far.
    #[serde(flatten)]
    pub target: Target,
}

/// What a region asks of the elements in it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Target {
    /// No edge longer than this, in model units.
    Size(f64),
    /// This many refinements of the input (level 0).
    Level(u8),
}

/// The shape of a region.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "camelCase")]
pub enum Shape {
    /// A box of any orientation: the box from `min` to `max`, turned about its centre.
    Box {
        /// Least corner before the turn.
        min: Point,
        /// Greatest corner before the turn.
        max: Point,
        /// Unit quaternion x, y, z, w.
        #[serde(default)]
        rotation: glam::DQuat,
    },
    /// A ball.
    Sphere {
        /// Its centre.
        center: Point,
        /// Its radius.
        radius: f64,
    },
    /// A capped cylinder of any axis.
    Cylinder {
        /// Centre of one cap.
        from: Point,
        /// Centre of the other cap.
        to: Point,
        /// Its radius.
        radius: f64,
    },
    /// Everything within `radius` of one of the points (the paper's governing points, section 3.2).
    Points {
        /// The points.
        points: Vec<Point>,
        /// The distance within which elements are refined; 0: elements that hold a point.
        radius: f64,
    },
    /// Everything within `distance` of a triangle surface.
    Surface {
        /// Its nodes.
        positions: Vec<Point>,
        /// Its triangles, as indices into `positions`.
        triangles: Vec<[u32; 3]>,
        /// The distance within which elements are refined; 0: elements that touch the surface.
        distance: f64,
    },
}

impl Shape {
    /// The name of the kind of shape, the same as `kind` in JSON.
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Box { .. } => "box",
            Self::Sphere { .. } => "sphere",
            Self::Cylinder { .. } => "cylinder",
            Self::Points { .. } => "points",
            Self::Surface { .. } => "surface",
        }
    }
}
