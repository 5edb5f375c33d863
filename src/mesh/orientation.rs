//! Hexes that are numbered inside out.

use super::check::listed;
use super::numbering::hex::{CORNERS, EDGE_BETWEEN, EDGES, NONE};
use super::topology::{Side, hex_of};
use super::{HexId, HexMesh};
use crate::geometry::Point;
use crate::parallel;

/// A corner counts as turned inside out if the determinant of its unit edge vectors is below minus this: what is
/// left of the digits of f64 once coordinates are a thousand times larger than the hex.
const ROUNDING: f64 = 1e-12;

/// Hexes that cannot be put right by numbering them otherwise, ascending.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error(
    "some hexes ({}) are inside out at some of their corners, but not at all of them: {} (counted from 0, in the file's order); \
     list their nodes bottom before top, both in the same sense, or move nodes that fold them",
    .0.len(), listed(.0)
)]
pub struct InvertedHexes(pub Vec<HexId>);

/// Turns the hexes around whose whole numbering is mirrored: those that are inside out at all eight corners.
/// Returns how many were.
///
/// # Errors
/// If a hex is inside out at one to seven corners; `mesh` is then as it was.
///
/// # Panics
/// If a node id is out of range: `check_hexes` tells before.
///
/// ```
/// use hexmill::mesh::{HexMesh, NodeId, orient_hexes, numbering::hex::CORNERS};
/// let positions = CORNERS.map(|c| hexmill::geometry::Point::from(c.map(f64::from)));
/// let mirrored = [4, 5, 6, 7, 0, 1, 2, 3].map(NodeId);
/// let mut mesh = HexMesh { positions: positions.to_vec(), hexes: vec![mirrored], ..HexMesh::default() };
/// assert_eq!(orient_hexes(&mut mesh), Ok(1));
/// assert_eq!(mesh.hexes, [[0, 1, 2, 3, 4, 5, 6, 7].map(NodeId)]);
/// ```
pub fn orient_hexes(mesh: &mut HexMesh) -> Result<usize, InvertedHexes> {
    let HexMesh { positions, hexes, groups, .. } = mesh;
    let turned = |h: usize| {
        let corners = inverted_corners(&hexes[h].map(|n| positions[n.index()]));
        (corners != 0).then_some((HexId::new(h), corners == ALL))
    };
    let found: Vec<(HexId, bool)> = parallel::filter_map(hexes.len(), turned);
    let wrong: Vec<HexId> = found.iter().filter(|(_, whole)| !whole).map(|&(h, _)| h).collect();
    if !wrong.is_empty() {
        return Err(InvertedHexes(wrong));
    }
    for (h, _) in &found {
        hexes[h.index()].rotate_left(4);
    }
    if !groups.is_empty() {
        let is_turned = |h: HexId| found.binary_search_by_key(&h, |&(turned, _)| turned).is_ok();
        groups.renumber(|side| if is_turned(hex_of(side)) { upside_down(side) } else { side });
    }
    Ok(found.len())
}

/// The number of a side once its hex has its bottom as its top.
fn upside_down(side: Side) -> Side {
    match side % 6 {
        0 => side + 1,
        1 => side - 1,
        _ => side,
    }
}

/// Every corner, in the result of [`inverted_corners`].
const ALL: u8 = u8::MAX;

/// The corners at which a hex is inside out, as bits.
pub(crate) fn inverted_corners(corners: &[Point; 8]) -> u8 {
    let edges = EDGES.map(|[a, b]| {
        let along = corners[usize::from(b)] - corners[usize::from(a)];
        along / along.length()
    });
    let inverted = |k: &usize| {
        let [x, y, z] = AXES_AT[*k].map(|e| edges[usize::from(e)]);
        // An edge without length makes this no number, which is not less.
        x.cross(y).dot(z) < -ROUNDING
    };
    (0..8).filter(inverted).fold(0, |bits, k| bits | 1 << k)
}

/// The edges along x, y and z at each corner; all of them run from 0 to 1.
const AXES_AT: [[u8; 3]; 8] = {
    let (mut all, mut k) = ([[NONE; 3]; 8], 0);
    while k < 8 {
        let mut other = 0;
        while other < 8 {
            let edge = EDGE_BETWEEN[k][other];
            if edge != NONE {
                let mut axis = 0;
                while CORNERS[k][axis] == CORNERS[other][axis] {
                    axis += 1;
                }
                all[k][axis] = edge;
            }
            other += 1;
        }
        k += 1;
    }
    all
};

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::NodeId;
    use crate::mesh::numbering::hex::SYMMETRIES;

    fn cube() -> [Point; 8] {
        CORNERS.map(|c| Point::from(c.map(f64::from)))
    }

    #[test]
    fn every_turn_is_right_and_every_mirror_wrong_at_any_scale() {
        for scale in [1e-100, 1.0, 1e100] {
            for (s, symmetry) in SYMMETRIES.iter().enumerate() {
                let corners = symmetry.map(|k| cube()[usize::from(k)] * scale);
                assert_eq!(inverted_corners(&corners), if s < 24 { 0 } else { ALL }, "{s} at {scale}");
            }
        }
    }

    #[test]
    fn mirrored_hexes_are_turned_and_crooked_ones_refused() {
        for symmetry in &SYMMETRIES[24..] {
            let mut mesh = HexMesh {
                positions: cube().to_vec(),
                hexes: vec![symmetry.map(|k| NodeId(k.into()))],
                ..HexMesh::default()
            };
            assert_eq!(orient_hexes(&mut mesh), Ok(1));
            assert_eq!(orient_hexes(&mut mesh), Ok(0));
        }
        let mut positions = cube().to_vec();
        positions[6] = Point::splat(0.1);
        let hexes = vec![[0, 1, 2, 3, 4, 5, 6, 7].map(NodeId)];
        let mut mesh = HexMesh { positions, hexes, ..HexMesh::default() };
        let before = mesh.clone();
        let error = orient_hexes(&mut mesh).unwrap_err();
        assert_eq!(error, InvertedHexes(vec![HexId(0)]));
        assert!(error.to_string().starts_with("some hexes (1) are inside out"));
        assert_eq!(mesh, before);
    }

    #[test]
    fn flat_corners_and_edges_without_length_are_not_inside_out() {
        let mut flat = cube();
        flat[2] = Point::new(0.5, 0.5, 0.0);
        assert_eq!(inverted_corners(&flat), 0);
        let mut wedge = cube();
        wedge[1] = wedge[0];
        wedge[5] = wedge[4];
        assert_eq!(inverted_corners(&wedge), 0);
    }
}
