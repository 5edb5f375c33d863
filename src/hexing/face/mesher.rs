//! The stages of the planar mesher, on a graph of curves in units of 2h.

use std::collections::HashSet;
use std::ops::Range;

use glam::DVec2;

use super::cells::{Bends, Cell, Quads, quality, split};
use super::field::Field;
use super::pack::{Ground, pack};
use super::pair::pair;
use super::sample::Samples;
use super::smooth::{Course, Stars, smooth};
use super::tidy::Patch;
use super::triangulation::{Outcome, Triangles, Triangulation};
use crate::mesh::NodeId;
use crate::{Cancelled, Monitor, Stage};

/// The stages that a monitor hears of.
pub(super) const SAMPLE: Stage = Stage("sample");
pub(super) const PACK: Stage = Stage("pack");
pub(super) const PAIR: Stage = Stage("pair");
pub(super) const TIDY: Stage = Stage("tidy");
pub(super) const SMOOTH: Stage = Stage("smooth");

/// Why a region was not meshed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum FaceError {
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The edge length is no positive number.
    #[error("the edge length is {0}; give a positive number")]
    EdgeLength(f64),
    /// The direction is no direction.
    #[error("the direction has no length, or is not finite; give another one")]
    Direction,
    /// There is nothing to mesh.
    #[error(
        "the region has no area: there are no polygons, or none is left where those that are given twice or cross themselves \
         cancel out; give polygons that enclose an area"
    )]
    Empty,
    /// The faces are no polygons; each kind of defect in words.
    #[error("the faces cannot be meshed: {}", .0.join("; "))]
    Invalid(Vec<String>),
    /// A point is not in the plane of the others.
    #[error("point {node} is {off:e} off the plane of the faces; {allowed:e} is allowed: give a planar face")]
    NotPlanar {
        /// The number of the point, from 0.
        node: u32,
        /// How far off it is.
        off: f64,
        /// How far off it may be: a millionth of the diagonal.
        allowed: f64,
    },
    /// A coordinate is no number.
    #[error("point {0} has a coordinate that is not finite; correct it")]
    NotFinite(u32),
    /// The outline does not close.
    #[error("the outline is open at point {node} ({}, {}); close it", .at[0], .at[1])]
    Open {
        /// The number of the point.
        node: u32,
        /// Where it is, in the region's plane.
        at: [f64; 2],
    },
    /// The outline crosses or touches itself between its points.
    #[error(
        "the outline crosses or touches itself at its segment from point {} to point {} (from {}, {}); mend it there",
        .ends[0], .ends[1], .at[0], .at[1]
    )]
    Crossing {
        /// The segment's points.
        ends: [u32; 2],
        /// Where the first of them is, in the region's plane.
        at: [f64; 2],
    },
    /// The mesh would have more quads than allowed.
    #[error(
        "the mesh would have about {quads:.0} quads, more than the limit of {limit}; raise the edge length or the limit"
    )]
    TooManyQuads {
        /// How many quads it would come to, about.
        quads: f64,
        /// The limit.
        limit: u64,
    },
    /// The edge length is too small for the digits of the coordinates.
    #[error(
        "an edge length of {edge_length:e} is too small for coordinates that reach {reach:e}; raise it, or move the region"
    )]
    TooFewDigits {
        /// The edge length.
        edge_length: f64,
        /// The greatest coordinate, without its sign.
        reach: f64,
    },
    /// Curves lie too close together for the edge length.
    #[error(
        "curves lie too close together to be told apart by segments of this edge length; lower it, or part the curves"
    )]
    TooClose,
}

impl FaceError {
    /// The same for a region whose point k is node k of `nodes`.
    pub(super) fn with_nodes(self, nodes: &[NodeId]) -> Self {
        let name = |p: u32| nodes[p as usize].0;
        match self {
            Self::NotFinite(p) => Self::NotFinite(name(p)),
            Self::Open { node, at } => Self::Open { node: name(node), at },
            Self::Crossing { ends, at } => Self::Crossing { ends: ends.map(name), at },
            other => other,
        }
    }

