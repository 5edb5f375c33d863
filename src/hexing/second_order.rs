//! Hexes of the second order, whose nodes on the boundary are on the solid (beyond the paper).
//!
//! 1. Nodes beside the corners stand in the middle: straight hexes.
//! 2. Those on boundary edges go to the curve or surface that the edge stands for, those on boundary faces (27 nodes)
//!    to their surface. Where a corner is off the solid its edges and faces stay straight.
//! 3. Where a hex is then not certainly positive, by Bernstein's bound, or far worse than it was, its nodes go back half
//!    of the way, and in the end all of it: straight hexes are positive.

use serde::Serialize;

use super::correspondence::Anchor;
use super::fit::{OnSolid, Target};
use super::meshed::Meshed;
use crate::geometry::Point;
use crate::mesh::numbering::hex::{EDGES_OF_FACE, FACES};
use crate::mesh::quality::second_order_jacobian;
use crate::mesh::second_order::{MiddleNodes, middle_of_face};
use crate::mesh::{FaceId, HexMesh, NodeId, SecondOrder, SecondOrderHex};
use crate::solid::{CurveId, SolidModel, SurfaceId};
use crate::{Cancelled, Monitor, Stage, parallel};

const SECOND_ORDER: Stage = Stage("second order");

/// The least Jacobian of a hex is at least this share of what it is with straight edges, by their bounds.
const LEAST: f64 = 0.2;

/// A corner is on the solid if it is nearer than this share of an edge.
const ON: f64 = 1e-6;

/// A node that would go farther than this share of its edge stays: the surface turns too much there.
const FARTHEST: f64 = 0.5;

/// How much of the way to the solid a node may go, one after the other.
const WAYS: [f64; 5] = [1.0, 0.5, 0.25, 0.125, 0.0];

/// What came of it.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct SecondOrderReport {
    /// The kind of hex.
    pub hex: SecondOrderHex,
    /// Nodes beside the corners.
    pub nodes: usize,
    /// How many of them are on the solid.
    pub on_solid: usize,
    /// How many had to stay off it for the sake of their hexes.
    pub yielded: usize,
    /// How far the farthest of these is from it, in model units.
    pub farthest: f64,
    /// Where that is.
    pub place: Option<[f64; 3]>,
}

impl SecondOrderReport {
    fn none(hex: SecondOrderHex) -> Self {
        Self { hex, nodes: 0, on_solid: 0, yielded: 0, farthest: 0.0, place: None }
    }

    fn add(&mut self, other: &Self) {
        self.nodes += other.nodes;
        self.on_solid += other.on_solid;
        self.yielded += other.yielded;
        if other.farthest > self.farthest {
            (self.farthest, self.place) = (other.farthest, other.place);
        }
    }
}

/// What a boundary stands for.
struct Standing<'a> {
    /// All boundary quads in order, each with its surface.
    faces: &'a [([NodeId; 4], SurfaceId)],
    /// Boundary edges on curves, the lesser node first, sorted.
    edges: &'a [([NodeId; 2], CurveId)],
    target: &'a dyn Target,
}

/// Makes the hexes of `mesh` hexes of the second order.
fn second_order(
    mesh: &HexMesh,
    standing: &Standing<'_>,
    hex: SecondOrderHex,
    monitor: &dyn Monitor,
) -> Result<(SecondOrder, SecondOrderReport), Cancelled> {
    monitor.checkpoint(SECOND_ORDER, 0.0)?;
    let mut bending = Bending::new(mesh, standing, hex, monitor)?;
    // Nodes that go back can press on the next hex, so that bad ones move through the mesh: until none is left. Each round
    // brings a node nearer to where all hexes are straight.
    for round in 1_u32.. {
        monitor.checkpoint(SECOND_ORDER, 1.0 - 1.0 / f64::from(round + 1))?;
        let bad = bending.bad(&bending.bent(), monitor)?;
        if bad.is_empty() {
            break;
        }
        bending.step_back(&bad);
    }
    monitor.checkpoint(SECOND_ORDER, 1.0)?;
    Ok(bending.done())
}

/// Bodies of the second order, one after the other.
pub(super) struct SecondOrderBodies {
    made: SecondOrder,
    report: SecondOrderReport,
    /// For each body its first corner node and how many it has, its first other node, and its first entry in `nodes`.
    starts: Vec<[usize; 4]>,
}

