//! The sheets, collars and wedges of a mesh in the order in which they were inserted, what each is for, and which of them
//! are to be left out.
//!
//! New nodes are copies of others. Which node of the core one comes from in the end does not depend on what else was
//! inserted: by it a collar is known again when all is inserted anew.

use super::super::correspondence::Correspondence;
use super::shrink::Layer;
use crate::mesh::topology::Sets;
use crate::mesh::{HexMesh, NodeId};
use crate::solid::CurveId;

/// So often layers are left out one by one; then only sheets are inserted.
const ROUNDS: usize = 8;

/// What a layer is for.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) enum Purpose {
    /// A sheet over a group of surfaces.
    Sheet(u32),
    /// A collar around quads that would be flat at these nodes of the core.
    Collar(Vec<NodeId>),
    /// A wedge at a curve.
    Wedge(CurveId),
}

/// The layers, and what none is inserted for.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Layers {
    layers: Vec<(Layer, Purpose)>,
    left_out: LeftOut,
}

/// What no layer is inserted for: its cells could not be pushed open.
#[derive(Clone, Debug, Default, PartialEq)]
struct LeftOut {
    groups: Vec<u32>,
    corners: Vec<NodeId>,
    curves: Vec<CurveId>,
    /// How often more was left out.
    rounds: usize,
}

impl Layers {
    pub(super) fn len(&self) -> usize {
        self.layers.len()
    }

    pub(super) fn push(&mut self, layer: Layer, purpose: Purpose) {
        self.layers.push((layer, purpose));
    }

    /// The last layer, which is none any more.
    pub(super) fn pop(&mut self) -> Option<Layer> {
        self.layers.pop().map(|(layer, _)| layer)
    }

    /// Takes all layers back at once.
    pub(super) fn take_all_back(&mut self, mesh: &mut HexMesh, on: &mut Correspondence) {
        if let Some((first, _)) = self.layers.first() {
            first.take_back_to(mesh, on, |n| self.core_node(n));
        }
        self.layers.clear();
    }

    pub(super) fn count(&self, is: impl Fn(&Purpose) -> bool) -> usize {
        self.layers.iter().filter(|(_, purpose)| is(purpose)).count()
    }

    /// Is the layer a sheet over a group of surfaces?
    pub(super) fn is_sheet(&self, layer: usize) -> bool {
        matches!(self.layers[layer].1, Purpose::Sheet(_))
    }

    /// The node of the core that a node is a copy of, or a copy of a copy; itself if it is of the core.
    pub(super) fn core_node(&self, mut node: NodeId) -> NodeId {
        loop {
            let count = self.layers.partition_point(|(layer, _)| layer.first_node <= node);
            let Some((layer, _)) = count.checked_sub(1).map(|last| &self.layers[last]) else { return node };
            node = layer.origin(node);
        }
    }

    pub(super) fn takes_sheet(&self, group: u32) -> bool {
        !self.left_out.groups.contains(&group)
    }

    pub(super) fn takes_collar(&self, at: NodeId) -> bool {
        self.left_out.rounds <= ROUNDS && !self.left_out.corners.contains(&self.core_node(at))
    }

    pub(super) fn takes_wedge(&self, curve: CurveId) -> bool {
        self.left_out.rounds <= ROUNDS && !self.left_out.curves.contains(&curve)
    }

    /// From now on no layer is inserted for what these layers are for.
    pub(super) fn leave_out(&mut self, layers: &[usize]) {
        self.left_out.rounds += 1;
        for &layer in layers {
            match &self.layers[layer].1 {
                Purpose::Sheet(group) => self.left_out.groups.push(*group),
                Purpose::Collar(corners) => self.left_out.corners.extend(corners),
                Purpose::Wedge(curve) => self.left_out.curves.push(*curve),
            }
        }
    }

    /// Parts the `hexes` by whether they touch, each with its culprit: the last layer that has hexes or nodes among them,
    /// or else among those that are nearest to them. Nothing if there are no layers.
    pub(super) fn culprits(&self, mesh: &HexMesh, hexes: &[u32]) -> Vec<(usize, Vec<u32>)> {
        let parts = if self.layers.is_empty() { Vec::new() } else { touching(mesh, hexes) };
        parts.into_iter().map(|part| (self.last_near(mesh, &part), part)).collect()
    }

    /// The last layer that has a part in the hexes, or in as few rings around them as may be; the last of all if none has.
    fn last_near(&self, mesh: &HexMesh, hexes: &[u32]) -> usize {
        let mut hexes = hexes.to_vec();
        loop {
            if let Some(layer) = self.last_with(mesh, &hexes) {
                return layer;
            }
            let mut nodes: Vec<NodeId> = hexes.iter().flat_map(|&h| mesh.hexes[h as usize]).collect();
            nodes.sort_unstable();
            nodes.dedup();
            let is_near = |h: &u32| mesh.hexes[*h as usize].iter().any(|n| nodes.binary_search(n).is_ok());
            let more: Vec<u32> = (0..mesh.hexes.len() as u32).filter(is_near).collect();
            if more.len() == hexes.len() {
                return self.layers.len() - 1;
            }
            hexes = more;
        }
    }

    /// The last layer that has a part in the hexes by its hexes or nodes.
    fn last_with(&self, mesh: &HexMesh, hexes: &[u32]) -> Option<usize> {
        let node = hexes.iter().flat_map(|&h| mesh.hexes[h as usize]).max()?;
        let hex = hexes.iter().copied().max()?;
        self.layers.iter().rposition(|(layer, _)| layer.first_hex <= hex || layer.first_node <= node)
    }
}

/// The hexes in parts that share no node, each ascending.
fn touching(mesh: &HexMesh, hexes: &[u32]) -> Vec<Vec<u32>> {
    let mut at: Vec<(NodeId, u32)> =
        (0u32..).zip(hexes).flat_map(|(i, &h)| mesh.hexes[h as usize].map(|n| (n, i))).collect();
    at.sort_unstable();
    let mut sets = Sets::new(hexes.len());
    for pair in at.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        sets.join(pair[0].1, pair[1].1, false);
    }
    let mut by_root: Vec<(u32, u32)> = (0u32..).zip(hexes).map(|(i, &h)| (sets.root(i).0, h)).collect();
    by_root.sort_unstable();
    by_root.chunk_by(|a, b| a.0 == b.0).map(|part| part.iter().map(|&(_, h)| h).collect()).collect()
}
