//! A hex mesh as it is looked into: which cells are shown, and the faces that show them.
//!
//! 1. Once, from topology alone: the unique faces, the one or two cells at each, and how deep each cell lies.
//! 2. For each [`Cut`], in one pass over the cells: which are shown.
//! 3. In one pass over the faces: those between a shown cell and a hidden one or none. Each is met once, so that no
//!    two faces of what is drawn lie in one place.
//!
//! A face inside the mesh that comes to light is a *cap*. A mesh costs about 100 bytes a cell beside its nodes.

use std::collections::VecDeque;

use glam::Vec3;

use super::{Section, Surface, SurfaceError};
use crate::geometry::Aabb;
use crate::mesh::topology::{HexFaces, hex_of};
use crate::mesh::{FaceId, NodeId};

/// A hex mesh in scene coordinates.
#[derive(Clone, Debug)]
pub struct Hexes {
    /// The nodes, without faces.
    nodes: Surface,
    cells: Vec<[u32; 8]>,
    faces: Vec<[u32; 4]>,
    /// The cells at each face; it is anticlockwise seen from outside the first. On the boundary the second is the
    /// number of cells, a cell that is never shown.
    sides: Vec<[u32; 2]>,
    centers: Vec<Vec3>,
    /// Cells between each cell and the boundary, through faces; those at the boundary have 0.
    depth: Vec<u16>,
}

/// What is hidden of a hex mesh.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Cut {
    /// Cells beyond this plane.
    pub section: Option<Section>,
    /// Cells less deep than this.
    pub peel: u16,
    /// Cells that are false here; `None`: no more than the other two. As many as there are cells.
    pub kept: Option<Vec<bool>>,
}

/// The faces that show a cut mesh, outwards from what is shown.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Shown {
    /// The nodes of each face.
    pub faces: Vec<[u32; 4]>,
    /// The shown cell at each face.
    pub cells: Vec<u32>,
    /// Whether each face lies inside the mesh.
    pub is_cap: Vec<bool>,
}

impl Hexes {
    /// A hex mesh from flat arrays: three coordinates a node, eight nodes a hex in the order of VTK_HEXAHEDRON.
    pub fn new(coordinates: &[f64], corners: &[u32]) -> Result<Self, SurfaceError> {
        let nodes = Surface::new(coordinates, None, Vec::new())?;
        let (cells, rest) = corners.as_chunks::<8>();
        if !rest.is_empty() {
            return Err(SurfaceError::Hexes(corners.len()));
        }
        let node_count = nodes.positions().len();
        if let Some(at) = corners.iter().position(|&n| n as usize >= node_count) {
            return Err(SurfaceError::Node { face: at / 8, node: corners[at], nodes: node_count });
        }
        let topology = HexFaces::of(node_count, bytemuck::cast_slice::<_, [NodeId; 8]>(cells));
        let outside = cells.len() as u32;
        let sides_of = |f: FaceId| {
            let mut cells = topology.sides(f).iter().map(|&side| hex_of(side).0);
            // Of more than two cells at a face, which no sound mesh has, the first two count.
            [cells.next().unwrap_or(outside), cells.next().unwrap_or(outside)]
        };
        let sides: Vec<[u32; 2]> = topology.ids().map(sides_of).collect();
        let depth = depths(&topology, &sides);
        let positions = nodes.positions();
        let center = |cell: &[u32; 8]| cell.iter().map(|&n| positions[n as usize]).sum::<Vec3>() / 8.0;
        Ok(Self {
            centers: cells.iter().map(center).collect(),
            cells: cells.to_vec(),
            faces: bytemuck::allocation::cast_vec(topology.nodes),
            sides,
            depth,
            nodes,
        })
    }

    /// Number of hexes.
    pub fn len(&self) -> usize {
        self.cells.len()
    }

    /// True if there is no hex.
    pub fn is_empty(&self) -> bool {
        self.cells.is_empty()
    }

    /// How many layers of cells can be peeled off before nothing is left.
    pub fn layers(&self) -> u16 {
        self.depth.iter().max().map_or(0, |&deepest| deepest + 1)
    }

    /// Layers of cells that lie over a cell.
    pub fn depth(&self, cell: usize) -> u16 {
        self.depth[cell]
    }

    /// The surface of what a cut leaves, and the cell behind each of its faces.
    pub fn surface(&self, cut: &Cut) -> (Surface, Vec<u32>) {
        let Shown { faces, cells, is_cap } = self.shown(cut);
        (self.nodes.with_quads(faces, is_cap), cells)
    }

