//! The cells around one node, gathered so that the node can be tried in many places.
//!
//! Four corners of each cell change with the node: the one where it is, and those at the other ends of the cell's edges
//! there, its spokes. Of the node's place v their determinants are affine functions; the lengths that change are those
//! of the spokes alone. Four cells are looked at side by side (`lanes`).

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, dispatch, f64x4, mask64x4};

use super::energy::{Corners, Energy, Expansion, Weights};
use super::problem::Problem;
use super::symmetric::{Matrices, Symmetric};
use crate::geometry::Point;
use crate::geometry::lanes::{LANES, Number, Row, Rows, Vectors, level, sum};
use crate::mesh::numbering::hex::{CORNER_AT, NEIGHBOURS};
use crate::mesh::quality::{Certainty, is_positive};

/// The cells that change when one node moves. Kept by each thread from node to node.
pub(crate) struct Star {
    level: Level,
    /// The cells, and maybe some of an earlier star.
    cells: Vec<Cells>,
    /// How many cells there are.
    count: usize,
    /// Is there an eps?
    is_regularised: bool,
    /// Cells that are positive inside and have to stay so, and the node's place in each.
    guarded: Vec<([Point; 8], usize)>,
    /// The mean length of the spokes, each as often as there are cells at it.
    pub(crate) size: f64,
}

/// Four cells at the node. Where there are fewer the first is there again, and counts nothing.
#[derive(Default)]
struct Cells {
    /// The ends of the spokes.
    ends: [Rows; 3],
    /// The square of chi's eps.
    eps_squared: Row,
    /// 1, or 0 for a cell that is there again.
    weight: Row,
    /// The gradient of the determinant at the node's corner, which is zero at the first spoke's end.
    slope: Rows,
    /// The corners at the ends of the spokes.
    beside: [Beside; 3],
}

/// The corners at the ends of a spoke of four cells.
#[derive(Clone, Copy, Default)]
struct Beside {
    /// The gradient of the determinant, which is zero at the spoke's end.
    slope: Rows,
    /// The sum and the product of the squares of the two other edges.
    sum: Row,
    product: Row,
}

/// For each corner the ends of its spokes, right-handed, then the corners across the faces that are between the second
/// spoke and the third, the third and the first, the first and the second.
const AROUND: [[u8; 6]; 8] = {
    let (mut all, mut k) = ([[0; 6]; 8], 0);
    while k < 8 {
        let mut i = 0;
        while i < 3 {
            let [one, other] = [NEIGHBOURS[k][(i + 1) % 3], NEIGHBOURS[k][(i + 2) % 3]];
            let across = CORNER_AT[k] ^ CORNER_AT[one as usize] ^ CORNER_AT[other as usize];
            all[k][i] = NEIGHBOURS[k][i];
            all[k][3 + i] = CORNER_AT[across as usize];
            i += 1;
        }
        k += 1;
    }
    all
};

/// The weights of one cell to four.
const WEIGHTS: [Row; LANES] =
    [[1.0, 0.0, 0.0, 0.0], [1.0, 1.0, 0.0, 0.0], [1.0, 1.0, 1.0, 0.0], [1.0, 1.0, 1.0, 1.0]];

/// How a star is with the node in some place.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Reading {
    pub(crate) energy: f64,
    /// The greatest distortion of the corners that change: of the worst, one over the scaled Jacobian's square without eps,
    /// if it is not flat.
    pub(crate) worst: f64,
}

impl Default for Star {
    fn default() -> Self {
        Self::with(level())
    }
}

impl Star {
    fn with(level: Level) -> Self {
        Self { level, cells: Vec::new(), count: 0, is_regularised: false, guarded: Vec::new(), size: 0.0 }
    }

    /// Looks at the cells around `node`; `eps` in units of each cell's volume.
    pub(crate) fn gather(&mut self, problem: &Problem, node: u32, eps: f64) {
        self.guarded.clear();
        for (cell, k) in problem.star(node) {
            if problem.guarded[cell] && problem.positive[cell] {
                self.guarded.push((problem.corners(cell), k));
            }
        }
        self.is_regularised = eps != 0.0;
        let corner = |place: u32, corner: u8| {
            problem.points[problem.cells[place as usize / 8][usize::from(corner)] as usize]
        };
        let eps = |place: u32| eps * problem.volume[place as usize / 8];
        self.take(problem.points[node as usize], problem.uses(node), eps, corner);
    }

