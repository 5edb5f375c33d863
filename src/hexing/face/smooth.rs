//! Moves the free nodes of a planar mesh of quads and triangles, all of which stay positive.
//!
//! The energy is that of `optimize` in the plane. With a and b the edges of a corner, counter-clockwise, and d their
//! determinant: f = (|a|^2 + |b|^2) / 2d of shape, r = |a||b| / d of angles alone, both 1 for a square and infinite where
//! d is zero; (1 - mu) f^p + mu r^p is summed over the corners and lowered node by node with Newton steps. A triangle has
//! one f, of what takes it to the equilateral one.

use glam::{DMat2, DVec2};

use super::cells::{Cell, corners, sine};
use crate::{Cancelled, Monitor};

/// A share of smoothing: rounds over all nodes with one energy.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course {
    /// p is 2 to this.
    pub(super) doublings: u32,
    pub(super) mu: f64,
    /// Nodes all of whose cells are better than this, by the scaled Jacobian, are left.
    pub(super) target: f64,
    pub(super) rounds: usize,
}

/// Nodes between two questions to the monitor.
const BATCH: usize = 1 << 12;

/// No cell is made worse than this, or worse than it was below this.
const FLOOR: f64 = 0.2;

/// Times that a step is halved.
const HALVINGS: u32 = 8;

/// The longest step, in units of the mean distance to the corners around.
const LONGEST: f64 = 0.4;

/// Runs the courses over all nodes that are not held.
pub(super) fn smooth(
    points: &mut [DVec2],
    cells: &[Cell],
    held: &[bool],
    courses: &[Course],
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    let stars = Stars::new(points.len(), cells);
    let mut star = Star::default();
    for course in courses {
        for _ in 0..course.rounds {
            for p in 0..points.len() {
                if p % BATCH == 0 {
                    monitor.proceed()?;
                }
                if !held[p] {
                    star.gather(points, cells, stars.of(p), p as u32);
                    if let Some(place) = star.improve(points[p], course) {
                        points[p] = place;
                    }
                }
            }
        }
    }
    Ok(())
}

/// The cells at each node.
pub(super) struct Stars {
    offsets: Vec<u32>,
    cells: Vec<u32>,
}

impl Stars {
    pub(super) fn new(nodes: usize, cells: &[Cell]) -> Self {
        let mut offsets = vec![0_u32; nodes + 1];
        for node in cells.iter().flat_map(corners) {
            offsets[*node as usize + 1] += 1;
        }
        for p in 0..nodes {
            offsets[p + 1] += offsets[p];
        }
        let mut next = offsets.clone();
        let mut all = vec![0; offsets[nodes] as usize];
        for (c, cell) in cells.iter().enumerate() {
            for &node in corners(cell) {
                all[next[node as usize] as usize] = c as u32;
                next[node as usize] += 1;
            }
        }
        Self { offsets, cells: all }
    }

    pub(super) fn of(&self, p: usize) -> &[u32] {
        &self.cells[self.offsets[p] as usize..self.offsets[p + 1] as usize]
    }
}

/// A corner of a cell at a node: a = a0 + sa v and b = b0 + sb v, where v is the node's place.
#[derive(Clone, Copy)]
struct Corner {
    a: (DVec2, f64),
    b: (DVec2, f64),
    /// b is to be taken to the right angle of an equilateral triangle.
    of_triangle: bool,
}

/// The corners that change when one node moves.
#[derive(Default)]
struct Star {
    corners: Vec<Corner>,
    size: f64,
}

/// An energy's value, gradient and second derivatives.
#[derive(Clone, Copy, Default)]
struct Expansion {
    value: f64,
    gradient: DVec2,
    hessian: DMat2,
}

impl Star {
    fn gather(&mut self, points: &[DVec2], cells: &[Cell], around: &[u32], node: u32) {
        self.corners.clear();
        let (mut size, mut count) = (0.0, 0);
        let here = points[node as usize];
        for &c in around {
            let nodes = corners(&cells[c as usize]);
            let n = nodes.len();
            let k = nodes.iter().position(|&other| other == node).expect("the cell is at the node");
            let at = |i: usize| points[nodes[(k + i) % n] as usize];
            size += here.distance(at(1)) + here.distance(at(n - 1));
            count += 2;
            self.corners.push(Corner { a: (at(1), -1.0), b: (at(n - 1), -1.0), of_triangle: n == 3 });
            if n == 4 {
                let (next, across, previous) = (at(1), at(2), at(3));
                self.corners.push(Corner { a: (across - next, 0.0), b: (-next, 1.0), of_triangle: false });
                self.corners.push(Corner {
                    a: (-previous, 1.0),
                    b: (across - previous, 0.0),
                    of_triangle: false,
                });
            }
        }
        self.size = size / f64::from(count.max(1));
    }

