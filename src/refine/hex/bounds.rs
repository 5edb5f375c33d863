//! The faces at a node of the interface that nodes are kept on, which are those of the boundary and those between
//! materials, and the ridges between them.

use super::interface::{Interface, Kept, Star};
use crate::geometry::Point;
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::FACES;
use crate::optimize::FaceKind;

/// Boundary faces that meet at more than this angle meet at a ridge, in degrees.
pub(super) const RIDGE_DEGREES: f64 = 30.0;

/// Its cosine.
pub(super) const RIDGE: f64 = 0.866_025_403_784_438_6;

/// The least sine, as a cosine to the normals, of a ridge's direction to the faces beside it.
pub(super) const ALONG: f64 = 0.5;

/// The bounds of a node. Its buffer serves one node after another.
#[derive(Default)]
pub(super) struct Bounds {
    at: Point,
    pub(super) all: Vec<Bound>,
}

/// A boundary face at the node, or one between materials.
pub(super) struct Bound {
    /// The region that keeps it.
    pub(super) region: u32,
    /// Out of the lesser of its materials.
    pub(super) normal: Point,
    pub(super) kind: FaceKind,
    pub(super) center: Point,
    pub(super) ends: [NodeId; 2],
}

impl Bound {
    /// Is an edge between the two a ridge, because they meet at an angle or are of different kinds?
    pub(super) fn has_ridge_to(&self, other: &Self) -> bool {
        self.normal.dot(other.normal) < RIDGE || self.kind != other.kind
    }
}

impl Bounds {
    /// Takes the bounds of a star's node. `region` tells that of a hex by its place in the star.
    pub(super) fn load(
        &mut self,
        positions: &[Point],
        interface: &Interface,
        star: &Star,
        region: impl Fn(usize) -> u32,
        kept: Kept,
    ) {
        self.at = positions[star.node.index()];
        self.all.clear();
        for face in &star.faces {
            let Some(kind) = interface.kind(star, face) else { continue };
            let (hex, side) = kept.keeper(star, face);
            let id = star.hexes[hex].0;
            let nodes = &interface.hexes[id as usize];
            let [a, b, c, d] = FACES[usize::from(side)].map(|k| positions[nodes[usize::from(k)].index()]);
            let outward = (c - a).cross(d - b).normalize_or_zero();
            self.all.push(Bound {
                kind,
                region: region(hex),
                normal: if interface.material(id) == kind.materials[0] { outward } else { -outward },
                center: ((a + c) + (b + d)) * 0.25,
                ends: [face.rest[0], face.rest[2]],
            });
        }
    }

    /// Pairs of bounds with a ridge between them, and the ridge's other end.
    pub(super) fn ridge_pairs(&self) -> impl Iterator<Item = (&Bound, &Bound, NodeId)> {
        let pairs = self.all.iter().enumerate().flat_map(|(k, a)| self.all[..k].iter().map(move |b| (a, b)));
        pairs.filter(|(a, b)| a.has_ridge_to(b)).filter_map(|(a, b)| {
            let end = a.ends.into_iter().find(|end| b.ends.contains(end))?;
            Some((a, b, end))
        })
    }

    /// Where the node can go.
    pub(super) fn freedom(&self, positions: &[Point]) -> Freedom {
        let Some(first) = self.all.first() else { return Freedom::Free };
        let mut ridges =
            self.ridge_pairs().map(|(.., end)| (positions[end.index()] - self.at).normalize_or_zero());
        let Some(ridge) = ridges.next() else { return Freedom::Plane(first.normal) };
        let is_straight = ridges.all(|other| other.dot(ridge).abs() > RIDGE)
            && self.all.iter().all(|bound| bound.normal.dot(ridge).abs() < ALONG);
        if is_straight { Freedom::Line(ridge) } else { Freedom::Fixed }
    }
}

/// Where a node can go, to first order.
#[derive(Clone, Copy)]
pub(super) enum Freedom {
    /// Anywhere.
    Free,
    /// Along the surface with this normal.
    Plane(Point),
    /// Along the ridge of this direction.
    Line(Point),
    /// Nowhere.
    Fixed,
}

/// Directions whose cosine is greater are parallel.
const PARALLEL: f64 = 0.99;

/// Those whose cosine is less are at right angles.
const RIGHT: f64 = 0.1;

impl Freedom {
    /// Can the node leave a line of this direction?
    pub(super) fn leaves_line(self, direction: Point) -> bool {
        match self {
            Self::Free | Self::Plane(_) => true,
            Self::Line(ridge) => ridge.dot(direction).abs() < PARALLEL,
            Self::Fixed => false,
        }
    }

    /// Can it leave a plane of this normal?
    pub(super) fn leaves_plane(self, normal: Point) -> bool {
        match self {
            Self::Free => true,
            Self::Plane(own) => own.dot(normal).abs() < PARALLEL,
            Self::Line(ridge) => ridge.dot(normal).abs() > RIGHT,
            Self::Fixed => false,
        }
    }

    /// The part of a motion that is possible.
    pub(super) fn part_of(self, motion: Point) -> Point {
        match self {
            Self::Free => motion,
            Self::Plane(normal) => motion - normal * normal.dot(motion),
            Self::Line(ridge) => ridge * ridge.dot(motion),
            Self::Fixed => Point::ZERO,
        }
    }
}
