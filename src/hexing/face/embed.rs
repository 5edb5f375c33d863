//! Lays curves into a graph one after another, so that they meet only in points of it.
//!
//! Curves that come from projections fall together, nearly, or cross under small angles. What lies within a tolerance of
//! the graph is taken to lie on it:
//!
//! 1. the curve is looked at in steps of half the tolerance, and each step's distance to the graph is measured;
//! 2. where it is farther than the tolerance for a while, that piece is added; it ends at points of the graph, or where
//!    the curve does;
//! 3. where it is close for a short while, it crosses or touches: the pieces before and after end in one point, the
//!    closest; where it is close for longer, it runs along the graph, and that part is dropped.
//!
//! So pieces are never closer to each other than the tolerance but at their ends, and no intersection is computed.
//! A curve that may come close to itself is laid in parts that turn by less than half a circle.
//!
//! Lengths are in units of 2h.

use std::collections::HashMap;

use glam::DVec2;

use super::graph::{Graph, Segment, turn};

/// Closer than this is the same, usually: 0.15 h.
pub(super) const TOLERANCE: f64 = 0.075;

/// A curve that is close to the graph for no longer than this, in units of the tolerance, crosses it, if under 30 degrees
/// and more.
const CROSSING: f64 = 4.2;

/// Pieces shorter than this, in units of the tolerance, are dropped.
const SHORTEST: f64 = 2.0;

/// Turn of a part of a curve, in degrees.
const PART: f64 = 170.0;

/// A graph that curves are laid into.
pub(super) struct Embedding {
    pub(super) graph: Graph,
    /// What is closer than this is the same.
    pub(super) tolerance: f64,
    /// Segments by the unit squares that they may be in.
    bins: HashMap<[i32; 2], Vec<u32>>,
}

/// A place on the graph close to a point.
#[derive(Clone, Copy)]
struct Close {
    segment: u32,
    at: DVec2,
    distance: f64,
}

/// A point of the graph where a curve comes to it or leaves it.
#[derive(Clone, Copy, PartialEq, Eq)]
struct Junction {
    node: u32,
    /// The curve crosses or touches the graph here, and does not run along it.
    is_crossing: bool,
}

/// A step along a curve.
struct Step {
    point: DVec2,
    /// How long the curve is up to here.
    along: f64,
    /// A point of the curve, not one between two.
    is_vertex: bool,
    close: Option<Close>,
}

impl Embedding {
    /// Begins with a graph whose segments cross nowhere.
    pub(super) fn new(graph: Graph, tolerance: f64) -> Self {
        let mut embedding = Self { graph, tolerance, bins: HashMap::new() };
        for s in 0..embedding.graph.segments.len() {
            embedding.note(s as u32);
        }
        embedding
    }

    /// Lays a curve; closed if the last point is the first. Points one after another that fall together count once, and one
    /// alone is no curve. Returns whether something of it was new.
    pub(super) fn lay(&mut self, curve: &[DVec2]) -> bool {
        // Between a point and itself no turn would be seen.
        let mut curve = curve.to_vec();
        curve.dedup();
        if curve.len() < 2 {
            return false;
        }
        let mut new = false;
        let mut first = 0;
        let mut turned = 0.0;
        for k in 1..curve.len() - 1 {
            turned += turn(curve[k] - curve[k - 1], curve[k + 1] - curve[k]);
            if turned > PART {
                new |= self.lay_part(&curve[first..=k]);
                (first, turned) = (k, 0.0);
            }
        }
        self.lay_part(&curve[first..]) || new
    }

    /// Makes the point of the graph that is close to `point` a node, and one if there is none but a segment.
    /// False if there is nothing close.
    pub(super) fn keep(&mut self, point: DVec2) -> bool {
        let Some(close) = self.closest(point) else { return false };
        let node = self.node_at(point, close);
        self.graph.kept[node as usize] = true;
        true
    }

    fn lay_part(&mut self, part: &[DVec2]) -> bool {
        let steps = self.steps(part);
        let count = steps.len();
        let is_close = |k: usize| steps[k].close.is_some();
        let mut new = false;
        let mut k = 0;
        // The graph changes as pieces are laid, but what is close to it does not: pieces keep away from each other.
        let mut start: Option<Junction> = None;
        while k < count {
            let run = (k..count).take_while(|&i| is_close(i) == is_close(k)).count();
            let last = k + run - 1;
            if !is_close(k) {
                let next = (last + 1 < count).then(|| self.junctions(&steps, last + 1));
                let end = next.map(|[entry, _]| entry);
                new |= self.add_piece(&steps[k..=last], start, end);
            }
            if is_close(k) {
                start = Some(self.junctions(&steps, k)[1]);
            }
            k = last + 1;
        }
        new
    }

