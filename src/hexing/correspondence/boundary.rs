//! The boundary of a hex mesh as a surface to walk on.
//!
//! Boundary nodes have numbers of their own, ascending with their ids. The edges that leave a node are its spokes,
//! anticlockwise seen from outside; each is half of an edge, its twin is the other:
//!
//! ```text
//!            b
//!        q2  |  q1         spokes of v: a, b, c; between a and b is q1.
//!            |             Left of the spoke v-a is q1, right of it q3.
//!       c----v----a
//!              q3
//! ```

use rstar::RTree;
use rstar::primitives::GeomWithData;

use crate::geometry::{Point, area_vector};
use crate::mesh::numbering::hex::EDGES;
use crate::mesh::topology::{Bins, hex_boundary};
use crate::mesh::{HexMesh, NodeId};
use crate::parallel;
use crate::{Cancelled, Monitor};

/// No node, spoke or quad.
pub(super) const NONE: u32 = u32::MAX;

/// Half of an edge: from a node to another.
#[derive(Clone, Copy, Debug)]
pub(super) struct Spoke {
    pub from: u32,
    pub to: u32,
    /// The quad at its left, seen from outside along it.
    pub left: u32,
    /// The spoke back; [`NONE`] only where the boundary is no manifold.
    pub twin: u32,
    /// How many hexes share the edge.
    pub hexes: u32,
}

/// A node is at the end of an arc that is no farther from it than this share of the arc's length.
const THERE: f64 = 0.1;

pub(super) struct Boundary {
    /// The mesh's nodes on the boundary, ascending.
    pub nodes: Vec<NodeId>,
    pub points: Vec<Point>,
    /// Outward unit normals.
    pub normals: Vec<Point>,
    /// The local edge length: the mean of the edges at each node.
    pub lengths: Vec<f64>,
    /// Four nodes each, anticlockwise seen from outside.
    pub quads: Vec<[u32; 4]>,
    pub spokes: Vec<Spoke>,
    /// Do its faces look the way the solid's do, so that this tells two sides apart that are near each other?
    pub looks_alike: bool,
    /// Where the spokes of each node start, and the end of the last.
    first: Vec<u32>,
    tree: RTree<GeomWithData<[f64; 3], u32>>,
}

impl Boundary {
    pub fn of(mesh: &HexMesh, looks_alike: bool, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let faces = hex_boundary(&mesh.hexes);
        monitor.proceed()?;
        let mut number = vec![NONE; mesh.positions.len()];
        for node in faces.iter().flat_map(|(nodes, _)| nodes) {
            number[node.index()] = 0;
        }
        let nodes: Vec<NodeId> = (0..number.len()).filter(|&n| number[n] == 0).map(NodeId::new).collect();
        for (at, node) in nodes.iter().enumerate() {
            number[node.index()] = at as u32;
        }
        let quads: Vec<[u32; 4]> = faces.iter().map(|(q, _)| q.map(|node| number[node.index()])).collect();
        let points: Vec<Point> = nodes.iter().map(|node| mesh.positions[node.index()]).collect();
        let (spokes, first) = spokes(&quads, nodes.len());
        let leaves = points.iter().zip(0..).map(|(p, n)| GeomWithData::new(p.to_array(), n));
        let tree = RTree::bulk_load(leaves.collect());
        let mut boundary =
            Self { nodes, points, normals: vec![], lengths: vec![], quads, spokes, looks_alike, first, tree };
        monitor.proceed()?;
        boundary.count_hexes(mesh, &number);
        boundary.lengths = parallel::collect(boundary.nodes.len(), |n| boundary.mean_length(n as u32));
        boundary.normals = boundary.node_normals();
        Ok(boundary)
    }

    pub fn spokes_of(&self, node: u32) -> &[Spoke] {
        let [start, end] = [node, node + 1].map(|n| self.first[n as usize] as usize);
        &self.spokes[start..end]
    }

    /// The number of a node's first spoke: the others follow.
    pub fn first_spoke(&self, node: u32) -> u32 {
        self.first[node as usize]
    }

    /// How many edges meet at a node.
    pub fn valence(&self, node: u32) -> usize {
        self.spokes_of(node).len()
    }

    /// The spoke from `from` to `to`.
    pub fn spoke_between(&self, from: u32, to: u32) -> Option<u32> {
        let at = self.spokes_of(from).iter().position(|spoke| spoke.to == to)?;
        Some(self.first_spoke(from) + at as u32)
    }

    /// How many quads lie left and right of a walk that comes along the spoke `into` and leaves along `out`.
    pub fn quads_beside(&self, into: u32, out: u32) -> [usize; 2] {
        let (back, node) = (self.spokes[into as usize].twin, self.spokes[into as usize].to);
        let valence = self.valence(node) as u32;
        // From the spoke that leaves, anticlockwise to the one back.
        let left = (back + valence - out) % valence;
        [left as usize, (valence - left) as usize]
    }

