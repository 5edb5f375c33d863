//! What topology needs of a surface mesh, be it of polygons or of quads.

use super::{NodeId, PolygonMesh, QuadMesh};
use crate::geometry::Point;

/// A surface seen as a list of faces. A *corner* is a place in the list of all faces' nodes, so corner
/// `k` is a node of one face, and also the edge from that node to the next one around the face.
///
/// Implemented by [`PolygonMesh`] and [`QuadMesh`], so that checks and topology are written once.
pub trait Faces: Sync {
    /// Coordinates of the nodes. Topology asks for their number alone.
    fn positions(&self) -> &[Point];

    /// Number of faces.
    fn face_count(&self) -> usize;

    /// The nodes of all faces, face after face.
    fn corners(&self) -> &[NodeId];

    /// Where the corners of face `f` stand in [`corners`](Self::corners).
    fn range(&self, f: usize) -> std::ops::Range<usize>;

    /// The face that corner `k` belongs to.
    fn face_of(&self, k: usize) -> usize;

    /// Number of nodes.
    fn node_count(&self) -> usize {
        self.positions().len()
    }

    /// The nodes of face `f`, in order around it.
    fn nodes_of(&self, f: usize) -> &[NodeId] {
        &self.corners()[self.range(f)]
    }
}

impl Faces for PolygonMesh {
    fn positions(&self) -> &[Point] {
        &self.positions
    }

    fn face_count(&self) -> usize {
        self.offsets.len() - 1
    }

    fn corners(&self) -> &[NodeId] {
        &self.corners
    }

    fn range(&self, f: usize) -> std::ops::Range<usize> {
        self.offsets[f] as usize..self.offsets[f + 1] as usize
    }

    fn face_of(&self, k: usize) -> usize {
        self.offsets.partition_point(|&start| start as usize <= k) - 1
    }
}

impl Faces for QuadMesh {
    fn positions(&self) -> &[Point] {
        &self.positions
    }

    fn face_count(&self) -> usize {
        self.quads.len()
    }

    fn corners(&self) -> &[NodeId] {
        self.quads.as_flattened()
    }

    fn range(&self, f: usize) -> std::ops::Range<usize> {
        4 * f..4 * f + 4
    }

    fn face_of(&self, k: usize) -> usize {
        k / 4
    }
}