    /// What a cut leaves. Steps 2 and 3.
    pub fn shown(&self, cut: &Cut) -> Shown {
        let is_shown = self.shown_cells(cut);
        let mut out = Shown::default();
        for (face, &[a, b]) in self.faces.iter().zip(&self.sides) {
            let (first, second) = (is_shown[a as usize], is_shown[b as usize]);
            if first == second {
                continue;
            }
            let [p, q, r, s] = *face;
            out.faces.push(if first { *face } else { [p, s, r, q] });
            out.cells.push(if first { a } else { b });
            out.is_cap.push(b as usize != self.cells.len());
        }
        out
    }

    /// Whether each cell is shown, and a last false for what is outside.
    fn shown_cells(&self, cut: &Cut) -> Vec<bool> {
        let everywhere = (Vec3::ZERO, 0.0);
        let (normal, offset) = cut.section.map_or(everywhere, |s| s.in_scene(self.nodes.frame()));
        let is_within = |(center, &depth): (&Vec3, &u16)| normal.dot(*center) <= offset && depth >= cut.peel;
        let mut is_shown: Vec<bool> = Vec::with_capacity(self.len() + 1);
        is_shown.extend(self.centers.iter().zip(&self.depth).map(is_within));
        if let Some(kept) = &cut.kept {
            is_shown.iter_mut().zip(kept).for_each(|(shown, kept)| *shown &= kept);
        }
        is_shown.push(false);
        is_shown
    }

    /// The nodes, as a surface without faces.
    pub fn nodes(&self) -> &Surface {
        &self.nodes
    }

    /// The nodes of a cell.
    pub fn cell(&self, cell: usize) -> &[u32; 8] {
        &self.cells[cell]
    }

    /// The middle of a cell, in scene coordinates.
    pub fn center(&self, cell: usize) -> Vec3 {
        self.centers[cell]
    }

    /// The box around a cell, in world coordinates.
    pub fn cell_bounds(&self, cell: usize) -> Aabb {
        self.nodes.bounds_of(&self.cells[cell])
    }
}

