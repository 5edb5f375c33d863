//! What holds each node while the mesh is fitted: nothing, a pull to its foot on the solid, or the solid itself.

use super::super::correspondence::Anchor;
use super::target::Target;
use crate::geometry::Point;
use crate::mesh::NodeId;
use crate::optimize::{Guide, Pull, Symmetric};

/// A node is drawn to the tangent plane at its foot, and by this share to the foot itself.
const TO_THE_FOOT: f64 = 0.15;

/// Along its curve a node is drawn to its place by this share of what draws it across.
const ALONG: f64 = 0.3;

/// What holds a node.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Hold {
    /// Nothing: it is inside, or the mesh is being inflated.
    Free,
    /// It is drawn to its foot; while the pull has no weight it keeps its distance.
    Drawn,
    /// It is on the solid, and slides there.
    Held,
    /// It stays where it is.
    Pinned,
}

/// The holds of all nodes of a mesh.
pub(super) struct Holds<'a> {
    pub(super) target: &'a dyn Target,
    pub(super) anchors: &'a [Anchor],
    pub(super) holds: Vec<Hold>,
    /// Where on its curve a node is drawn, if that is not its foot.
    pub(super) places: Vec<Option<Point>>,
    /// Of the pull, where lengths are in units of the node's mean edge.
    pub(super) weight: f64,
    /// The share of that for nodes of surfaces.
    pub(super) surfaces: f64,
}

impl<'a> Holds<'a> {
    /// All nodes free.
    pub(super) fn free(target: &'a dyn Target, anchors: &'a [Anchor]) -> Self {
        Self::of(target, anchors, vec![Hold::Free; anchors.len()])
    }

    /// All boundary nodes drawn.
    pub(super) fn drawn(target: &'a dyn Target, anchors: &'a [Anchor]) -> Self {
        let hold = |&anchor: &Anchor| if anchor == Anchor::Inside { Hold::Free } else { Hold::Drawn };
        Self::of(target, anchors, anchors.iter().map(hold).collect())
    }

    /// With the holds given.
    pub(super) fn of(target: &'a dyn Target, anchors: &'a [Anchor], holds: Vec<Hold>) -> Self {
        Self { target, anchors, places: vec![None; holds.len()], holds, weight: 0.0, surfaces: 1.0 }
    }

    pub(super) fn is(&self, node: NodeId, hold: Hold) -> bool {
        self.holds[node.index()] == hold
    }

    /// Holds the node in another way, if it is held in this one.
    pub(super) fn replace(&mut self, node: NodeId, held: Hold, by: Hold) {
        let hold = &mut self.holds[node.index()];
        if *hold == held {
            *hold = by;
        }
    }

    /// The nodes that are drawn.
    pub(super) fn stuck(&self) -> usize {
        self.holds.iter().filter(|&&hold| hold == Hold::Drawn).count()
    }
}

impl Guide for Holds<'_> {
    fn tangent(&self, node: NodeId, p: Point) -> Symmetric {
        let foot = || self.target.foot(self.anchors[node.index()], p);
        let across = |v: Point| Symmetric::IDENTITY + Symmetric::outer(v) * -1.0;
        match self.holds[node.index()] {
            Hold::Free => Symmetric::IDENTITY,
            Hold::Drawn if self.weight > 0.0 => Symmetric::IDENTITY,
            Hold::Drawn => {
                let away = foot().map_or(Point::ZERO, |foot| p - foot.point);
                across(away.normalize_or_zero())
            }
            Hold::Pinned => Symmetric::default(),
            Hold::Held => match (self.anchors[node.index()], foot()) {
                (Anchor::Surface(_), Some(foot)) => across(foot.direction),
                (Anchor::Curve(_), Some(foot)) => Symmetric::outer(foot.direction),
                _ => Symmetric::default(),
            },
        }
    }

    fn project(&self, node: NodeId, _: Point, p: Point) -> Point {
        match self.holds[node.index()] {
            Hold::Held => self.target.foot(self.anchors[node.index()], p).map_or(p, |foot| foot.point),
            _ => p,
        }
    }

    fn pull(&self, node: NodeId, p: Point, size: f64) -> Option<Pull> {
        if self.weight == 0.0 || !self.is(node, Hold::Drawn) {
            return None;
        }
        let anchor = self.anchors[node.index()];
        let foot = self.target.foot(anchor, p)?;
        let along = Symmetric::outer(foot.direction);
        let place = self.places[node.index()];
        let shape = match (anchor, place) {
            (Anchor::Surface(_), _) => (along + Symmetric::IDENTITY * TO_THE_FOOT) * self.surfaces,
            (Anchor::Curve(_), None) => Symmetric::IDENTITY * (1.0 + TO_THE_FOOT) + along * -1.0,
            (Anchor::Curve(_), Some(_)) => Symmetric::IDENTITY + along * (ALONG - 1.0),
            _ => Symmetric::IDENTITY,
        };
        Some(Pull { to: place.unwrap_or(foot.point), weight: shape * (self.weight / (size * size)) })
    }
}
