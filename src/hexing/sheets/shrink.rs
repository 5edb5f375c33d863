//! Pillows a shrink set: some hexes draw back from the others, or from the boundary, and a new hex fills the gap at each
//! face of the interface between.
//!
//! ```text
//!   a---b---c        a---b---c     the interface a-b-c of a set that draws back downwards: the old nodes stay above,
//!   | S | S |   is   |   |   |     the set's hexes get copies a', b', c', and a new hex stands at each face
//!   d---e---f        a'--b'--c'
//!                    | S | S |
//!                    d---e---f
//! ```
//!
//! A **sheet** is the pillow of the set of all hexes whose interface is a part of the boundary: the set is open at the
//! rest. Where the interface ends, the new hexes' outer sides lie on the boundary beside it, and the copies with them.
//!
//! 1. The interface: sides of the set that are between it and other hexes, or are covered boundary quads.
//! 2. It has to be a manifold at each node: one fan of faces, closed, or open with both ends on the boundary.
//! 3. What each copy is on the solid: inside, or what remains of the boundary at its node once the interface's old
//!    nodes have gone.
//! 4. Copies, new hexes, boundary quads and curves' edges.

use super::super::correspondence::{Anchor, Correspondence};
use super::boundary::{Boundary, BoundaryEdges, NONE, ascending};
use crate::geometry::Point;
use crate::mesh::numbering::hex::FACES;
use crate::mesh::topology::{Sets, Side, hex_boundary, side_nodes};
use crate::mesh::{HexMesh, NodeId};
use crate::solid::{CurveId, SurfaceId};

/// How far a copy is moved from its node, as a share of the way to the middle of what it moves into.
const THICKNESS: f64 = 0.35;

/// The hexes that draw back.
pub(super) enum ShrinkSet<'a> {
    /// All hexes from these boundary quads.
    Sheet(&'a [u32]),
    /// These hexes, ascending, from all others. On the boundary they stay, but for the quads that are `covered`.
    Hexes { hexes: &'a [u32], covered: &'a [u32] },
}

/// What a pillow added.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Layer {
    /// The node that each new node, from this one on, is a copy of.
    pub(super) first_node: NodeId,
    pub(super) origins: Vec<NodeId>,
    /// The first of its hexes.
    pub(super) first_hex: u32,
}

/// Why a set is not pillowed: at these nodes the interface is no manifold, or a feature of the solid would be torn.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Torn(pub(super) Vec<NodeId>);

/// Pillows the set, or leaves everything as it is.
pub(super) fn pillow(
    mesh: &mut HexMesh,
    on: &mut Correspondence,
    boundary: &mut Boundary,
    set: &ShrinkSet,
) -> Result<Layer, Torn> {
    let interface = Interface::of(mesh, boundary, set);
    let rims = interface.rims()?;
    let edges = boundary.edges(|n| interface.place(n).is_some());
    let copies = Copies::of(&interface, &rims, on, boundary, &edges)?;
    Ok(copies.insert(mesh, on, boundary, &interface, &rims, &edges))
}

/// The faces at which new hexes come to stand.
struct Interface {
    /// The nodes of each face, anticlockwise seen from outside the set.
    faces: Vec<[NodeId; 4]>,
    /// The boundary quad that each is, if it is one.
    quads: Vec<u32>,
    /// Its nodes, ascending, and the place of each node of the mesh among them.
    nodes: Vec<NodeId>,
    places: Vec<u32>,
    /// The set's hexes; `None` for all.
    members: Option<Vec<bool>>,
    /// For each boundary quad: is it the set's, and open?
    open: Vec<bool>,
}

/// An edge at which the interface ends: the face, and which of its edges.
struct Rim {
    face: u32,
    edge: u8,
}

