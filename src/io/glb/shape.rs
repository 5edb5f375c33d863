//! What is drawn of a mesh: f32 coordinates, triangles by tag set, edges.

use std::collections::BTreeMap;

use crate::geometry::{Aabb, Point, triangulate};
use crate::io::cell_view::{CellView, Cells};
use crate::mesh::topology::hex_boundary;
use crate::mesh::{Edges, Faces, NodeId, QuadMesh};

/// A mesh ready for buffers.
pub(super) struct Shape {
    /// What is to be added to the coordinates.
    pub center: Point,
    pub positions: Vec<[f32; 3]>,
    /// The triangles of each tag set.
    pub triangles: BTreeMap<u32, Vec<[u32; 3]>>,
    pub edges: Vec<[u32; 2]>,
}

impl Shape {
    /// The shape of a mesh; its edges only if they are wanted.
    pub fn of(view: &CellView<'_>, with_edges: bool) -> Self {
        let set = |cell: usize| view.tags.of_element.get(cell).copied().unwrap_or(0);
        match view.cells {
            Cells::Polygons(mesh) => Self::of_faces(mesh, set, with_edges),
            Cells::Quads(quads) => {
                let mesh = QuadMesh { positions: view.positions.to_vec(), quads: quads.to_vec() };
                Self::of_faces(&mesh, set, with_edges)
            }
            Cells::Hexes(hexes) => Self::of_hexes(view, hexes, set, with_edges),
            Cells::SecondOrder(hexes) => {
                let corners = |h: usize| std::array::from_fn(|c| hexes.nodes_of(h)[c]);
                let corners: Vec<[NodeId; 8]> = (0..view.cells.len()).map(corners).collect();
                Self::of_hexes(view, &corners, set, with_edges)
            }
        }
    }

    /// The boundary of hexes, with straight edges.
    fn of_hexes(
        view: &CellView<'_>,
        hexes: &[[NodeId; 8]],
        set: impl Fn(usize) -> u32,
        with_edges: bool,
    ) -> Self {
        let (quads, cells): (Vec<_>, Vec<_>) = hex_boundary(hexes).into_iter().unzip();
        let mesh = QuadMesh { positions: view.positions.to_vec(), quads };
        Self::of_faces(&mesh, |face| set(cells[face].index()), with_edges)
    }

    fn of_faces(mesh: &impl Faces, set: impl Fn(usize) -> u32, with_edges: bool) -> Self {
        let used = used_nodes(mesh);
        let bounds = Aabb::around(&used.iter().map(|&node| mesh.positions()[node]).collect::<Vec<_>>());
        let center = (bounds.min + bounds.max) / 2.0;
        let mut index_of = vec![0; mesh.node_count()];
        for (index, &node) in (0..).zip(&used) {
            index_of[node] = index;
        }
        let index = |node: NodeId| index_of[node.index()];
        let positions =
            used.iter().map(|&node| (mesh.positions()[node] - center).as_vec3().to_array()).collect();
        let mut triangles: BTreeMap<u32, Vec<[u32; 3]>> = BTreeMap::new();
        let (mut points, mut cut) = (Vec::new(), Vec::new());
        for face in 0..mesh.face_count() {
            let nodes = mesh.nodes_of(face);
            points.clear();
            points.extend(nodes.iter().map(|node| mesh.positions()[node.index()]));
            cut.clear();
            triangulate(&points, &mut cut);
            let corners = |triangle: &[u32; 3]| triangle.map(|corner| index(nodes[corner as usize]));
            triangles.entry(set(face)).or_default().extend(cut.iter().map(corners));
        }
        let edges = if with_edges {
            Edges::of(mesh).ends.into_iter().map(|ends| ends.map(index)).collect()
        } else {
            Vec::new()
        };
        Self { center, positions, triangles, edges }
    }
}

/// The nodes that faces have, in the order of the mesh.
fn used_nodes(mesh: &impl Faces) -> Vec<usize> {
    let mut used = vec![false; mesh.node_count()];
    for node in mesh.corners() {
        used[node.index()] = true;
    }
    (0..used.len()).filter(|&node| used[node]).collect()
}
