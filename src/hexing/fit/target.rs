//! Where on the solid a node belongs.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use super::super::correspondence::{Anchor, Reduction};
use crate::geometry::{Point, triangle_weights};
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

    /// The same, for a node that stood on the `last` facet, which is remembered from foot to foot: where it still stands
    /// there, that need not be looked for.
    fn foot_from(&self, _last: &AtomicU32, anchor: Anchor, p: Point) -> Option<Foot> {
        self.foot(anchor, p)
    }

    /// The solid, if there is one, along whose curves nodes can be spread.
    fn solid(&self) -> Option<&SolidModel> {
        None
    }
}

/// A surface is flat if no point of it is farther from its plane than this share of the solid's diagonal.
const FLAT: f64 = 1e-9;

/// A node stands on a facet that is no farther from it than this share of the solid's diagonal.
const ON: f64 = 1e-12;

/// And it stands at the edges of one if the weight of a corner is no more than this.
const INSIDE: f64 = 1e-6;

/// A solid, of which some surfaces stand for others.
pub(in super::super) struct OnSolid<'a> {
    solid: &'a SolidModel,
    reduction: &'a Reduction,
    /// The plane of each flat surface that stands for itself alone: feet there need no search, and may lie beyond the
    /// surface's curves, as its nodes do not.
    planes: Vec<Option<Plane>>,
    /// How far a node that stands on a facet is from it at most, squared.
    on_squared: f64,
}

struct Plane {
    point: Point,
    normal: Point,
}

impl<'a> OnSolid<'a> {
    pub(in super::super) fn new(solid: &'a SolidModel, reduction: &'a Reduction) -> Self {
        let planes =
            (0..solid.surfaces().len()).map(SurfaceId::new).map(|s| plane(solid, reduction, s)).collect();
        let on = ON * solid.diagonal();
        Self { solid, reduction, planes, on_squared: on * on }
    }
}

impl OnSolid<'_> {
    /// The foot of `p`, if it stands on this triangle of the solid, which is of the surface, and not at its edges: the same as
    /// that which is found.
    fn standing(&self, triangle: usize, surface: SurfaceId, p: Point) -> Option<Foot> {
        let &direction = self.solid.normals().get(triangle)?;
        let corners = self.solid.corners_of(triangle);
        let [a, b, c] = triangle_weights(p, corners);
        let point = corners[0] * a + corners[1] * b + corners[2] * c;
        let is_there = a.min(b).min(c) > INSIDE
            && point.distance_squared(p) <= self.on_squared
            && self.reduction.surface(self.solid.surface_of(triangle)) == surface;
        is_there.then_some(Foot { point, direction })
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

    fn foot_from(&self, last: &AtomicU32, anchor: Anchor, p: Point) -> Option<Foot> {
        let Anchor::Surface(surface) = anchor else { return self.foot(anchor, p) };
        if self.planes[surface.index()].is_some() {
            return self.foot(anchor, p);
        }
        if let Some(foot) = self.standing(last.load(Relaxed) as usize, surface, p) {
            return Some(foot);
        }
        let foot = self.reduction.nearest_on_surface(self.solid, surface, p);
        last.store(foot.triangle, Relaxed);
        Some(Foot { point: foot.point, direction: foot.normal })
    }

    fn solid(&self) -> Option<&SolidModel> {
        Some(self.solid)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::Silent;
    use crate::hexing::correspondence::correspond;
    use crate::mesh::{GridOptions, hex_grid};
    use crate::solid::testing::{moved, solid, voxels};

    #[test]
    fn the_foot_is_the_same_whatever_facet_is_remembered() {
        let bend = |p: Point| if p.z == 3.0 { p + Point::Z * (0.1 * p.x * (6.0 - p.x)) } else { p };
        let solid = solid(&moved(voxels([6, 3, 3], |_| true), bend));
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: true, max_hexes: 1000 };
        let mesh = hex_grid(solid.bounds(), &options).unwrap();
        let on = correspond(&mesh, &solid, &Silent).unwrap();
        let target = OnSolid::new(&solid, &on.reduction);
        let general =
            (0..solid.surfaces().len()).map(SurfaceId::new).find(|s| target.planes[s.index()].is_none());
        let top = general.expect("the top is bent");
        let of_top = |t: usize| solid.surface_of(t) == top;
        let count = solid.triangles().len();
        assert!((0..count).any(of_top) && !(0..count).all(of_top));
        for t in (0..count).filter(|&t| of_top(t)) {
            let [a, b, c] = solid.corners_of(t);
            let normal = solid.normals()[t];
            let places =
                [(a + b + c) / 3.0, (a + b) / 2.0, a, a.lerp(b, 0.3) + normal * 0.2, c - normal * 0.1];
            for (k, p) in places.into_iter().enumerate() {
                let found = target.foot(Anchor::Surface(top), p).unwrap();
                for remembered in 0..=count as u32 {
                    let last =
                        AtomicU32::new(if remembered as usize == count { u32::MAX } else { remembered });
                    let foot = target.foot_from(&last, Anchor::Surface(top), p).unwrap();
                    assert_eq!(foot, found, "{t} {k} {remembered}");
                    assert!(of_top(last.into_inner() as usize));
                }
            }
            // The middle of a facet that is remembered is not looked for: it is the facet's own.
            let last = AtomicU32::new(t as u32);
            let foot = target.foot_from(&last, Anchor::Surface(top), places[0]).unwrap();
            assert_eq!((foot.direction, last.into_inner()), (normal, t as u32));
            assert!(target.standing(t, top, places[0]).is_some());
            assert!(places[1..].iter().all(|&p| target.standing(t, top, p).is_none()));
        }
    }
}
