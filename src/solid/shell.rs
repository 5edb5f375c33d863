//! Triangles and how they hang together, by half-edges.
//!
//! ```text
//!        c            Half-edge 3t + i of triangle t runs from its corner i to the next; the triangle is on its left,
//!       / \           seen from outside. Its twin runs the other way in the neighbour.
//!   k+2/   \k+1
//!     /  t  \         Out of vertex a, counter-clockwise: k, then the twin of k+2, the half-edge that comes in.
//!    a-------b
//!        k
//! ```

use crate::geometry::Point;
use crate::mesh::topology::{EdgeUses, edge_ids};
use crate::mesh::{EdgeId, Edges, Faces, NodeId};
use crate::{Cancelled, Monitor};

/// No half-edge.
pub(super) const NONE: u32 = u32::MAX;

/// Triangles over points.
#[derive(Clone, Debug, Default)]
pub(super) struct Triangles {
    pub points: Vec<Point>,
    pub triangles: Vec<[u32; 3]>,
}

impl Faces for Triangles {
    fn positions(&self) -> &[Point] {
        &self.points
    }

    fn face_count(&self) -> usize {
        self.triangles.len()
    }

    fn corners(&self) -> &[NodeId] {
        bytemuck::cast_slice(self.triangles.as_flattened())
    }

    fn range(&self, f: usize) -> std::ops::Range<usize> {
        3 * f..3 * f + 3
    }

    fn face_of(&self, k: usize) -> usize {
        k / 3
    }
}

impl Triangles {
    /// The corners of triangle `t`.
    pub fn at(&self, t: usize) -> [Point; 3] {
        self.triangles[t].map(|v| self.points[v as usize])
    }
}

/// The edges of triangles and the half-edges at each.
pub(super) struct EdgeTable {
    pub edges: Edges,
    pub uses: EdgeUses,
}

impl EdgeTable {
    pub fn new(mesh: &Triangles, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let edges = Edges::monitored(mesh, monitor)?;
        let uses = EdgeUses::monitored(&edges, monitor)?;
        Ok(Self { edges, uses })
    }

    /// The edges at which the number of triangles is one that `wanted` accepts.
    pub fn with_uses(&self, wanted: impl Fn(usize) -> bool) -> Vec<EdgeId> {
        edge_ids(&self.edges).filter(|&e| wanted(self.uses.count(e))).collect()
    }
}

/// A closed manifold surface of triangles that all agree on what is outside.
#[derive(Clone, Debug, Default)]
pub(super) struct Shell {
    pub mesh: Triangles,
    /// The twin of each half-edge.
    pub twins: Vec<u32>,
}

impl Shell {
    /// The shell of triangles of which exactly two meet at each edge, in opposite directions.
    pub fn new(mesh: Triangles, table: &EdgeTable) -> Self {
        let mut twins = vec![NONE; 3 * mesh.triangles.len()];
        for e in edge_ids(&table.edges) {
            if let &[k, l] = table.uses.at(e) {
                twins[k as usize] = l;
                twins[l as usize] = k;
            }
        }
        debug_assert!(twins.iter().all(|&k| k != NONE));
        Self { mesh, twins }
    }

    /// The shell of some of the triangles, ascending, to which all their neighbours belong. Vertices stay in their order.
    pub fn part(&self, kept: &[usize]) -> Self {
        let mut place = vec![NONE; self.mesh.triangles.len()];
        let mut is_used = vec![false; self.mesh.points.len()];
        for (i, &t) in kept.iter().enumerate() {
            place[t] = i as u32;
            self.mesh.triangles[t].iter().for_each(|&v| is_used[v as usize] = true);
        }
        let mut part = Self::default();
        let mut vertex = vec![NONE; is_used.len()];
        for v in (0..is_used.len()).filter(|&v| is_used[v]) {
            vertex[v] = part.mesh.points.len() as u32;
            part.mesh.points.push(self.mesh.points[v]);
        }
        part.mesh.triangles =
            kept.iter().map(|&t| self.mesh.triangles[t].map(|v| vertex[v as usize])).collect();
        let twin = |k: u32| 3 * place[triangle_of(k)] + k % 3;
        part.twins =
            kept.iter().flat_map(|&t| (0..3).map(move |i| 3 * t + i)).map(|k| twin(self.twins[k])).collect();
        part
    }

    /// Number of half-edges.
    pub fn len(&self) -> usize {
        self.twins.len()
    }

    pub fn twin(&self, k: u32) -> u32 {
        self.twins[k as usize]
    }

    /// Where a half-edge starts.
    pub fn from(&self, k: u32) -> u32 {
        self.mesh.triangles.as_flattened()[k as usize]
    }

    /// Where a half-edge ends.
    pub fn to(&self, k: u32) -> u32 {
        self.from(next(k))
    }

    /// A half-edge from its start to its end.
    pub fn along(&self, k: u32) -> Point {
        self.mesh.points[self.to(k) as usize] - self.mesh.points[self.from(k) as usize]
    }

    /// The half-edge that follows `k` counter-clockwise among those that leave its start.
    pub fn around(&self, k: u32) -> u32 {
        self.twin(previous(k))
    }

    /// All half-edges that leave the start of `k`, counter-clockwise from `k`.
    pub fn fan(&self, k: u32) -> impl Iterator<Item = u32> {
        let mut at = Some(k);
        std::iter::from_fn(move || {
            let now = at?;
            at = Some(self.around(now)).filter(|&after| after != k);
            Some(now)
        })
    }

    /// Turns the edge of half-edge `k` around in the four points of its two triangles.
    ///
    /// ```text
    ///       c                 c
    ///      / \               /|\       The triangles a b c of k and b a d of its twin become a d c and
    ///     / t \             / | \      b c d. No edge may go from c to d before.
    ///    a--k->b    ->     a t|u b
    ///     \ u /             \ | /
    ///      \ /               \|/
    ///       d                 d
    /// ```
    pub fn flip(&mut self, k: u32) {
        let l = self.twin(k);
        let [a, b, c, d] = [k, l, previous(k), previous(l)].map(|h| self.from(h));
        let [bc, ca, ad, db] = [next(k), previous(k), next(l), previous(l)].map(|h| self.twin(h));
        let (t, u) = (triangle_of(k), triangle_of(l));
        self.mesh.triangles[t] = [a, d, c];
        self.mesh.triangles[u] = [b, c, d];
        let (t, u) = (3 * t as u32, 3 * u as u32);
        for (h, other) in [(t, ad), (t + 1, u + 1), (t + 2, ca), (u, bc), (u + 2, db)] {
            self.twins[h as usize] = other;
            self.twins[other as usize] = h;
        }
    }

    /// A half-edge out of each vertex: its least.
    pub fn out_of(&self) -> Vec<u32> {
        let mut out = vec![NONE; self.mesh.points.len()];
        for k in (0..self.len() as u32).rev() {
            out[self.from(k) as usize] = k;
        }
        out
    }
}

/// The half-edge after `k` in its triangle.
pub(super) fn next(k: u32) -> u32 {
    if k % 3 == 2 { k - 2 } else { k + 1 }
}

/// The half-edge before `k` in its triangle.
pub(super) fn previous(k: u32) -> u32 {
    if k.is_multiple_of(3) { k + 2 } else { k - 1 }
}

/// The triangle of half-edge `k`.
pub(super) fn triangle_of(k: u32) -> usize {
    k as usize / 3
}
