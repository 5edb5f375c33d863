//! Pillowing: a layer of one hex at each face of the interface separates the refined hexes from the coarse ones
//! (Ebeida et al., section 3.2).
//!
//! ```text
//!   R | R | R          R | R | R      refined copies of the nodes
//!   --*---*--   is     --*---*--
//!   C | C | C            |   |        the layer
//!                      --*---*--
//!                      C | C | C      coarse copies
//! ```
//!
//! 1. Find the pinched edges and decide which side each joins (`pinch`).
//! 2. Decide which side keeps the faces between materials (`materials`).
//! 3. Around each node of the interface find the regions (`regions`). One of them keeps the node, every other
//!    gets a copy, moved into the region (`shift`). Where that would fold the layer (`folds`), more must be refined.
//! 4. Give the hexes their copies, and make a hex at each face of the interface.
//!
//! Copies of nodes on the boundary stay on it, unless nobody keeps it
//! ([`StageMesh::has_free_boundary`](super::stage::StageMesh::has_free_boundary)): then they move into their regions like any
//! others, and nothing more has to be refined for the boundary's sake.
//!
//! **Departure from the paper.** It shifts each node by half its shortest edge along the mean normal of the faces,
//! which inverts hexes at concave corners; here it is [`THICKNESS`] of the shortest edge, towards the region.

use super::blocks::{BLOCK, offsets};
use super::interface::{Interface, InterfaceFace, Star};
use super::materials::kept_by_coarse;
use super::pinch::{Pinches, add_coarse};
use super::regions::Regions;
use super::ridges::Ridges;
use super::shift::{Beside, Shifts};
use super::stage::StageError;
use crate::geometry::Point;
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::FACES;
use crate::mesh::topology::Side;
use crate::parallel;
use crate::{Monitor, Stage};

/// The stage that this file reports.
const PILLOW: Stage = Stage("pillow");

/// How far a copy is moved, as a part of its node's shortest edge.
pub(super) const THICKNESS: f64 = 0.35;

/// A pillowed mesh. All of its hexes but the layer's keep their places.
pub(super) struct Pillow {
    /// The old nodes, then the copies.
    pub(super) positions: Vec<Point>,
    /// The hexes, with their copies of the nodes.
    pub(super) hexes: Vec<[NodeId; 8]>,
    /// The layer: a hex at each face of the interface.
    pub(super) layer: Vec<LayerHex>,
    /// Number of pinched edges.
    pub(super) pinched_edges: usize,
}

/// A hex of the layer.
#[derive(Clone, Copy)]
pub(super) struct LayerHex {
    /// Its nodes; below (corners 0 to 3) the coarse hex, above (4 to 7) the refined one.
    pub(super) hex: [NodeId; 8],
    /// The face at which it stands.
    pub(super) face: InterfaceFace,
    /// The hex in whose place it is: the coarse one, or the refined one where the coarse side keeps a face between
    /// materials.
    pub(super) within: u32,
}

impl LayerHex {
    /// The side in whose place it is, which is its own from now on, and the number that has there.
    pub(super) fn replaced(&self) -> (Side, Side) {
        if self.within == self.face.refined {
            (self.face.refined_side(), BELOW)
        } else {
            (self.face.coarse_side(), ABOVE)
        }
    }
}

/// The faces of a layer hex that the coarse hex and the refined one have, in the order of [`FACES`].
const BELOW: Side = 0;
const ABOVE: Side = 1;

/// The corners of a face of the refined hex, as corners 4 to 7 of the layer hex upon it.
pub(super) fn above(refined_face: u8) -> [u8; 4] {
    let [a, b, c, d] = FACES[usize::from(refined_face)];
    [a, d, c, b]
}

/// Separates the two sides of the interface.
///
/// # Errors
/// The coarse hexes that must be refined too where that is impossible, or if the monitor stops it.
pub(super) fn pillow(
    positions: &[Point],
    interface: &mut Interface,
    monitor: &dyn Monitor,
) -> Result<Pillow, StageError> {
    monitor.checkpoint(PILLOW, 0.0)?;
    let (copies, pinched_edges) = separated(positions, interface, monitor)?;
    let interface = &*interface;
    monitor.checkpoint(PILLOW, 0.8)?;
    let hexes = copies.applied(interface);
    let layer =
        interface.faces(monitor)?.into_iter().map(|face| layer_hex(interface, &hexes, face)).collect();
    let mut all = Vec::with_capacity(positions.len() + copies.points.len());
    all.extend_from_slice(positions);
    all.extend_from_slice(&copies.points);
    interface.nodes.iter().zip(&copies.kept).for_each(|(n, &kept)| all[n.index()] = kept);
    Ok(Pillow { positions: all, hexes, layer, pinched_edges })
}

/// Can the two sides of the interface be separated?
///
/// # Errors
/// As [`pillow`].
pub(super) fn can_be_separated(
    positions: &[Point],
    interface: &mut Interface,
    monitor: &dyn Monitor,
) -> Result<(), StageError> {
    separated(positions, interface, monitor).map(|_| ())
}

