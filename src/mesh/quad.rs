//! Quad meshes.

use super::NodeId;
use crate::geometry::{Aabb, Point};

/// A mesh of quads, as a structure of arrays. Nodes of a quad are in order around it (VTK_QUAD).
#[derive(Clone, Debug, Default, PartialEq)]
pub struct QuadMesh {
    /// Coordinates of the nodes.
    pub positions: Vec<Point>,
    /// The four nodes of each quad.
    pub quads: Vec<[NodeId; 4]>,
}

impl QuadMesh {
    /// The smallest box around the nodes.
    pub fn bounds(&self) -> Aabb {
        Aabb::around(&self.positions)
    }
}
