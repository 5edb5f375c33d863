//! The sign of a hex's Jacobian everywhere inside it, not at its corners alone.
//!
//! The determinant of the Jacobian of a trilinear hex has degree 2 in each of its three parameters. It is written
//! in Bernstein's basis, with 27 coefficients:
//!
//! 1. the coefficients at the eight corners are the determinants there; no value inside is below the least of all 27;
//! 2. where that does not decide, the hex is halved where its coefficients differ most (de Casteljau), and the halves
//!    are asked, those with the least coefficients first.
//!
//! As Johnen, Weill, Remacle, *Robust and efficient validation of the linear hexahedral element* (2017), with the
//! coefficients in closed form.

use std::array::from_fn;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

use fearless_simd::prelude::*;
use fearless_simd::{Simd, dispatch, f64x4, mask64x4};

use crate::geometry::Point;
use crate::geometry::lanes::{LANES, Number, Vector, Vectors, level};
use crate::mesh::numbering::hex::CORNER_AT;

/// Parts that are looked at before a hex is given up as undecided.
const MAX_PARTS: usize = 2048;

/// Coefficients are exact up to this share of the product of the longest edges in the three directions.
const ROUNDING: f64 = 64.0 * f64::EPSILON;

/// The width of [`min_jacobian_bound`]'s answer, as a share of the greatest coefficient.
const GAP: f64 = 1e-3;

/// What is known of the sign of a hex's Jacobian.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Certainty {
    /// Above zero in all of the hex.
    Positive,
    /// At some point of the hex not above zero, as far as rounding lets tell.
    NotPositive,
    /// So close to zero somewhere that the parts looked at did not decide.
    Undecided,
}

/// Two numbers between which the least value lies that the Jacobian determinant has in a hex; volumes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JacobianBound {
    /// No value is below.
    pub lower: f64,
    /// A value that the determinant has.
    pub upper: f64,
}

/// Is the Jacobian determinant of the trilinear hex positive everywhere? Corners are in the order of
/// VTK_HEXAHEDRON.
///
/// ```
/// use hexmill::mesh::{numbering::hex::CORNERS, quality::{Certainty, is_positive}};
/// let cube = CORNERS.map(|c| hexmill::geometry::Point::from(c.map(f64::from)));
/// assert_eq!(is_positive(&cube), Certainty::Positive);
/// ```
pub fn is_positive(corners: &[Point; 8]) -> Certainty {
    let edges = Edges::of(corners);
    let whole = Part(coefficients(&edges, 0.0));
    let zero = edges.magnitude() * ROUNDING;
    // One answer for all, so that no branch keeps the numbers from being compared side by side.
    if whole.0.iter().fold(true, |all, &c| all & (c > zero)) {
        return Certainty::Positive;
    }
    let mut queue = BinaryHeap::from([whole]);
    for _ in 0..MAX_PARTS {
        let Some(part) = queue.pop() else { return Certainty::Positive };
        // Written so that a number that is none is not positive.
        if part.ends().any(|value| value.is_nan() || value <= zero) {
            return Certainty::NotPositive;
        }
        queue.extend(part.halves().into_iter().filter(|half| half.least() <= zero));
    }
    Certainty::Undecided
}

/// Is the Jacobian determinant of each of four hexes positive everywhere?
pub(super) fn are_positive(hexes: &[[Point; 8]; LANES]) -> [bool; LANES] {
    let sure = dispatch!(level(), simd => are_surely_positive(simd, hexes));
    from_fn(|lane| sure[lane] || is_positive(&hexes[lane]) == Certainty::Positive)
}

/// Which of four hexes have positive coefficients alone?
#[inline(always)]
fn are_surely_positive<S: Simd>(simd: S, hexes: &[[Point; 8]; LANES]) -> [bool; LANES] {
    let edges = Edges::of(&Vectors::corners(simd, hexes));
    let zero = edges.magnitude() * ROUNDING;
    let mut all = mask64x4::splat(simd, true);
    for coefficient in coefficients(&edges, f64x4::splat(simd, 0.0)) {
        all &= coefficient.simd_gt(zero);
    }
    [all.test(0), all.test(1), all.test(2), all.test(3)]
}

/// Encloses the least value of the Jacobian determinant of the trilinear hex, to a thousandth of its greatest
/// coefficient. Corners are in the order of VTK_HEXAHEDRON.
pub fn min_jacobian_bound(corners: &[Point; 8]) -> JacobianBound {
    let whole = Part::of(corners);
    let gap = GAP * whole.0.iter().fold(0.0, |most: f64, c| most.max(c.abs()));
    let mut bound = JacobianBound { lower: whole.least(), upper: f64::INFINITY };
    let mut queue = BinaryHeap::from([whole]);
    for _ in 0..MAX_PARTS {
        let Some(part) = queue.pop() else { break };
        bound.lower = part.least();
        bound.upper = part.ends().fold(bound.upper, f64::min);
        if bound.upper - bound.lower <= gap {
            break;
        }
        queue.extend(part.halves());
    }
    bound
}

/// The edges of a hex by direction: `x[j][k]` at y = j, z = k; `y[i][k]`; `z[i][j]`.
struct Edges<V> {
    x: [[V; 2]; 2],
    y: [[V; 2]; 2],
    z: [[V; 2]; 2],
}

