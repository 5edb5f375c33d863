//! Wedges: curves at which two surfaces of one group meet so sharply that there is room for one hex alone. The sheet over
//! the group leaves two there.
//!
//! ```text
//!   across the curve v, surface A above and B below:
//!
//!   a-------b                a-------b      the two hexes at v draw back from A; they stay on B. What fills the gap over
//!    \   U   \               |\ new  / \     A is the one hex at v. Behind it, between a and b, there is another, and
//!  v--+-------m    is         v-----v'--U-m  beside V on B one more
//!    /   V   /                    \--V---/
//! ```
//!
//! 1. The row: the edges of a thin curve with two hexes. Where the row would end at a curve that is sharp too and has two
//!    hexes as well, it turns there: a third hex would be as thin.
//! 2. The hexes at the row draw back from the others, and from the quads on one side of it (`shrink`). The side is that
//!    where the row does more: where it turns to another thin curve this needs no wedge of its own, and there stays one hex
//!    at the corner between them. Else it is the shorter row; where that would be pinched, the other.
//! 3. Where a row ends, the surface that it lies on gets one quad more at the corner, and so does that behind the next curve.
//!    Where that curve is flat and the one after it is sharp, and no more end there, all hexes at the corner draw back together
//!    instead: it is left with two.

use std::collections::BTreeSet;

use super::super::correspondence::Correspondence;
use super::boundary::{Boundary, ascending};
use super::groups::Groups;
use super::layers::{Layers, Purpose};
use super::need::{CurveEdge, Look};
use super::shrink::{ShrinkSet, Torn, pillow};
use super::sides::Sides;
use crate::mesh::{HexMesh, NodeId};
use crate::solid::{CurveId, SurfaceId};
use crate::{Cancelled, Monitor};

/// Pillows the hexes at thin curves that the `layers` take wedges at. The nodes at which a row would have been pinched: it
/// is left as it was.
pub(super) fn insert(
    mesh: &mut HexMesh,
    on: &mut Correspondence,
    boundary: &mut Boundary,
    groups: &Groups,
    layers: &mut Layers,
    monitor: &dyn Monitor,
) -> Result<Vec<NodeId>, Cancelled> {
    let edges = Look::new(mesh, on, boundary, groups).curve_edges();
    let is_thin =
        |edge: &&CurveEdge| edge.hexes == 2 && groups.is_thin(edge.curve) && layers.takes_wedge(edge.curve);
    let mut thin: Vec<CurveId> = edges.iter().filter(is_thin).map(|edge| edge.curve).collect();
    thin.sort_unstable();
    thin.dedup();
    let mut pinched = Vec::new();
    for curve in thin {
        monitor.proceed()?;
        let mut torn = Vec::new();
        for Row { hexes, covered, .. } in rows(curve, &Look::new(mesh, on, boundary, groups)) {
            match pillow(mesh, on, boundary, &ShrinkSet::Hexes { hexes: &hexes, covered: &covered }) {
                Ok(layer) => {
                    layers.push(layer, Purpose::Wedge(curve));
                    torn.clear();
                    break;
                }
                Err(Torn(nodes)) => torn = nodes,
            }
        }
        pinched.extend(torn);
    }
    Ok(pinched)
}

/// What draws back, and from which quads.
struct Row {
    hexes: Vec<u32>,
    covered: Vec<u32>,
    /// How many edges of thin curves it is along.
    thin: usize,
    /// At how many of its ends all hexes of the corner draw back.
    rounded: usize,
}

impl Row {
    /// The quads that it takes, less two for each thin edge: a wedge of its own would take a quad there, and where such
    /// wedges meet they leave hexes for which there is no room. An end where all hexes of the corner draw back spares as much.
    fn cost(&self) -> isize {
        self.covered.len() as isize - 2 * (self.thin + self.rounded) as isize
    }
}

/// The rows along a curve, one on each of its sides, the better one first.
fn rows(curve: CurveId, look: &Look<'_>) -> Vec<Row> {
    let mut edges = look.curve_edges();
    edges.retain(|edge| edge.hexes == 2);
    let along: Vec<usize> = (0..edges.len()).filter(|&e| edges[e].curve == curve).collect();
    let surface = |quad: u32| look.boundary.surface[quad as usize];
    let mut surfaces: Vec<SurfaceId> = along.iter().flat_map(|&e| edges[e].quads).map(surface).collect();
    surfaces.sort_unstable();
    surfaces.dedup();
    let sides = Sides::of(look.on, look.boundary);
    let row = |on: SurfaceId| Walk { look, sides: &sides, edges: &edges, on }.row(&along);
    let mut rows: Vec<Row> = surfaces.into_iter().filter_map(row).collect();
    rows.sort_by_key(|row| (row.cost(), row.covered.len()));
    rows
}

