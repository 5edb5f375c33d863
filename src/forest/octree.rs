//! Octrees over unstructured coarse hexes: levels, edges, faces, and the 1 -> 8 split.
//!
//! Child `i` of an element stands at its corner `i`, with axes parallel to its parent's. Its local corner `j` is,
//! by the number of axes along which corners `i` and `j` differ ([`NodeKind::of`]):
//!
//! ```text
//!   0  the parent's corner i                           7-----------6
//!   1  the middle of the parent's edge i-j            /|          /|    child 0 has at its corners
//!   2  the centre of the parent's face across i-j    / |         / |      0        a corner
//!   3  the parent's centre                          4-----------5  |      1, 3, 4  edge nodes
//!                                                   |  |        |  |      2, 5, 7  face nodes
//!                                                   |  3--------|--2      6        the volume node
//!                                                   | /         | /
//!                                                   |/          |/
//!                                                   0-----------1
//! ```
//!
//! Edges and faces are inherited: a split edge has two halves; a split face has four quarters, and four edges
//! inside it from its centre to the middles of its own; a split element has six edges inside it, from its centre to
//! those of its faces, and twelve faces, one at the middle of each of its edges. Nothing is searched for or hashed.
//!
//! A split only notes what is refined. Elements and their nodes are made ([`HexForest::make`]) when something asks for
//! them: those of the deepest level, seven in eight, often nobody does.

use std::ops::Range;

use super::heirs::inherit;
use super::quadtree::{UNDIVIDED, center, midpoint};
use crate::geometry::Point;
use crate::mesh::numbering::hex::{EDGE_BETWEEN, EDGES_OF_FACE, FACE_ACROSS, apart};
use crate::mesh::{EdgeId, FaceId, HexId, NodeId};
use crate::{Cancelled, Monitor, parallel};

/// What a node of an element is to the element's parent.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum NodeKind {
    /// A corner of the parent: an older node.
    Corner,
    /// The paper's edge node: it divides an edge of the parent.
    Edge,
    /// The paper's face node: the centre of a face of the parent. (On surfaces the paper calls the centre of a
    /// quad, and the input's nodes, face nodes; in hexes it is this alone.)
    Face,
    /// The paper's volume node: the centre of the parent.
    Volume,
}

impl NodeKind {
    /// The kind of local corner `corner` of child `child`.
    pub fn of(child: usize, corner: usize) -> Self {
        [Self::Corner, Self::Edge, Self::Face, Self::Volume][apart(child, corner)]
    }
}

/// The elements of one level.
#[derive(Debug, Default)]
pub struct HexLevel {
    /// The eight nodes of each element. Of the deepest level maybe not all of them are made.
    pub elements: Vec<[NodeId; 8]>,
    /// For each element that is refined, in the order in which they were: element `refined[k]` has the
    /// elements `8k..8k + 8` of the next level as its children.
    pub refined: Vec<u32>,
    /// For each element: is it refined?
    pub is_refined: Vec<bool>,
    /// The coarse hex of each family of eight; at level 0 of each element.
    roots: Vec<HexId>,
    /// Edges and faces of each element, as far as they were needed.
    pub(super) sides: Vec<Sides>,
    pub(super) edges: LevelEdges,
    pub(super) faces: LevelFaces,
}

/// The edges and faces of an element, in the order of the reference hex.
#[derive(Clone, Copy, Debug)]
pub(super) struct Sides {
    pub edges: [EdgeId; 12],
    pub faces: [FaceId; 6],
}

/// The edges of one level. They are made when an element of the level is first refined.
#[derive(Debug, Default)]
pub(super) struct LevelEdges {
    pub ends: Vec<[NodeId; 2]>,
    /// The node that divides each edge, or [`UNDIVIDED`].
    pub middle: Vec<NodeId>,
    /// The first of each split edge's halves among the edges of the next level: the one at the first end.
    pub halves: Vec<EdgeId>,
    /// The edges that are split, in the order in which they were.
    pub split: Vec<EdgeId>,
    /// How many of `split` have their halves.
    pub halved: usize,
}

