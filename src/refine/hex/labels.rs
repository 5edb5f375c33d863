//! Labels of boundary faces: which group of the input's boundary each belongs to, carried from stage to stage.
//!
//! What a new boundary face is labelled follows from what it divides, never from where it is: a face of a hex that
//! stays keeps its label, a face of a template's cell has that of the face it lies in. A pillow makes new boundary
//! faces, at edges of the interface on the boundary: the side that leaves the old nodes makes room for one on its own
//! boundary face, and gives it that face's label. Where labels change the boundary has a ridge (`shift`), so that one
//! side stays there and no new face lies in two groups.

use super::divide::Divided;
use super::pillow::LayerHex;
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::FACES;
use crate::mesh::topology::{Side, side_nodes};

/// A boundary face with its label.
pub(super) type Label = (Side, u32);

/// A boundary face without one, where one is asked for.
pub(super) const NO_LABEL: u32 = u32::MAX;

/// The label of a side.
pub(super) fn label_of(labels: &[Label], side: Side) -> u32 {
    labels.binary_search_by_key(&side, |&(side, _)| side).map_or(NO_LABEL, |k| labels[k].1)
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

/// The labels of a pillow's layer. `hexes` have their copies of the nodes, of which there were `node_count` before.
pub(super) fn of_layer(
    labels: &[Label],
    hexes: &[[NodeId; 8]],
    layer: &[LayerHex],
    node_count: usize,
) -> Vec<Label> {
    if labels.is_empty() {
        return Vec::new();
    }
    let rims = Rims::of(labels, hexes);
    let is_old = |edge: [NodeId; 2]| edge.iter().all(|n| n.index() < node_count);
    let mut walls: Vec<([NodeId; 4], Label)> = Vec::new();
    for (k, hex) in layer.iter().enumerate() {
        for face in SIDES {
            let (coarse, refined) = ends(&hex.hex, face);
            let [of_coarse, of_refined] = [coarse, refined].map(|edge| rims.label(edge));
            if of_coarse == NO_LABEL && of_refined == NO_LABEL {
                continue;
            }
            let coarse_stays = is_old(coarse) && !is_old(refined);
            let label = if coarse_stays { of_refined } else { of_coarse };
            let mut nodes = [coarse[0], coarse[1], refined[0], refined[1]];
            nodes.sort_unstable();
            walls.push((nodes, (6 * k as Side + Side::from(face), label)));
        }
    }
    walls.sort_unstable();
    // A wall between two hexes of the layer is no boundary face.
    let alone = walls.chunk_by(|a, b| a.0 == b.0).filter(|same| same.len() == 1);
    let labelled = alone.map(|same| same[0].1).filter(|&(_, label)| label != NO_LABEL);
    let mut found: Vec<Label> = labelled.collect();
    found.sort_unstable();
    found
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

/// The edges of labelled faces, with their labels.
struct Rims(Vec<([NodeId; 2], u32)>);

impl Rims {
    fn of(labels: &[Label], hexes: &[[NodeId; 8]]) -> Self {
        let around = |&(side, label): &Label| {
            let nodes = side_nodes(hexes, side);
            [0, 1, 2, 3].map(|k| (ascending([nodes[k], nodes[(k + 1) % 4]]), label))
        };
        let mut edges: Vec<([NodeId; 2], u32)> = labels.iter().flat_map(around).collect();
        edges.sort_unstable();
        Self(edges)
    }

    /// The label of a boundary face at an edge. There is one such face where the edge is part of the interface on the
    /// boundary, the other one there being the layer's.
    fn label(&self, edge: [NodeId; 2]) -> u32 {
        let edge = ascending(edge);
        self.0.binary_search_by_key(&edge, |&(edge, _)| edge).map_or(NO_LABEL, |k| self.0[k].1)
    }
}

fn ascending([a, b]: [NodeId; 2]) -> [NodeId; 2] {
    [a.min(b), a.max(b)]
}
