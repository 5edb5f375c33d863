//! The energy of one corner of a cell.
//!
//! With the corner's edges a, b, c, its determinant D = a . (b x c) and chi(D) = (D + sqrt(D^2 + eps^2)) / 2, which is
//! positive for inverted corners too:
//!
//! ```text
//! shape       f = (|a|^2 + |b|^2 + |c|^2) / (3 chi^(2/3))                1 where a, b, c are equally long and perpendicular
//! angles      r = |a| |b| |c| / chi                                      1 / scaled Jacobian where eps is 0
//! energy      (1 - mu) f^(3n) + mu r^(2n)                                n a power of two, or a half
//! lengths     s = (|a|^2 + |b|^2 + |c|^2)^3 / (27 |a|^2 |b|^2 |c|^2)     1 where a, b, c are equally long
//! distortion  the greater of r^2 and s / 20                              what no step raises beyond what is kept
//! ```
//!
//! Angles do not see flat cells: a box with edges 1, 1 and h has a scaled Jacobian of 1 for any h. As the distortion has it,
//! which is one over a scaled Jacobian's square, that is so up to 1 to 8; from there on the box counts as 8.2 h.
//!
//! f^3 and r^2 are rational in chi, so no root of third degree and no logarithm is taken.

use fearless_simd::prelude::*;
use fearless_simd::{Simd, f64x4, mask64x4};

use super::symmetric::Symmetric;
use crate::geometry::Point;
use crate::geometry::lanes::Number;

/// How much unequal lengths count in a distortion.
const UNEQUAL: f64 = 1.0 / 20.0;

/// Which energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Weights {
    /// The power n is two to this, -1 at least.
    pub(crate) doublings: i32,
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

/// What the energy of a corner depends on, of four corners.
#[derive(Clone, Copy)]
pub(crate) struct Corners<S: Simd> {
    pub(crate) determinant: f64x4<S>,
    /// The mean of the squared edges.
    pub(crate) mean_square: f64x4<S>,
    /// The product of the squared edges.
    pub(crate) product: f64x4<S>,
    /// The square of chi's eps, where there is one.
    pub(crate) eps_squared: Option<f64x4<S>>,
}

/// The energy of corners. Where it is infinite, at inverted corners without eps, the numbers say nothing.
#[derive(Clone, Copy)]
pub(crate) struct Energy<S: Simd> {
    /// Is the energy finite?
    pub(crate) is_finite: mask64x4<S>,
    /// The parts that weigh shape and angles.
    pub(crate) shape: f64x4<S>,
    pub(crate) angles: f64x4<S>,
    /// The greater of r^2 and s / 20.
    pub(crate) distortion: f64x4<S>,
    /// One over the root of chi.
    over_root: f64x4<S>,
    determinant: f64x4<S>,
}

/// What the derivatives of energies are made of.
///
/// Of ln f^3 = 3 ln q - 2 ln chi and ln r^2 = ln(product) - 2 ln chi the derivatives are short; those of
/// E = exp(n u) are n E u' and n E (u'' + n u' u'^T).
#[derive(Clone, Copy)]
pub(crate) struct Factors<S: Simd> {
    /// n times the part of the energy that weighs shape, and n times the one that weighs angles.
    pub(crate) shape: f64x4<S>,
    pub(crate) angles: f64x4<S>,
    /// The first and the second derivative of -2 ln chi by the determinant.
    pub(crate) slope: f64x4<S>,
    pub(crate) bend: f64x4<S>,
}

impl Weights {
    /// n.
    pub(crate) fn power(self) -> f64 {
        if self.doublings < 0 { 0.5 } else { f64::from(1 << self.doublings) }
    }
}

impl<S: Simd> Corners<S> {
    /// The energies.
    #[inline(always)]
    pub(crate) fn energy(self, weights: Weights) -> Energy<S> {
        let determinant = self.determinant;
        // Without eps chi and its root are the determinant and its size.
        let (chi, root) = match self.eps_squared {
            None => (determinant, determinant),
            Some(eps_squared) => {
                let root = (determinant * determinant + eps_squared).sqrt();
                ((determinant + root) * 0.5, root)
            }
        };
        let (inverse, over_root) = match self.eps_squared {
            None => {
                let over = 1.0 / chi;
                (over * over, over)
            }
            Some(_) => (1.0 / (chi * chi), 1.0 / root),
        };
        let angles_squared = self.product * inverse;
        let q = self.mean_square;
        let cubed = q * q * q;
        Energy {
            is_finite: chi.simd_gt(0.0),
            shape: doubled(cubed * inverse, weights.doublings) * (1.0 - weights.mu),
            angles: doubled(angles_squared, weights.doublings) * weights.mu,
            distortion: angles_squared.greater(cubed / self.product * UNEQUAL),
            over_root,
            determinant,
        }
    }
}

