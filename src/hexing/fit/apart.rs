//! How far the boundary of a mesh and a solid are from each other around each node that moves, by the samples of a
//! [`Survey`].

use super::survey::Survey;
use crate::geometry::{Aabb, CutQuad, Point};
use crate::mesh::NodeId;
use crate::optimize::Problem;
use crate::parallel::greatest_first;
use crate::solid::{SolidModel, SurfaceId};

/// What is no farther from the solid than this share of its diagonal is on it.
const ON: f64 = 1e-9;

/// How far a mesh whose nodes move, and a solid are from each other around these.
pub(super) struct Apart<'a> {
    pub(super) solid: &'a SolidModel,
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
        self.solid.distance(place).max(ON * self.solid.diagonal())
    }

    /// Is a place no farther from the solid than `reach`?
    pub(super) fn is_within(&self, place: Point, reach: f64) -> bool {
        self.solid.distance(place) <= reach
    }

    /// What is looked at around a node, and how far that is apart with the node where it is.
    pub(super) fn probes(&self, problem: &Problem, node: u32) -> Probes {
        let from = problem.points[node as usize];
        let patch = self.patch(problem, node, from);
        let quads = 0..patch.quads.len();
        let of_quads = quads.flat_map(|own| [Probe::Diagonal(own), Probe::Side(own)]);
        let of_mesh = of_quads.chain([Probe::Node]);
        let all = self.samples(node).map(|(own, p)| Probe::Sample(own, p)).chain(of_mesh);
        let all: Vec<Probed> = all
            .map(|probe| {
                let squared = self.distance_squared(&patch, from, probe);
                let reach = match probe {
                    Probe::Sample(..) | Probe::Node => 1.0,
                    Probe::Side(_) | Probe::Diagonal(_) => 0.5,
                };
                Probed { probe, squared, distance: squared.sqrt(), reach }
            })
            .collect();
        let order = greatest_first(all.iter().map(|probed| probed.squared));
        let probes: Vec<Probed> = order.map(|k| all[k]).collect();
        let error = probes.iter().map(|probed| cubed(probed.squared)).sum();
        Probes { from, probes, error }
    }

    /// What is apart with the node at `at`, if that is less than `limit`: the sum of the sixth powers of all distances.
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
            let squared = self.distance_squared(&patch, at, probed.probe);
            error += cubed(squared);
            if error + rest.max(0.0) >= limit {
                return None;
            }
        }
        Some(error)
    }

    /// How far a probe is apart, squared, with the node of the patch at `at`.
    fn distance_squared(&self, patch: &Patch, at: Point, probe: Probe) -> f64 {
        let from_solid = |p: Point| {
            let distance = self.solid.distance(p);
            distance * distance
        };
        match probe {
            Probe::Sample(own, p) => patch.distance_squared(own, p),
            Probe::Diagonal(own) => from_solid(at.midpoint(patch.quads[own].corner(2))),
            Probe::Side(own) => from_solid(at.midpoint(patch.quads[own].corner(1))),
            Probe::Node => from_solid(at),
        }
    }

    /// The samples of the solid at the quads around a node, each behind the place of its quad among these.
    fn samples(&self, node: u32) -> impl Iterator<Item = (usize, Point)> + '_ {
        let around = self.around[node as usize].iter().enumerate();
        around.flat_map(|(own, &q)| self.samples[q as usize].iter().map(move |&p| (own, p)))
    }

    /// The quads around a node that stands at `at`.
    fn patch(&self, problem: &Problem, node: u32, at: Point) -> Patch {
        let place = |n: u32| if n == node { at } else { problem.points[n as usize] };
        let of_quad = |&q: &u32| {
            let quad = self.quads[q as usize];
            let own = quad.iter().position(|&n| n == node).expect("a quad around the node");
            PatchQuad::new(std::array::from_fn(|k| place(quad[(own + k) % 4])))
        };
        Patch { quads: self.around[node as usize].iter().map(of_quad).collect() }
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
#[derive(Clone, Copy)]
struct Probed {
    probe: Probe,
    squared: f64,
    distance: f64,
    reach: f64,
}

impl Probed {
    /// The least sixth power of its distance when the node has moved so far.
    fn least(&self, moved: f64) -> f64 {
        power((self.distance - self.reach * moved).max(0.0))
    }
}

/// The sixth power of a distance, of which all are summed so that the greatest count.
pub(super) fn power(distance: f64) -> f64 {
    cubed(distance * distance)
}

fn cubed(squared: f64) -> f64 {
    squared * squared * squared
}

/// A place of mesh or solid near a node.
#[derive(Clone, Copy)]
enum Probe {
    /// A sample of the solid that was nearest to this one of the node's quads.
    Sample(usize, Point),
    /// The middle of the diagonal from the node through this one of its quads. The other stays where it is.
    Diagonal(usize),
    /// The middle of the side from the node to the next of this quad. On a closed boundary each side at the node is one.
    Side(usize),
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

/// The quads around a node.
struct Patch {
    quads: Vec<PatchQuad>,
}

/// A quad within its box.
struct PatchQuad {
    bounds: Aabb,
    cut: CutQuad,
}

impl PatchQuad {
    /// With these corners, of which the first is the node.
    fn new(corners: [Point; 4]) -> Self {
        Self { bounds: Aabb::around(&corners), cut: CutQuad(corners) }
    }

    /// So many corners behind the node.
    fn corner(&self, k: usize) -> Point {
        self.cut.0[k]
    }
}

impl Patch {
    /// How far a sample is from these, of which the one at `own` is likely to be the nearest, squared.
    fn distance_squared(&self, own: usize, sample: Point) -> f64 {
        let others = self.quads[..own].iter().chain(&self.quads[own + 1..]);
        others.fold(self.quads[own].cut.distance_squared(sample), |nearest, quad| {
            let may_be_nearer = quad.bounds.distance_squared(sample) < nearest;
            if may_be_nearer { nearest.min(quad.cut.distance_squared(sample)) } else { nearest }
        })
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::testing::house;
    use super::*;
    use crate::Silent;
    use crate::hexing::correspondence::{Anchor, correspond};

    /// The boxes of the others only save work.
    #[test]
    fn the_distance_from_a_patch_is_that_from_its_nearest_quad() {
        let height = |x: f64, y: f64| 0.3 * libm::sin(3.0 * x) * libm::sin(2.0 * y + 1.0);
        let at = |x: f64, y: f64| Point::new(x, y, height(x, y));
        let quad = |x: f64, y: f64| [at(x, y), at(x + 1.0, y), at(x + 1.0, y + 1.0), at(x, y + 1.0)];
        let quads = [quad(0.0, 0.0), quad(-1.0, 0.0), quad(-1.0, -1.0), quad(0.0, -1.0)];
        let patch = Patch { quads: quads.into_iter().map(PatchQuad::new).collect() };
        for k in 0..300 {
            let [x, y, z] = [7, 11, 13].map(|n| f64::from(k % n) / f64::from(n) * 3.0 - 1.5);
            let sample = Point::new(x, y, z);
            let squared = quads.iter().map(|&quad| CutQuad(quad).distance_squared(sample));
            let expected = squared.fold(f64::INFINITY, f64::min);
            for own in 0..4 {
                assert!((patch.distance_squared(own, sample) - expected).abs() < 1e-12, "{sample} {own}");
            }
        }
    }

    /// Nothing gets nearer than is told without looking at it, and what is left out is not in the error's way.
    #[test]
    fn what_is_told_without_looking_is_what_looking_tells() {
        let (solid, mesh) = house(0.0);
        let on = correspond(&mesh, &solid, &Silent).unwrap();
        let mut survey = Survey::new(&mesh, &on.faces, &solid);
        survey.renew(&mesh, &Silent).unwrap();
        let is_outside = |n: NodeId| on.anchors[n.index()] != Anchor::Inside;
        let problem = Problem::new(&mesh.positions, &mesh.hexes, &is_outside);
        let apart = Apart::new(&problem, &on.faces, &survey);
        let mut refused = 0;
        for node in 0..problem.movable() as u32 {
            let from = problem.points[node as usize];
            let probes = apart.probes(&problem, node);
            for step in [0.0, 0.01, 0.1, 0.3] {
                let way = Point::new(0.6, -0.48, 0.64) * (step * problem.edge(node));
                let patch = apart.patch(&problem, node, from + way);
                let sixth_power = |probed: &Probed| {
                    let squared = apart.distance_squared(&patch, from + way, probed.probe);
                    assert!(probed.least(way.length()) <= cubed(squared) * (1.0 + 1e-9) + 1e-30);
                    cubed(squared)
                };
                let all: f64 = probes.probes.iter().map(sixth_power).sum();
                let error = |limit: f64| apart.error(&problem, node, from + way, &probes, limit);
                assert_eq!(error(f64::INFINITY), Some(all));
                if all > 0.0 {
                    assert_eq!([error(all * 1.001), error(all * 0.999)], [Some(all), None]);
                    refused += 1;
                }
            }
        }
        assert!(refused > 0);
    }
}
