//! What kind of solid a hex mesh is.

use serde::Serialize;

use super::{Bins, HexEdges, HexFaces, Sets};
use crate::mesh::numbering::hex::FACES_AT_EDGE;
use crate::mesh::{EdgeId, FaceId, HexMesh, NodeId};
use crate::monitor::batches;
use crate::{Cancelled, Monitor, Silent, parallel};

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

/// Looks a hex mesh over. `faces` and `edges` are those of `mesh`; all node ids are in range.
pub fn hex_report(mesh: &HexMesh, faces: &HexFaces, edges: &HexEdges) -> HexReport {
    let node_count = mesh.positions.len();
    let links = Links::of(mesh, faces, edges);
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
    let uses = edges.uses();
    let is_odd = |e: usize| !matches!(boundary_faces_at(faces, &uses, EdgeId::new(e)).len(), 0 | 2);
    let nodes = (0..node_count).filter(|&n| links.is_used(n)).count();
    HexReport {
        nodes,
        unused_nodes: node_count - nodes,
        edges: edges.ends.len(),
        faces: faces.nodes.len(),
        hexes: mesh.hexes.len(),
        boundary_faces: boundary().count(),
        boundary_components: rims.roots().filter(|&r| links.on_boundary[r as usize]).count(),
        non_manifold_faces: faces.ids().filter(|&f| faces.sides(f).len() > 2).count(),
        non_manifold_edges: parallel::filter(edges.ends.len(), is_odd).len(),
        non_manifold_nodes: links.odd().count(),
        components: parts.roots().filter(|&r| links.is_used(r as usize)).count(),
        euler: nodes as i64 - edges.ends.len() as i64 + faces.nodes.len() as i64 - mesh.hexes.len() as i64,
    }
}

/// The boundary faces at edge `e`, ascending. `uses` are the hexes at each edge.
pub(crate) fn boundary_faces_at(faces: &HexFaces, uses: &Bins, e: EdgeId) -> Vec<FaceId> {
    let mut found: Vec<FaceId> = uses.at(e.index()).iter().flat_map(|&u| faces_at_use(faces, u)).collect();
    found.retain(|&f| faces.is_boundary(f));
    found.sort_unstable();
    found.dedup();
    found
}

/// The two faces at edge `k` of hex `h`, where `u` is `12 * h + k`.
pub(crate) fn faces_at_use(faces: &HexFaces, u: u32) -> [FaceId; 2] {
    let of_hex = faces.of_hex[u as usize / 12];
    FACES_AT_EDGE[u as usize % 12].map(|k| of_hex[usize::from(k)])
}

/// The links of the nodes. The **link** of a node is the surface that the hexes around it cut out of a small ball
/// about it: a triangle a hex, an edge a face, a corner an edge of the mesh. It is a sphere around a node inside a
/// manifold and a disc around one on its boundary.
pub(crate) struct Links {
    /// Hexes at each node.
    hexes: Vec<u32>,
    /// The Euler characteristic of each node's link.
    euler: Vec<i32>,
    /// For each node: has it a boundary face?
    pub on_boundary: Vec<bool>,
}

impl Links {
    /// Counts edges, faces and hexes at each node.
    pub fn of(mesh: &HexMesh, faces: &HexFaces, edges: &HexEdges) -> Self {
        Self::within(mesh, faces, edges, &Silent).expect("nobody stops it")
    }

    /// As [`Links::of`], unless the monitor stops it.
    pub fn within(
        mesh: &HexMesh,
        faces: &HexFaces,
        edges: &HexEdges,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let count = mesh.positions.len();
        let (mut hexes, mut euler, mut on_boundary) = (vec![0; count], vec![0; count], vec![false; count]);
        let of_hexes = mesh.hexes.as_flattened();
        for (nodes, by) in [(edges.ends.as_flattened(), 1), (faces.nodes.as_flattened(), -1), (of_hexes, 1)] {
            for batch in batches(nodes.len(), monitor) {
                nodes[batch?].iter().for_each(|n| euler[n.index()] += by);
            }
        }
        for batch in batches(of_hexes.len(), monitor) {
            of_hexes[batch?].iter().for_each(|n| hexes[n.index()] += 1);
        }
        for batch in batches(faces.nodes.len(), monitor) {
            for f in batch?.map(FaceId::new).filter(|&f| faces.is_boundary(f)) {
                faces.nodes[f.index()].iter().for_each(|n| on_boundary[n.index()] = true);
            }
        }
        Ok(Self { hexes, euler, on_boundary })
    }

    /// True if some hex uses node `n`.
    pub fn is_used(&self, n: usize) -> bool {
        self.hexes[n] > 0
    }

    /// The nodes in use whose link has not the Euler characteristic of a sphere (2) or, on the boundary, of a disc
    /// (1), with that characteristic.
    pub fn odd(&self) -> impl Iterator<Item = (NodeId, i32)> {
        let is_odd = |&n: &usize| self.is_used(n) && self.euler[n] != if self.on_boundary[n] { 1 } else { 2 };
        (0..self.euler.len()).filter(is_odd).map(|n| (NodeId::new(n), self.euler[n]))
    }
}
