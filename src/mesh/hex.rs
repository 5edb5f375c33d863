//! Hex meshes.

use super::{FaceGroups, NodeId, Tags};
use crate::geometry::{Aabb, Point};

/// A mesh of hexahedra, as a structure of arrays. Nodes of a hex are in the order of VTK_HEXAHEDRON.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct HexMesh {
    /// Coordinates of the nodes.
    pub positions: Vec<Point>,
    /// The eight nodes of each hex.
    pub hexes: Vec<[NodeId; 8]>,
    /// Names that the file gave to the hexes.
    pub tags: Tags,
    /// Groups of faces, on the boundary and between hexes.
    pub groups: FaceGroups,
}

impl HexMesh {
    /// The smallest box around the nodes.
    pub fn bounds(&self) -> Aabb {
        Aabb::around(&self.positions)
    }
}