/// Steps 1 to 3: the copies of the nodes of the interface, which learns which side keeps the faces between materials; and
/// how many pinched edges there are.
fn separated(
    positions: &[Point],
    interface: &mut Interface,
    monitor: &dyn Monitor,
) -> Result<(Copies, usize), StageError> {
    let mut pinches = Pinches::find(interface, monitor)?;
    let more = pinches.resolve(positions, interface, monitor)?;
    if !more.is_empty() {
        return Err(StageError::Conflict(more));
    }
    monitor.proceed()?;
    interface.kept_by_coarse = kept_by_coarse(positions, interface, &pinches, monitor)?;
    let ridges = Ridges::new(positions, interface, &pinches, monitor)?;
    let copies = Copies::new(positions, interface, &pinches, &ridges, monitor)?;
    Ok((copies, pinches.len()))
}

/// The hex at a face of the interface.
fn layer_hex(interface: &Interface, hexes: &[[NodeId; 8]], face: InterfaceFace) -> LayerHex {
    let (refined, coarse) = (face.refined as usize, face.coarse as usize);
    let corners = above(face.refined_face);
    let mut hex = [NodeId(0); 8];
    for (k, corner) in corners.into_iter().enumerate() {
        let old = interface.hexes[refined][usize::from(corner)];
        let there = interface.hexes[coarse].iter().position(|&n| n == old).expect("both hexes have the face");
        hex[k] = hexes[coarse][there];
        hex[k + 4] = hexes[refined][usize::from(corner)];
    }
    let is_kept_by_coarse = interface.kept_by_coarse.binary_search(&face.refined_side()).is_ok();
    let within = if is_kept_by_coarse { face.refined } else { face.coarse };
    LayerHex { hex, face, within }
}

/// The copies of the nodes of the interface.
struct Copies {
    /// For each use of an interface node which copy its hex gets: 0 is the node itself.
    of_use: Vec<u32>,
    /// The first copy of each node, counted from the first of all.
    first: Vec<u32>,
    /// Where the copies are.
    points: Vec<Point>,
    /// Where the nodes of the interface are themselves.
    kept: Vec<Point>,
    /// The first of all copies.
    first_node: NodeId,
}

/// What a block of nodes has of it.
#[derive(Default)]
struct Block {
    of_use: Vec<u32>,
    counts: Vec<u32>,
    points: Vec<Point>,
    kept: Vec<Point>,
    more: Vec<u32>,
}

impl Copies {
    fn new(
        positions: &[Point],
        interface: &Interface,
        pinches: &Pinches,
        ridges: &Ridges,
        monitor: &dyn Monitor,
    ) -> Result<Self, StageError> {
        let count = interface.nodes.len();
        let blocks: Vec<Block> = parallel::try_blocks(count, BLOCK, monitor, |places| {
            Self::block(positions, interface, pinches, ridges, places)
        })?;
        let mut more = blocks.iter().flat_map(|block| block.more.iter().copied()).collect::<Vec<_>>();
        if !more.is_empty() {
            more.sort_unstable();
            more.dedup();
            return Err(StageError::Conflict(more));
        }
        let counts: Vec<u32> = blocks.iter().flat_map(|block| block.counts.iter().copied()).collect();
        Ok(Self {
            first_node: NodeId::new(positions.len()),
            of_use: blocks.iter().flat_map(|block| block.of_use.iter().copied()).collect(),
            first: offsets(counts.into_iter()),
            points: blocks.iter().flat_map(|block| block.points.iter().copied()).collect(),
            kept: blocks.iter().flat_map(|block| block.kept.iter().copied()).collect(),
        })
    }

    fn block(
        positions: &[Point],
        interface: &Interface,
        pinches: &Pinches,
        ridges: &Ridges,
        places: std::ops::Range<usize>,
    ) -> Block {
        let (mut star, mut regions, mut shifts) = (Star::default(), Regions::default(), Shifts::default());
        let mut block = Block::default();
        let mut beside = Beside::default();
        for place in places {
            star.load(interface, place);
            regions.load(interface, &star, pinches, place);
            shifts.load(positions, interface, &star, &regions, interface.kept());
            let staying_side = ridges.staying_side(place);
            let side_beside = ridges.side_beside(interface, &star);
            shifts.choose_keepers(&regions, staying_side, side_beside);
            if staying_side.is_none() {
                shifts.lean(&regions, side_beside);
            }
            let is_whole = shifts.keeps_ridges(&regions, staying_side);
            let is_folded = shifts.is_folded(|end| beside.freedom(positions, interface, end));
            if !regions.are_trees() || shifts.is_stuck() || !is_whole || is_folded {
                add_coarse(&star, &mut block.more, |_| true);
            }
            block.of_use.extend(regions.of_hex.iter().map(|&region| shifts.copy(region as usize)));
            block.kept.push(shifts.kept());
            let before = block.points.len();
            block.points.extend(shifts.points());
            block.counts.push((block.points.len() - before) as u32);
        }
        block
    }

    /// The hexes with their copies.
    fn applied(&self, interface: &Interface) -> Vec<[NodeId; 8]> {
        let mut hexes = interface.hexes.to_vec();
        let first_copy = self.first_node.0;
        for place in 0..interface.nodes.len() {
            let copies = &self.of_use[interface.stars.range(place)];
            for ((in_shell, corner), &copy) in interface.stars.at(place).zip(copies) {
                if copy > 0 {
                    let hex = &mut hexes[interface.shell[in_shell] as usize];
                    hex[corner] = NodeId(first_copy + self.first[place] + copy - 1);
                }
            }
        }
        hexes
    }
}
