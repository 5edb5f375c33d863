//! Groups the faces of a pillow's layer two by two, as the 2-refinement transition needs.
//!
//! Each face is to have one corner `f`, the middle of a group of four, between two corners `e`, and opposite to it a
//! corner `k`. Children of whole families have these roles from their octants. Any other layer is tried face by
//! face: the roles of one face's corners spread to its neighbours, and contradict each other or not (the 2x2
//! couplable condition of the paper on non-regular background meshes, section 4.3.2).

use super::pillow::{LayerHex, above};
use super::stage::{NO_OCTANT, StageMesh};
use crate::geometry::{Point, area_vector};
use crate::mesh::numbering::hex::apart;
use crate::mesh::{Edges, NodeId, QuadMesh};

/// How flat a group must be: the cosine of 30 degrees between the normals of faces side by side, that is a
/// dihedral angle of at least 150 degrees (theta_lower of the paper).
const FLAT: f64 = 0.866;

/// Which of the corners 0..4 of each hex of the layer is its `f`, by the octants of the refined hexes; none if one
/// of them is no child, or its face lies within its family.
pub(super) fn middles_of_families(layer: &[LayerHex], octant: &[u8]) -> Option<Vec<u8>> {
    let middle = |hex: &LayerHex| family_middle(octant[hex.face.refined as usize], hex.face.refined_face);
    layer.iter().map(middle).collect()
}

/// Which of the corners 0..4 of each hex of the layer is its `f`; or the refined hexes at faces that no group
/// can have, ascending.
///
/// How flat groups are is asked of the faces where the layer stands, in the mesh `before`.
pub(super) fn coupled_middles(before: &StageMesh, layer: &[LayerHex]) -> Result<Vec<u8>, Vec<u32>> {
    Sheet::new(before, layer).couple(layer)
}

/// The corner of a layer hex at the face node of the parent, if the refined child's face is part of a face of
/// its parent.
fn family_middle(octant: u8, refined_face: u8) -> Option<u8> {
    if octant == NO_OCTANT {
        return None;
    }
    // How many axes of its parent the child's corner divides: 0 at the parent's corner, 3 at the volume node.
    let role = |corner: u8| apart(octant.into(), corner.into());
    let corners = above(refined_face);
    let outside = corners.iter().all(|&corner| role(corner) < 3);
    (0..4).find(|&k| outside && role(corners[usize::from(k)]) == 2)
}

/// The layer seen as a sheet of quads: a node is a pair of a coarse and a refined copy.
struct Sheet {
    /// The quads, walked as corners 0..4 of their hexes.
    quads: Vec<[NodeId; 4]>,
    /// The normals of their faces before the layer was made, of length 1 or 0.
    normals: Vec<Point>,
    edges: Edges,
    /// The quads of each edge: two, or one and [`NONE`].
    of_edge: Vec<[u32; 2]>,
}

const NONE: u32 = u32::MAX;

impl Sheet {
    fn new(before: &StageMesh, layer: &[LayerHex]) -> Self {
        let columns = |hex: &LayerHex| [0, 1, 2, 3].map(|k| (hex.hex[k], hex.hex[k + 4]));
        let mut nodes: Vec<(NodeId, NodeId)> = layer.iter().flat_map(columns).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let number = |column| NodeId::new(nodes.binary_search(&column).expect("a column of the layer"));
        let normal = |hex: &LayerHex| {
            let nodes = before.hexes[hex.face.refined as usize];
            let corners =
                above(hex.face.refined_face).map(|k| before.positions[nodes[usize::from(k)].index()]);
            area_vector(&corners).normalize_or_zero()
        };
        let sheet = QuadMesh {
            positions: vec![Point::ZERO; nodes.len()],
            quads: layer.iter().map(|hex| columns(hex).map(number)).collect(),
        };
        let edges = Edges::of_quads(&sheet);
        let mut of_edge = vec![[NONE; 2]; edges.len()];
        for (corner, edge) in edges.of_corner.iter().enumerate() {
            let [first, second] = &mut of_edge[edge.index()];
            *(if *first == NONE { first } else { second }) = corner as u32 / 4;
        }
        Self { quads: sheet.quads, normals: layer.iter().map(normal).collect(), edges, of_edge }
    }

