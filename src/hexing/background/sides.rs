//! The two sides of a thin shell, and its rim.
//!
//! ```text
//!        one side
//!     .--------------.        A triangle is of a side if what is behind it, as far as the shell is thick on the whole, faces
//!   r |              | r      the other way. Those of the rim have more behind them.
//!     '--------------'
//!        the other
//! ```
//!
//! A shell has two sides that hang together, each of which is behind the other: plates, bent or curved both ways, bowls, pipes and
//! hollow bodies; none with ribs, or whose thickness changes by more than a factor of about two.

use crate::geometry::{NearestTriangle, Point, area_vector};
use crate::mesh::topology::Sets;
use crate::solid::{Curve, CurveId, SolidModel, SurfaceId};
use crate::{Cancelled, Monitor, parallel};

/// What is behind a triangle is looked for at these shares of the mean thickness.
const BEHIND: [f64; 2] = [0.75, 1.5];

/// The cosine between the normals of two triangles that face each other, at most.
const FACING: f64 = -0.7;

/// The share of the sides that has the other behind it, at least: at sharp edges what is behind is as far as these; and of all area
/// that is of a side or of the rim.
const MOST: f64 = 0.85;

/// So many triangles are looked at first: where of less than half their area something faces them from behind, the solid is no
/// shell.
const SAMPLES: usize = 2048;
const HALF: f64 = 0.5;

/// Of a side that is less than this share of the other nothing is known.
const LEAST: f64 = 0.3;

/// The cosine between the normals of triangles of one part that is of no side, at least.
const SMOOTH: f64 = 0.7;

/// Degrees: where surfaces of the rim meet at an angle so far from a straight one the rim turns.
const CORNER: f64 = 45.0;

/// No triangle.
const NONE: u32 = u32::MAX;

/// The sides of a shell.
#[derive(Debug)]
pub(super) struct Sides {
    /// From side to side, on the mean.
    pub(super) thickness: f64,
    /// Each side's triangles; the larger side first.
    sides: [NearestTriangle; 2],
    rim: NearestTriangle,
    corners: Vec<Turn>,
}

/// Where a rim turns: the middle of the curve from side to side there.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Turn {
    pub(super) place: Point,
    pub(super) is_outward: bool,
}

impl Sides {
    /// The sides of a solid, if it is a shell.
    pub(super) fn of(solid: &SolidModel, monitor: &dyn Monitor) -> Result<Option<Self>, Cancelled> {
        let count = solid.triangles().len();
        let area = |t: usize| area_vector(&solid.corners_of(t)).length();
        let thickness = thickness(solid);
        let samples: Vec<usize> = (0..count).step_by(count.div_ceil(SAMPLES).max(1)).collect();
        let facing =
            parallel::try_filter(samples.len(), monitor, |k| behind(solid, samples[k], thickness) != NONE)?;
        let sampled: f64 = samples.iter().map(|&t| area(t)).sum();
        if facing.iter().map(|&k| area(samples[k as usize])).sum::<f64>() < HALF * sampled {
            return Ok(None);
        }
        let total = solid.area();
        let behind = parallel::try_collect(count, monitor, |t| behind(solid, t, thickness))?;
        let parts = parts(solid, &behind);

        let mut areas = vec![0.0; count];
        (0..count).filter(|&t| behind[t] != NONE).for_each(|t| areas[parts[t] as usize] += area(t));
        let greatest = |but: usize| {
            let others = (0..count).filter(|&part| part != but && areas[part] > 0.0);
            others.reduce(|a, b| if areas[b] > areas[a] { b } else { a })
        };
        let Some(first) = greatest(count) else { return Ok(None) };
        let Some(second) = greatest(first) else { return Ok(None) };
        let side_of = |t: usize| match parts[t] as usize {
            part if part == first => Some(0),
            part if part == second => Some(1),
            _ => None,
        };
        let faces_other = |t: &usize| {
            let other = behind[*t];
            other != NONE && side_of(*t).zip(side_of(other as usize)).is_some_and(|(a, b)| a != b)
        };
        let of_sides = areas[first] + areas[second];
        let facing: f64 = (0..count).filter(faces_other).map(area).sum();
        let others: f64 = areas.iter().sum::<f64>() - of_sides;
        if areas[second] < LEAST * areas[first] || facing < MOST * of_sides || others > (1.0 - MOST) * total {
            return Ok(None);
        }
        let is_rim =
            |surface: SurfaceId| side_of(solid.surfaces()[surface.index()].triangles[0] as usize).is_none();
        let is_corner = |curve: &Curve| {
            curve.sharpness() > CORNER && curve.ends.is_some() && curve.sides.into_iter().all(is_rim)
        };
        let curves = solid.curves().iter().enumerate().filter(|(_, curve)| is_corner(curve));
        let turn = |(c, curve): (usize, &Curve)| Turn {
            place: solid.point_on_curve(CurveId::new(c), 0.5 * curve.length),
            is_outward: curve.interior_angle < 180.0,
        };
        let corners = curves.map(turn).collect();
        let of_side = |side: usize| {
            let triangles = (0..count).filter(|&t| side_of(t) == Some(side));
            NearestTriangle::of(triangles.map(|t| solid.corners_of(t)))
        };
        let rim = (0..count).filter(|&t| side_of(t).is_none()).map(|t| solid.corners_of(t));
        Ok(Some(Self {
            thickness: 2.0 * solid.volume() / of_sides,
            sides: [0, 1].map(of_side),
            rim: NearestTriangle::of(rim),
            corners,
        }))
    }