impl Interface {
    fn of(mesh: &HexMesh, boundary: &Boundary, set: &ShrinkSet) -> Self {
        let (quads, faces, members, open) = match set {
            ShrinkSet::Sheet(quads) => {
                let mut open = vec![true; boundary.quads.len()];
                quads.iter().for_each(|&q| open[q as usize] = false);
                let faces: Vec<[NodeId; 4]> = quads.iter().map(|&q| boundary.quads[q as usize]).collect();
                (quads.to_vec(), faces, None, open)
            }
            ShrinkSet::Hexes { hexes, covered } => {
                let mut members = vec![false; mesh.hexes.len()];
                hexes.iter().for_each(|&h| members[h as usize] = true);
                let mut open: Vec<bool> =
                    (0..boundary.quads.len()).map(|q| members[boundary.hex(q as u32)]).collect();
                covered.iter().for_each(|&q| open[q as usize] = false);
                let sides = sides_between(mesh, boundary, hexes, &open);
                let mut quads = vec![NONE; sides.len()];
                for &q in *covered {
                    let place = sides.binary_search(&boundary.sides[q as usize]);
                    quads[place.expect("covered quads are the members'")] = q;
                }
                let faces = sides.iter().map(|&side| side_nodes(&mesh.hexes, side)).collect();
                (quads, faces, Some(members), open)
            }
        };
        let mut nodes: Vec<NodeId> = faces.as_flattened().to_vec();
        nodes.sort_unstable();
        nodes.dedup();
        let mut places = vec![NONE; mesh.positions.len()];
        (0u32..).zip(&nodes).for_each(|(place, n)| places[n.index()] = place);
        Self { faces, quads, nodes, places, members, open }
    }

    fn place(&self, node: NodeId) -> Option<usize> {
        let place = self.places[node.index()];
        (place != NONE).then_some(place as usize)
    }

    fn has(&self, hex: usize) -> bool {
        self.members.as_ref().is_none_or(|members| members[hex])
    }

    /// The edges where the interface ends, if it is a manifold.
    fn rims(&self) -> Result<Vec<Rim>, Torn> {
        let mut uses: Vec<([NodeId; 2], u32, u8)> = Vec::with_capacity(4 * self.faces.len());
        for (f, face) in (0u32..).zip(&self.faces) {
            uses.extend((0..4u8).map(|k| {
                let k_next = usize::from(k + 1) % 4;
                (ascending([face[usize::from(k)], face[k_next]]), f, k)
            }));
        }
        uses.sort_unstable();
        let (mut rims, mut torn) = (Vec::new(), Vec::new());
        // Corner `4 * f + k` of the faces, joined around each node.
        let mut fans = Sets::new(4 * self.faces.len());
        for shared in uses.chunk_by(|a, b| a.0 == b.0) {
            match *shared {
                [(_, face, edge)] => rims.push(Rim { face, edge }),
                [(ends, f, k), (_, g, l)] => ends.iter().for_each(|&end| {
                    fans.join(self.corner(f, k, end), self.corner(g, l, end), false);
                }),
                _ => torn.extend(shared[0].0),
            }
        }
        let mut fan_count = vec![0u32; self.nodes.len()];
        for root in fans.roots() {
            fan_count[self.places[self.faces.as_flattened()[root as usize].index()] as usize] += 1;
        }
        torn.extend(self.nodes.iter().zip(fan_count).filter(|&(_, fans)| fans > 1).map(|(&n, _)| n));
        if torn.is_empty() { Ok(rims) } else { Err(torn_at(torn)) }
    }

    /// The ends of a rim.
    fn rim(&self, rim: &Rim) -> [NodeId; 2] {
        let face = self.faces[rim.face as usize];
        [0, 1].map(|k| face[(usize::from(rim.edge) + k) % 4])
    }

    /// The corner of face `f` at `end`, which is an end of its edge `k`.
    fn corner(&self, f: u32, k: u8, end: NodeId) -> u32 {
        let at_start = self.faces[f as usize][usize::from(k)] == end;
        4 * f + u32::from(if at_start { k } else { (k + 1) % 4 })
    }
}

/// The sides of `hexes` that are neither shared by two of them nor `open` boundary quads.
fn sides_between(mesh: &HexMesh, boundary: &Boundary, hexes: &[u32], open: &[bool]) -> Vec<Side> {
    let sides = hexes.iter().flat_map(|&h| (6 * h..).take(FACES.len()));
    let mut keyed: Vec<([NodeId; 4], Side)> =
        sides.map(|side| (sorted(side_nodes(&mesh.hexes, side)), side)).collect();
    keyed.sort_unstable();
    let mut on_boundary: Vec<Side> =
        (0..open.len()).filter(|&q| open[q]).map(|q| boundary.sides[q]).collect();
    on_boundary.sort_unstable();
    let mut single: Vec<Side> = keyed
        .chunk_by(|a, b| a.0 == b.0)
        .filter(|shared| shared.len() == 1 && on_boundary.binary_search(&shared[0].1).is_err())
        .map(|shared| shared[0].1)
        .collect();
    single.sort_unstable();
    single
}

