//! How far the boundary of a mesh and a solid are from each other, quad by quad.
//!
//! Both are sampled: the quads at their nodes, the quarters of their sides and the middles of their diagonals, the solid as where
//! distances are told. Each of its samples belongs to the quad that is nearest to it.

use crate::geometry::{Aabb, CutQuad, Firsts, NearestQuad, Point};
use crate::mesh::topology::Bins;
use crate::mesh::{HexMesh, NodeId, Sampled, Triangles};
use crate::solid::{SolidModel, SurfaceId};
use crate::{Cancelled, Monitor, parallel};

/// Of samples that are in one cube of so many edges the first counts.
const DENSE: f64 = 0.2;

/// How many samples of the solid count at a quad.
const SAMPLES: usize = 12;

/// Samples between two questions whether to stop.
const BATCH: usize = 1 << 12;

/// Samples that follow each other lie near each other: so many are looked at together first.
const BALL: usize = 64;

/// What is looked for around a ball of samples is farther, squared, than need be by this share: no rounding leaves one out.
const ROUNDING: f64 = 1e-6;

/// No place in a list.
const NOWHERE: u32 = u32::MAX;

/// All of a boundary, and how far each quad is from the solid.
pub struct Survey<'a> {
    pub(super) solid: &'a SolidModel,
    /// The mean length of the edges of the mesh when it was first looked at.
    pub(super) edge: f64,
    /// The samples of the solid, from the least corner of its bounds in shares of its diagonal, in digits enough to tell what is far;
    /// and which quad is nearest to each.
    samples: Vec<[f32; 3]>,
    nearest: Vec<NearestTo>,
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
    /// Of so many quads, the first, the nodes are brought nearer; of the others it is only seen how far they are.
    pub(super) heeded: usize,
}

impl<'a> Survey<'a> {
    /// One that has not looked yet.
    pub(in super::super) fn new(
        mesh: &HexMesh,
        faces: &[([NodeId; 4], SurfaceId)],
        solid: &'a SolidModel,
    ) -> Self {
        let mut number = vec![None; mesh.positions.len()];
        faces.iter().for_each(|(quad, _)| quad.iter().for_each(|n| number[n.index()] = Some(0)));
        let mut nodes = Vec::new();
        for (n, number) in number.iter_mut().enumerate().filter(|(_, number)| number.is_some()) {
            *number = Some(nodes.len() as u32);
            nodes.push(NodeId::new(n));
        }
        let of_quad = |n: NodeId| number[n.index()].expect("a node of the boundary");
        Self {
            solid,
            edge: mean_edge(&quads(mesh, faces)),
            samples: Vec::new(),
            nearest: Vec::new(),
            balls: Vec::new(),
            places: vec![Point::NAN; nodes.len()],
            of_nodes: Vec::new(),
            nodes,
            quads: faces.iter().map(|(quad, _)| quad.map(of_quad)).collect(),
            of_mesh: Vec::new(),
            of_solid: Bins::default(),
            distances: Vec::new(),
            heeded: faces.len(),
        }
    }

    /// Looks at all of the boundary, whose quads are those of before. What was seen of those that are where they were holds.
    pub(super) fn renew(&mut self, mesh: &HexMesh, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        if self.samples.is_empty() {
            self.sample(monitor)?;
        }
        let moved_nodes = self.follow(mesh);
        if !self.distances.is_empty() && !moved_nodes.contains(&true) {
            return Ok(());
        }
        let of_nodes = std::mem::take(&mut self.of_nodes);
        self.of_nodes = parallel::try_collect(self.nodes.len(), monitor, |n| {
            if moved_nodes[n] { self.solid.distance(self.places[n]) } else { of_nodes[n] }
        })?;
        let has_moved: Vec<bool> =
            self.quads.iter().map(|quad| quad.iter().any(|&n| moved_nodes[n as usize])).collect();
        let of_mesh = std::mem::take(&mut self.of_mesh);
        self.of_mesh = parallel::try_collect(self.quads.len(), monitor, |k| {
            if has_moved[k] { self.apart(k) } else { of_mesh[k] }
        })?;
        let mut nearest = std::mem::take(&mut self.nearest);
        self.bring_nearest(&mut nearest, &has_moved, monitor)?;
        self.nearest = nearest;
        self.rank(monitor)
    }