impl<V: Vector> Edges<V> {
    #[inline(always)]
    fn of(corners: &[V; 8]) -> Self {
        let at = |i: usize, j: usize, k: usize| corners[usize::from(CORNER_AT[i + 2 * j + 4 * k])];
        let none = [[corners[0]; 2]; 2];
        let mut edges = Self { x: none, y: none, z: none };
        for a in 0..2 {
            for b in 0..2 {
                edges.x[a][b] = at(1, a, b) - at(0, a, b);
                edges.y[a][b] = at(a, 1, b) - at(a, 0, b);
                edges.z[a][b] = at(a, b, 1) - at(a, b, 0);
            }
        }
        edges
    }

    /// The product of the longest edges in the three directions.
    #[inline(always)]
    fn magnitude(&self) -> V::Number {
        longest(&self.x) * longest(&self.y) * longest(&self.z)
    }
}

/// The length of the longest of four edges.
#[inline(always)]
fn longest<V: Vector>([[a, b], [c, d]]: &[[V; 2]; 2]) -> V::Number {
    let [a, b, c, d] = [a.dot(*a), b.dot(*b), c.dot(*c), d.dot(*d)];
    a.greater(b).greater(c).greater(d).root()
}

/// The coefficients over all of a hex, in the order of [`Part`]. Each pair of linear factors in one parameter multiplies to
/// a quadratic whose middle coefficient is the mean of two products.
#[inline(always)]
fn coefficients<V: Vector>(edges: &Edges<V>, zero: V::Number) -> [V::Number; 27] {
    let mut sums = [zero; 27];
    for yi in 0..2 {
        for yk in 0..2 {
            for zi in 0..2 {
                for zj in 0..2 {
                    let area = edges.y[yi][yk].cross(edges.z[zi][zj]);
                    for (xj, row) in edges.x.iter().enumerate() {
                        for (xk, edge) in row.iter().enumerate() {
                            sums[yi + zi + 3 * (xj + zj) + 9 * (xk + yk)] += edge.dot(area);
                        }
                    }
                }
            }
        }
    }
    for (sum, share) in sums.iter_mut().zip(SHARES) {
        *sum = *sum * share;
    }
    sums
}

/// A quadratic in x, y and z over a part of the hex: the coefficient at i, j, k stands at i + 3j + 9k.
#[derive(Clone, Copy)]
struct Part([f64; 27]);

/// One over the number of products whose mean each coefficient is.
const SHARES: [f64; 27] = {
    let (mut all, mut c) = ([1.0; 27], 0);
    while c < 27 {
        let middles = (c % 3 == 1) as u32 + (c / 3 % 3 == 1) as u32 + (c / 9 == 1) as u32;
        all[c] = 1.0 / (1 << middles) as f64;
        c += 1;
    }
    all
};

/// Where the coefficients stand that are values at the part's corners.
const ENDS: [usize; 8] = [0, 2, 6, 8, 18, 20, 24, 26];

/// The distance between neighbouring coefficients along x, y, z.
const STRIDES: [usize; 3] = [1, 3, 9];

impl Part {
    fn of(corners: &[Point; 8]) -> Self {
        Self(coefficients(&Edges::of(corners), 0.0))
    }

    /// The least coefficient, or NaN where there is one.
    fn least(&self) -> f64 {
        self.0.iter().fold(f64::INFINITY, |least, &c| if c < least || c.is_nan() { c } else { least })
    }

    fn ends(&self) -> impl Iterator<Item = f64> {
        ENDS.into_iter().map(|c| self.0[c])
    }

    /// The two halves along the axis along which neighbouring coefficients differ most.
    fn halves(&self) -> [Self; 2] {
        let steepness = STRIDES.map(|stride| {
            let pairs = (0..27).filter(|c| c / stride % 3 < 2);
            pairs.map(|c| (self.0[c + stride] - self.0[c]).abs()).fold(0.0, f64::max)
        });
        let steeper = |a: usize, b: usize| if steepness[b] > steepness[a] { b } else { a };
        let stride = STRIDES[steeper(steeper(0, 1), 2)];
        let [mut low, mut high] = [*self; 2];
        for first in (0..27).filter(|c| (c / stride).is_multiple_of(3)) {
            let [a, b, c] = [0, 1, 2].map(|i| self.0[first + i * stride]);
            let (ab, bc) = ((a + b) / 2.0, (b + c) / 2.0);
            let middle = (ab + bc) / 2.0;
            for (i, (l, h)) in [(a, middle), (ab, bc), (middle, c)].into_iter().enumerate() {
                low.0[first + i * stride] = l;
                high.0[first + i * stride] = h;
            }
        }
        [low, high]
    }
}

/// The part with the least coefficient is the greatest: it comes first out of a heap.
impl Ord for Part {
    fn cmp(&self, other: &Self) -> Ordering {
        other.least().total_cmp(&self.least())
    }
}

impl PartialOrd for Part {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl PartialEq for Part {
    fn eq(&self, other: &Self) -> bool {
        self.cmp(other).is_eq()
    }
}

impl Eq for Part {}

#[cfg(test)]
mod tests;
