//! Points, boxes and distances in double precision. Knows no mesh.

mod aabb;
mod nearest;
mod solids;
mod triangle;

#[cfg(all(test, not(target_arch = "wasm32")))]
mod testing;

pub use aabb::Aabb;
pub use nearest::{NearestPoint, NearestTriangle};
pub use solids::{Ball, Cylinder, OrientedBox};
pub use triangle::{Triangle, closest_on_segment, segments_distance_squared};

/// A point or vector in space, f64.
pub type Point = glam::DVec3;
