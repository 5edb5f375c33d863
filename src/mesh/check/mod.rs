//! Is a mesh conforming, and what else is there to know of it?
//!
//! [`check_quads`], [`check_polygons`] and [`check_hexes`] walk every invariant and give each [`Defect`] with its
//! ids; the command line, the tests and the page all show what they find. For surfaces in this order:
//!
//! 1. the faces' table, node ids and numbers of nodes (if these fail, nothing below is looked at);
//! 2. coordinates are finite;
//! 3. per face: repeated nodes, no area;
//! 4. faces with the same nodes;
//! 5. per edge: three or more faces, disagreeing directions;
//! 6. per node: unused, several fans;
//! 7. hanging nodes at edges of one face (see [`hanging_nodes`] for all edges).
//!
//! Time grows linearly with the mesh, but for the search tree over the boundary edges of step 7.

mod defect;
mod hanging;
mod hexes;
mod same_nodes;

pub(crate) use defect::listed;
pub use defect::{Defect, DefectCount, Severity, summary};
pub use hanging::hanging_nodes;
pub(crate) use hexes::hanging_on;
pub use hexes::{check_hexes, check_hexes_on, check_hexes_within};

use super::topology::{EdgeUses, Edges, disagrees, edge_ids, non_manifold_nodes, used_nodes};
use super::{EdgeId, FaceId, Faces, NodeId, PolygonMesh, QuadMesh};
use crate::geometry::Point;
use crate::parallel;
use crate::{Cancelled, Monitor, Silent};

/// Everything wrong with a quad mesh; empty for a conforming, oriented manifold without loose nodes.
pub fn check_quads(mesh: &QuadMesh) -> Vec<Defect> {
    check(mesh)
}

/// Everything wrong with a polygon mesh, as [`check_quads`].
pub fn check_polygons(mesh: &PolygonMesh) -> Vec<Defect> {
    match broken_offsets(mesh) {
        Some(face) => vec![Defect::BrokenOffsets { face }],
        None => check(mesh),
    }
}

/// What keeps a polygon mesh from being one at all: broken offsets, faces of fewer than three nodes, ids out of
/// range, coordinates that are not finite, nodes repeated in a face. In time linear in the mesh.
///
/// # Errors
/// If the monitor stops it.
pub fn check_faces(mesh: &PolygonMesh, monitor: &dyn Monitor) -> Result<Vec<Defect>, Cancelled> {
    if let Some(face) = broken_offsets(mesh) {
        return Ok(vec![Defect::BrokenOffsets { face }]);
    }
    let at_each = |count: usize, look: &(dyn Fn(usize) -> Option<Defect> + Sync)| {
        parallel::try_gather(count, monitor, |k, found| found.extend(look(k)))
    };
    let mut defects = at_each(mesh.face_count(), &|f| face_ids(mesh, f))?;
    if defects.is_empty() {
        defects.extend(at_each(mesh.positions.len(), &|n| not_finite_at(&mesh.positions, n))?);
        defects.extend(at_each(mesh.face_count(), &|f| {
            repeated_node(mesh.face(f)).map(|node| Defect::RepeatedNode { face: FaceId::new(f), node })
        })?);
    }
    Ok(defects)
}

fn not_finite(positions: &[Point]) -> Vec<Defect> {
    parallel::filter_map(positions.len(), |n| not_finite_at(positions, n))
}

fn not_finite_at(positions: &[Point], n: usize) -> Option<Defect> {
    (!positions[n].is_finite()).then(|| Defect::NotFinite { node: NodeId::new(n) })
}

fn check(mesh: &impl Faces) -> Vec<Defect> {
    let mut defects = per_face(mesh, |f| face_ids(mesh, f));
    if !defects.is_empty() {
        return defects;
    }
    defects.extend(not_finite(mesh.positions()));
    let all_finite = defects.is_empty();
    defects.extend(per_face(mesh, |f| face_shape(mesh, f)));
    let (same, (edges, uses)) = parallel::join(
        || same_nodes::same_nodes(mesh),
        || {
            let edges = Edges::of(mesh);
            let uses = EdgeUses::of(&edges);
            (edges, uses)
        },
    );
    let (at_edges, pinched) =
        parallel::join(|| edge_defects(mesh, &edges, &uses), || non_manifold_nodes(mesh, &edges));
    let used = used_nodes(mesh);
    let unused = used.iter().enumerate().filter(|&(_, &u)| !u);
    defects.extend(same);
    defects.extend(at_edges);
    defects.extend(unused.map(|(n, _)| Defect::UnusedNode { node: NodeId::new(n) }));
    defects.extend(pinched.into_iter().map(|(node, n)| Defect::NonManifoldNode { node, fans: n as u32 }));
    if all_finite {
        let open = edge_ids(&edges).filter(|&e| uses.count(e) == 1).map(|e| edges.ends[e.index()]);
        let found = hanging::inside(mesh.positions(), &used, open.collect(), &Silent);
        defects.extend(found.expect("nobody stops it").into_iter().map(hanging::defect));
    }
    defects
}

