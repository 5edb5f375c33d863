//! Labels of faces: which group of the input's faces each belongs to, carried from stage to stage.
//!
//! What a new face is labelled follows from what it divides, never from where it is: a face of a hex that stays keeps its
//! label, a face of a template's cell has that of the face it lies in. A face between two hexes has its label from both
//! sides, each inherited by itself; the labels tell which side the group has. Where that changes within a group there is
//! no border that would be kept.
//!
//! A pillow makes new boundary faces, at edges of the interface on the boundary: the side that leaves the old nodes makes
//! room for one on its own boundary face, and gives it that face's label. Where labels change the boundary has a ridge
//! (`shift`), so that one side stays there and no new face lies in two groups. Between materials it is the same, labelled
//! faces between hexes being between materials (`sheets`); and where such a face is one between refined and coarse hexes
//! too, the layer's hex upon it takes the label of the side in whose place it is.

use std::borrow::Cow;

use super::divide::Divided;
use super::pillow::LayerHex;
use crate::mesh::numbering::hex::FACES;
use crate::mesh::topology::{FaceSides, Side, side_nodes};
use crate::mesh::{HexMesh, NodeId};

/// A side with its label: the number of its group, with [`INNER`] between hexes and [`BACK`] on the side there that the
/// group does not have.
pub(super) type Label = (Side, u32);

/// A side without one, where one is asked for.
pub(super) const NO_LABEL: u32 = u32::MAX;

/// Marks the labels of faces between hexes.
pub(super) const INNER: u32 = 1 << 30;

/// Marks, of the two labels of such a face, the one on the side that its group does not have.
const BACK: u32 = 1 << 31;

/// The labels of a mesh by its groups, ascending.
pub(super) fn of_mesh(mesh: &HexMesh) -> Vec<Label> {
    let HexMesh { positions, hexes, groups, .. } = mesh;
    let face = |side| side_nodes(hexes, side);
    let known = FaceSides::find(hexes, positions.len(), groups.sides().iter().map(|&side| face(side)));
    let mut labels = Vec::with_capacity(groups.sides().len());
    for (side, group) in groups.labels() {
        match *known.of(face(side)) {
            [a, b] => {
                let other = if side == a { b } else { a };
                labels.extend([(side, group | INNER), (other, group | INNER | BACK)]);
            }
            _ => labels.push((side, group)),
        }
    }
    labels.sort_unstable();
    labels
}

/// The group's number in a label, whichever side has it; [`NO_LABEL`] of none.
pub(super) fn group_of(label: u32) -> u32 {
    if label == NO_LABEL { NO_LABEL } else { label & !(INNER | BACK) }
}

/// The sides that groups have, with the groups' numbers.
pub(super) fn of_groups(labels: &[Label]) -> impl Iterator<Item = Label> + '_ {
    labels.iter().filter(|&&(_, label)| label & BACK == 0).map(|&(side, label)| (side, group_of(label)))
}

/// The label of a side.
pub(super) fn label_of(labels: &[Label], side: Side) -> u32 {
    labels.binary_search_by_key(&side, |&(side, _)| side).map_or(NO_LABEL, |k| labels[k].1)
}

/// The labels but those of some sides, which ascend.
pub(super) fn without<'a>(labels: &'a [Label], sides: &[Side]) -> Cow<'a, [Label]> {
    if sides.is_empty() {
        return Cow::Borrowed(labels);
    }
    Cow::Owned(labels.iter().filter(|(side, _)| sides.binary_search(side).is_err()).copied().collect())
}

/// The labels of the given hexes alone, ascending, numbered by their places among these.
pub(super) fn of_some(labels: &[Label], hexes: &[u32]) -> Vec<Label> {
    let of_hex = |&(side, label): &Label| {
        let place = hexes.binary_search(&(side / 6)).ok()?;
        Some((6 * place as Side + side % 6, label))
    };
    labels.iter().filter_map(of_hex).collect()
}

