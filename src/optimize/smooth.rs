//! Improves positive cells, the worst above all.
//!
//! 1. Courses whose energy weighs shape first, then angles, in growing powers: what a high power sums is hardly more
//!    than its greatest term, the worst corner.
//! 2. Each course moves the nodes of the cells below its target alone, and those a ring around.
//! 3. Where that is asked for, it then goes on with the few worst cells: these take the most rounds, and few nodes.
//! 4. No round lowers the worst scaled Jacobian. Cells are kept positive inside by looking at them after each round,
//!    and where one was lost by making the round again, with that cell guarded at each of its nodes' steps.

use super::energy::Weights;
use super::guide::Guide;
use super::problem::Problem;
use super::sweep::{ASLEEP, Moved, Rules, sweep};
use super::{OptimizeOptions, SMOOTHING};
use crate::mesh::quality::four;
use crate::{Cancelled, Monitor, parallel};

/// Rounds with one energy.
struct Course {
    weights: Weights,
    /// The course's target is so much below that of the options.
    below: f64,
    /// Is its power so high that it is for low cells alone, where that is asked for?
    of_low: bool,
}

/// Shape has a share in each course: angles alone would be best with edges of no length. The high powers, which few
/// cells far above the worst notice, are for the lower ones; the last is for where few cells are smoothed.
const COURSES: [Course; 5] = [
    Course { weights: Weights { doublings: 0, mu: 0.0 }, below: 0.0, of_low: false },
    Course { weights: Weights { doublings: 1, mu: 0.3 }, below: 0.0, of_low: false },
    Course { weights: Weights { doublings: 2, mu: 0.999 }, below: 0.05, of_low: false },
    Course { weights: Weights { doublings: 3, mu: 0.99999 }, below: 0.05, of_low: true },
    Course { weights: Weights { doublings: 5, mu: 0.9999999999 }, below: 0.1, of_low: true },
];

/// A cell is low, too, if its scaled Jacobian is less than this above the worst.
const ABOVE_WORST: f64 = 0.1;

/// A course that raises the mean: nearly all angles, in a power so low that all corners count.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Evening {
    weights: Weights,
    /// Cells whose scaled Jacobian is below this have a part in it.
    target: f64,
    sweeps: usize,
}

impl Evening {
    /// The course when most of the boundary is where it stays.
    pub(crate) const LAST: Self =
        Self { weights: Weights { doublings: -1, mu: 0.99 }, target: 0.99, sweeps: 24 };

    /// Such courses, which differ in how much moves: neither is the better for all meshes.
    pub(crate) const ALL: [Self; 2] = [
        Self { weights: Weights { doublings: 0, mu: 0.99 }, target: 0.95, sweeps: 12 },
        Self { weights: Weights { doublings: 0, mu: 0.99 }, target: 0.98, sweeps: 12 },
    ];
}

/// Cells whose scaled Jacobian is below this are guarded from the first: those above are hardly ever lost.
const GUARDED: f64 = 0.2;

/// Rings of cells around those below the target whose nodes move too.
const RINGS: usize = 1;

/// Rings of cells around those that changed since all was smoothed that are smoothed too, but for the nodes around them.
const RINGS_SINCE: usize = 2;

/// Evening out goes on where its last round raised the mean by more than this, so many times.
const RISING: f64 = 3e-4;
const MORE: usize = 2;

/// For the mean no scaled Jacobian falls below this, however bad the worst of all is.
const KEPT: f64 = 0.36;

/// The worst cells are those below the scaled Jacobian that this share of the cells is below, or this many.
const WORST_SHARE: f64 = 0.003;
const WORST: usize = 100;

