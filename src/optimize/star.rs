//! The cells around one node, gathered so that the node can be tried in many places.
//!
//! Four corners of each cell change with the node: the one where it is, and those at the other ends of the cell's edges
//! there, its spokes. Of the node's place v their determinants are affine functions; the lengths that change are those
//! of the spokes alone, which the cells share.

use super::energy::{Corner, Expansion, Weights};
use super::problem::Problem;
use super::symmetric::Symmetric;
use crate::geometry::Point;
use crate::mesh::numbering::hex::NEIGHBOURS;
use crate::mesh::quality::{Certainty, is_positive};

/// The cells that change when one node moves. Kept by each thread from node to node.
#[derive(Default)]
pub(crate) struct Star {
    spokes: Vec<Spoke>,
    cells: Vec<Cell>,
    /// Cells that are positive inside and have to stay so, and the node's place in each.
    guarded: Vec<([Point; 8], usize)>,
    /// The mean length of the spokes, each as often as there are cells at it.
    pub(crate) size: f64,
}

/// An edge of the node.
struct Spoke {
    /// The node at its other end, and where that is.
    node: u32,
    end: Point,
    /// From the end to where the node is tried, and the square of that length.
    arm: Point,
    square: f64,
    /// Two over that square, where derivatives are asked for.
    share: f64,
    /// How much of `arm` times its transpose there is in the second derivatives.
    outer: f64,
}

/// A cell at the node.
struct Cell {
    /// Its spokes, right-handed.
    spokes: [u8; 3],
    /// The gradient of the determinant at the node's corner, which is zero at the first spoke's end.
    slope: Point,
    /// The corners at the ends of the spokes.
    beside: [Beside; 3],
    /// The square of chi's eps.
    eps_squared: f64,
}

/// A corner at the end of a spoke.
#[derive(Clone, Copy)]
struct Beside {
    /// The gradient of the determinant, which is zero at the spoke's end.
    slope: Point,
    /// The sum and the product of the squares of the two other edges.
    sum: f64,
    product: f64,
}

/// For each corner and each of its neighbours the two others of that one's, right-handed with the corner itself.
const BEYOND: [[[u8; 2]; 3]; 8] = {
    let (mut all, mut k) = ([[[0; 2]; 3]; 8], 0);
    while k < 8 {
        let mut i = 0;
        while i < 3 {
            let turned = NEIGHBOURS[NEIGHBOURS[k][i] as usize];
            let mut place = 0;
            while turned[place] as usize != k {
                place += 1;
            }
            all[k][i] = [turned[(place + 1) % 3], turned[(place + 2) % 3]];
            i += 1;
        }
        k += 1;
    }
    all
};

/// How a star is with the node in some place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reading {
    pub(crate) energy: f64,
    /// The greatest r^2 of the corners that change: of the worst, one over the scaled Jacobian's square without eps.
    pub(crate) worst: f64,
}

impl Star {
    /// Looks at the cells around `node`; `eps` in units of each cell's volume.
    pub(crate) fn gather(&mut self, problem: &Problem, node: u32, eps: f64) {
        self.clear();
        let v = problem.points[node as usize];
        for (cell, k) in problem.star(node) {
            let points = problem.corners(cell);
            self.add(&problem.cells[cell], &points, k, eps * problem.volume[cell]);
            if problem.guarded[cell] && problem.positive[cell] {
                self.guarded.push((points, k));
            }
        }
        self.measure(v);
    }

    fn clear(&mut self) {
        self.spokes.clear();
        self.cells.clear();
        self.guarded.clear();
    }

    /// Adds a cell by its nodes and where they are; the star's node is at its corner `k`.
    fn add(&mut self, nodes: &[u32; 8], points: &[Point; 8], k: usize, eps: f64) {
        // Loops, since closures over arrays are not inlined here.
        let mut ends = [Point::ZERO; 3];
        let mut spokes = [0; 3];
        let mut beside = [Beside { slope: Point::ZERO, sum: 0.0, product: 0.0 }; 3];
        for i in 0..3 {
            let around = usize::from(NEIGHBOURS[k][i]);
            ends[i] = points[around];
            spokes[i] = self.spoke(nodes[around], ends[i]);
            let b = points[usize::from(BEYOND[k][i][0])] - ends[i];
            let c = points[usize::from(BEYOND[k][i][1])] - ends[i];
            let (b_square, c_square) = (b.length_squared(), c.length_squared());
            beside[i] = Beside { slope: b.cross(c), sum: b_square + c_square, product: b_square * c_square };
        }
        let slope = (ends[2] - ends[0]).cross(ends[1] - ends[0]);
        self.cells.push(Cell { spokes, slope, beside, eps_squared: eps * eps });
    }

    /// The place of the spoke to `node` among the spokes.
    fn spoke(&mut self, node: u32, end: Point) -> u8 {
        let place = self.spokes.iter().position(|spoke| spoke.node == node).unwrap_or_else(|| {
            self.spokes.push(Spoke { node, end, arm: Point::ZERO, square: 0.0, share: 0.0, outer: 0.0 });
            self.spokes.len() - 1
        });
        u8::try_from(place).expect("a node has fewer than 256 edges")
    }