    /// The numbers of the nodes at most `distance` from `p`, ascending.
    pub fn within(&self, p: Point, distance: f64) -> Vec<u32> {
        let near = self.tree.locate_within_distance(p.to_array(), distance * distance);
        let mut nodes: Vec<u32> = near.map(|leaf| leaf.data).collect();
        nodes.sort_unstable();
        nodes
    }

    /// The local edge length at the node nearest to `p`; 0 if there is no node.
    pub fn length_near(&self, p: Point) -> f64 {
        self.tree.nearest_neighbor(p.to_array()).map_or(0.0, |leaf| self.lengths[leaf.data as usize])
    }

    /// How long an edge at the boundary node nearest to `p` may be that runs where edges are short: halfway from the
    /// mean there to the shortest.
    pub fn short_length_near(&self, p: Point) -> f64 {
        self.tree.nearest_neighbor(p.to_array()).map_or(0.0, |leaf| {
            let at = self.points[leaf.data as usize];
            let lengths =
                self.spokes_of(leaf.data).iter().map(|spoke| at.distance(self.points[spoke.to as usize]));
            0.5 * (self.lengths[leaf.data as usize] + lengths.fold(f64::INFINITY, f64::min))
        })
    }

    /// Are there edges of the boundary all along from `a` to `b`, as where layers of hexes are together as thick as a wall?
    pub fn has_edges(&self, a: Point, b: Point) -> bool {
        let (length, at) = (a.distance(b), |node: u32| self.points[node as usize]);
        let near = |p: Point| {
            let node = self.tree.nearest_neighbor(p.to_array())?.data;
            (at(node).distance(p) <= THERE * length).then_some(node)
        };
        let Some((mut node, end)) = near(a).zip(near(b)) else { return false };
        let is_along = |p: Point| (p - a).cross(b - a).length() <= THERE * length * length;
        while node != end {
            let ahead = self
                .spokes_of(node)
                .iter()
                .map(|spoke| spoke.to)
                .filter(|&to| to == end || at(to).distance(b) < at(node).distance(b) && is_along(at(to)));
            let next = ahead.min_by(|&p, &q| at(p).distance(b).total_cmp(&at(q).distance(b)));
            let Some(next) = next else { return false };
            node = next;
        }
        true
    }

    /// The area of a quad along its outward normal.
    pub fn area_vector(&self, quad: u32) -> Point {
        area_vector(&self.quads[quad as usize].map(|n| self.points[n as usize]))
    }

    fn mean_length(&self, node: u32) -> f64 {
        let at = self.points[node as usize];
        let spokes = self.spokes_of(node);
        let sum: f64 = spokes.iter().map(|spoke| at.distance(self.points[spoke.to as usize])).sum();
        sum / spokes.len().max(1) as f64
    }

    fn node_normals(&self) -> Vec<Point> {
        let of_quads = parallel::collect(self.quads.len(), |q| self.area_vector(q as u32));
        parallel::collect(self.nodes.len(), |n| {
            let around = self.spokes_of(n as u32).iter().map(|spoke| of_quads[spoke.left as usize]);
            around.sum::<Point>().normalize_or_zero()
        })
    }

    fn count_hexes(&mut self, mesh: &HexMesh, number: &[u32]) {
        for hex in &mesh.hexes {
            for [a, b] in EDGES {
                let [a, b] = [a, b].map(|k| number[hex[usize::from(k)].index()]);
                if a == NONE || b == NONE {
                    continue;
                }
                for spoke in [self.spoke_between(a, b), self.spoke_between(b, a)].into_iter().flatten() {
                    self.spokes[spoke as usize].hexes += 1;
                }
            }
        }
    }
}

/// The spokes of all nodes, and where those of each start. Where a node has several fans of quads, only the one with
/// its first quad is walked: the boundary is to be a manifold.
fn spokes(quads: &[[u32; 4]], node_count: usize) -> (Vec<Spoke>, Vec<u32>) {
    let corners = quads.as_flattened();
    let at_node = Bins::of(node_count, corners.len(), |k| corners[k] as usize);
    let next = |corner: u32| corners[(corner / 4 * 4 + (corner + 1) % 4) as usize];
    let before = |corner: u32| corners[(corner / 4 * 4 + (corner + 3) % 4) as usize];
    let mut spokes: Vec<Spoke> = Vec::with_capacity(corners.len());
    let mut first = Vec::with_capacity(node_count + 1);
    for node in 0..node_count {
        first.push(spokes.len() as u32);
        let fan = at_node.at(node);
        let mut corner = fan[0];
        for _ in fan {
            let spoke = Spoke { from: node as u32, to: next(corner), left: corner / 4, twin: NONE, hexes: 0 };
            spokes.push(spoke);
            let Some(&following) = fan.iter().find(|&&c| next(c) == before(corner)) else { break };
            corner = following;
            if corner == fan[0] {
                break;
            }
        }
    }
    first.push(spokes.len() as u32);
    for s in 0..spokes.len() {
        let Spoke { from, to, .. } = spokes[s];
        let [start, end] = [to, to + 1].map(|n| first[n as usize]);
        let twin = (start..end).find(|&t| spokes[t as usize].to == from);
        spokes[s].twin = twin.unwrap_or(NONE);
    }
    (spokes, first)
}
