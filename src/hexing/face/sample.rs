//! Nodes along arcs: about two edge lengths apart for the cells that are paired, and between them for those they are
//! split into.
//!
//! 1. Each arc gets `max(1, round(length / 2h))` segments; closed ones an even number, and at least 6.
//! 2. Both sides of a narrow strip get as many, across from each other (`strips`).
//! 3. Where segments of two arcs cross, or fall together, both arcs get twice as many. Arcs that cross nowhere are
//!    told apart in the end.
//!
//! Lengths here are in units of 2h.

use std::collections::HashMap;

use glam::DVec2;

use super::course::Course;
use super::graph::{Arc, Graph};
use super::mesher::{FaceError, SAMPLE};
use super::strips::Strips;
use super::triangulation::{Outcome, Triangulation};
use crate::{Cancelled, Monitor};

/// Times that segments are halved to tell arcs apart, and how many times as many nodes as at first they may get by that.
const HALVINGS: u32 = 10;
const MOST: usize = 16;

/// What is constrained: nodes on arcs.
#[derive(Clone, Debug, Default)]
pub(super) struct Samples {
    /// Where they are; the first `coarse` are those about 2h apart.
    pub(super) points: Vec<DVec2>,
    pub(super) coarse: usize,
    /// The coarse segments, and the node on the arc between their ends.
    pub(super) segments: Vec<SampledSegment>,
}

/// A segment of an arc between two samples.
#[derive(Clone, Copy, Debug)]
pub(super) struct SampledSegment {
    pub(super) ends: [u32; 2],
    pub(super) middle: u32,
    pub(super) outline: bool,
    arc: u32,
}

/// Why no nodes were placed.
#[derive(Debug)]
pub(super) enum SampleError {
    Cancelled(Cancelled),
    /// These arcs cannot be told apart from others by segments that are not much shorter than asked for.
    Crowded(Vec<usize>),
}

impl From<Cancelled> for SampleError {
    fn from(cancelled: Cancelled) -> Self {
        Self::Cancelled(cancelled)
    }
}

impl From<SampleError> for FaceError {
    fn from(error: SampleError) -> Self {
        match error {
            SampleError::Cancelled(cancelled) => Self::Cancelled(cancelled),
            SampleError::Crowded(_) => Self::TooClose,
        }
    }
}

/// Places nodes along all arcs, so that neither the coarse segments nor the fine ones cross; across from each other in strips
/// between all of them, or those of the outline alone.
pub(super) fn sample(
    graph: &Graph,
    arcs: &[Arc],
    all_strips: bool,
    monitor: &dyn Monitor,
) -> Result<Samples, SampleError> {
    monitor.checkpoint(SAMPLE, 0.0)?;
    let courses: Vec<Course> = arcs.iter().map(|arc| Course::new(graph, arc)).collect();
    let strips = Strips::between(&courses, all_strips);
    let mut counts = strips.counts();
    let most = MOST * counts.iter().sum::<usize>();
    let mut last = Vec::new();
    for _ in 0..HALVINGS {
        if counts.iter().sum::<usize>() > most {
            break;
        }
        let samples = place(graph, arcs, &strips, &counts);
        let crowded = crowded(&samples, arcs.len(), monitor)?;
        last = (0..arcs.len()).filter(|&arc| crowded[arc]).collect();
        if last.is_empty() {
            monitor.checkpoint(SAMPLE, 1.0)?;
            return Ok(samples);
        }
        let mut is_crowded = vec![false; arcs.len()];
        last.iter().for_each(|&arc| is_crowded[strips.strip[arc] as usize] = true);
        let crowded = counts.iter_mut().zip(&strips.strip).filter(|(_, strip)| is_crowded[**strip as usize]);
        crowded.for_each(|(count, _)| *count *= 2);
    }
    Err(SampleError::Crowded(last))
}

