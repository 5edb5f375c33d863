//! What holds each node while the mesh is fitted: nothing, a pull to its foot on the solid, or the solid itself.

use std::sync::atomic::AtomicU32;

use super::super::correspondence::Anchor;
use super::target::{Foot, Target};
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
    /// It goes anywhere that is no farther from its foot than its leash is long.
    Leashed,
    /// It stays where it is.
    Pinned,
}

impl Hold {
    /// Is the node not where it belongs?
    pub(super) fn is_off(self) -> bool {
        matches!(self, Self::Drawn | Self::Leashed)
    }
}

/// The holds of all nodes of a mesh.
pub(super) struct Holds<'a> {
    pub(super) target: &'a dyn Target,
    pub(super) anchors: &'a [Anchor],
    pub(super) holds: Vec<Hold>,
    /// The facet of the solid that each node stood on last.
    facets: Vec<AtomicU32>,
    /// Where on its curve a node is drawn, if that is not its foot; empty where that is so of all.
    places: Vec<Option<Point>>,
    /// How long the leashes are, in model units, by node, ascending.
    leashes: Vec<(NodeId, f64)>,
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
        let (places, leashes) = (Vec::new(), Vec::new());
        let facets = holds.iter().map(|_| AtomicU32::new(u32::MAX)).collect();
        Self { target, anchors, holds, facets, places, leashes, weight: 0.0, surfaces: 1.0 }
    }

    /// With the holds given, where nodes that are off the solid, or on leashes, come no farther from their feet than they are.
    pub(super) fn kept(
        target: &'a dyn Target,
        anchors: &'a [Anchor],
        holds: &[Hold],
        positions: &[Point],
    ) -> Self {
        let mut kept = Self::of(target, anchors, holds.to_vec());
        for n in (0..holds.len()).filter(|&n| holds[n].is_off()) {
            let foot = target.foot(anchors[n], positions[n]);
            kept.leash(NodeId::new(n), foot.map_or(0.0, |foot| foot.point.distance(positions[n])));
        }
        kept
    }

    /// Keeps a node so near.
    pub(super) fn leash(&mut self, node: NodeId, length: f64) {
        self.holds[node.index()] = Hold::Leashed;
        match self.leashes.binary_search_by_key(&node, |&(node, _)| node) {
            Ok(place) => self.leashes[place].1 = length,
            Err(place) => self.leashes.insert(place, (node, length)),
        }
    }

    /// How long the leash of a node is; 0 where it has none.
    pub(super) fn leash_of(&self, node: NodeId) -> f64 {
        let place = self.leashes.binary_search_by_key(&node, |&(node, _)| node);
        place.map_or(0.0, |place| self.leashes[place].1)
    }

    /// The foot of a node that may be at `p`.
    fn foot(&self, node: NodeId, p: Point) -> Option<Foot> {
        self.target.foot_from(&self.facets[node.index()], self.anchors[node.index()], p)
    }

    /// Where on its curve a node is drawn, if that is not its foot.
    pub(super) fn place(&self, node: NodeId) -> Option<Point> {
        self.places.get(node.index()).copied().flatten()
    }

    /// Draws a node to a place on its curve.
    pub(super) fn draw_to(&mut self, node: NodeId, place: Point) {
        self.places.resize(self.holds.len(), None);
        self.places[node.index()] = Some(place);
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
}

impl Guide for Holds<'_> {
    fn tangent(&self, node: NodeId, p: Point) -> Symmetric {
        let across = |v: Point| Symmetric::IDENTITY + Symmetric::outer(v) * -1.0;
        match self.holds[node.index()] {
            Hold::Free | Hold::Leashed => Symmetric::IDENTITY,
            Hold::Drawn if self.weight > 0.0 => Symmetric::IDENTITY,
            Hold::Drawn => {
                let away = self.foot(node, p).map_or(Point::ZERO, |foot| p - foot.point);
                across(away.normalize_or_zero())
            }
            Hold::Pinned => Symmetric::default(),
            Hold::Held => match (self.anchors[node.index()], self.foot(node, p)) {
                (Anchor::Surface(_), Some(foot)) => across(foot.direction),
                (Anchor::Curve(_), Some(foot)) => Symmetric::outer(foot.direction),
                _ => Symmetric::default(),
            },
        }
    }

    fn project(&self, node: NodeId, p: Point) -> Point {
        match self.holds[node.index()] {
            Hold::Held => self.foot(node, p).map_or(p, |foot| foot.point),
            Hold::Leashed => match self.foot(node, p) {
                Some(foot) => foot.point + (p - foot.point).clamp_length_max(self.leash_of(node)),
                None => p,
            },
            _ => p,
        }
    }

    fn pull(&self, node: NodeId, p: Point, size: f64) -> Option<Pull> {
        if self.weight == 0.0 || !self.is(node, Hold::Drawn) {
            return None;
        }
        let anchor = self.anchors[node.index()];
        let foot = self.foot(node, p)?;
        let along = Symmetric::outer(foot.direction);
        let place = self.place(node);
        let shape = match (anchor, place) {
            (Anchor::Surface(_), _) => (along + Symmetric::IDENTITY * TO_THE_FOOT) * self.surfaces,
            (Anchor::Curve(_), None) => Symmetric::IDENTITY * (1.0 + TO_THE_FOOT) + along * -1.0,
            (Anchor::Curve(_), Some(_)) => Symmetric::IDENTITY + along * (ALONG - 1.0),
            _ => Symmetric::IDENTITY,
        };
        Some(Pull { to: place.unwrap_or(foot.point), weight: shape * (self.weight / (size * size)) })
    }
}

#[cfg(test)]
mod tests {
    use super::super::target::OnSolid;
    use super::*;
    use crate::Silent;
    use crate::geometry::Aabb;
    use crate::hexing::correspondence::correspond;
    use crate::mesh::{GridOptions, hex_grid};
    use crate::solid::testing::{cuboid, solid};

    #[test]
    fn nodes_on_leashes_come_no_farther_from_the_solid() {
        let solid = solid(&cuboid([4, 4, 4]));
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 100 };
        let mut mesh = hex_grid(Aabb { min: Point::ZERO, max: Point::splat(4.0) }, &options).unwrap();
        let on = correspond(&mesh, &solid, &Silent).unwrap();
        let target = OnSolid::new(&solid, &on.reduction);
        let node = |p: Point| NodeId::new(mesh.positions.iter().position(|&q| q == p).unwrap());
        let (top, corner) = (node(Point::new(2.0, 2.0, 4.0)), node(Point::ZERO));
        let mut holds = vec![Hold::Held; mesh.positions.len()];
        holds[top.index()] = Hold::Drawn;
        mesh.positions[top.index()].z = 3.5;
        let mut kept = Holds::kept(&target, &on.anchors, &holds, &mesh.positions);
        assert!(kept.is(top, Hold::Leashed) && kept.is(corner, Hold::Held));
        // Along the surface and nearer to it as the node likes.
        for free in [Point::new(1.0, 3.0, 3.5), Point::new(2.0, 2.0, 4.0), Point::new(2.0, 2.0, 3.9)] {
            assert_eq!(kept.project(top, free), free);
        }
        let far = Point::new(1.0, 2.0, 2.5);
        assert_eq!(kept.project(top, far), Point::new(1.0, 2.0, 3.5));
        let away = Point::new(-0.5, 0.0, 0.0);
        assert_eq!(kept.project(corner, away), Point::ZERO);
        kept.leash(corner, 0.25);
        assert_eq!(kept.project(corner, away), Point::X * -0.25);
        assert_eq!(kept.tangent(corner, away), Symmetric::IDENTITY);
    }
}
