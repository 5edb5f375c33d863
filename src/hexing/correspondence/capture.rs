//! Stops and paths for all curves that can have them: place, route, place again where that failed, and give up what
//! still fails.

use std::collections::BTreeMap;

use super::CORRESPONDENCE;
use super::boundary::{Boundary, NONE};
use super::corridor::{Corridor, corridors};
use super::network::Network;
use super::place::{Candidates, Penalties, Placement, Placer};
use super::reduction::Reason;
use super::route::{Router, Routes};
use super::stops::{Leg, Stop, stops_and_legs};
use crate::mesh::topology::Sets;
use crate::solid::CurveId;
use crate::{Cancelled, Monitor};

/// How often stops are placed before a curve is given up.
const PLACEMENTS: usize = 5;

/// What a node, and an edge, of a stop costs more where a leg that left there failed.
const BAD_NODE: f64 = 0.25;
const BAD_SPOKE: f64 = 0.5;

/// A curve that fails is contracted if it is shorter than this many edges, else suppressed.
const SHORT: f64 = 1.6;

/// Where the stops are, and a path for each leg.
pub(super) struct Capture {
    pub stops: Vec<Stop>,
    pub legs: Vec<Leg>,
    pub placement: Placement,
    pub paths: Vec<Vec<u32>>,
}

/// The paths that are kept from one try to the next, by curve and number along it.
type Known = BTreeMap<(CurveId, u32), Vec<u32>>;

/// One try.
struct Try {
    placement: Placement,
    routes: Routes,
    penalties: Penalties,
}

/// Captures what can be, and gives up the rest in `network`.
pub(super) fn capture(
    boundary: &Boundary,
    network: &mut Network,
    monitor: &dyn Monitor,
) -> Result<Capture, Cancelled> {
    let curves: Vec<CurveId> = network.curves().collect();
    let corridors = corridors(boundary, network, &curves, monitor)?;
    let corridor_of = |curve: CurveId| &corridors[curves.binary_search(&curve).expect("legs are of these")];
    let mut penalties = Penalties::default();
    let (mut known, mut candidates) = (Known::new(), Candidates::new());
    let mut round = 0;
    loop {
        round += 1;
        // Most of it is done in the first rounds.
        monitor.checkpoint(CORRESPONDENCE, 0.9 - 0.8 / f64::from(round))?;
        let (stops, legs) = stops_and_legs(network, |p| boundary.length_near(p));
        let of_legs: Vec<&Corridor> = legs.iter().map(|leg| corridor_of(leg.curve)).collect();
        let mut best: Option<Try> = None;
        for _ in 0..PLACEMENTS {
            monitor.proceed()?;
            let placer = Placer { boundary, network, stops: &stops, legs: &legs };
            let placement = placer.place(&penalties, &mut candidates);
            let router = Router::new(boundary, &legs, &of_legs, &placement);
            let routes = router.route(|leg| known.get(&(leg.curve, leg.place)).cloned(), monitor)?;
            known = good_paths(&legs, &routes);
            let tried = Try { placement, routes, penalties: penalties.clone() };
            penalise(&mut penalties, &stops, &legs, &tried);
            if best.as_ref().is_none_or(|best| failures(&tried.routes) < failures(&best.routes)) {
                best = Some(tried);
            }
            if best.as_ref().is_some_and(|best| best.routes.is_complete()) {
                break;
            }
        }
        let best = best.expect("there was a try");
        if best.routes.is_complete() {
            let Try { placement, routes, .. } = best;
            return Ok(Capture { stops, legs, placement, paths: routes.paths });
        }
        known = good_paths(&legs, &best.routes);
        candidates.retain(|&stop, _| !penalties.are_at(stop));
        penalties = best.penalties.clone();
        give_up(boundary, network, &legs, &best);
    }
}

/// How many legs have no path of their own.
fn failures(routes: &Routes) -> usize {
    failing(routes).len()
}