    /// The middles, component by component: of the four choices at its first quad the flattest that fits.
    fn couple(&self, layer: &[LayerHex]) -> Result<Vec<u8>, Vec<u32>> {
        let mut middles = vec![u8::MAX; layer.len()];
        let mut misfits = Vec::new();
        let mut component = Vec::new();
        for seed in 0..layer.len() {
            if middles[seed] != u8::MAX {
                continue;
            }
            let mut best: Option<(f64, u8)> = None;
            for middle in 0..4 {
                self.clear(&mut middles, &component);
                if let Some(fold) = self.spread(seed, middle, &mut middles, &mut component)
                    && best.is_none_or(|(flattest, _)| fold > flattest)
                {
                    best = Some((fold, middle));
                }
            }
            self.clear(&mut middles, &component);
            match best.filter(|&(flattest, _)| flattest >= FLAT) {
                Some((_, middle)) => {
                    self.spread(seed, middle, &mut middles, &mut component);
                }
                None => {
                    self.spread(seed, 0, &mut middles, &mut component);
                    component.iter().for_each(|&quad| middles[quad] = 0);
                    misfits.extend(component.iter().map(|&quad| layer[quad].face.refined));
                }
            }
            component.clear();
        }
        misfits.sort_unstable();
        misfits.dedup();
        if misfits.is_empty() { Ok(middles) } else { Err(misfits) }
    }

    fn clear(&self, middles: &mut [u8], component: &[usize]) {
        component.iter().for_each(|&quad| middles[quad] = u8::MAX);
    }

    /// Spreads the middle of a quad over its component, which is noted. Returns the least cosine between normals
    /// of quads side by side in a group, or none if the roles contradict each other or a group is not whole.
    fn spread(&self, seed: usize, middle: u8, middles: &mut [u8], component: &mut Vec<usize>) -> Option<f64> {
        component.clear();
        component.push(seed);
        middles[seed] = middle;
        let (mut next, mut fits, mut flattest) = (0, true, 1.0f64);
        while let Some(&quad) = component.get(next) {
            next += 1;
            for side in 0..4 {
                let [a, b] = self.of_edge[self.edges.of_corner[4 * quad + side].index()];
                let other = if a as usize == quad { b } else { a } as usize;
                // An edge with `f` at one end lies within a group.
                let within = [side as u8, (side as u8 + 1) % 4].contains(&middles[quad]);
                if other == NONE as usize {
                    fits &= !within;
                    continue;
                }
                let there = self.neighbour_middle(quad, side, middles[quad], other);
                if middles[other] == u8::MAX {
                    middles[other] = there;
                    component.push(other);
                }
                fits &= middles[other] == there;
                if within {
                    flattest = flattest.min(self.normals[quad].dot(self.normals[other]));
                }
            }
        }
        let whole = || component.iter().all(|&quad| self.has_four(quad, middles));
        (fits && whole()).then_some(flattest)
    }

    /// The middle of the quad across a side, as this quad's `middle` wants it: the same node if the side has it, else
    /// the node opposite to the `k` that both share.
    fn neighbour_middle(&self, quad: usize, side: usize, middle: u8, other: usize) -> u8 {
        let nodes = self.quads[quad];
        let ends = [nodes[side], nodes[(side + 1) % 4]];
        let opposite = nodes[(usize::from(middle) + 2) % 4];
        let there = |node: NodeId| self.quads[other].iter().position(|&n| n == node);
        let f = nodes[usize::from(middle)];
        let place = if ends.contains(&f) { there(f) } else { there(opposite).map(|k| (k + 2) % 4) };
        place.expect("two quads at an edge share its nodes") as u8
    }

    /// Is the `f` of a quad that of four quads around it? Walks from quad to quad around the node.
    fn has_four(&self, quad: usize, middles: &[u8]) -> bool {
        let f = self.quads[quad][usize::from(middles[quad])];
        let (mut at, mut steps) = (quad, 0);
        loop {
            let corner = self.quads[at].iter().position(|&n| n == f).expect("the walk stays at the node");
            let [a, b] = self.of_edge[self.edges.of_corner[4 * at + corner].index()];
            let next = if a as usize == at { b } else { a };
            steps += 1;
            if next == NONE || steps > 4 {
                return false;
            }
            at = next as usize;
            if at == quad {
                return steps == 4;
            }
        }
    }
}
