//! Arcs by their length.

use glam::DVec2;

use super::graph::{Arc, Graph, turn};
use crate::geometry::{Aabb, Point};
use crate::hexing::extent::ROUNDED;

/// Segments of a closed arc, at least.
const LEAST_CLOSED: usize = 6;

/// Turn that one segment of an open arc may span, in degrees, unless the arc is short.
const MOST_TURN: f64 = 90.0;

/// An arc by its length.
pub(super) struct Course {
    pub(super) points: Vec<DVec2>,
    /// The length up to each point.
    along: Vec<f64>,
    pub(super) closed: bool,
    pub(super) outline: bool,
    /// Is it closed, and may start anywhere?
    pub(super) is_loose: bool,
}

impl Course {
    pub(super) fn new(graph: &Graph, arc: &Arc) -> Self {
        let points: Vec<DVec2> = arc.points.iter().map(|&p| graph.points[p as usize]).collect();
        let mut along = vec![0.0];
        for pair in points.windows(2) {
            along.push(along[along.len() - 1] + pair[0].distance(pair[1]));
        }
        Self { points, along, closed: arc.is_closed(), outline: arc.outline, is_loose: arc.is_loose }
    }

    pub(super) fn length(&self) -> f64 {
        self.along[self.along.len() - 1]
    }

    pub(super) fn bounds(&self) -> Aabb {
        Aabb::around(&self.points.iter().map(|p| Point::new(p.x, p.y, 0.0)).collect::<Vec<_>>())
    }

    /// How many segments it gets.
    pub(super) fn count(&self) -> usize {
        let count = |length: f64| (length + ROUNDED).round() as usize;
        if self.closed {
            return (2 * count(self.length() / 2.0)).max(LEAST_CLOSED);
        }
        let count = count(self.length()).max(1);
        let bent = (self.turns().map(|(turn, _)| turn).sum::<f64>() / MOST_TURN - 1e-3).ceil() as usize;
        if self.length() > 0.5 { count.max(bent) } else { count }
    }

    /// Where it turns between its ends: by how many degrees, and at which share of the length.
    pub(super) fn turns(&self) -> impl Iterator<Item = (f64, f64)> {
        let turns = self.points.windows(3).map(|p| turn(p[1] - p[0], p[2] - p[1]));
        turns.zip(&self.along[1..]).map(|(turn, along)| (turn, along / self.length()))
    }

    /// The point at `share` of the length.
    pub(super) fn at(&self, share: f64) -> DVec2 {
        let length = share * self.length();
        let k = self.along.partition_point(|&along| along <= length).clamp(1, self.along.len() - 1);
        let (before, after) = (self.along[k - 1], self.along[k]);
        let part = if after > before { (length - before) / (after - before) } else { 0.0 };
        self.points[k - 1].lerp(self.points[k], part)
    }

    /// The share of the length at which it is nearest to `p`.
    pub(super) fn nearest(&self, p: DVec2) -> f64 {
        let mut best = (f64::INFINITY, 0.0);
        for (pair, along) in self.points.windows(2).zip(self.along.windows(2)) {
            let way = pair[1] - pair[0];
            let part = ((p - pair[0]).dot(way) / way.length_squared()).clamp(0.0, 1.0);
            let distance = p.distance_squared(pair[0] + way * part);
            if distance < best.0 {
                best = (distance, along[0] + part * (along[1] - along[0]));
            }
        }
        best.1 / self.length()
    }
}
