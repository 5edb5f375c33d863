//! A solid's features as lines and points over its surface or its mesh.

use super::overlay::{Disc, Segment};
use super::{Frame, Rgba, Theme};
use crate::geometry::Point;

/// What a line or point stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeatureKind {
    /// A curve at which the solid is convex.
    Convex,
    /// A curve at which it is concave.
    Concave,
    /// A corner.
    Corner,
    /// What a mesh does not show.
    Lost,
}

/// A polyline, or a point, which is a polyline of one.
#[derive(Clone, Debug, PartialEq)]
pub struct FeatureLine {
    /// What it stands for.
    pub kind: FeatureKind,
    /// World coordinates.
    pub points: Vec<Point>,
}

/// Widths and radii in CSS pixels.
const LINE: f32 = 2.5;
const LINE_LOST: f32 = 3.5;
const POINT: f32 = 4.0;
const POINT_LOST: f32 = 5.5;
const RING: f32 = 1.25;

impl FeatureLine {
    /// The segments of a polyline.
    pub(super) fn segments(&self, frame: &Frame, theme: &Theme) -> impl Iterator<Item = Segment> {
        let width = if self.kind == FeatureKind::Lost { LINE_LOST } else { LINE };
        let colour = self.kind.colour(theme);
        let ends = self.points.windows(2).map(|ends| [ends[0], ends[1]].map(|end| frame.scene(end)));
        ends.map(move |[from, to]| Segment { from, to, width, colour })
    }

    /// The disc of a point.
    pub(super) fn disc(&self, frame: &Frame, theme: &Theme) -> Option<Disc> {
        let &[point] = self.points.as_slice() else { return None };
        let radius = if self.kind == FeatureKind::Lost { POINT_LOST } else { POINT };
        let fill = self.kind.colour(theme);
        Some(Disc { center: frame.scene(point), radius, ring: RING, fill, rim: theme.handle })
    }
}

impl FeatureKind {
    fn colour(self, theme: &Theme) -> Rgba {
        match self {
            Self::Convex => theme.convex,
            Self::Concave => theme.concave,
            Self::Corner => theme.corner,
            Self::Lost => theme.lost,
        }
    }
}
