//! Walks over the boundary around nodes that stay on one side of the curves.

use super::super::correspondence::{Anchor, Correspondence};
use super::boundary::{Boundary, BoundaryEdges};
use crate::mesh::NodeId;

/// The boundary and the curves on it.
pub(super) struct Sides<'a> {
    pub(super) boundary: &'a Boundary,
    on: &'a Correspondence,
    edges: BoundaryEdges,
}

impl<'a> Sides<'a> {
    pub(super) fn of(on: &'a Correspondence, boundary: &'a Boundary) -> Self {
        Self { boundary, on, edges: boundary.edges(|_| true) }
    }

    /// The quad, and those with it on one side of a smooth curve at a node where there are more than two.
    pub(super) fn crowded(&self, quad: u32) -> Vec<u32> {
        let nodes = self.boundary.quads[quad as usize];
        let on_curves = nodes.into_iter().filter(|n| matches!(self.on.anchors[n.index()], Anchor::Curve(_)));
        let crowds = on_curves.map(|n| self.around(quad, n)).filter(|quads| quads.len() > 2);
        crowds.flatten().chain([quad]).collect()
    }

    /// The quads at `node` that are reached from `quad` without crossing a curve, itself among them.
    pub(super) fn around(&self, quad: u32, node: NodeId) -> Vec<u32> {
        let mut reached = vec![quad];
        let mut next = 0;
        while next < reached.len() {
            for beside in self.neighbours(reached[next], node) {
                if self.on.curve_of(node, beside).is_none() {
                    let at_edge = self.edges.quads([node, beside]).unwrap_or([quad; 2]);
                    reached.extend(at_edge.into_iter().filter(|q| !reached.contains(q)).collect::<Vec<_>>());
                }
            }
            next += 1;
        }
        reached
    }

    /// The nodes before and after `node` in a quad.
    pub(super) fn neighbours(&self, quad: u32, node: NodeId) -> [NodeId; 2] {
        let nodes = self.boundary.quads[quad as usize];
        let k = nodes.iter().position(|&n| n == node).expect("quads around a node have it");
        [nodes[(k + 1) % 4], nodes[(k + 3) % 4]]
    }
}