/// The labels of one hex, numbered as if it were the first.
pub(super) fn of_one(labels: &[Label], hex: u32) -> impl Iterator<Item = Label> + '_ {
    let first = labels.partition_point(|&(side, _)| side < 6 * hex);
    let of_hex = labels[first..].iter().take_while(move |&&(side, _)| side / 6 == hex);
    of_hex.map(|&(side, label)| (side % 6, label))
}

/// The labels with `count` more hexes before them.
pub(super) fn after(count: usize, labels: impl IntoIterator<Item = Label>) -> impl Iterator<Item = Label> {
    labels.into_iter().map(move |(side, label)| (side + 6 * count as Side, label))
}

/// The labels of the cells of divided hexes, ascending: those of hex `k` are numbered from `cells_of[k]`.
pub(super) fn of_cells(labels: &[Label], divided: &[Divided], cells_of: &[u32]) -> Vec<Label> {
    let of_cell = |&(side, label): &Label| {
        let (k, face) = (side as usize / 6, (side % 6) as u8);
        let Divided { template, symmetry, .. } = divided[k];
        template
            .faces_on(symmetry, face)
            .map(move |(cell, face)| (6 * (cells_of[k] + cell as u32) + u32::from(face), label))
    };
    let mut found: Vec<Label> = labels.iter().flat_map(of_cell).collect();
    found.sort_unstable();
    found
}

/// A pillow and what it was made of, as its labels follow from them.
pub(super) struct Labelled<'a> {
    /// The labels before.
    pub(super) labels: &'a [Label],
    /// The hexes with the nodes that they had, and with their copies.
    pub(super) before: &'a [[NodeId; 8]],
    pub(super) hexes: &'a [[NodeId; 8]],
    pub(super) layer: &'a [LayerHex],
    /// How many nodes there were.
    pub(super) node_count: usize,
}

impl Labelled<'_> {
    /// The labels of the layer, and the sides before whose labels the layer has now; both ascending. `material` is that of
    /// a hex before.
    pub(super) fn of_layer(&self, material: impl Fn(u32) -> u32) -> (Vec<Label>, Vec<Side>) {
        let (mut found, mut moved) = (Vec::new(), Vec::new());
        if self.labels.is_empty() {
            return (found, moved);
        }
        for (hex, k) in self.layer.iter().zip(0..) {
            let (side, face) = hex.replaced();
            let label = label_of(self.labels, side);
            if label != NO_LABEL {
                moved.push(side);
                found.push((6 * k + face, label));
            }
        }
        moved.sort_unstable();
        self.label_walls(material, &mut found);
        found.sort_unstable();
        (found, moved)
    }

    /// Labels the faces between the coarse and the refined side.
    fn label_walls(&self, material: impl Fn(u32) -> u32, found: &mut Vec<Label>) {
        let rims = Rims::of(self, &material);
        // Each with its nodes, ascending.
        let mut walls: Vec<([NodeId; 4], Label)> = Vec::new();
        for (hex, k) in self.layer.iter().zip(0..) {
            for face in SIDES {
                let (coarse, refined) = ends(&hex.hex, face);
                if rims.are_at(coarse) || rims.are_at(refined) {
                    let mut nodes = [coarse[0], coarse[1], refined[0], refined[1]];
                    nodes.sort_unstable();
                    walls.push((nodes, (6 * k + Side::from(face), NO_LABEL)));
                }
            }
        }
        walls.sort_unstable();
        let of_side = |side: Side| material(self.layer[side as usize / 6].within);
        for same in walls.chunk_by(|a, b| a.0 == b.0) {
            let leaves = self.edge_that_leaves(same[0].1.0);
            match *same {
                [(_, (side, _))] => found.extend(rims.boundary(leaves).map(|label| (side, label))),
                [(_, (a, _)), (_, (b, _))] => {
                    for (side, other) in [(a, b), (b, a)] {
                        let label = rims.between(leaves, [of_side(side), of_side(other)]);
                        found.extend(label.map(|label| (side, label)));
                    }
                }
                _ => {}
            }
        }
    }

    /// The edge, of a face of a layer hex, of the side that leaves the old nodes.
    fn edge_that_leaves(&self, side: Side) -> [NodeId; 2] {
        let is_old = |edge: [NodeId; 2]| edge.iter().all(|n| n.index() < self.node_count);
        let (coarse, refined) = ends(&self.layer[side as usize / 6].hex, (side % 6) as u8);
        if is_old(coarse) && !is_old(refined) { refined } else { coarse }
    }
}