/// Where all was smoothed before, `moved` are the nodes that moved since: then the cells around these are smoothed, and others
/// stay as they are. Returns the number of rounds made.
pub(crate) fn smooth(
    problem: &mut Problem,
    guide: &dyn Guide,
    options: &OptimizeOptions,
    moved: Option<&[bool]>,
    monitor: &dyn Monitor,
) -> Result<usize, Cancelled> {
    let courses = COURSES.into_iter().take(options.courses);
    let planned = courses.len() * (options.smooth_sweeps + options.worst_sweeps);
    let looked_at = moved.map(|moved| changed(problem, moved, monitor)).transpose()?;
    let mut rounds = Rounds::new(problem, guide, planned, monitor)?;
    rounds.looked_at = looked_at;
    for (k, Course { weights, below, of_low }) in courses.enumerate() {
        let low = if of_low { options.low.max(rounds.worst() + ABOVE_WORST) } else { f64::INFINITY };
        let target = (options.target - below).min(low);
        let most = options.first_sweeps.get(k).copied().unwrap_or(usize::MAX);
        rounds.make(weights, target, options.smooth_sweeps.min(most))?;
        rounds.make(weights, target.min(worst_target(&rounds.jacobians)), options.worst_sweeps)?;
    }
    rounds.end()
}

/// Is a cell among those that changed as nodes moved, or in the rings around them?
fn changed(problem: &Problem, moved: &[bool], monitor: &dyn Monitor) -> Result<Vec<bool>, Cancelled> {
    let moved = parallel::filter(moved.len(), |n| moved[n]);
    let cells = problem.cells_around_within(&moved, monitor)?.into_iter().map(|cell| cell as usize);
    let near = problem.rings_within(&cells.collect::<Vec<_>>(), RINGS_SINCE - 1, monitor)?;
    let nodes = parallel::filter(near.len(), |n| near[n]);
    let mut is_changed = vec![false; problem.cells.len()];
    for cell in problem.cells_around_within(&nodes, monitor)? {
        is_changed[cell as usize] = true;
    }
    Ok(is_changed)
}

/// Raises the mean scaled Jacobian: moves the nodes of all cells that are not nearly perfect. As long as that still raises
/// it, half as many rounds are made again, twice at most. Returns the number of rounds made.
pub(crate) fn even_out(
    problem: &mut Problem,
    guide: &dyn Guide,
    evening: Evening,
    monitor: &dyn Monitor,
) -> Result<usize, Cancelled> {
    let Evening { weights, target, sweeps } = evening;
    let more = sweeps / 2;
    let mut rounds = Rounds::new(problem, guide, sweeps + MORE * more, monitor)?;
    rounds.least = KEPT;
    rounds.make(weights, target, sweeps)?;
    for _ in 0..MORE {
        if rounds.rise > RISING {
            rounds.make(weights, target, more)?;
        }
    }
    rounds.end()
}

/// Rounds over the cells of a problem.
struct Rounds<'a> {
    problem: &'a mut Problem,
    guide: &'a dyn Guide,
    monitor: &'a dyn Monitor,
    /// The scaled Jacobian of each cell.
    jacobians: Vec<f64>,
    /// Is a cell looked at? All are, if that is not told.
    looked_at: Option<Vec<bool>>,
    /// No scaled Jacobian falls below this, nor below the worst of all, if that is greater.
    least: f64,
    /// By how much the last round raised the mean.
    rise: f64,
    /// How many rounds were made, how many might have been, and how many there may be.
    done: usize,
    passed: usize,
    planned: usize,
}

impl<'a> Rounds<'a> {
    fn new(
        problem: &'a mut Problem,
        guide: &'a dyn Guide,
        planned: usize,
        monitor: &'a dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let jacobians = problem.scaled_jacobians(monitor)?;
        let (looked_at, least, rise) = (None, 0.0, 0.0);
        let [done, passed] = [0; 2];
        Ok(Self { problem, guide, monitor, jacobians, looked_at, least, rise, done, passed, planned })
    }

