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
//! 1. The quads of flat corners on one side of a curve that touch each other draw back together, and with them the quads
//!    around a node of the curve that has more than two there: it is left with two. Those across the curve are for
//!    themselves: drawn back together, the curve would turn off between them, and be flat there.
//! 2. Where such a set is no manifold, the quads between its members join it, a few times; then it is given up.
//! 3. A pillow can make corners flat at a curve that it crosses: all is done again, a few times.

use super::super::correspondence::Correspondence;
use super::boundary::Boundary;
use super::groups::Groups;
use super::layers::{Layers, Purpose};
use super::need::{FlatCorner, Look};
use super::shrink::{Layer, ShrinkSet, Torn, pillow};
use super::sides::Sides;
use crate::mesh::topology::Sets;
use crate::mesh::{HexMesh, NodeId};
use crate::{Cancelled, Monitor};

/// How often the quads around torn nodes join a set.
const GROWTHS: usize = 3;

/// How often flat corners are looked for.
const ROUNDS: usize = 4;

/// Pillows the hexes of all flat corners that the `layers` take collars at.
pub(super) fn insert(
    mesh: &mut HexMesh,
    on: &mut Correspondence,
    boundary: &mut Boundary,
    groups: &Groups,
    layers: &mut Layers,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    for _ in 0..ROUNDS {
        let mut corners = Look::new(mesh, on, boundary, groups).flat_corners();
        corners.retain(|corner| layers.takes_collar(corner.node));
        let before = layers.len();
        for Crowd { quads, corners } in touching(&Sides::of(on, boundary), &corners) {
            monitor.proceed()?;
            let corners = corners.into_iter().map(|node| layers.core_node(node)).collect();
            if let Some(layer) = pillow_grown(mesh, on, boundary, quads) {
                layers.push(layer, Purpose::Collar(corners));
            }
        }
        if layers.len() == before {
            break;
        }
    }
    Ok(())
}

/// What draws back together: quads, and the nodes at which some of them would be flat.
struct Crowd {
    /// Ascending.
    quads: Vec<u32>,
    corners: Vec<NodeId>,
}

/// Pillows the hexes of the quads, with those that are needed to make the set a manifold.
fn pillow_grown(
    mesh: &mut HexMesh,
    on: &mut Correspondence,
    boundary: &mut Boundary,
    mut quads: Vec<u32>,
) -> Option<Layer> {
    for _ in 0..=GROWTHS {
        let hexes = boundary.hexes(quads.iter().copied());
        match pillow(mesh, on, boundary, &ShrinkSet::Hexes { hexes: &hexes, covered: &[] }) {
            Ok(layer) => return Some(layer),
            Err(Torn(nodes)) => {
                let sides = Sides::of(on, boundary);
                let is_torn = |n: &NodeId| nodes.binary_search(n).is_ok();
                let more: Vec<u32> = quads
                    .iter()
                    .flat_map(|&q| boundary.quads[q as usize].map(|n| (q, n)))
                    .filter(|(_, n)| is_torn(n))
                    .flat_map(|(q, n)| sides.around(q, n))
                    .collect();
                let before = quads.len();
                quads.extend(more);
                quads.sort_unstable();
                quads.dedup();
                if quads.len() == before {
                    return None;
                }
            }
        }
    }
    None
}

/// The quads of the corners, in sets that share nodes on one side of the curves.
fn touching(sides: &Sides, corners: &[FlatCorner]) -> Vec<Crowd> {
    let mut quads: Vec<u32> = corners.iter().flat_map(|corner| sides.crowded(corner.quad)).collect();
    quads.sort_unstable();
    quads.dedup();
    let mut sets = Sets::new(quads.len());
    for (i, &q) in (0u32..).zip(&quads) {
        for near in sides.boundary.quads[q as usize].iter().flat_map(|&n| sides.around(q, n)) {
            if let Ok(other) = quads.binary_search(&near) {
                sets.join(i, other as u32, false);
            }
        }
    }
    let mut by_root: Vec<(u32, u32)> = (0u32..).zip(quads).map(|(i, q)| (sets.root(i).0, q)).collect();
    by_root.sort_unstable();
    let crowd = |set: &[(u32, u32)]| {
        let quads: Vec<u32> = set.iter().map(|&(_, q)| q).collect();
        let corners = corners.iter().filter(|corner| quads.binary_search(&corner.quad).is_ok());
        Crowd { corners: corners.map(|corner| corner.node).collect(), quads }
    };
    by_root.chunk_by(|a, b| a.0 == b.0).map(crowd).collect()
}
