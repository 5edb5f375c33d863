//! Gets nodes to the solid that were stuck before it, by letting go of those around.
//!
//! Around a stuck node the others slide on the solid already, and there is no room. Within some rings all are drawn
//! again instead of held, so that cells can turn a little away from the solid and come back in another way.

use super::FITTING;
use super::holds::{Hold, Holds};
use super::progress::Part;
use super::pull::{Course, pull};
use super::spread::Chain;
use crate::optimize::Problem;
use crate::{Cancelled, Monitor};

/// Rings of cells around a stuck node where nodes are let go, in each attempt.
const RINGS: [usize; 3] = [1, 2, 4];

/// Sweeps of an attempt, and how bad they may make cells.
const SWEEPS: usize = 20;
const FLOOR: f64 = 0.05;

/// Tries to get the drawn nodes onto the solid. An attempt that does not leave fewer is taken back. Returns the number
/// of sweeps made.
pub(super) fn unlock(
    problem: &mut Problem,
    holds: &mut Holds,
    chains: &[Chain],
    monitor: &dyn Monitor,
) -> Result<usize, Cancelled> {
    let mut sweeps = 0;
    for (k, rings) in RINGS.into_iter().enumerate() {
        let stuck = holds.stuck();
        if stuck == 0 {
            break;
        }
        let before = (problem.points.clone(), holds.holds.clone());
        let is_stuck = |n: u32| holds.is(problem.nodes[n as usize], Hold::Drawn);
        let nodes: Vec<u32> = (0..problem.movable() as u32).filter(|&n| is_stuck(n)).collect();
        let cells: Vec<usize> = problem.cells_around(&nodes).into_iter().map(|c| c as usize).collect();
        let mut awake = problem.rings_around(&cells, rings);
        for node in (0..problem.movable()).filter(|&n| awake[n]) {
            let hold = &mut holds.holds[problem.nodes[node].index()];
            if *hold == Hold::Held {
                *hold = Hold::Drawn;
            }
        }
        let course = Course { stage: FITTING, sweeps: SWEEPS, floor: FLOOR };
        let part =
            Part { whole: monitor, stage: FITTING, range: [k, k + 1].map(|k| k as f64 / RINGS.len() as f64) };
        sweeps += pull(problem, holds, chains, &mut awake, course, &part)?;
        if holds.stuck() >= stuck {
            (problem.points, holds.holds) = before;
            problem.find_positive();
        }
    }
    Ok(sweeps)
}
