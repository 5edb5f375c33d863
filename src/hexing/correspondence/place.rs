//! Which nodes stand for the stops, and along which edges the legs leave them.
//!
//! 1. Each stop looks at boundary nodes near it: how near, how well its arms fit the edges there in their cyclic order,
//!    how well the quads between fill the angles between arms, and the surface's normal (paper 5.2.1 scores by the Jacobian
//!    after moving the node; this needs no move).
//! 2. Stops that want the same node share out the nodes near them at the least cost.
//! 3. With all nodes known the arms are chosen once more: none may lead to another stop's node, but for the leg
//!    between the two where that is about an edge long, and two legs of different curves had better not begin with
//!    the same node.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

use super::arms::assign_arms;
use super::boundary::{Boundary, NONE};
use super::network::Network;
use super::stops::{Leg, Stop, StopKey};
use crate::graph::{Choice, cheapest_assignment};
use crate::parallel;
use crate::solid::CurveId;

/// How far from the stop nodes are looked at, in local edge lengths.
const REACH: f64 = 2.5;

/// How many nodes are looked at, and how many are kept.
const NEAREST: usize = 28;
const KEPT: usize = 8;

/// Weights of the arms' directions, of edges that the corner has no use for, and of the normal. The square of the
/// distance over the edge length has weight 1.
const ARMS: f64 = 1.2;
const SPARE: f64 = 0.1;
const NORMAL: f64 = 0.4;

/// Weight of the angle inside the solid along an arm, against its direction.
const FOLD: f64 = 0.15;

/// Weight of what quads lack that share the angle between two arms. None at a cusp, where arms leave at a less angle than this,
/// in degrees: no number of quads is right there.
const SECTOR: f64 = 1.0;
const CUSP: f64 = 25.0;

/// A leg shorter than this many edges runs along the edge between two stops' nodes, if there is one.
const DIRECT: f64 = 1.8;

/// What it costs an arm to begin with a node that a leg of another curve begins with.
const SHARED: f64 = 0.5;

/// Where the stops are.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Placement {
    /// The node of each stop; [`NONE`] if there is none for it.
    pub nodes: Vec<u32>,
    /// The spoke of each arm of each stop.
    pub spokes: Vec<Vec<u32>>,
}

/// What routing has found to be bad, by stop: nodes, and spokes of its node.
#[derive(Clone, Debug, Default)]
pub(super) struct Penalties {
    pub nodes: BTreeMap<(StopKey, u32), f64>,
    pub spokes: BTreeMap<(StopKey, u32), f64>,
}

impl Penalties {
    pub fn are_at(&self, stop: StopKey) -> bool {
        let all = (stop, 0)..=(stop, NONE);
        self.nodes.range(all.clone()).next().is_some() || self.spokes.range(all).next().is_some()
    }
}

/// The nodes near stops with their scores, the best first; kept from one placement to the next, each with the curves
/// at the stop.
pub(super) type Candidates = BTreeMap<StopKey, (Vec<CurveId>, Vec<(f64, u32)>)>;

pub(super) struct Placer<'a> {
    pub boundary: &'a Boundary,
    pub network: &'a Network<'a>,
    pub stops: &'a [Stop],
    pub legs: &'a [Leg],
}

/// The value of an arm on a spoke, by arm and spoke of the node.
type Fit<'a> = dyn Fn(usize, usize) -> Option<f64> + 'a;