    fn measure(&mut self, v: Point) {
        self.move_to(v);
        let spokes = self.cells.iter().flat_map(|cell| cell.spokes);
        let length: f64 = spokes.map(|s| self.spokes[usize::from(s)].square.sqrt()).sum();
        self.size = length / (3 * self.cells.len()).max(1) as f64;
    }

    #[inline]
    fn move_to(&mut self, v: Point) {
        for spoke in &mut self.spokes {
            spoke.arm = v - spoke.end;
            spoke.square = spoke.arm.length_squared();
            spoke.outer = 0.0;
        }
    }

    /// How the star is with the node at `v`; `None` as soon as the energy is seen to be above `limit` or infinite.
    pub(crate) fn read(&mut self, v: Point, weights: Weights, limit: f64) -> Option<Reading> {
        self.move_to(v);
        let mut all = Reading { energy: 0.0, worst: 0.0 };
        for cell in &self.cells {
            for corner in cell.corners(&self.spokes) {
                let (energy, angles_squared) = corner.energy(weights);
                all.energy += energy;
                all.worst = all.worst.max(angles_squared);
            }
            if all.energy.is_nan() || all.energy > limit {
                return None;
            }
        }
        all.energy.is_finite().then_some(all)
    }

    /// The energy and its derivatives with the node at `v`, and the worst r^2 as in [`Reading`]; `None` where the
    /// energy is infinite.
    pub(crate) fn expand(&mut self, v: Point, weights: Weights) -> Option<(Expansion, f64)> {
        self.move_to(v);
        self.spokes.iter_mut().for_each(|spoke| spoke.share = 2.0 / spoke.square);
        let (n, mut worst) = (weights.power(), 0.0_f64);
        let Expansion { mut value, mut gradient, mut hessian } = Expansion::default();
        let mut diagonal = 0.0;
        for cell in &self.cells {
            let [here, beside @ ..] = cell.corners(&self.spokes);
            let at_node = here.factors(weights)?;
            value += at_node.value;
            worst = worst.max(at_node.angles_squared);
            // With q the mean square: q' / q, and the product's gradient over the product.
            let mut of_square = Point::ZERO;
            let mut of_product = Point::ZERO;
            for s in cell.spokes {
                let spoke = &mut self.spokes[usize::from(s)];
                let share = spoke.share;
                of_square += spoke.arm;
                of_product += spoke.arm * share;
                spoke.outer -= at_node.angles * share * share;
                diagonal += at_node.angles * share;
            }
            of_square *= 2.0 / (3.0 * here.mean_square);
            let of_chi = cell.slope * at_node.slope;
            let (shape, angles) = (of_square * 3.0 + of_chi, of_product + of_chi);
            gradient += shape * at_node.shape + angles * at_node.angles;
            diagonal += at_node.shape * 6.0 / here.mean_square;
            hessian += Symmetric::outer(cell.slope) * ((at_node.shape + at_node.angles) * at_node.bend)
                + Symmetric::outer(shape) * (n * at_node.shape)
                + Symmetric::outer(angles) * (n * at_node.angles)
                + Symmetric::outer(of_square) * (-3.0 * at_node.shape);

            for ((corner, s), Beside { slope, .. }) in beside.into_iter().zip(cell.spokes).zip(cell.beside) {
                let at_end = corner.factors(weights)?;
                value += at_end.value;
                worst = worst.max(at_end.angles_squared);
                let spoke = &mut self.spokes[usize::from(s)];
                // Both gradients are a multiple of the arm and one of the slope.
                let (of_square, of_product) = (2.0 / corner.mean_square, spoke.share);
                let both = at_end.shape + at_end.angles;
                let along = at_end.shape * of_square + at_end.angles * of_product;
                gradient += spoke.arm * along + slope * (at_end.slope * both);
                diagonal += along;
                spoke.outer += (n - 1.0 / 3.0) * at_end.shape * of_square * of_square
                    + (n - 1.0) * at_end.angles * of_product * of_product;
                hessian += Symmetric::outer(slope) * (both * (at_end.bend + n * at_end.slope * at_end.slope))
                    + Symmetric::mixed(spoke.arm, slope) * (n * at_end.slope * along);
            }
        }
        for spoke in &self.spokes {
            hessian += Symmetric::outer(spoke.arm) * spoke.outer;
        }
        hessian += Symmetric::IDENTITY * diagonal;
        value.is_finite().then_some((Expansion { value, gradient, hessian }, worst))
    }

    /// Do all guarded cells stay positive with the node at `v`?
    pub(crate) fn stays_positive(&mut self, v: Point) -> bool {
        self.guarded.iter_mut().all(|(points, k)| {
            points[*k] = v;
            is_positive(points) == Certainty::Positive
        })
    }
}

