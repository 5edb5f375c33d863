//! Does a correspondence hold what it promises?

use std::collections::{BTreeMap, BTreeSet};

use super::{Anchor, Correspondence, CurveFate};
use crate::mesh::topology::{Sets, hex_boundary};
use crate::mesh::{HexMesh, NodeId};
use crate::solid::{CornerId, CurveId, SolidModel, SurfaceId};

/// What a correspondence does not hold.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Fault {
    /// The anchors are not as many as the nodes, or the faces are not those of the boundary.
    NotOfThisMesh,
    /// Several nodes stand for a corner, or none where a captured curve ends.
    CornerNodes {
        /// The corner.
        corner: CornerId,
        /// Its nodes.
        nodes: Vec<NodeId>,
    },
    /// The edges of a captured curve are not one simple path between the nodes of its corners, or one simple cycle; or
    /// a curve that was given up has edges.
    NotAPath {
        /// The curve.
        curve: CurveId,
    },
    /// A node on an edge of the curve is anchored to something else than that curve and its corners.
    StrangeNode {
        /// The curve.
        curve: CurveId,
        /// The node.
        node: NodeId,
    },
    /// The faces at an edge are not those of the sides of its curve.
    WrongSides {
        /// The curve.
        curve: CurveId,
        /// The edge.
        edge: [NodeId; 2],
    },
    /// Two faces at an edge that no curve has are of different surfaces.
    OpenBorder {
        /// The edge.
        edge: [NodeId; 2],
    },
    /// A node's anchor does not follow from its edges and faces.
    WrongAnchor {
        /// The node.
        node: NodeId,
    },
    /// The faces of a surface, with those it stands for, are in more parts than these are.
    InParts {
        /// The surface that stands for them.
        surface: SurfaceId,
        /// How many parts the faces are in.
        parts: usize,
    },
    /// A surface has faces though another stands for it, or has none though it is not said to be lost.
    WrongLabel {
        /// The surface.
        surface: SurfaceId,
    },
}

/// Everything that a correspondence between a mesh and a solid does not hold of what [`Correspondence`] promises.
pub fn check_correspondence(mesh: &HexMesh, solid: &SolidModel, on: &Correspondence) -> Vec<Fault> {
    let boundary = hex_boundary(&mesh.hexes);
    let same = boundary.iter().map(|(nodes, _)| nodes).eq(on.faces.iter().map(|(nodes, _)| nodes));
    if !same || on.anchors.len() != mesh.positions.len() {
        return vec![Fault::NotOfThisMesh];
    }
    let checker = Checker::new(solid, on);
    let mut faults = checker.corners();
    for curve in (0..solid.curves().len()).map(CurveId::new) {
        faults.extend(checker.curve(curve));
    }
    faults.extend(checker.borders());
    faults.extend(checker.anchors());
    faults.extend(checker.surfaces());
    faults
}

struct Checker<'a> {
    solid: &'a SolidModel,
    on: &'a Correspondence,
    /// The face at the left of each directed edge of the boundary.
    left: BTreeMap<[NodeId; 2], usize>,
    /// The nodes of each corner.
    corners: BTreeMap<CornerId, Vec<NodeId>>,
    /// The edges of each curve.
    edges: BTreeMap<CurveId, Vec<[NodeId; 2]>>,
}

impl<'a> Checker<'a> {
    fn new(solid: &'a SolidModel, on: &'a Correspondence) -> Self {
        let mut left = BTreeMap::new();
        for (face, (nodes, _)) in on.faces.iter().enumerate() {
            for k in 0..4 {
                left.insert([nodes[k], nodes[(k + 1) % 4]], face);
            }
        }
        let mut corners: BTreeMap<CornerId, Vec<NodeId>> = BTreeMap::new();
        for (node, anchor) in on.anchors.iter().enumerate() {
            if let Anchor::Corner(corner) = anchor {
                corners.entry(*corner).or_default().push(NodeId::new(node));
            }
        }
        let mut edges: BTreeMap<CurveId, Vec<[NodeId; 2]>> = BTreeMap::new();
        for &(ends, curve) in &on.edges {
            edges.entry(curve).or_default().push(ends);
        }
        Self { solid, on, left, corners, edges }
    }

    fn surface(&self, face: usize) -> SurfaceId {
        self.on.faces[face].1
    }

    fn corner_node(&self, corner: CornerId) -> Option<NodeId> {
        self.corners.get(&self.on.reduction.corner(corner)).map(|nodes| nodes[0])
    }

    fn corners(&self) -> Vec<Fault> {
        let reduction = &self.on.reduction;
        let captured = |c: &CurveId| reduction.curve(*c) == CurveFate::Captured;
        let kept = (0..self.solid.curves().len()).map(CurveId::new).filter(captured);
        let ends = kept.filter_map(|c| self.solid.curves()[c.index()].ends);
        let mut named: BTreeSet<CornerId> = ends.flatten().map(|c| reduction.corner(c)).collect();
        named.extend(self.corners.keys());
        let nodes = |corner| self.corners.get(&corner).cloned().unwrap_or_default();
        let all = named.into_iter().map(|corner| (corner, nodes(corner)));
        let wrong = all.filter(|(corner, nodes)| nodes.len() != 1 || reduction.corner(*corner) != *corner);
        wrong.map(|(corner, nodes)| Fault::CornerNodes { corner, nodes }).collect()
    }