impl Placer<'_> {
    /// Places all stops. A stop that finds no node, or whose arms find no edges, has neither.
    pub fn place(&self, penalties: &Penalties, known: &mut Candidates) -> Placement {
        self.look_around(penalties, known);
        let whole = |score: f64| (score.max(0.0) * 1e6).min(4e9) as u64;
        let of_stop =
            |stop: &Stop| known[&stop.key].1.iter().map(|&(score, node)| (node, whole(score))).collect();
        let mut choices: Vec<Vec<Choice>> = self.stops.iter().map(of_stop).collect();
        // A node where the arms find no edges once the others are placed is tried no more.
        for _ in 0..KEPT {
            let nodes: Vec<u32> =
                cheapest_assignment(&choices).into_iter().map(|node| node.unwrap_or(NONE)).collect();
            let (spokes, stuck) = self.settle(&nodes, penalties);
            if stuck.is_empty() {
                return Placement { nodes, spokes };
            }
            for stop in stuck {
                choices[stop as usize].retain(|&(node, _)| node != nodes[stop as usize]);
            }
        }
        let nodes: Vec<u32> =
            cheapest_assignment(&choices).into_iter().map(|node| node.unwrap_or(NONE)).collect();
        let (spokes, stuck) = self.settle(&nodes, penalties);
        let mut placement = Placement { nodes, spokes };
        for stop in stuck {
            placement.nodes[stop as usize] = NONE;
        }
        placement
    }

    /// Scores the nodes near stops that are new, have lost a curve, or are penalised.
    fn look_around(&self, penalties: &Penalties, known: &mut Candidates) {
        let curves = |stop: &Stop| -> Vec<CurveId> {
            stop.arms.iter().map(|arm| self.legs[arm.leg as usize].curve).collect()
        };
        let is_old = |stop: &Stop| known.get(&stop.key).is_none_or(|(before, _)| *before != curves(stop));
        let stale = (0..self.stops.len()).filter(|&s| {
            let stop = &self.stops[s];
            is_old(stop) || penalties.are_at(stop.key)
        });
        let stale: Vec<usize> = stale.collect();
        let scored = parallel::collect(stale.len(), |k| self.candidates(stale[k] as u32, penalties));
        for (s, candidates) in stale.into_iter().zip(scored) {
            known.insert(self.stops[s].key, (curves(&self.stops[s]), candidates));
        }
    }

    /// The nodes near a stop with their scores, the best first.
    fn candidates(&self, stop: u32, penalties: &Penalties) -> Vec<(f64, u32)> {
        let Stop { point, arms, .. } = &self.stops[stop as usize];
        let reach = REACH * self.boundary.length_near(*point);
        let mut near: Vec<(f64, u32)> = self
            .boundary
            .within(*point, reach)
            .into_iter()
            .map(|node| (self.boundary.points[node as usize].distance_squared(*point), node))
            .filter(|&(_, node)| self.boundary.valence(node) >= arms.len())
            .collect();
        parallel::put_least_first(&mut near);
        near.truncate(NEAREST);
        let scores = near.iter().filter_map(|&(_, node)| Some((self.score(stop, node, penalties)?, node)));
        let mut scored: Vec<(f64, u32)> = scores.collect();
        parallel::put_least_first(&mut scored);
        scored.truncate(KEPT);
        scored
    }

    fn score(&self, stop: u32, node: u32, penalties: &Penalties) -> Option<f64> {
        let Stop { key, point, normal, arms } = &self.stops[stop as usize];
        let (at, n) = (self.boundary.points[node as usize], self.boundary.normals[node as usize]);
        let away = at.distance(*point) / self.boundary.lengths[node as usize];
        let (fit, _) =
            self.fit(stop, node, &|arm, spoke| Some(self.value(stop, arm, node, spoke, penalties)))?;
        let misfit = if arms.is_empty() { 0.0 } else { ARMS * (1.0 - fit / arms.len() as f64) };
        let spare = (self.boundary.valence(node) as f64 - arms.len().max(3) as f64).abs();
        // Only of a mesh whose faces look the way the solid's do does that tell more of a place than its distance.
        let counts = self.boundary.looks_alike || !arms.is_empty();
        let tilt = if counts && normal.length_squared() > 0.0 { NORMAL * (1.0 - normal.dot(n)) } else { 0.0 };
        let penalty = penalties.nodes.get(&(*key, node)).copied().unwrap_or(0.0);
        Some(away * away + misfit + SPARE * spare + tilt + penalty)
    }

    /// The best edges at a node for the arms of a stop.
    fn fit(&self, stop: u32, node: u32, value: &Fit) -> Option<(f64, Vec<u32>)> {
        let arms = self.stops[stop as usize].arms.len();
        let sectors: Vec<f64> = self.stops[stop as usize].arms.iter().map(|arm| arm.sector).collect();
        let is_cusp = sectors.iter().any(|sector| sector.to_degrees() < CUSP);
        let between = |arm: usize, quads: usize| {
            if is_cusp { 0.0 } else { -SECTOR * lack(sectors[arm] / quads as f64) }
        };
        let (sum, places) = assign_arms(arms, self.boundary.valence(node), value, between)?;
        let first = self.boundary.first_spoke(node);
        Some((sum, places.into_iter().map(|k| first + k as u32).collect()))
    }

    /// How well an arm fits an edge: 1 if it fits exactly.
    fn value(&self, stop: u32, arm: usize, node: u32, spoke: usize, penalties: &Penalties) -> f64 {
        let number = self.boundary.first_spoke(node) + spoke as u32;
        let edge = &self.boundary.spokes[number as usize];
        let [from, to] = [edge.from, edge.to].map(|n| self.boundary.points[n as usize]);
        let Stop { key, arms, .. } = &self.stops[stop as usize];
        let arm = &arms[arm];
        let curve = self.legs[arm.leg as usize].curve;
        let inside = self.network.solid.curves()[curve.index()].interior_angle;
        let fold = (90.0 * f64::from(edge.hexes) - inside).abs() / 90.0;
        let penalty = penalties.spokes.get(&(*key, number)).copied().unwrap_or(0.0);
        (to - from).normalize_or_zero().dot(arm.direction) - FOLD * fold - penalty
    }

    /// The edges of all arms, where the stops have these nodes; and the stops whose arms find none.
    fn settle(&self, nodes: &[u32], penalties: &Penalties) -> (Vec<Vec<u32>>, Vec<u32>) {
        let mut stop_at = BTreeMap::new();
        for (stop, &node) in (0..).zip(nodes) {
            stop_at.insert(node, stop);
        }
        let mut direct = self.direct_legs(nodes);
        loop {
            let mut direct_legs: Vec<u32> = direct.values().copied().collect();
            direct_legs.sort_unstable();
            let mut begun: BTreeMap<u32, u32> = BTreeMap::new();
            let mut spokes = Vec::with_capacity(nodes.len());
            let mut stuck = Vec::new();
            for (stop, &node) in (0..).zip(nodes) {
                if node == NONE {
                    spokes.push(Vec::new());
                    continue;
                }
                let value = |arm: usize, spoke: usize| {
                    let to = self.boundary.spokes_of(node)[spoke].to;
                    let leg = self.stops[stop as usize].arms[arm].leg;
                    // Along the edge between their nodes runs that leg, and no other.
                    let runs = stop_at.get(&to).map(|&other| direct.get(&pair(stop, other)) == Some(&leg));
                    if runs == Some(false) || (runs.is_none() && direct_legs.binary_search(&leg).is_ok()) {
                        return None;
                    }
                    let shared = begun.get(&to).is_some_and(|&other| other != leg);
                    Some(self.value(stop, arm, node, spoke, penalties) - if shared { SHARED } else { 0.0 })
                };
                let Some((_, chosen)) = self.fit(stop, node, &value) else {
                    stuck.push(stop);
                    spokes.push(Vec::new());
                    continue;
                };
                for (arm, &spoke) in self.stops[stop as usize].arms.iter().zip(&chosen) {
                    begun.insert(self.boundary.spokes[spoke as usize].to, arm.leg);
                }
                spokes.push(chosen);
            }
            // Where an edge between stops leaves no room for the other arms, its leg goes around.
            let before = direct.len();
            direct.retain(|stops, _| !stops.iter().any(|stop| stuck.contains(stop)));
            if stuck.is_empty() || direct.len() == before {
                return (spokes, stuck);
            }
        }
    }

    /// The short legs between stops whose nodes an edge joins, by their stops.
    fn direct_legs(&self, nodes: &[u32]) -> BTreeMap<[u32; 2], u32> {
        let mut direct: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        for (number, leg) in (0..).zip(self.legs) {
            let [a, b] = leg.stops;
            let ends = [a, b].map(|s| nodes[s as usize]);
            if a == b || ends.contains(&NONE) || self.boundary.spoke_between(ends[0], ends[1]).is_none() {
                continue;
            }
            if leg.length > DIRECT * self.boundary.lengths[ends[0] as usize] {
                continue;
            }
            let known = direct.entry(pair(a, b)).or_insert(number);
            if leg.length < self.legs[*known as usize].length {
                *known = number;
            }
        }
        direct
    }
}

/// What a quad lacks with such an angle, in radians: 0 at a right angle, and most from three of them on.
fn lack(angle: f64) -> f64 {
    1.0 - libm::sin(angle.min(3.0 * FRAC_PI_2))
}

/// Two stops, the lesser first.
fn pair(a: u32, b: u32) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