/// How many cells lie between each cell and the boundary: a walk inwards from the cells at the boundary.
fn depths(topology: &HexFaces, sides: &[[u32; 2]]) -> Vec<u16> {
    let outside = topology.of_hex.len();
    let mut depth = vec![u16::MAX; outside];
    let mut queue = VecDeque::new();
    let reach = |cell: u32, layer: u16, depth: &mut [u16], queue: &mut VecDeque<u32>| {
        if depth[cell as usize] > layer {
            depth[cell as usize] = layer;
            queue.push_back(cell);
        }
    };
    for &[a, b] in sides {
        if b as usize == outside {
            reach(a, 0, &mut depth, &mut queue);
        }
    }
    while let Some(cell) = queue.pop_front() {
        let next = depth[cell as usize].saturating_add(1);
        for face in topology.of_hex[cell as usize] {
            let [a, b] = sides[face.index()];
            let other = if a == cell { b } else { a };
            if other as usize != outside {
                reach(other, next, &mut depth, &mut queue);
            }
        }
    }
    depth
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;

    use glam::DVec3;

    use super::*;
    use crate::geometry::Point;
    use crate::mesh::{GridOptions, hex_grid};

    /// `n` unit cubes an axis.
    fn grid(n: u32) -> Hexes {
        let bounds = Aabb { min: Point::ZERO, max: Point::splat(f64::from(n)) };
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 1 << 20 };
        let mesh = hex_grid(bounds, &options).unwrap();
        Hexes::new(bytemuck::cast_slice(&mesh.positions), bytemuck::cast_slice(&mesh.hexes)).unwrap()
    }

    fn section(normal: DVec3, offset: f64) -> Cut {
        Cut { section: Section::new(normal, offset), ..Cut::default() }
    }

    /// The volume that the shown faces enclose, in world units, which tells also that all look outwards.
    fn volume(hexes: &Hexes, shown: &Shown) -> f64 {
        let frame = hexes.nodes().frame();
        let point = |n: u32| frame.world(hexes.nodes().positions()[n as usize].as_dvec3());
        let cone = |[a, b, c, d]: [u32; 4]| {
            let [a, b, c, d] = [a, b, c, d].map(point);
            (a.dot(b.cross(c)) + a.dot(c.cross(d))) / 6.0
        };
        shown.faces.iter().map(|&face| cone(face)).sum()
    }

    fn caps(shown: &Shown) -> usize {
        shown.is_cap.iter().filter(|&&cap| cap).count()
    }

    #[test]
    fn whole_cells_up_to_the_plane_are_shown_with_a_cap() {
        let hexes = grid(6);
        for (offset, layers) in [(-1.0, 0), (0.4, 0), (0.5, 1), (2.0, 2), (2.49, 2), (2.5, 3), (9.0, 6)] {
            for (normal, offset) in [(DVec3::Y, offset), (DVec3::NEG_Y, offset - 6.0)] {
                let shown = hexes.shown(&section(normal, offset));
                assert!(
                    (volume(&hexes, &shown) - 36.0 * f64::from(layers)).abs() < 1e-3,
                    "{normal} {offset}"
                );
                assert_eq!(caps(&shown), if (1..6).contains(&layers) { 36 } else { 0 });
            }
        }
    }

    /// Whatever is cut away, each edge of what is shown has as many faces one way as the other, and no face comes
    /// twice.
    #[test]
    fn what_is_shown_is_closed_and_each_face_comes_once() {
        let hexes = grid(5);
        let odd = (0..125).map(|c| c % 3 != 1).collect();
        let oblique = Section::new(DVec3::new(1.0, 0.7, 0.4), 5.3);
        for cut in [
            Cut::default(),
            Cut { section: oblique, ..Cut::default() },
            Cut { section: oblique, peel: 1, ..Cut::default() },
            Cut { section: oblique, peel: 0, kept: Some(odd) },
        ] {
            let shown = hexes.shown(&cut);
            assert!(!shown.faces.is_empty());
            let (mut around, mut seen) =
                (BTreeMap::<[u32; 2], i32>::new(), BTreeMap::<[u32; 4], usize>::new());
            for face in &shown.faces {
                for k in 0..4 {
                    let (a, b) = (face[k], face[(k + 1) % 4]);
                    *around.entry([a.min(b), a.max(b)]).or_default() += if a < b { 1 } else { -1 };
                }
                let mut nodes = *face;
                nodes.sort_unstable();
                *seen.entry(nodes).or_default() += 1;
            }
            assert!(around.values().all(|&balance| balance == 0));
            assert!(seen.values().all(|&times| times == 1));
        }
    }

    #[test]
    fn peeling_takes_layer_after_layer() {
        let hexes = grid(7);
        assert_eq!(hexes.layers(), 4);
        assert_eq!(hexes.depth(3 + 7 * (3 + 7 * 3)), 3);
        for (peel, side) in [(0, 7), (1, 5), (2, 3), (3, 1), (4, 0)] {
            let shown = hexes.shown(&Cut { peel, ..Cut::default() });
            assert_eq!(shown.faces.len(), 6 * side * side, "{peel}");
            assert_eq!(caps(&shown), if peel == 0 { 0 } else { shown.faces.len() });
        }
    }

    #[test]
    fn a_kept_cell_is_shown_alone_and_found_behind_its_faces() {
        let hexes = grid(4);
        let kept = (0..64).map(|cell| cell == 21).collect();
        let shown = hexes.shown(&Cut { kept: Some(kept), ..Cut::default() });
        assert_eq!(shown.cells, [21; 6]);
        assert!((volume(&hexes, &shown) - 1.0).abs() < 1e-4);
        let bounds = hexes.cell_bounds(21);
        assert!(
            bounds.min.distance(Point::ONE) < 1e-5 && bounds.max.distance(Point::splat(2.0)) < 1e-5,
            "{bounds:?}"
        );
    }

    /// A plane through the middles of a layer of cells takes all of them or none, wherever the mesh stands.
    #[test]
    fn a_plane_through_the_middles_of_a_layer_does_not_tear_it() {
        for (normal, far) in [(DVec3::X, 0.1), (DVec3::Z, 777.7), (DVec3::NEG_Y, -3e4)] {
            let mesh = grid(9);
            let frame = *mesh.nodes().frame();
            let moved: Vec<f64> = mesh
                .nodes()
                .positions()
                .iter()
                .flat_map(|p| (frame.world(p.as_dvec3()) / 7.0 + far).to_array())
                .collect();
            let hexes = Hexes::new(&moved, mesh.cells.as_flattened()).unwrap();
            let middle = normal.dot(Point::splat(4.5 / 7.0 + far));
            assert_eq!(caps(&hexes.shown(&section(normal, middle))), 81, "{normal} {far}");
        }
    }

    #[test]
    fn bad_arrays_are_refused() {
        let cube = &crate::mesh::numbering::hex::CORNERS.map(|c| c.map(f64::from));
        let cube = cube.as_flattened();
        let refused = |coordinates: &[f64], corners: &[u32]| Hexes::new(coordinates, corners).unwrap_err();
        assert_eq!(refused(cube, &[0, 1, 2, 3, 4, 5, 6]), SurfaceError::Hexes(7));
        assert_eq!(
            refused(cube, &[0, 1, 2, 3, 4, 5, 6, 8]),
            SurfaceError::Node { face: 0, node: 8, nodes: 8 }
        );
        assert_eq!(refused(&[f64::NAN; 3], &[]), SurfaceError::NotFinite(0));
        let none = Hexes::new(&[], &[]).unwrap();
        assert_eq!((none.len(), none.layers(), none.shown(&Cut::default())), (0, 0, Shown::default()));
    }
}
