//! Fits a mesh to its solid without ever returning an inverted cell: the paper's geometric optimisation (section 6).
//!
//! The energy is that of [`optimize`](crate::optimize); the order of the steps makes the promise:
//!
//! 1. `inflate`: cells of new sheets are pushed open, all nodes free, until every cell is positive;
//! 2. `pull`: boundary nodes are drawn to their corner, to their curve, `spread` along it, or to their surface, ever more
//!    strongly, and held there (`snap`) as soon as the cells bear it. No step is taken that turns a cell over;
//! 3. smoothing, the worst cells above all, while boundary nodes slide on the solid;
//! 4. `loosen`: nodes that cannot get to a curve that somebody drew rest on a surface beside it, for which those around
//!    are let go for a while (`unlock`);
//! 5. `soften`: soft curves that cost cells are given up, and the worst cells smoothed again, for which nodes that are
//!    off the solid, or on curves that nobody drew, may go a little farther;
//! 6. `even`: all is smoothed for the mean;
//! 7. `near`: where mesh and solid are farthest from each other, boundary nodes try other places. Where they stay far apart
//!    and nodes found much better places, the last two steps are made again around there, with other courses, and each counts
//!    that brings them much nearer;
//! 8. `approach`: where they are so far apart that another attempt would be made, or was and is no better, with cells that are
//!    fair instead of good, and where little is missing, with good ones: room is made among the cells around, and what came
//!    nearer counts, place by place ([`Fitted::approach`], `patches`);
//! 9. `even` once more, for what is inside and in planes ([`Fitted::finish`]): that takes mesh and solid no farther from
//!    each other, so that meshes can be held against each other before it, and only the one that is kept needs it.
//!
//! Positive here means at the corners and, by Bernstein's bound, in all of the inside. Flat cells count as bad ones, whatever
//! their angles, in each step that keeps cells better than a floor; two nodes with one and the same foot hold each other off
//! there. What could not be reached stays off the solid and is reported with its distance.
//!
//! **Departure from the paper.** It projects first and then moves each bad node to the best place of a box around it;
//! that leaves cells inverted. Here cells are positive first, and stay so.
//!
//! **Departure from the design.** Nodes that are stuck are not unlocked to get to their own place: what that brings, the later
//! steps bring as well, and most meshes are the same without.

mod apart;
mod approach;
mod even;
mod finish;
mod holds;
mod inflate;
mod loosen;
mod near;
mod patches;
mod pull;
mod regions;
mod rings;
mod snap;
mod soften;
mod spread;
mod survey;
mod target;
mod unlock;

use super::correspondence::Correspondence;
use super::sheets::SheetReport;
use crate::geometry::Point;
use crate::mesh::quality::scaled_jacobian;
use crate::mesh::{HexId, HexMesh, NodeId};
use crate::monitor::Part;
use crate::optimize::{Evening, OptimizeOptions, Problem, smooth};
use crate::solid::SolidModel;
use crate::{Cancelled, Monitor, Stage, parallel};
pub use approach::ApproachOptions;
use even::even;
pub(super) use finish::{FINISHED, FINISHING};
use holds::{Hold, Holds};
use inflate::inflate;
use loosen::loosen;
use near::{Nearness, Terms, near};
use pull::{Course, pull};
use rings::widen;
use soften::soften;
use spread::chains;
pub(super) use survey::Survey;
#[cfg(test)]
pub(super) use target::Foot;
pub(super) use target::{OnSolid, Target};

const FITTING: Stage = Stage("fitting");

/// Drawing the boundary makes no cell worse than this, unless it is already.
const FLOOR: f64 = 0.2;

/// The share of the work that is done where the pull starts, where cells are smoothed, and where nodes that stay stuck are
/// let go.
const PULL: f64 = 0.1;
const SMOOTH: f64 = 0.5;
const LOOSEN: f64 = 0.8;

/// The share of the work that is done where soft curves are given up, where all is evened out, and where only what is far
/// from the solid is left; of a course of evening out the share where mesh and solid are brought nearer.
const SOFTEN: f64 = 0.9;
const EVEN: f64 = 0.94;
pub(super) const APPROACH: f64 = 0.98;
const NEAR: f64 = 0.6;