    /// A better place for the node than `here`, if there is one.
    fn improve(&self, here: DVec2, course: &Course) -> Option<DVec2> {
        let worst = self.worst(here);
        if worst > course.target || self.corners.is_empty() {
            return None;
        }
        let now = self.expand(here, course)?;
        let mut step = now.descent();
        let length = step.length();
        if length > LONGEST * self.size {
            step *= LONGEST * self.size / length;
        }
        if length < 1e-9 * self.size || !step.is_finite() {
            return None;
        }
        for _ in 0..HALVINGS {
            let there = here + step;
            let better = self.expand(there, course).is_some_and(|then| then.value < now.value);
            if better && self.worst(there) >= worst.min(FLOOR) {
                return Some(there);
            }
            step *= 0.5;
        }
        None
    }

    /// The least sine of the corners.
    fn worst(&self, v: DVec2) -> f64 {
        let sines = self.corners.iter().map(|corner| {
            let (a, b) = corner.edges(v);
            sine(DVec2::ZERO, a, b)
        });
        sines.fold(f64::INFINITY, f64::min)
    }

    /// `None` where a corner is not positive.
    fn expand(&self, v: DVec2, course: &Course) -> Option<Expansion> {
        let mut sum = Expansion::default();
        for corner in &self.corners {
            let of = corner.expand(v, course)?;
            sum.value += of.value;
            sum.gradient += of.gradient;
            sum.hessian += of.hessian;
        }
        sum.value.is_finite().then_some(sum)
    }
}

impl Expansion {
    /// Newton's step where the energy bends upwards, else a step down the gradient.
    fn descent(&self) -> DVec2 {
        let (trace, determinant) =
            (self.hessian.x_axis.x + self.hessian.y_axis.y, self.hessian.determinant());
        if trace > 0.0 && determinant > 1e-6 * trace * trace {
            -(self.hessian.inverse() * self.gradient)
        } else {
            -self.gradient / self.hessian.x_axis.length().max(self.hessian.y_axis.length()).max(1e-300)
        }
    }
}

/// What takes the edges at a corner of an equilateral triangle to those of a square: b' = (b - a/2) 2/sqrt(3).
const UPRIGHT: f64 = 1.154_700_538_379_251_5;

impl Corner {
    fn edges(&self, v: DVec2) -> (DVec2, DVec2) {
        (self.a.0 + v * self.a.1, self.b.0 + v * self.b.1)
    }

    fn expand(&self, v: DVec2, course: &Course) -> Option<Expansion> {
        let (a, mut b) = self.edges(v);
        let (sa, mut sb) = (self.a.1, self.b.1);
        if self.of_triangle {
            b = (b - a * 0.5) * UPRIGHT;
            sb = (sb - sa * 0.5) * UPRIGHT;
        }
        let d = a.perp_dot(b);
        let (aa, bb) = (a.length_squared(), b.length_squared());
        if d.is_nan() || d <= 0.0 {
            return None;
        }
        // d is linear in v: with a x b = a.x b.y - a.y b.x.
        let of_d = DVec2::new(sa * b.y - sb * a.y, sb * a.x - sa * b.x) / d;
        let outer_d = outer(of_d);
        let sum = aa + bb;
        let of_sum = (a * sa + b * sb) * (2.0 / sum);
        let bend = DMat2::from_diagonal(DVec2::splat(2.0 * (sa * sa + sb * sb) / sum));
        // The logarithm of f, which is ln(sum) - ln(d) - ln(2).
        let shape = raise(sum / (2.0 * d), of_sum - of_d, bend - outer(of_sum) + outer_d, course.doublings);
        if course.mu == 0.0 || self.of_triangle {
            return Some(shape);
        }
        let (of_aa, of_bb) = (a * (sa / aa), b * (sb / bb));
        let bend = DMat2::from_diagonal(DVec2::splat(sa * sa / aa + sb * sb / bb));
        // The logarithm of r, which is ln(aa)/2 + ln(bb)/2 - ln(d).
        let second = bend - outer(of_aa) * 2.0 - outer(of_bb) * 2.0 + outer_d;
        let angles = raise((aa * bb).sqrt() / d, of_aa + of_bb - of_d, second, course.doublings);
        let blend = |s: f64, r: f64| s + (r - s) * course.mu;
        Some(Expansion {
            value: blend(shape.value, angles.value),
            gradient: shape.gradient.lerp(angles.gradient, course.mu),
            hessian: shape.hessian * (1.0 - course.mu) + angles.hessian * course.mu,
        })
    }
}

fn outer(g: DVec2) -> DMat2 {
    DMat2::from_cols(g * g.x, g * g.y)
}

/// `value` to the power of 2 to `doublings`, from its logarithm's derivatives.
fn raise(value: f64, of_log: DVec2, of_log_twice: DMat2, doublings: u32) -> Expansion {
    let (mut power, mut p) = (value, 1.0);
    for _ in 0..doublings {
        power *= power;
        p *= 2.0;
    }
    Expansion {
        value: power,
        gradient: of_log * (p * power),
        hessian: (of_log_twice + outer(of_log) * p) * (p * power),
    }
}