/// What `look` finds at each face, in order of faces.
fn per_face(mesh: &impl Faces, look: impl Fn(usize) -> Option<Defect> + Sync) -> Vec<Defect> {
    parallel::filter_map(mesh.face_count(), look)
}

/// The first face whose corners are not where its offsets say.
fn broken_offsets(mesh: &PolygonMesh) -> Option<FaceId> {
    let (first, last) = (mesh.offsets.first().copied(), mesh.offsets.last().copied());
    if first != Some(0) {
        return Some(FaceId(0));
    }
    let falls = mesh.offsets.windows(2).position(|w| w[1] < w[0]);
    let short =
        (last != u32::try_from(mesh.corners.len()).ok()).then(|| mesh.offsets.len().saturating_sub(2));
    falls.or(short).map(FaceId::new)
}

/// Step 1 at one face.
fn face_ids(mesh: &impl Faces, f: usize) -> Option<Defect> {
    let (face, nodes) = (FaceId::new(f), mesh.nodes_of(f));
    if nodes.len() < 3 {
        return Some(Defect::TooFewNodes { face, count: nodes.len() as u32 });
    }
    let wrong = nodes.iter().find(|n| n.index() >= mesh.node_count());
    wrong.map(|&node| Defect::NodeOutOfRange { face, node, nodes: mesh.node_count() as u32 })
}

/// Step 3 at one face: a face with a repeated node is not told to lack area as well.
fn face_shape(mesh: &impl Faces, f: usize) -> Option<Defect> {
    let (face, nodes) = (FaceId::new(f), mesh.nodes_of(f));
    if let Some(node) = repeated_node(nodes) {
        return Some(Defect::RepeatedNode { face, node });
    }
    has_no_area(mesh.positions(), nodes).then_some(Defect::ZeroArea { face })
}

fn repeated_node(nodes: &[NodeId]) -> Option<NodeId> {
    /// Up to this many nodes, comparing all pairs is faster than sorting.
    const FEW: usize = 12;
    if nodes.len() <= FEW {
        let again = |i: usize| nodes[..i].contains(&nodes[i]);
        return (1..nodes.len()).find(|&i| again(i)).map(|i| nodes[i]);
    }
    let mut sorted = nodes.to_vec();
    sorted.sort_unstable();
    sorted.windows(2).find(|w| w[0] == w[1]).map(|w| w[0])
}

/// A face whose vector area is below this share of the square of its size counts as having none: what
/// is left of the digits of f64 once coordinates are a thousand times larger than the face.
const NO_AREA: f64 = 1e-12;

fn has_no_area(positions: &[Point], nodes: &[NodeId]) -> bool {
    let at = |i: usize| positions[nodes[i].index()] - positions[nodes[0].index()];
    let size = (1..nodes.len()).map(|i| at(i).abs().max_element()).fold(0.0, f64::max);
    if size == 0.0 {
        return true;
    }
    // Scaled to size 1, so that neither tiny nor huge models leave the range of f64.
    let area: Point = (1..nodes.len() - 1).map(|i| (at(i) / size).cross(at(i + 1) / size)).sum();
    area.length() < NO_AREA
}

/// Step 5.
fn edge_defects(mesh: &impl Faces, edges: &Edges, uses: &EdgeUses) -> Vec<Defect> {
    parallel::filter_map(edges.len(), |e| edge_defect(mesh, edges, uses, EdgeId::new(e)))
}

/// Step 5 at one edge.
fn edge_defect(mesh: &impl Faces, edges: &Edges, uses: &EdgeUses, e: EdgeId) -> Option<Defect> {
    let faces = || uses.at(e).iter().map(|&k| FaceId::new(mesh.face_of(k as usize)));
    let edge = edges.ends[e.index()];
    if uses.count(e) > 2 {
        return Some(Defect::NonManifoldEdge { edge, faces: faces().collect() });
    }
    let mut two = faces();
    match (disagrees(mesh, uses, e), two.next(), two.next()) {
        // A face that walks an edge twice has a repeated node, which step 3 told.
        (true, Some(g), Some(h)) if g != h => Some(Defect::Disagreement { edge, faces: [g, h] }),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
