//! Spreads the nodes of curves along these, so that they do not crowd at one foot and leave another stretch without any.
//!
//! The nodes of a curve are a path, from corner to corner or closed, whose order no foot knows of. Their places along the
//! curve are
//! 1. those of their feet, unwound on a closed curve;
//! 2. made monotone, by means of those that are out of order;
//! 3. smoothed between the nodes that are held: evenly over a few nodes, as the feet are over many.

use std::collections::BTreeMap;

use super::super::correspondence::{Anchor, Correspondence};
use super::holds::{Hold, Holds};
use crate::geometry::Point;
use crate::mesh::NodeId;
use crate::solid::{CurveId, SolidModel};

/// How much a node is drawn to its foot, in units of what draws it to the middle of its neighbours.
const TO_THE_FOOT: f64 = 0.2;

/// Rounds of smoothing.
const ROUNDS: usize = 12;

/// The nodes of a curve in the order of the path.
pub(super) struct Chain {
    curve: CurveId,
    /// In the curve's direction; in a closed chain the first is the last.
    nodes: Vec<NodeId>,
}

/// The paths of all curves.
pub(super) fn chains(
    on: &Correspondence,
    solid: Option<&SolidModel>,
    at: impl Fn(NodeId) -> Point,
) -> Vec<Chain> {
    let Some(solid) = solid else { return Vec::new() };
    let mut by_curve: BTreeMap<CurveId, Vec<[NodeId; 2]>> = BTreeMap::new();
    on.edges.iter().for_each(|&(ends, curve)| by_curve.entry(curve).or_default().push(ends));
    let of_curve = |(curve, edges): (CurveId, Vec<[NodeId; 2]>)| {
        let mut chain = Chain { curve, nodes: path(&edges, |n| on.anchors[n.index()])? };
        let feet: Vec<f64> = chain.nodes.iter().map(|&n| solid.nearest_on_curve(curve, at(n)).at).collect();
        let length = solid.curves()[curve.index()].length;
        let turn = if chain.is_closed() {
            *unwound(&feet, length).last()? - feet[0]
        } else {
            feet[feet.len() - 1] - feet[0]
        };
        if turn < 0.0 {
            chain.nodes.reverse();
        }
        Some(chain)
    };
    by_curve.into_iter().filter_map(of_curve).collect()
}

/// The nodes along the edges, from a corner if there is one; `None` if they are no path.
fn path(edges: &[[NodeId; 2]], anchor: impl Fn(NodeId) -> Anchor) -> Option<Vec<NodeId>> {
    let mut beside: BTreeMap<NodeId, Vec<NodeId>> = BTreeMap::new();
    for &[a, b] in edges {
        beside.entry(a).or_default().push(b);
        beside.entry(b).or_default().push(a);
    }
    let is_end = |n: &&NodeId| beside[n].len() == 1 || matches!(anchor(**n), Anchor::Corner(_));
    let first = *beside.keys().find(is_end).or(beside.keys().next())?;
    let mut nodes = vec![first, *beside[&first].first()?];
    while nodes.len() <= edges.len() {
        let [before, here] = [nodes[nodes.len() - 2], nodes[nodes.len() - 1]];
        nodes.push(*beside[&here].iter().find(|&&n| n != before)?);
    }
    Some(nodes)
}

impl Chain {
    fn is_closed(&self) -> bool {
        self.nodes.first() == self.nodes.last()
    }

    /// How far along the curve each node belongs; on a closed curve that may be beyond its length.
    fn places(&self, feet: &[f64], length: f64, is_held: impl Fn(NodeId) -> bool) -> Vec<f64> {
        let last = feet.len() - 1;
        let mut feet = if self.is_closed() { unwound(feet, length) } else { feet.to_vec() };
        let [start, end] = if self.is_closed() { [feet[0], feet[0] + length] } else { [0.0, length] };
        if self.is_closed() && (feet[last] - end).abs() > 0.5 * length {
            // They do not go round: only their number is believed.
            feet = (0..=last).map(|i| start + length * i as f64 / last as f64).collect();
        }
        (feet[0], feet[last]) = (start, end);
        feet.iter_mut().for_each(|foot| *foot = foot.clamp(start, end));
        monotone(&mut feet);
        let mut places = feet.clone();
        for _ in 0..ROUNDS {
            for i in 1..last {
                if !is_held(self.nodes[i]) {
                    places[i] = (places[i - 1] + places[i + 1] + TO_THE_FOOT * feet[i]) / (2.0 + TO_THE_FOOT);
                }
            }
        }
        places
    }
}