    /// That of these quads alone, of which so many are heeded, and of what is nearest to them; it has looked, as this one has.
    pub(super) fn part(
        &self,
        quads: &[u32],
        heeded: usize,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let mut number = vec![NOWHERE; self.quads.len()];
        (0..).zip(quads).for_each(|(k, &quad)| number[quad as usize] = k);
        let (mut samples, mut nearest) = (Vec::new(), Vec::new());
        for (&sample, &near) in self.samples.iter().zip(&self.nearest) {
            let quad = number[near.quad as usize];
            if quad != NOWHERE {
                samples.push(sample);
                nearest.push(NearestTo { quad, ..near });
            }
        }
        let mut part = Self {
            samples,
            nearest,
            balls: Vec::new(),
            nodes: self.nodes.clone(),
            places: self.places.clone(),
            of_nodes: self.of_nodes.clone(),
            quads: quads.iter().map(|&quad| self.quads[quad as usize]).collect(),
            of_mesh: quads.iter().map(|&quad| self.of_mesh[quad as usize]).collect(),
            of_solid: Bins::default(),
            distances: Vec::new(),
            heeded,
            ..*self
        };
        part.enclose(monitor)?;
        part.rank(monitor)?;
        Ok(part)
    }

    /// Puts the samples at each quad in order, the farthest first, and tells how far each quad is.
    fn rank(&mut self, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        let quad_of = |k: usize| self.nearest[k].quad as usize;
        self.of_solid = Bins::monitored(self.quads.len(), self.samples.len(), quad_of, monitor)?;
        let (nearest, unit) = (&self.nearest, self.unit());
        let distance = |k: u32| nearest[k as usize].at_most(unit).sqrt();
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

    /// Samples the solid. Not before they are looked at: samples are what most of the memory is for.
    fn sample(&mut self, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        self.samples = samples(self.edge, self.solid, monitor)?;
        self.enclose(monitor)
    }

    /// Finds the balls around the samples.
    fn enclose(&mut self, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        self.balls = parallel::try_collect(self.samples.len().div_ceil(BALL), monitor, |k| {
            let range = k * BALL..self.samples.len().min((k + 1) * BALL);
            ball(&range.map(|k| self.sample_at(k)).collect::<Vec<_>>())
        })?;
        Ok(())
    }

    /// Where a sample is.
    fn sample_at(&self, k: usize) -> Point {
        self.solid.bounds().min + Point::from(self.samples[k].map(f64::from)) * self.solid.diagonal()
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
        between.map(|p| self.solid.distance(p)).chain(of_nodes).fold(0.0, f64::max)
    }

    /// The greatest distance of all.
    #[inline(never)]
    pub(super) fn farthest(&self) -> f64 {
        self.distances.iter().copied().fold(0.0, f64::max)
    }

    /// Where the corners of a quad are.
    fn quad(&self, quad: usize) -> [Point; 4] {
        self.quads[quad].map(|n| self.places[n as usize])
    }

    /// The samples of the solid that count at a quad.
    pub(super) fn at(&self, quad: usize) -> Vec<Point> {
        self.of_solid.at(quad).iter().take(SAMPLES).map(|&k| self.sample_at(k as usize)).collect()
    }

    /// What squares of distances are told as shares of: the square of the solid's diagonal.
    fn unit(&self) -> f64 {
        self.solid.diagonal() * self.solid.diagonal()
    }

    /// Could some of these quads be nearer to a sample of the ball than what was nearest to it?
    fn near_balls(
        &self,
        nearest: &[NearestTo],
        quads: &NearestQuad,
        monitor: &dyn Monitor,
    ) -> Result<Vec<bool>, Cancelled> {
        let unit = self.unit();
        parallel::try_collect(self.balls.len(), monitor, |k| {
            let (middle, radius) = self.balls[k];
            let known = nearest.chunks(BALL).nth(k).unwrap_or_default();
            let reach = radius + known.iter().map(|near| near.at_most(unit)).fold(0.0, f64::max).sqrt();
            quads.nearest_within(middle, reach * reach * (1.0 + ROUNDING)).is_some()
        })
    }

    /// Brings up to date what is nearest to each sample. Where that has not moved, only what has can be nearer.
    fn bring_nearest(
        &self,
        nearest: &mut Vec<NearestTo>,
        has_moved: &[bool],
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        let mut moved: Vec<u32> =
            (0u32..).zip(has_moved).filter_map(|(q, &moved)| moved.then_some(q)).collect();
        // Where most has moved a tree of that alone is hardly smaller than one of all.
        let is_known = !nearest.is_empty() && 2 * moved.len() <= has_moved.len();
        if !is_known {
            moved.clear();
        }
        let of_all = NearestQuad::sharing(self.places.clone(), self.quads.iter().copied(), monitor)?;
        let moved_quads = moved.iter().map(|&quad| self.quads[quad as usize]);
        let of_moved = NearestQuad::sharing(self.places.clone(), moved_quads, monitor)?;
        let is_near = self.near_balls(nearest, &of_moved, monitor)?;
        let unit = self.unit();
        nearest.resize(self.samples.len(), NearestTo { quad: 0, share: f32::INFINITY });
        parallel::try_for_each_mut(nearest, monitor, |k, near| {
            let p = self.sample_at(k);
            let quad = near.quad as usize;
            if !is_known || has_moved[quad] {
                let found = of_all.nearest(p).expect("a mesh has a boundary");
                *near = NearestTo::new(found.facet, found.point.distance_squared(p), unit);
            } else if is_near[k / BALL]
                && let Some(found) = of_moved.nearest_within(p, near.at_most(unit))
            {
                let (other, squared) = (moved[found.facet] as usize, found.point.distance_squared(p));
                let known = CutQuad(self.quad(quad)).distance_squared(p);
                if squared < known || squared == known && other < quad {
                    *near = NearestTo::new(other, squared, unit);
                }
            }
        })
    }
}

/// What is nearest to a sample. There are many of these.
#[derive(Clone, Copy, Debug)]
struct NearestTo {
    quad: u32,
    /// How far it is, squared, as a share of a unit, rounded up.
    share: f32,
}

impl NearestTo {
    fn new(quad: usize, squared: f64, unit: f64) -> Self {
        let share = (squared / unit) as f32;
        let is_less = f64::from(share) * unit < squared;
        Self { quad: quad as u32, share: if is_less { share.next_up() } else { share } }
    }