/// A course more of evening out, and an approach that ends before it is near enough, count where they leave so much less
/// between mesh and solid.
pub(super) const NEARER: f64 = 0.92;

/// Another is made for so many rings of cells around what is far.
const AGAIN: usize = 8;

/// A scaled Jacobian that no cell loses for the sake of distance, unless another attempt would be made for that.
pub(super) const GOOD: f64 = 0.45;

/// Cells below this are looked at where the worst are smoothed.
const LOW: f64 = GOOD + 0.05;

/// How far nodes may be from where they belong for the sake of cells, in edges, if they are not farther already.
const LEAVE: f64 = 0.15;

/// The least scaled Jacobian in a mesh that is left as it is, since all its nodes are where they belong; and the share of its
/// edges within which a node is there.
const RIGHT: f64 = 0.7;
const THERE: f64 = 1e-6;

/// Nodes that are looked at between two questions whether to stop.
const BATCH: usize = 1 << 12;

/// Rings of cells around the boundary that are moved at first; others follow where these move far.
const RINGS: usize = 3;

/// How far to go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FitOptions {
    /// Sweeps that draw the boundary to the solid, at most.
    pub sweeps: usize,
    /// How the cells are smoothed in the end.
    pub smoothing: OptimizeOptions,
    /// How far mesh and solid may be from each other, in model units: for better cells nodes leave where they belong by
    /// half of that at most, if they are not farther already.
    pub max_distance: f64,
}

impl Default for FitOptions {
    fn default() -> Self {
        Self {
            sweeps: 40,
            smoothing: OptimizeOptions {
                smooth_sweeps: 8,
                first_sweeps: [4, 6],
                low: LOW,
                ..Default::default()
            },
            max_distance: f64::INFINITY,
        }
    }
}

/// A boundary node that is not where it belongs.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OffNode {
    /// The node.
    pub node: NodeId,
    /// Where it is.
    pub place: Point,
    /// How far it is from its corner, curve or surface, in model units.
    pub distance: f64,
}

/// What came of a fit.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct FitReport {
    /// Sheets, wedges and collars that were taken back, since their cells could not be pushed open.
    pub taken_back: usize,
    /// Sweeps over nodes.
    pub sweeps: usize,
    /// Boundary nodes that are not where they belong, the farthest first.
    pub off: Vec<OffNode>,
    /// The least scaled Jacobian; `None` if there are no hexes.
    pub worst: Option<f64>,
    /// The mean scaled Jacobian.
    pub mean: f64,
    /// Hexes that are not certainly positive, ascending: none, if all were positive before sheets were inserted.
    pub inverted: Vec<HexId>,
    /// How far mesh and solid are from each other at the samples of a survey, in model units; infinite if there was none.
    pub apart: f64,
}

/// What came of a fit, and what holds the nodes.
#[derive(Clone, Debug)]
pub struct Fitted {
    /// What came of it.
    pub report: FitReport,
    holds: Vec<Hold>,
}

/// Moves the nodes of `mesh` to the solid as `on` tells: all but the last step. What came of it, and what was seen of mesh and
/// solid, unless hexes are inverted. Sheets that cannot be fitted are taken back, in all of `mesh`,
/// `on` and `sheets`; soft curves that leave no room for good cells are given up in `on`.
///
/// # Errors
/// [`Cancelled`] when the monitor says so; nodes that have moved by then stay where they are.
pub fn fit<'a>(
    mesh: &mut HexMesh,
    on: &mut Correspondence,
    sheets: &mut SheetReport,
    solid: &'a SolidModel,
    options: &FitOptions,
    monitor: &dyn Monitor,
) -> Result<(Fitted, Option<Survey<'a>>), Cancelled> {
    let reduction = on.reduction.clone();
    let part = |from, to| Part { whole: monitor, stage: FITTING, range: [from, to] };
    let (mut report, mut holds) =
        fitted(mesh, on, sheets, &OnSolid::new(solid, &reduction), options, &part(0.0, SOFTEN))?;
    let mut survey = None;
    if report.inverted.is_empty() {
        let softened = soften(mesh, on, &mut holds, solid, options.max_distance, &part(SOFTEN, EVEN))?;
        let part = part(EVEN, APPROACH);
        let seen = survey.insert(Survey::new(mesh, &on.faces, solid));
        let came = even_and_near(mesh, on, &holds, seen, options.max_distance, &part)?;
        report.sweeps += softened + came.sweeps;
        report.apart = came.apart;
        (report.worst, report.mean) = quality(mesh);
        report.off = off(mesh, on, &holds, &OnSolid::new(solid, &on.reduction));
    }
    Ok((Fitted { report, holds }, survey))
}