    /// The points of both sides that are nearest to `p`.
    pub(super) fn feet(&self, p: Point) -> [Point; 2] {
        self.sides.each_ref().map(|side| side.closest_point(p).expect("a side has triangles"))
    }

    /// How far `p` is from either side.
    pub(super) fn distances(&self, p: Point) -> [f64; 2] {
        self.feet(p).map(|foot| foot.distance(p))
    }

    /// Is `p` beyond the rim, or nearer to it than `margin`? What is beyond is nearest to points of the sides that are at the rim.
    pub(super) fn is_at_rim(&self, p: Point, margin: f64) -> bool {
        self.feet(p).into_iter().all(|foot| self.rim.nearest_within(foot, margin).is_some())
    }

    /// Where the rim turns.
    pub(super) fn corners(&self) -> &[Turn] {
        &self.corners
    }

    /// The point of the rim that is nearest to `p`, if there is a rim.
    pub(super) fn foot_on_rim(&self, p: Point) -> Option<Point> {
        self.rim.closest_point(p)
    }
}

/// How thick a solid is if it is a shell, or a little less.
pub(in super::super) fn thickness(solid: &SolidModel) -> f64 {
    2.0 * solid.volume() / solid.area()
}

/// The triangle that faces a triangle from behind, or [`NONE`].
fn behind(solid: &SolidModel, t: usize, thickness: f64) -> u32 {
    let [a, b, c] = solid.corners_of(t);
    let (middle, normal) = ((a + b + c) / 3.0, solid.normals()[t]);
    let facing = |share: f64| {
        let foot = solid.nearest(middle - normal * (share * thickness));
        let is_behind = foot.normal.dot(normal) < FACING && (middle - foot.point).dot(normal) > 0.0;
        is_behind.then_some(foot.triangle)
    };
    BEHIND.into_iter().find_map(facing).unwrap_or(NONE)
}

/// For each triangle the least one of its part: of a side, or of the rim. At sharp edges outwards there is as much behind triangles as
/// at the rim; but what they lie between are not two sides that face each other.
fn parts(solid: &SolidModel, behind: &[u32]) -> Vec<u32> {
    let mut is_side: Vec<bool> = behind.iter().map(|&t| t != NONE).collect();
    let normal = |t: usize| solid.normals()[t];
    let is_smooth = |a: usize, b: usize| is_side[a] || normal(a).dot(normal(b)) > SMOOTH;
    let part = joined(solid, |a, b| is_side[a] == is_side[b] && is_smooth(a, b));
    let mut facing = Sets::new(behind.len());
    for (t, &other) in behind.iter().enumerate().filter(|(_, other)| **other != NONE) {
        facing.join(part[t], part[other as usize], true);
    }
    // A part of the sides beside each part that is of none, and whether there is one that faces it.
    let (mut beside, mut is_rim) = (vec![None; behind.len()], vec![false; behind.len()]);
    for t in (0..behind.len()).filter(|&t| behind[t] == NONE) {
        for other in across(solid, t).into_iter().filter(|&other| is_side[other]) {
            let (root, odd) = facing.root(part[other]);
            let first = *beside[part[t] as usize].get_or_insert((root, odd));
            is_rim[part[t] as usize] |= first == (root, !odd);
        }
    }
    for t in (0..behind.len()).filter(|&t| behind[t] == NONE) {
        is_side[t] = beside[part[t] as usize].is_some() && !is_rim[part[t] as usize];
    }
    joined(solid, |a, b| is_side[a] == is_side[b])
}

