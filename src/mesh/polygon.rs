//! Polygon surface meshes: what a surface file holds.

use super::{NodeId, Tags};
use crate::geometry::{Aabb, Point, triangulate};

/// A surface of polygons, as a structure of arrays.
///
/// Invariants: `offsets` has one entry more than there are faces, starts at 0 and never falls; face
/// `f` has the nodes `corners[offsets[f]..offsets[f + 1]]`, at least three, in order around it; every
/// node id is less than `positions.len()`.
#[derive(Clone, Debug, PartialEq)]
pub struct PolygonMesh {
    /// Coordinates of the nodes.
    pub positions: Vec<Point>,
    /// Where each face's corners start in `corners`, and the end of the last.
    pub offsets: Vec<u32>,
    /// The nodes of all faces, face after face.
    pub corners: Vec<NodeId>,
    /// Names that the file gave to the faces.
    pub tags: Tags,
    /// Polylines, creases and the boundary rule that came with the surface.
    pub features: Features,
}

/// What a file says beside the faces: polylines (OBJ `l`) and OpenSubdiv's `t` lines.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Features {
    /// Polylines of at least two nodes.
    pub polylines: Vec<Vec<NodeId>>,
    /// Edges with a sharpness (OBJ `t crease`).
    pub creases: Vec<([NodeId; 2], f64)>,
    /// Nodes with a sharpness (OBJ `t corner`).
    pub corners: Vec<(NodeId, f64)>,
    /// OpenSubdiv's boundary rule (OBJ `t interpolateboundary`), if given.
    pub interpolate_boundary: Option<i32>,
}

impl Default for PolygonMesh {
    fn default() -> Self {
        Self {
            positions: Vec::new(),
            offsets: vec![0],
            corners: Vec::new(),
            tags: Tags::default(),
            features: Features::default(),
        }
    }
}

impl PolygonMesh {
    /// Number of faces.
    pub fn face_count(&self) -> usize {
        self.offsets.len() - 1
    }

    /// The faces cut into triangles, by their nodes.
    pub fn triangles(&self) -> Vec<[u32; 3]> {
        let (mut triangles, mut corners, mut cut) = (Vec::new(), Vec::new(), Vec::new());
        for nodes in self.faces() {
            corners.clear();
            corners.extend(nodes.iter().map(|n| self.positions[n.index()]));
            cut.clear();
            triangulate(&corners, &mut cut);
            triangles.extend(cut.iter().map(|t| t.map(|k| nodes[k as usize].0)));
        }
        triangles
    }

    /// The nodes of face `f`, in order around it.
    pub fn face(&self, f: usize) -> &[NodeId] {
        &self.corners[self.offsets[f] as usize..self.offsets[f + 1] as usize]
    }

    /// All faces in order.
    pub fn faces(&self) -> impl ExactSizeIterator<Item = &[NodeId]> {
        self.offsets.windows(2).map(|w| &self.corners[w[0] as usize..w[1] as usize])
    }

    /// Adds a face with the given nodes.
    pub fn push_face(&mut self, nodes: impl IntoIterator<Item = NodeId>) {
        self.corners.extend(nodes);
        self.offsets.push(u32::try_from(self.corners.len()).expect("more than 2^32 corners"));
    }

    /// True if every face has four nodes.
    pub fn is_all_quad(&self) -> bool {
        self.faces().all(|f| f.len() == 4)
    }

    /// The smallest box around the nodes.
    pub fn bounds(&self) -> Aabb {
        Aabb::around(&self.positions)
    }
}