fn place(graph: &Graph, arcs: &[Arc], strips: &Strips, counts: &[usize]) -> Samples {
    let mut halves: Vec<Vec<DVec2>> = Vec::with_capacity(arcs.len());
    for (arc, &count) in counts.iter().enumerate() {
        let across = strips.across[arc].map(|earlier| halves[earlier].as_slice());
        halves.push(strips.halves(arc, count, across));
    }
    let mut samples = Samples::default();
    let mut at_node: HashMap<u32, u32> = HashMap::new();
    let add = |samples: &mut Samples, point| {
        samples.points.push(point);
        samples.points.len() as u32 - 1
    };
    for (a, arc) in arcs.iter().enumerate() {
        let n = counts[a];
        let mut ends = [arc.points[0], arc.points[arc.points.len() - 1]].map(|node| {
            let place = if arc.is_loose { halves[a][0] } else { graph.points[node as usize] };
            *at_node.entry(node).or_insert_with(|| add(&mut samples, place))
        });
        for k in 1..=n {
            let end = if k == n { ends[1] } else { add(&mut samples, halves[a][2 * k]) };
            let (outline, middle) = (arc.outline, 0);
            samples.segments.push(SampledSegment { ends: [ends[0], end], middle, outline, arc: a as u32 });
            ends[0] = end;
        }
    }
    samples.coarse = samples.points.len();
    let middles = halves.iter().flat_map(|halves| halves.iter().skip(1).step_by(2));
    for (k, &middle) in middles.enumerate() {
        samples.segments[k].middle = add(&mut samples, middle);
    }
    samples
}

/// For each arc, whether it crosses another one, coarsely or finely.
fn crowded(samples: &Samples, arcs: usize, monitor: &dyn Monitor) -> Result<Vec<bool>, Cancelled> {
    let mut crowded = vec![false; arcs];
    let coarse: Vec<_> = samples.segments.iter().map(|s| (s.ends, s.arc)).collect();
    meet(&samples.points[..samples.coarse], &coarse, &mut crowded, monitor)?;
    let halves = |s: &SampledSegment| [([s.ends[0], s.middle], s.arc), ([s.middle, s.ends[1]], s.arc)];
    let fine: Vec<_> = samples.segments.iter().flat_map(halves).collect();
    meet(&samples.points, &fine, &mut crowded, monitor)?;
    Ok(crowded)
}

/// Marks the owners of segments that cross, touch or fall together.
fn meet(
    points: &[DVec2],
    segments: &[([u32; 2], u32)],
    crowded: &mut [bool],
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    let mut triangulation = Triangulation::new();
    let mut ids = Vec::with_capacity(points.len());
    for &point in points {
        ids.push(triangulation.insert(point, monitor)?);
    }
    let segments: Vec<_> =
        segments.iter().map(|&(ends, owner)| (ends.map(|e| ids[e as usize]), owner)).collect();
    let mut owner_at = vec![0; points.len()];
    for &(ends, owner) in &segments {
        ends.iter().for_each(|&end| owner_at[end as usize] = owner);
    }
    let mut owner_of: HashMap<[u32; 2], u32> = HashMap::new();
    for &([a, b], owner) in &segments {
        let sorted = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
        let other = match triangulation.constrain([a, b], monitor)? {
            Outcome::Added => {
                owner_of.insert(sorted([a, b]), owner);
                continue;
            }
            Outcome::Degenerate => owner,
            Outcome::Touches(node) => owner_at[node as usize],
            Outcome::Exists => owner_of[&sorted([a, b])],
            Outcome::Crosses(edge) => owner_of[&sorted(edge)],
        };
        crowded[owner as usize] = true;
        crowded[other as usize] = true;
    }
    Ok(())
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::graph::Segment;
    use super::*;
    use crate::Silent;

    /// Samples of a ring and nearly all of another one around the same point, so far from each other: 18 coarse segments each at
    /// first, if they are near. An open curve and a closed one are no strip.
    fn rings(apart: f64) -> Result<Samples, SampleError> {
        const POINTS: u32 = 4000;
        let mut graph = Graph::default();
        for (radius, from, pieces) in [(3.0, 0.0, POINTS), (3.0 + apart, 0.1, POINTS - 1)] {
            let first = graph.points.len() as u32;
            for k in 0..POINTS {
                let (y, x) = libm::sincos(from + std::f64::consts::TAU * f64::from(k) / f64::from(POINTS));
                graph.add(DVec2::new(x, y) * radius, false);
                let ends = [first + k, first + (k + 1) % POINTS];
                if k < pieces {
                    graph.segments.push(Segment { ends, outline: true });
                }
            }
        }
        sample(&graph, &graph.arcs(), true, &Silent)
    }

    /// Without a limit the nearer ones would be told apart too, with more than a thousand segments each.
    #[test]
    fn curves_are_told_apart_by_sixteen_times_as_many_segments_at_most() {
        assert_eq!(rings(0.5).unwrap().segments.len(), 18 + 22);
        let near = rings(1e-3).unwrap().segments.len();
        assert!((4 * 2 * 18..=MOST * 2 * 18).contains(&near), "{near}");
        assert!(matches!(rings(1e-5), Err(SampleError::Crowded(arcs)) if arcs == [0, 1]));
    }
}
