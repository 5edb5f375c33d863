//! Symmetric 3 x 3 matrices: second derivatives of an energy at a node, and projectors.

use std::ops::{Add, AddAssign, Mul};

use fearless_simd::{Simd, f64x4};

use crate::geometry::Point;
use crate::geometry::lanes::Vectors;

/// A symmetric matrix by its diagonal (xx, yy, zz) and what stands beside it (yz, xz, xy).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(crate) struct Symmetric {
    pub(crate) diagonal: Point,
    pub(crate) beside: Point,
}

impl Symmetric {
    pub(crate) const IDENTITY: Self = Self { diagonal: Point::ONE, beside: Point::ZERO };

    /// `v` times its transpose.
    #[inline]
    pub(crate) fn outer(v: Point) -> Self {
        Self { diagonal: v * v, beside: Point::new(v.y * v.z, v.x * v.z, v.x * v.y) }
    }

    pub(crate) fn trace(self) -> f64 {
        self.diagonal.element_sum()
    }

    pub(crate) fn times(self, v: Point) -> Point {
        let Self { diagonal: d, beside: b } = self;
        Point::new(
            d.x * v.x + b.z * v.y + b.y * v.z,
            b.z * v.x + d.y * v.y + b.x * v.z,
            b.y * v.x + b.x * v.y + d.z * v.z,
        )
    }

    /// `p` times this times `p`, for a projector `p`.
    pub(crate) fn between(self, p: Self) -> Self {
        let columns = [Point::X, Point::Y, Point::Z].map(|axis| p.times(self.times(p.times(axis))));
        Self {
            diagonal: Point::new(columns[0].x, columns[1].y, columns[2].z),
            beside: Point::new(columns[1].z, columns[0].z, columns[0].y),
        }
    }

    /// The solution of this matrix with right side `v`; `None` if the matrix is not positive definite.
    pub(crate) fn solve(self, v: Point) -> Option<Point> {
        let Self { diagonal: d, beside: b } = self;
        // Cholesky without roots: the matrix is L D L^T.
        let small = 1e-14 * self.trace();
        let dx = d.x;
        if dx.is_nan() || dx <= small {
            return None;
        }
        let (lyx, lzx) = (b.z / dx, b.y / dx);
        let dy = d.y - lyx * b.z;
        if dy.is_nan() || dy <= small {
            return None;
        }
        let rest = b.x - lzx * b.z;
        let lzy = rest / dy;
        let dz = d.z - lzx * b.y - lzy * rest;
        if dz.is_nan() || dz <= small {
            return None;
        }
        let y = v.y - lyx * v.x;
        let z = (v.z - lzx * v.x - lzy * y) / dz;
        let y = y / dy - lzy * z;
        Some(Point::new(v.x / dx - lyx * y - lzx * z, y, z))
    }
}

impl Add for Symmetric {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self { diagonal: self.diagonal + other.diagonal, beside: self.beside + other.beside }
    }
}

impl AddAssign for Symmetric {
    #[inline]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl Mul<f64> for Symmetric {
    type Output = Self;
    #[inline]
    fn mul(self, factor: f64) -> Self {
        Self { diagonal: self.diagonal * factor, beside: self.beside * factor }
    }
}

/// Sums of symmetric matrices, a sum a lane.
#[derive(Clone, Copy)]
pub(crate) struct Matrices<S: Simd> {
    diagonal: Vectors<f64x4<S>>,
    beside: Vectors<f64x4<S>>,
}

impl<S: Simd> Matrices<S> {
    #[inline(always)]
    pub(crate) fn zero(simd: S) -> Self {
        let zero = Vectors::splat(simd, [0.0; 3]);
        Self { diagonal: zero, beside: zero }
    }

    /// Adds `v w^T`, which is to be symmetric.
    #[inline(always)]
    pub(crate) fn add_product(&mut self, v: Vectors<f64x4<S>>, w: Vectors<f64x4<S>>) {
        self.diagonal += Vectors { x: v.x * w.x, y: v.y * w.y, z: v.z * w.z };
        self.beside += Vectors { x: v.y * w.z, y: v.x * w.z, z: v.x * w.y };
    }

    /// Adds `v w^T + w v^T`.
    #[inline(always)]
    pub(crate) fn add_mixed(&mut self, v: Vectors<f64x4<S>>, w: Vectors<f64x4<S>>) {
        let both = v + v;
        self.diagonal += Vectors { x: both.x * w.x, y: both.y * w.y, z: both.z * w.z };
        self.beside +=
            Vectors { x: v.y * w.z + v.z * w.y, y: v.x * w.z + v.z * w.x, z: v.x * w.y + v.y * w.x };
    }

    /// The sum over the lanes.
    #[inline(always)]
    pub(crate) fn sum(self) -> Symmetric {
        Symmetric { diagonal: self.diagonal.sum(), beside: self.beside.sum() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn solves_what_it_multiplies() {
        let matrix = Symmetric::outer(Point::new(1.0, -2.0, 0.5))
            + Symmetric::outer(Point::new(0.3, 1.0, 4.0)) * 2.0
            + Symmetric::IDENTITY * 0.1;
        for v in [Point::X, Point::new(3.0, -1.0, 7.0)] {
            let x = matrix.solve(v).unwrap();
            assert!(matrix.times(x).distance(v) < 1e-12, "{x}");
        }
        assert_eq!((Symmetric::IDENTITY * -1.0).solve(Point::X), None);
        assert_eq!(Symmetric::outer(Point::ONE).solve(Point::X), None, "singular");
        assert_eq!((Symmetric::IDENTITY * f64::NAN).solve(Point::X), None);
    }

    #[test]
    fn projects_from_both_sides() {
        let n = Point::new(1.0, 2.0, 2.0) / 3.0;
        let plane = Symmetric::IDENTITY + Symmetric::outer(n) * -1.0;
        let matrix = Symmetric::outer(Point::new(1.0, -2.0, 0.5)) + Symmetric::IDENTITY;
        let between = matrix.between(plane);
        assert!(between.times(n).length() < 1e-15);
        let v = Point::new(2.0, -1.0, 0.0);
        assert!(between.times(v).distance(plane.times(matrix.times(v))) < 1e-14);
    }
}
