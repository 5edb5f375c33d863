//! The energy of one corner of a cell as a function of where one node is, with its first two derivatives.
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
//! f^3 and r^2 are rational in chi, so no root of third degree and no logarithm is taken. Of a node that moves, D is
//! an affine function, at the corner where the node is and at the three next to it.

use super::symmetric::Symmetric;
use crate::geometry::Point;

/// Which energy.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Weights {
    /// The power n is two to this.
    pub(super) doublings: u32,
    /// The share of the angles, from 0 to 1.
    pub(super) mu: f64,
}

/// A value with its gradient and its second derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Expansion {
    pub(super) value: f64,
    pub(super) gradient: Point,
    pub(super) hessian: Symmetric,
}

/// A corner of a cell, as far as it depends on the node that moves.
#[derive(Clone, Copy, Debug)]
pub(super) struct Corner {
    /// A point where the determinant is zero, and the determinant's gradient.
    zero: Point,
    slope: Point,
    /// The sum of the squared edges is `moving * |v - centre|^2 + rest`, for the node at v.
    centre: Point,
    moving: f64,
    rest: f64,
    /// The product of the squared edges is `fixed_product` times the squared distances of v to these.
    ends: [Point; 3],
    end_count: usize,
    fixed_product: f64,
    /// The square of chi's eps.
    eps_squared: f64,
}

impl Corner {
    /// The corner where the node is; its edges lead to `ends`, right-handed.
    pub(super) fn at_node(ends: [Point; 3], eps: f64) -> Self {
        let centre = (ends[0] + ends[1] + ends[2]) / 3.0;
        Self {
            zero: ends[0],
            slope: (ends[2] - ends[0]).cross(ends[1] - ends[0]),
            centre,
            moving: 3.0,
            rest: ends.iter().map(|e| e.distance_squared(centre)).sum(),
            ends,
            end_count: 3,
            fixed_product: 1.0,
            eps_squared: eps * eps,
        }
    }

    /// A corner at `origin` with the fixed edges `b` and `c`, and an edge `a` that ends in the node: a, b, c are
    /// right-handed.
    pub(super) fn beside_node(origin: Point, b: Point, c: Point, eps: f64) -> Self {
        Self {
            zero: origin,
            slope: b.cross(c),
            centre: origin,
            moving: 1.0,
            rest: b.length_squared() + c.length_squared(),
            ends: [origin; 3],
            end_count: 1,
            fixed_product: b.length_squared() * c.length_squared(),
            eps_squared: eps * eps,
        }
    }

    /// The corner's determinant with the node at `v`.
    pub(super) fn determinant(&self, v: Point) -> f64 {
        (v - self.zero).dot(self.slope)
    }

    /// The corner's scaled Jacobian with the node at `v`; 0 if an edge has no length.
    pub(super) fn scaled_jacobian(&self, v: Point) -> f64 {
        let product = self.product(v);
        if product > 0.0 { self.determinant(v) / product.sqrt() } else { 0.0 }
    }

    /// chi of the determinant, and its root. Without eps they are the determinant and its size, to the last bit.
    fn chi(&self, determinant: f64) -> (f64, f64) {
        if self.eps_squared == 0.0 {
            return (determinant, determinant.abs());
        }
        let root = (determinant * determinant + self.eps_squared).sqrt();
        ((determinant + root) / 2.0, root)
    }

    /// The product of the squared edges.
    fn product(&self, v: Point) -> f64 {
        self.ends[..self.end_count].iter().fold(self.fixed_product, |p, e| p * v.distance_squared(*e))
    }

    /// The mean of the squared edges.
    fn mean_square(&self, v: Point) -> f64 {
        (self.moving * v.distance_squared(self.centre) + self.rest) / 3.0
    }

    /// The energy with the node at `v`; infinite for an inverted corner without eps.
    pub(super) fn energy(&self, v: Point, weights: Weights) -> f64 {
        let (chi, _) = self.chi(self.determinant(v));
        if chi.is_nan() || chi <= 0.0 {
            return f64::INFINITY;
        }
        let inverse = 1.0 / (chi * chi);
        let mut energy = 0.0;
        if weights.mu < 1.0 {
            let q = self.mean_square(v);
            energy += (1.0 - weights.mu) * doubled(q * q * q * inverse, weights.doublings);
        }
        if weights.mu > 0.0 {
            energy += weights.mu * doubled(self.product(v) * inverse, weights.doublings);
        }
        energy
    }

