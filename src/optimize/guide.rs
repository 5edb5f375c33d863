//! What nodes are kept on and what draws them, as sweeps ask for it.

use super::symmetric::Symmetric;
use crate::geometry::Point;
use crate::mesh::NodeId;

/// Says of each node where it may go and where it is drawn.
pub(crate) trait Guide: Sync {
    /// The projector to the directions in which the node may go from `p`.
    fn tangent(&self, node: NodeId, p: Point) -> Symmetric;

    /// Where the node may be that is near to `p`.
    fn project(&self, node: NodeId, p: Point) -> Point;

    /// What draws the node when it is at `p`, with edges of the mean length `size`.
    fn pull(&self, _node: NodeId, _p: Point, _size: f64) -> Option<Pull> {
        None
    }
}

/// All nodes go anywhere.
pub(crate) struct Free;

impl Guide for Free {
    fn tangent(&self, _: NodeId, _: Point) -> Symmetric {
        Symmetric::IDENTITY
    }

    fn project(&self, _: NodeId, p: Point) -> Point {
        p
    }
}

/// All nodes go anywhere, and are drawn from where they are to where this tells, with this weight.
#[cfg(test)]
pub(crate) struct DrawnTo(pub(crate) fn(Point) -> Point, pub(crate) f64);

#[cfg(test)]
impl Guide for DrawnTo {
    fn tangent(&self, _: NodeId, _: Point) -> Symmetric {
        Symmetric::IDENTITY
    }

    fn project(&self, _: NodeId, p: Point) -> Point {
        p
    }

    fn pull(&self, _: NodeId, p: Point, _: f64) -> Option<Pull> {
        Some(Pull { to: self.0(p), weight: Symmetric::IDENTITY * self.1 })
    }
}

/// A quadratic energy that draws a node: (p - to)^T weight (p - to).
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Pull {
    pub(crate) to: Point,
    pub(crate) weight: Symmetric,
}

impl Pull {
    pub(super) fn energy(&self, p: Point) -> f64 {
        let away = p - self.to;
        away.dot(self.weight.times(away))
    }

    /// Half the gradient at `p`.
    pub(super) fn half_gradient(&self, p: Point) -> Point {
        self.weight.times(p - self.to)
    }
}
