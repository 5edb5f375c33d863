//! How far the boundary of a mesh and a solid are from each other, quad by quad.
//!
//! Both are sampled: the quads at their nodes and the middles of their halves, the solid at its vertices, the middles of
//! its triangles and along the edges where it bends. Each of these belongs to the quad that is nearest to it.

use std::collections::HashSet;

use crate::geometry::{NearestTriangle, Point};
use crate::mesh::topology::Bins;
use crate::mesh::{HexMesh, NodeId};
use crate::solid::{SolidModel, SurfaceId};
use crate::{Cancelled, Monitor, parallel};

/// Along edges of the solid samples are so many edges of the mesh from each other.
const STEP: f64 = 0.5;

/// Of samples that are in one cube of so many edges the first counts.
const DENSE: f64 = 0.15;

/// Edges of the solid are straight on where the cosine between the normals at their sides is above this: 1 degree.
const STRAIGHT: f64 = 0.99985;

/// How many samples of the solid count at a quad.
const SAMPLES: usize = 12;

/// Samples between two questions whether to stop.
const BATCH: usize = 1 << 12;

/// All of a boundary, and how far each quad is from the solid.
pub(super) struct Survey<'a> {
    pub(super) solid: &'a SolidModel,
    /// The mean length of the edges of the mesh when it was first looked at.
    pub(super) edge: f64,
    /// The samples of the solid, and the half of a quad that is nearest to each: twice the quad, and which half; behind it
    /// how far that is, squared.
    samples: Vec<Point>,
    nearest: Vec<(u32, f64)>,
    /// The nodes of the boundary, ascending, and where they are.
    nodes: Vec<NodeId>,
    places: Vec<Point>,
    /// Which of them each quad has, and how far these and the middles of its halves are from the solid.
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
            samples,
            nearest: Vec::new(),
            places: vec![Point::NAN; nodes.len()],
            nodes,
            quads: faces.iter().map(|(quad, _)| quad.map(of_quad)).collect(),
            of_mesh: Vec::new(),
            of_solid: Bins::default(),
            distances: Vec::new(),
        })
    }

    /// Looks at all of the boundary, whose quads are those of before. What was seen of those that are where they were holds.
    pub(super) fn renew(&mut self, mesh: &HexMesh, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        let has_moved = self.follow(mesh);
        let of_mesh = std::mem::take(&mut self.of_mesh);
        let (mut all, count) = (Vec::new(), self.quads.len());
        for start in (0..count).step_by(BATCH) {
            monitor.proceed()?;
            parallel::extend(&mut all, BATCH.min(count - start), |k| {
                if !has_moved[start + k] {
                    return of_mesh[start + k];
                }
                let quad = self.quad(start + k);
                let apart = |p: Point| self.solid.nearest(p).distance;
                quad.iter().copied().chain(middles(&quad)).map(apart).fold(0.0, f64::max)
            });
        }
        self.of_mesh = all;
        self.nearest = self.nearest_halves(&has_moved, monitor)?;
        let quad_of = |k: usize| self.nearest[k].0 as usize / 2;
        self.of_solid = Bins::monitored(self.quads.len(), self.samples.len(), quad_of, monitor)?;
        let distance = |k: u32| self.nearest[k as usize].1.sqrt();
        self.distances.clear();
        for (quad, &of_mesh) in self.of_mesh.iter().enumerate() {
            if quad.is_multiple_of(BATCH) {
                monitor.proceed()?;
            }
            // Of those that are equally far the first.
            let samples = self.of_solid.at_mut(quad);
            samples.sort_unstable_by(|&a, &b| distance(b).total_cmp(&distance(a)).then(a.cmp(&b)));
            let farthest = samples.first().map_or(0.0, |&k| distance(k));
            self.distances.push(of_mesh.max(farthest));
        }
        Ok(())
    }

    /// Takes the nodes to where the mesh has them. Which quads have one that was elsewhere.
    fn follow(&mut self, mesh: &HexMesh) -> Vec<bool> {
        let mut has_moved = vec![false; self.nodes.len()];
        for ((node, place), has_moved) in self.nodes.iter().zip(&mut self.places).zip(&mut has_moved) {
            let now = mesh.positions[node.index()];
            *has_moved = *place != now;
            *place = now;
        }
        self.quads.iter().map(|quad| quad.iter().any(|&n| has_moved[n as usize])).collect()
    }

    /// Where the corners of a quad are.
    fn quad(&self, quad: usize) -> [Point; 4] {
        self.quads[quad].map(|n| self.places[n as usize])
    }

    /// The samples of the solid that count at a quad.
    pub(super) fn at(&self, quad: usize) -> Vec<Point> {
        self.of_solid.at(quad).iter().take(SAMPLES).map(|&k| self.samples[k as usize]).collect()
    }

    /// What is nearest to each sample. Where that has not moved, only what has can be nearer.
    fn nearest_halves(
        &self,
        has_moved: &[bool],
        monitor: &dyn Monitor,
    ) -> Result<Vec<(u32, f64)>, Cancelled> {
        let mut moved: Vec<u32> =
            (0u32..).zip(has_moved).filter_map(|(q, &moved)| moved.then_some(q)).collect();
        // Where most has moved a tree of that alone is hardly smaller than one of all.
        let is_known = !self.nearest.is_empty() && 2 * moved.len() <= has_moved.len();
        if !is_known {
            moved.clear();
        }
        let halves_of = |quad: usize| halves(&self.quad(quad));
        let of_moved = NearestTriangle::within(moved.iter().flat_map(|&q| halves_of(q as usize)), monitor)?;
        let of_all = NearestTriangle::within((0..has_moved.len()).flat_map(halves_of), monitor)?;
        parallel::try_collect(self.samples.len(), monitor, |k| {
            let p = self.samples[k];
            let known = self.nearest.get(k).filter(|(half, _)| is_known && !has_moved[*half as usize / 2]);
            let Some(&(half, squared)) = known else {
                let found = of_all.nearest(p).expect("a mesh has a boundary");
                return (found.facet as u32, found.point.distance_squared(p));
            };
            let nearer = of_moved.nearest_within(p, squared).map(|found| {
                let half = 2 * moved[found.facet / 2] + found.facet as u32 % 2;
                (half, found.point.distance_squared(p))
            });
            nearer.filter(|&(other, nearer)| nearer < squared || other < half).unwrap_or((half, squared))
        })
    }
}

