//! What a solid's boundary is made of.

use crate::geometry::{Aabb, Point};

crate::mesh::ids! {
    /// A point of the solid where curves end.
    CornerId;
    /// A line on the boundary that a mesh has to keep: where surfaces meet, or a crease within one.
    CurveId;
    /// A part of the boundary that curves bound.
    SurfaceId;
}

/// A point where feature edges end or branch, or where a curve turns sharply.
#[derive(Clone, Debug, PartialEq)]
pub struct Corner {
    /// The vertex, among [`SolidModel::points`](super::SolidModel::points).
    pub vertex: u32,
    /// Where it is.
    pub point: Point,
    /// The ends of curves that meet here, counter-clockwise seen from outside: in the order in which a walk over the
    /// triangles around the vertex meets them.
    pub arms: Vec<Arm>,
}

/// An end of a curve at a corner. A curve that comes back to its corner has two there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arm {
    /// The curve.
    pub curve: CurveId,
    /// Is it the curve's start, or its end?
    pub at_start: bool,
    /// The angle between it and the next arm in radians: the sum of those of the triangles there.
    pub sector: f64,
}

/// A chain of feature edges.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Its vertices from start to end; in a closed curve without a corner the first is the last.
    pub vertices: Vec<u32>,
    /// The corners at its start and end; `None` if it is closed and has no corner.
    pub ends: Option<[CornerId; 2]>,
    /// The surfaces left and right of its direction, seen from outside. They are the same along a crease that ends
    /// within a surface.
    pub sides: [SurfaceId; 2],
    /// Degrees inside the solid, from surface to surface: the mean over its length. Less than 180 is convex.
    pub interior_angle: f64,
    /// Its length.
    pub length: f64,
    /// Do all its edges have one direction?
    pub is_straight: bool,
}

impl Curve {
    /// By how much its sides meet at another angle than a straight one, in degrees.
    pub fn sharpness(&self) -> f64 {
        (self.interior_angle - 180.0).abs()
    }
}

/// A part of the boundary.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    /// Its triangles, ascending.
    pub triangles: Vec<u32>,
    /// Its area.
    pub area: f64,
    /// Its shape.
    pub class: SurfaceClass,
    /// The curves that bound it or end within it, ascending.
    pub curves: Vec<CurveId>,
    /// The box around it.
    pub bounds: Aabb,
    /// Which of the disjoint bodies it belongs to, from 0.
    pub body: u32,
}

/// The shape of a surface, told by its normals.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SurfaceClass {
    /// All normals are one.
    Planar {
        /// The outward unit normal.
        normal: Point,
    },
    /// All normals are perpendicular to one direction: a cylinder, or another profile that is extruded.
    Cylindrical {
        /// The unit direction of extrusion; which of the two is arbitrary.
        axis: Point,
    },
    /// Anything else.
    General,
}