    /// The steps along a curve, and what is close to each.
    fn steps(&self, part: &[DVec2]) -> Vec<Step> {
        let mut steps = Vec::new();
        let mut along = 0.0;
        let mut add = |point: DVec2, along: f64, is_vertex: bool| {
            steps.push(Step { point, along, is_vertex, close: self.closest(point) });
        };
        add(part[0], 0.0, true);
        for pair in part.windows(2) {
            let length = pair[0].distance(pair[1]);
            let pieces = (length / (0.5 * self.tolerance)).ceil().max(1.0) as usize;
            for i in 1..=pieces {
                let share = i as f64 / pieces as f64;
                let point = if i == pieces { pair[1] } else { pair[0].lerp(pair[1], share) };
                add(point, along + share * length, i == pieces);
            }
            along += length;
        }
        steps
    }

    /// The points of the graph where a curve comes to it and leaves it again, in the run of close steps from `first` on.
    fn junctions(&mut self, steps: &[Step], first: usize) -> [Junction; 2] {
        let run = steps[first..].iter().take_while(|step| step.close.is_some()).count();
        let last = first + run - 1;
        let distance = |k: usize| steps[k].close.map_or(f64::INFINITY, |close| close.distance);
        let is_crossing = steps[last].along - steps[first].along <= CROSSING * self.tolerance;
        let ends = if is_crossing {
            let closest = (first..=last).min_by(|&a, &b| distance(a).total_cmp(&distance(b)));
            [closest.expect("a run has a step"); 2]
        } else {
            [first, last]
        };
        ends.map(|k| {
            // The segment may have been divided since.
            let close = self.closest(steps[k].point).or(steps[k].close);
            Junction { node: self.node_at(steps[k].point, close.expect("the step is close")), is_crossing }
        })
    }

    /// Adds a run of steps that keep away from the graph, between points of it or ends of its own.
    fn add_piece(&mut self, steps: &[Step], start: Option<Junction>, end: Option<Junction>) -> bool {
        let (first, last) = (&steps[0], &steps[steps.len() - 1]);
        if last.along - first.along < SHORTEST * self.tolerance
            && (start.is_some() || end.is_some())
            && start == end
        {
            return false;
        }
        let closed = start.is_none() && end.is_none() && first.point == last.point;
        let bends = |k: usize, from: Option<Junction>, towards: usize| {
            from.filter(|at| at.is_crossing).is_some_and(|at| {
                self.bends(self.graph.points[at.node as usize], steps[k].point, steps[towards].point)
            })
        };
        // Where the point of a crossing is beside the curve, the rest of the piece stays as it is.
        let (next, before) = (self.first_vertex(steps), self.last_vertex(steps));
        let last_step = steps.len() - 1;
        let is_inner = |k: usize| {
            steps[k].is_vertex
                || k == 0 && (start.is_none() || bends(0, start, next))
                || k == last_step && bends(last_step, end, before)
        };
        let mut inner: Vec<DVec2> =
            (0..steps.len()).filter(|&k| is_inner(k)).map(|k| steps[k].point).collect();
        if inner.is_empty() && start == end {
            return false;
        }
        if closed {
            inner.pop();
        }
        let mut nodes: Vec<u32> = start.iter().map(|at| at.node).collect();
        nodes.extend(inner.into_iter().map(|point| self.graph.add(point, false)));
        if closed {
            nodes.push(nodes[0]);
        }
        nodes.extend(end.iter().map(|at| at.node));
        if nodes.len() == 3 && nodes[0] == nodes[2] {
            return false;
        }
        // Ends that were moved to the graph may have drawn the piece across something smaller than the tolerance.
        if nodes.windows(2).any(|pair| self.meets([pair[0], pair[1]])) {
            return false;
        }
        for pair in nodes.windows(2) {
            self.graph.segments.push(Segment { ends: [pair[0], pair[1]], outline: false });
            self.note(self.graph.segments.len() as u32 - 1);
        }
        true
    }

    /// The first step after the start that is a point of the curve, or the last step.
    fn first_vertex(&self, steps: &[Step]) -> usize {
        (1..steps.len()).find(|&k| steps[k].is_vertex).unwrap_or(steps.len() - 1)
    }

    /// The last step before the end that is a point of the curve, or the first step.
    fn last_vertex(&self, steps: &[Step]) -> usize {
        (0..steps.len() - 1).rev().find(|&k| steps[k].is_vertex).unwrap_or(0)
    }

    /// Is `middle` notably beside the straight way from `from` to `to`?
    fn bends(&self, from: DVec2, middle: DVec2, to: DVec2) -> bool {
        let way = to - from;
        way.perp_dot(middle - from).abs() > 0.1 * self.tolerance * way.length()
    }

