//! Points, boxes, distances and overlaps in double precision. Knows no mesh.

mod aabb;
mod bilinear;
mod box_index;
mod boxes;
mod centered_box;
mod centered_cylinder;
mod closest;
mod eigen;
mod extent;
mod firsts;
mod frame;
mod gjk;
mod grove;
mod hull;
pub(crate) mod lanes;
mod nearest;
mod quad_hull;
mod solid;
mod triangulate;

pub use aabb::Aabb;
pub use bilinear::BilinearQuad;
pub use box_index::BoxIndex;
pub use centered_box::CenteredBox;
pub use centered_cylinder::CenteredCylinder;
pub use closest::{closest_on_segment, closest_on_triangle, segment_weights, triangle_weights};
pub use eigen::symmetric_eigen;
pub(crate) use extent::Extent;
pub(crate) use firsts::Firsts;
pub use frame::Frame;
pub use gjk::{Convex, hull_within};
pub use hull::{Corners, Hull};
pub(crate) use nearest::{CutQuad, Facet, Nearest, NearestFacet, NearestQuad, NearestTriangle, Numbered};
pub use quad_hull::QuadHull;
pub use solid::Solid;
pub use triangulate::{area_vector, triangulate};

/// A point or vector in space, f64.
pub type Point = glam::DVec3;

#[cfg(all(test, not(target_arch = "wasm32")))]
pub(crate) mod samples;
