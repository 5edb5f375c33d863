//! Numbers and vectors side by side, four of double precision or eight of single precision, with the instructions of the
//! processor at hand. Each lane is computed as one number would be, and nothing is fused, so that all processors give the
//! same bits.

use std::ops::{Add, AddAssign, Mul, Sub};
use std::sync::OnceLock;

use fearless_simd::prelude::*;
use fearless_simd::{Level, Simd, f32x8, f64x2, f64x4, mask64x4};

use super::Point;

/// How many numbers of double precision stand side by side.
pub(crate) const LANES: usize = 4;

/// How many of single precision.
pub(crate) const SINGLES: usize = 8;

/// Numbers in store.
pub(crate) type Row = [f64; LANES];
pub(crate) type SingleRow = [f32; SINGLES];

/// Vectors in store: all x, then all y, then all z.
pub(crate) type Rows = [Row; 3];
pub(crate) type SingleRows = [SingleRow; 3];

/// What the processor can do.
pub(crate) fn level() -> Level {
    static LEVEL: OnceLock<Level> = OnceLock::new();
    *LEVEL.get_or_init(Level::new)
}

/// The sum, in an order that is the same everywhere.
#[inline(always)]
pub(crate) fn sum<S: Simd>(lanes: f64x4<S>) -> f64 {
    let [a, b, c, d] = lanes.to_array();
    (a + b) + (c + d)
}

/// Four numbers side by side, which come from different places. Without an array of them, which in WebAssembly would be
/// stored number by number and loaded again two by two.
#[inline(always)]
fn row<S: Simd>(simd: S, [a, b, c, d]: Row) -> f64x4<S> {
    let pair = |a: f64, b: f64| f64x2::splat(simd, a).zip_low(f64x2::splat(simd, b));
    pair(a, b).combine(pair(c, d))
}

/// One number, or some side by side: what is computed from vectors is written once for all.
pub(crate) trait Number:
    Copy + Add<Output = Self> + AddAssign + Sub<Output = Self> + Mul<Output = Self>
{
    /// The greater of two numbers. By a comparison: what the web has for it takes ten times as long, since it looks for NaN.
    fn greater(self, other: Self) -> Self;
    /// The lesser of two numbers.
    fn lesser(self, other: Self) -> Self;
    fn root(self) -> Self;
}

impl Number for f64 {
    #[inline(always)]
    fn greater(self, other: Self) -> Self {
        if self < other { other } else { self }
    }

    #[inline(always)]
    fn lesser(self, other: Self) -> Self {
        if other < self { other } else { self }
    }

    #[inline(always)]
    fn root(self) -> Self {
        self.sqrt()
    }
}

macro_rules! numbers {
    ($($lanes:ident),*) => {$(
        impl<S: Simd> Number for $lanes<S> {
            #[inline(always)]
            fn greater(self, other: Self) -> Self {
                self.simd_lt(other).select(other, self)
            }

            #[inline(always)]
            fn lesser(self, other: Self) -> Self {
                other.simd_lt(self).select(other, self)
            }

            #[inline(always)]
            fn root(self) -> Self {
                self.sqrt()
            }
        }
    )*};
}

numbers!(f32x8, f64x4);

/// One vector, or four side by side.
pub(crate) trait Vector: Copy + Sub<Output = Self> + Mul<f64, Output = Self> {
    type Number: Number + Mul<f64, Output = Self::Number>;

    fn dot(self, other: Self) -> Self::Number;
    fn cross(self, other: Self) -> Self;
    /// Of length one; zero where it has none.
    fn normalize_or_zero(self) -> Self;
}

impl Vector for Point {
    type Number = f64;

    #[inline(always)]
    fn dot(self, other: Self) -> f64 {
        self.dot(other)
    }

    #[inline(always)]
    fn cross(self, other: Self) -> Self {
        self.cross(other)
    }

    #[inline(always)]
    fn normalize_or_zero(self) -> Self {
        self.normalize_or_zero()
    }
}

/// As many vectors as there are numbers in `N`.
#[derive(Clone, Copy)]
pub(crate) struct Vectors<N> {
    pub(crate) x: N,
    pub(crate) y: N,
    pub(crate) z: N,
}

impl<S: Simd> Vector for Vectors<f64x4<S>> {
    type Number = f64x4<S>;

    #[inline(always)]
    fn dot(self, other: Self) -> f64x4<S> {
        self.dot(other)
    }

