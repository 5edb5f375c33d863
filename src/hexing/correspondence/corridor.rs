//! What it costs a curve's path to run along the edges near it (paper 5.2.2, equations 5.8 to 5.11).
//!
//! Departures from the paper: the cost of an edge is `L/h (c + (1 - alpha) f_dir / 2 + f_loc + fold)`, where `f_dir`
//! is equation 5.9, `f_loc` is equation 5.10 with `d_max = h`, not weighted by `alpha`, so that nearness never counts
//! less than direction; the constant `c` keeps paths short, and `fold` compares the hexes around the edge with the
//! angle inside the solid along the curve: a curve of a convex right angle has one hex, a concave one three.

use super::boundary::{Boundary, NONE};
use super::network::Network;
use crate::geometry::Point;
use crate::parallel;
use crate::solid::{CurveFoot, CurveId};
use crate::{Cancelled, Monitor};

/// What 1 is in whole numbers: costs are exact.
pub(super) const UNIT: f64 = 65536.0;

/// How far from the curve its path is looked for, in local edge lengths (the paper's `3 l_e`).
const REACH: f64 = 3.0;

/// The cost of an edge that runs along the curve, in it.
const LENGTH: f64 = 0.08;

/// The weight of the direction.
const DIRECTION: f64 = 0.5;

/// The weight of a right angle more or less than the solid has.
const FOLD: f64 = 0.1;

/// An edge may not lead on along the curve by more than this many of its lengths: there two parts of the curve are
/// near each other, and the edge leads from one to the other.
const JUMP: f64 = 4.0;

/// The edges near a curve, and what they cost its path.
pub(super) struct Corridor {
    /// Boundary nodes within reach, ascending.
    nodes: Vec<u32>,
    /// Where the costs of each node's spokes start.
    first: Vec<u32>,
    costs: Vec<u32>,
}

/// The cost of an edge that leads out of reach.
const FORBIDDEN: u32 = u32::MAX;

impl Corridor {
    pub fn of(boundary: &Boundary, network: &Network, curve: CurveId) -> Self {
        let near = nodes_near(boundary, network, curve);
        let foot = |p: Point| network.solid.nearest_on_curve(curve, p);
        let feet = near.into_iter().map(|n| (n, foot(boundary.points[n as usize])));
        let within = |(n, foot): &(u32, CurveFoot)| foot.distance <= REACH * boundary.lengths[*n as usize];
        let (nodes, feet): (Vec<u32>, Vec<CurveFoot>) = feet.filter(within).unzip();
        let mut first = Vec::with_capacity(nodes.len());
        let mut costs = Vec::new();
        for &node in &nodes {
            first.push(costs.len() as u32);
            costs.resize(costs.len() + boundary.valence(node), FORBIDDEN);
        }
        let mut corridor = Self { nodes, first, costs };
        let edge = Edge { boundary, network, curve };
        for at in 0..corridor.nodes.len() {
            let node = corridor.nodes[at];
            for (k, spoke) in boundary.spokes_of(node).iter().enumerate() {
                let Ok(other) = corridor.nodes.binary_search(&spoke.to) else { continue };
                if other < at || spoke.twin == NONE {
                    continue;
                }
                let s = boundary.first_spoke(node) + k as u32;
                let cost = edge.cost(s, [feet[at], feet[other]], foot);
                corridor.costs[corridor.first[at] as usize + k] = cost;
                let back = spoke.twin - boundary.first_spoke(spoke.to);
                corridor.costs[(corridor.first[other] + back) as usize] = cost;
            }
        }
        corridor
    }

    /// The cost of a spoke; `None` if it is not within reach.
    pub fn cost(&self, boundary: &Boundary, spoke: u32) -> Option<u64> {
        let node = boundary.spokes[spoke as usize].from;
        self.costs_at(node).nth((spoke - boundary.first_spoke(node)) as usize)?
    }

    /// The costs of a node's spokes, as [`cost`](Self::cost) tells them; none if the node is not within reach.
    pub fn costs_at(&self, node: u32) -> impl Iterator<Item = Option<u64>> + '_ {
        let costs = self.nodes.binary_search(&node).map_or(&[][..], |at| {
            let end = self.first.get(at + 1).map_or(self.costs.len(), |&next| next as usize);
            &self.costs[self.first[at] as usize..end]
        });
        costs.iter().map(|&cost| (cost != FORBIDDEN).then_some(u64::from(cost)))
    }
}

struct Edge<'a> {
    boundary: &'a Boundary,
    network: &'a Network<'a>,
    curve: CurveId,
}

impl Edge<'_> {
    fn cost(&self, spoke: u32, feet: [CurveFoot; 2], foot: impl Fn(Point) -> CurveFoot) -> u32 {
        let spoke = &self.boundary.spokes[spoke as usize];
        let ends = [spoke.from, spoke.to].map(|n| n as usize);
        let [a, b] = ends.map(|n| self.boundary.points[n]);
        let [from, to] = feet;
        let length = a.distance(b);
        if self.advance(from.at, to.at) > JUMP * length {
            return FORBIDDEN;
        }
        let h = 0.5 * (self.boundary.lengths[ends[0]] + self.boundary.lengths[ends[1]]);
        let middle = foot(a.midpoint(b));
        let distance = (from.distance + middle.distance + to.distance) / 3.0;
        let tangent = (from.tangent + middle.tangent + to.tangent).normalize_or_zero();
        let along = tangent.dot((b - a).normalize_or_zero());
        let alpha = (distance / (REACH * h)).min(1.0);
        let near = distance / h;
        let direction = DIRECTION * (1.0 - alpha) * (1.0 - along * along);
        let cost = length / h * (LENGTH + direction + near * near + FOLD * self.fold(spoke.hexes));
        (cost * UNIT).min(f64::from(FORBIDDEN - 1)) as u32
    }

    /// How far apart two places on the curve are, along it.
    fn advance(&self, from: f64, to: f64) -> f64 {
        let curve = &self.network.solid.curves()[self.curve.index()];
        let apart = (from - to).abs();
        if curve.ends.is_none() { apart.min(curve.length - apart) } else { apart }
    }

    fn fold(&self, hexes: u32) -> f64 {
        let inside = self.network.solid.curves()[self.curve.index()].interior_angle;
        (90.0 * f64::from(hexes) - inside).abs() / 90.0
    }
}

/// The corridors of some curves.
pub(super) fn corridors(
    boundary: &Boundary,
    network: &Network,
    curves: &[CurveId],
    monitor: &dyn Monitor,
) -> Result<Vec<Corridor>, Cancelled> {
    parallel::try_collect(curves.len(), monitor, |k| Corridor::of(boundary, network, curves[k]))
}

/// A superset of the nodes within reach of a curve, ascending.
fn nodes_near(boundary: &Boundary, network: &Network, curve: CurveId) -> Vec<u32> {
    let h = boundary.length_near(network.point_along(curve, 0.0));
    let mut nodes = Vec::new();
    for sample in network.samples(curve, h) {
        // Edges may grow by half from the curve to the end of the reach.
        let reach = 1.5 * REACH * boundary.length_near(sample);
        nodes.extend(boundary.within(sample, h + reach));
    }
    nodes.sort_unstable();
    nodes.dedup();
    nodes
}
