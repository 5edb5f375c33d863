//! The materials of a mesh: what its hexes are told apart by, so that the faces between are kept (`materials`).
//!
//! Hexes with different sets of tags are of different materials. So are those on the two sides of a face in a group:
//!
//! 1. Hexes that are connected through faces in no group and between equal tags are of one material.
//! 2. Where a sheet of faces in groups does not part the mesh, since it ends within it, both its sides are of one material
//!    now. There the hexes along one of its sides, those that have its edges among them, become a material of their own.
//!    So all of their faces stay where they are, not those of the sheet alone.
//! 3. Where both sides are of one material still, as at a sheet that has one side alone, a hex at each such face becomes one.

use std::collections::BTreeMap;

use super::labels::{INNER, Label, NO_LABEL, label_of};
use crate::mesh::topology::{HexFaces, Sets, Side, hex_of};
use crate::mesh::{FaceId, HexMesh, NodeId};
use crate::monitor::batches;
use crate::{Cancelled, Monitor};

/// The material of each hex; empty if all are of one.
///
/// # Errors
/// If the monitor stops it.
pub(super) fn materials_of(
    mesh: &HexMesh,
    labels: &[Label],
    monitor: &dyn Monitor,
) -> Result<Vec<u32>, Cancelled> {
    if labels.iter().any(|&(_, label)| label & INNER != 0) {
        return Sheets::new(mesh, labels, monitor)?.materials(monitor);
    }
    let of_hex = &mesh.tags.of_element;
    let is_one = of_hex.windows(2).all(|two| two[0] == two[1]);
    Ok(if is_one { Vec::new() } else { of_hex.clone() })
}

/// The faces in groups between hexes.
struct Sheets<'a> {
    faces: HexFaces,
    /// The set of tags of each hex; empty if there are none.
    tags: &'a [u32],
    labels: &'a [Label],
    /// Hexes that no wall parts.
    sets: Sets,
}

impl<'a> Sheets<'a> {
    fn new(mesh: &'a HexMesh, labels: &'a [Label], monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let faces = HexFaces::within(mesh.positions.len(), &mesh.hexes, monitor)?;
        let sets = Sets::new(mesh.hexes.len());
        let mut sheets = Self { faces, tags: &mesh.tags.of_element, labels, sets };
        for batch in batches(sheets.faces.nodes.len(), monitor) {
            for f in batch?.map(FaceId::new) {
                if let Some([a, b]) = sheets.way(f) {
                    sheets.sets.join(hex_of(a).0, hex_of(b).0, false);
                }
            }
        }
        Ok(sheets)
    }

    /// The sides of a face that is no wall: between hexes of equal tags, and in no group.
    fn way(&self, f: FaceId) -> Option<[Side; 2]> {
        let &[a, b] = self.faces.sides(f) else { return None };
        let tag = |side: Side| self.tags.get(hex_of(side).index());
        (tag(a) == tag(b) && label_of(self.labels, a) == NO_LABEL).then_some([a, b])
    }

    fn face(&self, side: Side) -> FaceId {
        self.faces.of_hex[hex_of(side).index()][side as usize % 6]
    }

    /// The side on the other side of the same face; itself on the boundary.
    fn beyond(&self, side: Side) -> Side {
        let sides = self.faces.sides(self.face(side));
        sides.iter().copied().find(|&other| other != side).unwrap_or(side)
    }