impl SecondOrderBodies {
    pub(super) fn new(hex: SecondOrderHex) -> Self {
        Self {
            made: SecondOrder { hex, positions: Vec::new(), nodes: Vec::new() },
            report: SecondOrderReport::none(hex),
            starts: Vec::new(),
        }
    }

    /// Adds a body whose corner nodes come after `first` others.
    pub(super) fn add(
        &mut self,
        meshed: &Meshed,
        solid: &SolidModel,
        first: usize,
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        let Meshed { mesh, on, .. } = meshed;
        let standing =
            Standing { faces: &on.faces, edges: &on.edges, target: &OnSolid::new(solid, &on.reduction) };
        let (made, report) = second_order(mesh, &standing, self.made.hex, monitor)?;
        self.starts.push([first, mesh.positions.len(), self.made.positions.len(), self.made.nodes.len()]);
        self.made.positions.extend(made.positions);
        self.made.nodes.extend(made.nodes);
        self.report.add(&report);
        Ok(())
    }

    /// All of them as hexes of one mesh with so many corner nodes.
    pub(super) fn joined(mut self, corners: usize) -> (SecondOrder, SecondOrderReport) {
        let ends = self.starts.iter().skip(1).map(|start| start[3]).chain([self.made.nodes.len()]);
        let ends: Vec<usize> = ends.collect();
        for (&[first, own, other, from], to) in self.starts.iter().zip(ends) {
            for node in &mut self.made.nodes[from..to] {
                let id = node.index();
                *node = NodeId::new(if id < own { first + id } else { corners + other + (id - own) });
            }
        }
        (self.made, self.report)
    }
}

/// Nodes on the way to the solid.
struct Bending<'a> {
    mesh: &'a HexMesh,
    hex: SecondOrderHex,
    middle: MiddleNodes,
    /// By edge: its middle, and the place on the solid that this belongs to.
    edges: Vec<(Point, Option<Point>)>,
    /// By face: its surface, if its corners are on that.
    faces: Vec<Option<SurfaceId>>,
    target: &'a dyn Target,
    /// By edge and face: how often they stepped back.
    steps: [Vec<u8>; 2],
}

impl<'a> Bending<'a> {
    fn new(
        mesh: &'a HexMesh,
        standing: &Standing<'a>,
        hex: SecondOrderHex,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let middle = MiddleNodes::of(mesh, monitor)?;
        let (of_edges, of_faces) = anchors(&middle, standing);
        let at = |n: NodeId| mesh.positions[n.index()];
        let is_on = |anchor: Anchor, n: NodeId, length: f64| {
            let foot = standing.target.foot(anchor, at(n));
            foot.is_some_and(|foot| foot.point.distance(at(n)) <= ON * length)
        };
        let edges = parallel::try_collect(middle.edges.ends.len(), monitor, |e| {
            let ends = middle.edges.ends[e];
            let [a, b] = ends.map(at);
            let (straight, anchor, length) = (a.midpoint(b), of_edges[e], a.distance(b));
            let foot = standing.target.foot(anchor, straight).map(|foot| foot.point);
            let is_good = |foot: &Point| {
                foot.distance(straight) <= FARTHEST * length && ends.iter().all(|&n| is_on(anchor, n, length))
            };
            (straight, foot.filter(is_good))
        })?;
        let faces = parallel::try_collect(of_faces.len(), monitor, |f| {
            let surface = of_faces[f].filter(|_| hex == SecondOrderHex::Hex27)?;
            let corners = middle.faces.nodes[f];
            let length = at(corners[0]).distance(at(corners[2]));
            let is_on = |&n: &NodeId| is_on(Anchor::Surface(surface), n, length);
            corners.iter().all(is_on).then_some(surface)
        })?;
        let steps = [vec![0; edges.len()], vec![0; faces.len()]];
        Ok(Self { mesh, hex, middle, edges, faces, target: standing.target, steps })
    }

