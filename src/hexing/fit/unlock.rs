//! Gets nodes to the solid that were stuck before it, by letting go of those around.
//!
//! Around a stuck node the others slide on the solid already, and there is no room. Within some rings all are drawn
//! again instead of held, so that cells can turn a little away from the solid and come back in another way. Regions that
//! have no cell in common are judged each for itself: where that brought nothing it is taken back, and not tried with more
//! room around.

use super::FITTING;
use super::holds::{Hold, Holds};
use super::pull::{Course, pull};
use super::regions::{Mark, Regions, drawn};
use crate::monitor::Part;
use crate::optimize::Problem;
use crate::{Cancelled, Monitor};

/// Rings of cells around a stuck node where nodes are let go, in each attempt where the last one brought something, and how
/// many more move along.
const RINGS: [usize; 3] = [1, 2, 4];
const ALONG: usize = 2;

/// That is something: this share of what a region lacked.
const ENOUGH: f64 = 0.02;

/// Sweeps of an attempt, and how bad they may make cells.
const SWEEPS: usize = 20;
const FLOOR: f64 = 0.05;

/// What was done.
#[derive(Clone, Debug, Default)]
pub(super) struct Unlocked {
    pub(super) sweeps: usize,
    /// By how much that brought some region nearer to the solid, at best, as a share of what it lacked.
    pub(super) gain: f64,
    /// The nodes that stand elsewhere now.
    pub(super) moved: Vec<bool>,
}

/// Tries to get the drawn nodes onto the solid, so that its `marks` are no farther from the mesh.
pub(super) fn unlock(
    problem: &mut Problem,
    holds: &mut Holds,
    marks: &[Mark],
    monitor: &dyn Monitor,
) -> Result<Unlocked, Cancelled> {
    let mut unlocked = Unlocked { moved: vec![false; problem.movable()], ..Unlocked::default() };
    let mut stuck: Vec<u32> = drawn(problem, holds).collect();
    for (k, rings) in RINGS.into_iter().enumerate() {
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
        unlocked.sweeps += pull(problem, holds, &[], &regions.moves, &mut awake, course, &part)?;
        let gains = regions.keep_better(problem, holds, marks, before, &mut unlocked.moved);
        unlocked.gain = gains.iter().copied().fold(unlocked.gain, f64::max);
        stuck = drawn(problem, holds).filter(|&n| gains[n as usize] > ENOUGH).collect();
    }
    Ok(unlocked)
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

    use super::super::target::{Foot, Target};
    use super::*;
    use crate::Silent;
    use crate::geometry::{Aabb, Point};
    use crate::hexing::correspondence::Anchor;
    use crate::mesh::{GridOptions, hex_grid};
    use crate::solid::SurfaceId;

    /// A plane that is too far for cubes below it, and something that goes farther away than a node comes after it.
    struct OutOfReach {
        asked: AtomicUsize,
    }

    impl Target for OutOfReach {
        fn foot(&self, anchor: Anchor, p: Point) -> Option<Foot> {
            let point = match anchor {
                Anchor::Surface(SurfaceId(0)) => p.with_z(12.0),
                Anchor::Surface(_) => {
                    self.asked.fetch_add(1, Relaxed);
                    p.with_z(2.0 * p.z + 8.0)
                }
                _ => return None,
            };
            Some(Foot { point, direction: Point::Z })
        }
    }

    /// How often it is asked for the foot of the node that gets no nearer to it, alone or with one that does.
    fn asked(is_alone: bool) -> (usize, Unlocked) {
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 1000 };
        let mesh = hex_grid(Aabb { min: Point::ZERO, max: Point::new(40.0, 2.0, 2.0) }, &options).unwrap();
        let at = |x: f64| mesh.positions.iter().position(|&p| p == Point::new(x, 1.0, 2.0)).unwrap();
        let mut anchors = vec![Anchor::Inside; mesh.positions.len()];
        if !is_alone {
            anchors[at(1.0)] = Anchor::Surface(SurfaceId(0));
        }
        anchors[at(39.0)] = Anchor::Surface(SurfaceId(1));
        let target = OutOfReach { asked: AtomicUsize::new(0) };
        let mut problem = Problem::new(&mesh.positions, &mesh.hexes, &|_| true);
        let mut holds = Holds::drawn(&target, &anchors);
        let unlocked = unlock(&mut problem, &mut holds, &[], &Silent).unwrap();
        drop(holds);
        (target.asked.into_inner(), unlocked)
    }

    #[test]
    fn what_brought_nothing_is_not_tried_with_more_room_around() {
        let (alone, first) = asked(true);
        assert!(first.gain == 0.0 && first.sweeps > 0);
        let (beside, both) = asked(false);
        assert!(both.gain > ENOUGH && both.sweeps > first.sweeps, "{both:?}");
        // Where things stand is asked before and after each attempt, no more.
        assert!(beside <= alone + 2 * (RINGS.len() - 1), "{beside} {alone}");
    }
}