    /// A stable name of the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Cancelled(_) => "cancelled",
            Self::EdgeLength(_) => "edge-length-out-of-range",
            Self::Direction => "no-direction",
            Self::Empty => "region-empty",
            Self::Invalid(_) => "face-invalid",
            Self::NotPlanar { .. } => "not-planar",
            Self::NotFinite(_) => "region-not-finite",
            Self::Open { .. } => "outline-open",
            Self::Crossing { .. } => "outline-crosses-itself",
            Self::TooManyQuads { .. } => "too-many-quads",
            Self::TooFewDigits { .. } => "too-few-digits",
            Self::TooClose => "curves-too-close",
        }
    }
}

/// Rounds in which nodes between samples are pulled to their curves, by the least scaled Jacobian that is left there.
const PULLS: [f64; 7] = [0.5, 0.4, 0.3, 0.2, 0.1, 0.05, 0.02];

/// Between pulls.
const AFTER_PULL: Course = Course { doublings: 0, mu: 0.0, target: 2.0, rounds: 3 };

/// In the end: shape first, then more and more the worst angles alone.
const POLISH: [Course; 4] = [
    Course { doublings: 0, mu: 0.0, target: 2.0, rounds: 6 },
    Course { doublings: 1, mu: 0.3, target: 0.95, rounds: 8 },
    Course { doublings: 2, mu: 0.9, target: 0.8, rounds: 8 },
    Course { doublings: 3, mu: 1.0, target: 0.5, rounds: 8 },
];

/// Meshes the inside of the outline among `samples`; `area` is that of the inside.
pub(super) fn mesh(samples: &Samples, area: f64, monitor: &dyn Monitor) -> Result<Quads, FaceError> {
    let points = place(samples, area, monitor)?;
    let (triangles, _) = triangulate(&points, samples, monitor)?;
    let bends = Bends::new(samples);
    let cells = pair(triangles, &points, &bends, monitor)?;
    let mut patch = Patch::new(points, cells, samples, &bends);
    patch.tidy(monitor)?;
    let mut quads = split(&patch.points, &patch.cells, samples);
    finish(&mut quads, monitor)?;
    let quads = quads.compact();
    let is_positive = |cell: &Cell| quads.quality(cell) > 0.0;
    if quads.cells.is_empty() || !quads.cells.iter().all(is_positive) {
        return Err(FaceError::TooClose);
    }
    Ok(quads)
}

/// The coarse samples and points between them: once in rows along the nearest segments, and with the field that was
/// solved for on those in rows along that.
fn place(samples: &Samples, area: f64, monitor: &dyn Monitor) -> Result<Vec<DVec2>, FaceError> {
    let (_, coarse) = triangulate(&samples.points[..samples.coarse], samples, monitor)?;
    let (triangulation, inside) = (&coarse.triangulation, &coarse.inside);
    let ground = Ground { samples, triangulation, inside, expected: area + samples.coarse as f64 };
    let first = pack(&ground, None, [0.0, 0.4], monitor)?;
    let (triangles, fine) = triangulate(&first, samples, monitor)?;
    let field = Field::new(&fine.triangulation, &triangles, &first, samples, monitor)?;
    Ok(pack(&ground, Some(&field), [0.5, 1.0], monitor)?)
}

/// A triangulation with the constrained segments, and which of its faces are inside of the outline.
struct Constrained {
    triangulation: Triangulation,
    inside: Vec<bool>,
}

