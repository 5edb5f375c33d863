//! Where paths begin and end, and the legs between.
//!
//! A stop is a corner, or a place on a closed curve that has no corner: three or four of them, for routing only. A leg
//! is what of a curve lies between two stops.

use std::f64::consts::TAU;

use super::network::Network;
use crate::geometry::Point;
use crate::solid::{CornerId, CurveId};

/// What a stop is. It keeps its key when others are given up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum StopKey {
    Corner(CornerId),
    /// A place on a closed curve, by its number there.
    Place(CurveId, u32),
}

pub(super) struct Stop {
    pub key: StopKey,
    pub point: Point,
    /// The outward unit normal; zero where none is known.
    pub normal: Point,
    /// In cyclic order; none at a place on a closed curve, whose legs may leave as they like.
    pub arms: Vec<StopArm>,
}

/// An end of a leg at a corner.
pub(super) struct StopArm {
    pub leg: u32,
    /// Where the leg leads, as a unit vector.
    pub direction: Point,
    /// The angle between it and the next arm in radians, as far away as the direction is looked up.
    pub sector: f64,
}

/// What of a curve lies between two stops.
#[derive(Clone, Copy, Debug)]
pub(super) struct Leg {
    pub curve: CurveId,
    /// Its number along the curve.
    pub place: u32,
    /// From start to end.
    pub stops: [u32; 2],
    /// The arm of either stop that it is; [`NONE`](super::boundary::NONE) at a place on a closed curve.
    pub arms: [u32; 2],
    pub length: f64,
}

/// Places on a closed curve: four, or three where they would be closer than this many edges.
const CLOSE: f64 = 2.0;

/// The stops and legs of all curves that are kept. An arm's direction is looked up about one edge away, as
/// `length_near` tells.
pub(super) fn stops_and_legs(network: &Network, length_near: impl Fn(Point) -> f64) -> (Vec<Stop>, Vec<Leg>) {
    let solid = network.solid;
    let mut stop_of = vec![0; solid.corners().len()];
    let mut stops = Vec::new();
    for corner in network.standing_corners() {
        stop_of[corner.index()] = stops.len() as u32;
        let (point, normal) =
            (network.point(corner), solid.normal_at(solid.corners()[corner.index()].vertex));
        stops.push(Stop { key: StopKey::Corner(corner), point, normal, arms: Vec::new() });
    }
    let mut legs = Vec::new();
    let mut leg_of = vec![0; solid.curves().len()];
    for curve in network.curves() {
        leg_of[curve.index()] = legs.len() as u32;
        let length = network.length(curve);
        match network.ends(curve) {
            Some(ends) => {
                let ends = ends.map(|end| stop_of[end.index()]);
                legs.push(Leg { curve, place: 0, stops: ends, arms: [super::boundary::NONE; 2], length });
            }
            None => close(network, curve, &length_near, &mut stops, &mut legs),
        }
    }
    for stop in &mut stops {
        let StopKey::Corner(corner) = stop.key else { continue };
        let at = stop.point;
        let reach = length_near(at);
        for (place, arm) in (0..).zip(network.arms(corner)) {
            let leg = leg_of[arm.curve.index()];
            legs[leg as usize].arms[usize::from(!arm.at_start)] = place;
            let along = reach.min(0.5 * solid.curves()[arm.curve.index()].length);
            let direction = direction(network, arm.curve, arm.at_start, along, at);
            stop.arms.push(StopArm { leg, direction, sector: arm.sector });
        }
        let directions: Vec<Point> = stop.arms.iter().map(|arm| arm.direction).collect();
        for (k, arm) in stop.arms.iter_mut().enumerate() {
            arm.sector = sector(directions[k], directions[(k + 1) % directions.len()], arm.sector);
        }
    }
    (stops, legs)
}

/// Adds the places on a closed curve and the legs between them.
fn close(
    network: &Network,
    curve: CurveId,
    length_near: impl Fn(Point) -> f64,
    stops: &mut Vec<Stop>,
    legs: &mut Vec<Leg>,
) {
    let length = network.length(curve);
    let h = length_near(network.point_along(curve, 0.0));
    let count: u32 = if length < 4.0 * CLOSE * h { 3 } else { 4 };
    let (first, share) = (stops.len() as u32, length / f64::from(count));
    let normal = network.normals_along(curve);
    for place in 0..count {
        let point = network.point_along(curve, share * f64::from(place));
        let key = StopKey::Place(curve, place);
        let normal = normal(share * f64::from(place));
        stops.push(Stop { key, point, normal, arms: Vec::new() });
        let ends = [first + place, first + (place + 1) % count];
        legs.push(Leg { curve, place, stops: ends, arms: [super::boundary::NONE; 2], length: share });
    }
}

/// The angle from one direction to another: the lesser one, or what it lacks to a whole turn if that is nearer to the angle
/// `at` the corner.
fn sector(from: Point, to: Point, at: f64) -> f64 {
    let lesser = libm::atan2(from.cross(to).length(), from.dot(to));
    if (TAU - lesser - at).abs() < (lesser - at).abs() { TAU - lesser } else { lesser }
}

/// Where a curve leads from the corner `at` that stands at one of its ends. For one whose own corner was joined to
/// another, from that other.
fn direction(network: &Network, curve: CurveId, at_start: bool, along: f64, at: Point) -> Point {
    let whole = network.solid.curves()[curve.index()].length;
    let ahead = network.point_along(curve, if at_start { along } else { whole - along });
    let direction = (ahead - at).normalize_or_zero();
    if direction != Point::ZERO {
        return direction;
    }
    (network.point_along(curve, 0.5 * whole) - at).normalize_or_zero()
}

#[cfg(test)]
mod tests {
    use std::f64::consts::{FRAC_PI_2, PI};

    use super::*;

    #[test]
    fn a_sector_is_the_lesser_or_the_greater_angle_as_at_the_corner() {
        let (from, to) = (Point::X, Point::Y);
        for (at, expected) in
            [(1.2, FRAC_PI_2), (3.0, FRAC_PI_2), (3.3, 3.0 * FRAC_PI_2), (5.0, 3.0 * FRAC_PI_2)]
        {
            assert!((sector(from, to, at) - expected).abs() < 1e-12, "{at}");
        }
        assert!((sector(from, -from, 3.0) - PI).abs() < 1e-12);
        // The only arm of a corner has all around it.
        assert!((sector(from, from, 6.0) - TAU).abs() < 1e-12);
    }
}