    #[inline(always)]
    fn cross(self, other: Self) -> Self {
        self.cross(other)
    }

    #[inline(always)]
    fn normalize_or_zero(self) -> Self {
        let over = 1.0 / self.dot(self).sqrt();
        let zero = f64x4::splat(over.simd, 0.0);
        let over = (over.simd_gt(0.0) & over.simd_lt(f64::INFINITY)).select(over, zero);
        self * over
    }
}

impl<N: Number> Vectors<N> {
    #[inline(always)]
    pub(crate) fn dot(self, other: Self) -> N {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline(always)]
    pub(crate) fn cross(self, other: Self) -> Self {
        Self {
            x: self.y * other.z - other.y * self.z,
            y: self.z * other.x - other.z * self.x,
            z: self.x * other.y - other.x * self.y,
        }
    }

    #[inline(always)]
    pub(crate) fn length_squared(self) -> N {
        self.dot(self)
    }

    /// The same vector everywhere.
    #[inline(always)]
    pub(crate) fn splat<S: Simd>(simd: S, [x, y, z]: [N::Element; 3]) -> Self
    where
        N: SimdBase<S>,
    {
        Self { x: N::splat(simd, x), y: N::splat(simd, y), z: N::splat(simd, z) }
    }

    #[inline(always)]
    pub(crate) fn load<S: Simd>(simd: S, [x, y, z]: &[N::Array; 3]) -> Self
    where
        N: SimdBase<S>,
    {
        Self { x: N::load_array_ref(simd, x), y: N::load_array_ref(simd, y), z: N::load_array_ref(simd, z) }
    }
}

impl<S: Simd> Vectors<f64x4<S>> {
    /// Four points side by side.
    #[inline(always)]
    pub(crate) fn of(simd: S, [a, b, c, d]: [Point; LANES]) -> Self {
        Self {
            x: row(simd, [a.x, b.x, c.x, d.x]),
            y: row(simd, [a.y, b.y, c.y, d.y]),
            z: row(simd, [a.z, b.z, c.z, d.z]),
        }
    }

    /// The corners of four hexes.
    #[inline(always)]
    pub(crate) fn corners(simd: S, hexes: &[[Point; 8]; LANES]) -> [Self; 8] {
        let mut corners = [Self::splat(simd, [0.0; 3]); 8];
        for (k, corner) in corners.iter_mut().enumerate() {
            *corner = Self::of(simd, [hexes[0][k], hexes[1][k], hexes[2][k], hexes[3][k]]);
        }
        corners
    }

    #[inline(always)]
    pub(crate) fn store(self) -> Rows {
        [self.x.to_array(), self.y.to_array(), self.z.to_array()]
    }

    /// Stores them without a copy of all.
    #[inline(always)]
    pub(crate) fn store_in(self, [x, y, z]: &mut Rows) {
        self.x.store_array(x);
        self.y.store_array(y);
        self.z.store_array(z);
    }

    /// The sum of the four.
    #[inline(always)]
    pub(crate) fn sum(self) -> Point {
        Point::new(sum(self.x), sum(self.y), sum(self.z))
    }

    /// Those of `other` where the mask is set, these elsewhere.
    #[inline(always)]
    pub(crate) fn replaced(self, mask: mask64x4<S>, other: Self) -> Self {
        Self {
            x: mask.select(other.x, self.x),
            y: mask.select(other.y, self.y),
            z: mask.select(other.z, self.z),
        }
    }
}

impl<N: Number> Add for Vectors<N> {
    type Output = Self;
    #[inline(always)]
    fn add(self, other: Self) -> Self {
        Self { x: self.x + other.x, y: self.y + other.y, z: self.z + other.z }
    }
}

impl<N: Number> AddAssign for Vectors<N> {
    #[inline(always)]
    fn add_assign(&mut self, other: Self) {
        *self = *self + other;
    }
}

impl<N: Number> Sub for Vectors<N> {
    type Output = Self;
    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        Self { x: self.x - other.x, y: self.y - other.y, z: self.z - other.z }
    }
}

impl<N: Number> Mul<N> for Vectors<N> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: N) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}

impl<S: Simd> Mul<f64> for Vectors<f64x4<S>> {
    type Output = Self;
    #[inline(always)]
    fn mul(self, factor: f64) -> Self {
        Self { x: self.x * factor, y: self.y * factor, z: self.z * factor }
    }
}