/// Samples of a solid for a mesh with edges of this mean length: its vertices, the middles of its triangles, and points of
/// edges where it bends. Where they are dense one stands for those around.
fn samples(edge: f64, solid: &SolidModel, monitor: &dyn Monitor) -> Result<Vec<Point>, Cancelled> {
    let mut sparse = Sparse {
        origin: solid.bounds().min,
        size: DENSE * edge,
        taken: HashSet::new(),
        samples: Vec::new(),
        asked: 0,
        monitor,
    };
    for &p in solid.points() {
        sparse.add(p)?;
    }
    for (t, normal) in solid.normals().iter().enumerate() {
        let corners = solid.corners_of(t);
        for side in 0..3 {
            let other = solid.across(t, side) as usize;
            if t < other && normal.dot(solid.normals()[other]) < STRAIGHT {
                let [from, to] = [corners[side], corners[(side + 1) % 3]];
                let steps = (from.distance(to) / (STEP * edge)).ceil() as u32;
                for k in 1..steps {
                    sparse.add(from.lerp(to, f64::from(k) / f64::from(steps)))?;
                }
            }
        }
        sparse.add(corners.into_iter().sum::<Point>() / 3.0)?;
    }
    Ok(sparse.samples)
}

/// Samples of which no two are in one cube.
struct Sparse<'a> {
    origin: Point,
    /// The edge of a cube.
    size: f64,
    /// The cubes with samples.
    taken: HashSet<[i64; 3]>,
    samples: Vec<Point>,
    /// How many samples were offered.
    asked: usize,
    monitor: &'a dyn Monitor,
}

impl Sparse<'_> {
    fn add(&mut self, p: Point) -> Result<(), Cancelled> {
        if self.asked.is_multiple_of(BATCH) {
            self.monitor.proceed()?;
        }
        self.asked += 1;
        let cube = ((p - self.origin) / self.size).to_array().map(|x| x as i64);
        if self.taken.insert(cube) {
            self.samples.push(p);
        }
        Ok(())
    }
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

/// A quad as two triangles, of its corners or what stands for these.
pub(super) fn halves<T: Copy>(&[a, b, c, d]: &[T; 4]) -> [[T; 3]; 2] {
    [[a, b, c], [a, c, d]]
}

fn middles(quad: &[Point; 4]) -> [Point; 2] {
    halves(quad).map(|half| half.into_iter().sum::<Point>() / 3.0)
}