/// The feet of a closed curve, each less than half its length from the one before.
fn unwound(feet: &[f64], length: f64) -> Vec<f64> {
    let mut all = vec![feet[0]];
    for foot in &feet[1..] {
        let before = all[all.len() - 1];
        let turns = ((before - foot) / length).round();
        all.push(foot + turns * length);
    }
    all
}

/// The ascending values that are nearest to those given, in the sum of squares: those out of order become their mean.
fn monotone(values: &mut [f64]) {
    let mut blocks: Vec<(f64, usize)> = Vec::new();
    for &value in values.iter() {
        let (mut sum, mut count) = (value, 1);
        while let Some(&(before, size)) = blocks.last()
            && before * count as f64 > sum * size as f64
        {
            blocks.pop();
            (sum, count) = (sum + before, count + size);
        }
        blocks.push((sum, count));
    }
    let spread = blocks.into_iter().flat_map(|(sum, count)| std::iter::repeat_n(sum / count as f64, count));
    values.iter_mut().zip(spread).for_each(|(value, mean)| *value = mean);
}

/// Tells all nodes of curves that are drawn where they belong.
pub(super) fn spread(chains: &[Chain], holds: &mut Holds, at: impl Fn(NodeId) -> Point) {
    let Some(solid) = holds.target.solid() else { return };
    for chain in chains {
        let is_held = |n: NodeId| holds.is(n, Hold::Held);
        if chain.nodes.iter().all(|&n| is_held(n)) {
            continue;
        }
        let length = solid.curves()[chain.curve.index()].length;
        let feet: Vec<f64> =
            chain.nodes.iter().map(|&n| solid.nearest_on_curve(chain.curve, at(n)).at).collect();
        let places = chain.places(&feet, length, is_held);
        for (n, place) in chain.nodes.iter().zip(places) {
            if matches!(holds.anchors[n.index()], Anchor::Curve(_)) {
                let place = if place > length { place - length } else { place };
                holds.draw_to(*n, solid.point_on_curve(chain.curve, place));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn chain(nodes: &[u32]) -> Chain {
        Chain { curve: CurveId(0), nodes: nodes.iter().map(|&n| NodeId(n)).collect() }
    }

    #[test]
    fn values_out_of_order_become_their_mean() {
        let mut values = [0.0, 3.0, 2.0, 4.0, 5.0, 1.0, 0.0];
        monotone(&mut values);
        assert_eq!(values, [0.0, 2.5, 2.5, 2.5, 2.5, 2.5, 2.5]);
        let mut values = [1.0, 3.0, 2.0, 4.0];
        monotone(&mut values);
        assert_eq!(values, [1.0, 2.5, 2.5, 4.0]);
    }

    /// Feet in a crowd, some in the wrong order: places ascend, all apart, and nodes that are held stay.
    #[test]
    fn crowded_nodes_are_spread() {
        let feet = [0.0, 0.2, 0.1, 0.2, 0.2, 6.0, 9.9, 10.0];
        let nodes = [4, 7, 1, 9, 3, 2, 8, 0];
        let places = chain(&nodes).places(&feet, 10.0, |n| n == NodeId(2));
        assert_eq!([places[0], places[5], places[7]], [0.0, 6.0, 10.0]);
        assert!(places.windows(2).all(|pair| pair[1] - pair[0] > 0.4), "{places:?}");
    }

    #[test]
    fn nodes_go_once_round_a_closed_curve() {
        let ring = chain(&[0, 1, 2, 3, 4, 0]);
        for feet in [[9.0, 0.5, 2.5, 5.0, 7.0, 9.0], [9.0, 9.1, 9.2, 9.1, 9.0, 9.0]] {
            let places = ring.places(&feet, 10.0, |_| false);
            assert_eq!([places[0], places[5]], [9.0, 19.0]);
            assert!(places.windows(2).all(|pair| pair[1] - pair[0] > 1.0), "{places:?}");
        }
    }

    #[test]
    fn paths_start_at_corners() {
        let edges = |pairs: &[[u32; 2]]| pairs.iter().map(|p| p.map(NodeId)).collect::<Vec<_>>();
        let ids = |nodes: &[u32]| Some(nodes.iter().map(|&n| NodeId(n)).collect::<Vec<_>>());
        let on_curve = |_| Anchor::Curve(CurveId(0));
        assert_eq!(path(&edges(&[[1, 5], [2, 5], [2, 3]]), on_curve), ids(&[1, 5, 2, 3]));
        let closed = edges(&[[1, 5], [2, 5], [2, 3], [1, 3]]);
        assert_eq!(path(&closed, on_curve), ids(&[1, 5, 2, 3, 1]));
        let corner = |n| if n == NodeId(3) { Anchor::Corner(crate::solid::CornerId(0)) } else { on_curve(n) };
        assert_eq!(path(&closed, corner), ids(&[3, 2, 5, 1, 3]));
    }
}
