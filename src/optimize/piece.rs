//! A patch or a curve of a surface: what of it is nearest to a point, and how it runs there.
//!
//! Quads that are not flat are bilinear surfaces, as faces of hexes are and as templates divide them. All others are
//! triangles.

use fearless_simd::Simd;

use crate::geometry::lanes::{LANES, Row, Rows};
use crate::geometry::{
    BilinearQuad, Facet, NearestFacet, NearestTriangle, Numbered, Point, closest_on_triangle, triangulate,
};

/// Unit vectors whose difference is below this are one direction: far above rounding, far below what shows.
const SAME: f64 = 1e-9;

/// A quad whose corners leave their plane by less than this share of its diagonals is flat.
const FLAT: f64 = 1e-9;

/// A patch or a curve.
#[derive(Debug)]
pub(super) struct Piece {
    parts: Parts,
    /// The unit normal of a planar patch, or the unit direction of a straight curve, up to their sign.
    pub(super) constant: Option<Point>,
}

#[derive(Debug)]
enum Parts {
    /// Triangles and the unit normal of each; or a curve's edges as triangles without area, and the unit direction of each.
    Straight(NearestTriangle, Vec<Point>),
    /// Where some quads are not flat.
    Warped(NearestFacet<PatchFacet>),
}

/// A part of a patch.
#[derive(Clone, Debug)]
pub(super) enum PatchFacet {
    Triangle([Point; 3]),
    Quad(BilinearQuad),
}

impl PatchFacet {
    /// Appends the facets of a face.
    pub(super) fn of_face(corners: &[Point], facets: &mut Vec<Self>) {
        if let &[a, b, c, d] = corners {
            let quad = BilinearQuad { corners: [a, b, c, d] };
            if quad.warp() > FLAT * a.distance(c).max(b.distance(d)) {
                facets.push(Self::Quad(quad));
                return;
            }
        }
        facets.extend(triangles_of(corners).map(Self::Triangle));
    }

    /// Its point that is closest to `p`.
    fn closest(&self, p: Point) -> Point {
        match self {
            Self::Triangle(corners) => closest_on_triangle(p, *corners),
            Self::Quad(quad) => quad.point(quad.closest(p)),
        }
    }

    /// The unit normal where `p` is nearest to it.
    fn normal(&self, p: Point) -> Point {
        match self {
            Self::Triangle(triangle) => unit_normal(triangle),
            Self::Quad(quad) => quad.normal(quad.closest(p)),
        }
    }
}

impl Facet for PatchFacet {
    const TOGETHER: usize = 1;

    type Shared = ();

    fn corners(&self, (): &()) -> impl AsRef<[Point]> {
        match self {
            Self::Triangle(corners) => &corners[..],
            Self::Quad(quad) => &quad.corners,
        }
    }

    #[inline(always)]
    fn closest_of<S: Simd>(_: S, (): &(), facets: &[Numbered<Self>], p: Point) -> (Rows, Row) {
        let point = facets[0].facet.closest(p);
        (point.to_array().map(|x| [x; LANES]), [point.distance_squared(p); LANES])
    }
}

impl Piece {
    /// A patch of these facets.
    pub(super) fn patch(facets: Vec<PatchFacet>) -> Self {
        let triangle = |facet: &PatchFacet| match facet {
            PatchFacet::Triangle(triangle) => Some(*triangle),
            PatchFacet::Quad(_) => None,
        };
        match facets.iter().map(triangle).collect() {
            Some(triangles) => Self::straight(triangles, unit_normal),
            None => Self { constant: None, parts: Parts::Warped(NearestFacet::new(facets)) },
        }
    }

    /// A curve of these edges.
    pub(super) fn curve(edges: &[[Point; 2]]) -> Self {
        let along = |t: &[Point; 3]| (t[1] - t[0]).normalize_or_zero();
        Self::straight(edges.iter().map(|&[a, b]| [a, b, b]).collect(), along)
    }

    fn straight(triangles: Vec<[Point; 3]>, direction: impl Fn(&[Point; 3]) -> Point) -> Self {
        let directions: Vec<Point> = triangles.iter().map(direction).collect();
        let first = directions.iter().copied().find(|&d| d != Point::ZERO);
        let agrees = |first: Point| {
            let same = |d: &Point| d.cross(first).length() <= SAME;
            directions.iter().all(same).then_some(first)
        };
        let constant = first.and_then(agrees);
        Self { constant, parts: Parts::Straight(NearestTriangle::of(triangles), directions) }
    }

    /// The normal or direction where `p` is nearest to the piece.
    pub(super) fn direction(&self, p: Point) -> Point {
        let here = || match &self.parts {
            Parts::Straight(nearest, directions) => nearest.nearest(p).map(|found| directions[found.facet]),
            Parts::Warped(nearest) => nearest.nearest_facet(p).map(|facet| facet.normal(p)),
        };
        self.constant.or_else(here).unwrap_or_default()
    }

    /// Its point nearest to `p`.
    pub(super) fn closest(&self, p: Point) -> Point {
        let found = match &self.parts {
            Parts::Straight(nearest, _) => nearest.closest_point(p),
            Parts::Warped(nearest) => nearest.closest_point(p),
        };
        found.unwrap_or(p)
    }
}

/// The triangles of a face.
pub(super) fn triangles_of(corners: &[Point]) -> impl Iterator<Item = [Point; 3]> + '_ {
    let mut local = Vec::new();
    triangulate(corners, &mut local);
    local.into_iter().map(|t| t.map(|k| corners[k as usize]))
}

fn unit_normal(t: &[Point; 3]) -> Point {
    (t[1] - t[0]).cross(t[2] - t[0]).normalize_or_zero()
}
