//! The nodes of cells of the second order that are no corners.

use crate::geometry::Point;
use crate::mesh::NodeId;

/// Nodes on edges, on faces and inside.
#[derive(Default)]
pub(super) struct MiddleNodes {
    /// For each node; empty if there are none.
    is_middle: Vec<bool>,
}

impl MiddleNodes {
    /// Notes `node`, one of `node_count`.
    pub fn note(&mut self, node: NodeId, node_count: usize) {
        self.is_middle.resize(node_count, false);
        self.is_middle[node.index()] = true;
    }

    /// The positions without these nodes; the hexes get the numbers of the others. A node that is the corner of a hex too
    /// stays.
    pub fn leave_out(mut self, mut positions: Vec<Point>, hexes: &mut [[NodeId; 8]]) -> Vec<Point> {
        if self.is_middle.is_empty() {
            return positions;
        }
        for corner in hexes.as_flattened() {
            self.is_middle[corner.index()] = false;
        }
        let mut left_out = 0;
        let new_ids: Vec<NodeId> = self
            .is_middle
            .iter()
            .enumerate()
            .map(|(node, &is_middle)| {
                left_out += usize::from(is_middle);
                NodeId::new(node + usize::from(is_middle) - left_out)
            })
            .collect();
        for corner in hexes.as_flattened_mut() {
            *corner = new_ids[corner.index()];
        }
        let mut is_middle = self.is_middle.into_iter();
        positions.retain(|_| !is_middle.next().unwrap_or(false));
        positions
    }
}
