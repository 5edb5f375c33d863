//! An element made ready to be held against regions.

use super::SizedElement;
use crate::geometry::{Aabb, Point, Triangle};

/// How far, as a share of its longest edge, an element may reach into a region without overlapping it
/// *by more than a touch*. Elements are shrunk towards their centre by this share before they are held
/// against regions, so that those that share an edge or a node with a region's elements are left alone
/// even where coordinates were rounded to six digits or to f32.
///
/// Whatever is thinner than this is taken to be this thick (half its extent). So a region without
/// thickness, a single point or a surface is found even where it follows the edges between elements,
/// into whose shrunk images it would otherwise fall through: the gap beside an element is at most this
/// share wide.
pub(super) const TOUCH: f64 = 1e-3;

/// How far, as a share of its longest edge, an element that lies in a face of a box, in a cap of a
/// cylinder or along a surface may be off it and still belong to the region: f32's rounding of
/// coordinates a thousand times as large as the element. A tenth of [`TOUCH`], so that neighbours stay
/// out.
pub(super) const FLUSH: f64 = TOUCH / 10.0;

/// A share of the longest edge well above the rounding of f64 and well below everything else.
pub(super) const ROUNDING: f64 = 1e-9;

/// An element, shrunk by [`TOUCH`].
pub(super) struct Probe {
    pub(super) longest: f64,
    pub(super) center: Point,
    /// Unit normal; zero if the element has no area.
    pub(super) normal: Point,
    /// The two triangles that make up the shrunk element.
    pub(super) triangles: [Triangle; 2],
}

impl Probe {
    pub(super) fn of(element: &SizedElement) -> Self {
        let corners = element.corners;
        let center = corners.iter().sum::<Point>() / 4.0;
        let [a, b, c, d] = corners.map(|p| center + (p - center) * (1.0 - TOUCH));
        let normal = (c - a).cross(d - b).normalize_or_zero();
        // The diagonal that lies inside: a reflex corner is an end of it.
        let folded = (b - a).cross(c - a).dot((c - a).cross(d - a)) < 0.0;
        let triangles = if folded { [[a, b, d], [b, c, d]] } else { [[a, b, c], [a, c, d]] };
        Self { longest: element.longest, center, normal, triangles: triangles.map(Triangle) }
    }

    /// Half of an extent, no thinner than a touch.
    pub(super) fn thick(&self, half: f64) -> f64 {
        half.max(TOUCH * self.longest)
    }

    /// How far to move a face with normal `axis` outwards, so that elements flush with it belong.
    pub(super) fn flush(&self, axis: Point) -> f64 {
        self.longest * (ROUNDING + FLUSH * self.normal.dot(axis).abs())
    }

    /// Distance from the centre to the farthest corner.
    pub(super) fn radius(&self) -> f64 {
        let corners = self.triangles.iter().flat_map(|t| t.0);
        corners.map(|p| p.distance_squared(self.center)).fold(0.0, f64::max).sqrt()
    }

    /// The point of the element nearest to `p`.
    pub(super) fn closest_point(&self, p: Point) -> Point {
        let [q, r] = self.triangles.map(|t| t.closest_point(p));
        if r.distance_squared(p) < q.distance_squared(p) { r } else { q }
    }

    /// The distance between the element and a solid given by its closest points: projections to and fro
    /// between both, started at the nearest of corners and centre and sped up by momentum (Beck and
    /// Teboulle's FISTA). Never too small. Too large by hundredths of the longest edge at worst where
    /// a convex solid passes at a shallow angle; beside others at most what corners and centre give.
    pub(super) fn distance_to(&self, closest: impl Fn(Point) -> Point) -> f64 {
        /// Projections, each one question to the solid.
        const STEPS: u32 = 16;
        let gap = |p: Point| p.distance(closest(p));
        let corners = self.triangles.iter().flat_map(|t| t.0).map(|p| (gap(p), p));
        let nearer = |best: (f64, Point), next: (f64, Point)| if next.0 < best.0 { next } else { best };
        let (mut least, start) = corners.fold((gap(self.center), self.center), nearer);
        let (mut before, mut ahead) = (start, closest(start));
        for k in 1..=STEPS {
            let here = self.closest_point(ahead);
            let k = f64::from(k);
            let leap = here + (here - before) * ((k - 1.0) / (k + 2.0));
            ahead = closest(leap);
            least = least.min(gap(here));
            before = here;
        }
        least
    }
}

/// The smallest box around an element.
pub(super) fn bounds(element: &SizedElement) -> Aabb {
    Aabb::around(&element.corners)
}
