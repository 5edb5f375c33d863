//! What each part of the mesh stands for on the solid.

use super::{CurveFate, Reason, Reduction};
use crate::mesh::NodeId;
use crate::solid::{CornerId, CurveId, SolidModel, SurfaceId};

/// Where a node belongs. Corners and surfaces are those that stand for others too, as [`Reduction`] says.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Anchor {
    /// Within the solid: free to move anywhere.
    Inside,
    /// On a surface.
    Surface(SurfaceId),
    /// On a curve.
    Curve(CurveId),
    /// At a corner.
    Corner(CornerId),
}

impl Anchor {
    /// In how many directions the node may move: 3, 2, 1 or 0.
    pub fn freedom(self) -> usize {
        match self {
            Self::Inside => 3,
            Self::Surface(_) => 2,
            Self::Curve(_) => 1,
            Self::Corner(_) => 0,
        }
    }
}

/// Which nodes, edges and faces of a hex mesh's boundary stand for which corners, curves and surfaces of a solid.
///
/// * Every corner that is captured has one node, and no two have the same.
/// * The edges of a captured curve that is open are one simple path from the node of its start to that of its end;
///   those of a closed one are one simple cycle. No node is inside two paths, and no corner's node is inside any.
/// * The faces left and right of a path, seen from outside along the curve, are those of the curve's sides.
/// * A face has one surface. Where no path runs along the edge of two faces, they have the same.
///
/// [`check_correspondence`](super::check_correspondence) looks at all of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Correspondence {
    /// For each node of the mesh.
    pub anchors: Vec<Anchor>,
    /// The boundary edges on curves, each with its lesser node first; ascending.
    pub edges: Vec<([NodeId; 2], CurveId)>,
    /// All boundary faces, anticlockwise seen from outside, in the order of
    /// [`hex_boundary`](crate::mesh::topology::hex_boundary), each with the surface that stands for its own.
    pub faces: Vec<([NodeId; 4], SurfaceId)>,
    /// What of the solid was given up, and what stands for it.
    pub reduction: Reduction,
}

impl Correspondence {
    /// The curve that the edge between two nodes lies on.
    pub fn curve_of(&self, a: NodeId, b: NodeId) -> Option<CurveId> {
        if [a, b].iter().any(|n| self.anchors[n.index()].freedom() > 1) {
            return None;
        }
        let ends = [a.min(b), a.max(b)];
        let at = self.edges.binary_search_by_key(&ends, |&(ends, _)| ends).ok()?;
        Some(self.edges[at].1)
    }

    /// The boundary.
    pub(in super::super) fn quads(&self) -> Vec<[NodeId; 4]> {
        self.faces.iter().map(|&(quad, _)| quad).collect()
    }

    /// The captured curves at a corner and at those that it stands for, ascending.
    pub(in super::super) fn curves_at(&self, solid: &SolidModel, corner: CornerId) -> Vec<CurveId> {
        let ends_there = |c: &CurveId| {
            let ends = solid.curves()[c.index()].ends.into_iter().flatten();
            self.reduction.curve(*c) == CurveFate::Captured
                && ends.into_iter().any(|end| self.reduction.corner(end) == corner)
        };
        (0..solid.curves().len()).map(CurveId::new).filter(ends_there).collect()
    }

    /// Gives a captured curve up: its nodes stand for the surface at its sides from now on, which is one then, and so do
    /// corners where no other curve ends.
    pub(in super::super) fn give_up(&mut self, solid: &SolidModel, curve: CurveId, reason: Reason) {
        let of_solid = &solid.curves()[curve.index()];
        let [a, b] = of_solid.sides.map(|side| self.reduction.surface(side));
        let (stays, goes) = (a.min(b), a.max(b));
        self.reduction.give_up(solid, curve, reason);
        self.edges.retain(|(_, on)| *on != curve);
        let ends: Vec<CornerId> =
            of_solid.ends.into_iter().flatten().map(|end| self.reduction.corner(end)).collect();
        let bare: Vec<CornerId> =
            ends.into_iter().filter(|&end| self.curves_at(solid, end).is_empty()).collect();
        for anchor in &mut self.anchors {
            *anchor = match *anchor {
                Anchor::Curve(on) if on == curve => Anchor::Surface(stays),
                Anchor::Surface(on) if on == goes => Anchor::Surface(stays),
                Anchor::Corner(on) if bare.contains(&on) => Anchor::Surface(stays),
                other => other,
            };
        }
        self.faces.iter_mut().filter(|(_, on)| *on == goes).for_each(|(_, on)| *on = stays);
        let lost = &mut self.reduction.lost_corners;
        lost.extend(bare);
        lost.sort_unstable();
        lost.dedup();
    }
}
