//! Draws the boundary to the solid, ever more strongly, while no cell is turned over or made bad.
//!
//! 1. A sweep over corners, then curves, surfaces and the inside lowers the shape energy and that of the pull, which
//!    grows from sweep to sweep. Steps that turn a cell over or make one worse than [`FLOOR`] are not taken.
//! 2. From the fifth sweep on nodes are put on their feet, first where the cells there stay good, in the end wherever
//!    they stay positive. From then on they slide on the solid.

use super::holds::{Hold, Holds};
use super::snap::snap;
use crate::optimize::{Problem, Rules, Weights, keep_positive, sweep};
use crate::{Cancelled, Monitor, Stage};

/// How strongly nodes are drawn in the first sweep, and by how much more in each after it.
const WEIGHT: f64 = 3.0;
const GROWTH: f64 = 1.35;

/// The first sweep after which nodes are put on their feet.
const FIRST_SNAP: usize = 4;

/// By the share of the sweeps that are done: the least scaled Jacobian that may be left where a node was put on its foot.
const LEAST: [(f64, f64); 3] = [(0.4, 0.3), (0.8, 0.15), (1.0, 0.02)];

/// What a pull may cost.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    pub(super) stage: Stage,
    pub(super) sweeps: usize,
    /// A cell whose scaled Jacobian is below this is not made worse by a sweep, and none is brought below it.
    pub(super) floor: f64,
}

/// Draws the nodes that are to be drawn; those `awake` are moved at first, then all that have reason to. Returns the
/// number of sweeps made.
pub(super) fn pull(
    problem: &mut Problem,
    holds: &mut Holds,
    awake: &mut Vec<bool>,
    course: Course,
    monitor: &dyn Monitor,
) -> Result<usize, Cancelled> {
    let allowed = vec![true; problem.movable()];
    let weights = Weights { doublings: 0, mu: 0.0 };
    holds.weight = WEIGHT;
    for round in 0..course.sweeps {
        let done = round as f64 / course.sweeps as f64;
        monitor.checkpoint(course.stage, done)?;
        for (awake, &node) in awake.iter_mut().zip(&problem.nodes) {
            *awake |= holds.is(node, Hold::Drawn);
        }
        let rules = Rules { guide: &*holds, weights, eps: 0.0, floor: Some(course.floor) };
        let (_, moved) =
            keep_positive(problem, awake, |problem, awake| sweep(problem, rules, &allowed, awake, monitor))?;
        if round >= FIRST_SNAP {
            let least = LEAST.iter().find(|(share, _)| done < *share).map_or(0.0, |&(_, least)| least);
            snap(problem, holds, least, &allowed, awake, monitor)?;
        }
        if moved.far == 0 && holds.stuck() == 0 {
            return Ok(round + 1);
        }
        holds.weight *= GROWTH;
    }
    Ok(course.sweeps)
}
