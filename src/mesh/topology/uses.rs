//! Which faces meet at an edge.

use super::Bins;
use crate::mesh::{EdgeId, Edges};
use crate::{Cancelled, Monitor, Silent};

/// For each edge the corners that use it, in ascending order: one on the boundary, two inside a
/// manifold surface, more where sheets meet. Corner `k` walks its edge forwards if the mesh's corner
/// `k` equals `ends[0]` of the edge.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct EdgeUses(Bins);

impl EdgeUses {
    /// Turns `edges.of_corner` around.
    pub fn of(edges: &Edges) -> Self {
        Self::monitored(edges, &Silent).expect("nobody stops it")
    }

    /// As [`EdgeUses::of`], for callers that may want to stop.
    ///
    /// # Errors
    /// If the monitor stops it.
    pub fn monitored(edges: &Edges, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let of_corner = &edges.of_corner;
        Bins::monitored(edges.len(), of_corner.len(), |k| of_corner[k].index(), monitor).map(Self)
    }

    /// The corners that use edge `e`.
    pub fn at(&self, e: EdgeId) -> &[u32] {
        self.0.at(e.index())
    }

    /// How many faces meet at edge `e` (a face that walks it twice counts twice).
    pub fn count(&self, e: EdgeId) -> usize {
        self.at(e).len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_the_corners_of_each_edge_in_order() {
        let edges =
            Edges { ends: vec![Default::default(); 3], of_corner: [2, 0, 2, 1, 2].map(EdgeId).to_vec() };
        let uses = EdgeUses::of(&edges);
        assert_eq!(uses.at(EdgeId(0)), [1]);
        assert_eq!(uses.at(EdgeId(1)), [3]);
        assert_eq!(uses.at(EdgeId(2)), [0, 2, 4]);
        assert_eq!(uses.count(EdgeId(2)), 3);
    }
}
