//! The boundary of a mesh while sheets are inserted: its quads, the surface and the side of each.

use super::super::correspondence::Correspondence;
use crate::mesh::numbering::hex::FACES;
use crate::mesh::topology::{Side, hex_boundary, hex_of, side_nodes};
use crate::mesh::{HexId, HexMesh, NodeId};
use crate::parallel;
use crate::solid::SurfaceId;

/// No quad.
pub(super) const NONE: u32 = u32::MAX;

/// The boundary quads, in no particular order.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Boundary {
    /// The nodes of each quad, outward.
    pub(super) quads: Vec<[NodeId; 4]>,
    /// The surface of the solid that each lies on.
    pub(super) surface: Vec<SurfaceId>,
    /// The side of a hex that each is.
    pub(super) sides: Vec<Side>,
}

impl Boundary {
    /// The boundary of a mesh; `on` gives its quads in their order.
    pub(super) fn of(mesh: &HexMesh, on: &Correspondence) -> Self {
        let found = hex_boundary(&mesh.hexes);
        debug_assert_eq!(found.len(), on.faces.len());
        let side = |(quad, hex): &([NodeId; 4], HexId)| {
            let sides = (6 * hex.0..).take(FACES.len());
            sides.into_iter().find(|&side| side_nodes(&mesh.hexes, side) == *quad).unwrap_or(NONE)
        };
        Self {
            sides: found.iter().map(side).collect(),
            quads: found.into_iter().map(|(quad, _)| quad).collect(),
            surface: on.faces.iter().map(|&(_, surface)| surface).collect(),
        }
    }

    /// The quads with their surfaces, in the order of [`hex_boundary`].
    pub(super) fn in_order(&self) -> Vec<([NodeId; 4], SurfaceId)> {
        self.by_side().into_iter().map(|q| (self.quads[q as usize], self.surface[q as usize])).collect()
    }

    /// The quads in the order of the sides that they are: those of a hex follow each other.
    #[inline(never)] // Compiled once for all that call it.
    pub(super) fn by_side(&self) -> Vec<u32> {
        let mut order: Vec<(u64, u32)> = self.sides.iter().map(|&side| side.into()).zip(0..).collect();
        order.sort_unstable();
        order.into_iter().map(|(_, q)| q).collect()
    }

    /// The hex that has a quad.
    pub(super) fn hex(&self, quad: u32) -> usize {
        hex_of(self.sides[quad as usize]).index()
    }

    /// The hexes that have the quads, ascending, each once.
    pub(super) fn hexes(&self, quads: impl IntoIterator<Item = u32>) -> Vec<u32> {
        let mut hexes: Vec<u32> = quads.into_iter().map(|q| self.hex(q) as u32).collect();
        hexes.sort_unstable();
        hexes.dedup();
        hexes
    }

    /// The edges of the quads of which some end is `wanted`.
    pub(super) fn edges(&self, wanted: impl Fn(NodeId) -> bool + Sync) -> BoundaryEdges {
        let mut uses = parallel::gather(self.quads.len(), |q, uses: &mut Vec<(u64, u32)>| {
            let quad = &self.quads[q];
            let edges = (0..4).map(|k| [quad[k], quad[(k + 1) % 4]]);
            let wanted = edges.filter(|edge| edge.iter().any(|&n| wanted(n)));
            uses.extend(wanted.map(|edge| (key(edge), q as u32)));
        });
        parallel::sort(&mut uses);
        BoundaryEdges(uses)
    }
}

/// Edges, as numbers, with the quads at them.
pub(super) struct BoundaryEdges(Vec<(u64, u32)>);

impl BoundaryEdges {
    /// The two quads at an edge; `None` if it has not two.
    pub(super) fn quads(&self, edge: [NodeId; 2]) -> Option<[u32; 2]> {
        let edge = key(edge);
        let first = self.0.partition_point(|&(other, _)| other < edge);
        match self.0[first..] {
            [(a, p), (b, q), ref rest @ ..]
                if a == edge && b == edge && rest.first().is_none_or(|r| r.0 != edge) =>
            {
                Some([p, q])
            }
            _ => None,
        }
    }
}

/// An edge as a number, the same either way round.
fn key(edge: [NodeId; 2]) -> u64 {
    let [a, b] = ascending(edge).map(|n| u64::from(n.0));
    a << 32 | b
}

/// The ends of an edge, the lesser first.
pub(super) fn ascending([a, b]: [NodeId; 2]) -> [NodeId; 2] {
    [a.min(b), a.max(b)]
}
