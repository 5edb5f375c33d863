//! How far the boundary of a mesh and a solid are from each other, quad by quad.
//!
//! Both are sampled: the quads at their nodes, the quarters of their sides and the middles of their diagonals, the solid as where
//! distances are told. Each of its samples belongs to the quad that is nearest to it.

use std::collections::HashSet;

use crate::geometry::{Aabb, CutQuad, NearestQuad, Point};
use crate::mesh::topology::Bins;
use crate::mesh::{HexMesh, NodeId, Sampled, Triangles};
use crate::solid::{SolidModel, SurfaceId};
use crate::{Cancelled, Monitor, parallel};

/// Of samples that are in one cube of so many edges the first counts.
const DENSE: f64 = 0.15;

/// How many samples of the solid count at a quad.
const SAMPLES: usize = 12;

/// Samples between two questions whether to stop.
const BATCH: usize = 1 << 12;

/// Samples that follow each other lie near each other: so many are looked at together first.
const BALL: usize = 64;

/// What is looked for around a ball of samples is farther, squared, than need be by this share: no rounding leaves one out.
const ROUNDING: f64 = 1e-6;

/// All of a boundary, and how far each quad is from the solid.
pub struct Survey<'a> {
    pub(super) solid: &'a SolidModel,
    /// The mean length of the edges of the mesh when it was first looked at.
    pub(super) edge: f64,
    /// The samples of the solid, and which quad is nearest to each; behind it how far that is, squared.
    samples: Vec<Point>,
    nearest: Vec<(u32, f64)>,
    /// A ball around each `BALL` samples, by its middle and radius.
    balls: Vec<(Point, f64)>,
    /// The nodes of the boundary, ascending, where they are, and how far from the solid.
    nodes: Vec<NodeId>,
    places: Vec<Point>,
    of_nodes: Vec<f64>,
    /// Which of them each quad has, and how far these, the middles of its diagonals and the quarters of its sides are from the solid;
    /// of a side between two quads the one that has it ascending knows.
    quads: Vec<[u32; 4]>,
    of_mesh: Vec<f64>,
    /// The samples at each quad, the farthest first.
    of_solid: Bins,
    /// The greatest distance at each quad, either way.
    pub(super) distances: Vec<f64>,
}

impl<'a> Survey<'a> {
    /// One that has not looked yet.
    pub(super) fn new(
        mesh: &HexMesh,
        faces: &[([NodeId; 4], SurfaceId)],
        solid: &'a SolidModel,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let edge = mean_edge(&quads(mesh, faces));
        let samples = samples(edge, solid, monitor)?;
        let mut number = vec![None; mesh.positions.len()];
        faces.iter().for_each(|(quad, _)| quad.iter().for_each(|n| number[n.index()] = Some(0)));
        let mut nodes = Vec::new();
        for (n, number) in number.iter_mut().enumerate().filter(|(_, number)| number.is_some()) {
            *number = Some(nodes.len() as u32);
            nodes.push(NodeId::new(n));
        }
        let of_quad = |n: NodeId| number[n.index()].expect("a node of the boundary");
        Ok(Self {
            solid,
            edge,
            balls: parallel::try_collect(samples.len().div_ceil(BALL), monitor, |k| {
                ball(&samples[k * BALL..samples.len().min((k + 1) * BALL)])
            })?,
            samples,
            nearest: Vec::new(),
            places: vec![Point::NAN; nodes.len()],
            of_nodes: Vec::new(),
            nodes,
            quads: faces.iter().map(|(quad, _)| quad.map(of_quad)).collect(),
            of_mesh: Vec::new(),
            of_solid: Bins::default(),
            distances: Vec::new(),
        })
    }

    /// Looks at all of the boundary, whose quads are those of before. What was seen of those that are where they were holds.
    pub(super) fn renew(&mut self, mesh: &HexMesh, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        let moved_nodes = self.follow(mesh);
        let of_nodes = std::mem::take(&mut self.of_nodes);
        self.of_nodes = parallel::try_collect(self.nodes.len(), monitor, |n| {
            if moved_nodes[n] { self.solid.nearest(self.places[n]).distance } else { of_nodes[n] }
        })?;
        let has_moved: Vec<bool> =
            self.quads.iter().map(|quad| quad.iter().any(|&n| moved_nodes[n as usize])).collect();
        let of_mesh = std::mem::take(&mut self.of_mesh);
        self.of_mesh = parallel::try_collect(self.quads.len(), monitor, |k| {
            if has_moved[k] { self.apart(k) } else { of_mesh[k] }
        })?;
        self.nearest = self.nearest_quads(&has_moved, monitor)?;
        let quad_of = |k: usize| self.nearest[k].0 as usize;
        self.of_solid = Bins::monitored(self.quads.len(), self.samples.len(), quad_of, monitor)?;
        let distance = |k: u32| self.nearest[k as usize].1.sqrt();
        self.distances.clear();
        for (quad, &of_mesh) in self.of_mesh.iter().enumerate() {
            if quad.is_multiple_of(BATCH) {
                monitor.proceed()?;
            }
            let samples = self.of_solid.at_mut(quad);
            let order = parallel::greatest_first(samples.iter().map(|&k| distance(k)));
            let in_order: Vec<u32> = order.map(|k| samples[k]).collect();
            samples.copy_from_slice(&in_order);
            let farthest = samples.first().map_or(0.0, |&k| distance(k));
            self.distances.push(of_mesh.max(farthest));
        }
        Ok(())
    }