    /// Moves the nodes of the cells below the target, as often as that still does something.
    fn make(&mut self, weights: Weights, target: f64, sweeps: usize) -> Result<(), Cancelled> {
        let &mut Self { guide, monitor, planned, passed, .. } = self;
        self.passed += sweeps;
        let is_low = |&c: &usize| {
            self.jacobians[c] < target && self.looked_at.as_ref().is_none_or(|looked_at| looked_at[c])
        };
        let low: Vec<usize> = (0..self.jacobians.len()).filter(is_low).collect();
        if low.is_empty() || sweeps == 0 {
            return Ok(());
        }
        let allowed = self.problem.rings_within(&low, RINGS, monitor)?;
        let mut awake = allowed.clone();
        self.problem.guarded = self.jacobians.iter().map(|&jacobian| jacobian < GUARDED).collect();
        for round in 0..sweeps {
            monitor.checkpoint(SMOOTHING, (passed + round) as f64 / planned as f64)?;
            // Nobody looks at who is awake after the last round.
            let asleep = if round + 1 < sweeps { ASLEEP } else { f64::INFINITY };
            let rules = Rules { guide, weights, eps: 0.0, floor: Some(self.worst().max(self.least)), asleep };
            let round =
                |problem: &mut Problem, awake: &mut [bool]| sweep(problem, rules, &allowed, awake, monitor);
            let (changed, moved) = keep_positive(self.problem, &mut awake, monitor, round)?;
            let corners = |k: usize| self.problem.corners(changed[k] as usize);
            let renewed = four::scaled_jacobians(changed.len(), monitor, corners)?;
            let mut rise = 0.0;
            for (&cell, jacobian) in changed.iter().zip(renewed) {
                rise += jacobian - self.jacobians[cell as usize];
                self.jacobians[cell as usize] = jacobian;
            }
            self.rise = rise / self.jacobians.len() as f64;
            self.done += 1;
            if moved.far == 0 {
                break;
            }
        }
        Ok(())
    }

    /// The least scaled Jacobian.
    fn worst(&self) -> f64 {
        self.jacobians.iter().copied().fold(f64::INFINITY, f64::min)
    }

    /// The number of rounds made.
    fn end(self) -> Result<usize, Cancelled> {
        self.monitor.checkpoint(SMOOTHING, 1.0)?;
        Ok(self.done)
    }
}

/// What the worst cells are below.
fn worst_target(jacobians: &[f64]) -> f64 {
    let count = WORST.max((WORST_SHARE * jacobians.len() as f64) as usize);
    if count >= jacobians.len() {
        return f64::INFINITY;
    }
    let mut sorted = jacobians.to_vec();
    *sorted.select_nth_unstable_by(count, f64::total_cmp).1
}

/// Makes a round, again and again until every cell that was positive inside still is: those that were lost are guarded
/// the next time. The cells that changed, and what moved.
pub(crate) fn keep_positive(
    problem: &mut Problem,
    awake: &mut Vec<bool>,
    monitor: &dyn Monitor,
    mut round: impl FnMut(&mut Problem, &mut [bool]) -> Result<Moved, Cancelled>,
) -> Result<(Vec<u32>, Moved), Cancelled> {
    let before = awake.clone();
    loop {
        let moved = round(problem, awake)?;
        let changed = problem.cells_around_within(&moved.nodes, monitor)?;
        let is_positive =
            four::are_positive(changed.len(), monitor, |k| problem.corners(changed[k] as usize))?;
        let now = || changed.iter().map(|&cell| cell as usize).zip(is_positive.iter().copied());
        let lost: Vec<usize> =
            now().filter(|&(cell, is)| problem.positive[cell] && !is).map(|(cell, _)| cell).collect();
        if lost.is_empty() {
            // Those that became positive are to stay so from now on.
            now().for_each(|(cell, is)| problem.positive[cell] = is);
            return Ok((changed, moved));
        }
        lost.into_iter().for_each(|cell| problem.guarded[cell] = true);
        moved.take_back(problem);
        awake.clone_from(&before);
    }
}

#[cfg(test)]
mod tests {
    use super::super::Free;
    use super::super::guide::DrawnTo;
    use super::*;
    use crate::Silent;
    use crate::geometry::{Aabb, Point};
    use crate::mesh::numbering::hex::CORNERS;
    use crate::mesh::{GridOptions, NodeId, hex_grid};

    #[test]
    fn the_worst_are_a_share_and_some_at_least() {
        let jacobians = |count: usize| (0..count).rev().map(|k| k as f64).collect::<Vec<_>>();
        assert_eq!(worst_target(&jacobians(WORST)), f64::INFINITY);
        assert_eq!(worst_target(&jacobians(2 * WORST)), WORST as f64);
        assert_eq!(worst_target(&jacobians(100_000)), 300.0);
    }

