//! The base level of a forest, from a polygon mesh.
//!
//! As in the paper every face of level 0 is refined once, which tells edge nodes from the others everywhere:
//!
//! ```text
//!        q2                 an n-gon becomes n quads: child i is
//!       /  \                (q_i, m_i, c, m_{i-1}), with the edges
//!     m2    m1              half of e_i at q_i, interior i,
//!     /  \ /  \             interior i-1, half of e_{i-1} at q_i;
//!    /    c    \            interior i joins m_i to c
//!   q0----m0----q1
//! ```
//!
//! Where the nodes of an all-quad mesh can be coloured with two colours, none beside its own, the coarse quads
//! themselves alternate: turned so that local nodes 1 and 3 have the second colour they serve as the base
//! level, and need not be refined (beyond the paper).

use super::QuadForest;
use super::quadtree::{Level, LevelEdges, midpoint};
use crate::geometry::Point;
use crate::mesh::topology::two_colouring;
use crate::mesh::{EdgeId, Edges, FaceId, NodeId, PolygonMesh};
use crate::monitor::batches;
use crate::parallel;
use crate::{Cancelled, Monitor};

/// Why a polygon mesh cannot be the base of a forest.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum BaseError {
    /// Coarse quads can be kept only where all faces are quads.
    #[error("face {face} has {nodes} nodes; coarse faces can be kept only if all of them are quads")]
    NotAQuad {
        /// The first face that is no quad.
        face: FaceId,
        /// How many nodes it has.
        nodes: usize,
    },
    /// Coarse quads can be kept only where the nodes can be two-coloured.
    #[error(
        "nodes {} and {} lie on a cycle of odd length, so that the coarse quads cannot alternate \
         edge nodes and others; refine without keeping them", .0[0], .0[1]
    )]
    OddCycle([NodeId; 2]),
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl QuadForest {
    /// The forest of level 1: every face of `input` refined once.
    ///
    /// # Errors
    /// If the monitor stops it.
    pub fn refined_once(input: &PolygonMesh, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let edges = Edges::monitored(input, monitor)?;
        let (mut positions, node_of) = used_nodes(input, monitor)?;
        let first_edge_node = positions.len();
        positions.reserve_exact(edges.len() + input.face_count());
        parallel::try_extend(&mut positions, edges.len(), monitor, |e| {
            midpoint(&input.positions, edges.ends[e])
        })?;
        let first_face_node = positions.len();
        parallel::try_extend(&mut positions, input.face_count(), monitor, |f| mean(input, f))?;

        let edge_node = |e: EdgeId| NodeId::new(first_edge_node + e.index());
        let mut ends = Vec::with_capacity(2 * edges.len() + input.corners.len());
        parallel::try_extend(&mut ends, 2 * edges.len(), monitor, |half| {
            let e = half / 2;
            [edge_node(EdgeId::new(e)), node_of[edges.ends[e][half % 2].index()]]
        })?;
        let first_interior = ends.len();

        let mut elements = Vec::with_capacity(input.corners.len());
        let mut of_element = Vec::with_capacity(input.corners.len());
        let mut roots = Vec::with_capacity(input.corners.len());
        for batch in batches(input.face_count(), monitor) {
            for f in batch? {
                let face_node = NodeId::new(first_face_node + f);
                let (start, end) = (input.offsets[f] as usize, input.offsets[f + 1] as usize);
                for here in start..end {
                    let before = if here == start { end - 1 } else { here - 1 };
                    let corner = input.corners[here];
                    let (edge, edge_before) = (edges.of_corner[here], edges.of_corner[before]);
                    let half = |e: EdgeId| EdgeId(2 * e.0 + u32::from(edges.ends[e.index()][1] == corner));
                    let interior = |k: usize| EdgeId::new(first_interior + k);
                    let corner = node_of[corner.index()];
                    elements.push([corner, edge_node(edge), face_node, edge_node(edge_before)]);
                    of_element.push([half(edge), interior(here), interior(before), half(edge_before)]);
                    ends.push([edge_node(edge), face_node]);
                    roots.push(FaceId::new(f));
                }
            }
        }
        let base = Level::base(elements, roots, LevelEdges::base(of_element, ends));
        Ok(Self { positions, levels: vec![base], base_level: 1 })
    }

    /// The forest of level 0, whose base is the quads of `input` as they are.
    ///
    /// # Errors
    /// If a face is no quad, the nodes cannot be two-coloured, or the monitor stops it.
    pub fn coarse(input: &PolygonMesh, monitor: &dyn Monitor) -> Result<Self, BaseError> {
        let mut elements = as_quads(input)?;
        let edges = Edges::monitored(input, monitor)?;
        let is_edge_node = two_colouring(input.positions.len(), &edges, monitor)?
            .map_err(|e| BaseError::OddCycle(edges.ends[e.index()]))?;
        let (positions, node_of) = used_nodes(input, monitor)?;
        let new = |n: NodeId| node_of[n.index()];
        let mut of_element: Vec<[EdgeId; 4]> =
            edges.of_corner.chunks_exact(4).map(|e| [e[0], e[1], e[2], e[3]]).collect();
        for batch in batches(elements.len(), monitor) {
            let batch = batch?;
            for (element, sides) in elements[batch.clone()].iter_mut().zip(&mut of_element[batch]) {
                if is_edge_node[element[0].index()] {
                    element.rotate_left(1);
                    sides.rotate_left(1);
                }
                *element = element.map(new);
            }
        }
        let edge_node_first = |ends: &[NodeId; 2]| {
            let [a, b] = *ends;
            if is_edge_node[a.index()] { [new(a), new(b)] } else { [new(b), new(a)] }
        };
        let ends = edges.ends.iter().map(edge_node_first).collect();
        let roots = (0..elements.len()).map(FaceId::new).collect();
        let base = Level::base(elements, roots, LevelEdges::base(of_element, ends));
        Ok(Self { positions, levels: vec![base], base_level: 0 })
    }

    /// The quads of `input` as a forest that is never to be split.
    ///
    /// # Errors
    /// If a face is no quad, or the monitor stops it.
    pub fn untouched(input: &PolygonMesh, monitor: &dyn Monitor) -> Result<Self, BaseError> {
        let elements = as_quads(input)?;
        let (positions, node_of) = used_nodes(input, monitor)?;
        let elements: Vec<_> = elements.iter().map(|q| q.map(|n| node_of[n.index()])).collect();
        let roots = (0..elements.len()).map(FaceId::new).collect();
        Ok(Self {
            positions,
            levels: vec![Level::base(elements, roots, LevelEdges::default())],
            base_level: 0,
        })
    }
}

