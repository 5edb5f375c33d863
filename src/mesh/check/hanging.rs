//! Nodes inside edges. Reads positions, which is why it stands apart from topology.

use rayon::prelude::*;
use rstar::{AABB, RTree, RTreeObject};

use super::{CHUNK, Defect};
use crate::geometry::Point;
use crate::mesh::topology::{Edges, used_nodes};
use crate::mesh::{Faces, NodeId};

/// Every node that lies inside an edge of which it is no end, among all edges: on a surface that passes,
/// no cracks hide where several sheets meet either. Costs several times what a check costs, which looks
/// at the edges of one face alone.
pub fn hanging_nodes(mesh: &impl Faces) -> Vec<Defect> {
    inside(mesh.positions(), &used_nodes(mesh), Edges::of(mesh).ends)
}

/// A node counts as inside an edge if it is nearer to the edge than this share of its length, and
/// farther than that from its ends: what a file of six significant digits leaves of a coordinate.
const NEAR: f64 = 1e-6;

/// The `used` nodes that lie inside one of `edges`, in order of nodes, then of edges.
pub(super) fn inside(positions: &[Point], used: &[bool], edges: Vec<[NodeId; 2]>) -> Vec<Defect> {
    if edges.is_empty() {
        return Vec::new();
    }
    let tree = RTree::bulk_load(edges.into_iter().map(|ends| Segment::new(positions, ends)).collect());
    let nodes = positions.par_iter().enumerate().with_min_len(CHUNK).filter(|&(n, _)| used[n]);
    let found = nodes.flat_map_iter(|(n, &p)| {
        let node = NodeId::new(n);
        let near = tree.locate_in_envelope_intersecting(AABB::from_point(p.to_array()));
        let mut edges: Vec<_> = near.filter(|s| s.holds(positions, node)).map(|s| s.ends).collect();
        edges.sort_unstable();
        edges.into_iter().map(move |edge| Defect::HangingNode { node, edge })
    });
    found.collect()
}

struct Segment {
    ends: [NodeId; 2],
    envelope: AABB<[f64; 3]>,
}

impl Segment {
    fn new(positions: &[Point], ends: [NodeId; 2]) -> Self {
        let [a, b] = ends.map(|n| positions[n.index()]);
        let margin = Point::splat(NEAR * a.distance(b));
        let (min, max) = (a.min(b) - margin, a.max(b) + margin);
        Self { ends, envelope: AABB::from_corners(min.to_array(), max.to_array()) }
    }

    fn holds(&self, positions: &[Point], node: NodeId) -> bool {
        if self.ends.contains(&node) {
            return false;
        }
        let [a, b] = self.ends.map(|n| positions[n.index()]);
        let (along, to_node) = (b - a, positions[node.index()] - a);
        let t = to_node.dot(along) / along.length_squared();
        t > NEAR && t < 1.0 - NEAR && to_node.distance(t * along) < NEAR * along.length()
    }
}

impl RTreeObject for Segment {
    type Envelope = AABB<[f64; 3]>;

    fn envelope(&self) -> Self::Envelope {
        self.envelope
    }
}
