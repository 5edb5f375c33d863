//! What kind of solid a hex mesh is.

use serde::Serialize;

use super::{HexTopology, Sets};

/// What kind of solid a hex mesh is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct HexReport {
    /// Nodes that some hex uses.
    pub nodes: usize,
    /// Nodes that no hex uses.
    pub unused_nodes: usize,
    /// Edges.
    pub edges: usize,
    /// Faces.
    pub faces: usize,
    /// Hexes.
    pub hexes: usize,
    /// Faces of one hex.
    pub boundary_faces: usize,
    /// Parts of the boundary that share no node.
    pub boundary_components: usize,
    /// Faces of three hexes or more.
    pub non_manifold_faces: usize,
    /// Edges with boundary faces, but not two.
    pub non_manifold_edges: usize,
    /// Nodes around which the hexes fill neither a ball nor half of one.
    pub non_manifold_nodes: usize,
    /// Parts that share no node.
    pub components: usize,
    /// Euler characteristic: nodes - edges + faces - hexes.
    pub euler: i64,
}

impl HexReport {
    /// True if the mesh is a manifold with boundary: the points of each face, edge and node have a neighbourhood
    /// like a ball, or half of one.
    pub fn is_manifold(&self) -> bool {
        self.non_manifold_faces == 0 && self.non_manifold_edges == 0 && self.non_manifold_nodes == 0
    }
}

/// Looks a hex mesh over.
pub fn hex_report(topology: &HexTopology) -> HexReport {
    let HexTopology { faces, edges, links, .. } = topology;
    let node_count = links.len();
    let (mut parts, mut rims) = (Sets::new(node_count), Sets::new(node_count));
    for [a, b] in &edges.ends {
        parts.join(a.0, b.0, false);
    }
    let boundary = || faces.ids().filter(|&f| faces.is_boundary(f));
    for [a, b, c, d] in boundary().map(|f| faces.nodes[f.index()]) {
        rims.join(a.0, b.0, false);
        rims.join(b.0, c.0, false);
        rims.join(c.0, d.0, false);
    }
    let nodes = (0..node_count).filter(|&n| links.is_used(n)).count();
    let hexes = faces.of_hex.len();
    HexReport {
        nodes,
        unused_nodes: node_count - nodes,
        edges: edges.ends.len(),
        faces: faces.nodes.len(),
        hexes,
        boundary_faces: boundary().count(),
        boundary_components: rims.roots().filter(|&r| links.on_boundary[r as usize]).count(),
        non_manifold_faces: faces.ids().filter(|&f| faces.sides(f).len() > 2).count(),
        non_manifold_edges: topology.odd_rims().count(),
        non_manifold_nodes: links.odd().count(),
        components: parts.roots().filter(|&r| links.is_used(r as usize)).count(),
        euler: nodes as i64 - edges.ends.len() as i64 + faces.nodes.len() as i64 - hexes as i64,
    }
}