fn triangulate(
    points: &[DVec2],
    samples: &Samples,
    monitor: &dyn Monitor,
) -> Result<(Triangles, Constrained), FaceError> {
    let mut triangulation = Triangulation::new();
    let insert = |triangulation: &mut Triangulation, places: Range<usize>| {
        for k in places {
            // Points that fall together have one number: those after them would have others than here.
            if triangulation.insert(points[k], monitor)? as usize != k {
                return Err(FaceError::TooClose);
            }
        }
        Ok(())
    };
    insert(&mut triangulation, 0..samples.coarse)?;
    let mut outline = HashSet::new();
    for segment in &samples.segments {
        let [a, b] = segment.ends;
        if triangulation.constrain([a, b], monitor)? != Outcome::Added {
            return Err(FaceError::TooClose);
        }
        if segment.outline {
            outline.insert([a.min(b), a.max(b)]);
        }
    }
    insert(&mut triangulation, samples.coarse..points.len())?;
    let inside = triangulation.inside(|edge| outline.contains(&edge));
    let triangles = triangulation.triangles(&inside);
    Ok((triangles, Constrained { triangulation, inside }))
}

/// Brings the nodes between samples to their curves, and smooths.
fn finish(quads: &mut Quads, monitor: &dyn Monitor) -> Result<(), Cancelled> {
    let stars = Stars::new(quads.points.len(), &quads.cells);
    for (round, least) in PULLS.into_iter().enumerate() {
        monitor.checkpoint(SMOOTH, 0.5 * round as f64 / PULLS.len() as f64)?;
        quads.pull(&stars, least);
        if quads.pulled.is_empty() {
            break;
        }
        smooth(&mut quads.points, &quads.cells, &quads.held, &[AFTER_PULL], monitor)?;
    }
    for (k, course) in POLISH.into_iter().enumerate() {
        monitor.checkpoint(SMOOTH, 0.5 + 0.5 * k as f64 / POLISH.len() as f64)?;
        smooth(&mut quads.points, &quads.cells, &quads.held, &[course], monitor)?;
    }
    monitor.checkpoint(SMOOTH, 1.0)
}

impl Quads {
    /// Moves nodes to where they belong, or half the way, where no quad around gets worse than `least`, or worse than
    /// it was.
    fn pull(&mut self, stars: &Stars, least: f64) {
        let pulled = std::mem::take(&mut self.pulled);
        for (node, target) in pulled {
            let from = self.points[node as usize];
            let before = self.worst(stars.of(node as usize));
            let arrived = [1.0, 0.5].into_iter().find(|&share| {
                self.points[node as usize] = if share == 1.0 { target } else { from.lerp(target, share) };
                self.worst(stars.of(node as usize)) >= least.min(before)
            });
            if arrived.is_none() {
                self.points[node as usize] = from;
            }
            if arrived != Some(1.0) {
                self.pulled.push((node, target));
            }
        }
    }

    fn worst(&self, cells: &[u32]) -> f64 {
        cells.iter().map(|&c| self.quality(&self.cells[c as usize])).fold(f64::INFINITY, f64::min)
    }

    /// The scaled Jacobian of a quad.
    pub(super) fn quality(&self, cell: &Cell) -> f64 {
        quality(&cell.map(|n| self.points[n as usize]))
    }

    /// The same without nodes that no quad has.
    fn compact(self) -> Self {
        let mut used = vec![false; self.points.len()];
        self.cells.as_flattened().iter().for_each(|&n| used[n as usize] = true);
        let mut number = vec![0_u32; self.points.len()];
        let in_use = (0..used.len()).filter(|&n| used[n]);
        in_use.enumerate().for_each(|(k, n)| number[n] = k as u32);
        let kept = |n: &usize| used[*n];
        let all = 0..self.points.len();
        Self {
            points: all.clone().filter(kept).map(|n| self.points[n]).collect(),
            cells: self.cells.iter().map(|cell| cell.map(|n| number[n as usize])).collect(),
            held: all.filter(kept).map(|n| self.held[n]).collect(),
            pulled: self.pulled.iter().map(|&(n, target)| (number[n as usize], target)).collect(),
        }
    }
}
