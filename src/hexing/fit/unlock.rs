//! Gets nodes to the solid that were stuck before it, by letting go of those around.
//!
//! Around a stuck node the others slide on the solid already, and there is no room. Within some rings all are drawn
//! again instead of held, so that cells can turn a little away from the solid and come back in another way. Regions that
//! have no cell in common are judged each for itself: where that brought nothing it is taken back.

use super::FITTING;
use super::holds::{Hold, Holds};
use super::progress::Part;
use super::pull::{Course, pull};
use super::regions::{Mark, Regions, drawn};
use super::spread::Chain;
use crate::optimize::Problem;
use crate::{Cancelled, Monitor};

/// Rings of cells around a stuck node where nodes are let go, in each attempt as long as one brings something, and how many
/// more move along.
const RINGS: [usize; 3] = [1, 2, 4];
const ALONG: usize = 2;

/// Sweeps of an attempt, and how bad they may make cells.
const SWEEPS: usize = 20;
const FLOOR: f64 = 0.05;

/// What was done.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Unlocked {
    pub(super) sweeps: usize,
    /// By how much that brought some region nearer to the solid, at best, as a share of what it lacked.
    pub(super) gain: f64,
}

/// Tries to get the drawn nodes onto the solid, so that its `marks` are no farther from the mesh.
pub(super) fn unlock(
    problem: &mut Problem,
    holds: &mut Holds,
    chains: &[Chain],
    marks: &[Mark],
    monitor: &dyn Monitor,
) -> Result<Unlocked, Cancelled> {
    let mut unlocked = Unlocked::default();
    for (k, rings) in RINGS.into_iter().enumerate() {
        let stuck: Vec<u32> = drawn(problem, holds).collect();
        if stuck.is_empty() {
            break;
        }
        let cells: Vec<usize> = problem.cells_around(&stuck).into_iter().map(|c| c as usize).collect();
        let mut awake = problem.rings_around(&cells, rings);
        let regions = Regions::new(problem, problem.rings_around(&cells, rings + ALONG));
        let before = regions.state(problem, holds, marks);
        for node in (0..problem.movable()).filter(|&n| awake[n]) {
            holds.replace(problem.nodes[node], Hold::Held, Hold::Drawn);
        }
        let course = Course { stage: FITTING, sweeps: SWEEPS, floor: FLOOR };
        let part =
            Part { whole: monitor, stage: FITTING, range: [k, k + 1].map(|k| k as f64 / RINGS.len() as f64) };
        unlocked.sweeps += pull(problem, holds, chains, &regions.moves, &mut awake, course, &part)?;
        let gain = regions.keep_better(problem, holds, marks, before);
        if gain == 0.0 {
            // What brought nothing anywhere brings nothing with more room around.
            break;
        }
        unlocked.gain = unlocked.gain.max(gain);
    }
    Ok(unlocked)
}