    /// How far it is, squared, or hardly more.
    fn at_most(self, unit: f64) -> f64 {
        f64::from(self.share) * unit
    }
}

/// The middle and the radius of a ball around some points.
fn ball(points: &[Point]) -> (Point, f64) {
    let middle = Aabb::around(points).center();
    let squared = points.iter().map(|p| p.distance_squared(middle)).fold(0.0, f64::max);
    (middle, squared.sqrt())
}

/// Samples of a solid, as a survey has them, for a mesh with edges of this mean length: those by which distances are told, but
/// where they are dense one for those around.
fn samples(edge: f64, solid: &SolidModel, monitor: &dyn Monitor) -> Result<Vec<[f32; 3]>, Cancelled> {
    let surface = Triangles { positions: solid.points(), triangles: solid.triangles() };
    let (origin, diagonal) = (solid.bounds().min, solid.diagonal());
    let mut firsts = Firsts::new(origin, DENSE * edge);
    let mut sparse = Vec::new();
    surface.sample(edge, monitor, &mut |batch, _| {
        let first = batch.iter().filter(|&&p| firsts.is_first(p));
        sparse.extend(first.map(|&p| ((p - origin) / diagonal).to_array().map(|x| x as f32)));
    })?;
    sparse.shrink_to_fit();
    Ok(sparse)
}

/// Where the corners of faces are.
pub(super) fn quads(mesh: &HexMesh, faces: &[([NodeId; 4], SurfaceId)]) -> Vec<[Point; 4]> {
    faces.iter().map(|(quad, _)| quad.map(|n| mesh.positions[n.index()])).collect()
}

/// The mean length of the sides of all quads.
fn mean_edge(quads: &[[Point; 4]]) -> f64 {
    quads.iter().map(mean_side).sum::<f64>() / quads.len() as f64
}

/// The mean length of a quad's sides.
pub(super) fn mean_side(quad: &[Point; 4]) -> f64 {
    (0..4).map(|k| quad[k].distance(quad[(k + 1) % 4])).sum::<f64>() / 4.0
}