/// The faces of `input`, if all of them are quads.
fn as_quads(input: &PolygonMesh) -> Result<Vec<[NodeId; 4]>, BaseError> {
    input
        .faces()
        .enumerate()
        .map(|(f, nodes)| {
            nodes.try_into().map_err(|_| BaseError::NotAQuad { face: FaceId::new(f), nodes: nodes.len() })
        })
        .collect()
}

/// The positions of the nodes that some face has, in order, and the new number of each.
fn used_nodes(input: &PolygonMesh, monitor: &dyn Monitor) -> Result<(Vec<Point>, Vec<NodeId>), Cancelled> {
    let mut used = vec![false; input.positions.len()];
    for batch in batches(input.corners.len(), monitor) {
        for n in &input.corners[batch?] {
            used[n.index()] = true;
        }
    }
    let mut positions = Vec::with_capacity(input.positions.len());
    let node_of = used
        .iter()
        .zip(&input.positions)
        .map(|(&used, &p)| {
            let id = NodeId::new(positions.len());
            if used {
                positions.push(p);
            }
            id
        })
        .collect();
    Ok((positions, node_of))
}

/// The mean of the nodes of face `f`. Opposite corners are added first, as for every other element.
fn mean(input: &PolygonMesh, f: usize) -> Point {
    let nodes = input.face(f);
    let at = |n: NodeId| input.positions[n.index()];
    if let [a, b, c, d] = *nodes {
        return ((at(a) + at(c)) + (at(b) + at(d))) * 0.25;
    }
    nodes.iter().map(|&n| at(n)).sum::<Point>() / nodes.len() as f64
}