/// The faces of a layer hex between its coarse one, below, and its refined one, above.
const SIDES: [u8; 4] = [2, 3, 4, 5];

/// The edges of such a face that the coarse hex and the refined one have.
fn ends(hex: &[NodeId; 8], face: u8) -> ([NodeId; 2], [NodeId; 2]) {
    let corners = FACES[usize::from(face)];
    let below = |wanted: bool| {
        let mut found = corners.into_iter().filter(move |&k| (k < 4) == wanted);
        [found.next(), found.next()].map(|k| hex[usize::from(k.expect("two corners below, two above"))])
    };
    (below(true), below(false))
}

/// What a labelled face's own material is, and the one beyond it.
type Materials = [u32; 2];

/// On the boundary there is none beyond.
const OUTSIDE: u32 = u32::MAX;

/// The edges of labelled faces, with the materials and the labels of these.
struct Rims(Vec<([NodeId; 2], Materials, u32)>);

impl Rims {
    fn of(pillow: &Labelled, material: &impl Fn(u32) -> u32) -> Self {
        let Labelled { labels, before, hexes, layer, .. } = *pillow;
        let mut edges: Vec<([NodeId; 2], Materials, u32)> = Vec::new();
        let mut add = |side: Side, materials: Materials, label: u32| {
            let nodes = side_nodes(hexes, side);
            edges.extend((0..4).map(|k| (ascending([nodes[k], nodes[(k + 1) % 4]]), materials, label)));
        };
        let mut inner: Vec<([NodeId; 4], Label)> = Vec::new();
        for &(side, label) in labels {
            if label & INNER == 0 {
                add(side, [0, OUTSIDE], label);
            } else {
                let mut nodes = side_nodes(before, side);
                nodes.sort_unstable();
                inner.push((nodes, (side, label)));
            }
        }
        inner.sort_unstable();
        // No wall goes on from a face that the layer stands on.
        let mut below: Vec<Side> = Vec::new();
        if !inner.is_empty() {
            below.extend(layer.iter().flat_map(|hex| [hex.face.refined_side(), hex.face.coarse_side()]));
            below.sort_unstable();
        }
        for same in inner.chunk_by(|a, b| a.0 == b.0) {
            if let &[(_, a), (_, b)] = same
                && below.binary_search(&a.0).is_err()
            {
                for ((side, label), (other, _)) in [(a, b), (b, a)] {
                    add(side, [material(side / 6), material(other / 6)], label);
                }
            }
        }
        edges.sort_unstable();
        edges.dedup();
        Self(edges)
    }

    fn at(&self, edge: [NodeId; 2]) -> impl Iterator<Item = &([NodeId; 2], Materials, u32)> {
        let edge = ascending(edge);
        let first = self.0.partition_point(|&(other, ..)| other < edge);
        self.0[first..].iter().take_while(move |&&(other, ..)| other == edge)
    }

    /// Has a labelled face the edge?
    fn are_at(&self, edge: [NodeId; 2]) -> bool {
        self.at(edge).next().is_some()
    }

    /// The label of a boundary face at an edge. There is one such face where the edge is part of the interface on the
    /// boundary, the other one there being the layer's.
    fn boundary(&self, edge: [NodeId; 2]) -> Option<u32> {
        self.at(edge).find(|(_, materials, _)| materials[1] == OUTSIDE).map(|&(.., label)| label)
    }

    /// The label, on the side of the first of two materials, of the face between them at an edge.
    fn between(&self, edge: [NodeId; 2], materials: Materials) -> Option<u32> {
        self.at(edge).find(|&&(_, other, _)| other == materials).map(|&(.., label)| label)
    }
}

fn ascending([a, b]: [NodeId; 2]) -> [NodeId; 2] {
    [a.min(b), a.max(b)]
}
