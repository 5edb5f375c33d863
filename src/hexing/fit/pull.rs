//! Draws the boundary to the solid, ever more strongly, while no cell is turned over or made bad.
//!
//! 1. A sweep over corners, then curves, surfaces and the inside lowers the shape energy and that of the pull, which
//!    grows from sweep to sweep. Steps that turn a cell over or make one worse than the floor are not taken.
//! 2. Curves come first: surfaces hardly pull in the first sweeps, so that cells go along with their curves and the feet
//!    of the nodes beside these are on the right side of them.
//! 3. From the fifth sweep on nodes are put on their feet, first where the cells there stay good; where that gets on no
//!    more, wherever they stay positive. From then on they slide on the solid.

use super::holds::{Hold, Holds};
use super::regions::drawn;
use super::snap::{Bearable, snap};
use super::spread::{Chain, spread};
use crate::optimize::{Problem, Rules, Weights, keep_positive, sweep};
use crate::{Cancelled, Monitor, Stage};

/// How strongly nodes are drawn in the first sweep, and by how much more in each after it.
const WEIGHT: f64 = 3.0;
const GROWTH: f64 = 1.35;

/// The first sweep after which nodes are put on their feet.
const FIRST_SNAP: usize = 4;

/// Sweeps in which curves are ahead of surfaces, and the share of the weight that surfaces have then.
const CURVES_FIRST: usize = 6;
const BEHIND: f64 = 0.1;

/// The least scaled Jacobian that may be left where a node was put on its foot, and the energy of the cells. The higher
/// powers push back where a cell is about to become bad, where steps of the lower ones would be refused.
const LEVELS: [(f64, Weights); 3] = [
    (0.3, Weights { doublings: 0, mu: 0.0 }),
    (0.15, Weights { doublings: 1, mu: 0.3 }),
    (0.02, Weights { doublings: 2, mu: 0.9 }),
];

/// Sweeps in a row after which the next of these is taken, if no fewer nodes are off.
const PATIENCE: usize = 4;

/// A step below this share of a node's mean edge wakes no neighbours: what is left is for the smoothing.
const ASLEEP: f64 = 0.02;

/// What a pull may cost.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    pub(super) stage: Stage,
    pub(super) sweeps: usize,
    /// A cell whose scaled Jacobian is below this is not made worse by a sweep, and none is brought below it.
    pub(super) floor: f64,
}

/// Draws those of the `allowed` nodes that are to be drawn; those `awake` are moved at first, then all of the allowed that
/// have reason to. Returns the number of sweeps made.
pub(super) fn pull(
    problem: &mut Problem,
    holds: &mut Holds,
    chains: &[Chain],
    allowed: &[bool],
    awake: &mut Vec<bool>,
    course: Course,
    monitor: &dyn Monitor,
) -> Result<usize, Cancelled> {
    holds.weight = WEIGHT;
    let (mut level, mut fewest, mut in_vain) = (0, usize::MAX, 0);
    for round in 0..course.sweeps {
        monitor.checkpoint(course.stage, round as f64 / course.sweeps as f64)?;
        spread(chains, holds, |node| problem.place(node));
        holds.surfaces = if round < CURVES_FIRST { BEHIND } else { 1.0 };
        for ((awake, &allowed), &node) in awake.iter_mut().zip(allowed).zip(&problem.nodes) {
            *awake |= allowed && holds.is(node, Hold::Drawn);
        }
        let (least, weights) = LEVELS[level];
        let rules = Rules { guide: &*holds, weights, eps: 0.0, floor: Some(course.floor), asleep: ASLEEP };
        keep_positive(problem, awake, monitor, |problem, awake| {
            sweep(problem, rules, allowed, awake, monitor)
        })?;
        if round >= FIRST_SNAP {
            let freedom = if round < CURVES_FIRST { 1 } else { 2 };
            snap(problem, holds, Bearable { least, freedom }, allowed, awake, monitor)?;
        }
        if round >= CURVES_FIRST {
            let stuck = drawn(problem, holds).filter(|&n| allowed[n as usize]).count();
            in_vain = if stuck < fewest { 0 } else { in_vain + 1 };
            fewest = fewest.min(stuck);
            if in_vain >= PATIENCE && level + 1 < LEVELS.len() {
                (level, in_vain) = (level + 1, 0);
            }
            if stuck == 0 || in_vain >= PATIENCE {
                return Ok(round + 1);
            }
        }
        holds.weight *= GROWTH;
    }
    Ok(course.sweeps)
}

#[cfg(test)]
mod tests {
    use super::super::target::{Foot, Target};
    use super::*;
    use crate::Silent;
    use crate::geometry::{Aabb, Point};
    use crate::hexing::correspondence::Anchor;
    use crate::mesh::{GridOptions, NodeId, hex_grid};
    use crate::solid::SurfaceId;

    /// What is at the boundary belongs a little above the cubes.
    struct Above;

    impl Target for Above {
        fn foot(&self, _: Anchor, p: Point) -> Option<Foot> {
            Some(Foot { point: p.with_z(2.2), direction: Point::Z })
        }
    }

    #[test]
    fn nodes_that_are_not_allowed_to_move_stay_drawn() {
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 100 };
        let mesh = hex_grid(Aabb { min: Point::ZERO, max: Point::new(8.0, 2.0, 2.0) }, &options).unwrap();
        let at = |x: f64| mesh.positions.iter().position(|&p| p == Point::new(x, 1.0, 2.0)).unwrap();
        let [here, there] = [at(1.0), at(7.0)].map(NodeId::new);
        let mut anchors = vec![Anchor::Inside; mesh.positions.len()];
        [here, there].iter().for_each(|n| anchors[n.index()] = Anchor::Surface(SurfaceId(0)));
        let mut holds = Holds::drawn(&Above, &anchors);
        let mut problem = Problem::new(&mesh.positions, &mesh.hexes, &|_| true);
        let allowed: Vec<bool> = problem.points.iter().map(|p| p.x < 4.0).collect();
        let course = Course { stage: Stage("pulling"), sweeps: 20, floor: 0.2 };
        let mut awake = vec![false; problem.movable()];
        pull(&mut problem, &mut holds, &[], &allowed, &mut awake, course, &Silent).unwrap();
        assert!(holds.is(here, Hold::Held) && problem.place(here).z == 2.2);
        assert!(holds.is(there, Hold::Drawn) && problem.place(there).z == 2.0);
    }
}
