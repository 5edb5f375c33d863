//! What each node may do.

use super::guide::Guide;
use super::surface::BoundarySurface;
use super::symmetric::Symmetric;
use crate::geometry::Point;
use crate::mesh::topology::{EdgeUses, Edges, edge_ids, hex_boundary};
use crate::mesh::{Faces, NodeId, QuadMesh};

/// A curve beside a curved patch that turns by more than this at a node has a corner there, in degrees.
const CORNER_DEGREES: f64 = 50.0;

/// The same of a curve between planar patches. A node that slides round any corner there takes area from one of them.
const CORNER_IN_PLANE_DEGREES: f64 = 1e-4;

/// An edge whose middle is this near to a crease lies on it, as a share of the edge.
const ON_CREASE: f64 = 1e-6;

/// Where a node may go.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Freedom {
    /// Anywhere: a node inside.
    #[default]
    Inside,
    /// On a patch of the boundary surface.
    Patch(u32),
    /// Along a curve of the boundary surface.
    Curve(u32),
    /// Nowhere: a corner.
    Fixed,
}

/// The freedom of each node of a mesh, on a boundary surface.
#[derive(Clone, Debug)]
pub struct Constraints<'a> {
    surface: Option<&'a BoundarySurface>,
    /// Are nodes kept where planar patches and straight curves end?
    is_bounded: bool,
    /// One for each node.
    pub freedom: Vec<Freedom>,
}

impl<'a> Constraints<'a> {
    /// All of `nodes` nodes may go anywhere.
    pub fn none(nodes: usize) -> Self {
        Self { surface: None, is_bounded: false, freedom: vec![Freedom::Inside; nodes] }
    }

    /// The freedom of the nodes of a hex mesh whose boundary lies on `surface`, usually that of the mesh it was
    /// refined from.
    ///
    /// A boundary face belongs to the patch nearest to its middle. A node all of whose faces belong to one patch
    /// slides on it, one where two patches meet along the curve between them. Where more meet, or the curve turns by
    /// more than 50 degrees (at all, if it is between planar patches), the node is fixed; so it is where the boundary is no
    /// manifold.
    ///
    /// # Panics
    /// If a node id is out of range.
    pub fn of_hexes(positions: &[Point], hexes: &[[NodeId; 8]], surface: &'a BoundarySurface) -> Self {
        let quads = hex_boundary(hexes).into_iter().map(|(quad, _)| quad).collect();
        let boundary = QuadMesh { positions: positions.to_vec(), quads };
        let middle = |quad: &[NodeId; 4]| quad.iter().map(|n| positions[n.index()]).sum::<Point>() / 4.0;
        let patch: Option<Vec<u32>> =
            boundary.quads.iter().map(|quad| surface.patch_at(middle(quad))).collect();
        match patch {
            Some(patch) => Self::of_boundary(&boundary, &patch, surface),
            None => Self::none(positions.len()),
        }
    }

    /// The freedom of the nodes of a mesh by its boundary faces and those between materials, each of which lies on the
    /// given patch.
    pub fn of_boundary(boundary: &QuadMesh, patch: &[u32], surface: &'a BoundarySurface) -> Self {
        let mut freedom = vec![Freedom::Inside; boundary.node_count()];
        for (quad, &patch) in boundary.quads.iter().zip(patch) {
            for n in quad {
                freedom[n.index()] = Freedom::Patch(patch);
            }
        }
        let turns = |curve: u32, a: Point, b: Point| {
            is_corner(a, b, if surface.is_in_plane(curve) { CORNER_IN_PLANE_DEGREES } else { CORNER_DEGREES })
        };
        for (n, ends) in curve_ends(boundary, patch, surface).into_iter().enumerate() {
            let here = boundary.positions[n];
            freedom[n] = match ends.as_slice() {
                [] => continue,
                &[(Some(curve), a), (Some(other), b)]
                    if curve == other && !turns(curve, here - a, b - here) =>
                {
                    Freedom::Curve(curve)
                }
                _ => Freedom::Fixed,
            };
        }
        for (quad, &patch) in boundary.quads.iter().zip(patch) {
            for n in quad {
                let freedom = &mut freedom[n.index()];
                let leaves = match *freedom {
                    Freedom::Patch(other) => other != patch,
                    Freedom::Curve(curve) => !surface.is_at_curve(patch, curve),
                    Freedom::Inside | Freedom::Fixed => false,
                };
                if leaves {
                    *freedom = Freedom::Fixed;
                }
            }
        }
        Self { surface: Some(surface), is_bounded: false, freedom }
    }

