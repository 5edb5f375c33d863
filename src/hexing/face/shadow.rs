//! What a solid covers along a direction.

use glam::DVec2;

use super::scale::Projection;
use crate::geometry::{Aabb, BoxIndex, Point};
use crate::solid::SolidModel;

/// The solid's triangles that face the direction, projected.
pub(super) struct Shadow {
    triangles: Vec<[DVec2; 3]>,
    index: BoxIndex,
}

impl Shadow {
    pub(super) fn new(solid: &SolidModel, projection: &Projection) -> Self {
        let flat = |t: &[u32; 3]| t.map(|v| projection.unit_from_model(solid.points()[v as usize]));
        let mut triangles: Vec<[DVec2; 3]> = solid.triangles().iter().map(flat).collect();
        triangles.retain(|[a, b, c]| (*b - *a).perp_dot(*c - *a) > 0.0);
        let bounds = triangles.iter().map(|t| Aabb::around(&t.map(|p| Point::new(p.x, p.y, 0.0))));
        let index = BoxIndex::new(bounds.collect::<Vec<_>>());
        Self { triangles, index }
    }

    /// Is `p` covered?
    pub(super) fn covers(&self, p: DVec2) -> bool {
        let at = Point::new(p.x, p.y, 0.0);
        self.index.touching(&Aabb { min: at, max: at }).any(|t| {
            let [a, b, c] = self.triangles[t];
            (b - a).perp_dot(p - a) >= 0.0 && (c - b).perp_dot(p - b) >= 0.0 && (a - c).perp_dot(p - c) >= 0.0
        })
    }
}
