//! Where on the solid a node belongs.

use super::super::correspondence::{Anchor, Reduction};
use crate::geometry::Point;
use crate::solid::SolidModel;

/// The point of a corner, curve or surface that is nearest to a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Foot {
    pub(super) point: Point,
    /// The unit normal of a surface, the unit tangent of a curve.
    pub(super) direction: Point,
}

/// Finds feet.
pub(super) trait Target: Sync {
    /// The foot of a node at `p`; `None` for nodes that are inside.
    fn foot(&self, anchor: Anchor, p: Point) -> Option<Foot>;
}

/// A solid, of which some surfaces stand for others.
pub(super) struct OnSolid<'a> {
    pub(super) solid: &'a SolidModel,
    pub(super) reduction: &'a Reduction,
}

impl Target for OnSolid<'_> {
    fn foot(&self, anchor: Anchor, p: Point) -> Option<Foot> {
        match anchor {
            Anchor::Inside => None,
            Anchor::Surface(surface) => {
                let foot = self.reduction.nearest_on_surface(self.solid, surface, p);
                Some(Foot { point: foot.point, direction: foot.normal })
            }
            Anchor::Curve(curve) => {
                let foot = self.solid.nearest_on_curve(curve, p);
                Some(Foot { point: foot.point, direction: foot.tangent })
            }
            Anchor::Corner(corner) => {
                let point = self.solid.corners()[corner.index()].point;
                Some(Foot { point, direction: Point::ZERO })
            }
        }
    }
}
