//! The pieces of surfaces that are searched.

use fearless_simd::Simd;
use fearless_simd::prelude::*;

use super::super::Point;
use super::super::closest::{closest_on_four, closest_on_triangle};
use super::super::lanes::{LANES, Row, Rows, Vectors};
use super::Numbered;

/// A piece of a surface.
pub(crate) trait Facet: Sized {
    /// How many are looked at together: `LANES` at most.
    const TOGETHER: usize;

    /// Points whose convex hull it is in.
    fn corners(&self) -> &[Point];

    /// The points that are closest to `p` of `TOGETHER` facets at most, and how far they are from it, squared. Where there are
    /// fewer the rest say nothing.
    fn closest_of<S: Simd>(simd: S, facets: &[Numbered<Self>], p: Point) -> (Rows, Row);
}

impl Facet for [Point; 3] {
    const TOGETHER: usize = LANES;

    fn corners(&self) -> &[Point] {
        self
    }

    #[inline(always)]
    fn closest_of<S: Simd>(simd: S, facets: &[Numbered<Self>], p: Point) -> (Rows, Row) {
        let mut four = [&facets[0].facet; LANES];
        for (lane, numbered) in four.iter_mut().zip(facets) {
            *lane = &numbered.facet;
        }
        let [a, b, c, d] = four;
        let corners = [
            Vectors::of(simd, [a[0], b[0], c[0], d[0]]),
            Vectors::of(simd, [a[1], b[1], c[1], d[1]]),
            Vectors::of(simd, [a[2], b[2], c[2], d[2]]),
        ];
        let (points, squared) = closest_on_four(simd, Vectors::splat(simd, p.to_array()), corners);
        (points.store(), squared.to_array())
    }
}

/// A quad as four triangles around its middle. That is on the quad's bilinear patch, whereas the halves that a diagonal cuts
/// it into are both on one side of it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct QuadPatch(pub(crate) [Point; 4]);

impl QuadPatch {
    /// The mean of the corners.
    #[inline(always)]
    pub(crate) fn middle(&self) -> Point {
        self.0.iter().sum::<Point>() / 4.0
    }

    /// The triangles.
    pub(crate) fn triangles(&self) -> [[Point; 3]; 4] {
        let (corners, middle) = (self.0, self.middle());
        std::array::from_fn(|k| [corners[k], corners[(k + 1) % 4], middle])
    }

    /// How far a point is from it, squared.
    pub(crate) fn distance_squared(&self, p: Point) -> f64 {
        let to = |t| closest_on_triangle(p, t).distance_squared(p);
        self.triangles().into_iter().map(to).fold(f64::INFINITY, f64::min)
    }
}

impl Facet for QuadPatch {
    const TOGETHER: usize = 1;

    fn corners(&self) -> &[Point] {
        &self.0
    }

    #[inline(always)]
    fn closest_of<S: Simd>(simd: S, facets: &[Numbered<Self>], p: Point) -> (Rows, Row) {
        let quad = facets[0].facet;
        let [a, b, c, d] = quad.0;
        let middle = Vectors::splat(simd, quad.middle().to_array());
        let sides = [Vectors::of(simd, [a, b, c, d]), Vectors::of(simd, [b, c, d, a]), middle];
        let (points, squared) = closest_on_four(simd, Vectors::splat(simd, p.to_array()), sides);
        let (mut points, mut squared) = (points.store(), squared.to_array());
        for lane in 1..LANES {
            if squared[lane] < squared[0] {
                squared[0] = squared[lane];
                points.iter_mut().for_each(|row: &mut Row| row[0] = row[lane]);
            }
        }
        (points, squared)
    }
}
