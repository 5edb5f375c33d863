//! Where on the solid a node belongs.

use super::super::correspondence::{Anchor, Reduction};
use crate::geometry::Point;
use crate::solid::{SolidModel, SurfaceClass, SurfaceId};

/// The point of a corner, curve or surface that is nearest to a node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in super::super) struct Foot {
    pub(in super::super) point: Point,
    /// The unit normal of a surface, the unit tangent of a curve.
    pub(in super::super) direction: Point,
}

/// Finds feet.
pub(in super::super) trait Target: Sync {
    /// The foot of a node at `p`; `None` for nodes that are inside.
    fn foot(&self, anchor: Anchor, p: Point) -> Option<Foot>;

    /// The solid, if there is one, along whose curves nodes can be spread.
    fn solid(&self) -> Option<&SolidModel> {
        None
    }
}

/// A surface is flat if no point of it is farther from its plane than this share of the solid's diagonal.
const FLAT: f64 = 1e-9;

/// A solid, of which some surfaces stand for others.
pub(in super::super) struct OnSolid<'a> {
    solid: &'a SolidModel,
    reduction: &'a Reduction,
    /// The plane of each flat surface that stands for itself alone: feet there need no search, and may lie beyond the
    /// surface's curves, as its nodes do not.
    planes: Vec<Option<Plane>>,
}

struct Plane {
    point: Point,
    normal: Point,
}

impl<'a> OnSolid<'a> {
    pub(in super::super) fn new(solid: &'a SolidModel, reduction: &'a Reduction) -> Self {
        let planes =
            (0..solid.surfaces().len()).map(SurfaceId::new).map(|s| plane(solid, reduction, s)).collect();
        Self { solid, reduction, planes }
    }
}

fn plane(solid: &SolidModel, reduction: &Reduction, s: SurfaceId) -> Option<Plane> {
    let surface = &solid.surfaces()[s.index()];
    let SurfaceClass::Planar { normal } = surface.class else { return None };
    let mut points = surface.triangles.iter().flat_map(|&t| solid.corners_of(t as usize));
    let point = points.next()?;
    let is_near = |p: Point| normal.dot(p - point).abs() <= FLAT * solid.diagonal();
    (reduction.members(s) == [s] && points.all(is_near)).then_some(Plane { point, normal })
}

impl Target for OnSolid<'_> {
    fn foot(&self, anchor: Anchor, p: Point) -> Option<Foot> {
        match anchor {
            Anchor::Inside => None,
            Anchor::Surface(surface) => Some(match &self.planes[surface.index()] {
                Some(plane) => {
                    let point = p - plane.normal * plane.normal.dot(p - plane.point);
                    Foot { point, direction: plane.normal }
                }
                None => {
                    let foot = self.reduction.nearest_on_surface(self.solid, surface, p);
                    Foot { point: foot.point, direction: foot.normal }
                }
            }),
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

    fn solid(&self) -> Option<&SolidModel> {
        Some(self.solid)
    }
}