/// The faces of one level, made with the edges. Edge `k` of a face joins its nodes `k` and `k + 1`.
#[derive(Debug, Default)]
pub(super) struct LevelFaces {
    pub nodes: Vec<[NodeId; 4]>,
    pub edges: Vec<[EdgeId; 4]>,
    /// The node in the middle of each face, or [`UNDIVIDED`].
    pub centre: Vec<NodeId>,
    /// The first of each split face's quarters among the faces of the next level: quarter `k` is at node `k`.
    pub quarters: Vec<FaceId>,
    /// The first of the edges inside each split face among those of the next level: edge `k` ends in the middle of
    /// edge `k`.
    pub inside: Vec<EdgeId>,
    pub split: Vec<FaceId>,
    pub quartered: usize,
}

/// A forest of octrees: the nodes of all levels and the elements of each.
#[derive(Debug)]
pub struct HexForest {
    /// Coordinates of all nodes.
    pub positions: Vec<Point>,
    /// The levels, from level 1. There is always one; it has no elements as long as none of level 0 is refined.
    pub levels: Vec<HexLevel>,
    /// Level 0: the input's hexes.
    pub base: HexLevel,
}

impl HexLevel {
    /// The coarse hexes as a level, with their edges and faces.
    pub(super) fn base(
        elements: Vec<[NodeId; 8]>,
        sides: Vec<Sides>,
        edges: LevelEdges,
        faces: LevelFaces,
    ) -> Self {
        let roots = (0..elements.len()).map(HexId::new).collect();
        let is_refined = vec![false; elements.len()];
        Self { elements, is_refined, roots, sides, edges, faces, ..Self::default() }
    }

    /// Number of elements.
    pub fn len(&self) -> usize {
        self.is_refined.len()
    }

    /// True if there are no elements.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The coarse hex that each family of eight elements is part of.
    pub fn family_roots(&self) -> &[HexId] {
        &self.roots
    }

    /// The coarse hex that element `e` is part of.
    pub fn root(&self, e: usize) -> HexId {
        self.roots[e / 8]
    }

    /// For each element of family `k`: is it refined?
    pub(super) fn family(&self, k: usize) -> &[bool] {
        &self.is_refined[8 * k..8 * k + 8]
    }
}

impl LevelEdges {
    pub(super) fn base(ends: Vec<[NodeId; 2]>) -> Self {
        let (middle, halves) = (vec![UNDIVIDED; ends.len()], vec![EdgeId::default(); ends.len()]);
        Self { ends, middle, halves, ..Self::default() }
    }

    pub(super) fn len(&self) -> usize {
        self.ends.len()
    }

    /// The half of split edge `e` at its end `n`.
    pub(super) fn half(&self, e: EdgeId, n: NodeId) -> EdgeId {
        EdgeId(self.halves[e.index()].0 + u32::from(self.ends[e.index()][1] == n))
    }

    /// Makes room for what is known of edges once they are split.
    pub(super) fn settle(&mut self) {
        self.middle.resize(self.ends.len(), UNDIVIDED);
        self.halves.resize(self.ends.len(), EdgeId::default());
    }
}

impl LevelFaces {
    pub(super) fn base(nodes: Vec<[NodeId; 4]>, edges: Vec<[EdgeId; 4]>) -> Self {
        let mut faces = Self { nodes, edges, ..Self::default() };
        faces.settle();
        faces
    }

    pub(super) fn len(&self) -> usize {
        self.nodes.len()
    }

    /// The quarter of split face `f` at its node `n`.
    pub(super) fn quarter(&self, f: FaceId, n: NodeId) -> FaceId {
        let at = self.nodes[f.index()].iter().position(|&m| m == n);
        FaceId(self.quarters[f.index()].0 + at.expect("a corner of the face") as u32)
    }