    /// Takes the cells of these `uses` of the node, which is at `v`; each is eight times a cell, and the node's corner.
    #[inline]
    fn take(&mut self, v: Point, uses: &[u32], eps: impl Fn(u32) -> f64, corner: impl Fn(u32, u8) -> Point) {
        self.count = uses.len();
        if self.cells.len() < uses.len().div_ceil(LANES) {
            self.cells.resize_with(uses.len().div_ceil(LANES), Cells::default);
        }
        let cells = &mut self.cells;
        let length = dispatch!(self.level, simd => taken(simd, cells, v, uses, &eps, &corner));
        self.size = length / (3 * self.count).max(1) as f64;
    }

    /// The cells that were taken.
    fn used(&self) -> &[Cells] {
        &self.cells[..self.count.div_ceil(LANES)]
    }

    /// How the star is with the node at `v`; `None` as soon as the energy is seen to be above `limit` or infinite.
    pub(crate) fn read(&self, v: Point, weights: Weights, limit: f64) -> Option<Reading> {
        dispatch!(self.level, simd => read(simd, self, v, weights, limit))
    }

    /// The energy and its derivatives with the node at `v`, and the worst distortion as in [`Reading`]; `None` where
    /// the energy is infinite.
    pub(crate) fn expand(&self, v: Point, weights: Weights) -> Option<(Expansion, f64)> {
        dispatch!(self.level, simd => expanded(simd, self, v, weights))
    }

    /// Do all guarded cells stay positive with the node at `v`?
    pub(crate) fn stays_positive(&mut self, v: Point) -> bool {
        self.guarded.iter_mut().all(|(points, k)| {
            points[*k] = v;
            is_positive(points) == Certainty::Positive
        })
    }
}

/// Four cells with the node in some place.
struct Placed<S: Simd> {
    /// From the ends of the spokes to the node, and the squares of their lengths.
    arms: [Vectors<f64x4<S>>; 3],
    squares: [f64x4<S>; 3],
    weight: f64x4<S>,
    eps_squared: Option<f64x4<S>>,
}

impl<S: Simd> Placed<S> {
    #[inline(always)]
    fn new(simd: S, cells: &Cells, v: Vectors<f64x4<S>>, is_regularised: bool) -> Self {
        let arm = |i: usize| v - Vectors::load(simd, &cells.ends[i]);
        let arms = [arm(0), arm(1), arm(2)];
        Self {
            arms,
            squares: [arms[0].length_squared(), arms[1].length_squared(), arms[2].length_squared()],
            weight: f64x4::load_array_ref(simd, &cells.weight),
            eps_squared: is_regularised.then(|| f64x4::load_array_ref(simd, &cells.eps_squared)),
        }
    }

    /// The energies at the node's corners.
    #[inline(always)]
    fn at_node(&self, slope: Vectors<f64x4<S>>, weights: Weights) -> (Energy<S>, f64x4<S>) {
        let [a, b, c] = self.squares;
        let mean_square = (a + b + c) * (1.0 / 3.0);
        let corners = Corners {
            determinant: self.arms[0].dot(slope),
            mean_square,
            product: a * b * c,
            eps_squared: self.eps_squared,
        };
        (corners.energy(weights), mean_square)
    }

    /// The energies at the corners beside, at the ends of the spokes `i`.
    #[inline(always)]
    fn at_end(
        &self,
        simd: S,
        i: usize,
        beside: &Beside,
        slope: Vectors<f64x4<S>>,
        weights: Weights,
    ) -> (Energy<S>, f64x4<S>) {
        let square = self.squares[i];
        let mean_square = (square + f64x4::load_array_ref(simd, &beside.sum)) * (1.0 / 3.0);
        let corners = Corners {
            determinant: self.arms[i].dot(slope),
            mean_square,
            product: square * f64x4::load_array_ref(simd, &beside.product),
            eps_squared: self.eps_squared,
        };
        (corners.energy(weights), mean_square)
    }
}