    /// Does a segment between two points of the graph cross another one, or fall together with it?
    fn meets(&self, ends: [u32; 2]) -> bool {
        let at = |n: u32| self.graph.points[n as usize];
        let [a, b] = ends.map(at);
        let across = |s: &u32| {
            let others = self.graph.segments[*s as usize].ends;
            let shared = ends.iter().filter(|end| others.contains(end)).count();
            shared == 2 || shared == 0 && cross([a, b], others.map(at))
        };
        let pieces = (a.distance(b) * 2.0).ceil().max(1.0) as usize;
        (0..=pieces).any(|k| self.near(a.lerp(b, k as f64 / pieces as f64)).iter().any(across))
    }

    /// The point of the graph at a place close to `point`: one that is there, or one that divides the segment.
    fn node_at(&mut self, point: DVec2, close: Close) -> u32 {
        let Segment { ends, outline } = self.graph.segments[close.segment as usize];
        let near = self.near(point).into_iter().flat_map(|s| self.graph.segments[s as usize].ends);
        let distance = |n: u32| self.graph.points[n as usize].distance(point);
        let nearest = near.min_by(|&a, &b| distance(a).total_cmp(&distance(b)).then(a.cmp(&b)));
        if let Some(node) = nearest.filter(|&n| distance(n) <= self.tolerance) {
            return node;
        }
        let node = self.graph.add(close.at, false);
        self.graph.segments[close.segment as usize].ends = [ends[0], node];
        self.graph.segments.push(Segment { ends: [node, ends[1]], outline });
        self.note(self.graph.segments.len() as u32 - 1);
        node
    }

    /// The closest place of the graph within the tolerance.
    fn closest(&self, point: DVec2) -> Option<Close> {
        let to = |&segment: &u32| {
            let [a, b] = self.graph.segments[segment as usize].ends.map(|n| self.graph.points[n as usize]);
            let square = (b - a).length_squared();
            let share = if square > 0.0 { ((point - a).dot(b - a) / square).clamp(0.0, 1.0) } else { 0.0 };
            let at = a.lerp(b, share);
            Close { segment, at, distance: at.distance(point) }
        };
        let close = self.near(point);
        let close = close.iter().map(to).filter(|close| close.distance <= self.tolerance);
        close.min_by(|a, b| a.distance.total_cmp(&b.distance).then(a.segment.cmp(&b.segment)))
    }

    /// Segments that may be close to `point`.
    fn near(&self, point: DVec2) -> Vec<u32> {
        let [x, y] = bin(point);
        let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [x + dx, y + dy]));
        around.filter_map(|b| self.bins.get(&b)).flatten().copied().collect()
    }

    /// Notes a segment in the squares that it may be in.
    fn note(&mut self, segment: u32) {
        let [a, b] = self.graph.segments[segment as usize].ends.map(|n| self.graph.points[n as usize]);
        let pieces = (a.distance(b) * 2.0).ceil().max(1.0) as usize;
        let mut last = None;
        for k in 0..=pieces {
            let here = bin(a.lerp(b, k as f64 / pieces as f64));
            if last != Some(here) {
                self.bins.entry(here).or_default().push(segment);
                last = Some(here);
            }
        }
    }
}

/// Do two segments cross or touch, or overlap on one line?
fn cross([a, b]: [DVec2; 2], [c, d]: [DVec2; 2]) -> bool {
    let sides = |p: DVec2, q: DVec2, [r, s]: [DVec2; 2]| (q - p).perp_dot(r - p) * (q - p).perp_dot(s - p);
    let (of_others, of_these) = (sides(a, b, [c, d]), sides(c, d, [a, b]));
    if of_others == 0.0 && of_these == 0.0 {
        let along = |p: DVec2| (p - a).dot(b - a);
        let (least, most) = (along(c).min(along(d)), along(c).max(along(d)));
        return least < along(b) && most > 0.0;
    }
    of_others <= 0.0 && of_these <= 0.0
}

fn bin(p: DVec2) -> [i32; 2] {
    [p.x.floor() as i32, p.y.floor() as i32]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A circle seen from its side: it turns back at both ends, in a point and in two that fall together.
    #[test]
    fn a_curve_that_turns_back_is_laid_once() {
        let curve = [0.5, 0.0, 0.5, 1.0, 1.0, 0.5].map(|x| DVec2::new(x, 2.0 * x));
        let mut embedding = Embedding::new(Graph::default(), TOLERANCE);
        assert!(embedding.lay(&curve));
        let Graph { points, segments, .. } = embedding.graph;
        for (k, point) in points.iter().enumerate() {
            assert!(points[..k].iter().all(|other| other.distance(*point) > TOLERANCE), "{points:?}");
        }
        let length: f64 =
            segments.iter().map(|s| points[s.ends[0] as usize].distance(points[s.ends[1] as usize])).sum();
        assert!((length - 5f64.sqrt()).abs() < 1e-12, "{segments:?}");
    }

    #[test]
    fn a_curve_of_one_point_is_none() {
        let mut embedding = Embedding::new(Graph::default(), TOLERANCE);
        assert!(!embedding.lay(&[DVec2::ONE; 3]) && embedding.graph.points.is_empty());
    }
}