impl<S: Simd> Energy<S> {
    /// What the derivatives are made of.
    #[inline(always)]
    pub(crate) fn factors(self, weights: Weights) -> Factors<S> {
        let w = self.over_root;
        Factors {
            shape: self.shape * weights.power(),
            angles: self.angles * weights.power(),
            slope: w * -2.0,
            bend: self.determinant * 2.0 * (w * w * w),
        }
    }
}

/// `x` to the power of two to the `doublings`.
#[inline(always)]
fn doubled<S: Simd>(x: f64x4<S>, doublings: i32) -> f64x4<S> {
    let square = x * x;
    match doublings {
        ..0 => x.sqrt(),
        0 => x,
        1 => square,
        2 => square * square,
        more => (2..more).fold(square * square, |x, _| x * x),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::lanes::level;
    use fearless_simd::dispatch;

    /// A box 1 by 1 by h counts as less than its angles tell if it is flatter than 1 to 8.
    #[test]
    fn a_flat_corner_is_distorted() {
        #[inline(always)]
        fn distortion<S: Simd>(simd: S, h: f64) -> f64 {
            let all = |x: f64| f64x4::splat(simd, x);
            let (mean_square, product) = (all((2.0 + h * h) / 3.0), all(h * h));
            let corners = Corners { determinant: all(h), mean_square, product, eps_squared: None };
            corners.energy(Weights { doublings: 0, mu: 0.5 }).distortion.to_array()[0]
        }
        for (h, expected) in [(1.0, 1.0), (0.125, 1.0), (0.05, 0.4103), (0.02, 0.1643)] {
            let counts_as = 1.0 / dispatch!(level(), simd => distortion(simd, h)).sqrt();
            assert!((counts_as - expected).abs() < 1e-3, "{h}: {counts_as}");
        }
    }

    /// The energy of a cube's corner with so long edges, its distortion and n times both parts, infinite where it is.
    fn cube(edge: f64, determinant: f64, eps_squared: Option<f64>, weights: Weights) -> [f64; 3] {
        #[inline(always)]
        fn corner<S: Simd>(
            simd: S,
            edge: f64,
            determinant: f64,
            eps: Option<f64>,
            weights: Weights,
        ) -> [f64; 3] {
            let square = edge * edge;
            let all = |x: f64| f64x4::splat(simd, x);
            let (mean_square, product) = (all(square), all(square * square * square));
            let eps_squared = eps.map(all);
            let energy =
                Corners { determinant: all(determinant), mean_square, product, eps_squared }.energy(weights);
            if !energy.is_finite.all_true() {
                return [f64::INFINITY; 3];
            }
            let factors = energy.factors(weights);
            let [all, angles, derived] =
                [energy.shape + energy.angles, energy.distortion, factors.shape + factors.angles];
            [all[3], angles[2], derived[1]]
        }
        dispatch!(level(), simd => corner(simd, edge, determinant, eps_squared, weights))
    }

    #[test]
    fn a_cube_corner_has_energy_one() {
        for (doublings, mu) in [(-1, 0.5), (0, 0.0), (2, 0.4), (4, 1.0)] {
            let weights = Weights { doublings, mu };
            let [energy, angles, derived] = cube(3.0, 27.0, None, weights);
            assert!((energy - 1.0).abs() < 1e-12 && (angles - 1.0).abs() < 1e-12, "{energy}");
            assert!((derived - weights.power()).abs() < 1e-12 * derived, "{derived}");
        }
    }

    #[test]
    fn an_inverted_corner_has_a_finite_energy_with_eps_alone() {
        let weights = Weights { doublings: 0, mu: 0.0 };
        assert_eq!(cube(1.0, -1.0, None, weights), [f64::INFINITY; 3]);
        assert_eq!(cube(1.0, 0.0, None, weights), [f64::INFINITY; 3]);
        let [energy, _, derived] = cube(1.0, -1.0, Some(0.01), weights);
        assert!(energy.is_finite() && energy > 100.0, "{energy}");
        assert!((derived - energy).abs() < 1e-12 * energy);
    }
}
