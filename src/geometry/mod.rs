//! Points, boxes and distances in double precision. Knows no mesh.

mod aabb;

pub use aabb::Aabb;

/// A point or vector in space, f64.
pub type Point = glam::DVec3;
