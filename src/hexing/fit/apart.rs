//! How far the boundary of a mesh and a solid are from each other, quad by quad and around each node.
//!
//! Both are sampled: the quads at their nodes and the middles of their halves, the solid at its vertices, the middles of
//! its triangles and along the edges where it bends. Each of these belongs to the quad that is nearest to it.

use std::collections::HashSet;

use crate::geometry::{Aabb, NearestTriangle, Point, closest_on_triangle};
use crate::mesh::topology::Bins;
use crate::mesh::{HexMesh, NodeId};
use crate::optimize::Problem;
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

/// What is no farther from the solid than this share of its diagonal is on it.
const ON: f64 = 1e-9;

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
    /// Where the corners of the quads are, and how far these and the middles of their halves are from the solid.
    quads: Vec<[Point; 4]>,
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
        let (nearest, quads, of_mesh) = (Vec::new(), Vec::new(), Vec::new());
        let (of_solid, distances) = (Bins::default(), Vec::new());
        Ok(Self { solid, edge, samples, nearest, quads, of_mesh, of_solid, distances })
    }

    /// Looks at all faces of the mesh, which are as many as before. What was seen of those that are where they were holds.
    pub(super) fn renew(
        &mut self,
        mesh: &HexMesh,
        faces: &[([NodeId; 4], SurfaceId)],
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        let (before, quads) = (std::mem::take(&mut self.quads), quads(mesh, faces));
        let has_moved: Vec<bool> = (0..quads.len()).map(|q| before.get(q) != Some(&quads[q])).collect();
        let of_mesh = std::mem::take(&mut self.of_mesh);
        for start in (0..quads.len()).step_by(BATCH) {
            monitor.proceed()?;
            parallel::extend(&mut self.of_mesh, BATCH.min(quads.len() - start), |k| {
                let quad = &quads[start + k];
                if !has_moved[start + k] {
                    return of_mesh[start + k];
                }
                let apart = |p: Point| self.solid.nearest(p).distance;
                quad.iter().copied().chain(middles(quad)).map(apart).fold(0.0, f64::max)
            });
        }
        self.nearest = self.nearest_halves(&quads, &has_moved, monitor)?;
        let quad_of = |k: usize| self.nearest[k].0 as usize / 2;
        self.of_solid = Bins::monitored(quads.len(), self.samples.len(), quad_of, monitor)?;
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
        self.quads = quads;
        Ok(())
    }

    /// The samples of the solid that count at a quad.
    fn at(&self, quad: usize) -> Vec<Point> {
        self.of_solid.at(quad).iter().take(SAMPLES).map(|&k| self.samples[k as usize]).collect()
    }

    /// What is nearest to each sample. Where that has not moved, only what has can be nearer.
    fn nearest_halves(
        &self,
        quads: &[[Point; 4]],
        has_moved: &[bool],
        monitor: &dyn Monitor,
    ) -> Result<Vec<(u32, f64)>, Cancelled> {
        let mut moved: Vec<u32> = (0..quads.len() as u32).filter(|&q| has_moved[q as usize]).collect();
        // Where most has moved a tree of that alone is hardly smaller than one of all.
        let is_known = !self.nearest.is_empty() && 2 * moved.len() <= quads.len();
        if !is_known {
            moved.clear();
        }
        let of_moved =
            NearestTriangle::within(moved.iter().flat_map(|&q| halves(&quads[q as usize])), monitor)?;
        let of_all = NearestTriangle::within(quads.iter().flat_map(halves), monitor)?;
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

/// A quad as two triangles.
fn halves(&[a, b, c, d]: &[Point; 4]) -> [[Point; 3]; 2] {
    [[a, b, c], [a, c, d]]
}

fn middles(quad: &[Point; 4]) -> [Point; 2] {
    halves(quad).map(|half| half.into_iter().sum::<Point>() / 3.0)
}

/// How far a mesh whose nodes move, and a solid are from each other around these.
pub(super) struct Apart<'a> {
    solid: &'a SolidModel,
    /// The boundary quads around movable nodes, by nodes of the problem.
    quads: Vec<[u32; 4]>,
    /// The samples of the solid at each of them.
    samples: Vec<Vec<Point>>,
    /// How far each of them was from the solid at first.
    distances: Vec<f64>,
    /// The quads around each movable node.
    around: Vec<Vec<u32>>,
}