    /// The hexes with an edge or face that is bent.
    fn bent(&self) -> Vec<u32> {
        parallel::filter(self.mesh.hexes.len(), |h| {
            let mut edges = self.middle.edges.of_hex[h].iter().map(|e| e.index());
            let mut faces = self.middle.faces.of_hex[h].iter().map(|f| f.index());
            edges.any(|e| self.edges[e].1.is_some() && self.steps[0][e] + 1 < WAYS.len() as u8)
                || faces.any(|f| self.faces[f].is_some() && self.steps[1][f] + 1 < WAYS.len() as u8)
        })
    }

    fn on_edge(&self, e: usize) -> Point {
        let (straight, foot) = self.edges[e];
        foot.map_or(straight, |foot| straight.lerp(foot, WAYS[usize::from(self.steps[0][e])]))
    }

    /// Where the node on face `f` is. Edges that are bent bend the face.
    fn on_face(&self, f: usize) -> Point {
        let side = self.middle.faces.sides(FaceId::new(f))[0] as usize;
        let (h, k) = (side / 6, side % 6);
        let corners = FACES[k].map(|c| self.mesh.positions[self.mesh.hexes[h][usize::from(c)].index()]);
        let edges =
            EDGES_OF_FACE[k].map(|e| self.on_edge(self.middle.edges.of_hex[h][usize::from(e)].index()));
        let middle = middle_of_face(corners, edges);
        match self.foot_of_face(f, middle) {
            Some(foot) => middle.lerp(foot, WAYS[usize::from(self.steps[1][f])]),
            None => middle,
        }
    }

    fn foot_of_face(&self, f: usize, from: Point) -> Option<Point> {
        Some(self.target.foot(Anchor::Surface(self.faces[f]?), from)?.point)
    }

    /// The 27 nodes of a hex as they are, and with straight edges.
    fn nodes(&self, h: usize) -> [[Point; 27]; 2] {
        let bent = self.middle.lattice(self.mesh, h, |e| self.on_edge(e), |f| self.on_face(f));
        let straight_edge = |e: usize| self.edges[e].0;
        let middle = |f: usize| self.middle.faces.nodes[f].iter().map(|n| self.mesh.positions[n.index()]);
        let straight_face = |f: usize| middle(f).sum::<Point>() * 0.25;
        [bent, self.middle.lattice(self.mesh, h, straight_edge, straight_face)]
    }

    /// Those of the hexes that are not as good as they have to be.
    fn bad(&self, suspects: &[u32], monitor: &dyn Monitor) -> Result<Vec<u32>, Cancelled> {
        let is_bad = parallel::try_collect(suspects.len(), monitor, |k| {
            let [bent, straight] =
                self.nodes(suspects[k] as usize).map(|nodes| second_order_jacobian(&nodes).lower);
            // Written so that numbers that are none are bad.
            !(bent > 0.0 && bent >= LEAST * straight)
        })?;
        Ok(suspects.iter().zip(is_bad).filter(|(_, bad)| *bad).map(|(&h, _)| h).collect())
    }

    /// Lets the edges and faces of hexes go back a step, each once.
    fn step_back(&mut self, hexes: &[u32]) {
        let of_hexes = |ids: &mut dyn FnMut(usize) -> Vec<usize>| {
            let mut all: Vec<usize> = hexes.iter().flat_map(|&h| ids(h as usize)).collect();
            all.sort_unstable();
            all.dedup();
            all
        };
        let edges = of_hexes(&mut |h| self.middle.edges.of_hex[h].map(|e| e.index()).to_vec());
        let faces = of_hexes(&mut |h| self.middle.faces.of_hex[h].map(|f| f.index()).to_vec());
        for (steps, ids) in self.steps.iter_mut().zip([edges, faces]) {
            for id in ids {
                steps[id] = (steps[id] + 1).min(WAYS.len() as u8 - 1);
            }
        }
    }

    fn done(self) -> (SecondOrder, SecondOrderReport) {
        let on_edges = parallel::collect(self.edges.len(), |e| self.on_edge(e));
        let on_faces = parallel::collect(self.faces.len(), |f| self.on_face(f));
        let of_edges = self.edges.iter().zip(&on_edges).zip(&self.steps[0]);
        let of_faces = on_faces.iter().enumerate().map(|(f, &at)| (self.foot_of_face(f, at), at));
        let nodes = of_edges
            .map(|((&(_, foot), &at), &steps)| (foot, at, steps))
            .chain(of_faces.zip(&self.steps[1]).map(|((foot, at), &steps)| (foot, at, steps)));
        let mut report = SecondOrderReport::none(self.hex);
        for (foot, at, steps) in nodes {
            match foot {
                Some(_) if steps == 0 => report.on_solid += 1,
                Some(foot) => {
                    report.yielded += 1;
                    if foot.distance(at) > report.farthest {
                        report.farthest = foot.distance(at);
                        report.place = Some(at.to_array());
                    }
                }
                None => {}
            }
        }
        let made = self.middle.second_order(self.mesh, self.hex, on_edges, on_faces);
        report.nodes = made.positions.len();
        (made, report)
    }
}