    /// Cubes whose inner corners were moved about.
    #[test]
    fn evening_out_raises_the_mean_and_keeps_the_worst() {
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 1000 };
        let bounds = Aabb { min: Point::ZERO, max: Point::splat(6.0) };
        let mut mesh = hex_grid(bounds, &options).unwrap();
        let is_inside = |p: Point| p.min_element() > 0.5 && p.max_element() < 5.5;
        let inside: Vec<bool> = mesh.positions.iter().map(|&p| is_inside(p)).collect();
        for p in mesh.positions.iter_mut().filter(|p| is_inside(**p)) {
            *p += Point::new(libm::sin(p.y * 2.0), libm::sin(p.z * 3.0), libm::sin(p.x * 5.0)) * 0.25;
        }
        for evening in Evening::ALL {
            let mut problem = Problem::new(&mesh.positions, &mesh.hexes, &|n| inside[n.index()]);
            let before = problem.state(&Silent).unwrap();
            assert!(before.mean() < 0.9);
            let sweeps = even_out(&mut problem, &Free, evening, &Silent).unwrap();
            assert!((1..=2 * evening.sweeps).contains(&sweeps), "{sweeps}");
            let after = problem.state(&Silent).unwrap();
            assert!(
                after.mean() > 0.99 && after.worst() >= before.worst(),
                "{} {:?}",
                after.mean(),
                after.worst()
            );
        }
    }

    /// The middle of a block is drawn aside; another block leans so far that its cells are much worse.
    #[test]
    fn no_fair_cell_becomes_worse_than_fair_while_all_is_evened_out() {
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 8 };
        let block = hex_grid(Aabb { min: Point::ZERO, max: Point::splat(2.0) }, &options).unwrap();
        let nodes = block.positions.len();
        let leaning = block.positions.iter().map(|&p| p + Point::X * (12.0 * p.z));
        let positions: Vec<Point> = block.positions.iter().copied().chain(leaning).collect();
        let other = block.hexes.iter().map(|hex| hex.map(|n| NodeId::new(n.index() + nodes)));
        let hexes: Vec<_> = block.hexes.iter().copied().chain(other).collect();
        let is_middle = |n: NodeId| block.positions[n.index() % nodes] == Point::ONE;
        let mut problem = Problem::new(&positions, &hexes, &is_middle);
        problem.points[0] += Point::splat(0.1);
        let worst = |problem: &Problem| {
            let jacobians = problem.scaled_jacobians(&Silent).unwrap();
            let (block, other) = jacobians.split_at(block.hexes.len());
            [block, other].map(|jacobians| jacobians.iter().copied().fold(1.0, f64::min))
        };
        let [before, other] = worst(&problem);
        assert!(before > 0.7 && other < 0.1);
        let aside = DrawnTo(|p| p + Point::ONE, 1e3);
        even_out(&mut problem, &aside, Evening::ALL[0], &Silent).unwrap();
        let [after, _] = worst(&problem);
        assert!((KEPT..KEPT + 0.02).contains(&after), "{after}");
    }

    /// All of a bar could be better; since it was smoothed a node of one end was moved.
    #[test]
    fn what_was_smoothed_before_stays_where_nothing_moved() {
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 1000 };
        let mut mesh =
            hex_grid(Aabb { min: Point::ZERO, max: Point::new(20.0, 2.0, 2.0) }, &options).unwrap();
        let is_axis = |p: Point| p.y == 1.0 && p.z == 1.0 && p.x > 0.0 && p.x < 20.0;
        let axis: Vec<bool> = mesh.positions.iter().map(|&p| is_axis(p)).collect();
        for p in mesh.positions.iter_mut().filter(|p| is_axis(**p)) {
            *p += Point::new(0.0, 0.5, -0.4);
        }
        let smoothed = |again: bool| {
            let mut problem = Problem::new(&mesh.positions, &mesh.hexes, &|n| axis[n.index()]);
            let before = problem.points.clone();
            let moved: Vec<bool> = before[..problem.movable()].iter().map(|p| p.x == 2.0).collect();
            let moved = again.then_some(moved.as_slice());
            smooth(&mut problem, &Free, &OptimizeOptions::default(), moved, &Silent).unwrap();
            let moved = (0..problem.movable()).filter(|&n| problem.points[n] != before[n]);
            moved.map(|n| before[n].x).fold(0.0, f64::max)
        };
        // Cells on both sides of the node, the rings, and a ring of nodes around.
        assert_eq!(smoothed(true), 2.0 + 1.0 + (RINGS_SINCE + RINGS) as f64);
        assert_eq!(smoothed(false), 19.0);
    }

    /// Two blocks of eight cells, one leaning and the other leaning far, whose middles may move.
    #[test]
    fn high_powers_are_for_low_cells_and_first_courses_are_short_where_that_is_asked_for() {
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 8 };
        let block = hex_grid(Aabb { min: Point::ZERO, max: Point::splat(2.0) }, &options).unwrap();
        let nodes = block.positions.len();
        let leaning = |shear: f64| {
            block.positions.iter().map(move |&p| p + Point::X * (shear * p.z * (1.0 + 0.1 * p.x * p.y)))
        };
        let positions: Vec<Point> = leaning(0.9).chain(leaning(3.0)).collect();
        let moved = block.hexes.iter().map(|hex| hex.map(|n| NodeId::new(n.index() + nodes)));
        let hexes: Vec<[NodeId; 8]> = block.hexes.iter().copied().chain(moved).collect();
        let middle = block.positions.iter().position(|&p| p == Point::ONE).unwrap();
        let smoothed = |options: OptimizeOptions| {
            let mut problem = Problem::new(&positions, &hexes, &|n| n.index() % nodes == middle);
            let rounds = smooth(&mut problem, &Free, &options, None, &Silent).unwrap();
            (problem.points[..2].to_vec(), rounds)
        };
        let after = |courses: usize, low: f64| {
            smoothed(OptimizeOptions { courses, low, ..OptimizeOptions::default() }).0
        };
        let (before, all, low) = (after(3, 0.5), after(4, f64::INFINITY), after(4, 0.5));
        assert!(all[0] != before[0] && all[1] != before[1], "all are below the target");
        assert_eq!((low[0], low[1]), (before[0], all[1]));

        let rounds = |first_sweeps: [usize; 2]| {
            smoothed(OptimizeOptions { courses: 2, first_sweeps, ..OptimizeOptions::default() }).1
        };
        assert!(rounds([usize::MAX; 2]) > 3);
        assert_eq!(rounds([1, 2]), 3);
    }

    /// A long bar whose middle was pushed aside comes back slowly.
    #[test]
    fn evening_out_goes_on_as_long_as_the_mean_rises() {
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 1000 };
        let bounds = Aabb { min: Point::ZERO, max: Point::new(2.0, 2.0, 40.0) };
        let mut mesh = hex_grid(bounds, &options).unwrap();
        let moves: Vec<bool> = mesh.positions.iter().map(|p| p.z > 0.0 && p.z < 40.0).collect();
        mesh.positions.iter_mut().for_each(|p| p.x += 10.0 * libm::sin(p.z * std::f64::consts::PI / 40.0));
        let evening = Evening::ALL[1];
        let mut problem = Problem::new(&mesh.positions, &mesh.hexes, &|n| moves[n.index()]);
        let sweeps = even_out(&mut problem, &Free, evening, &Silent).unwrap();
        assert!(sweeps > evening.sweeps && sweeps <= 2 * evening.sweeps, "{sweeps}");
    }

    /// A round that loses a cell is made again from where the nodes were, with the cell guarded.
    #[test]
    fn a_cell_that_was_lost_is_guarded() {
        let positions = CORNERS.map(|c| Point::from(c.map(f64::from)));
        let hexes = [[0, 1, 2, 3, 4, 5, 6, 7].map(NodeId)];
        let mut problem = Problem::new(&positions, &hexes, &|_| true);
        let mut awake = vec![true; 8];
        let mut starts = Vec::new();
        let done = keep_positive(&mut problem, &mut awake, &Silent, |problem, awake| {
            starts.push((problem.points[6], awake[6], problem.guarded[0]));
            awake[6] = false;
            let to = if problem.guarded[0] { Point::splat(0.9) } else { Point::splat(-1.0) };
            let mut moved = Moved::default();
            moved.take(problem, 6, to);
            moved.far = 1;
            Ok(moved)
        });
        let (changed, moved) = done.unwrap();
        assert_eq!((changed, moved.nodes, moved.far), (vec![0], vec![6], 1));
        assert_eq!(starts, [(Point::ONE, true, false), (Point::ONE, true, true)]);
        assert_eq!(problem.points[6], Point::splat(0.9));
    }
}
