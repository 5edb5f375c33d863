//! Quads in space as solids: the convex hull of the four corners.

use super::{Aabb, Point, closest_on_triangle};

/// A quad whose corners leave a common plane by less than this share of its diagonals counts as flat.
const FLAT: f64 = 1e-6;

/// The triangles of both diagonals, those of the first one first.
const TRIANGLES: [[usize; 3]; 4] = [[0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3]];

/// The segments between the corners, those around the quad first.
const SEGMENTS: [[usize; 2]; 6] = [[0, 1], [1, 2], [2, 3], [3, 0], [0, 2], [1, 3]];

/// The convex hull of a quad's corners.
///
/// A flat convex quad is its own hull. Of any other quad the hull holds the bilinear surface, the triangles of
/// both diagonals, and every quad that bilinear subdivision makes of it: so a hull holds its children's hulls.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct QuadHull {
    /// The corners, in order around the quad.
    pub corners: [Point; 4],
    /// True if the quad is flat and convex: one diagonal's triangles make up the hull.
    flat: bool,
}

impl QuadHull {
    /// The hull of `corners`, which go around the quad.
    pub fn new(corners: [Point; 4]) -> Self {
        let [a, b, c, d] = corners;
        let (ac, bd) = (c - a, d - b);
        let normal = ac.cross(bd);
        let height = (b - a).dot(normal);
        let longest = ac.length_squared().max(bd.length_squared());
        let level = height * height <= FLAT * FLAT * normal.length_squared() * longest;
        let convex = (0..4).all(|i| {
            let [before, here, after] = [(i + 3) % 4, i, (i + 1) % 4].map(|k| corners[k]);
            (here - before).cross(after - here).dot(normal) > 0.0
        });
        Self { corners, flat: level && convex }
    }

    /// The same hull with its corners moved rigidly.
    pub fn map(&self, rigid: impl Fn(Point) -> Point) -> Self {
        Self { corners: self.corners.map(rigid), flat: self.flat }
    }

    /// The smallest axis-aligned box around it.
    pub fn bounds(&self) -> Aabb {
        Aabb::around(&self.corners)
    }

    /// Triangles that cover the hull's surface.
    pub fn triangles(&self) -> impl Iterator<Item = [Point; 3]> {
        let count = if self.flat { 2 } else { 4 };
        TRIANGLES[..count].iter().map(|t| t.map(|k| self.corners[k]))
    }

    /// The hull's edges as vectors; of a flat hull those around the quad.
    pub fn edges(&self) -> impl Iterator<Item = Point> {
        let count = if self.flat { 4 } else { 6 };
        SEGMENTS[..count].iter().map(|&[i, j]| self.corners[j] - self.corners[i])
    }

    /// Normals of the hull's sides, of any length and sign.
    pub fn normals(&self) -> impl Iterator<Item = Point> {
        let count = if self.flat { 1 } else { 4 };
        TRIANGLES[..count].iter().map(|t| {
            let [a, b, c] = t.map(|k| self.corners[k]);
            (b - a).cross(c - a)
        })
    }

    /// True if `p` lies inside; never for a flat hull.
    pub fn holds(&self, p: Point) -> bool {
        if self.flat {
            return false;
        }
        let volume = |[a, b, c, d]: [Point; 4]| (b - a).cross(c - a).dot(d - a);
        let whole = volume(self.corners);
        whole != 0.0
            && (0..4).all(|i| {
                let mut part = self.corners;
                part[i] = p;
                volume(part) * whole >= 0.0
            })
    }

    /// True if `p` is at most `distance` away.
    pub fn within(&self, p: Point, distance: f64) -> bool {
        let squared = distance * distance;
        self.triangles().any(|t| closest_on_triangle(p, t).distance_squared(p) <= squared) || self.holds(p)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hull(corners: [[f64; 3]; 4]) -> QuadHull {
        QuadHull::new(corners.map(Point::from))
    }

    #[test]
    fn a_square_is_its_own_hull() {
        let square = hull([[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]]);
        assert_eq!(square.triangles().count(), 2);
        assert!(square.within(Point::new(0.5, 0.5, 0.1), 0.1));
        assert!(!square.within(Point::new(0.5, 0.5, 0.1), 0.099));
        assert!(!square.holds(Point::new(0.5, 0.5, 0.0)));
    }

    #[test]
    fn a_twisted_quad_is_solid() {
        let twisted = hull([[0., 0., 0.], [1., 0., 1.], [1., 1., 0.], [0., 1., 1.]]);
        assert_eq!(twisted.triangles().count(), 4);
        assert!(twisted.holds(Point::splat(0.5)));
        assert!(twisted.within(Point::splat(0.5), 0.0));
        assert!(!twisted.holds(Point::ZERO - Point::X * 0.01));
    }

    #[test]
    fn a_dart_is_filled_to_its_hull() {
        let dart = hull([[0., 0., 0.], [4., -2., 0.], [1., 0., 0.], [4., 2., 0.]]);
        assert_eq!(dart.triangles().count(), 4);
        assert!(dart.within(Point::new(3.0, 0.0, 0.0), 1e-12), "in the notch");
    }

    #[test]
    fn quads_of_no_area_do_not_stumble() {
        let line = hull([[0., 0., 0.], [1., 0., 0.], [2., 0., 0.], [3., 0., 0.]]);
        assert!(line.within(Point::new(2.5, 1.0, 0.0), 1.0));
        assert!(!line.within(Point::new(2.5, 1.0, 0.0), 0.99));
        let point = hull([[1., 1., 1.]; 4]);
        assert!(point.within(Point::ONE, 0.0) && !point.within(Point::ZERO, 1.7));
    }

    #[cfg(not(target_arch = "wasm32"))]
    mod random {
        use proptest::prelude::*;

        use super::*;
        use crate::geometry::samples::{of_hull, point, points};

        proptest! {
            #[test]
            fn distances_agree_with_samples(p in point(2.0), corners in points::<4>(1.0), r in 0.0..2.0_f64) {
                let sampled = of_hull(corners, 16).map(|s| s.distance(p)).fold(f64::INFINITY, f64::min);
                let within = QuadHull::new(corners).within(p, r);
                prop_assert!(within || sampled > r - 1e-9, "a sample is at {sampled}");
                // No point of the hull is farther from a sample than a step of the longest edge, over sqrt 2.
                prop_assert!(!within || sampled <= r + 3.5 / 16.0, "the nearest sample is at {sampled}");
            }
        }
    }
}