    fn curve(&self, curve: CurveId) -> Vec<Fault> {
        let edges = self.edges.get(&curve).map(Vec::as_slice).unwrap_or_default();
        if self.on.reduction.curve(curve) != CurveFate::Captured {
            return if edges.is_empty() { vec![] } else { vec![Fault::NotAPath { curve }] };
        }
        let Some(paths) = self.walks(curve, edges) else { return vec![Fault::NotAPath { curve }] };
        // A closed curve, or one from a corner back to it, may be walked either way: one of them has its sides.
        let faults = paths.iter().map(|path| self.path(curve, path));
        faults.min_by_key(Vec::len).unwrap_or_default()
    }

    /// The nodes of a curve's edges, in order from its start to its end, as far as that is known: a cycle both ways.
    fn walks(&self, curve: CurveId, edges: &[[NodeId; 2]]) -> Option<Vec<Vec<NodeId>>> {
        let mut around: BTreeMap<NodeId, Vec<NodeId>> = BTreeMap::new();
        for &[a, b] in edges {
            around.entry(a).or_default().push(b);
            around.entry(b).or_default().push(a);
        }
        let (start, end) = match self.solid.curves()[curve.index()].ends {
            Some([a, b]) => (self.corner_node(a)?, self.corner_node(b)?),
            None => (edges.first()?[0], edges.first()?[0]),
        };
        let mut path = vec![start];
        let mut before = None;
        loop {
            let at = *path.last()?;
            let ways = around.get(&at)?;
            let inner = at != start && at != end;
            let expected = if inner || start == end { 2 } else { 1 };
            if ways.len() != expected || path.len() > edges.len() + 1 {
                return None;
            }
            if path.len() > 1 && at == end {
                break;
            }
            let next = ways.iter().copied().find(|&n| Some(n) != before)?;
            before = Some(at);
            path.push(next);
        }
        if path.len() != edges.len() + 1 {
            return None;
        }
        let back = path.iter().rev().copied().collect();
        Some(if start == end { vec![path, back] } else { vec![path] })
    }

    fn path(&self, curve: CurveId, path: &[NodeId]) -> Vec<Fault> {
        let sides = self.solid.curves()[curve.index()].sides.map(|s| self.on.reduction.surface(s));
        let mut faults = Vec::new();
        for pair in path.windows(2) {
            let [a, b] = [pair[0], pair[1]];
            let faces = [self.left.get(&[a, b]), self.left.get(&[b, a])];
            if faces.map(|face| face.map(|&f| self.surface(f))) != sides.map(Some) {
                faults.push(Fault::WrongSides { curve, edge: [a, b] });
            }
        }
        let is_closed = self.solid.curves()[curve.index()].ends.is_none();
        let inside = if is_closed { path } else { &path[1..path.len() - 1] };
        let strange = inside.iter().filter(|node| self.on.anchors[node.index()] != Anchor::Curve(curve));
        faults.extend(strange.map(|&node| Fault::StrangeNode { curve, node }));
        faults
    }

    fn borders(&self) -> Vec<Fault> {
        let differ = |(&[a, b], &face): (&[NodeId; 2], &usize)| {
            let other = *self.left.get(&[b, a])?;
            let open = self.surface(face) != self.surface(other) && self.on.curve_of(a, b).is_none();
            (open && a < b).then_some(Fault::OpenBorder { edge: [a, b] })
        };
        self.left.iter().filter_map(differ).collect()
    }

    fn anchors(&self) -> Vec<Fault> {
        let mut expected = vec![Anchor::Inside; self.on.anchors.len()];
        for (nodes, surface) in &self.on.faces {
            nodes.iter().for_each(|node| expected[node.index()] = Anchor::Surface(*surface));
        }
        for (ends, curve) in &self.on.edges {
            ends.iter().for_each(|node| expected[node.index()] = Anchor::Curve(*curve));
        }
        // A corner stands where curves end, or within a surface.
        let agrees = |node: &usize| match (self.on.anchors[*node], expected[*node]) {
            (Anchor::Corner(_), Anchor::Curve(_) | Anchor::Surface(_)) => true,
            (anchor, expected) => anchor == expected,
        };
        let wrong = (0..expected.len()).filter(|node| !agrees(node));
        wrong.map(|node| Fault::WrongAnchor { node: NodeId::new(node) }).collect()
    }

    fn surfaces(&self) -> Vec<Fault> {
        let mut parts = Sets::new(self.on.faces.len());
        for (&[a, b], &face) in &self.left {
            let other = self.left.get(&[b, a]).copied();
            if let Some(other) = other.filter(|&other| self.surface(face) == self.surface(other)) {
                parts.join(face as u32, other as u32, false);
            }
        }
        let mut count = vec![0; self.solid.surfaces().len()];
        for root in parts.roots() {
            count[self.surface(root as usize).index()] += 1;
        }
        let reduction = &self.on.reduction;
        let mut faults = Vec::new();
        for surface in (0..count.len()).map(SurfaceId::new) {
            let parts = count[surface.index()];
            if (parts == 0) != reduction.members(surface).is_empty() {
                faults.push(Fault::WrongLabel { surface });
            } else if parts > 1 {
                faults.push(Fault::InParts { surface, parts });
            }
        }
        faults
    }
}
