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
//! Either side can keep a face, if the other can leave it:
//!
//! 1. At each edge of such a face see whether a side has faces between materials of its own. It can leave the edge along
//!    one of them that lies between two hexes, each at the interface; of any more hexes it must keep the edge. At a pinched
//!    edge the side that is joined must.
//! 2. At each node see whether a side can move at all (`shift`) where the other keeps all the faces there; else it must
//!    keep them.
//! 3. Faces that share an edge, or a node with but two regions, are kept by the same side. Where both sides must, coarse
//!    hexes are refined at the places where the refined side must: these are notches of the refined set. That ends at
//!    a convex one at the latest, and does not follow the face between materials along its steps.
//! 4. What nothing is said of is kept by the refined side.

use super::blocks::in_blocks;
use super::interface::{Interface, InterfaceFace, Kept, Star, StarFace};
use super::pinch::{Pinches, add_coarse};
use super::regions::{Regions, has_edge};
use super::shift::Shifts;
use super::stage::StageError;
use crate::Monitor;
use crate::geometry::Point;
use crate::mesh::NodeId;
use crate::mesh::topology::{Sets, Side};

/// A face that is kept by the same side as the first one at an edge or a node, and what is said of them there.
struct Tie {
    /// The refined sides of the face and of the first one.
    faces: [Side; 2],
    said: Said,
}

/// What is said of faces at an edge or a node.
#[derive(Clone, Copy)]
struct Said {
    /// Must the coarse side keep them, must the refined one?
    must: [bool; 2],
    /// A coarse hex there: if it is refined, the refined side may leave.
    coarse: u32,
}

/// Of the faces between refined and coarse hexes of different materials those that the coarse side keeps: their refined
/// sides, ascending.
///
/// # Errors
/// The coarse hexes that must be refined too where neither side can keep the faces, or if the monitor stops it.
pub(super) fn kept_by_coarse(
    positions: &[Point],
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
    let buffers = || (Star::default(), Regions::default(), Shifts::default());
    let at = |buffers: &mut (Star, Regions, Shifts), place: usize, found: &mut Vec<Tie>| {
        let (star, regions, shifts) = buffers;
        star.load(interface, place);
        at_edges(interface, star, pinches, found);
        if faces_between(interface, star).any(|face| star.is_interface(face)) {
            regions.load(interface, star, pinches, place);
            at_node(positions, interface, star, (regions, shifts), found);
        }
    };
    let ties = in_blocks(interface.nodes.len(), monitor, buffers, at)?;
    let mut sets = Sets::new(faces.len());
    for tie in &ties {
        let [a, b] = tie.faces.map(|side| number(side) as u32);
        sets.join(a, b, false);
    }
    let mut set_of = |side: Side| sets.root(number(side) as u32).0 as usize;
    let mut must = vec![[false; 2]; faces.len()];
    for Tie { faces: [side, _], said } in &ties {
        let of_set = &mut must[set_of(*side)];
        *of_set = [0, 1].map(|k| of_set[k] || said.must[k]);
    }
    let lifts = |tie: &&Tie| tie.said.must[1] && must[set_of(tie.faces[0])] == [true; 2];
    let mut more: Vec<u32> = ties.iter().filter(lifts).map(|tie| tie.said.coarse).collect();
    if !more.is_empty() {
        more.sort_unstable();
        more.dedup();
        return Err(StageError::Conflict(more));
    }
    let sides = faces.iter().map(InterfaceFace::refined_side);
    Ok(sides.filter(|&side| must[set_of(side)][0]).collect())
}

/// The faces between materials at a star's node.
fn faces_between<'a>(interface: &'a Interface, star: &'a Star) -> impl Iterator<Item = &'a StarFace> {
    star.faces.iter().filter(|face| interface.kind(star, face).is_some_and(|kind| kind.is_inner()))
}

/// Ties faces of the interface, and says the same of them.
fn tie<'a>(star: &Star, faces: impl Iterator<Item = &'a StarFace>, said: Said, found: &mut Vec<Tie>) {
    let mut sides = faces.filter_map(|face| Some(star.side(star.sides(face)?[0])));
    let Some(first) = sides.next() else { return };
    found.extend(std::iter::once(first).chain(sides).map(|side| Tie { faces: [side, first], said }));
}

/// What the edges from a star's node to greater ones say.
fn at_edges(interface: &Interface, star: &Star, pinches: &Pinches, found: &mut Vec<Tie>) {
    let between: Vec<&StarFace> = faces_between(interface, star).collect();
    let mut ends: Vec<NodeId> = between.iter().flat_map(|face| [face.rest[0], face.rest[2]]).collect();
    ends.retain(|&end| end > star.node);
    ends.sort_unstable();
    ends.dedup();
    for end in ends {
        let at_edge = || between.iter().copied().filter(|face| face.has_edge(end));
        let mut coarse = Vec::new();
        add_coarse(star, &mut coarse, |hex| has_edge(interface, star, hex, end));
        // Without a coarse hex the edge is none of the interface.
        let Some(&coarse) = coarse.first() else { continue };
        let must = match pinches.between(star.node, end) {
            Some(pinch) => [!pinch.joins_refined, pinch.joins_refined],
            None => [false, true].map(|refined| {
                let is_within =
                    |face: &StarFace| !star.is_interface(face) && star.is_refined(face.first.0) == refined;
                at_edge().any(is_within) && !can_leave_edge(interface, star, end, refined)
            }),
        };
        tie(star, at_edge(), Said { must, coarse }, found);
    }
}

/// Can a side with a face between materials leave an edge along it?
fn can_leave_edge(interface: &Interface, star: &Star, end: NodeId, refined: bool) -> bool {
    let is_on_boundary = star.faces.iter().any(|face| face.has_edge(end) && face.second.is_none());
    let of_side = |&hex: &usize| star.is_refined(hex) == refined && has_edge(interface, star, hex, end);
    !is_on_boundary && (0..star.hexes.len()).filter(of_side).count() == 2
}

/// What a star says whose node has two regions, between which some of its faces lie.
fn at_node(
    positions: &[Point],
    interface: &Interface,
    star: &Star,
    (regions, shifts): (&Regions, &mut Shifts),
    found: &mut Vec<Tie>,
) {
    if regions.all.len() != 2 {
        return;
    }
    let must = [false, true].map(|refined| {
        shifts.load(positions, interface, star, regions, Kept::All(!refined));
        !shifts.can_leave(regions, refined)
    });
    let mut coarse = Vec::new();
    add_coarse(star, &mut coarse, |_| true);
    tie(star, faces_between(interface, star), Said { must, coarse: coarse[0] }, found);
}