/// The legs that have no path, or share nodes; ascending.
fn failing(routes: &Routes) -> Vec<u32> {
    let shared = routes.shared.iter().flat_map(|(_, legs)| legs);
    let mut legs: Vec<u32> = routes.unreached.iter().chain(shared).copied().collect();
    legs.sort_unstable();
    legs.dedup();
    legs
}

fn good_paths(legs: &[Leg], routes: &Routes) -> Known {
    let mut known = Known::new();
    let failing = failing(routes);
    for (number, (leg, path)) in (0..).zip(legs.iter().zip(&routes.paths)) {
        if failing.binary_search(&number).is_err() {
            known.insert((leg.curve, leg.place), path.clone());
        }
    }
    known
}

/// Makes the nodes and edges where failing legs begin dearer.
fn penalise(penalties: &mut Penalties, stops: &[Stop], legs: &[Leg], tried: &Try) {
    for leg in failing(&tried.routes) {
        let Leg { stops: ends, arms, .. } = legs[leg as usize];
        for (stop, arm) in ends.into_iter().zip(arms) {
            let (key, node) = (stops[stop as usize].key, tried.placement.nodes[stop as usize]);
            if node == NONE {
                continue;
            }
            *penalties.nodes.entry((key, node)).or_insert(0.0) += BAD_NODE;
            if arm != NONE {
                let spoke = tried.placement.spokes[stop as usize][arm as usize];
                *penalties.spokes.entry((key, spoke)).or_insert(0.0) += BAD_SPOKE;
            }
        }
    }
}

/// Gives up one curve of each group of legs that get in each other's way, and each that has no path for itself.
fn give_up(boundary: &Boundary, network: &mut Network, legs: &[Leg], tried: &Try) {
    let is_placed = |stop: u32| tried.placement.nodes[stop as usize] != NONE;
    let mut chosen: Vec<(CurveId, Reason)> = Vec::new();
    for stop in (0..tried.placement.nodes.len() as u32).filter(|&stop| !is_placed(stop)) {
        let at_stop = legs.iter().filter(|leg| leg.stops.contains(&stop)).map(|leg| leg.curve);
        chosen.extend(least_missed(boundary, network, at_stop).map(|curve| (curve, Reason::NoNode)));
    }
    for &leg in &tried.routes.unreached {
        let Leg { curve, stops: ends, .. } = legs[leg as usize];
        if ends.into_iter().all(is_placed) {
            chosen.push((curve, Reason::NoPath));
        }
    }
    let mut groups = Sets::new(legs.len());
    for (_, together) in &tried.routes.shared {
        together.windows(2).for_each(|pair| {
            groups.join(pair[0], pair[1], false);
        });
    }
    let mut by_group: BTreeMap<u32, Vec<CurveId>> = BTreeMap::new();
    for leg in tried.routes.shared.iter().flat_map(|(_, together)| together) {
        by_group.entry(groups.root(*leg).0).or_default().push(legs[*leg as usize].curve);
    }
    for curves in by_group.into_values() {
        chosen.extend(least_missed(boundary, network, curves).map(|curve| (curve, Reason::NoPath)));
    }
    for (curve, reason) in chosen {
        if !network.is_kept(curve) {
            continue;
        }
        if is_short(boundary, network, curve) {
            network.contract(curve, reason);
        } else {
            network.suppress(curve, reason);
        }
    }
}

fn is_short(boundary: &Boundary, network: &Network, curve: CurveId) -> bool {
    network.length(curve) < SHORT * boundary.length_near(network.point_along(curve, 0.0))
}

/// The curve that is missed least: a short one, or else the one nearest to smooth, or else the shortest.
fn least_missed(
    boundary: &Boundary,
    network: &Network,
    curves: impl IntoIterator<Item = CurveId>,
) -> Option<CurveId> {
    let worth = |&curve: &CurveId| {
        let long = !is_short(boundary, network, curve);
        // Within ten degrees the length decides.
        let sharpness = if long { (network.sharpness(curve) / 10.0) as u64 } else { 0 };
        (long, sharpness, network.length(curve).to_bits(), curve)
    };
    curves.into_iter().min_by_key(worth)
}
