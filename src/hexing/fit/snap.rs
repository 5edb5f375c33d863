//! Puts nodes on their feet, where the cells around them bear it.

use super::holds::{Hold, Holds};
use crate::geometry::Point;
use crate::optimize::{Moved, Problem, Star, Weights, keep_positive, wake, worst_kept};
use crate::parallel;
use crate::{Cancelled, Monitor};

/// Nodes between two questions whether to stop.
const BATCH: usize = 4096;

/// Which nodes are put on their feet.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bearable {
    /// The least scaled Jacobian that may be left.
    pub(super) least: f64,
    /// Corners alone, curves too, or surfaces too.
    pub(super) freedom: usize,
}

/// Moves those of the `allowed` nodes that are drawn and have no more than so much `freedom` to their places or feet if the
/// least scaled Jacobian around stays above `least`, or as it is. Those that get there are held from now on, and wake the nodes around.
/// Returns how many.
pub(super) fn snap(
    problem: &mut Problem,
    holds: &mut Holds,
    Bearable { least, freedom }: Bearable,
    allowed: &[bool],
    awake: &mut Vec<bool>,
    monitor: &dyn Monitor,
) -> Result<usize, Cancelled> {
    let (_, snapped) = keep_positive(problem, awake, monitor, |problem, _| {
        round(problem, holds, Bearable { least, freedom }, allowed, monitor)
    })?;
    for &node in &snapped.nodes {
        holds.holds[problem.nodes[node as usize].index()] = Hold::Held;
    }
    wake(problem, &snapped.nodes, allowed, awake);
    Ok(snapped.nodes.len())
}

fn round(
    problem: &mut Problem,
    holds: &Holds,
    Bearable { least, freedom }: Bearable,
    allowed: &[bool],
    monitor: &dyn Monitor,
) -> Result<Moved, Cancelled> {
    let mut moved = Moved::default();
    for colour in 0..problem.colours.len() {
        let is_drawn = |&n: &u32| {
            let id = problem.nodes[n as usize];
            let is_free = holds.anchors[id.index()].freedom() <= freedom;
            allowed[n as usize] && is_free && holds.is(id, Hold::Drawn)
        };
        let nodes: Vec<u32> = problem.colours[colour].iter().copied().filter(is_drawn).collect();
        for batch in nodes.chunks(BATCH) {
            if monitor.cancelled() {
                return Err(Cancelled);
            }
            let feet = parallel::collect_with(batch.len(), Star::default, |star, k| {
                let node = batch[k];
                let (id, from) = (problem.nodes[node as usize], problem.points[node as usize]);
                let foot = || Some(holds.target.foot(holds.anchors[id.index()], from)?.point);
                star.gather(problem, node, 0.0);
                let shape = Weights { doublings: 0, mu: 0.0 };
                let before = star.read(from, shape, f64::INFINITY)?.worst;
                let mut is_kept = |to: &Point| {
                    let after = star.read(*to, shape, f64::INFINITY).map(|reading| reading.worst);
                    let keeps = |after| after <= worst_kept(before, least) || *to == from;
                    after.is_some_and(keeps) && star.stays_positive(*to)
                };
                holds.place(id).filter(&mut is_kept).or_else(|| foot().filter(&mut is_kept))
            });
            for (&node, to) in batch.iter().zip(feet) {
                if let Some(to) = to {
                    moved.take(problem, node, to);
                }
            }
        }
    }
    Ok(moved)
}