    fn materials(mut self, monitor: &dyn Monitor) -> Result<Vec<u32>, Cancelled> {
        let inner = |&&(_, label): &&Label| label & INNER != 0;
        let sides: Vec<Side> = self.labels.iter().filter(inner).map(|&(side, _)| side).collect();
        let mut open = Vec::new();
        for batch in batches(sides.len(), monitor) {
            for &side in &sides[batch?] {
                let [here, there] = [side, self.beyond(side)].map(|side| self.sets.root(hex_of(side).0));
                open.extend((here == there).then_some(side));
            }
        }
        let mut own = self.along_one_side(&open, monitor)?;
        own.sort_unstable();
        own.dedup();
        let mut materials: Vec<u32> = (0..self.tags.len().max(self.faces.of_hex.len()) as u32)
            .map(|hex| self.sets.root(hex).0)
            .collect();
        let mut next = materials.len() as u32;
        // Hexes along the same sheets, of what was one material, stay one.
        let mut known: BTreeMap<[u32; 2], u32> = BTreeMap::new();
        for (hex, along) in own {
            let material = &mut materials[hex as usize];
            *material = *known.entry([*material, along]).or_insert_with(|| {
                next += 1;
                next - 1
            });
        }
        for &side in &sides {
            let [here, there] = [side, self.beyond(side)].map(|side| hex_of(side).index());
            if materials[here] == materials[there] {
                materials[here] = next;
                next += 1;
            }
        }
        Ok(materials)
    }

    /// The hexes along one side of each sheet, each with the side's number. The sheets are of the faces with the sides
    /// `open`, which ascend; one is followed from face to face around the edges that these share.
    fn along_one_side(&self, open: &[Side], monitor: &dyn Monitor) -> Result<Vec<(u32, u32)>, Cancelled> {
        let place = |side: Side| open.binary_search(&side).ok();
        let mut joined = Sets::new(open.len());
        let mut passed: Vec<(u32, u32)> = Vec::new();
        for batch in batches(open.len(), monitor) {
            for k in batch? {
                let first = passed.len();
                passed.push((hex_of(open[k]).0, k as u32));
                let nodes = self.faces.nodes[self.face(open[k]).index()];
                for edge in [0, 1, 2, 3].map(|j| [nodes[j], nodes[(j + 1) % 4]]) {
                    let before = passed.len();
                    let end = self.turn(open[k], edge, |hex| passed.push((hex, k as u32)));
                    match place(end) {
                        Some(other) if self.face(end) != self.face(open[k]) => {
                            joined.join(k as u32, other as u32, false);
                        }
                        _ => passed.truncate(before),
                    }
                }
                passed[first..].sort_unstable();
            }
        }
        // One of the two sides of each sheet, the one with fewer hexes or else the first.
        let mut counts = vec![0; open.len()];
        passed.iter().for_each(|&(_, k)| counts[joined.root(k).0 as usize] += 1);
        let mut is_own: Vec<Option<bool>> = vec![None; open.len()];
        for (k, &side) in (0..).zip(open) {
            let other = place(self.beyond(side)).expect("both sides are open");
            let [here, there] = [k, other as u32].map(|k| joined.root(k).0 as usize);
            if here == there || is_own[here].is_some() {
                continue;
            }
            let is_here = match is_own[there] {
                Some(is_there) => !is_there,
                None => (counts[here], here) < (counts[there], there),
            };
            is_own[here] = Some(is_here);
            is_own[there].get_or_insert(!is_here);
        }
        let of_own = |(hex, k): (u32, u32)| {
            let along = joined.root(k).0;
            (is_own[along as usize] == Some(true)).then_some((hex, along))
        };
        Ok(passed.into_iter().filter_map(of_own).collect())
    }

    /// Turns around an edge of a side, through its hex and on, up to the next wall: the side on which that ends. Tells the
    /// hexes on the way but the first.
    fn turn(&self, side: Side, edge: [NodeId; 2], mut passes: impl FnMut(u32)) -> Side {
        let mut at = side;
        loop {
            let hex = hex_of(at).0;
            let has_edge = |f: FaceId| edge.iter().all(|n| self.faces.nodes[f.index()].contains(n));
            let of_hex = self.faces.of_hex[hex as usize];
            let on = (0..6).find(|&k| 6 * hex + k != at && has_edge(of_hex[k as usize]));
            let end = 6 * hex + on.expect("two faces of a hex have an edge");
            let Some([a, b]) = self.way(self.face(end)) else { return end };
            at = if a == end { b } else { a };
            passes(hex_of(at).0);
        }
    }
}