/// What each edge and each face stands for.
fn anchors(middle: &MiddleNodes, standing: &Standing<'_>) -> (Vec<Anchor>, Vec<Option<SurfaceId>>) {
    let mut of_edges = vec![Anchor::Inside; middle.edges.ends.len()];
    let mut of_faces = vec![None; middle.faces.nodes.len()];
    let mut surfaces = standing.faces.iter().map(|&(_, surface)| surface);
    for (edges, faces) in middle.edges.of_hex.iter().zip(&middle.faces.of_hex) {
        for (k, &face) in faces.iter().enumerate().filter(|(_, face)| middle.faces.is_boundary(**face)) {
            let surface = surfaces.next().expect("the boundary quads are in this order");
            of_faces[face.index()] = Some(surface);
            for e in EDGES_OF_FACE[k].map(|e| edges[usize::from(e)].index()) {
                of_edges[e] = Anchor::Surface(surface);
            }
        }
    }
    for (anchor, &[a, b]) in of_edges.iter_mut().zip(&middle.edges.ends) {
        if *anchor != Anchor::Inside {
            let ends = [a.min(b), a.max(b)];
            if let Ok(found) = standing.edges.binary_search_by(|(edge, _)| edge.cmp(&ends)) {
                *anchor = Anchor::Curve(standing.edges[found].1);
            }
        }
    }
    (of_edges, of_faces)
}

#[cfg(test)]
mod tests {
    use super::super::fit::Foot;
    use super::*;
    use crate::Silent;
    use crate::mesh::topology::hex_boundary;

    /// How thick a hex is; its other edges are 1 long.
    const THICK: f64 = 0.05;
    const HEXES: u32 = 12;

    /// Pushes the middles of edges along a row of hexes, all but those of its end.
    struct Wind;

    impl Target for Wind {
        fn foot(&self, _: Anchor, p: Point) -> Option<Foot> {
            let is_end = p.x > (f64::from(HEXES) - 0.25) * THICK;
            let push = if is_end { 0.0 } else { 12.0 * THICK * (0.25 - (p.y - 0.5) * (p.y - 0.5)) };
            Some(Foot { point: Point::new(p.x + push, p.y, p.z), direction: Point::Y })
        }
    }

    #[test]
    fn hexes_that_neighbours_press_on_step_back_too() {
        let mut mesh = HexMesh::default();
        for x in 0..=HEXES {
            for [y, z] in [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
                mesh.positions.push(Point::new(f64::from(x) * THICK, y, z));
            }
        }
        let corners = |h: u32| [0, 4, 5, 1, 3, 7, 6, 2].map(|n| NodeId(4 * h + n));
        mesh.hexes.extend((0..HEXES).map(corners));
        let quads = hex_boundary(&mesh.hexes);
        let faces: Vec<_> = quads.iter().map(|&(quad, _)| (quad, SurfaceId(0))).collect();
        let standing = Standing { faces: &faces, edges: &[], target: &Wind };
        let (made, report) =
            second_order(&mesh, &standing, SecondOrderHex::Hex20, &Silent).expect("not cancelled");
        assert!(report.yielded >= 8, "{report:?}");
        let place = |n: &NodeId| {
            let other = || made.positions[n.index() - mesh.positions.len()];
            mesh.positions.get(n.index()).copied().unwrap_or_else(other)
        };
        let widths: Vec<f64> = (0..HEXES as usize)
            .map(|h| {
                let nodes: Vec<Point> = made.nodes_of(h).iter().map(place).collect();
                let [near, far] = [11, 9].map(|k| nodes[k].x);
                far - near
            })
            .collect();
        assert!(widths.iter().all(|&width| width > 0.0), "{widths:?}");
    }
}