/// Follows the border of a surface.
struct Walk<'a> {
    look: &'a Look<'a>,
    sides: &'a Sides<'a>,
    /// The edges on curves that have two hexes, by their ends.
    edges: &'a [CurveEdge],
    on: SurfaceId,
}

impl Walk<'_> {
    /// The row of all edges that are reached from the given ones. None if both sides of one are the same surface.
    fn row(&self, from: &[usize]) -> Option<Row> {
        let mut reached = vec![false; self.edges.len()];
        from.iter().for_each(|&e| reached[e] = true);
        let mut next = from.to_vec();
        let (mut covered, mut beside) = (BTreeSet::new(), BTreeSet::new());
        let mut rounded = 0;
        while let Some(e) = next.pop() {
            let edge = &self.edges[e];
            let [inner, outer] = self.quads(edge)?;
            covered.insert(inner);
            beside.insert(outer);
            for node in edge.ends {
                let [around, across] = [inner, outer].map(|quad| self.sides.around(quad, node));
                if let Some(ahead) = self.ahead(edge, inner, node, &around) {
                    // The row goes on: all quads between belong to it.
                    covered.extend(around);
                    beside.extend(across);
                    if !std::mem::replace(&mut reached[ahead], true) {
                        next.push(ahead);
                    }
                } else if let Some(last) = self.behind_flat(edge, inner, node, &across) {
                    covered.insert(last);
                    beside.extend(across);
                    rounded += 1;
                }
            }
        }
        let hexes = self.look.boundary.hexes(covered.iter().chain(&beside).copied());
        let is_thin =
            |&(edge, &reached): &(&CurveEdge, &bool)| reached && self.look.groups.is_thin(edge.curve);
        let thin = self.edges.iter().zip(&reached).filter(is_thin).count();
        Some(Row { hexes, covered: covered.into_iter().collect(), thin, rounded })
    }

    /// The quad of an edge on the surface, and that across.
    fn quads(&self, edge: &CurveEdge) -> Option<[u32; 2]> {
        let is_here = |quad: u32| self.look.boundary.surface[quad as usize] == self.on;
        match edge.quads.map(is_here) {
            [true, false] => Some(edge.quads),
            [false, true] => Some([edge.quads[1], edge.quads[0]]),
            _ => None,
        }
    }

    /// The quad behind a flat curve that ends at `node` beside the row's last `quad`, if nothing but a sharp curve is between it
    /// and the quads `across` the row.
    fn behind_flat(&self, edge: &CurveEdge, quad: u32, node: NodeId, across: &[u32]) -> Option<u32> {
        let (flat, behind) = self.other_side(quad, node, edge.ends)?;
        let (sharp, last) = self.other_side(behind, node, flat.ends)?;
        let is_flat = |edge: &CurveEdge| self.look.groups.is_flat(edge.curve);
        (is_flat(flat) && !is_flat(sharp) && across.contains(&last)).then_some(behind)
    }

    /// The edge of a quad at a node that is not `before`, if it is on a curve, and the quad across it.
    fn other_side(&self, quad: u32, node: NodeId, before: [NodeId; 2]) -> Option<(&CurveEdge, u32)> {
        let mut out = self.sides.neighbours(quad, node).into_iter().map(|n| ascending([node, n]));
        let edge = &self.edges[self.place(out.find(|&ends| ends != before)?)?];
        let [a, b] = edge.quads;
        Some((edge, if a == quad { b } else { a }))
    }

    /// The place of the edge between two nodes.
    fn place(&self, ends: [NodeId; 2]) -> Option<usize> {
        self.edges.binary_search_by_key(&ends, |edge| edge.ends).ok()
    }

    /// The place of the edge on which the row goes on after `node`: of the same curve, or of one that is sharp and ends at
    /// the same quad.
    fn ahead(&self, edge: &CurveEdge, quad: u32, node: NodeId, around: &[u32]) -> Option<usize> {
        let mut out =
            around.iter().flat_map(|&q| self.sides.neighbours(q, node)).map(|n| ascending([node, n]));
        let ahead = out.find_map(|ends| self.place(ends).filter(|_| ends != edge.ends))?;
        let other = self.edges[ahead].curve;
        let is_sharp = || around == [quad] && !self.look.groups.is_flat(other);
        (other == edge.curve || is_sharp()).then_some(ahead)
    }
}

#[cfg(test)]
mod tests;
