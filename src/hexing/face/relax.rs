//! Fewer constraints: curves inside a principal face that would spoil its quads are given up (the paper's §4.1.2).
//!
//! 1. Arcs that end within the face without another one there, again and again; closed ones that are too short;
//! 2. at a node where two arcs part by less than 10 degrees, the shorter of those inside;
//! 3. at a node of 10 arcs and more, every other one of those inside, around the node, until there are fewer.
//! 4. of arcs that cannot be told apart by segments that are not much shorter than asked for, the shortest inside.
//!
//! The outline is never given up, but for holes that are too short to go around with cells.

use glam::DVec2;

use super::graph::{Arc, Graph, Segment, turn};

/// Arcs that part by less than this, in degrees, over-constrain their node. The paper has 5; the first piece of a curve
/// that leaves another one along it turns by half of what the next ones do.
const LEAST_ANGLE: f64 = 10.0;

/// So many arcs over-constrain their node.
const MOST_ARCS: usize = 10;

/// Closed curves shorter than this are given up: 2.5 h.
const LEAST_CLOSED: f64 = 1.25;

/// The way of an arc out of a node is that to the first point this far away: h / 2.
const AHEAD: f64 = 0.25;

/// Takes arcs away; returns how many.
pub(super) fn relax(graph: &mut Graph) -> usize {
    let mut given_up = 0;
    loop {
        let arcs = graph.arcs();
        let doomed = doomed(graph, &arcs);
        if doomed.is_empty() {
            return given_up;
        }
        given_up += doomed.len();
        give_up(graph, doomed.iter().map(|&a| &arcs[a]));
    }
}

/// Takes the shortest inner one of these arcs away, which cannot be told apart, and what is relaxed after that; returns how
/// many, or none if they all are of the outline.
pub(super) fn part(graph: &mut Graph, crowded: &[Arc]) -> usize {
    let inner = crowded.iter().filter(|arc| !arc.outline);
    let Some(shortest) = inner.min_by(|a, b| length(graph, a).total_cmp(&length(graph, b))) else { return 0 };
    give_up(graph, [shortest].into_iter());
    1 + relax(graph)
}

fn give_up<'a>(graph: &mut Graph, arcs: impl Iterator<Item = &'a Arc>) {
    let sorted = |a: u32, b: u32| [a.min(b), a.max(b)];
    let mut gone: Vec<[u32; 2]> =
        arcs.flat_map(|arc| arc.points.windows(2)).map(|pair| sorted(pair[0], pair[1])).collect();
    gone.sort_unstable();
    graph.segments.retain(|Segment { ends: [a, b], .. }| gone.binary_search(&sorted(*a, *b)).is_err());
}

fn length(graph: &Graph, arc: &Arc) -> f64 {
    let at = |p: u32| graph.points[p as usize];
    arc.points.windows(2).map(|pair| at(pair[0]).distance(at(pair[1]))).sum()
}

/// The arcs that go next, by the first rule that says so.
fn doomed(graph: &Graph, arcs: &[Arc]) -> Vec<usize> {
    let ends = ends(graph, arcs);
    let length = |arc: &Arc| length(graph, arc);
    let is_loose = |arc: &Arc| {
        let tips = [arc.points[0], arc.points[arc.points.len() - 1]];
        tips.iter().any(|&tip| ends[tip as usize].len() == 1)
    };
    let is_short = |arc: &Arc| {
        let alone = ends[arc.points[0] as usize].len() <= 2;
        arc.is_closed() && alone && length(arc) < LEAST_CLOSED
    };
    let simple: Vec<usize> =
        (0..arcs.len()).filter(|&a| is_short(&arcs[a]) || !arcs[a].outline && is_loose(&arcs[a])).collect();
    if !simple.is_empty() {
        return simple;
    }
    let narrow = ends.iter().find_map(|at| narrowest(at).and_then(|pair| shorter_inner(pair, arcs, length)));
    if let Some(arc) = narrow {
        return vec![arc];
    }
    let crowded = ends.iter().find(|at| at.len() >= MOST_ARCS);
    crowded.map_or_else(Vec::new, |at| {
        let inner: Vec<usize> = at.iter().map(|end| end.arc).filter(|&a| !arcs[a].outline).collect();
        let mut every_other: Vec<usize> =
            inner.into_iter().step_by(2).take(at.len() + 1 - MOST_ARCS).collect();
        every_other.sort_unstable();
        every_other.dedup();
        every_other
    })
}

/// An end of an arc at a node, and the way it goes out.
struct End {
    arc: usize,
    way: DVec2,
}

/// The ends of arcs at each node, counter-clockwise.
fn ends(graph: &Graph, arcs: &[Arc]) -> Vec<Vec<End>> {
    let mut ends: Vec<Vec<End>> = graph.points.iter().map(|_| Vec::new()).collect();
    for (arc, Arc { points, .. }) in arcs.iter().enumerate() {
        let at = |&p: &u32| graph.points[p as usize];
        let out = |from: DVec2, mut along: Box<dyn Iterator<Item = DVec2> + '_>, last: DVec2| {
            along.find(|p| p.distance(from) >= AHEAD).unwrap_or(last) - from
        };
        let (first, last) = (at(&points[0]), at(&points[points.len() - 1]));
        ends[points[0] as usize].push(End { arc, way: out(first, Box::new(points.iter().map(at)), last) });
        let back = points.iter().rev().map(at);
        ends[points[points.len() - 1] as usize].push(End { arc, way: out(last, Box::new(back), first) });
    }
    for at in &mut ends {
        at.sort_unstable_by(|a, b| angle(a.way).total_cmp(&angle(b.way)).then(a.arc.cmp(&b.arc)));
    }
    ends
}

fn angle(way: DVec2) -> f64 {
    libm::atan2(way.y, way.x)
}

/// The two neighbouring arcs that part by the least angle, if that is too small.
fn narrowest(at: &[End]) -> Option<[usize; 2]> {
    if at.len() < 3 {
        return None;
    }
    let pairs = (0..at.len()).map(|k| [&at[k], &at[(k + 1) % at.len()]]);
    let parting = pairs.map(|[a, b]| (turn(a.way, b.way), [a.arc, b.arc]));
    let narrow = parting.filter(|&(angle, [a, b])| angle < LEAST_ANGLE && a != b);
    narrow.min_by(|a, b| a.0.total_cmp(&b.0)).map(|(_, pair)| pair)
}

fn shorter_inner(pair: [usize; 2], arcs: &[Arc], length: impl Fn(&Arc) -> f64) -> Option<usize> {
    let inner = pair.into_iter().filter(|&a| !arcs[a].outline);
    inner.min_by(|&a, &b| length(&arcs[a]).total_cmp(&length(&arcs[b])))
}
