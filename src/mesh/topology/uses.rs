//! Which faces meet at an edge.

use crate::mesh::{EdgeId, Edges};

/// For each edge the corners that use it, in ascending order: one on the boundary, two inside a
/// manifold surface, more where sheets meet. Corner `k` walks its edge forwards if the mesh's corner
/// `k` equals `ends[0]` of the edge.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct EdgeUses {
    /// Where each edge's corners start in `corners`, and the end of the last.
    offsets: Vec<u32>,
    corners: Vec<u32>,
}

impl EdgeUses {
    /// Turns `edges.of_corner` around, by a counting sort.
    pub fn of(edges: &Edges) -> Self {
        let mut offsets = vec![0u32; edges.len() + 1];
        for e in &edges.of_corner {
            offsets[e.index()] += 1;
        }
        let mut end = 0;
        for count in &mut offsets {
            end += *count;
            *count = end;
        }
        let mut corners = vec![0u32; edges.of_corner.len()];
        for (k, e) in edges.of_corner.iter().enumerate().rev() {
            offsets[e.index()] -= 1;
            corners[offsets[e.index()] as usize] = u32::try_from(k).expect("more than 2^32 corners");
        }
        Self { offsets, corners }
    }

    /// The corners that use edge `e`.
    pub fn at(&self, e: EdgeId) -> &[u32] {
        &self.corners[self.offsets[e.index()] as usize..self.offsets[e.index() + 1] as usize]
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
