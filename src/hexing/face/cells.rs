//! Cells of quads and triangles, and the quads that all of them are split into.
//!
//! ```text
//!      c                 d------g------c
//!     / \                |      |      |
//!    f   e               h------m------f
//!   / \m/ \              |      |      |
//!  a---d---b             a------e------b
//! ```

use std::collections::HashMap;

use glam::DVec2;

use super::sample::{SampledSegment, Samples};
use super::triangulation::NONE;

/// The corners of a quad or triangle, counter-clockwise; the fourth of a triangle is [`NONE`].
pub(super) type Cell = [u32; 4];

/// The corners of a cell: three or four.
pub(super) fn corners(cell: &Cell) -> &[u32] {
    &cell[..if cell[3] == NONE { 3 } else { 4 }]
}

/// The scaled Jacobian of a quad: the least sine of its angles, negative for those above 180 degrees.
pub(super) fn quality(quad: &[DVec2; 4]) -> f64 {
    (0..4).map(|k| sine(quad[k], quad[(k + 1) % 4], quad[(k + 3) % 4])).fold(f64::INFINITY, f64::min)
}

/// The sine of the angle at `p` from `next` to `previous`; 0 beside an edge without length.
pub(super) fn sine(p: DVec2, next: DVec2, previous: DVec2) -> f64 {
    let (a, b) = (next - p, previous - p);
    let lengths = (a.length_squared() * b.length_squared()).sqrt();
    if lengths > 0.0 { a.perp_dot(b) / lengths } else { 0.0 }
}

/// The constrained segments, and which way curves leave their ends.
pub(super) struct Bends(HashMap<[u32; 2], DVec2>);

impl Bends {
    pub(super) fn new(samples: &Samples) -> Self {
        let bend = |s: &SampledSegment| (sorted(s.ends), samples.points[s.middle as usize]);
        Self(samples.segments.iter().map(bend).collect())
    }

    pub(super) fn is_constrained(&self, a: u32, b: u32) -> bool {
        self.0.contains_key(&sorted([a, b]))
    }

    /// The least sine of a cell's angles, as they are, and as they will be when it is split: sides on curves bent. At
    /// most 0.1 for a cell with a wide corner.
    pub(super) fn quality(&self, cell: &Cell, at: impl Fn(u32) -> DVec2) -> f64 {
        let nodes = corners(cell);
        let n = nodes.len();
        let angle = |k: usize| {
            let [here, next, previous] = [k, k + 1, k + n - 1].map(|i| nodes[i % n]);
            sine(at(here), at(next), at(previous)).min(self.sine(here, next, previous, &at))
        };
        let least = (0..n).map(angle).fold(f64::INFINITY, f64::min);
        if self.wide_corner(cell, &at).is_some() { least.min(TOO_WIDE) } else { least }
    }

    /// The sine of the angle at `here`.
    fn sine(&self, here: u32, next: u32, previous: u32, at: impl Fn(u32) -> DVec2) -> f64 {
        let towards = |n: u32| self.0.get(&sorted([here, n])).copied().unwrap_or_else(|| at(n));
        sine(at(here), towards(next), towards(previous))
    }

    /// The corner of a cell, if there is one, that is so wide between two sides on curves that two cells belong there.
    pub(super) fn wide_corner(&self, cell: &Cell, at: impl Fn(u32) -> DVec2) -> Option<usize> {
        let nodes = corners(cell);
        let n = nodes.len();
        (0..n).find(|&k| {
            let [here, next, previous] = [k, k + 1, k + n - 1].map(|i| nodes[i % n]);
            self.is_constrained(here, next)
                && self.is_constrained(here, previous)
                && (at(next) - at(here)).dot(at(previous) - at(here)) < 0.0
                && self.sine(here, next, previous, &at) < WIDE
        })
    }
}

fn sorted([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// What a cell with a wide corner is worth at most: no operation makes one.
const TOO_WIDE: f64 = 0.1;

/// The sine of 140 degrees.
const WIDE: f64 = 0.642_787_609_686_539_3;

/// The quads of a region while their nodes still move.
#[derive(Clone, Debug, Default)]
pub(super) struct Quads {
    pub(super) points: Vec<DVec2>,
    pub(super) cells: Vec<Cell>,
    /// Nodes on curves.
    pub(super) held: Vec<bool>,
    /// Where nodes on curves belong, for those that do not stand there yet.
    pub(super) pulled: Vec<(u32, DVec2)>,
}

/// Splits every cell. Nodes between samples stand on the straight line between them.
pub(super) fn split(points: &[DVec2], cells: &[Cell], samples: &Samples) -> Quads {
    let mut quads = Quads { points: points.to_vec(), ..Quads::default() };
    quads.held = (0..points.len()).map(|p| p < samples.coarse).collect();
    let mut middles: HashMap<[u32; 2], u32> = HashMap::new();
    let add = |quads: &mut Quads, point: DVec2, held: bool| {
        quads.points.push(point);
        quads.held.push(held);
        quads.points.len() as u32 - 1
    };
    for segment in &samples.segments {
        let [a, b] = segment.ends;
        let straight = points[a as usize].midpoint(points[b as usize]);
        let middle = add(&mut quads, straight, true);
        middles.insert(sorted([a, b]), middle);
        quads.pulled.push((middle, samples.points[segment.middle as usize]));
    }
    for cell in cells {
        let nodes = corners(cell);
        let n = nodes.len();
        let at: Vec<usize> = nodes.iter().map(|&node| node as usize).collect();
        let sides: Vec<u32> = (0..n)
            .map(|k| {
                let (a, b) = (nodes[k], nodes[(k + 1) % n]);
                *middles.entry(sorted([a, b])).or_insert_with(|| {
                    add(&mut quads, points[a as usize].midpoint(points[b as usize]), false)
                })
            })
            .collect();
        let centre = at.iter().map(|&p| points[p]).sum::<DVec2>() / n as f64;
        let centre = add(&mut quads, centre, false);
        quads.cells.extend((0..n).map(|k| [nodes[k], sides[k], centre, sides[(k + n - 1) % n]]));
    }
    quads
}
