//! The pieces of surfaces that are searched.

use std::fmt::Debug;

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

    /// What all facets of an index share: the points that their corners are among, or nothing.
    type Shared: Debug;

    /// Points whose convex hull it is in.
    fn corners(&self, shared: &Self::Shared) -> impl AsRef<[Point]>;

    /// The points that are closest to `p` of `TOGETHER` facets at most, and how far they are from it, squared. Where there are
    /// fewer the rest say nothing.
    fn closest_of<S: Simd>(
        simd: S,
        shared: &Self::Shared,
        facets: &[Numbered<Self>],
        p: Point,
    ) -> (Rows, Row);
}

/// A triangle by the places of its corners among points: a sixth of the memory of these, if triangles share them.
impl Facet for [u32; 3] {
    const TOGETHER: usize = LANES;

    type Shared = Vec<Point>;

    fn corners(&self, points: &Vec<Point>) -> impl AsRef<[Point]> {
        self.map(|n| points[n as usize])
    }

    #[inline(always)]
    fn closest_of<S: Simd>(simd: S, points: &Vec<Point>, facets: &[Numbered<Self>], p: Point) -> (Rows, Row) {
        let mut four = [&facets[0].facet; LANES];
        for (lane, numbered) in four.iter_mut().zip(facets) {
            *lane = &numbered.facet;
        }
        let [a, b, c, d] = four;
        let at = |n: u32| points[n as usize];
        let corners = [
            Vectors::of(simd, [at(a[0]), at(b[0]), at(c[0]), at(d[0])]),
            Vectors::of(simd, [at(a[1]), at(b[1]), at(c[1]), at(d[1])]),
            Vectors::of(simd, [at(a[2]), at(b[2]), at(c[2]), at(d[2])]),
        ];
        let (points, squared) = closest_on_four(simd, Vectors::splat(simd, p.to_array()), corners);
        (points.store(), squared.to_array())
    }
}

/// A quad that is cut in two along either diagonal. A point is as far from it as from the farther of the two cuts: so it is no
/// farther from the quad however that is drawn. Its bilinear patch lies between the cuts, and is no farther either.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CutQuad(pub(crate) [Point; 4]);

impl CutQuad {
    /// The middles of the diagonals.
    pub(crate) fn middles(&self) -> [Point; 2] {
        let [a, b, c, d] = self.0;
        [a.midpoint(c), b.midpoint(d)]
    }

    /// The triangles of one cut, then those of the other.
    pub(crate) fn triangles(&self) -> [[Point; 3]; 4] {
        let [a, b, c, d] = self.0;
        [[a, b, c], [a, c, d], [b, c, d], [b, d, a]]
    }

    /// How far a point is from it, squared.
    pub(crate) fn distance_squared(&self, p: Point) -> f64 {
        farther(self.triangles().map(|t| closest_on_triangle(p, t).distance_squared(p))).1
    }
}

/// Given how far the triangles are, squared: the one that is nearest of the farther cut, and how far that is.
#[inline(always)]
fn farther(squared: [f64; 4]) -> (usize, f64) {
    let nearer = |i: usize, j: usize| if squared[j] < squared[i] { j } else { i };
    let [one, other] = [nearer(0, 1), nearer(2, 3)];
    let farther = if squared[other] > squared[one] { other } else { one };
    (farther, squared[farther])
}

impl AsRef<[Point]> for CutQuad {
    fn as_ref(&self) -> &[Point] {
        &self.0
    }
}

/// A quad that is cut in two along either diagonal, by the places of its corners among points.
impl Facet for [u32; 4] {
    const TOGETHER: usize = 1;

    type Shared = Vec<Point>;

    fn corners(&self, points: &Vec<Point>) -> impl AsRef<[Point]> {
        self.map(|n| points[n as usize])
    }

    #[inline(always)]
    fn closest_of<S: Simd>(simd: S, points: &Vec<Point>, facets: &[Numbered<Self>], p: Point) -> (Rows, Row) {
        let [s, t, u, v] = CutQuad(facets[0].facet.map(|n| points[n as usize])).triangles();
        let corners = [0, 1, 2].map(|k| Vectors::of(simd, [s[k], t[k], u[k], v[k]]));
        let (points, squared) = closest_on_four(simd, Vectors::splat(simd, p.to_array()), corners);
        let (mut points, mut squared) = (points.store(), squared.to_array());
        let lane;
        (lane, squared[0]) = farther(squared);
        points.iter_mut().for_each(|row: &mut Row| row[0] = row[lane]);
        (points, squared)
    }
}
