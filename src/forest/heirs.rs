//! What the elements of a level leave to the next: edges and faces of their children, from their own.

use super::octree::{HexLevel, LevelEdges, LevelFaces, Sides};
use super::quadtree::append;
use crate::mesh::numbering::hex::{EDGE_BETWEEN, EDGES, FACE_ACROSS, FACES, FACES_AT_EDGE, apart};
use crate::mesh::{EdgeId, FaceId, NodeId};
use crate::{Cancelled, Monitor, parallel};

/// Makes the edges and faces of `child` that the splits of `parent` have called for.
///
/// New edges come in this order: halves of split edges, edges inside split faces, edges inside split elements; new
/// faces: quarters of split faces, faces inside split elements.
///
/// # Errors
/// If the monitor stops it; then the levels are of no use any more.
pub(super) fn inherit(
    parent: &mut HexLevel,
    child: &mut HexLevel,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    let known = child.sides.len() / 8;
    let marked = &parent.refined[known..];
    if marked.is_empty() {
        return Ok(());
    }
    let (edges, faces) = (&mut parent.edges, &mut parent.faces);
    let (first_half, first_quarter) = (child.edges.ends.len(), child.faces.nodes.len());
    let (new_edges, new_faces) = (&edges.split[edges.halved..], &faces.split[faces.quartered..]);
    for (k, e) in new_edges.iter().enumerate() {
        edges.halves[e.index()] = EdgeId::new(first_half + 2 * k);
    }
    let first_inside = first_half + 2 * new_edges.len();
    for (k, f) in new_faces.iter().enumerate() {
        faces.inside[f.index()] = EdgeId::new(first_inside + 4 * k);
        faces.quarters[f.index()] = FaceId::new(first_quarter + 4 * k);
    }
    let heirs = Heirs {
        edges,
        faces,
        elements: &parent.elements,
        sides: &parent.sides,
        families: &child.elements[8 * known..],
        first_edge: first_inside + 4 * new_faces.len(),
        first_face: first_quarter + 4 * new_faces.len(),
    };
    let halves = parallel::try_collect(new_edges.len(), monitor, |k| heirs.halves(new_edges[k]))?;
    let in_faces = parallel::try_collect(new_faces.len(), monitor, |k| heirs.edges_in_face(new_faces[k]))?;
    let in_elements = parallel::try_collect(marked.len(), monitor, |k| heirs.edges_in_element(k))?;
    let quarters = parallel::try_collect(new_faces.len(), monitor, |k| heirs.quarters(new_faces[k]))?;
    let (quarter_nodes, quarter_edges): (Vec<_>, Vec<_>) = quarters.into_iter().unzip();
    monitor.proceed()?;
    let walls = parallel::try_collect(marked.len(), monitor, |k| heirs.faces_in_element(k, marked[k]))?;
    let (wall_nodes, wall_edges): (Vec<_>, Vec<_>) = walls.into_iter().unzip();
    monitor.proceed()?;
    let sides = parallel::try_collect(marked.len(), monitor, |k| heirs.sides(k, marked[k]))?;

    let ends = [halves.into_flattened(), in_faces.into_flattened(), in_elements.into_flattened()];
    for ends in ends {
        append(&mut child.edges.ends, ends);
        monitor.proceed()?;
    }
    child.edges.settle();
    monitor.proceed()?;
    for nodes in [quarter_nodes.into_flattened(), wall_nodes.into_flattened()] {
        append(&mut child.faces.nodes, nodes);
        monitor.proceed()?;
    }
    for edges in [quarter_edges.into_flattened(), wall_edges.into_flattened()] {
        append(&mut child.faces.edges, edges);
        monitor.proceed()?;
    }
    child.faces.settle();
    monitor.proceed()?;
    append(&mut child.sides, sides.into_flattened());
    parent.edges.halved = parent.edges.split.len();
    parent.faces.quartered = parent.faces.split.len();
    monitor.proceed()
}

/// What split edges, faces and elements leave to the next level.
struct Heirs<'a> {
    edges: &'a LevelEdges,
    faces: &'a LevelFaces,
    elements: &'a [[NodeId; 8]],
    sides: &'a [Sides],
    /// The children of the newly split elements.
    families: &'a [[NodeId; 8]],
    /// The first of the edges inside the first newly split element.
    first_edge: usize,
    /// The first of the faces inside it.
    first_face: usize,
}