    /// The same, and nodes on planar patches and straight curves stay within these. That takes a search for each move,
    /// and is hardly ever needed: where a node would pass the end of its patch, cells nearly always turn over.
    pub fn bounded(self) -> Self {
        Self { is_bounded: true, ..self }
    }

    /// The same, and those of the nodes for which `stays` holds that are on curved patches and curves stay where they are.
    pub(crate) fn fixed_where_curved(mut self, stays: impl Fn(NodeId) -> bool) -> Self {
        let Some(surface) = self.surface else { return self };
        for (n, freedom) in self.freedom.iter_mut().enumerate() {
            let is_curved = match *freedom {
                Freedom::Patch(patch) => !surface.is_planar(patch),
                Freedom::Curve(curve) => !surface.is_straight(curve),
                Freedom::Inside | Freedom::Fixed => false,
            };
            if is_curved && stays(NodeId::new(n)) {
                *freedom = Freedom::Fixed;
            }
        }
        self
    }

    /// Is the node a corner?
    pub fn is_fixed(&self, node: NodeId) -> bool {
        self.freedom[node.index()] == Freedom::Fixed
    }

    /// How far `p` is from the patch or the curve of the node.
    pub(super) fn distance(&self, node: NodeId, p: Point) -> f64 {
        match (self.freedom[node.index()], self.surface) {
            (Freedom::Patch(patch), Some(surface)) => surface.distance_to_patch(patch, p),
            (Freedom::Curve(curve), Some(surface)) => surface.distance_to_curve(curve, p),
            _ => 0.0,
        }
    }
}

/// Keeps nodes to their constraints, from where they are at first on.
pub(super) struct Constrained<'a> {
    pub(super) constraints: &'a Constraints<'a>,
    pub(super) positions: &'a [Point],
}

impl Guide for Constrained<'_> {
    fn tangent(&self, node: NodeId, p: Point) -> Symmetric {
        let Constraints { surface, ref freedom, .. } = *self.constraints;
        match (freedom[node.index()], surface) {
            (Freedom::Patch(patch), Some(surface)) => {
                Symmetric::IDENTITY + Symmetric::outer(surface.normal(patch, p)) * -1.0
            }
            (Freedom::Curve(curve), Some(surface)) => Symmetric::outer(surface.tangent(curve, p)),
            (Freedom::Fixed, _) => Symmetric::default(),
            _ => Symmetric::IDENTITY,
        }
    }

    fn project(&self, node: NodeId, p: Point) -> Point {
        let Constraints { surface, is_bounded, ref freedom } = *self.constraints;
        let anchor = self.positions[node.index()];
        match (freedom[node.index()], surface) {
            (Freedom::Patch(patch), Some(surface)) if is_bounded => surface.closest_on_patch(patch, p),
            (Freedom::Curve(curve), Some(surface)) if is_bounded => surface.closest_on_curve(curve, p),
            (Freedom::Patch(patch), Some(surface)) => surface.onto_patch(patch, anchor, p),
            (Freedom::Curve(curve), Some(surface)) => surface.onto_curve(curve, anchor, p),
            (Freedom::Fixed, _) => anchor,
            _ => p,
        }
    }
}

/// For each node the boundary edges at it that lie on curves: the curve, if the surface has one there, and where the
/// edge leads to.
fn curve_ends(
    boundary: &QuadMesh,
    patch: &[u32],
    surface: &BoundarySurface,
) -> Vec<Vec<(Option<u32>, Point)>> {
    let edges = Edges::of_quads(boundary);
    let uses = EdgeUses::of(&edges);
    let mut ends = vec![Vec::new(); boundary.node_count()];
    for e in edge_ids(&edges) {
        let nodes = edges.ends[e.index()];
        let [a, b] = nodes.map(|n| boundary.positions[n.index()]);
        let curve = match *uses.at(e) {
            [k, l] => {
                let [p, q] = [k, l].map(|k| patch[boundary.face_of(k as usize)]);
                let curve = surface.curve_between([p, q]);
                let near =
                    |&c: &u32| surface.distance_to_curve(c, (a + b) / 2.0) <= ON_CREASE * a.distance(b);
                if p == q && !curve.is_some_and(|c| near(&c)) {
                    continue;
                }
                curve
            }
            ref faces => surface.curve_among(faces.iter().map(|&k| patch[boundary.face_of(k as usize)])),
        };
        ends[nodes[0].index()].push((curve, b));
        ends[nodes[1].index()].push((curve, a));
    }
    ends
}

/// Does a curve that arrives along `a` and leaves along `b` turn by more than so many degrees?
fn is_corner(a: Point, b: Point, degrees: f64) -> bool {
    a.normalize_or_zero().dot(b.normalize_or_zero()) < libm::cos(degrees.to_radians())
}
