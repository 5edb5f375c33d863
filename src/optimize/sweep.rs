//! One round over nodes: each is moved to where the energy around it is lower, if that keeps what is to be kept.

use std::ops::Range;

use super::ahead::read_ahead;
use super::energy::{Expansion, Weights};
use super::guide::{Guide, Pull};
use super::problem::Problem;
use super::star::{Reading, Star};
use super::symmetric::Symmetric;
use crate::geometry::Point;
use crate::parallel::{self, Flags};
use crate::{Cancelled, Monitor};

/// Nodes that are moved before it is asked whether to stop.
const BATCH: usize = 512;

/// Nodes that are awake and swept before the next, all of their colours: what they and the cells around them take stays in a
/// processor's cache from colour to colour.
const BLOCK: usize = 1 << 12;

/// A step at most this share of the node's mean edge.
const LONGEST: f64 = 0.5;

/// A step below this share of the node's mean edge wakes no neighbours, where cells are smoothed.
pub(crate) const ASLEEP: f64 = 5e-3;

/// The first step tried, in units of Newton's: what one node gains by the longer step is little less, and what is to
/// wander through many nodes, such as the thickness of a layer, gets there in half the rounds. A node that is drawn would
/// swing about its goal.
const OVERRELAXATION: f64 = 1.8;

/// How often a step is halved before the node stays.
const HALVINGS: usize = 6;

/// What a round lowers and what it keeps.
#[derive(Clone, Copy)]
pub(crate) struct Rules<'a> {
    pub(crate) guide: &'a dyn Guide,
    pub(crate) weights: Weights,
    /// Of chi, in units of the cells' volumes.
    pub(crate) eps: f64,
    /// The least scaled Jacobian around a node may fall, but not below this, and flat cells count as if theirs were less
    /// (`energy`); any, where there is none. Positive cells stay positive where there is one.
    pub(crate) floor: Option<f64>,
    /// A step below this share of the node's mean edge wakes no neighbours.
    pub(crate) asleep: f64,
}

/// Moves the nodes that are `awake`, colour by colour, in blocks. A node falls asleep when it hardly moves, and wakes its
/// neighbours among the `allowed` when it does. The nodes that moved, and how many of them far.
pub(crate) fn sweep(
    problem: &mut Problem,
    rules: Rules,
    allowed: &[bool],
    awake: &mut [bool],
    monitor: &dyn Monitor,
) -> Result<Moved, Cancelled> {
    let mut moved = Moved::of(awake.iter().filter(|&&awake| awake).count());
    for (colour, places) in parts(problem, awake) {
        let part = problem.colours[colour][places].iter().copied();
        let nodes: Vec<u32> = part.filter(|&n| awake[n as usize]).collect();
        for batch in nodes.chunks(BATCH) {
            if monitor.cancelled() {
                return Err(Cancelled);
            }
            let step = |star: &mut Star, k: usize, awake: &Flags| {
                read_ahead(problem, batch, k);
                let step = relaxed(problem, batch[k], rules, star);
                if let Some(Step { far: true, .. }) = step {
                    wake_around(problem, batch[k], allowed, awake);
                }
                step
            };
            let found = parallel::collect_raising(awake, batch.len(), Star::default, step);
            for (&node, step) in batch.iter().zip(found) {
                let is_far = matches!(step, Some(Step { far: true, .. }));
                awake[node as usize] = is_far && allowed[node as usize];
                let Some(Step { to, .. }) = step else { continue };
                moved.take(problem, node, to);
                moved.far += usize::from(is_far);
            }
        }
    }
    Ok(moved)
}

/// The parts of the colours, in the order of a round: of each block of nodes one of each colour.
fn parts(problem: &Problem, awake: &[bool]) -> Vec<(usize, Range<usize>)> {
    let is_awake = (0u32..).zip(awake).filter(|&(_, &awake)| awake).map(|(node, _)| node);
    let mut bounds: Vec<u32> = is_awake.step_by(BLOCK).collect();
    bounds.push(problem.movable() as u32);
    let mut parts = Vec::new();
    for block in bounds.windows(2) {
        for (colour, nodes) in problem.colours.iter().enumerate() {
            let place = |bound: u32| nodes.partition_point(|&n| n < bound);
            let places = place(block[0])..place(block[1]);
            parts.extend((!places.is_empty()).then_some((colour, places)));
        }
    }
    parts
}

/// What a round did.
#[derive(Debug, Default, PartialEq)]
pub(crate) struct Moved {
    pub(crate) nodes: Vec<u32>,
    /// Where each of them was.
    from: Vec<Point>,
    /// How many of the nodes moved so far that it matters to their neighbours.
    pub(crate) far: usize,
}

