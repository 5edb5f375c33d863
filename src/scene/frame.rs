//! Where the f32 scene stands in the f64 world.

use glam::{DMat4, DVec3, Vec3};

use crate::geometry::{Aabb, Point};

/// The scene's origin and scale: `scene = (world - origin) * scale`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    /// World point at the scene's origin.
    pub origin: Point,
    /// Scene units a world unit.
    pub scale: f64,
}

impl Default for Frame {
    fn default() -> Self {
        Self { origin: Point::ZERO, scale: 1.0 }
    }
}

impl Frame {
    /// The frame in which `bounds` is centred and its longest side is 1. An empty box or one without
    /// extent keeps world units.
    pub fn around(bounds: &Aabb) -> Self {
        if bounds.is_empty() {
            return Self::default();
        }
        // Halves before the difference: the diagonal of huge coordinates must not overflow.
        let half = (bounds.max * 0.5 - bounds.min * 0.5).max_element();
        let scale = if half > 0.0 { 0.5 / half } else { 1.0 };
        Self { origin: bounds.center(), scale }
    }

    /// A world point in the scene, as the GPU gets it.
    pub fn scene(&self, world: Point) -> Vec3 {
        self.scene_f64(world).as_vec3()
    }

    /// A world point in the scene, in double precision.
    pub fn scene_f64(&self, world: Point) -> DVec3 {
        (world - self.origin) * self.scale
    }

    /// A scene point in the world.
    pub fn world(&self, scene: DVec3) -> Point {
        scene / self.scale + self.origin
    }

    /// The transform from scene to world.
    pub fn world_from_scene(&self) -> DMat4 {
        DMat4::from_translation(self.origin) * DMat4::from_scale(DVec3::splat(1.0 / self.scale))
    }
}