#[cfg(test)]
fn fit_to(
    mesh: &mut HexMesh,
    on: &mut Correspondence,
    sheets: &mut SheetReport,
    target: &dyn Target,
    options: &FitOptions,
    monitor: &dyn Monitor,
) -> Result<FitReport, Cancelled> {
    Ok(fitted(mesh, on, sheets, target, options, monitor)?.0)
}

/// Fits to the target; what holds each node in the end is told too.
fn fitted(
    mesh: &mut HexMesh,
    on: &mut Correspondence,
    sheets: &mut SheetReport,
    target: &dyn Target,
    options: &FitOptions,
    monitor: &dyn Monitor,
) -> Result<(FitReport, Vec<Hold>), Cancelled> {
    let part = |from, to| Part { whole: monitor, stage: FITTING, range: [from, to] };
    monitor.checkpoint(FITTING, 0.0)?;
    let inflated = inflate(mesh, on, sheets, target, &part(0.0, PULL))?;
    let (mut problem, mut sweeps) = (inflated.problem, inflated.sweeps);
    let mut holds = Holds::drawn(target, &on.anchors);
    let chains = chains(on, target.solid(), |n| problem.place(n));
    // Corners first, then curves, surfaces, and the inside.
    problem.order_by(4, |n| on.anchors[n.index()].freedom());

    if is_exact(&problem, &holds, monitor)? {
        problem.nodes.iter().for_each(|&n| holds.replace(n, Hold::Drawn, Hold::Held));
    } else {
        let boundary: Vec<u32> = (0..problem.movable() as u32)
            .filter(|&n| holds.is(problem.nodes[n as usize], Hold::Drawn))
            .collect();
        let cells: Vec<usize> = problem.cells_around(&boundary).into_iter().map(|c| c as usize).collect();
        let mut awake = problem.rings_around(&cells, RINGS);
        let all = vec![true; problem.movable()];
        let course = Course { stage: FITTING, sweeps: options.sweeps, floor: FLOOR };
        sweeps += pull(&mut problem, &mut holds, &chains, &all, &mut awake, course, &part(PULL, SMOOTH))?;
        holds.weight = 0.0;
        sweeps += smooth(&mut problem, &holds, &options.smoothing, None, &part(SMOOTH, LOOSEN))?;
        sweeps += loosen(&mut problem, &mut holds, on, &options.smoothing, &part(LOOSEN, 1.0))?;
    }
    monitor.checkpoint(FITTING, 1.0)?;

    problem.write_back(&mut mesh.positions);
    let holds = holds.holds;
    let (worst, mean) = quality(mesh);
    let report = FitReport {
        taken_back: inflated.taken_back,
        sweeps,
        off: off(mesh, on, &holds, target),
        worst,
        mean,
        inverted: parallel::filter(problem.cells.len(), |cell| !problem.is_positive(cell))
            .into_iter()
            .map(HexId)
            .collect(),
        apart: f64::INFINITY,
    };
    Ok((report, holds))
}