/// Fills in cells, and all that does not change with the node. The sum of the spokes' lengths.
#[inline(always)]
fn taken<S: Simd>(
    simd: S,
    all: &mut [Cells],
    v: Point,
    uses: &[u32],
    eps: &impl Fn(u32) -> f64,
    corner: &impl Fn(u32, u8) -> Point,
) -> f64 {
    let v = Vectors::splat(simd, v.to_array());
    let mut lengths = f64x4::splat(simd, 0.0);
    for (cells, four) in all.iter_mut().zip(uses.chunks(LANES)) {
        // What is left over of the last four is the first of these, without weight.
        let lane = |k: usize| four.get(k).copied().unwrap_or(four[0]);
        let [a, b, c, d] = [lane(0), lane(1), lane(2), lane(3)];
        let around = [
            &AROUND[a as usize % 8],
            &AROUND[b as usize % 8],
            &AROUND[c as usize % 8],
            &AROUND[d as usize % 8],
        ];
        let mut corners = [v; 6];
        for (i, at) in corners.iter_mut().enumerate() {
            let [a, b] = [corner(a, around[0][i]), corner(b, around[1][i])];
            *at = Vectors::of(simd, [a, b, corner(c, around[2][i]), corner(d, around[3][i])]);
        }
        let [eps_a, eps_b, eps_c, eps_d] = [eps(a), eps(b), eps(c), eps(d)];
        cells.eps_squared = [eps_a * eps_a, eps_b * eps_b, eps_c * eps_c, eps_d * eps_d];
        cells.weight = WEIGHTS[four.len() - 1];
        let weight = f64x4::load_array_ref(simd, &cells.weight);
        for i in 0..3 {
            let end = corners[i];
            end.store_in(&mut cells.ends[i]);
            lengths += (v - end).length_squared().sqrt() * weight;
            let (b, c) = (corners[3 + (i + 1) % 3] - end, corners[3 + (i + 2) % 3] - end);
            let (b_square, c_square) = (b.length_squared(), c.length_squared());
            cells.beside[i] = Beside {
                slope: b.cross(c).store(),
                sum: (b_square + c_square).to_array(),
                product: (b_square * c_square).to_array(),
            };
        }
        cells.slope = (corners[2] - corners[0]).cross(corners[1] - corners[0]).store();
    }
    sum(lengths)
}

/// What is summed up while a star is read.
struct Sums<S: Simd> {
    are_finite: mask64x4<S>,
    energy: f64x4<S>,
    /// The greatest distortion.
    worst: f64x4<S>,
}

impl<S: Simd> Sums<S> {
    #[inline(always)]
    fn new(simd: S) -> Self {
        let zero = f64x4::splat(simd, 0.0);
        Self { are_finite: mask64x4::splat(simd, true), energy: zero, worst: zero }
    }

    #[inline(always)]
    fn add(&mut self, energy: &Energy<S>, weight: f64x4<S>) {
        self.are_finite &= energy.is_finite;
        self.energy += (energy.shape + energy.angles) * weight;
        self.worst = self.worst.greater(energy.distortion);
    }

    /// What was read, if the energy is finite.
    #[inline(always)]
    fn reading(&self) -> Option<Reading> {
        let energy = sum(self.energy);
        let [a, b, c, d] = self.worst.to_array();
        let worst = a.greater(b).greater(c.greater(d));
        (self.are_finite.all_true() && energy.is_finite()).then_some(Reading { energy, worst })
    }
}

#[inline(always)]
fn read<S: Simd>(simd: S, star: &Star, v: Point, weights: Weights, limit: f64) -> Option<Reading> {
    let v = Vectors::splat(simd, v.to_array());
    let mut sums = Sums::new(simd);
    let mut reading = Some(Reading { energy: 0.0, worst: 0.0 });
    for cells in star.used() {
        let placed = Placed::new(simd, cells, v, star.is_regularised);
        sums.add(&placed.at_node(Vectors::load(simd, &cells.slope), weights).0, placed.weight);
        for (i, beside) in cells.beside.iter().enumerate() {
            let slope = Vectors::load(simd, &beside.slope);
            sums.add(&placed.at_end(simd, i, beside, slope, weights).0, placed.weight);
        }
        reading = Some(sums.reading().filter(|reading| reading.energy <= limit)?);
    }
    reading
}

