//! Moves nodes until every hex is positive, then until the worst are as good as can be. Topology stays.
//!
//! The energy is a sum of powers over the corners of the cells (see `energy`), regularised so that it is finite for
//! inverted ones, and lowered node by node with Newton steps:
//!
//! 1. `constraint`: nodes of the boundary and between materials slide on the input's surfaces, along their curves, or stay;
//! 2. `problem`: the cells around the movable nodes, and nodes coloured so that those of one colour share no cell;
//! 3. `untangle`: cells that are not positive are pushed open by a regularised energy;
//! 4. `smooth`: shape first, then more and more the worst corners alone.
//!
//! Promises: in smoothing no cell stops being positive (at its corners, and inside by Bernstein's bound), the worst scaled
//! Jacobian never falls, and no cell gets so flat that it counts as a worse one (`energy`). Nodes that are not movable do not
//! move. The same bytes for any number of threads. Time is linear in the cells around movable nodes, but for one pass over all
//! hexes.
//!
//! Refuses nothing: cells that stay inverted are listed in the report, for the caller to repair.

mod ahead;
mod constraint;
mod energy;
mod guide;
mod piece;
mod problem;
mod smooth;
mod star;
mod surface;
mod sweep;
mod symmetric;
mod untangle;

pub(crate) use energy::Weights;
pub(crate) use guide::{Free, Guide, Pull};
pub(crate) use problem::Problem;
pub(crate) use smooth::{Evening, even_out, keep_positive, smooth};
pub(crate) use star::Star;
pub(crate) use sweep::{Moved, Rules, sweep, wake, worst_kept};
pub(crate) use symmetric::Symmetric;
pub(crate) use untangle::untangle;

use constraint::Constrained;
pub use constraint::{Constraints, Freedom};
pub use surface::{BoundarySurface, FaceKind};

use crate::geometry::Point;
use crate::mesh::quality::{Certainty, is_positive};
use crate::mesh::{HexId, NodeId};
use crate::parallel;
use crate::{Cancelled, Monitor, Stage};

/// How far to go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OptimizeOptions {
    /// Cells whose scaled Jacobian is above this are good enough: only their worse neighbours move them. The last
    /// courses of smoothing let 0.05 less do.
    pub target: f64,
    /// Sweeps over the tangled part before the cells left are given up.
    pub untangle_sweeps: usize,
    /// Courses of smoothing, at most 5: the first looks at shape alone, each further one more at the worst corners.
    pub courses: usize,
    /// Sweeps over the cells below the target in each of the courses of smoothing.
    pub smooth_sweeps: usize,
    /// In the first two courses no more than these: cells that were drawn to a boundary with about such an energy need few.
    pub first_sweeps: [usize; 2],
    /// The fourth course and the fifth, whose powers are the highest, move only cells whose scaled Jacobian is below this, or hardly
    /// above the worst. What others gain by them costs the mean.
    pub low: f64,
    /// Sweeps over the few worst cells alone, after those.
    pub worst_sweeps: usize,
}

impl OptimizeOptions {
    pub(crate) const DEFAULT: Self = Self {
        target: 0.75,
        untangle_sweeps: 200,
        courses: 4,
        smooth_sweeps: 5,
        first_sweeps: [usize::MAX; 2],
        low: f64::INFINITY,
        worst_sweeps: 0,
    };
}

impl Default for OptimizeOptions {
    fn default() -> Self {
        Self::DEFAULT
    }
}

/// What was done, over the cells around movable nodes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct OptimizeReport {
    /// Cells around movable nodes.
    pub cells: usize,
    /// Their least scaled Jacobian before; `None` if there are none.
    pub worst_before: Option<f64>,
    /// Their least scaled Jacobian after.
    pub worst_after: Option<f64>,
    /// Their mean scaled Jacobian before, 0 if there are none.
    pub mean_before: f64,
    /// Their mean scaled Jacobian after.
    pub mean_after: f64,
    /// Nodes that stand elsewhere than before.
    pub moved: usize,
    /// The greatest distance of a movable boundary node from where its freedom lets it be.
    pub off_boundary: f64,
    /// All hexes that are not certainly positive, whether their nodes can move or not, ascending.
    pub inverted: Vec<HexId>,
    /// Rounds over nodes that were made.
    pub sweeps: usize,
}

/// The stages that a monitor hears of.
const UNTANGLING: Stage = Stage("untangling");
pub(crate) const SMOOTHING: Stage = Stage("smoothing");

/// Untangles and smooths the hexes around the nodes that are `movable` (one flag a node), within `constraints`.
///
/// `positions` are left as they were if the work is cancelled.
///
/// # Errors
/// [`Cancelled`] when the monitor says so.
///
/// # Panics
/// If a hex names a node that has no position, flag or constraint.
///
/// ```
/// use hexmill::{Silent, geometry::Point, mesh::{NodeId, numbering::hex::CORNERS}};
/// use hexmill::optimize::{Constraints, optimize};
/// // A cube with one corner pushed through the opposite one.
/// let mut positions = CORNERS.map(|c| Point::from(c.map(f64::from)));
/// positions[6] = Point::splat(-0.5);
/// let hexes = [[0, 1, 2, 3, 4, 5, 6, 7].map(NodeId)];
/// let movable = [false, false, false, false, false, false, true, false];
/// let report =
///     optimize(&mut positions, &hexes, &movable, &Constraints::none(8), &Default::default(), &Silent).unwrap();
/// assert!(report.worst_before.unwrap() < 0.0 && report.worst_after.unwrap() > 0.9);
/// ```
pub fn optimize(
    positions: &mut [Point],
    hexes: &[[NodeId; 8]],
    movable: &[bool],
    constraints: &Constraints,
    options: &OptimizeOptions,
    monitor: &dyn Monitor,
) -> Result<OptimizeReport, Cancelled> {
    monitor.checkpoint(UNTANGLING, 0.0)?;
    let moves = |n: NodeId| movable[n.index()] && !constraints.is_fixed(n);
    let mut problem = Problem::within(positions, hexes, &moves, monitor)?;
    let before = problem.state(monitor)?;
    let guide = Constrained { constraints, positions };
    let mut sweeps = untangle(&mut problem, &guide, options, monitor)?;
    sweeps += smooth(&mut problem, &guide, options, None, monitor)?;
    let mut after = problem.state(monitor)?;
    if after.is_worse_than(&before) {
        problem.put_back(positions);
        after = before.clone();
    }
    let mut inverted = after.inverted(&problem);
    // Hexes of which no node moves are none of the problem.
    let is_doubtful = |hex: &[NodeId; 8]| {
        !hex.iter().any(|&n| moves(n))
            && is_positive(&hex.map(|n| positions[n.index()])) != Certainty::Positive
    };
    let rigid = parallel::try_filter(hexes.len(), monitor, |h| is_doubtful(&hexes[h]))?;
    inverted.extend(rigid.into_iter().map(HexId));
    inverted.sort_unstable();
    let moved = problem.write_back(positions);
    Ok(OptimizeReport {
        cells: problem.cells.len(),
        worst_before: before.worst(),
        worst_after: after.worst(),
        mean_before: before.mean(),
        mean_after: after.mean(),
        moved,
        off_boundary: parallel::greatest(problem.movable(), |i| {
            constraints.distance(problem.nodes[i], problem.points[i])
        }),
        inverted,
        sweeps,
    })
}
