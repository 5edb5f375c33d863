//! Hexes of the second order: with nodes on edges, on faces and inside beside those at their corners.

use serde::{Deserialize, Serialize};

use super::numbering::hex::{CORNERS, EDGES, EDGES_OF_FACE, FACES};
use super::topology::{HexEdges, HexFaces, Side};
use super::{HexMesh, NodeId};
use crate::geometry::Point;
use crate::{Cancelled, Monitor, Silent};

/// A kind of hex of the second order.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum SecondOrderHex {
    /// A node on each edge (serendipity): 20 nodes.
    Hex20,
    /// A node on each edge, on each face and inside (Lagrange): 27 nodes.
    Hex27,
}

impl SecondOrderHex {
    /// How many nodes a hex has.
    pub fn nodes(self) -> usize {
        match self {
            Self::Hex20 => 20,
            Self::Hex27 => 27,
        }
    }

    /// How many nodes a face has.
    pub fn nodes_of_face(self) -> usize {
        match self {
            Self::Hex20 => 8,
            Self::Hex27 => 9,
        }
    }
}

/// What makes the hexes of a [`HexMesh`] hexes of the second order.
#[derive(Clone, Debug, PartialEq)]
pub struct SecondOrder {
    /// The kind of hex.
    pub hex: SecondOrderHex,
    /// Coordinates of the nodes beside the corners. The first of them has the id after those of the mesh's nodes.
    pub positions: Vec<Point>,
    /// All nodes of each hex, hex after hex: its corners, then those on edges, on faces and inside, in the order of
    /// VTK_QUADRATIC_HEXAHEDRON or VTK_TRIQUADRATIC_HEXAHEDRON.
    pub nodes: Vec<NodeId>,
}

impl SecondOrder {
    /// The hexes of `mesh` with straight edges: all nodes beside the corners are in the middle of these.
    ///
    /// # Panics
    /// If a node id of the mesh is out of range: `check_hexes` tells before.
    pub fn straight(mesh: &HexMesh, hex: SecondOrderHex) -> Self {
        let middle = MiddleNodes::of(mesh, &Silent).expect("nobody stops it");
        let mean = |nodes: &[NodeId]| {
            nodes.iter().map(|n| mesh.positions[n.index()]).sum::<Point>() / nodes.len() as f64
        };
        let on_edges = middle.edges.ends.iter().map(|ends| mean(ends)).collect();
        let on_faces = middle.faces.nodes.iter().map(|face| mean(face)).collect();
        middle.second_order(mesh, hex, on_edges, on_faces)
    }

    /// The nodes of hex `h`.
    pub fn nodes_of(&self, h: usize) -> &[NodeId] {
        &self.nodes[h * self.hex.nodes()..][..self.hex.nodes()]
    }

    /// The nodes of a side: its corners, anticlockwise seen from outside its hex, the nodes on the edges after each, and
    /// the one on the face.
    pub fn nodes_of_side(&self, side: Side) -> Vec<NodeId> {
        let (nodes, face) = (self.nodes_of(side as usize / 6), side as usize % 6);
        let corners = FACES[face].iter().map(|&c| usize::from(c));
        let edges = EDGES_OF_FACE[face].iter().map(|&e| 8 + usize::from(e));
        let middle = (self.hex == SecondOrderHex::Hex27).then_some(FACE_PLACES[face]);
        corners.chain(edges).chain(middle).map(|k| nodes[k]).collect()
    }
}

/// Where each node beside the corners belongs: ids of edges, faces and hexes count from 0.
#[derive(Clone, Debug)]
pub(crate) struct MiddleNodes {
    pub(crate) edges: HexEdges,
    pub(crate) faces: HexFaces,
}

impl MiddleNodes {
    pub(crate) fn of(mesh: &HexMesh, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let nodes = mesh.positions.len();
        Ok(Self {
            edges: HexEdges::within(nodes, &mesh.hexes, monitor)?,
            faces: HexFaces::within(nodes, &mesh.hexes, monitor)?,
        })
    }