impl<'a> Apart<'a> {
    pub(super) fn new(problem: &Problem, faces: &[([NodeId; 4], SurfaceId)], survey: &Survey<'a>) -> Self {
        let count = problem.nodes.iter().map(|n| n.index() + 1).max().unwrap_or(0);
        let mut local = vec![None; count];
        (0u32..).zip(&problem.nodes).for_each(|(k, n)| local[n.index()] = Some(k));
        let mut around = vec![Vec::new(); problem.movable()];
        let (mut quads, mut samples, mut distances) = (Vec::new(), Vec::new(), Vec::new());
        for (k, (quad, _)) in faces.iter().enumerate() {
            let [Some(a), Some(b), Some(c), Some(d)] = quad.map(|n| local.get(n.index()).copied().flatten())
            else {
                continue;
            };
            let movable = [a, b, c, d].into_iter().filter(|&n| (n as usize) < problem.movable());
            movable.for_each(|n| around[n as usize].push(quads.len() as u32));
            quads.push([a, b, c, d]);
            samples.push(survey.at(k));
            distances.push(survey.distances[k]);
        }
        Self { solid: survey.solid, quads, samples, distances, around }
    }

    /// The greatest distance around a node at first.
    pub(super) fn farthest(&self, node: u32) -> f64 {
        self.around[node as usize].iter().map(|&q| self.distances[q as usize]).fold(0.0, f64::max)
    }

    /// How far a place is from the solid, where what is on it counts as a little off.
    pub(super) fn reach(&self, place: Point) -> f64 {
        self.solid.nearest(place).distance.max(ON * self.solid.diagonal())
    }

    /// Is a place no farther from the solid than `reach`?
    pub(super) fn is_within(&self, place: Point, reach: f64) -> bool {
        self.solid.nearest(place).distance <= reach
    }

    /// What is looked at around a node, and how far that is apart with the node where it is.
    pub(super) fn probes(&self, problem: &Problem, node: u32) -> Probes {
        let from = problem.points[node as usize];
        let patch = self.patch(problem, node, from);
        let of_mesh = (0..patch.halves()).map(Probe::Middle).chain([Probe::Node]);
        let all = self.samples(node).map(|(own, p)| Probe::Sample(own, p)).chain(of_mesh);
        let mut probes: Vec<Probed> = all
            .map(|probe| {
                let squared = self.distance_squared(&patch, from, probe);
                let reach = match probe {
                    Probe::Sample(..) | Probe::Node => 1.0,
                    Probe::Middle(half) if self.has(node, half) => 1.0 / 3.0,
                    Probe::Middle(_) => 0.0,
                };
                Probed { probe, squared, distance: squared.sqrt(), reach }
            })
            .collect();
        // Stable: of those that are equally far the first.
        probes.sort_by(|a, b| b.squared.total_cmp(&a.squared));
        let error = probes.iter().map(|probed| probed.squared * probed.squared).sum();
        Probes { from, probes, error }
    }

    /// What is apart with the node at `at`, if that is less than `limit`: the sum of the fourth powers of all distances, so
    /// that the greatest count.
    pub(super) fn error(
        &self,
        problem: &Problem,
        node: u32,
        at: Point,
        probes: &Probes,
        limit: f64,
    ) -> Option<f64> {
        let moved = at.distance(probes.from);
        // What the probes that were not looked at yet come to at least.
        let mut rest: f64 = probes.probes.iter().map(|probed| probed.least(moved)).sum();
        if rest >= limit {
            return None;
        }
        let patch = self.patch(problem, node, at);
        let mut error = 0.0;
        for probed in &probes.probes {
            rest -= probed.least(moved);
            let squared = if probed.reach == 0.0 {
                probed.squared
            } else {
                self.distance_squared(&patch, at, probed.probe)
            };
            error += squared * squared;
            if error + rest.max(0.0) >= limit {
                return None;
            }
        }
        Some(error)
    }

    /// How far a probe is apart, squared, with the node of the patch at `at`.
    fn distance_squared(&self, patch: &Patch, at: Point, probe: Probe) -> f64 {
        let from_solid = |p: Point| {
            let distance = self.solid.nearest(p).distance;
            distance * distance
        };
        match probe {
            Probe::Sample(own, p) => patch.distance_squared(own, p),
            Probe::Middle(half) => from_solid(patch.middle(half)),
            Probe::Node => from_solid(at),
        }
    }