impl Heirs<'_> {
    fn halves(&self, e: EdgeId) -> [[NodeId; 2]; 2] {
        self.edges.ends[e.index()].map(|end| [end, self.edges.middle[e.index()]])
    }

    fn middle(&self, e: EdgeId) -> NodeId {
        self.edges.middle[e.index()]
    }

    fn edges_in_face(&self, f: FaceId) -> [[NodeId; 2]; 4] {
        self.faces.edges[f.index()].map(|e| [self.middle(e), self.faces.centre[f.index()]])
    }

    /// Quarter `k` of a face is (node k, middle of edge k, centre, middle of edge k - 1), as of a quad.
    fn quarters(&self, f: FaceId) -> ([[NodeId; 4]; 4], [[EdgeId; 4]; 4]) {
        let (nodes, edges) = (self.faces.nodes[f.index()], self.faces.edges[f.index()]);
        let (centre, inside) = (self.faces.centre[f.index()], self.faces.inside[f.index()].0);
        let before = |k: usize| (k + 3) % 4;
        let corners = |k: usize| [nodes[k], self.middle(edges[k]), centre, self.middle(edges[before(k)])];
        let sides = |k: usize| {
            let half = |e: EdgeId| self.edges.half(e, nodes[k]);
            let inner = |k: usize| EdgeId(inside + k as u32);
            [half(edges[k]), inner(k), inner(before(k)), half(edges[before(k)])]
        };
        (std::array::from_fn(corners), std::array::from_fn(sides))
    }

    /// The volume node of family `k`: the corner of child 0 that is opposite to the parent's.
    fn volume_node(&self, k: usize) -> NodeId {
        self.families[8 * k][6]
    }

    /// Edge `f` inside an element runs from the centre of face `f` to its own.
    fn edges_in_element(&self, k: usize) -> [[NodeId; 2]; 6] {
        std::array::from_fn(|f| {
            let [corner, _, opposite, _] = FACES[f].map(usize::from);
            [self.families[8 * k + corner][opposite], self.volume_node(k)]
        })
    }

    /// The edge inside family `k`'s parent from the centre of its face `f`.
    fn spoke(&self, k: usize, f: u8) -> EdgeId {
        EdgeId::new(self.first_edge + 6 * k + usize::from(f))
    }

    /// Face `j` inside an element has the middle of its edge `j`, the centres of the faces at that, and its own.
    fn faces_in_element(&self, k: usize, e: u32) -> ([[NodeId; 4]; 12], [[EdgeId; 4]; 12]) {
        let sides = &self.sides[e as usize];
        let face = |f: u8| sides.faces[usize::from(f)];
        let nodes = |j: usize| {
            let [f, g] = FACES_AT_EDGE[j].map(|f| self.faces.centre[face(f).index()]);
            [self.middle(sides.edges[j]), f, self.volume_node(k), g]
        };
        let edges = |j: usize| {
            let [f, g] = FACES_AT_EDGE[j];
            let rim = |f: u8| self.faces.inside_at(face(f), sides.edges[j]);
            [rim(f), self.spoke(k, f), self.spoke(k, g), rim(g)]
        };
        (std::array::from_fn(nodes), std::array::from_fn(edges))
    }

    /// The edges and faces of the children of element `e`, family `k`.
    fn sides(&self, k: usize, e: u32) -> [Sides; 8] {
        std::array::from_fn(|i| Sides {
            edges: EDGES.map(|ends| self.child_edge(k, e, i, ends)),
            faces: std::array::from_fn(|f| self.child_face(k, e, i, f)),
        })
    }

    /// The edge of child `i` between two of its corners: half of an edge, inside a face, or inside the element.
    fn child_edge(&self, k: usize, e: u32, i: usize, ends: [u8; 2]) -> EdgeId {
        let sides = &self.sides[e as usize];
        let [a, b] = ends.map(usize::from);
        let (near, far) = if apart(i, a) < apart(i, b) { (a, b) } else { (b, a) };
        let edge = |to: usize| sides.edges[usize::from(EDGE_BETWEEN[i][to])];
        match apart(i, near) {
            0 => self.edges.half(edge(far), self.elements[e as usize][i]),
            1 => self.faces.inside_at(sides.faces[usize::from(FACE_ACROSS[i][far])], edge(near)),
            _ => self.spoke(k, FACE_ACROSS[i][near]),
        }
    }

    /// Face `f` of child `i`: a quarter of the parent's face `f` if that has corner `i`, else inside the element,
    /// at the middle of the edge from corner `i` to the face.
    fn child_face(&self, k: usize, e: u32, i: usize, f: usize) -> FaceId {
        if FACES[f].contains(&(i as u8)) {
            return self.faces.quarter(self.sides[e as usize].faces[f], self.elements[e as usize][i]);
        }
        let near = FACES[f].into_iter().find(|&j| apart(i, usize::from(j)) == 1);
        let near = usize::from(near.expect("a face without corner i has a neighbour of it"));
        FaceId::new(self.first_face + 12 * k + usize::from(EDGE_BETWEEN[i][near]))
    }
}
