//! Collars: pillows around single hexes whose boundary quad would be flat at a smooth curve, where no sheet can help
//! since it would lie on both sides of the curve.
//!
//! ```text
//!   seen on the surface, the curve a-v-b below:
//!
//!   *---x---*        *---x---*
//!   |  / \  |        |  /|\  |      the quad a-v-b-x has a right angle at v on paper and a straight one on the solid;
//!   | / q \ |   is   | / x'\ |      after the pillow two quads meet at v
//!   |/     \|        |/a' b'\|
//!   a---v---b        a---v---b
//! ```
//!
//! 1. The hexes of flat corners that touch each other draw back together.
//! 2. Where such a set is no manifold, the hexes between its members join it, a few times; then it is given up.

use super::super::correspondence::Correspondence;
use super::boundary::Boundary;
use super::groups::Groups;
use super::need::Look;
use super::shrink::{Layer, ShrinkSet, Torn, pillow};
use crate::mesh::topology::Sets;
use crate::mesh::{HexMesh, NodeId};

/// How often the hexes around torn nodes join a set.
const GROWTHS: usize = 3;

/// What came of the flat corners.
#[derive(Default)]
pub(super) struct Collars {
    pub(super) layers: Vec<Layer>,
    /// Nodes at which corners stay flat.
    pub(super) flat: Vec<NodeId>,
}

/// Pillows the hexes of all flat corners.
pub(super) fn insert(
    mesh: &mut HexMesh,
    on: &mut Correspondence,
    boundary: &mut Boundary,
    groups: &Groups,
) -> Collars {
    let corners = Look::new(mesh, on, boundary, groups).flat_corners();
    let hexes: Vec<(u32, NodeId)> =
        corners.iter().map(|corner| (boundary.hex(corner.quad) as u32, corner.node)).collect();
    let mut done = Collars::default();
    for set in touching(mesh, hexes) {
        let nodes: Vec<NodeId> = set.iter().map(|&(_, node)| node).collect();
        let mut hexes: Vec<u32> = set.iter().map(|&(hex, _)| hex).collect();
        hexes.dedup();
        match pillow_grown(mesh, on, boundary, hexes) {
            Some(layer) => done.layers.push(layer),
            None => done.flat.extend(nodes),
        }
    }
    done.flat.sort_unstable();
    done.flat.dedup();
    done
}

/// Pillows the hexes, with those that are needed to make the set a manifold.
fn pillow_grown(
    mesh: &mut HexMesh,
    on: &mut Correspondence,
    boundary: &mut Boundary,
    mut hexes: Vec<u32>,
) -> Option<Layer> {
    for _ in 0..=GROWTHS {
        match pillow(mesh, on, boundary, &ShrinkSet::Hexes(&hexes)) {
            Ok(layer) => return Some(layer),
            Err(Torn(nodes)) => {
                let surfaces: Vec<_> = (0..boundary.quads.len())
                    .filter(|&q| hexes.binary_search(&(boundary.hex(q as u32) as u32)).is_ok())
                    .map(|q| boundary.surface[q])
                    .collect();
                let more = (0..boundary.quads.len()).filter(|&q| {
                    surfaces.contains(&boundary.surface[q])
                        && boundary.quads[q].iter().any(|n| nodes.binary_search(n).is_ok())
                });
                hexes.extend(more.map(|q| boundary.hex(q as u32) as u32));
                hexes.sort_unstable();
                hexes.dedup();
            }
        }
    }
    None
}

/// The hexes, with a node each, in sets that share nodes; each set in the order of hexes.
fn touching(mesh: &HexMesh, mut hexes: Vec<(u32, NodeId)>) -> Vec<Vec<(u32, NodeId)>> {
    hexes.sort_unstable();
    let mut at_node: Vec<(NodeId, u32)> = Vec::new();
    for (i, &(hex, _)) in (0u32..).zip(&hexes) {
        at_node.extend(mesh.hexes[hex as usize].map(|n| (n, i)));
    }
    at_node.sort_unstable();
    let mut sets = Sets::new(hexes.len());
    for pair in at_node.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        sets.join(pair[0].1, pair[1].1, false);
    }
    let mut by_root: Vec<(u32, (u32, NodeId))> =
        (0u32..).zip(hexes).map(|(i, hex)| (sets.root(i).0, hex)).collect();
    by_root.sort_unstable();
    by_root.chunk_by(|a, b| a.0 == b.0).map(|set| set.iter().map(|&(_, hex)| hex).collect()).collect()
}