impl Moved {
    /// Nothing yet, with room for so many nodes.
    fn of(count: usize) -> Self {
        Self { nodes: Vec::with_capacity(count), from: Vec::with_capacity(count), far: 0 }
    }

    /// Takes a node to another place; it was not moved before.
    pub(crate) fn take(&mut self, problem: &mut Problem, node: u32, to: Point) {
        self.nodes.push(node);
        self.from.push(std::mem::replace(&mut problem.points[node as usize], to));
    }

    /// Takes all of them back.
    pub(super) fn take_back(self, problem: &mut Problem) {
        for (node, from) in self.nodes.into_iter().zip(self.from) {
            problem.points[node as usize] = from;
        }
    }
}

/// Wakes the nodes and those that share a cell with one of them.
pub(crate) fn wake(problem: &Problem, nodes: &[u32], allowed: &[bool], awake: &mut [bool]) {
    parallel::raise_some(awake, nodes.len(), |k, awake| wake_around(problem, nodes[k], allowed, awake));
}

fn wake_around(problem: &Problem, node: u32, allowed: &[bool], awake: &Flags) {
    for (cell, _) in problem.star(node) {
        for other in problem.cells[cell] {
            if allowed.get(other as usize) == Some(&true) {
                awake.raise(other as usize);
            }
        }
    }
}

/// Where a node goes, and whether that is far enough to matter to its neighbours.
struct Step {
    to: Point,
    far: bool,
}

/// A place for the node with less energy, found by Newton's step, its halves, and the doubles of short ones; `None` to
/// stay.
fn relaxed(problem: &Problem, node: u32, rules: Rules, star: &mut Star) -> Option<Step> {
    star.gather(problem, node, rules.eps);
    let from = problem.points[node as usize];
    let (mut here, worst) = star.expand(from, rules.weights)?;
    let id = problem.nodes[node as usize];
    let size = star.size;
    let pull = rules.guide.pull(id, from, size);
    if let Some(pull) = pull {
        here.draw(pull, from);
    }
    let step = newton(here, rules.guide.tangent(id, from), size)?;
    let kept = rules.floor.map(|floor| worst_kept(worst, floor));
    let at = |share: f64| rules.guide.project(id, from + step * share);
    let mut lowered = |to: Point, limit: f64| {
        let drawn = pull.map_or(0.0, |pull| pull.energy(to));
        let Reading { energy, worst } = star.read(to, rules.weights, limit - drawn)?;
        let energy = energy + drawn;
        let keeps = |kept: f64| worst <= kept && star.stays_positive(to);
        (energy < limit && kept.is_none_or(keeps)).then_some(energy)
    };
    let mut share = if pull.is_some() { 1.0 } else { OVERRELAXATION };
    let mut to = at(share);
    let mut best = lowered(to, here.value);
    for _ in 1..HALVINGS {
        if best.is_some() {
            break;
        }
        share *= 0.5;
        to = at(share);
        best = lowered(to, here.value);
    }
    let mut energy = best?;
    // Where a cell has next to no volume the energy is so steep that Newton's steps hardly move.
    while to.distance(from) <= ASLEEP * size {
        share *= 2.0;
        let farther = at(share);
        let Some(lower) = lowered(farther, energy) else { break };
        (to, energy) = (farther, lower);
    }
    Some(Step { to, far: to.distance(from) > rules.asleep * size })
}

/// The greatest distortion that a node's corners may have, of which the greatest is `worst`: the scaled Jacobian may fall,
/// but not below the floor, nor may corners get flatter than those of that scaled Jacobian count. A little less than that,
/// so that no rounding lowers the worst of all.
pub(crate) fn worst_kept(worst: f64, floor: f64) -> f64 {
    let at_floor = if floor > 0.0 { 1.0 / (floor * floor) } else { f64::INFINITY };
    worst.max(at_floor) * (1.0 - 1e-12)
}

impl Expansion {
    /// Adds what draws the node at `p`.
    fn draw(&mut self, pull: Pull, p: Point) {
        self.value += pull.energy(p);
        self.gradient += pull.half_gradient(p) * 2.0;
        self.hessian += pull.weight * 2.0;
    }
}

