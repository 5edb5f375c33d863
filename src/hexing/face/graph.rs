//! Curves in the plane as a graph of straight segments, and the arcs between its nodes.

use glam::DVec2;

/// Turn between two segments, in degrees, from which the point between them is a corner: what is smoother is taken for
/// a curve. A regular polygon of up to eight sides keeps its corners.
const CORNER_TURN: f64 = 40.0;

/// A straight piece of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Segment {
    pub(super) ends: [u32; 2],
    /// Between the inside of the region and what is not of it.
    pub(super) outline: bool,
}

/// Points and the segments between them, which cross nowhere.
#[derive(Clone, Debug, Default)]
pub(super) struct Graph {
    pub(super) points: Vec<DVec2>,
    pub(super) segments: Vec<Segment>,
    /// Points that must become nodes of the mesh.
    pub(super) kept: Vec<bool>,
}

/// A curve without corners between two nodes of the graph.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Arc {
    /// The points along it; the first again at the end if it is closed.
    pub(super) points: Vec<u32>,
    pub(super) outline: bool,
    /// Is it closed, and no node on it? Then it may as well start elsewhere.
    pub(super) is_loose: bool,
}

impl Arc {
    pub(super) fn is_closed(&self) -> bool {
        self.points.first() == self.points.last()
    }
}

impl Graph {
    /// Adds a point.
    pub(super) fn add(&mut self, point: DVec2, kept: bool) -> u32 {
        self.points.push(point);
        self.kept.push(kept);
        u32::try_from(self.points.len() - 1).expect("fewer than 2^32 points")
    }

    /// The segments at each point, as places in `segments`.
    pub(super) fn stars(&self) -> Vec<Vec<u32>> {
        let mut stars = vec![Vec::new(); self.points.len()];
        for (s, segment) in self.segments.iter().enumerate() {
            for end in segment.ends {
                stars[end as usize].push(s as u32);
            }
        }
        stars
    }

    /// The arcs, each once, in order of their first segments; closed ones without a node last.
    pub(super) fn arcs(&self) -> Vec<Arc> {
        let stars = self.stars();
        let nodes: Vec<bool> = (0..self.points.len()).map(|p| self.is_node(p, &stars[p])).collect();
        let mut walked = vec![false; self.segments.len()];
        let mut arcs = Vec::new();
        for p in (0..self.points.len()).filter(|&p| nodes[p]) {
            for &s in &stars[p] {
                if !walked[s as usize] {
                    arcs.push(self.walk(p as u32, s, &nodes, &stars, &mut walked));
                }
            }
        }
        for s in 0..self.segments.len() {
            if !walked[s] {
                arcs.push(self.walk(self.segments[s].ends[0], s as u32, &nodes, &stars, &mut walked));
            }
        }
        arcs
    }

    /// From `start` along `segment` to the next node, or around to the start.
    fn walk(&self, start: u32, segment: u32, nodes: &[bool], stars: &[Vec<u32>], walked: &mut [bool]) -> Arc {
        let outline = self.segments[segment as usize].outline;
        let (mut points, mut at, mut s) = (vec![start], start, segment);
        loop {
            walked[s as usize] = true;
            let [a, b] = self.segments[s as usize].ends;
            at = if a == at { b } else { a };
            points.push(at);
            if nodes[at as usize] || at == start {
                return Arc { points, outline, is_loose: !nodes[at as usize] };
            }
            let star = &stars[at as usize];
            s = if star[0] == s { star[1] } else { star[0] };
        }
    }

    fn is_node(&self, p: usize, star: &[u32]) -> bool {
        let [a, b] = star else { return !star.is_empty() };
        let [a, b] = [a, b].map(|&s| self.segments[s as usize]);
        self.kept[p] || a.outline != b.outline || self.turn(p, a, b) > CORNER_TURN
    }

    /// How much the way from one segment to the other turns at `p`, in degrees from 0 to 180.
    fn turn(&self, p: usize, a: Segment, b: Segment) -> f64 {
        let towards = |s: Segment| {
            let other = if s.ends[0] as usize == p { s.ends[1] } else { s.ends[0] };
            self.points[other as usize] - self.points[p]
        };
        turn(-towards(a), towards(b))
    }
}

/// The angle between two directions, in degrees from 0 to 180.
pub(super) fn turn(a: DVec2, b: DVec2) -> f64 {
    libm::atan2(a.perp_dot(b).abs(), a.dot(b)).to_degrees()
}
