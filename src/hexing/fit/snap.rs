//! Puts nodes on their feet, where the cells around them bear it.

use super::holds::{Hold, Holds};
use crate::optimize::{Moved, Problem, Star, Weights, keep_positive, wake, worst_kept};
use crate::parallel;
use crate::{Cancelled, Monitor};

/// Nodes between two questions whether to stop.
const BATCH: usize = 4096;

/// Moves the nodes that are drawn to their feet if the least scaled Jacobian around stays above `least`, or as it is.
/// Those that get there are held from now on, and wake the nodes around. Returns how many.
pub(super) fn snap(
    problem: &mut Problem,
    holds: &mut Holds,
    least: f64,
    allowed: &[bool],
    awake: &mut Vec<bool>,
    monitor: &dyn Monitor,
) -> Result<usize, Cancelled> {
    let (_, snapped) = keep_positive(problem, awake, |problem, _| round(problem, holds, least, monitor))?;
    for &node in &snapped.nodes {
        holds.holds[problem.nodes[node as usize].index()] = Hold::Held;
        wake(problem, node, allowed, awake);
    }
    Ok(snapped.nodes.len())
}

fn round(
    problem: &mut Problem,
    holds: &Holds,
    least: f64,
    monitor: &dyn Monitor,
) -> Result<Moved, Cancelled> {
    let mut moved = Moved::default();
    for colour in 0..problem.colours.len() {
        let is_drawn = |&n: &u32| holds.is(problem.nodes[n as usize], Hold::Drawn);
        let nodes: Vec<u32> = problem.colours[colour].iter().copied().filter(is_drawn).collect();
        for batch in nodes.chunks(BATCH) {
            if monitor.cancelled() {
                return Err(Cancelled);
            }
            let feet = parallel::collect_with(batch.len(), Star::default, |star, k| {
                let node = batch[k];
                let (id, from) = (problem.nodes[node as usize], problem.points[node as usize]);
                let to = holds.target.foot(holds.anchors[id.index()], from)?.point;
                star.gather(problem, node, 0.0);
                let shape = Weights { doublings: 0, mu: 0.0 };
                let before = star.read(from, shape, f64::INFINITY)?.worst;
                let after = star.read(to, shape, f64::INFINITY)?.worst;
                let is_kept = after <= worst_kept(before, least) || to == from;
                (is_kept && star.stays_positive(to)).then_some(to)
            });
            for (&node, to) in batch.iter().zip(feet) {
                if let Some(to) = to {
                    problem.points[node as usize] = to;
                    moved.nodes.push(node);
                }
            }
        }
    }
    Ok(moved)
}
