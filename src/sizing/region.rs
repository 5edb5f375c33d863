//! Refinement regions: a shape in space and what is wanted inside it.

use serde::{Deserialize, Serialize};

use super::overlap::Overlap;
use crate::geometry::{Aabb, Point};

/// Elements that overlap `shape` are refined until they reach `target`.
///
/// In JSON the keys of both stand side by side:
///
/// ```
/// use hexmill::sizing::{Region, Target};
/// let ball: Region = serde_json::from_str(r#"{"kind": "sphere", "center": [0, 0, 0], "radius": 1, "size": 0.1}"#)?;
/// assert_eq!(ball.target, Target::Size(0.1));
/// let error = serde_json::from_str::<Region>(r#"{"kind": "sphere", "center": [0, 0, 0], "radius": 1}"#).unwrap_err();
/// assert!(error.to_string().starts_with("a sphere region needs 'size' or 'level'"));
/// # Ok::<(), serde_json::Error>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Region {
    /// Where.
    pub shape: Shape,
    /// How far.
    pub target: Target,
}

/// What a region asks of the elements in it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    /// No edge longer than this, in model units.
    Size(f64),
    /// This many refinements of the input (level 0).
    Level(u8),
}

/// The shape of a region, with its boundary.
///
/// A shape may have no thickness: a flat box, the points of a set with radius 0, a surface with distance 0. The
/// elements that it lies in overlap it; if it lies in an edge, all elements at that edge do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(tag = "kind", rename_all = "camelCase")]
pub enum Shape {
    /// A box of any orientation: the box from `min` to `max`, turned about its centre.
    Box {
        /// Least corner before the turn.
        min: Point,
        /// Greatest corner before the turn.
        max: Point,
        /// Quaternion x, y, z, w, of any length but 0. In JSON it may be left out: no turn.
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
    /// A capped cylinder of any axis. Where both ends are one there is no axis: then the ball of that radius, which
    /// is what discs of all directions fill.
    Cylinder {
        /// Centre of one cap.
        from: Point,
        /// Centre of the other cap.
        to: Point,
        /// Its radius.
        radius: f64,
    },
    /// Everything within `radius` of one of the points (the paper's governing points, section 3.2 and figure 14).
    Points {
        /// The points.
        points: Vec<Point>,
        /// The distance within which elements are refined; 0: elements that hold a point.
        radius: f64,
    },
    /// Everything within `distance` of a triangle surface (the paper's governing surface, figure 15).
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
    /// The box around it.
    pub fn bounds(&self) -> Aabb {
        Overlap::new(self).bounds
    }

    /// The name of the kind of shape, as JSON has it.
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
