//! Improves positive cells, the worst above all.
//!
//! 1. Stages whose energy weighs shape first, then angles, in growing powers: what a high power sums is hardly more
//!    than its greatest term, the worst corner.
//! 2. Each stage moves the nodes of the cells below its target alone.

use super::energy::Weights;
use super::problem::Problem;
use super::sweep::{Rules, sweep};
use super::{OptimizeOptions, SMOOTHING};
use crate::{Cancelled, Monitor};

/// The stages' energies. Shape has a share in each: angles alone would be best with edges of no length.
const COURSES: [Weights; 4] = [
    Weights { doublings: 0, mu: 0.0 },
    Weights { doublings: 1, mu: 0.3 },
    Weights { doublings: 2, mu: 0.999 },
    Weights { doublings: 3, mu: 0.99999 },
];

/// Rings of cells around those below the target whose nodes move too.
const RINGS: usize = 1;

/// Returns the number of rounds made.
pub(super) fn smooth(
    problem: &mut Problem,
    options: &OptimizeOptions,
    monitor: &dyn Monitor,
) -> Result<usize, Cancelled> {
    let total = (COURSES.len() * options.smooth_sweeps) as f64;
    let mut done = 0;
    for (index, weights) in COURSES.into_iter().enumerate() {
        let jacobians = problem.scaled_jacobians();
        let below: Vec<usize> = (0..jacobians.len()).filter(|&c| jacobians[c] < options.target).collect();
        if below.is_empty() {
            continue;
        }
        let allowed = problem.rings_around(&below, RINGS);
        let mut awake = allowed.clone();
        for round in 0..options.smooth_sweeps {
            monitor.checkpoint(SMOOTHING, (index * options.smooth_sweeps + round) as f64 / total)?;
            let worst = problem.scaled_jacobians().into_iter().fold(f64::INFINITY, f64::min);
            problem.find_positive();
            let rules = Rules { weights, eps: 0.0, floor: Some(worst) };
            done += 1;
            if sweep(problem, rules, &allowed, &mut awake, monitor)? == 0 {
                break;
            }
        }
    }
    monitor.checkpoint(SMOOTHING, 1.0)?;
    Ok(done)
}
