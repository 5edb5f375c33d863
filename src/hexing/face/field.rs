//! Which way the cells are to lie, and how long they are to be, everywhere in a region.
//!
//! A cross field (four directions at right angles) that follows the constrained segments, and a field of lengths, both
//! as even as they can be in between: harmonic on the nodes of a triangulation. The cross is held as the fourth power of
//! one of its directions as a complex number, which is the same for all four; the lengths as a symmetric tensor L whose
//! product t·Lt is the logarithm of the length along a direction t. A segment says of L what is along it, and nothing
//! of what is across.
//!
//! Lengths are in units of 2h.

use glam::DVec2;

use super::sample::Samples;
use super::triangulation::{Triangles, Triangulation};
use crate::{Cancelled, Monitor};

/// Rounds over all nodes, at most: enough for a few hundred cells from side to side.
const ROUNDS: usize = 400;

/// Overrelaxation.
const OVER: f64 = 1.7;

/// No change of a round above this: the field is settled.
const SETTLED: f64 = 1e-3;

/// Lengths that segments may ask for, in units of 2h.
const LENGTHS: [f64; 2] = [0.4, 1.6];

/// A symmetric tensor by its entries xx, xy, yy.
type Tensor = [f64; 3];

/// A cross and a length tensor at each node of a triangulation.
pub(super) struct Field<'a> {
    triangulation: &'a Triangulation,
    points: &'a [DVec2],
    /// The fourth power of a direction, of any length.
    cross: Vec<DVec2>,
    length: Vec<Tensor>,
}

/// The field at a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Frame {
    /// Two directions at right angles, the second to the left of the first.
    pub(super) axes: [DVec2; 2],
    /// How long cells are to be along each.
    pub(super) lengths: [f64; 2],
}

impl<'a> Field<'a> {
    /// Solves for both fields on the nodes of `triangles`, which are those of `triangulation` inside the region; the
    /// first of `points` are the coarse samples.
    pub(super) fn new(
        triangulation: &'a Triangulation,
        triangles: &Triangles,
        points: &'a [DVec2],
        samples: &Samples,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let neighbours = neighbours(points.len(), triangles);
        let mut along: Vec<Vec<(DVec2, f64)>> = vec![Vec::new(); points.len()];
        let mut cross = vec![DVec2::ZERO; points.len()];
        for segment in &samples.segments {
            let [a, b] = segment.ends;
            let way = points[b as usize] - points[a as usize];
            let (direction, length) = (way.normalize(), way.length().clamp(LENGTHS[0], LENGTHS[1]));
            for end in [a, b] {
                along[end as usize].push((direction, libm::log(length)));
                cross[end as usize] += fourth_power(direction);
            }
        }
        let held: Vec<bool> = (0..points.len()).map(|p| cross[p].length() > 0.5).collect();
        for (cross, _) in cross.iter_mut().zip(&held).filter(|(_, held)| **held) {
            *cross = cross.normalize();
        }
        let mut field = Self { triangulation, points, cross, length: vec![[0.0; 3]; points.len()] };
        for _ in 0..ROUNDS {
            monitor.proceed()?;
            if field.relax(&neighbours, &along, &held) < SETTLED {
                break;
            }
        }
        Ok(field)
    }

    /// One round over all nodes; returns the greatest change.
    fn relax(&mut self, neighbours: &Neighbours, along: &[Vec<(DVec2, f64)>], held: &[bool]) -> f64 {
        let mut greatest = 0.0_f64;
        for p in 0..self.points.len() {
            let around = neighbours.of(p);
            if around.is_empty() {
                continue;
            }
            let share = 1.0 / around.len() as f64;
            if !held[p] {
                let mean = around.iter().map(|&n| self.cross[n as usize]).sum::<DVec2>() * share;
                let change = (mean - self.cross[p]) * OVER;
                self.cross[p] += change;
                greatest = greatest.max(change.length());
            }
            let mut length = [0, 1, 2].map(|i| {
                let mean = around.iter().map(|&n| self.length[n as usize][i]).sum::<f64>() * share;
                self.length[p][i] + (mean - self.length[p][i]) * OVER
            });
            // What is asked for along segments holds exactly; across, the mean does.
            for &(t, wanted) in &along[p] {
                let outer = [t.x * t.x, t.x * t.y, t.y * t.y];
                let missing = wanted - value(length, t);
                length = [0, 1, 2].map(|i| length[i] + missing * outer[i]);
            }
            let changes = [0, 1, 2].map(|i| (length[i] - self.length[p][i]).abs());
            greatest = changes.into_iter().fold(greatest, f64::max);
            self.length[p] = length;
        }
        greatest
    }

