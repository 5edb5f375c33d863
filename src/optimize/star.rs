//! The cells around one node, gathered so that the node can be tried in many places.

use super::energy::{Corner, Expansion, Weights};
use super::problem::Problem;
use crate::geometry::Point;
use crate::mesh::numbering::hex::NEIGHBOURS;
use crate::mesh::quality::{Certainty, is_positive};

/// The corners and the cells that change when one node moves. Kept by each thread from node to node.
#[derive(Default)]
pub(super) struct Star {
    corners: Vec<Corner>,
    /// Cells that are positive and have to stay so, and the node's place in each.
    positive: Vec<([Point; 8], usize)>,
    /// The mean length of the node's edges.
    pub(super) size: f64,
}

impl Star {
    /// Looks at the cells around `node`; `eps` in units of each cell's volume.
    pub(super) fn gather(&mut self, problem: &Problem, node: u32, eps: f64) {
        self.corners.clear();
        self.positive.clear();
        let v = problem.points[node as usize];
        let (mut length, mut edges) = (0.0, 0);
        for &(cell, k) in problem.star(node) {
            let cell = cell as usize;
            let points = problem.corners(cell);
            let eps = eps * problem.volume[cell];
            let at = |corner: u8| points[usize::from(corner)];
            let ends = NEIGHBOURS[usize::from(k)].map(at);
            self.corners.push(Corner::at_node(ends, eps));
            for end in NEIGHBOURS[usize::from(k)] {
                let (origin, around) = (at(end), NEIGHBOURS[usize::from(end)]);
                let place = around.iter().position(|&n| n == k).expect("neighbours are mutual");
                let [b, c] = [1, 2].map(|turn| at(around[(place + turn) % 3]) - origin);
                self.corners.push(Corner::beside_node(origin, b, c, eps));
                length += origin.distance(v);
                edges += 1;
            }
            if problem.positive[cell] {
                self.positive.push((points, usize::from(k)));
            }
        }
        self.size = length / f64::from(edges.max(1));
    }

    pub(super) fn expand(&self, v: Point, weights: Weights) -> Expansion {
        let mut sum = Expansion::default();
        for corner in &self.corners {
            corner.expand(v, weights, &mut sum);
        }
        sum
    }

    /// The energy with the node at `v`, or infinity as soon as it is seen to be above `limit`.
    pub(super) fn energy(&self, v: Point, weights: Weights, limit: f64) -> f64 {
        let mut sum = 0.0;
        for corner in &self.corners {
            sum += corner.energy(v, weights);
            if sum > limit {
                return f64::INFINITY;
            }
        }
        sum
    }

    /// The least scaled Jacobian of the corners that change.
    pub(super) fn worst(&self, v: Point) -> f64 {
        self.corners.iter().map(|c| c.scaled_jacobian(v)).fold(f64::INFINITY, f64::min)
    }

    /// Do all cells that are positive stay so with the node at `v`?
    pub(super) fn stays_positive(&mut self, v: Point) -> bool {
        self.positive.iter_mut().all(|(points, k)| {
            points[*k] = v;
            is_positive(points) == Certainty::Positive
        })
    }
}
