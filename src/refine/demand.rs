//! Which elements the options want finer: what refinement and its estimate have in common.

use super::options::{QuadOptions, RefineError, validate, validate_digits};
use crate::geometry::Point;
use crate::mesh::{FaceId, PolygonMesh};
use crate::parallel;
use crate::sizing::{SizeField, SizeOptions, SizedElement};
use crate::{Cancelled, Monitor};

/// The options, checked and made ready for many questions.
pub(super) struct Demand {
    /// Every element of a lower level is wanted finer.
    everywhere: u8,
    field: SizeField,
}

impl Demand {
    pub fn new(
        input: &PolygonMesh,
        options: &QuadOptions,
        monitor: &dyn Monitor,
    ) -> Result<Self, RefineError> {
        validate(input, options, monitor)?;
        let &QuadOptions { edge_length, curvature, gradation, ref regions, .. } = options;
        let field =
            SizeField::new(input, SizeOptions { edge_length, curvature, gradation, regions }, monitor)?;
        let demand = Self { everywhere: options.levels.unwrap_or(0), field };
        let longest_edge = |f: usize| outline(&face_points(input, f)).1;
        let longest = parallel::try_greatest(input.face_count(), monitor, longest_edge)?;
        validate_digits(input, longest, demand.deepest(options.max_levels))?;
        Ok(demand)
    }

    /// How many levels more every element of `level` is to be refined, and none further, if that is known.
    pub fn uniform_levels_from(&self, level: u8, max_levels: u8) -> u8 {
        let last = self.everywhere.min(max_levels);
        if self.is_idle_from(last) { last.saturating_sub(level) } else { 0 }
    }

    /// True if every element of `level` is wanted finer.
    pub fn is_uniform_at(&self, level: u8) -> bool {
        level < self.everywhere
    }

    /// True if no element of `level` or deeper can be wanted finer.
    pub fn is_idle_from(&self, level: u8) -> bool {
        !self.is_uniform_at(level) && self.field.is_idle_from(level)
    }

    /// The level below which nothing is wanted finer, at most `max_levels`.
    pub fn deepest(&self, max_levels: u8) -> u8 {
        (0..max_levels).find(|&level| self.is_idle_from(level)).unwrap_or(max_levels)
    }

    /// The regions that overlap no part of the input, by their places among the options'.
    pub fn idle_regions(&self, input: &PolygonMesh, monitor: &dyn Monitor) -> Result<Vec<u32>, Cancelled> {
        self.field.idle_regions(input.face_count(), monitor, |f| {
            let points = face_points(input, f);
            let root = Some(FaceId::new(f));
            let element = |corners| SizedElement { corners, longest: outline(&corners).1, level: 1, root };
            corner_quads(&points).map(element).collect::<Vec<SizedElement>>()
        })
    }

    /// True if an element of `level`, part of input face `root`, is wanted finer.
    #[inline]
    pub fn wants(&self, corners: [Point; 4], longest: f64, level: u8, root: FaceId) -> bool {
        self.is_uniform_at(level)
            || self.field.wants(&SizedElement { corners, longest, level, root: Some(root) })
    }
}

/// The positions of the nodes of an input face.
pub(super) fn face_points(input: &PolygonMesh, face: usize) -> Vec<Point> {
    input.face(face).iter().map(|n| input.positions[n.index()]).collect()
}

/// The quads of a polygon's first refinement: one at each corner.
pub(super) fn corner_quads(points: &[Point]) -> impl Iterator<Item = [Point; 4]> + '_ {
    let (center, _) = outline(points);
    (0..points.len()).map(move |i| corner_quad(points, center, i))
}

/// The quad at corner `i` of a polygon around `center`.
#[inline]
pub(super) fn corner_quad(points: &[Point], center: Point, i: usize) -> [Point; 4] {
    let n = points.len();
    let (here, before, after) = (points[i], points[(i + n - 1) % n], points[(i + 1) % n]);
    [here, (here + after) * 0.5, center, (before + here) * 0.5]
}

/// The mean of a polygon's nodes and the length of its longest edge.
#[inline]
pub(super) fn outline(points: &[Point]) -> (Point, f64) {
    let mut longest = 0.0_f64;
    let mut before = points[points.len() - 1];
    for &p in points {
        longest = longest.max(p.distance_squared(before));
        before = p;
    }
    (points.iter().sum::<Point>() / points.len() as f64, longest.sqrt())
}
