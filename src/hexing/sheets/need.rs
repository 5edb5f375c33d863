//! Which groups of surfaces need a sheet: where a cell would be flat on the solid.
//!
//! A group needs one if
//! 1. a hex has two faces in it that share an edge, and no sharp curve runs there;
//! 2. an edge between it and another group has not exactly one hex, but for two in a thin wall;
//! 3. a quad of another group beside it has two edges on the curve between them, and no corner there;
//! 4. so has a quad of its own, at a curve within the group, whose hex has the quad across as well: collars need a hex
//!    for each.

use super::super::correspondence::Correspondence;
use super::boundary::{Boundary, BoundaryEdges, ascending};
use super::groups::Groups;
use crate::mesh::numbering::hex::EDGES;
use crate::mesh::quality::aspect;
use crate::mesh::{HexMesh, NodeId};
use crate::parallel;
use crate::solid::CurveId;

/// Hexes longer than so many times their shortest edge are those of a thin wall.
const THIN: f64 = 4.0;

/// What of the boundary is looked at.
pub(super) struct Look<'a> {
    pub(super) mesh: &'a HexMesh,
    pub(super) on: &'a Correspondence,
    pub(super) boundary: &'a Boundary,
    pub(super) groups: &'a Groups,
    edges: BoundaryEdges,
    /// Is a node at an edge on a curve?
    on_curve: Vec<bool>,
}

impl<'a> Look<'a> {
    pub(super) fn new(
        mesh: &'a HexMesh,
        on: &'a Correspondence,
        boundary: &'a Boundary,
        groups: &'a Groups,
    ) -> Self {
        let mut on_curve = vec![false; mesh.positions.len()];
        on.edges.iter().for_each(|(ends, _)| ends.iter().for_each(|n| on_curve[n.index()] = true));
        let edges = boundary.edges(|n| on_curve[n.index()]);
        Self { mesh, on, boundary, groups, edges, on_curve }
    }

    /// For each group: does it need a sheet?
    pub(super) fn needs(&self) -> Vec<bool> {
        let mut needs = vec![false; self.groups.bound()];
        let mut need = |group: u32| needs[group as usize] = true;
        self.bent_hexes().into_iter().for_each(&mut need);
        for edge in self.curve_edges() {
            let groups = edge.quads.map(|quad| self.group(quad));
            if groups[0] != groups[1] && edge.hexes != 1 && !self.is_mitred(&edge) {
                groups.into_iter().for_each(&mut need);
            }
        }
        for corner in self.flat_corners() {
            for &quad in &corner.across {
                let is_bent = || self.boundary.hex(quad) == self.boundary.hex(corner.quad);
                if self.group(quad) != self.group(corner.quad) || is_bent() {
                    need(self.group(quad));
                }
            }
        }
        needs
    }

    /// Do two hexes share the angle at an edge fairly, so thin that a layer beside them could not be opened? So it is where a
    /// thin wall turns.
    fn is_mitred(&self, edge: &CurveEdge) -> bool {
        let is_thin = |quad: u32| {
            let hex = &self.mesh.hexes[self.boundary.hex(quad)];
            aspect(&hex.map(|n| self.mesh.positions[n.index()])) > THIN
        };
        edge.hexes == 2 && !self.groups.is_thin(edge.curve) && edge.quads.into_iter().all(is_thin)
    }

    /// The group that a quad is of.
    pub(super) fn group(&self, quad: u32) -> u32 {
        self.groups.group(self.boundary.surface[quad as usize])
    }

    fn curve(&self, [a, b]: [NodeId; 2]) -> Option<CurveId> {
        self.on.curve_of(a, b)
    }

    /// The groups in which hexes have two faces that share an edge without a sharp curve.
    pub(super) fn bent_hexes(&self) -> Vec<u32> {
        let boundary = self.boundary;
        let mut bent = Vec::new();
        for of_hex in boundary.by_side().chunk_by(|&p, &q| boundary.hex(p) == boundary.hex(q)) {
            for (i, &p) in of_hex.iter().enumerate() {
                for &q in of_hex[..i].iter().filter(|&&q| self.group(q) == self.group(p)) {
                    let is_smooth = |ends| self.curve(ends).is_none_or(|curve| self.groups.is_flat(curve));
                    if shared_edge(boundary.quads[p as usize], boundary.quads[q as usize])
                        .is_some_and(is_smooth)
                    {
                        bent.push(self.group(p));
                    }
                }
            }
        }
        bent
    }

