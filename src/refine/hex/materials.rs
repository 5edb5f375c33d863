//! Faces between materials, that is between hexes with different sets of tags, or in groups (`sheets`). They stay where
//! they are, as the boundary does: nodes on them move along them alone.
//!
//! Where such a face is one between refined and coarse hexes too, the layer's hex upon it belongs to one of the two
//! materials, and the nodes of the other side are kept. Let S and A be the materials, the line between them where they
//! meet, R refined and L the layer:
//!
//! ```text
//!   S R | S        S R L S        The interface turns into the face between materials from S, so that the layer upon
//!   ====+====  is   L  L S        it belongs to S, too: the coarse side keeps the face. Else a hex of the layer would
//!   A   | A        ==*=====       have two faces in one plane that share an edge.
//!                  A   | A
//! ```
//!
//! 1. At each edge of such a face see what the other faces between materials there are between: if coarse hexes, the
//!    coarse side keeps the face, if refined ones, that side. At a pinched edge it is the side that is joined.
//! 2. Faces that share an edge are kept by the same side. If that cannot be, refine the coarse hexes at faces that the
//!    coarse side would keep.
//! 3. What nothing is said of is kept by the refined side.

use super::blocks::in_blocks;
use super::interface::{Interface, InterfaceFace, Star, StarFace};
use super::pinch::Pinches;
use super::stage::StageError;
use crate::Monitor;
use crate::mesh::NodeId;
use crate::mesh::topology::{Sets, Side};

/// One of the faces at an edge, and what the edge says of it.
struct Tie {
    /// The refined sides of the face and of the first one there.
    side: Side,
    first: Side,
    by_coarse: bool,
    by_refined: bool,
}

/// Of the faces between refined and coarse hexes of different materials those that the coarse side keeps: their refined
/// sides, ascending.
///
/// # Errors
/// The coarse hexes that must be refined too where neither side can keep the faces, or if the monitor stops it.
pub(super) fn kept_by_coarse(
    interface: &Interface,
    pinches: &Pinches,
    monitor: &dyn Monitor,
) -> Result<Vec<Side>, StageError> {
    if interface.materials.is_empty() {
        return Ok(Vec::new());
    }
    let mut faces = interface.faces(monitor)?;
    faces.retain(|face| interface.material(face.refined) != interface.material(face.coarse));
    faces.sort_unstable_by_key(InterfaceFace::refined_side);
    let number = |side: Side| {
        faces.binary_search_by_key(&side, InterfaceFace::refined_side).expect("a face of the interface")
    };
    let at = |star: &mut Star, place: usize, found: &mut Vec<Tie>| {
        star.load(interface, place);
        ties(interface, star, pinches, found);
    };
    let ties = in_blocks(interface.nodes.len(), monitor, Star::default, at)?;
    let mut sets = Sets::new(faces.len());
    for tie in &ties {
        sets.join(number(tie.side) as u32, number(tie.first) as u32, false);
    }
    let mut set_of = |side: Side| sets.root(number(side) as u32).0 as usize;
    let (mut by_coarse, mut by_refined) = (vec![false; faces.len()], vec![false; faces.len()]);
    for tie in &ties {
        let set = set_of(tie.side);
        by_coarse[set] |= tie.by_coarse;
        by_refined[set] |= tie.by_refined;
    }
    let mut more: Vec<u32> = Vec::new();
    for tie in ties.iter().filter(|tie| tie.by_coarse) {
        let set = set_of(tie.side);
        more.extend((by_coarse[set] && by_refined[set]).then(|| faces[number(tie.side)].coarse));
    }
    if !more.is_empty() {
        more.sort_unstable();
        more.dedup();
        return Err(StageError::Conflict(more));
    }
    let sides = faces.iter().map(InterfaceFace::refined_side);
    Ok(sides.filter(|&side| by_coarse[set_of(side)]).collect())
}

/// What the edges from a star's node to greater ones say.
fn ties(interface: &Interface, star: &Star, pinches: &Pinches, found: &mut Vec<Tie>) {
    let is_inner = |face: &&StarFace| interface.kind(star, face).is_some_and(|kind| kind.is_inner());
    let inner: Vec<&StarFace> = star.faces.iter().filter(is_inner).collect();
    let mut ends: Vec<NodeId> = inner.iter().flat_map(|face| [face.rest[0], face.rest[2]]).collect();
    ends.retain(|&end| end > star.node);
    ends.sort_unstable();
    ends.dedup();
    for end in ends {
        let at_edge = || inner.iter().filter(|face| face.has_edge(end));
        let is_between = |refined: bool| {
            at_edge().any(|face| !star.is_interface(face) && star.is_refined(face.first.0) == refined)
        };
        let (by_coarse, by_refined) = match pinches.between(star.node, end) {
            Some(pinch) => (!pinch.joins_refined, pinch.joins_refined),
            None => (is_between(false) && !is_between(true), is_between(true) && !is_between(false)),
        };
        let mut sides = at_edge().filter(|face| star.is_interface(face)).filter_map(|face| {
            let refined = [Some(face.first), face.second];
            let (hex, side) = refined.into_iter().flatten().find(|&(hex, _)| star.is_refined(hex))?;
            Some(6 * star.hexes[hex].0 + Side::from(side))
        });
        let Some(first) = sides.next() else { continue };
        let tie = |side| Tie { side, first, by_coarse, by_refined };
        found.extend(std::iter::once(first).chain(sides).map(tie));
    }
}