    /// The field at `point`, where `near` is a node close by, and a node closer by; `None` outside of the triangulation.
    pub(super) fn at(&self, point: DVec2, near: u32) -> Option<(Frame, u32)> {
        let (_, corners) = self.triangulation.locate(point, near)?;
        let [a, b, c] = corners.map(|corner| self.points[corner as usize]);
        let whole = (b - a).perp_dot(c - a);
        let weights = [(b - point).perp_dot(c - point), (c - point).perp_dot(a - point)];
        let [wa, wb] = weights.map(|w| if whole > 0.0 { (w / whole).clamp(0.0, 1.0) } else { 0.0 });
        let weights = [wa, wb, 1.0 - wa - wb];
        let mut cross = DVec2::ZERO;
        let mut length = [0.0; 3];
        for (corner, weight) in corners.map(|corner| corner as usize).into_iter().zip(weights) {
            cross += self.cross[corner] * weight;
            length = [0, 1, 2].map(|i| length[i] + self.length[corner][i] * weight);
        }
        Some((Frame::new(cross, length), corners[0]))
    }

    /// The field at a node.
    pub(super) fn at_node(&self, p: u32) -> Frame {
        Frame::new(self.cross[p as usize], self.length[p as usize])
    }
}

impl Frame {
    fn new(cross: DVec2, length: Tensor) -> Self {
        let angle = libm::atan2(cross.y, cross.x) / 4.0;
        let u = DVec2::new(libm::cos(angle), libm::sin(angle));
        let axes = [u, u.perp()];
        Self { axes, lengths: axes.map(|t| libm::exp(value(length, t)).clamp(LENGTHS[0], LENGTHS[1])) }
    }

    /// The direction of the cross that is closest to `way`, and the length along it.
    pub(super) fn along(&self, way: DVec2) -> (DVec2, f64) {
        let dots = self.axes.map(|axis| axis.dot(way));
        let k = usize::from(dots[1].abs() > dots[0].abs());
        (self.axes[k] * dots[k].signum(), self.lengths[k])
    }

    /// `way` in units of the lengths along the axes.
    pub(super) fn measure(&self, way: DVec2) -> DVec2 {
        DVec2::new(self.axes[0].dot(way) / self.lengths[0], self.axes[1].dot(way) / self.lengths[1])
    }
}

fn value(tensor: Tensor, t: DVec2) -> f64 {
    tensor[0] * t.x * t.x + 2.0 * tensor[1] * t.x * t.y + tensor[2] * t.y * t.y
}

/// The fourth power of a direction as a complex number.
fn fourth_power(t: DVec2) -> DVec2 {
    let square = |z: DVec2| DVec2::new(z.x * z.x - z.y * z.y, 2.0 * z.x * z.y);
    square(square(t))
}

/// The nodes that share an edge with each node.
struct Neighbours {
    offsets: Vec<u32>,
    all: Vec<u32>,
}

impl Neighbours {
    fn of(&self, p: usize) -> &[u32] {
        &self.all[self.offsets[p] as usize..self.offsets[p + 1] as usize]
    }
}

fn neighbours(count: usize, triangles: &Triangles) -> Neighbours {
    let mut pairs: Vec<[u32; 2]> = Vec::with_capacity(6 * triangles.corners.len());
    for &[a, b, c] in &triangles.corners {
        pairs.extend([[a, b], [b, a], [b, c], [c, b], [c, a], [a, c]]);
    }
    pairs.sort_unstable();
    pairs.dedup();
    let mut offsets = vec![0; count + 1];
    for [p, _] in &pairs {
        offsets[*p as usize + 1] += 1;
    }
    for p in 0..count {
        offsets[p + 1] += offsets[p];
    }
    Neighbours { offsets, all: pairs.into_iter().map(|[_, n]| n).collect() }
}
