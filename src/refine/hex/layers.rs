//! Method I (Ebeida et al., section 3.1): layer templates instead of a pillow.
//!
//! 1. A coarse hex with refined nodes is cut by template A, B or C, by how many it has (`template::hex::select`).
//!    All edges with one refined end are halved, and each piece has one refined face, one refined edge, or
//!    neither.
//! 2. A piece with a refined face takes the quarter, one with a refined edge takes C at the edge node.
//!
//! | refined nodes | template | hexes in the end |
//! |---|---|---|
//! | 1 | C at the node | 4 |
//! | 2, an edge | B at the edge, C in its box | 6 |
//! | 4, a face | A, one quarter | 8 |
//! | 6, two faces | B at the other edge, two quarters | 15 |
//! | 7, three faces | C at the other node, three quarters | 22 |
//!
//! Others have no template and are refused; the forest's closure prevents them. No hex is inverted.

use super::divide::{Divided, divide};
use super::interface::{Interface, InterfaceFace};
use super::labels;
use super::quarters::{Quarter, place_quarters};
use super::stage::{NO_OCTANT, StageError};
use super::transition::{Transition, Transitions};
use crate::geometry::Point;
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::{FACES, NEIGHBOURS, apart};
use crate::template::hex::{COLUMN, CORNER, SLAB, Selected, select, symmetry_to};
use crate::{Monitor, parallel};

/// Cuts the coarse hexes at the interface, appending to `positions`, and says what their pieces become.
///
/// # Errors
/// The coarse hexes that no template fits, or if the monitor stops it.
pub(super) fn layers(
    positions: &mut Vec<Point>,
    interface: &Interface,
    octant: &[u8],
    monitor: &dyn Monitor,
) -> Result<Transitions, StageError> {
    let faces = interface.faces(monitor)?;
    let cut = layer_hexes(interface, &faces, octant).map_err(StageError::Forbidden)?;
    let divided: Vec<Divided> = cut.iter().map(|&(_, divided)| divided).collect();
    let mut cells = Vec::new();
    let cells_of = divide(positions, &mut cells, &divided, monitor)?;
    let replaced: Vec<u32> = cut.iter().map(|&(hex, _)| hex).collect();
    let labels = labels::of_cells(&labels::of_some(interface.labels, &replaced), &divided, &cells_of);
    let (mut transitions, mut quarters, mut quarters_from) = (Transitions::default(), Vec::new(), Vec::new());
    let mut quarter_labels = Vec::new();
    for (k, &hex) in replaced.iter().enumerate() {
        for cell in cells_of[k]..cells_of[k + 1] {
            let piece = cells[cell as usize];
            let (place, labels_there) = match Piece::of(interface, hex, octant, piece) {
                Piece::Whole => {
                    transitions.whole.push((hex, piece));
                    (transitions.whole.len() - 1, &mut transitions.whole_labels)
                }
                Piece::Face(quarter) => {
                    quarters.push(quarter);
                    quarters_from.push(hex);
                    (quarters.len() - 1, &mut quarter_labels)
                }
                Piece::Edge(divided) => {
                    transitions.divided.push(Transition { from: hex, within: hex, divided });
                    (transitions.divided.len() - 1, &mut transitions.labels)
                }
            };
            labels_there.extend(labels::after(place, labels::of_one(&labels, cell)));
        }
    }
    transitions.replaced = replaced;
    transitions.labels.extend(labels::after(transitions.divided.len(), quarter_labels));
    let placed =
        place_quarters(&quarters).ok_or_else(|| StageError::Forbidden(transitions.replaced.clone()))?;
    let placed = quarters_from.into_iter().zip(placed).map(|(from, divided)| Transition {
        from,
        within: from,
        divided,
    });
    transitions.divided.extend(placed);
    transitions.interface_faces = faces.len();
    Ok(transitions)
}