/// Are all nodes where they belong, and no cells bad? Then nothing is to be done: what draws nodes to the solid would first move
/// them away, and those of walls far thinner than cells are long would hardly get back.
fn is_exact(problem: &Problem, holds: &Holds, monitor: &dyn Monitor) -> Result<bool, Cancelled> {
    let is_there = |n: usize| {
        let (id, place) = (problem.nodes[n], problem.points[n]);
        let foot = holds.target.foot(holds.anchors[id.index()], place);
        foot.is_none_or(|foot| foot.point.distance(place) <= THERE * problem.edge(n as u32))
    };
    for first in (0..problem.movable()).step_by(BATCH) {
        if monitor.cancelled() {
            return Err(Cancelled);
        }
        if !(first..problem.movable().min(first + BATCH)).all(is_there) {
            return Ok(false);
        }
    }
    Ok(problem.scaled_jacobians(monitor)?.into_iter().all(|jacobian| jacobian >= RIGHT))
}

/// Smooths all for the mean and brings mesh and solid nearer to each other; where they stay far from each other again, with
/// one course after the other, each of which counts if it brings them much nearer.
fn even_and_near(
    mesh: &mut HexMesh,
    on: &Correspondence,
    holds: &[Hold],
    survey: &mut Survey,
    max_distance: f64,
    monitor: &dyn Monitor,
) -> Result<Nearness, Cancelled> {
    let far = vec![true; mesh.positions.len()];
    let mut all = Nearness { sweeps: 0, at_first: f64::INFINITY, apart: f64::INFINITY, far };
    for (k, evening) in Evening::ALL.into_iter().enumerate() {
        let range = [k, k + 1].map(|k| k as f64 / Evening::ALL.len() as f64);
        let part = Part { whole: monitor, stage: FITTING, range };
        let terms = Terms { leave: 0.5 * max_distance, evening, enough: 0.0, fair: GOOD };
        let before = mesh.positions.clone();
        let mut came = course(mesh, on, holds, (&mut *survey, &all.far), terms, &part)?;
        came.sweeps += all.sweeps;
        if came.apart < NEARER * all.apart {
            all = came;
            widen(mesh, &mut all.far, AGAIN, monitor)?;
        } else {
            mesh.positions = before;
            all.sweeps = came.sweeps;
        }
        if !all.calls_for_more(survey.edge, survey.solid.diagonal()) {
            break;
        }
    }
    Ok(all)
}

/// Smooths the cells around the nodes that move for the mean, and brings mesh and solid nearer to each other.
fn course(
    mesh: &mut HexMesh,
    on: &Correspondence,
    holds: &[Hold],
    (survey, moves): (&mut Survey, &[bool]),
    terms: Terms,
    monitor: &dyn Monitor,
) -> Result<Nearness, Cancelled> {
    let part = |from, to| Part { whole: monitor, stage: FITTING, range: [from, to] };
    let solid = survey.solid;
    let sweeps = even(mesh, on, holds, solid, terms.evening, &|n| moves[n.index()], &part(0.0, NEAR))?;
    let came = near(mesh, on, holds, survey, terms, &part(NEAR, 1.0))?;
    Ok(Nearness { sweeps: sweeps + came.sweeps, ..came })
}

/// The least scaled Jacobian, if there is one, and the mean.
pub(super) fn quality(mesh: &HexMesh) -> (Option<f64>, f64) {
    let jacobians = parallel::collect(mesh.hexes.len(), |h| {
        scaled_jacobian(&mesh.hexes[h].map(|n| mesh.positions[n.index()]))
    });
    let mean = jacobians.iter().sum::<f64>() / jacobians.len().max(1) as f64;
    (jacobians.into_iter().reduce(f64::min), mean)
}

/// The nodes that are not where they belong, the farthest first.
fn off(mesh: &HexMesh, on: &Correspondence, holds: &[Hold], target: &dyn Target) -> Vec<OffNode> {
    let mut off = parallel::filter_map(mesh.positions.len(), |n| {
        let place = mesh.positions[n];
        let foot = target.foot(on.anchors[n], place)?;
        let off = OffNode { node: NodeId::new(n), place, distance: foot.point.distance(place) };
        holds[n].is_off().then_some(off)
    });
    parallel::put_greatest_first(&mut off, |off| off.distance);
    off
}

#[cfg(all(test, not(target_arch = "wasm32")))]
pub(super) mod testing;
#[cfg(test)]
mod tests;