    /// Takes the nodes to where the mesh has them. Which were elsewhere.
    fn follow(&mut self, mesh: &HexMesh) -> Vec<bool> {
        let mut has_moved = vec![false; self.nodes.len()];
        for ((node, place), has_moved) in self.nodes.iter().zip(&mut self.places).zip(&mut has_moved) {
            let now = mesh.positions[node.index()];
            *has_moved = *place != now;
            *place = now;
        }
        has_moved
    }

    /// How far a quad's corners, the middles of its diagonals and the quarters of the sides that it has ascending are from the
    /// solid.
    fn apart(&self, quad: usize) -> f64 {
        let corners = self.quad(quad);
        let is_ours = |&k: &usize| self.quads[quad][k] < self.quads[quad][(k + 1) % 4];
        let quarters = |k: usize| [0.25, 0.5, 0.75].map(|at| corners[k].lerp(corners[(k + 1) % 4], at));
        let between = (0..4).filter(is_ours).flat_map(quarters).chain(CutQuad(corners).middles());
        let of_nodes = self.quads[quad].map(|n| self.of_nodes[n as usize]);
        between.map(|p| self.solid.nearest(p).distance).chain(of_nodes).fold(0.0, f64::max)
    }

    /// Where the corners of a quad are.
    fn quad(&self, quad: usize) -> [Point; 4] {
        self.quads[quad].map(|n| self.places[n as usize])
    }

    /// The samples of the solid that count at a quad.
    pub(super) fn at(&self, quad: usize) -> Vec<Point> {
        self.of_solid.at(quad).iter().take(SAMPLES).map(|&k| self.samples[k as usize]).collect()
    }

    /// Could some of these quads be nearer to a sample of the ball than what was nearest to it?
    fn near_balls(&self, quads: &NearestQuad, monitor: &dyn Monitor) -> Result<Vec<bool>, Cancelled> {
        parallel::try_collect(self.balls.len(), monitor, |k| {
            let (middle, radius) = self.balls[k];
            let known = self.nearest.chunks(BALL).nth(k).unwrap_or_default();
            let reach = radius + known.iter().map(|&(_, squared)| squared).fold(0.0, f64::max).sqrt();
            quads.nearest_within(middle, reach * reach * (1.0 + ROUNDING)).is_some()
        })
    }

    /// What is nearest to each sample. Where that has not moved, only what has can be nearer.
    fn nearest_quads(&self, has_moved: &[bool], monitor: &dyn Monitor) -> Result<Vec<(u32, f64)>, Cancelled> {
        let mut moved: Vec<u32> =
            (0u32..).zip(has_moved).filter_map(|(q, &moved)| moved.then_some(q)).collect();
        // Where most has moved a tree of that alone is hardly smaller than one of all.
        let is_known = !self.nearest.is_empty() && 2 * moved.len() <= has_moved.len();
        if !is_known {
            moved.clear();
        }
        let patch = |quad: u32| CutQuad(self.quad(quad as usize));
        let of_moved = NearestQuad::within(moved.iter().map(|&quad| patch(quad)), monitor)?;
        let of_all = NearestQuad::within((0..has_moved.len() as u32).map(patch), monitor)?;
        let is_near = self.near_balls(&of_moved, monitor)?;
        parallel::try_collect(self.samples.len(), monitor, |k| {
            let p = self.samples[k];
            let known = self.nearest.get(k).filter(|(quad, _)| is_known && !has_moved[*quad as usize]);
            let Some(&(quad, squared)) = known else {
                let found = of_all.nearest(p).expect("a mesh has a boundary");
                return (found.facet as u32, found.point.distance_squared(p));
            };
            if !is_near[k / BALL] {
                return (quad, squared);
            }
            let nearer = of_moved
                .nearest_within(p, squared)
                .map(|found| (moved[found.facet], found.point.distance_squared(p)));
            nearer.filter(|&(other, nearer)| nearer < squared || other < quad).unwrap_or((quad, squared))
        })
    }
}

/// The middle and the radius of a ball around some points.
fn ball(points: &[Point]) -> (Point, f64) {
    let middle = Aabb::around(points).center();
    let squared = points.iter().map(|p| p.distance_squared(middle)).fold(0.0, f64::max);
    (middle, squared.sqrt())
}

/// Samples of a solid for a mesh with edges of this mean length: those by which distances are told, but where they are dense
/// one for those around.
fn samples(edge: f64, solid: &SolidModel, monitor: &dyn Monitor) -> Result<Vec<Point>, Cancelled> {
    let surface = Triangles { positions: solid.points(), triangles: solid.triangles() };
    let (origin, size) = (solid.bounds().min, DENSE * edge);
    let cube = |p: Point| ((p - origin) / size).to_array().map(|x| x as i32);
    let mut taken = HashSet::new();
    let mut sparse = Vec::new();
    surface.sample(edge, monitor, &mut |batch, _| {
        sparse.extend(batch.iter().filter(|&&p| taken.insert(cube(p))));
    })?;
    Ok(sparse)
}

/// Where the corners of faces are.
pub(super) fn quads(mesh: &HexMesh, faces: &[([NodeId; 4], SurfaceId)]) -> Vec<[Point; 4]> {
    faces.iter().map(|(quad, _)| quad.map(|n| mesh.positions[n.index()])).collect()
}

/// The mean length of the sides of all quads.
pub(super) fn mean_edge(quads: &[[Point; 4]]) -> f64 {
    quads.iter().map(mean_side).sum::<f64>() / quads.len() as f64
}

/// The mean length of a quad's sides.
pub(super) fn mean_side(quad: &[Point; 4]) -> f64 {
    (0..4).map(|k| quad[k].distance(quad[(k + 1) % 4])).sum::<f64>() / 4.0
}
