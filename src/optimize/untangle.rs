//! Pushes cells open until all are positive.
//!
//! 1. The nodes of cells that are not positive may move, and those up to some rings around.
//! 2. Rounds with the regularised energy, whose eps follows the least determinant: large while there are deeply
//!    inverted corners, then small.
//! 3. Where that does not get on, more rings may move, and at last the cells left are given up.

use super::energy::Weights;
use super::guide::Guide;
use super::problem::Problem;
use super::sweep::{ASLEEP, Rules, sweep};
use super::{OptimizeOptions, UNTANGLING};
use crate::mesh::numbering::hex::NEIGHBOURS;
use crate::{Cancelled, Monitor, Silent, parallel};

/// Rings of cells around those that are not positive whose nodes move, at first.
const RINGS: usize = 2;

/// Rounds between two looks at which cells are not positive yet.
const ROUNDS: usize = 4;

/// Looks in a row that find no fewer cells than before until the rest is given up.
const PATIENCE: usize = 6;

/// eps^2 is `SMALL` and this share of the least determinant's square.
const DEPTH: f64 = 0.04;
const SMALL: f64 = 1e-8;

const SHAPE: Weights = Weights { doublings: 0, mu: 0.0 };

/// Returns the number of rounds made.
pub(crate) fn untangle(
    problem: &mut Problem,
    guide: &dyn Guide,
    options: &OptimizeOptions,
    monitor: &dyn Monitor,
) -> Result<usize, Cancelled> {
    let mut rings = RINGS;
    let mut done = 0;
    let (mut fewest, mut in_vain) = (usize::MAX, 0);
    while done < options.untangle_sweeps {
        monitor.checkpoint(UNTANGLING, done as f64 / options.untangle_sweeps as f64)?;
        let tangled: Vec<usize> = (0..problem.cells.len()).filter(|&c| !problem.positive[c]).collect();
        in_vain = if tangled.len() < fewest { 0 } else { in_vain + 1 };
        if tangled.is_empty() || in_vain > PATIENCE {
            break;
        }
        rings += usize::from(in_vain > 0);
        fewest = fewest.min(tangled.len());
        let allowed = problem.rings_within(&tangled, rings, monitor)?;
        let mut awake = allowed.clone();
        for _ in 0..ROUNDS {
            let least = least_determinant(problem, &tangled).min(0.0);
            let eps = (SMALL + DEPTH * least * least).sqrt();
            let rules = Rules { guide, weights: SHAPE, eps, floor: None, asleep: ASLEEP };
            sweep(problem, rules, &allowed, &mut awake, monitor)?;
            // The energy changes with eps.
            awake.clone_from(&allowed);
            done += 1;
        }
        problem.find_positive();
    }
    monitor.checkpoint(UNTANGLING, 1.0)?;
    Ok(done)
}

/// The least determinant of the cells' corners, in units of their volumes.
fn least_determinant(problem: &Problem, cells: &[usize]) -> f64 {
    let of_cell = |&cell: &usize| {
        let points = problem.corners(cell);
        let at_corner = |k: usize| {
            let [a, b, c] = NEIGHBOURS[k].map(|end| points[usize::from(end)] - points[k]);
            a.dot(b.cross(c))
        };
        (0..8).map(at_corner).fold(f64::INFINITY, f64::min) / problem.volume[cell]
    };
    cells.iter().map(of_cell).fold(f64::INFINITY, f64::min)
}

impl Problem {
    /// The movable nodes of the cells, and of `rings` rings of cells around them.
    pub(crate) fn rings_around(&self, cells: &[usize], rings: usize) -> Vec<bool> {
        self.rings_within(cells, rings, &Silent).expect("nobody stops it")
    }

    /// As [`Problem::rings_around`], unless the monitor stops it.
    pub(crate) fn rings_within(
        &self,
        cells: &[usize],
        rings: usize,
        monitor: &dyn Monitor,
    ) -> Result<Vec<bool>, Cancelled> {
        monitor.proceed()?;
        let nodes_of = |cell: usize| self.cells[cell].map(|n| n as usize);
        let mut reached = parallel::flags(self.nodes.len(), cells.len(), |k| nodes_of(cells[k]));
        for _ in 0..rings {
            // Only movable nodes know the cells around them, and lead on.
            let is_at = |cell: usize| nodes_of(cell).iter().any(|&n| n < self.movable() && reached[n]);
            let ring = parallel::try_filter(self.cells.len(), monitor, is_at)?;
            parallel::raise(&mut reached, ring.len(), |k| nodes_of(ring[k] as usize));
        }
        reached.truncate(self.movable());
        Ok(reached)
    }
}