    /// The samples of the solid at the quads around a node, each behind the place of its quad among these.
    fn samples(&self, node: u32) -> impl Iterator<Item = (usize, Point)> + '_ {
        let around = self.around[node as usize].iter().enumerate();
        around.flat_map(|(own, &q)| self.samples[q as usize].iter().map(move |&p| (own, p)))
    }

    /// Is the node a corner of this half of the quads around it?
    fn has(&self, node: u32, half: usize) -> bool {
        let [a, b, c, d] = self.quads[self.around[node as usize][half / 2] as usize];
        [[a, b, c], [a, c, d]][half % 2].contains(&node)
    }

    /// The quads around a node that stands at `at`.
    fn patch(&self, problem: &Problem, node: u32, at: Point) -> Patch {
        let place = |n: u32| if n == node { at } else { problem.points[n as usize] };
        let halves =
            |&q: &u32| halves(&self.quads[q as usize].map(place)).map(|half| (Aabb::around(&half), half));
        Patch { quads: self.around[node as usize].iter().map(halves).collect() }
    }
}

/// What is looked at to tell how far mesh and solid are apart around a node, what was farthest at first before all else:
/// that tells soonest where it would be farther.
pub(super) struct Probes {
    /// Where the node was at first.
    from: Point,
    probes: Vec<Probed>,
    /// What was apart at first.
    pub(super) error: f64,
}

/// How far a probe was apart at first, and squared, and the share of the node's way by which it may get nearer.
struct Probed {
    probe: Probe,
    squared: f64,
    distance: f64,
    reach: f64,
}

impl Probed {
    /// The least fourth power of its distance when the node has moved so far.
    fn least(&self, moved: f64) -> f64 {
        let distance = (self.distance - self.reach * moved).max(0.0);
        let squared = distance * distance;
        squared * squared
    }
}

/// A place of mesh or solid near a node.
#[derive(Clone, Copy)]
enum Probe {
    /// A sample of the solid that was nearest to this one of the node's quads.
    Sample(usize, Point),
    /// The middle of this half of the quads.
    Middle(usize),
    /// The node.
    Node,
}

impl Probes {
    /// The samples of the solid that are farthest from the quads, the farthest first.
    pub(super) fn farthest_samples(&self) -> impl Iterator<Item = Point> + '_ {
        self.probes.iter().filter_map(|probed| match &probed.probe {
            Probe::Sample(_, p) => Some(*p),
            _ => None,
        })
    }
}

/// Quads, each as two triangles within their boxes.
struct Patch {
    quads: Vec<[(Aabb, [Point; 3]); 2]>,
}

impl Patch {
    /// How far a sample is from these, of which the one at `own` is likely to be the nearest, squared.
    fn distance_squared(&self, own: usize, sample: Point) -> f64 {
        let to = |half: [Point; 3]| closest_on_triangle(sample, half).distance_squared(sample);
        let nearest = self.quads[own].iter().map(|&(_, half)| to(half)).fold(f64::INFINITY, f64::min);
        let others = self.quads[..own].iter().chain(&self.quads[own + 1..]).flatten();
        others.fold(nearest, |nearest, (bounds, half)| {
            if bounds.distance_squared(sample) < nearest { nearest.min(to(*half)) } else { nearest }
        })
    }

    /// How many triangles there are.
    fn halves(&self) -> usize {
        2 * self.quads.len()
    }

    /// The middle of a triangle.
    fn middle(&self, half: usize) -> Point {
        self.quads.as_flattened()[half].1.into_iter().sum::<Point>() / 3.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The boxes of the others only save work.
    #[test]
    fn the_distance_from_a_patch_is_that_from_its_nearest_half() {
        let height = |x: f64, y: f64| 0.3 * libm::sin(3.0 * x) * libm::sin(2.0 * y + 1.0);
        let at = |x: f64, y: f64| Point::new(x, y, height(x, y));
        let quad = |x: f64, y: f64| [at(x, y), at(x + 1.0, y), at(x + 1.0, y + 1.0), at(x, y + 1.0)];
        let quads = [quad(0.0, 0.0), quad(-1.0, 0.0), quad(-1.0, -1.0), quad(0.0, -1.0)].map(|q| halves(&q));
        let patch = Patch { quads: quads.map(|of| of.map(|half| (Aabb::around(&half), half))).to_vec() };
        for k in 0..300 {
            let [x, y, z] = [7, 11, 13].map(|n| f64::from(k % n) / f64::from(n) * 3.0 - 1.5);
            let sample = Point::new(x, y, z);
            let nearest = quads.as_flattened().iter().map(|&half| closest_on_triangle(sample, half));
            let expected = nearest.map(|p| p.distance_squared(sample)).fold(f64::INFINITY, f64::min);
            for own in 0..4 {
                assert!((patch.distance_squared(own, sample) - expected).abs() < 1e-12, "{sample} {own}");
            }
        }
    }
}
