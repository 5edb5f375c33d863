//! Nodes inside edges and faces. Reads positions, which is why it stands apart from topology.

use rstar::{AABB, RTree, RTreeObject};

use super::Defect;
use crate::geometry::{Aabb, Point};
use crate::mesh::topology::{Edges, used_nodes};
use crate::mesh::{Faces, NodeId};
use crate::{Cancelled, Monitor, Silent, parallel};

/// Every node that lies inside an edge of which it is no end, among all edges: on a surface that passes,
/// no cracks hide where several sheets meet either. Costs several times what a check costs, which looks
/// at the edges of one face alone.
pub fn hanging_nodes(mesh: &impl Faces) -> Vec<Defect> {
    let found = inside(mesh.positions(), &used_nodes(mesh), Edges::of(mesh).ends, &Silent);
    found.expect("nobody stops it").into_iter().map(defect).collect()
}

/// A node, and the edge that it is inside of.
pub(super) type InEdge = (NodeId, [NodeId; 2]);

/// A node, and the place of the face that it is inside of.
pub(super) type InFace = (NodeId, u32);

/// A node inside an edge, as a defect.
pub(super) fn defect((node, edge): InEdge) -> Defect {
    Defect::HangingNode { node, edge }
}

/// A node counts as inside an edge if it is nearer to the edge than this share of its length, and
/// farther than that from its ends: what a file of six significant digits leaves of a coordinate.
const NEAR: f64 = 1e-6;

/// The `used` nodes that lie inside one of `edges`, each with the edge, in order of nodes, then of edges.
///
/// # Errors
/// If the monitor stops it.
pub(super) fn inside(
    positions: &[Point],
    used: &[bool],
    edges: Vec<[NodeId; 2]>,
    monitor: &dyn Monitor,
) -> Result<Vec<InEdge>, Cancelled> {
    let trees = Trees::of(edges.into_iter().map(|ends| Segment::new(positions, ends)), monitor)?;
    parallel::try_gather(positions.len(), monitor, |n, found| {
        if !used[n] {
            return;
        }
        let node = NodeId::new(n);
        let near = trees.at(positions[n]);
        let mut edges: Vec<_> = near.filter(|s| s.holds(positions, node)).map(|s| s.ends).collect();
        edges.sort_unstable();
        found.extend(edges.into_iter().map(|edge| (node, edge)));
    })
}

/// The `used` nodes that lie inside one of `faces`, each with the face's place among them, in order of nodes, then of faces.
///
/// # Errors
/// If the monitor stops it.
pub(super) fn inside_faces(
    positions: &[Point],
    used: &[bool],
    faces: &[[NodeId; 4]],
    monitor: &dyn Monitor,
) -> Result<Vec<InFace>, Cancelled> {
    let patches = (0..).zip(faces).map(|(place, &nodes)| Patch::new(positions, place, nodes));
    let trees = Trees::of(patches, monitor)?;
    parallel::try_gather(positions.len(), monitor, |n, found| {
        if !used[n] {
            return;
        }
        let node = NodeId::new(n);
        let near = trees.at(positions[n]);
        let mut faces: Vec<u32> = near.filter(|f| f.holds(positions, node)).map(|f| f.place).collect();
        faces.sort_unstable();
        found.extend(faces.into_iter().map(|face| (node, face)));
    })
}

/// Search trees over objects, each over so few that it is soon packed. Objects that follow each other are usually near to
/// each other, so that few of the trees are looked into.
struct Trees<T: RTreeObject>(Vec<RTree<T>>);

/// Objects of a tree.
const PACKED: usize = 1 << 15;

impl<T: RTreeObject<Envelope = AABB<[f64; 3]>>> Trees<T> {
    fn of(mut objects: impl Iterator<Item = T>, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let mut trees = Vec::new();
        loop {
            let few: Vec<T> = objects.by_ref().take(PACKED).collect();
            if few.is_empty() {
                return Ok(Self(trees));
            }
            trees.push(RTree::bulk_load(few));
            monitor.proceed()?;
        }
    }

    /// The objects whose boxes hold `p`.
    fn at(&self, p: Point) -> impl Iterator<Item = &T> {
        let p = AABB::from_point(p.to_array());
        self.0.iter().flat_map(move |tree| tree.locate_in_envelope_intersecting(p))
    }
}

/// A bilinear face.
struct Patch {
    place: u32,
    nodes: [NodeId; 4],
    envelope: AABB<[f64; 3]>,
}

/// Steps towards the point of a patch that is closest to a node: Gauss and Newton's double the digits each time.
const STEPS: usize = 8;

impl Patch {
    fn new(positions: &[Point], place: u32, nodes: [NodeId; 4]) -> Self {
        let bounds = Aabb::around(&nodes.map(|n| positions[n.index()]));
        let bounds = bounds.grown(NEAR * bounds.diagonal());
        Self { place, nodes, envelope: AABB::from_corners(bounds.min.to_array(), bounds.max.to_array()) }
    }

    fn holds(&self, positions: &[Point], node: NodeId) -> bool {
        if self.nodes.contains(&node) {
            return false;
        }
        let [a, b, c, d] = self.nodes.map(|n| positions[n.index()]);
        let p = positions[node.index()];
        let (along, across, twist) = (b - a, d - a, a - b + (c - d));
        let (mut u, mut v) = (0.5, 0.5);
        let gap = |u: f64, v: f64| p - (a + u * along + v * across + u * v * twist);
        for _ in 0..STEPS {
            let (by_u, by_v, gap) = (along + v * twist, across + u * twist, gap(u, v));
            let (uu, uv, vv) = (by_u.dot(by_u), by_u.dot(by_v), by_v.dot(by_v));
            let (gu, gv, determinant) = (by_u.dot(gap), by_v.dot(gap), uu * vv - uv * uv);
            if determinant <= 0.0 {
                return false;
            }
            u += (gu * vv - gv * uv) / determinant;
            v += (gv * uu - gu * uv) / determinant;
        }
        let inner = NEAR..1.0 - NEAR;
        inner.contains(&u)
            && inner.contains(&v)
            && gap(u, v).length() < NEAR * (c - a).length().max((d - b).length())
    }
}

impl RTreeObject for Patch {
    type Envelope = AABB<[f64; 3]>;

    fn envelope(&self) -> Self::Envelope {
        self.envelope
    }
}

struct Segment {
    ends: [NodeId; 2],
    envelope: AABB<[f64; 3]>,
}

impl Segment {
    fn new(positions: &[Point], ends: [NodeId; 2]) -> Self {
        let [a, b] = ends.map(|n| positions[n.index()]);
        let margin = Point::splat(NEAR * a.distance(b));
        let (min, max) = (a.min(b) - margin, a.max(b) + margin);
        Self { ends, envelope: AABB::from_corners(min.to_array(), max.to_array()) }
    }

    fn holds(&self, positions: &[Point], node: NodeId) -> bool {
        if self.ends.contains(&node) {
            return false;
        }
        let [a, b] = self.ends.map(|n| positions[n.index()]);
        let (along, to_node) = (b - a, positions[node.index()] - a);
        let t = to_node.dot(along) / along.length_squared();
        t > NEAR && t < 1.0 - NEAR && to_node.distance(t * along) < NEAR * along.length()
    }
}

impl RTreeObject for Segment {
    type Envelope = AABB<[f64; 3]>;

    fn envelope(&self) -> Self::Envelope {
        self.envelope
    }
}
