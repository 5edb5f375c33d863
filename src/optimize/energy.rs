//! The energy of one corner of a cell.
//!
//! With the corner's edges a, b, c, its determinant D = a . (b x c) and chi(D) = (D + sqrt(D^2 + eps^2)) / 2, which is
//! positive for inverted corners too:
//!
//! ```text
//! shape      f = (|a|^2 + |b|^2 + |c|^2) / (3 chi^(2/3))     1 where a, b, c are equally long and perpendicular
//! angles     r = |a| |b| |c| / chi                           1 / scaled Jacobian where eps is 0
//! energy     (1 - mu) f^(3n) + mu r^(2n)                     n a power of two
//! ```
//!
//! f^3 and r^2 are rational in chi, so no root of third degree and no logarithm is taken.

use super::symmetric::Symmetric;
use crate::geometry::Point;

/// Which energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Weights {
    /// The power n is two to this.
    pub(crate) doublings: u32,
    /// The share of the angles, from 0 to 1.
    pub(crate) mu: f64,
}

/// An energy with its gradient and its second derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Expansion {
    pub(crate) value: f64,
    pub(crate) gradient: Point,
    pub(crate) hessian: Symmetric,
}

/// What the energy of a corner depends on.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Corner {
    pub(crate) determinant: f64,
    /// The mean of the squared edges.
    pub(crate) mean_square: f64,
    /// The product of the squared edges.
    pub(crate) product: f64,
    /// The square of chi's eps.
    pub(crate) eps_squared: f64,
}

/// The energy of a corner, and what its derivatives are made of.
///
/// Of ln f^3 = 3 ln q - 2 ln chi and ln r^2 = ln(product) - 2 ln chi the derivatives are short; those of
/// E = exp(n u) are n E u' and n E (u'' + n u' u'^T).
#[derive(Clone, Copy, Debug)]
pub(crate) struct Factors {
    /// The energy.
    pub(crate) value: f64,
    /// n times the part of the energy that weighs shape, and n times the one that weighs angles.
    pub(crate) shape: f64,
    pub(crate) angles: f64,
    /// The first and the second derivative of -2 ln chi by the determinant.
    pub(crate) slope: f64,
    pub(crate) bend: f64,
    /// r^2.
    pub(crate) angles_squared: f64,
}

impl Weights {
    /// n.
    pub(crate) fn power(self) -> f64 {
        f64::from(1 << self.doublings)
    }
}

impl Corner {
    /// chi of the determinant, and its root. Without eps they are the determinant and its size, to the last bit.
    #[inline]
    fn chi(self) -> (f64, f64) {
        if self.eps_squared == 0.0 {
            return (self.determinant, self.determinant.abs());
        }
        let root = (self.determinant * self.determinant + self.eps_squared).sqrt();
        ((self.determinant + root) / 2.0, root)
    }

    /// The energy, and r^2; both infinite for an inverted corner without eps.
    #[inline]
    pub(crate) fn energy(self, weights: Weights) -> (f64, f64) {
        let (chi, _) = self.chi();
        if chi.is_nan() || chi <= 0.0 {
            return (f64::INFINITY, f64::INFINITY);
        }
        let inverse = 1.0 / (chi * chi);
        let angles_squared = self.product * inverse;
        let [shape, angles] = self.parts(weights, inverse, angles_squared);
        (shape + angles, angles_squared)
    }

    /// The energy and its derivatives' factors; `None` where the energy is infinite.
    #[inline]
    pub(crate) fn factors(self, weights: Weights) -> Option<Factors> {
        let (chi, root) = self.chi();
        if chi.is_nan() || chi <= 0.0 {
            return None;
        }
        let inverse = 1.0 / (chi * chi);
        let angles_squared = self.product * inverse;
        let [shape, angles] = self.parts(weights, inverse, angles_squared);
        let w = 1.0 / root;
        Some(Factors {
            value: shape + angles,
            shape: weights.power() * shape,
            angles: weights.power() * angles,
            slope: -2.0 * w,
            bend: 2.0 * self.determinant * w * w * w,
            angles_squared,
        })
    }

    /// The parts of the energy that weigh shape and angles.
    #[inline]
    fn parts(self, weights: Weights, inverse: f64, angles_squared: f64) -> [f64; 2] {
        let q = self.mean_square;
        [
            (1.0 - weights.mu) * doubled(q * q * q * inverse, weights.doublings),
            weights.mu * doubled(angles_squared, weights.doublings),
        ]
    }
}

/// `x` to the power of two to the `doublings`.
#[inline]
fn doubled(x: f64, doublings: u32) -> f64 {
    let square = x * x;
    match doublings {
        0 => x,
        1 => square,
        2 => square * square,
        more => (2..more).fold(square * square, |x, _| x * x),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube(edge: f64) -> Corner {
        let square = edge * edge;
        let (determinant, product) = (square * edge, square * square * square);
        Corner { determinant, mean_square: square, product, eps_squared: 0.0 }
    }

    #[test]
    fn a_cube_corner_has_energy_one() {
        for (doublings, mu) in [(0, 0.0), (2, 0.4), (4, 1.0)] {
            let (energy, angles) = cube(3.0).energy(Weights { doublings, mu });
            assert!((energy - 1.0).abs() < 1e-12 && (angles - 1.0).abs() < 1e-12, "{energy}");
        }
    }

    #[test]
    fn an_inverted_corner_has_a_finite_energy_with_eps_alone() {
        let weights = Weights { doublings: 0, mu: 0.0 };
        let inverted = Corner { determinant: -1.0, ..cube(1.0) };
        assert_eq!(inverted.energy(weights), (f64::INFINITY, f64::INFINITY));
        assert!(inverted.factors(weights).is_none());
        let regular = Corner { eps_squared: 0.01, ..inverted };
        let (energy, _) = regular.energy(weights);
        assert!(energy.is_finite() && energy > 100.0, "{energy}");
        assert!((regular.factors(weights).unwrap().value - energy).abs() < 1e-12 * energy);
    }
}
