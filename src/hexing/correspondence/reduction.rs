//! What of a solid its mesh cannot show, and what stands for it. The solid's own ids never change.

use crate::geometry::Point;
use crate::solid::{CornerId, CurveId, Foot, SolidModel, SurfaceId};

/// What became of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CurveFate {
    /// A path of edges stands for it.
    Captured,
    /// It shrank to the corner that stands for both of its ends.
    Contracted,
    /// Nothing stands for it: the surfaces at its sides became one, unless one of them was lost.
    Suppressed,
}

/// Why something of the solid was given up.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Reason {
    /// A surface beside it is a step far lower than the edges of the mesh there.
    Low,
    /// It is too short for the edges of the mesh there.
    Short,
    /// No boundary node near a corner at its end is left that as many edges leave as curves.
    NoNode,
    /// No path of boundary edges near it is left that keeps clear of the other curves.
    NoPath,
    /// It is soft, and the cells at it would be poor.
    Costly,
}

/// A curve that was given up.
#[derive(Clone, Debug, PartialEq)]
pub struct LostCurve {
    /// The curve.
    pub curve: CurveId,
    /// Contracted or suppressed.
    pub fate: CurveFate,
    /// Why.
    pub reason: Reason,
    /// The middle of the curve.
    pub place: Point,
    /// Its length, in model units.
    pub length: f64,
}

/// A surface that no boundary face stands for, by itself or among others.
#[derive(Clone, Debug, PartialEq)]
pub struct LostSurface {
    /// The surface.
    pub surface: SurfaceId,
    /// The middle of its bounds.
    pub place: Point,
    /// Its area, in model units squared.
    pub area: f64,
}

/// What of the solid was given up, and what stands for it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Reduction {
    /// Per curve.
    pub(super) curves: Vec<CurveFate>,
    /// Per corner the corner that stands for it.
    pub(super) corners: Vec<CornerId>,
    /// Per surface the surface that stands for it.
    pub(super) surfaces: Vec<SurfaceId>,
    /// Per surface that stands for others or for itself, those it stands for; none if it was lost.
    pub(super) members: Vec<Vec<SurfaceId>>,
    /// Curves that were given up, ascending.
    pub lost_curves: Vec<LostCurve>,
    /// Surfaces without a face, ascending.
    pub lost_surfaces: Vec<LostSurface>,
    /// Corners without a node that no other corner stands for, ascending: no captured curve ends there.
    pub lost_corners: Vec<CornerId>,
}

impl Reduction {
    /// The surface that stands for `s`: the least of those that became one.
    pub fn surface(&self, s: SurfaceId) -> SurfaceId {
        self.surfaces[s.index()]
    }

    /// The corner that stands for `c`: itself, or one that short curves joined to it.
    pub fn corner(&self, c: CornerId) -> CornerId {
        self.corners[c.index()]
    }

    /// What became of a curve.
    pub fn curve(&self, c: CurveId) -> CurveFate {
        self.curves[c.index()]
    }

    /// The surfaces that `representative` stands for, ascending. None if it was lost, or another stands for it.
    pub fn members(&self, representative: SurfaceId) -> &[SurfaceId] {
        &self.members[representative.index()]
    }

    /// How many curves have that fate.
    pub fn count(&self, fate: CurveFate) -> usize {
        self.curves.iter().filter(|&&f| f == fate).count()
    }

    /// Notes that a captured curve is given up, and unites the surfaces at its sides.
    pub(super) fn give_up(&mut self, solid: &SolidModel, curve: CurveId, reason: Reason) {
        let of_solid = &solid.curves()[curve.index()];
        let place = solid.point_on_curve(curve, 0.5 * of_solid.length);
        self.curves[curve.index()] = CurveFate::Suppressed;
        let lost = LostCurve { curve, fate: CurveFate::Suppressed, reason, place, length: of_solid.length };
        let at = self.lost_curves.partition_point(|other| other.curve < curve);
        self.lost_curves.insert(at, lost);
        let [a, b] = of_solid.sides.map(|side| self.surface(side));
        let (stays, goes) = (a.min(b), a.max(b));
        if stays != goes {
            let more = std::mem::take(&mut self.members[goes.index()]);
            let members = &mut self.members[stays.index()];
            members.extend(more);
            members.sort_unstable();
            self.surfaces.iter_mut().filter(|s| **s == goes).for_each(|s| *s = stays);
        }
    }

    /// The point nearest to `p` on the surfaces that `representative` stands for. If it stands for none, on itself.
    pub fn nearest_on_surface(&self, solid: &SolidModel, representative: SurfaceId, p: Point) -> Foot {
        let mut best = solid.nearest_on_surface(representative, p);
        for &member in self.members(representative) {
            // Of the many that may have become one most are far off.
            let bounds = &solid.surfaces()[member.index()].bounds;
            if member != representative && bounds.distance_squared(p) < best.distance * best.distance {
                let foot = solid.nearest_on_surface(member, p);
                if foot.distance < best.distance {
                    best = foot;
                }
            }
        }
        best
    }
}