/// For each triangle the least one with which it hangs together, over edges between triangles that belong together.
fn joined(solid: &SolidModel, belong: impl Fn(usize, usize) -> bool) -> Vec<u32> {
    let count = solid.triangles().len();
    let mut sets = Sets::new(count);
    for t in 0..count {
        for other in across(solid, t).into_iter().filter(|&other| belong(t, other)) {
            sets.join(t as u32, other as u32, false);
        }
    }
    (0..count as u32).map(|t| sets.root(t).0).collect()
}

/// The triangles across the edges of one.
fn across(solid: &SolidModel, t: usize) -> [usize; 3] {
    [0, 1, 2].map(|side| solid.across(t, side) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Silent;
    use crate::mesh::PolygonMesh;
    use crate::solid::testing::{bent, cuboid, cylinder, ell, hollow_ball, moved, solid, voxels};

    fn sides(surface: &PolygonMesh) -> Option<Sides> {
        Sides::of(&solid(surface), &Silent).unwrap()
    }

    #[test]
    fn plates_have_two_sides_a_rim_and_corners() {
        let height = |x: f64, y: f64| 0.02 * (x * x - y * y);
        let sides = sides(&bent(16, 0.3, height)).unwrap();
        assert!((sides.thickness - 0.3).abs() < 0.01, "{}", sides.thickness);
        assert!(sides.corners().iter().all(|turn| turn.is_outward));
        let mut corners: Vec<Point> = sides.corners().iter().map(|turn| turn.place).collect();
        corners.sort_unstable_by(|a, b| a.x.total_cmp(&b.x).then(a.y.total_cmp(&b.y)));
        let expected = [[-8.0, -8.0], [-8.0, 8.0], [8.0, -8.0], [8.0, 8.0]];
        assert_eq!(corners.len(), 4);
        for (corner, [x, y]) in corners.iter().zip(expected) {
            assert!(corner.distance(Point::new(x, y, 0.0)) < 1e-9, "{corner}");
        }
        // Within, at the rim, and beyond it.
        let at = |x: f64| Point::new(x, 1.0, height(x, 1.0) + 0.1);
        assert_eq!(
            [6.0, 7.2, 7.9, 8.5, 12.0].map(|x| sides.is_at_rim(at(x), 0.5)),
            [false, false, true, true, true]
        );
        let [a, b] = sides.distances(at(3.0));
        assert!((a + b - 0.3).abs() < 0.01 && (a - b).abs() > 0.15);
        let foot = sides.foot_on_rim(at(7.5)).unwrap();
        assert!((foot.x - 8.0).abs() < 0.15, "{foot}");
    }

    #[test]
    fn closed_shells_have_no_rim() {
        let sides = sides(&hollow_ball(8, 5.0, 0.4)).unwrap();
        assert_eq!((sides.corners().len(), sides.foot_on_rim(Point::X)), (0, None));
        let [outer, inner] = sides.feet(Point::new(4.8, 0.0, 0.0));
        assert!((outer.x - 5.0).abs() < 0.1 && (inner.x - 4.6).abs() < 0.1, "{outer} {inner}");
    }

    #[test]
    fn pipes_have_rims_without_corners() {
        let ring = voxels([24, 1, 6], |_| true);
        let bent = |p: Point| {
            let (sin, cos) = libm::sincos(p.x / 24.0 * 4.5);
            Point::new((4.0 + 0.3 * p.y) * cos, (4.0 + 0.3 * p.y) * sin, p.z)
        };
        assert_eq!(sides(&moved(ring, bent)).unwrap().corners().len(), 4);
        let tube = voxels([21, 21, 8], |[x, y, _]| x % 20 == 0 || y % 20 == 0);
        assert!(sides(&tube).unwrap().corners().is_empty());
    }

    /// Blocks and rods; a plate with a rib, whose sides are three.
    #[test]
    fn solids_without_two_sides_are_no_shells() {
        let ribbed = voxels([12, 12, 6], |[x, _, z]| z == 0 || x == 5);
        for surface in [cuboid([3, 3, 3]), cuboid([12, 1, 1]), cylinder(24), ell(), ribbed] {
            assert!(sides(&surface).is_none());
        }
    }
}
