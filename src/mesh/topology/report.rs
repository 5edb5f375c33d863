//! What kind of surface a mesh is.

use serde::Serialize;

use super::{EdgeUses, Edges, Sets};
use crate::mesh::{EdgeId, Faces, NodeId};
use crate::monitor::batches;
use crate::{Cancelled, Monitor, Silent};

/// What kind of surface a mesh is. None of this is an error: open, non-manifold and one-sided surfaces
/// can be refined too.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct SurfaceReport {
    /// Nodes that some face uses.
    pub nodes: usize,
    /// Nodes that no face uses.
    pub unused_nodes: usize,
    /// Edges.
    pub edges: usize,
    /// Faces.
    pub faces: usize,
    /// Edges of one face.
    pub boundary_edges: usize,
    /// Connected parts of the boundary: the rims of holes and sheets.
    pub boundary_loops: usize,
    /// Edges where three or more faces meet.
    pub non_manifold_edges: usize,
    /// Nodes around which the faces form more than one fan.
    pub non_manifold_nodes: usize,
    /// Parts that share no node.
    pub components: usize,
    /// Euler characteristic: nodes - edges + faces.
    pub euler: i64,
    /// Edges of two faces that walk them in the same direction, so that their normals disagree.
    pub disagreeing_edges: usize,
    /// True if turning some faces around would make all normals agree (across edges of two faces).
    pub orientable: bool,
    /// True if the nodes can be coloured black and white so that every edge joins both colours.
    pub two_colourable: bool,
}

impl SurfaceReport {
    /// True if every edge has exactly two faces and every node one fan: a closed surface.
    pub fn is_closed_manifold(&self) -> bool {
        self.boundary_edges == 0 && self.is_manifold()
    }

    /// True if no edge has more than two faces and every node has one fan.
    pub fn is_manifold(&self) -> bool {
        self.non_manifold_edges == 0 && self.non_manifold_nodes == 0
    }
}

/// Looks a surface over. `edges` are those of `mesh`; all node ids are in range.
pub fn surface_report(mesh: &impl Faces, edges: &Edges) -> SurfaceReport {
    let uses = EdgeUses::of(edges);
    let used = used_nodes(mesh);
    let nodes = used.iter().filter(|&&u| u).count();
    let boundary: Vec<EdgeId> = edge_ids(edges).filter(|&e| uses.count(e) == 1).collect();
    let mut linked = Sets::new(mesh.node_count());
    for &[a, b] in &edges.ends {
        linked.join(a.0, b.0, false);
    }
    SurfaceReport {
        nodes,
        unused_nodes: used.len() - nodes,
        edges: edges.len(),
        faces: mesh.face_count(),
        boundary_edges: boundary.len(),
        boundary_loops: boundary_loops(mesh.node_count(), edges, &boundary),
        non_manifold_edges: edge_ids(edges).filter(|&e| uses.count(e) > 2).count(),
        non_manifold_nodes: non_manifold_nodes(mesh, edges).len(),
        components: linked.roots().filter(|&r| used[r as usize]).count(),
        euler: nodes as i64 - edges.len() as i64 + mesh.face_count() as i64,
        disagreeing_edges: edge_ids(edges).filter(|&e| disagrees(mesh, &uses, e)).count(),
        orientable: is_orientable(mesh, &uses, edges),
        two_colourable: two_colouring(mesh.node_count(), edges, &Silent).is_ok_and(|colours| colours.is_ok()),
    }
}

/// The edges in order.
pub(crate) fn edge_ids(edges: &Edges) -> impl Iterator<Item = EdgeId> + use<> {
    (0..edges.len()).map(EdgeId::new)
}

/// For each node whether some face uses it.
pub(crate) fn used_nodes(mesh: &impl Faces) -> Vec<bool> {
    let mut used = vec![false; mesh.node_count()];
    for n in mesh.corners() {
        used[n.index()] = true;
    }
    used
}