    /// The mesh's hexes with the nodes given on edges and faces. The node inside is where those around would have it:
    /// trilinear transfinite interpolation.
    pub(crate) fn second_order(
        &self,
        mesh: &HexMesh,
        hex: SecondOrderHex,
        on_edges: Vec<Point>,
        on_faces: Vec<Point>,
    ) -> SecondOrder {
        let first = mesh.positions.len();
        let first_face = first + on_edges.len();
        let first_inside = first_face + on_faces.len();
        let mut nodes = Vec::with_capacity(mesh.hexes.len() * hex.nodes());
        for (h, corners) in mesh.hexes.iter().enumerate() {
            nodes.extend_from_slice(corners);
            nodes.extend(self.edges.of_hex[h].map(|e| NodeId::new(first + e.index())));
            if hex == SecondOrderHex::Hex27 {
                let mut on_faces = [NodeId(0); 6];
                for (f, place) in self.faces.of_hex[h].into_iter().zip(FACE_PLACES) {
                    on_faces[place - 20] = NodeId::new(first_face + f.index());
                }
                nodes.extend(on_faces);
                nodes.push(NodeId::new(first_inside + h));
            }
        }
        let mut positions = on_edges;
        if hex == SecondOrderHex::Hex27 {
            let inside: Vec<Point> = (0..mesh.hexes.len())
                .map(|h| self.lattice(mesh, h, |e| positions[e], |f| on_faces[f])[26])
                .collect();
            positions.extend(on_faces);
            positions.extend(inside);
        }
        SecondOrder { hex, positions, nodes }
    }

    /// The 27 nodes of hex `h`, in the order of [`SecondOrder::nodes`].
    pub(crate) fn lattice(
        &self,
        mesh: &HexMesh,
        h: usize,
        on_edge: impl Fn(usize) -> Point,
        on_face: impl Fn(usize) -> Point,
    ) -> [Point; 27] {
        let mut nodes = [Point::ZERO; 27];
        let corners = mesh.hexes[h].map(|n| mesh.positions[n.index()]);
        nodes[..8].copy_from_slice(&corners);
        nodes[8..20].copy_from_slice(&self.edges.of_hex[h].map(|e| on_edge(e.index())));
        for (f, place) in self.faces.of_hex[h].into_iter().zip(FACE_PLACES) {
            nodes[place] = on_face(f.index());
        }
        nodes[26] = middle_of_hex(&nodes);
        nodes
    }
}

/// The middle of a face in which the edges bulge as they do around it: a Coons patch. A hex of 20 nodes has its faces so.
pub(crate) fn middle_of_face(corners: [Point; 4], on_edges: [Point; 4]) -> Point {
    on_edges.into_iter().sum::<Point>() * 0.5 - corners.into_iter().sum::<Point>() * 0.25
}

/// The middle of a hex whose corners, edges and faces are known, by transfinite interpolation.
fn middle_of_hex(nodes: &[Point; 27]) -> Point {
    let sum = |from: usize, to: usize| nodes[from..to].iter().copied().sum::<Point>();
    sum(20, 26) * 0.5 - sum(8, 20) * 0.25 + sum(0, 8) * 0.125
}

/// Where the node on each face, in the order of [`FACES`], stands among the nodes of a hex: those on x = 0, x = 1, y = 0 and
/// so on follow each other there.
const FACE_PLACES: [usize; 6] = [24, 25, 22, 21, 23, 20];

/// Where each of the 27 nodes stands in a lattice of 3 x 3 x 3: `x + 3 * y + 9 * z`.
pub(crate) const LATTICE: [usize; 27] = {
    let mut places = [13; 27];
    let mut k = 0;
    while k < 26 {
        // The corners around the node whose place is looked for.
        let (node, corners): (usize, &[u8]) = if k < 8 {
            (k, &[k as u8])
        } else if k < 20 {
            (k, &EDGES[k - 8])
        } else {
            (FACE_PLACES[k - 20], &FACES[k - 20])
        };
        let (mut axis, mut place, mut step) = (0, 0, 1);
        while axis < 3 {
            let (mut c, mut sum) = (0, 0);
            while c < corners.len() {
                sum += CORNERS[corners[c] as usize][axis] as usize;
                c += 1;
            }
            place += step * (2 * sum / corners.len());
            step *= 3;
            axis += 1;
        }
        places[node] = place;
        k += 1;
    }
    places
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_lattice_has_each_place_once() {
        let mut places = LATTICE;
        places.sort_unstable();
        assert_eq!(places, std::array::from_fn(|k| k));
        // The middles of the faces at x = 0, x = 1, y = 0 and so on.
        assert_eq!(LATTICE[20..], [12, 14, 10, 16, 4, 22, 13]);
        assert_eq!((LATTICE[0], LATTICE[8], LATTICE[18]), (0, 1, 17));
    }
}
