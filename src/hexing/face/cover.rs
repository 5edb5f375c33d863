//! Which parts between projected curves the solid covers, and so which curves are the outline.

use std::collections::{BTreeSet, HashMap};

use glam::DVec2;

use super::graph::{Graph, Segment};
use super::shadow::Shadow;
use super::triangulation::{NONE, Outcome, Triangles, Triangulation};
use crate::{Cancelled, Monitor, parallel};

/// Marks the segments between what is covered and what is not as outline, and takes away those outside. Where curves leave
/// a gap there, it is closed. Returns the area that is covered, in units.
pub(super) fn cover(graph: &mut Graph, shadow: &Shadow, monitor: &dyn Monitor) -> Result<f64, Cancelled> {
    let mut triangulation = Triangulation::new();
    let ids = graph.points.iter().map(|&point| triangulation.insert(point, monitor));
    let ids = ids.collect::<Result<Vec<u32>, Cancelled>>()?;
    let mut kept = Vec::new();
    for segment in &graph.segments {
        let ends = segment.ends.map(|end| ids[end as usize]);
        // Curves cross nowhere but by rounding; then one of them goes.
        kept.push(triangulation.constrain(ends, monitor)? == Outcome::Added);
    }
    let mut points = vec![DVec2::ZERO; graph.points.len()];
    ids.iter().zip(&graph.points).for_each(|(&id, &point)| points[id as usize] = point);
    let triangles = triangulation.all_triangles();
    let covered = covered(&triangles, &points, shadow, monitor)?;

    let mut sides: HashMap<[u32; 2], i32> = HashMap::new();
    for (t, corners) in triangles.corners.iter().enumerate() {
        for k in 0..3 {
            let (a, b) = (corners[k], corners[(k + 1) % 3]);
            *sides.entry([a.min(b), a.max(b)]).or_insert(0) += i32::from(covered[t]);
        }
    }
    graph.segments = bounded(graph, &ids, &kept, &sides);
    let twice = |corners: &[u32; 3]| {
        let [a, b, c] = corners.map(|n| points[n as usize]);
        (b - a).perp_dot(c - a)
    };
    let areas = triangles.corners.iter().zip(&covered).filter(|(_, covered)| **covered);
    Ok(0.5 * areas.map(|(corners, _)| twice(corners)).sum::<f64>())
}

/// The segments with something covered beside them, and what closes the outline, by the number of covered triangles at
/// each edge.
fn bounded(graph: &Graph, ids: &[u32], kept: &[bool], sides: &HashMap<[u32; 2], i32>) -> Vec<Segment> {
    let sorted = |[a, b]: [u32; 2]| [a.min(b), a.max(b)];
    // Filled one by one, as in `correspondence::network`: a sort would be some kilobytes of the modules.
    let mut open = BTreeSet::new();
    open.extend(sides.iter().filter(|(_, covered)| **covered == 1).map(|(ends, _)| *ends));
    let mut segments = Vec::new();
    for (segment, _) in graph.segments.iter().zip(kept).filter(|(_, kept)| **kept) {
        let ends = sorted(segment.ends.map(|end| ids[end as usize]));
        if sides.get(&ends).is_some_and(|covered| *covered > 0) {
            segments.push(Segment { outline: open.remove(&ends), ..*segment });
        }
    }
    let mut point_of = vec![0; ids.len()];
    ids.iter().enumerate().rev().for_each(|(p, &id)| point_of[id as usize] = p as u32);
    let closing = open.into_iter().map(|ends| ends.map(|id| point_of[id as usize]));
    segments.extend(closing.map(|ends| Segment { ends, outline: true }));
    segments
}

/// Shares of a part's area from which it is taken to be covered, or not, as a whole.
const WHOLE: [f64; 2] = [0.02, 0.98];

/// For each triangle whether it is covered. A part between curves is, or is not, as a whole, unless it leaks through a
/// gap: then each of its triangles is by itself.
fn covered(
    triangles: &Triangles,
    points: &[DVec2],
    shadow: &Shadow,
    monitor: &dyn Monitor,
) -> Result<Vec<bool>, Cancelled> {
    let (part_of, parts) = parts(triangles);
    let area = |t: usize| {
        let [a, b, c] = triangles.corners[t].map(|n| points[n as usize]);
        (b - a).perp_dot(c - a)
    };
    let by_itself = parallel::try_collect(part_of.len(), monitor, |t| {
        shadow.covers(triangles.corners[t].map(|n| points[n as usize]).iter().sum::<DVec2>() / 3.0)
    })?;
    let (mut all, mut under) = (vec![0.0; parts], vec![0.0; parts]);
    for (t, &part) in part_of.iter().enumerate() {
        all[part] += area(t);
        under[part] += if by_itself[t] { area(t) } else { 0.0 };
    }
    let is_covered = |(t, &part): (usize, &usize)| match under[part] / all[part] {
        share if share >= WHOLE[1] => true,
        share if share <= WHOLE[0] => false,
        _ => by_itself[t],
    };
    Ok(part_of.iter().enumerate().map(is_covered).collect())
}

/// The part between constrained segments that each triangle is of, and how many there are.
fn parts(triangles: &Triangles) -> (Vec<usize>, usize) {
    let mut part_of = vec![usize::MAX; triangles.corners.len()];
    let mut parts = 0;
    for first in 0..part_of.len() {
        if part_of[first] != usize::MAX {
            continue;
        }
        let mut front = vec![first];
        part_of[first] = parts;
        while let Some(t) = front.pop() {
            for k in 0..3 {
                let other = triangles.beyond[t][k];
                if other != NONE && !triangles.constrained[t][k] && part_of[other as usize] == usize::MAX {
                    part_of[other as usize] = parts;
                    front.push(other as usize);
                }
            }
        }
        parts += 1;
    }
    (part_of, parts)
}