impl Cell {
    /// The node's corner, then those at the ends of the spokes.
    #[inline]
    fn corners(&self, spokes: &[Spoke]) -> [Corner; 4] {
        let eps_squared = self.eps_squared;
        let [a, b, c] = self.spokes.map(|s| &spokes[usize::from(s)]);
        let beside = |at: Beside, spoke: &Spoke| Corner {
            determinant: spoke.arm.dot(at.slope),
            mean_square: (spoke.square + at.sum) / 3.0,
            product: spoke.square * at.product,
            eps_squared,
        };
        let at_node = Corner {
            determinant: a.arm.dot(self.slope),
            mean_square: (a.square + b.square + c.square) / 3.0,
            product: a.square * b.square * c.square,
            eps_squared,
        };
        [at_node, beside(self.beside[0], a), beside(self.beside[1], b), beside(self.beside[2], c)]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::numbering::hex::CORNERS;
    use crate::mesh::quality::scaled_jacobian;

    /// Two distorted cells that share the face of the nodes 0, 3, 7, 4, of which node 0 is the star's.
    fn star(eps: f64) -> (Star, [[Point; 8]; 2], [usize; 2]) {
        let bend = |p: Point| p + Point::new(0.2 * p.y * p.z, 0.1 * p.x - 0.15 * p.z, 0.1 * p.x * p.y);
        let right = CORNERS.map(|c| bend(Point::from(c.map(f64::from))));
        let left = CORNERS.map(|c| bend(Point::from(c.map(f64::from)) - Point::X));
        let mut star = Star::default();
        star.add(&[0, 1, 2, 3, 4, 5, 6, 7], &right, 0, eps);
        star.add(&[8, 0, 3, 9, 10, 4, 7, 11], &left, 1, eps);
        star.measure(right[0]);
        (star, [right, left], [0, 1])
    }

    const NODES: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [0.2, 0.1, -0.2], [0.3, 0.6, 0.4], [0.7, 1.4, 1.5]];

    #[test]
    fn cells_share_spokes() {
        let (star, ..) = star(0.0);
        assert_eq!(star.spokes.iter().map(|s| s.node).collect::<Vec<_>>(), [1, 3, 4, 8]);
        assert!((star.size - 1.0).abs() < 0.1, "{}", star.size);
    }

    /// The worst is that of the corners that change, as the quality of the cells tells it.
    #[test]
    fn the_worst_is_that_of_the_cells() {
        let (mut star, mut cells, places) = star(0.0);
        let v = Point::new(0.3, 0.25, 0.2);
        for (cell, k) in cells.iter_mut().zip(places) {
            cell[k] = v;
        }
        let least = cells.iter().map(scaled_jacobian).fold(f64::INFINITY, f64::min);
        let reading = star.read(v, Weights { doublings: 1, mu: 0.5 }, f64::INFINITY).unwrap();
        assert!((1.0 / reading.worst.sqrt() - least).abs() < 1e-12, "{reading:?} {least}");
        assert!(star.read(v, Weights { doublings: 1, mu: 0.5 }, reading.energy * 0.99).is_none());
        assert!(star.read(Point::splat(3.0), Weights { doublings: 0, mu: 0.0 }, f64::INFINITY).is_none());
    }

    /// Derivatives against central differences, for positive and inverted corners.
    #[test]
    fn derivatives_are_those_of_finite_differences() {
        let (mut star, ..) = star(0.4);
        let mut inverted = 0;
        for (doublings, mu) in [(0, 0.0), (0, 1.0), (1, 0.0), (1, 0.3), (2, 0.9), (3, 1.0)] {
            let weights = Weights { doublings, mu };
            for v in NODES.map(Point::from) {
                let (here, worst) = star.expand(v, weights).unwrap();
                let corners = star.cells.iter().flat_map(|cell| cell.corners(&star.spokes));
                inverted += corners.filter(|corner| corner.determinant < 0.0).count();
                let mut read = |v: Point| star.read(v, weights, f64::INFINITY).unwrap();
                assert!((here.value / read(v).energy - 1.0).abs() < 1e-12);
                assert!((worst / read(v).worst - 1.0).abs() < 1e-12);
                let h = 1e-6;
                for axis in [Point::X, Point::Y, Point::Z] {
                    let slope = (read(v + axis * h).energy - read(v - axis * h).energy) / (2.0 * h);
                    let scale = here.value + here.gradient.length();
                    assert!((slope - here.gradient.dot(axis)).abs() < 1e-6 * scale, "{weights:?} {v}");
                }
                for axis in [Point::X, Point::Y, Point::Z] {
                    let mut gradient = |v: Point| star.expand(v, weights).unwrap().0.gradient;
                    let bend = (gradient(v + axis * h) - gradient(v - axis * h)) / (2.0 * h);
                    let scale = here.gradient.length() + here.hessian.trace().abs();
                    assert!(bend.distance(here.hessian.times(axis)) < 1e-6 * scale, "{weights:?} {v}");
                }
            }
        }
        assert!(inverted > 0);
    }
}