/// True if exactly two faces meet at `e` and both walk it in the same direction.
pub(crate) fn disagrees(mesh: &impl Faces, uses: &EdgeUses, e: EdgeId) -> bool {
    match uses.at(e) {
        &[k, l] => mesh.corners()[k as usize] == mesh.corners()[l as usize],
        _ => false,
    }
}

/// Colours the nodes so that every edge joins `false` and `true`; the least node of each component
/// gets `false`. The inner error is an edge that closes a cycle of odd length.
///
/// # Errors
/// If the monitor stops it.
pub fn two_colouring(
    nodes: usize,
    edges: &Edges,
    monitor: &dyn Monitor,
) -> Result<Result<Vec<bool>, EdgeId>, Cancelled> {
    let mut sides = Sets::new(nodes);
    for batch in batches(edges.len(), monitor) {
        for e in batch? {
            let [a, b] = edges.ends[e];
            if !sides.join(a.0, b.0, true) {
                return Ok(Err(EdgeId::new(e)));
            }
        }
    }
    let mut colours = Vec::with_capacity(nodes);
    for batch in batches(nodes, monitor) {
        colours.extend(batch?.map(|n| sides.root(n as u32).1));
    }
    Ok(Ok(colours))
}

/// The nodes around which the faces form more than one fan, with the number of fans.
///
/// Corners at a node belong to one fan if their faces share an edge there.
pub(crate) fn non_manifold_nodes(mesh: &impl Faces, edges: &Edges) -> Vec<(NodeId, usize)> {
    let corners = mesh.corners();
    let mut fans = Sets::new(corners.len());
    // For each edge the corners at its two ends in the face that came last.
    let mut before = vec![[NONE; 2]; edges.len()];
    for f in 0..mesh.face_count() {
        let range = mesh.range(f);
        for k in range.clone() {
            let next = if k + 1 == range.end { range.start } else { k + 1 };
            let e = edges.of_corner[k].index();
            let forwards = corners[k] == edges.ends[e][0];
            let here = if forwards { [k as u32, next as u32] } else { [next as u32, k as u32] };
            let there = std::mem::replace(&mut before[e], here);
            if there[0] != NONE {
                fans.join(here[0], there[0], false);
                fans.join(here[1], there[1], false);
            }
        }
    }
    let mut count = vec![0u32; mesh.node_count()];
    for r in fans.roots() {
        count[corners[r as usize].index()] += 1;
    }
    let several = count.iter().enumerate().filter(|&(_, &c)| c > 1);
    several.map(|(n, &c)| (NodeId::new(n), c as usize)).collect()
}

/// No corner, or no face.
const NONE: u32 = u32::MAX;

fn boundary_loops(nodes: usize, edges: &Edges, boundary: &[EdgeId]) -> usize {
    let mut linked = Sets::new(nodes);
    let mut on_rim = vec![false; nodes];
    for e in boundary {
        let [a, b] = edges.ends[e.index()];
        linked.join(a.0, b.0, false);
        on_rim[a.index()] = true;
        on_rim[b.index()] = true;
    }
    linked.roots().filter(|&r| on_rim[r as usize]).count()
}