    /// The edge inside split face `f` that ends in the middle of edge `e`.
    pub(super) fn inside_at(&self, f: FaceId, e: EdgeId) -> EdgeId {
        let at = self.edges[f.index()].iter().position(|&d| d == e);
        EdgeId(self.inside[f.index()].0 + at.expect("an edge of the face") as u32)
    }

    /// Makes room for what is known of faces once they are split.
    pub(super) fn settle(&mut self) {
        self.centre.resize(self.nodes.len(), UNDIVIDED);
        self.quarters.resize(self.nodes.len(), FaceId::default());
        self.inside.resize(self.nodes.len(), EdgeId::default());
    }
}

impl HexForest {
    /// Number of elements that are not refined.
    pub fn leaf_count(&self) -> usize {
        let all = std::iter::once(&self.base).chain(&self.levels);
        all.map(|l| l.len() - l.refined.len()).sum()
    }

    /// The level above `levels[depth]`: its element `refined[k]` is the parent of family `k`.
    pub(super) fn parents(&self, depth: usize) -> &HexLevel {
        depth.checked_sub(1).map_or(&self.base, |above| &self.levels[above])
    }

    /// Splits the hexes `marked` of the input, none of which is refined yet, into eight each.
    ///
    /// # Errors
    /// If the monitor stops it; then the forest is of no use any more.
    pub fn split_base(&mut self, marked: &[u32], monitor: &dyn Monitor) -> Result<(), Cancelled> {
        split(&mut self.base, &mut self.levels[0], marked);
        if self.levels.len() > 1 { self.make(0, monitor) } else { Ok(()) }
    }

    /// Splits the elements `marked` of `levels[depth]`, none of which is refined yet, into eight each.
    ///
    /// # Errors
    /// If the monitor stops it; then the forest is of no use any more.
    pub fn split(&mut self, depth: usize, marked: &[u32], monitor: &dyn Monitor) -> Result<(), Cancelled> {
        if marked.is_empty() {
            return Ok(());
        }
        self.make(depth, monitor)?;
        if depth + 1 == self.levels.len() {
            self.levels.push(HexLevel::default());
        }
        let (parents, children) = self.levels.split_at_mut(depth + 1);
        split(&mut parents[depth], &mut children[0], marked);
        if depth + 2 < self.levels.len() { self.make(depth + 1, monitor) } else { Ok(()) }
    }

    /// Makes the elements of `levels[depth]` that splits have called for. Those of all levels but the deepest are there.
    ///
    /// # Errors
    /// If the monitor stops it; then the forest is of no use any more.
    pub fn make(&mut self, depth: usize, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        let known = self.levels[depth].elements.len() / 8;
        let wanted = self.parents(depth).refined.len();
        if known == wanted {
            return Ok(());
        }
        match depth {
            0 => {}
            1 => inherit(&mut self.base, &mut self.levels[0], monitor)?,
            _ => {
                let (parents, children) = self.levels.split_at_mut(depth - 1);
                inherit(&mut parents[depth - 2], &mut children[0], monitor)?;
            }
        }
        let (parents, children) = self.levels.split_at_mut(depth);
        let parent = parents.last_mut().unwrap_or(&mut self.base);
        for first in (known..wanted).step_by(BATCH) {
            monitor.proceed()?;
            let families = first..wanted.min(first + BATCH);
            refine(&mut self.positions, parent, &mut children[0], families, monitor)?;
        }
        Ok(())
    }
}

/// Elements that are refined before the monitor is asked again.
const BATCH: usize = 1 << 14;

/// Notes that the elements `marked` of `parent` are refined.
fn split(parent: &mut HexLevel, child: &mut HexLevel, marked: &[u32]) {
    let at_base = parent.roots.len() == parent.len();
    child.roots.extend(marked.iter().map(|&e| parent.roots[e as usize / if at_base { 1 } else { 8 }]));
    child.is_refined.resize(child.len() + 8 * marked.len(), false);
    for &e in marked {
        parent.is_refined[e as usize] = true;
    }
    parent.refined.extend_from_slice(marked);
}