/// Newton's step within the tangent space; where the energy is not convex, with as much of the identity added as
/// makes it so.
fn newton(energy: Expansion, tangent: Symmetric, size: f64) -> Option<Point> {
    let scale = energy.hessian.diagonal.abs().element_sum();
    let (gradient, hessian) = if tangent == Symmetric::IDENTITY {
        (energy.gradient, energy.hessian)
    } else {
        // Directions out of the tangent space get the identity, and the gradient has no part in them.
        let outside = (Symmetric::IDENTITY + tangent * -1.0) * scale;
        (tangent.times(energy.gradient), energy.hessian.between(tangent) + outside)
    };
    let mut added = 0.0;
    for _ in 0..8 {
        let matrix = hessian + Symmetric::IDENTITY * (added * scale);
        if let Some(step) = matrix.solve(-gradient) {
            let length = step.length();
            let longest = LONGEST * size;
            return (length > 0.0 && length.is_finite())
                .then(|| if length > longest { step * (longest / length) } else { step });
        }
        added = if added == 0.0 { 1e-3 } else { added * 4.0 };
    }
    None
}

#[cfg(test)]
mod tests {
    use super::super::guide::DrawnTo;
    use super::*;
    use crate::Silent;
    use crate::geometry::Aabb;
    use crate::mesh::quality::aspect;
    use crate::mesh::{GridOptions, NodeId, hex_grid};

    /// Of two layers of cubes the nodes between are drawn to the bottom, with an energy that sees angles alone: those stay
    /// right, however flat the lower layer gets.
    #[test]
    fn cells_get_no_flatter_than_the_floor_allows() {
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 100 };
        let mesh = hex_grid(Aabb { min: Point::ZERO, max: Point::new(3.0, 3.0, 2.0) }, &options).unwrap();
        let to_plane = DrawnTo(|p| p.with_z(0.0), 100.0);
        let flattest = |floor: Option<f64>| {
            let is_between = |n: NodeId| mesh.positions[n.index()].z == 1.0;
            let mut problem = Problem::new(&mesh.positions, &mesh.hexes, &is_between);
            let weights = Weights { doublings: 0, mu: 1.0 };
            let rules = Rules { guide: &to_plane, weights, eps: 0.0, floor, asleep: ASLEEP };
            for _ in 0..40 {
                let mut awake = vec![true; problem.movable()];
                sweep(&mut problem, rules, &awake.clone(), &mut awake, &Silent).unwrap();
            }
            (0..problem.cells.len()).map(|cell| aspect(&problem.corners(cell))).fold(0.0, f64::max)
        };
        // The scaled Jacobian that a box 1 by 1 by h counts as is 8.2 h.
        for (floor, allowed) in
            [(None, 100.0..f64::INFINITY), (Some(0.2), 30.0..42.0), (Some(0.4), 15.0..21.0)]
        {
            assert!(allowed.contains(&flattest(floor)), "{floor:?}: {}", flattest(floor));
        }
    }

    #[test]
    fn a_block_has_so_many_nodes_that_are_awake() {
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 10_000 };
        let mesh = hex_grid(Aabb { min: Point::ZERO, max: Point::splat(21.0) }, &options).unwrap();
        let problem = Problem::new(&mesh.positions, &mesh.hexes, &|_| true);
        let nodes = problem.movable();
        assert!(2 * BLOCK < nodes && nodes < 3 * BLOCK);
        for (one_in, expected) in [(1, 3), (2, 2), (3, 1)] {
            let awake: Vec<bool> = (0..nodes).map(|n| n.is_multiple_of(one_in)).collect();
            let (mut blocks, mut swept): (Vec<Vec<u32>>, Vec<u32>) = (Vec::new(), Vec::new());
            let mut last = problem.colours.len();
            for (colour, places) in parts(&problem, &awake) {
                if colour <= last {
                    blocks.push(Vec::new());
                }
                last = colour;
                let part = &problem.colours[colour][places];
                let mut cells: Vec<usize> =
                    part.iter().flat_map(|&n| problem.star(n).map(|(cell, _)| cell)).collect();
                let all = cells.len();
                cells.sort_unstable();
                cells.dedup();
                assert_eq!(cells.len(), all, "two of a part share a cell");
                blocks.last_mut().unwrap().extend(part.iter().filter(|&&n| awake[n as usize]));
                swept.extend(part.iter().filter(|&&n| awake[n as usize]));
            }
            assert_eq!(blocks.len(), expected);
            let (last, whole) = blocks.split_last().unwrap();
            assert!(whole.iter().all(|block| block.len() == BLOCK) && last.len() <= BLOCK);
            assert!(blocks.is_sorted_by(|a, b| a.iter().max() < b.iter().min()));
            swept.sort_unstable();
            assert!(swept.into_iter().eq((0..nodes as u32).filter(|&n| awake[n as usize])));
        }
    }
}