#[inline(always)]
fn expanded<S: Simd>(simd: S, star: &Star, v: Point, weights: Weights) -> Option<(Expansion, f64)> {
    let v = Vectors::splat(simd, v.to_array());
    let n = weights.power();
    let zero = f64x4::splat(simd, 0.0);
    let mut sums = Sums::new(simd);
    let mut gradient = Vectors::splat(simd, [0.0; 3]);
    let mut hessian = Matrices::zero(simd);
    let mut diagonal = zero;
    for cells in star.used() {
        let placed = Placed::new(simd, cells, v, star.is_regularised);
        let Placed { arms, squares, weight, .. } = placed;
        let shares = [2.0 / squares[0], 2.0 / squares[1], 2.0 / squares[2]];

        let slope = Vectors::load(simd, &cells.slope);
        let (energy, mean_square) = placed.at_node(slope, weights);
        sums.add(&energy, weight);
        let at_node = energy.factors(weights);
        let (of_shape, of_angles) = (at_node.shape * weight, at_node.angles * weight);
        let angles_at_node = of_angles;
        let over = 1.0 / mean_square;
        // With q the mean square: q' / q, and the product's gradient over the product.
        let of_square = (arms[0] + arms[1] + arms[2]) * (over * (2.0 / 3.0));
        let of_product = arms[0] * shares[0] + arms[1] * shares[1] + arms[2] * shares[2];
        let of_chi = slope * at_node.slope;
        let thrice = of_square * f64x4::splat(simd, 3.0);
        let (shape, angles) = (thrice + of_chi, of_product + of_chi);
        gradient += shape * of_shape + angles * of_angles;
        diagonal += of_shape * over * 6.0 + of_angles * (shares[0] + shares[1] + shares[2]);
        hessian.add_product(slope * ((of_shape + of_angles) * at_node.bend), slope);
        hessian.add_product(shape * (of_shape * n), shape);
        hessian.add_product(angles * (of_angles * n), angles);
        hessian.add_product(of_square * -of_shape, thrice);

        for (i, beside) in cells.beside.iter().enumerate() {
            let slope = Vectors::load(simd, &beside.slope);
            let (energy, mean_square) = placed.at_end(simd, i, beside, slope, weights);
            sums.add(&energy, weight);
            let at_end = energy.factors(weights);
            let (of_shape, of_angles) = (at_end.shape * weight, at_end.angles * weight);
            // Both gradients are a multiple of the arm and one of the slope.
            let (arm, of_product) = (arms[i], shares[i]);
            let of_square = 2.0 / mean_square;
            let both = of_shape + of_angles;
            let (shape, angles) = (of_shape * of_square, of_angles * of_product);
            let along = shape + angles;
            gradient += arm * along + slope * (at_end.slope * both);
            diagonal += along;
            let outer = shape * of_square * (n - 1.0 / 3.0) + angles * of_product * (n - 1.0)
                - angles_at_node * shares[i] * shares[i];
            hessian.add_product(arm * outer, arm);
            hessian.add_product(slope * (both * (at_end.bend + at_end.slope * at_end.slope * n)), slope);
            hessian.add_mixed(arm, slope * (at_end.slope * along * n));
        }
    }
    let Reading { energy: value, worst } = sums.reading()?;
    let hessian = hessian.sum() + Symmetric::IDENTITY * sum(diagonal);
    Some((Expansion { value, gradient: gradient.sum(), hessian }, worst))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::numbering::hex::CORNERS;
    use crate::mesh::quality::scaled_jacobian;

    /// Two distorted cells that share the face of the nodes 0, 3, 7, 4, of which node 0 is the star's.
    fn star(level: Level, eps: f64) -> (Star, [[Point; 8]; 2], [usize; 2]) {
        let bend = |p: Point| p + Point::new(0.2 * p.y * p.z, 0.1 * p.x - 0.15 * p.z, 0.1 * p.x * p.y);
        let right = CORNERS.map(|c| bend(Point::from(c.map(f64::from))));
        let left = CORNERS.map(|c| bend(Point::from(c.map(f64::from)) - Point::X));
        let mut star = Star::with(level);
        // What is left of an earlier star with more cells is none of this.
        star.take(Point::ONE, &[0, 0, 0, 0, 0], |_| 1.0, |_, _| Point::ZERO);
        star.is_regularised = eps != 0.0;
        let corner = |place: u32, k: u8| [right, left][place as usize / 8][usize::from(k)];
        star.take(right[0], &[0, 8 + 1], |_| eps, corner);
        (star, [right, left], [0, 1])
    }

    const NODES: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [0.2, 0.1, -0.2], [0.3, 0.6, 0.4], [0.7, 1.4, 1.5]];

    #[test]
    fn its_size_is_the_mean_length_of_its_spokes() {
        let (star, cells, places) = star(level(), 0.0);
        let lengths = |(cell, k): (&[Point; 8], usize)| {
            NEIGHBOURS[k].map(|end| cell[k].distance(cell[usize::from(end)]))
        };
        let lengths: Vec<f64> = cells.iter().zip(places).flat_map(lengths).collect();
        assert!((star.size - lengths.iter().sum::<f64>() / 6.0).abs() < 1e-15, "{}", star.size);
    }

    /// Each processor gives the same bits.
    #[test]
    fn instructions_do_not_matter() {
        let weights = Weights { doublings: 1, mu: 0.3 };
        for eps in [0.0, 0.4] {
            let all = [Level::baseline(), level()].map(|level| {
                let (star, ..) = star(level, eps);
                let v = Point::from(NODES[1]);
                let (Expansion { value, gradient, hessian }, worst) = star.expand(v, weights).unwrap();
                let reading = star.read(v, weights, f64::INFINITY).unwrap();
                let numbers = [star.size, value, worst, reading.energy, reading.worst];
                let vectors = [gradient, hessian.diagonal, hessian.beside].map(|v| v.to_array());
                numbers.iter().chain(vectors.as_flattened()).map(|x| x.to_bits()).collect::<Vec<_>>()
            });
            assert_eq!(all[0], all[1]);
        }
    }

    /// The worst is that of the corners that change, as the quality of the cells tells it.
    #[test]
    fn the_worst_is_that_of_the_cells() {
        let (star, mut cells, places) = star(level(), 0.0);
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
        let (star, cells, places) = star(level(), 0.4);
        let mut inverted = 0;
        for (doublings, mu) in [(-1, 0.9), (0, 0.0), (0, 1.0), (1, 0.0), (1, 0.3), (2, 0.9), (3, 1.0)] {
            let weights = Weights { doublings, mu };
            for v in NODES.map(Point::from) {
                let (here, worst) = star.expand(v, weights).unwrap();
                for (mut cell, k) in cells.into_iter().zip(places) {
                    cell[k] = v;
                    inverted += usize::from(scaled_jacobian(&cell) < 0.0);
                }
                let read = |v: Point| star.read(v, weights, f64::INFINITY).unwrap();
                assert!((here.value / read(v).energy - 1.0).abs() < 1e-12);
                assert!((worst / read(v).worst - 1.0).abs() < 1e-12);
                let h = 1e-6;
                for axis in [Point::X, Point::Y, Point::Z] {
                    let slope = (read(v + axis * h).energy - read(v - axis * h).energy) / (2.0 * h);
                    let scale = here.value + here.gradient.length();
                    assert!((slope - here.gradient.dot(axis)).abs() < 1e-6 * scale, "{weights:?} {v}");
                }
                for axis in [Point::X, Point::Y, Point::Z] {
                    let gradient = |v: Point| star.expand(v, weights).unwrap().0.gradient;
                    let bend = (gradient(v + axis * h) - gradient(v - axis * h)) / (2.0 * h);
                    let scale = here.gradient.length() + here.hessian.trace().abs();
                    assert!(bend.distance(here.hessian.times(axis)) < 1e-6 * scale, "{weights:?} {v}");
                }
            }
        }
        assert!(inverted > 0);
    }
}