/// Makes some families of `child`, in order, from their parents, whose edges and faces are made.
fn refine(
    positions: &mut Vec<Point>,
    parent: &mut HexLevel,
    child: &mut HexLevel,
    families: Range<usize>,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    let volume_nodes = add_nodes(positions, parent, families.clone());
    let marked = &parent.refined[families];
    parallel::try_extend_arrays(&mut child.elements, marked.len(), monitor, |k| {
        let e = marked[k] as usize;
        let mut nodes = [NodeId(volume_nodes.0 + k as u32); 27];
        let Sides { edges, faces } = &parent.sides[e];
        nodes[..8].copy_from_slice(&parent.elements[e]);
        for (node, edge) in nodes[8..].iter_mut().zip(edges) {
            *node = parent.edges.middle[edge.index()];
        }
        for (node, face) in nodes[20..].iter_mut().zip(faces) {
            *node = parent.faces.centre[face.index()];
        }
        let mut family = [[NodeId(0); 8]; 8];
        for (child, corners) in family.iter_mut().zip(CHILDREN) {
            for (node, corner) in child.iter_mut().zip(corners) {
                *node = nodes[usize::from(corner)];
            }
        }
        family
    })
}

/// The corners of each child among the parent's corners (0..8), edges (8..20), faces (20..26) and centre (26).
const CHILDREN: [[u8; 8]; 8] = {
    let (mut all, mut i) = ([[0; 8]; 8], 0);
    while i < 8 {
        let mut j = 0;
        while j < 8 {
            all[i][j] = match apart(i, j) {
                0 => i as u8,
                1 => 8 + EDGE_BETWEEN[i][j],
                2 => 20 + FACE_ACROSS[i][j],
                _ => 26,
            };
            j += 1;
        }
        i += 1;
    }
    all
};

/// Divides the edges and faces of the parents of `families` that nothing divides yet and gives each parent its volume
/// node; returns the first of the volume nodes.
fn add_nodes(positions: &mut Vec<Point>, level: &mut HexLevel, families: Range<usize>) -> NodeId {
    let HexLevel { elements, refined, sides, edges, faces, .. } = level;
    let marked = &refined[families];
    let first = positions.len();
    let (old_edges, old_faces) = (edges.split.len(), faces.split.len());
    for &e in marked {
        for edge in sides[e as usize].edges {
            let middle = &mut edges.middle[edge.index()];
            if *middle == UNDIVIDED {
                *middle = NodeId::new(first + edges.split.len() - old_edges);
                edges.split.push(edge);
            }
        }
    }
    let first_centre = first + edges.split.len() - old_edges;
    for &e in marked {
        for face in sides[e as usize].faces {
            let centre = &mut faces.centre[face.index()];
            if *centre == UNDIVIDED {
                *centre = NodeId::new(first_centre + faces.split.len() - old_faces);
                faces.split.push(face);
            }
        }
    }
    let (edge_list, face_list) = (&edges.split[old_edges..], &faces.split[old_faces..]);
    let (n, m) = (edge_list.len(), face_list.len());
    parallel::grow(positions, n + m + marked.len(), |old, k| {
        if k < n {
            midpoint(old, edges.ends[edge_list[k].index()])
        } else if k < n + m {
            center(old, faces.nodes[face_list[k - n].index()])
        } else {
            middle(old, &elements[marked[k - n - m] as usize])
        }
    });
    NodeId::new(first + n + m)
}

/// The mean of the eight nodes of an element. Opposite corners are added first.
fn middle(positions: &[Point], element: &[NodeId; 8]) -> Point {
    let [a, b, c, d, e, f, g, h] = element.map(|n| positions[n.index()]);
    (((a + g) + (b + h)) + ((c + e) + (d + f))) * 0.125
}

/// The edges of face `f` of a hex with these edges, in the face's order.
pub(super) fn edges_of_face(f: usize, edges: &[EdgeId; 12]) -> [EdgeId; 4] {
    EDGES_OF_FACE[f].map(|e| edges[usize::from(e)])
}

#[cfg(test)]
mod tests;