    /// The edges on curves, in the order of `on.edges`; those that have not two quads are left out.
    pub(super) fn curve_edges(&self) -> Vec<CurveEdge> {
        let is_near = |n: &NodeId| self.on_curve[n.index()];
        let found = parallel::gather(self.mesh.hexes.len(), |h, found: &mut Vec<u32>| {
            let hex = &self.mesh.hexes[h];
            // Most hexes are away from all curves.
            if !hex.iter().any(is_near) {
                return;
            }
            let near = hex.each_ref().map(is_near);
            for [a, b] in EDGES.map(|ends| ends.map(usize::from)) {
                if near[a] && near[b] {
                    let ends = ascending([hex[a], hex[b]]);
                    let place = self.on.edges.partition_point(|&(other, _)| other < ends);
                    if self.on.edges.get(place).is_some_and(|(other, _)| *other == ends) {
                        found.push(place as u32);
                    }
                }
            }
        });
        let mut counts = vec![0u32; self.on.edges.len()];
        found.into_iter().for_each(|place| counts[place as usize] += 1);
        let counted = self.on.edges.iter().zip(counts);
        let edge = |(&(ends, curve), hexes): (&([NodeId; 2], CurveId), u32)| {
            Some(CurveEdge { ends, curve, quads: self.edges.quads(ends)?, hexes })
        };
        counted.filter_map(edge).collect()
    }

    /// Corners of quads that would be flat on the solid, since both edges lie on curves and no corner is between them.
    pub(super) fn flat_corners(&self) -> Vec<FlatCorner> {
        parallel::gather(self.boundary.quads.len(), |quad, found: &mut Vec<FlatCorner>| {
            let (q, quad) = (quad as u32, &self.boundary.quads[quad]);
            for k in 0..4 {
                let [before, node, after] = [k + 3, k, k + 1].map(|k| quad[k % 4]);
                let anchor = self.on.anchors[node.index()];
                if !self.groups.is_wide(anchor, self.boundary.surface[q as usize]) {
                    continue;
                }
                let edges = [[before, node], [node, after]];
                if edges.iter().all(|&ends| self.curve(ends).is_some()) {
                    let across = edges.map(|ends| {
                        let other = self.edges.quads(ends).map(|[a, b]| if a == q { b } else { a });
                        other.unwrap_or(q)
                    });
                    found.push(FlatCorner { quad: q, node, across });
                }
            }
        })
    }
}

/// An edge on a curve.
pub(super) struct CurveEdge {
    /// The lesser node first.
    pub(super) ends: [NodeId; 2],
    pub(super) curve: CurveId,
    pub(super) quads: [u32; 2],
    /// How many hexes it has.
    pub(super) hexes: u32,
}

/// A corner of a quad that would be flat.
pub(super) struct FlatCorner {
    pub(super) quad: u32,
    pub(super) node: NodeId,
    /// The quads across its two edges.
    pub(super) across: [u32; 2],
}

/// The edge that two quads of a hex share.
fn shared_edge(p: [NodeId; 4], q: [NodeId; 4]) -> Option<[NodeId; 2]> {
    let mut shared = p.into_iter().filter(|n| q.contains(n));
    Some([shared.next()?, shared.next()?])
}

#[cfg(test)]
mod tests {
    use super::super::testing::{told, voxels};
    use super::*;
    use crate::geometry::Point;
    use crate::mesh::check_hexes;

    /// Two hexes of an angle whose outer sides, surfaces 0 and 1, meet at the origin, along y; each is as long as 4 such widths at
    /// 1.
    fn angle(width: f64) -> HexMesh {
        let mut mesh = voxels(&[[0, 0, 0], [1, 0, 0]]);
        for p in &mut mesh.positions {
            let outer = [[-4.0, 0.0], [0.0, 0.0], [0.0, -4.0]][p.x as usize];
            let inwards = [[0.0, -1.0], [-1.0, -1.0], [-1.0, 0.0]][p.x as usize];
            let [x, z] = [0, 1].map(|k| outer[k] + inwards[k] * width * p.z);
            *p = Point::new(x, -p.y, z);
        }
        assert_eq!(check_hexes(&mesh), []);
        mesh
    }

    /// Do the outer sides need a sheet? `is_sharp` leaves room for one hex alone at the edge between them.
    fn needs(width: f64, is_sharp: bool) -> [bool; 2] {
        let mesh = angle(width);
        let on = told(&mesh, |middle, normal| match (normal.x > 0.9, normal.z > 0.9) {
            (true, _) => 0,
            (_, true) => 1,
            _ if middle.y == 0.0 => 2,
            _ => 3,
        });
        let is_outer = |n: &NodeId| mesh.positions[n.index()].with_y(0.0) == Point::ZERO;
        let outer = on.edges.iter().find(|(ends, _)| ends.iter().all(is_outer)).expect("they meet");
        let given = Groups::given(&[0, 1, 2, 3], &vec![false; on.edges.len()]);
        let groups = if is_sharp { given.with_thin(&[outer.1]) } else { given };
        let boundary = Boundary::of(&mesh, &on);
        let needs = Look::new(&mesh, &on, &boundary, &groups).needs();
        [needs[0], needs[1]]
    }

    #[test]
    fn two_hexes_share_the_edge_of_a_thin_wall_that_turns() {
        assert_eq!(needs(1.0, false), [true; 2], "there is room for a layer");
        assert_eq!(needs(0.2, false), [false; 2]);
        assert_eq!(needs(0.2, true), [true; 2], "there is room for one hex alone");
    }
}