fn is_orientable(mesh: &impl Faces, uses: &EdgeUses, edges: &Edges) -> bool {
    let mut turned = Sets::new(mesh.face_count());
    let mut first_face = vec![NONE; edges.len()];
    (0..mesh.face_count()).all(|f| {
        mesh.range(f).all(|k| {
            let e = edges.of_corner[k];
            let other = std::mem::replace(&mut first_face[e.index()], f as u32);
            other == NONE || uses.count(e) != 2 || turned.join(f as u32, other, disagrees(mesh, uses, e))
        })
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Point;
    use crate::mesh::PolygonMesh;

    fn report(nodes: usize, faces: &[&[u32]]) -> SurfaceReport {
        let mut mesh = PolygonMesh { positions: vec![Point::ZERO; nodes], ..Default::default() };
        for face in faces {
            mesh.push_face(face.iter().map(|&n| NodeId(n)));
        }
        surface_report(&mesh, &Edges::of_polygons(&mesh))
    }

    /// The faces of a cube with corner x + 2y + 4z, oriented outwards.
    const CUBE: [&[u32]; 6] =
        [&[0, 2, 3, 1], &[4, 5, 7, 6], &[0, 1, 5, 4], &[2, 6, 7, 3], &[0, 4, 6, 2], &[1, 3, 7, 5]];

    #[test]
    fn a_cube_is_a_closed_sphere_like_surface() {
        let cube = report(8, &CUBE);
        assert!(cube.is_closed_manifold() && cube.orientable && cube.two_colourable);
        assert_eq!((cube.euler, cube.components, cube.boundary_loops, cube.disagreeing_edges), (2, 1, 0, 0));
    }

    #[test]
    fn a_turned_face_disagrees_with_its_neighbours_but_can_be_turned_back() {
        let mut faces = CUBE;
        faces[5] = &[5, 7, 3, 1];
        let cube = report(8, &faces);
        assert_eq!(cube.disagreeing_edges, 4);
        assert!(cube.orientable);
    }

    /// Rings of `n` quads between nodes 0..n and n..2n, the last with a half twist or without.
    fn ring(n: u32, twisted: bool) -> SurfaceReport {
        let quads: Vec<[u32; 4]> = (0..n)
            .map(|i| match (i + 1 == n, twisted) {
                (false, _) => [i, i + 1, n + i + 1, n + i],
                (true, false) => [i, 0, n, n + i],
                (true, true) => [i, n, 0, n + i],
            })
            .collect();
        let faces: Vec<&[u32]> = quads.iter().map(<[u32; 4]>::as_slice).collect();
        report(2 * n as usize, &faces)
    }

    #[test]
    fn tells_an_annulus_from_a_moebius_strip() {
        let annulus = ring(6, false);
        assert!(annulus.orientable && annulus.two_colourable);
        assert_eq!((annulus.boundary_loops, annulus.euler), (2, 0));
        let moebius = ring(6, true);
        assert!(!moebius.orientable && !moebius.two_colourable);
        assert_eq!((moebius.boundary_loops, moebius.euler), (1, 0));
        assert!(!ring(5, false).two_colourable, "an odd ring");
    }

    #[test]
    fn counts_components_loose_nodes_and_pinches() {
        let two = report(9, &[&[0, 1, 2], &[3, 4, 5]]);
        assert_eq!((two.components, two.unused_nodes, two.non_manifold_nodes), (2, 3, 0));
        let pinched = report(5, &[&[0, 1, 2], &[2, 3, 4]]);
        assert_eq!((pinched.components, pinched.non_manifold_nodes, pinched.boundary_loops), (1, 1, 1));
        let book = report(5, &[&[0, 1, 2], &[1, 0, 3], &[0, 1, 4]]);
        assert_eq!((book.non_manifold_edges, book.non_manifold_nodes, book.boundary_edges), (1, 0, 6));
    }

    #[test]
    fn colours_start_at_the_least_node_of_each_component() {
        let mut mesh = PolygonMesh { positions: vec![Point::ZERO; 9], ..Default::default() };
        mesh.push_face([3, 2, 1, 0].map(NodeId));
        mesh.push_face([8, 7, 6, 5].map(NodeId));
        let colours = two_colouring(9, &Edges::of_polygons(&mesh), &Silent).unwrap().unwrap();
        assert_eq!(colours, [false, true, false, true, false, false, true, false, true]);
        mesh.push_face([0, 1, 8].map(NodeId));
        let edges = Edges::of_polygons(&mesh);
        let odd = two_colouring(9, &edges, &Silent).unwrap().unwrap_err();
        assert_eq!(edges.ends[odd.index()], [8, 0].map(NodeId));
    }
}