/// The coarse hexes at the interface with their templates; or those that have none.
fn layer_hexes(
    interface: &Interface,
    faces: &[InterfaceFace],
    octant: &[u8],
) -> Result<Vec<(u32, Divided)>, Vec<u32>> {
    let mut refined_faces = vec![0u8; interface.hexes.len()];
    for face in faces {
        refined_faces[face.coarse as usize] |= 1 << face.coarse_face;
    }
    let found: Vec<(u32, Option<Divided>)> = parallel::filter_map(interface.shell.len(), |k| {
        let hex = interface.shell[k];
        let is_coarse = !interface.refined[hex as usize];
        is_coarse.then(|| (hex, layer_hex(interface, hex, refined_faces[hex as usize], octant)))
    });
    let forbidden: Vec<u32> = found.iter().filter(|(_, cut)| cut.is_none()).map(|&(hex, _)| hex).collect();
    if !forbidden.is_empty() {
        return Err(forbidden);
    }
    Ok(found.into_iter().filter_map(|(hex, divided)| Some((hex, divided?))).collect())
}

/// The template of a coarse hex, if there is one: it must have roles, its faces of refined nodes alone must be refined
/// faces, and a lone edge a refined edge.
fn layer_hex(interface: &Interface, hex: u32, refined_faces: u8, octant: &[u8]) -> Option<Divided> {
    let nodes = interface.hexes[hex as usize];
    let is_refined = |k: u8| interface.place(nodes[usize::from(k)]).is_some();
    let refined = (0..8).filter(|&k| is_refined(k)).fold(0u8, |mask, k| mask | 1 << k);
    let whole_faces =
        (0..6).filter(|&f| FACES[f].into_iter().all(is_refined)).fold(0u8, |mask, f| mask | 1 << f);
    if whole_faces != refined_faces || (refined.count_ones() > 1 && octant[hex as usize] == NO_OCTANT) {
        return None;
    }
    let (template, symmetry) = match select(refined) {
        Selected::Face(symmetry) => (&SLAB, symmetry),
        Selected::Edge(symmetry) => (&COLUMN, symmetry),
        Selected::Node(symmetry) => (&CORNER, symmetry),
        Selected::Stay | Selected::None => return None,
    };
    let mut corners = (0..8).filter(|&k| is_refined(k)).map(|k| nodes[usize::from(k)]);
    if refined.count_ones() == 2 && !is_refined_edge(interface, [corners.next()?, corners.next()?]) {
        return None;
    }
    Some(Divided { hex: nodes, template, symmetry })
}

/// Has some refined hex the edge between two nodes of the interface?
fn is_refined_edge(interface: &Interface, [a, b]: [NodeId; 2]) -> bool {
    let place = interface.place(a).expect("a node of the interface");
    interface.stars.at(place).any(|(in_shell, corner)| {
        let hex = interface.shell[in_shell] as usize;
        let nodes = &interface.hexes[hex];
        interface.refined[hex] && NEIGHBOURS[corner].iter().any(|&k| nodes[usize::from(k)] == b)
    })
}

/// What a piece of a coarse hex becomes.
enum Piece {
    /// It stays.
    Whole,
    /// It has a refined face.
    Face(Quarter),
    /// It has a refined edge.
    Edge(Divided),
}

impl Piece {
    fn of(interface: &Interface, hex: u32, octant: &[u8], piece: [NodeId; 8]) -> Self {
        let nodes = &interface.hexes[hex as usize];
        // A hex without an octant has one refined node alone, whose role is not asked for.
        let octant = octant[hex as usize] % 8;
        let mut refined = [None; 8];
        for (role, node) in refined.iter_mut().zip(piece) {
            let corner = nodes.iter().position(|&n| n == node && interface.place(n).is_some());
            *role = corner.map(|corner| apart(octant.into(), corner));
        }
        let with_role = |wanted: usize| (0..8u8).filter(move |&k| refined[usize::from(k)] == Some(wanted));
        match refined.iter().flatten().count() {
            4 => {
                let ends: Vec<u8> = with_role(1).collect();
                match (with_role(0).next(), ends.as_slice(), with_role(2).next()) {
                    (Some(k), &[a, b], Some(f)) => Self::Face(Quarter { hex: piece, k, e: [a, b], f }),
                    _ => Self::Whole,
                }
            }
            2 => match (with_role(0).next(), with_role(1).next()) {
                (Some(k), Some(e)) => {
                    let third = NEIGHBOURS[usize::from(e)].into_iter().find(|&n| n != k);
                    let symmetry = third.and_then(|third| symmetry_to(e, k, third));
                    let symmetry = symmetry.expect("the refined edge is an edge of the piece");
                    Self::Edge(Divided { hex: piece, template: &CORNER, symmetry })
                }
                _ => Self::Whole,
            },
            _ => Self::Whole,
        }
    }
}