fn torn_at(mut nodes: Vec<NodeId>) -> Torn {
    nodes.sort_unstable();
    nodes.dedup();
    Torn(nodes)
}

/// What the copies are on the solid.
struct Copies {
    /// By place in the interface.
    anchors: Vec<Anchor>,
    /// For each rim the open boundary quad beside it.
    beside: Vec<u32>,
}

impl Copies {
    fn of(
        interface: &Interface,
        rims: &[Rim],
        on: &Correspondence,
        boundary: &Boundary,
        edges: &BoundaryEdges,
    ) -> Result<Self, Torn> {
        let mut torn = Vec::new();
        let is_open = |&q: &u32| interface.open[q as usize];
        let mut rims_at = vec![0u8; interface.nodes.len()];
        let mut beside = Vec::with_capacity(rims.len());
        for rim in rims {
            let ends = interface.rim(rim);
            ends.iter().for_each(|&n| rims_at[interface.places[n.index()] as usize] += 1);
            match edges.quads(ends) {
                Some([p, q]) if is_open(&p) != is_open(&q) => beside.push(if is_open(&p) { p } else { q }),
                _ => torn.extend(ends),
            }
        }
        let mut anchors = vec![Anchor::Inside; interface.nodes.len()];
        // Copies stay on the surface of the open quads at their node,
        for q in (0..boundary.quads.len()).filter(|&q| interface.open[q]) {
            let surface = Anchor::Surface(boundary.surface[q]);
            for (place, node) in boundary.quads[q].iter().filter_map(|&n| Some((interface.place(n)?, n))) {
                // which has to lie at the end of the interface.
                if rims_at[place] != 2 {
                    torn.push(node);
                }
                anchors[place] = surface;
            }
        }
        // or on the one curve between such quads.
        for &(ends, curve) in &on.edges {
            if edges.quads(ends).is_some_and(|quads| quads.iter().all(is_open)) {
                for (place, node) in ends.iter().filter_map(|&n| Some((interface.place(n)?, n))) {
                    match anchors[place] {
                        Anchor::Curve(_) => torn.push(node),
                        _ => anchors[place] = Anchor::Curve(curve),
                    }
                }
            }
        }
        if torn.is_empty() { Ok(Self { anchors, beside }) } else { Err(torn_at(torn)) }
    }

    fn insert(
        self,
        mesh: &mut HexMesh,
        on: &mut Correspondence,
        boundary: &mut Boundary,
        interface: &Interface,
        rims: &[Rim],
        edges: &BoundaryEdges,
    ) -> Layer {
        let first_node = NodeId::new(mesh.positions.len());
        let first_hex = mesh.hexes.len() as u32;
        let copy = |n: NodeId| interface.place(n).map_or(n, |place| NodeId(first_node.0 + place as u32));
        let points = self.points(mesh, boundary, interface);
        mesh.positions.extend(points);
        for h in (0..mesh.hexes.len()).filter(|&h| interface.has(h)) {
            mesh.hexes[h] = mesh.hexes[h].map(copy);
        }
        let outer = |face: &[NodeId; 4]| {
            let [a, b, c, d] = *face;
            [copy(a), copy(b), copy(c), copy(d), a, b, c, d]
        };
        mesh.hexes.extend(interface.faces.iter().map(outer));

        // The two quads at a curve's edge are looked at before they change.
        let is_open = |q: &u32| interface.open[*q as usize];
        for (ends, _) in &mut on.edges {
            if edges.quads(*ends).is_some_and(|quads| quads.iter().all(is_open)) {
                *ends = ascending(ends.map(copy));
            }
        }
        let branches = interface.nodes.iter().zip(&self.anchors).filter_map(|(&n, anchor)| match *anchor {
            Anchor::Curve(curve) => Some((ascending([n, copy(n)]), curve)),
            _ => None,
        });
        on.edges.extend(branches.collect::<Vec<([NodeId; 2], CurveId)>>());
        on.edges.sort_unstable();
        on.anchors.extend_from_slice(&self.anchors);

        for (f, &q) in (0u32..).zip(&interface.quads).filter(|(_, q)| **q != NONE) {
            boundary.sides[q as usize] = 6 * (first_hex + f) + 1;
        }
        for q in (0..boundary.quads.len()).filter(|&q| interface.open[q]) {
            boundary.quads[q] = boundary.quads[q].map(copy);
        }
        for (rim, &beside) in rims.iter().zip(&self.beside) {
            // Corners 4 and 5 of the new hex are those of the face's edge 0, whose side is face 2, and so on.
            let side = 6 * (first_hex + rim.face) + 2 + u32::from(rim.edge);
            boundary.sides.push(side);
            boundary.quads.push(side_nodes(&mesh.hexes, side));
            boundary.surface.push(boundary.surface[beside as usize]);
        }
        Layer { first_node, origins: interface.nodes.clone(), first_hex }
    }