    /// Adds the energy and its derivatives with the node at `v`; of an infinite energy the value alone.
    ///
    /// Of ln f^3 = 3 ln q - 2 ln chi and ln r^2 = ln(product) - 2 ln chi the derivatives are short; those of
    /// E = exp(n u) are n E u' and n E (u'' + n u' u'^T).
    pub(super) fn expand(&self, v: Point, weights: Weights, sum: &mut Expansion) {
        let determinant = self.determinant(v);
        let (chi, root) = self.chi(determinant);
        if chi.is_nan() || chi <= 0.0 {
            sum.value = f64::INFINITY;
            return;
        }
        let inverse = 1.0 / (chi * chi);
        let w = 1.0 / root;
        // -2 ln chi.
        let gradient = self.slope * (-2.0 * w);
        let hessian = Symmetric::outer(self.slope) * (2.0 * determinant * w * w * w);
        let n = f64::from(1 << weights.doublings);
        let mut add = |share: f64, value: f64, gradient: Point, hessian: Symmetric| {
            let value = share * doubled(value, weights.doublings);
            sum.value += value;
            sum.gradient += gradient * (n * value);
            sum.hessian += (hessian + Symmetric::outer(gradient) * n) * (n * value);
        };
        if weights.mu < 1.0 {
            let q = self.mean_square(v);
            let slope = (v - self.centre) * (2.0 / 3.0 * self.moving / q);
            let bend = Symmetric::IDENTITY * (2.0 / 3.0 * self.moving / q) + Symmetric::outer(slope) * -1.0;
            add(1.0 - weights.mu, q * q * q * inverse, gradient + slope * 3.0, hessian + bend * 3.0);
        }
        if weights.mu > 0.0 {
            let (mut slope, mut bend) = (gradient, hessian);
            for end in &self.ends[..self.end_count] {
                let edge = v - *end;
                let inverse = 1.0 / edge.length_squared();
                slope += edge * (2.0 * inverse);
                bend += (Symmetric::IDENTITY + Symmetric::outer(edge) * (-2.0 * inverse)) * (2.0 * inverse);
            }
            add(weights.mu, self.product(v) * inverse, slope, bend);
        }
    }
}

/// `x` to the power of two to the `doublings`.
fn doubled(x: f64, doublings: u32) -> f64 {
    (0..doublings).fold(x, |x, _| x * x)
}

#[cfg(test)]
mod tests {
    use super::*;

    const POINTS: [[f64; 3]; 3] = [[1.1, 0.2, -0.1], [-0.2, 0.9, 0.3], [0.1, -0.3, 1.2]];

    /// A corner where the node is, and one beside it; the second is inverted for some of the nodes below.
    fn corners(eps: f64) -> [Corner; 2] {
        let [a, b, c] = POINTS.map(Point::from);
        [Corner::at_node([a, b, c], eps), Corner::beside_node(a, b, c, eps)]
    }

    const NODES: [[f64; 3]; 4] = [[0.0, 0.0, 0.0], [0.2, 0.3, -0.4], [1.9, 0.3, 0.4], [-0.7, 1.4, 1.5]];

    #[test]
    fn determinants_are_those_of_the_edges() {
        let [a, b, c] = POINTS.map(Point::from);
        for v in NODES.map(Point::from) {
            let [at, beside] = corners(0.0);
            let (d, l) =
                ((a - v).dot((b - v).cross(c - v)), (a - v).length() * (b - v).length() * (c - v).length());
            assert!((at.determinant(v) - d).abs() < 1e-14 && (at.scaled_jacobian(v) - d / l).abs() < 1e-14);
            let (d, l) = ((v - a).dot(b.cross(c)), (v - a).length() * b.length() * c.length());
            assert!(
                (beside.determinant(v) - d).abs() < 1e-14
                    && (beside.scaled_jacobian(v) - d / l).abs() < 1e-14
            );
        }
    }

    #[test]
    fn a_cube_corner_has_energy_one() {
        let corner = Corner::at_node([Point::X * 3.0, Point::Y * 3.0, Point::Z * 3.0], 0.0);
        for (doublings, mu) in [(0, 0.0), (2, 0.4), (4, 1.0)] {
            let energy = corner.energy(Point::ZERO, Weights { doublings, mu });
            assert!((energy - 1.0).abs() < 1e-12, "{energy}");
        }
        assert_eq!(corner.energy(Point::ONE * 2.0, Weights { doublings: 0, mu: 0.0 }), f64::INFINITY);
    }

    /// Derivatives against central differences, for positive and inverted corners.
    #[test]
    fn derivatives_are_those_of_finite_differences() {
        let weights = [(0, 0.0), (0, 1.0), (1, 0.0), (1, 0.3), (2, 0.9), (3, 1.0)];
        let mut inverted = 0;
        for (doublings, mu) in weights {
            let weights = Weights { doublings, mu };
            for (corner, v) in corners(0.4).into_iter().flat_map(|c| NODES.map(|v| (c, Point::from(v)))) {
                inverted += usize::from(corner.determinant(v) < 0.0);
                let expand = |v| {
                    let mut sum = Expansion::default();
                    corner.expand(v, weights, &mut sum);
                    sum
                };
                let here = expand(v);
                assert!((here.value / corner.energy(v, weights) - 1.0).abs() < 1e-12);
                let h = 1e-6;
                for axis in [Point::X, Point::Y, Point::Z] {
                    let slope = (corner.energy(v + axis * h, weights) - corner.energy(v - axis * h, weights))
                        / (2.0 * h);
                    let scale = here.value + here.gradient.length();
                    assert!((slope - here.gradient.dot(axis)).abs() < 1e-6 * scale, "{weights:?} {v}");
                    let bend = (expand(v + axis * h).gradient - expand(v - axis * h).gradient) / (2.0 * h);
                    let scale = here.gradient.length() + here.hessian.trace().abs();
                    assert!(bend.distance(here.hessian.times(axis)) < 1e-6 * scale, "{weights:?} {v}");
                }
            }
        }
        assert!(inverted > 0);
    }
}