    /// Where copies come to be: towards the middle of the open quads at their node, or of the set's hexes there.
    fn points(&self, mesh: &HexMesh, boundary: &Boundary, interface: &Interface) -> Vec<Point> {
        let position = |n: &NodeId| mesh.positions[n.index()];
        let mut sums = vec![(Point::ZERO, 0.0); interface.nodes.len()];
        let mut add = |nodes: &[NodeId], is_inside: bool| {
            let touched = || nodes.iter().filter_map(|&n| interface.place(n));
            if touched().next().is_some() {
                let middle = nodes.iter().map(position).sum::<Point>() / nodes.len() as f64;
                for place in touched().filter(|&p| (self.anchors[p] == Anchor::Inside) == is_inside) {
                    sums[place].0 += middle;
                    sums[place].1 += 1.0;
                }
            }
        };
        (0..mesh.hexes.len()).filter(|&h| interface.has(h)).for_each(|h| add(&mesh.hexes[h], true));
        (0..boundary.quads.len()).filter(|&q| interface.open[q]).for_each(|q| add(&boundary.quads[q], false));
        let moved = |(n, &(sum, count)): (&NodeId, &(Point, f64))| {
            let from = position(n);
            if count > 0.0 { from.lerp(sum / count, THICKNESS) } else { from }
        };
        interface.nodes.iter().zip(&sums).map(moved).collect()
    }
}

impl Layer {
    /// What a node was before the layer was inserted.
    pub(super) fn origin(&self, node: NodeId) -> NodeId {
        if node < self.first_node { node } else { self.origins[(node.0 - self.first_node.0) as usize] }
    }

    /// Takes the layer back. It has to be the last one inserted.
    pub(super) fn take_back(&self, mesh: &mut HexMesh, on: &mut Correspondence) {
        self.take_back_to(mesh, on, |n| self.origin(n));
    }

    /// Takes the layer and all after it back: every new node becomes its `origin` before them, and what falls together is
    /// gone. Nodes stay where they are.
    pub(super) fn take_back_to(
        &self,
        mesh: &mut HexMesh,
        on: &mut Correspondence,
        origin: impl Fn(NodeId) -> NodeId,
    ) {
        mesh.hexes.truncate(self.first_hex as usize);
        for hex in &mut mesh.hexes {
            *hex = hex.map(&origin);
        }
        mesh.positions.truncate(self.first_node.index());
        on.anchors.truncate(self.first_node.index());
        for (ends, _) in &mut on.edges {
            *ends = ascending(ends.map(&origin));
        }
        on.edges.retain(|([a, b], _)| a != b);
        on.edges.sort_unstable();
        let mut surfaces: Vec<([NodeId; 4], SurfaceId)> =
            on.faces.iter().map(|&(quad, surface)| (sorted(quad.map(&origin)), surface)).collect();
        surfaces.sort_unstable();
        let surface = |quad: [NodeId; 4]| {
            let place = surfaces.partition_point(|&(key, _)| key < sorted(quad));
            surfaces[place].1
        };
        on.faces = hex_boundary(&mesh.hexes).into_iter().map(|(quad, _)| (quad, surface(quad))).collect();
    }
}

fn sorted(mut quad: [NodeId; 4]) -> [NodeId; 4] {
    quad.sort_unstable();
    quad
}
