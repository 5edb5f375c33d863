//! The swept background (the paper's §4.2): the quads of the principal face, layer by layer along the direction.

use std::sync::OnceLock;

use super::columns::{Columns, share_an_edge};
use super::levels::{ONE_STEP, levels};
use crate::geometry::Point;
use crate::hexing::extent::ROUNDED;
use crate::hexing::face::{FaceError, PrincipalFace, RegionMesh, RegionOptions, principal_face};
use crate::mesh::topology::{Bins, Sets};
use crate::mesh::{HexMesh, NodeId};
use crate::solid::SolidModel;
use crate::{Cancelled, Monitor, Stage, parallel};

/// Hexes whose centre is farther outside than this, in edge lengths, are dropped.
const FAR: f64 = 2.0;

const SWEEP: Stage = Stage("sweep");

/// Why a solid was not swept.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SweepError {
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The principal face was not meshed.
    #[error("the principal face cannot be meshed: {0}")]
    Face(FaceError),
    /// There would be more hexes than allowed.
    #[error("about {hexes:.3e} hexes are more than the limit of {limit}; raise the edge length")]
    TooManyHexes {
        /// How many hexes, about.
        hexes: f64,
        /// The limit.
        limit: u64,
    },
}

impl SweepError {
    /// A stable name of the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Cancelled(_) => "cancelled",
            Self::Face(error) => error.code(),
            Self::TooManyHexes { .. } => "too-many-hexes",
        }
    }
}

impl From<FaceError> for SweepError {
    fn from(error: FaceError) -> Self {
        match error {
            FaceError::Cancelled(cancelled) => Self::Cancelled(cancelled),
            error => Self::Face(error),
        }
    }
}

/// What [`Sweep::new`] is to make.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SweepOptions {
    /// How long the hexes' edges are, about, in model units.
    pub edge_length: f64,
    /// Refuse a sweep of more hexes than this.
    pub max_hexes: u64,
    /// The share of the usual tolerances within which curves, and layers, are one: less than 1 where walls, or steps, that are
    /// thinner than those are to be shown. Cells in them are as thin.
    pub tolerance: f64,
}

impl SweepOptions {
    /// Edges about so long, and at most 16 million hexes.
    pub fn new(edge_length: f64) -> Self {
        Self { edge_length, max_hexes: 16_000_000, tolerance: 1.0 }
    }
}

/// The principal face of a solid and the layers along a direction: a mesh, once it is swept.
#[derive(Clone, Debug, PartialEq)]
pub struct Sweep {
    face: PrincipalFace,
    /// Of all layers along the direction, ascending.
    heights: Vec<f64>,
    edge_length: f64,
    /// Which hexes there are, of all quads times all steps, once they were made: those of the same sweep are made for one attempt
    /// after the other.
    kept: OnceLock<Vec<u32>>,
}

impl Sweep {
    /// Meshes the principal face along `direction`, of any length but 0, and finds the layers: these stand in planar
    /// surfaces and curves across the direction, and around holes across it; between them edges are about as long as
    /// `options` say.
    ///
    /// # Errors
    /// See [`SweepError`]. The number of hexes, those far outside of the solid among them, is held against the limit
    /// before any is made.
    pub fn new(
        solid: &SolidModel,
        direction: Point,
        options: &SweepOptions,
        monitor: &dyn Monitor,
    ) -> Result<Self, SweepError> {
        let &SweepOptions { edge_length, max_hexes, tolerance } = options;
        let heights = layers(solid, direction, options)?;
        let steps = heights.len() as u64 - 1;
        let max_quads = max_hexes / steps;
        let too_many =
            |quads: f64| SweepError::TooManyHexes { hexes: quads * steps as f64, limit: max_hexes };
        let region = RegionOptions { edge_length, max_quads };
        let face = match principal_face(solid, direction, &region, tolerance, monitor) {
            Err(FaceError::TooManyQuads { quads, .. }) => return Err(too_many(quads)),
            // The estimate may have been too low.
            Ok(face) if face.mesh.quads.len() as u64 > 2 * max_quads => {
                return Err(too_many(face.mesh.quads.len() as f64));
            }
            face => face?,
        };
        Ok(Self { face: one_fan_a_point(face), heights, edge_length, kept: OnceLock::new() })
    }

    /// The least scaled Jacobian of the face's quads.
    pub fn worst_quad(&self) -> f64 {
        self.face.mesh.worst
    }

    /// The hexes in and around the `solid` that is swept: each is a quad of the face times a step. Those that are farther outside
    /// than two edge lengths are left out; all others are there, inside or outside. They are conforming and positive, and
    /// a manifold with boundary. Nodes and hexes are numbered layer by layer.
    ///
    /// # Errors
    /// If the monitor stops it.
    pub fn mesh(&self, solid: &SolidModel, monitor: &dyn Monitor) -> Result<HexMesh, Cancelled> {
        monitor.checkpoint(SWEEP, 0.0)?;
        let Self { face, heights, edge_length, .. } = self;
        let (points, quads) = (face.mesh.points.len(), face.mesh.quads.len());
        let [u, v, w] = face.axes;
        let position = |n: usize| {
            let (p, height) = (face.mesh.points[n % points], heights[n / points]);
            u * p.x + v * p.y + w * height
        };
        let hex = |k: usize| {
            let (quad, layer) = (face.mesh.quads[k % quads], k / quads);
            let at = |corner: usize, layer: usize| NodeId::new(quad[corner] as usize + layer * points);
            [0, 1, 2, 3, 4, 5, 6, 7].map(|k| at(k % 4, layer + k / 4))
        };
        let positions = parallel::try_collect(points * heights.len(), monitor, position)?;
        let is_near = |k: usize| {
            let centre = hex(k).iter().map(|n| positions[n.index()]).sum::<Point>() / 8.0;
            solid.signed_distance(centre) <= FAR * edge_length
        };
        if self.kept.get().is_none() {
            let near = parallel::try_collect(quads * (heights.len() - 1), monitor, is_near)?;
            monitor.checkpoint(SWEEP, 0.8)?;
            let kept = Columns::new(points, &face.mesh.quads, near).made_manifold(monitor)?;
            self.kept.get_or_init(|| kept);
        }
        let kept = self.kept.get().into_iter().flatten();
        let hexes = kept.map(|&k| hex(k as usize)).collect();
        monitor.checkpoint(SWEEP, 1.0)?;
        Ok(without_unused(HexMesh { positions, hexes, ..HexMesh::default() }))
    }
}

/// The face with a point of its own for each fan of quads: where parts of it touch at a point alone, so would the hexes.
fn one_fan_a_point(mut face: PrincipalFace) -> PrincipalFace {
    let RegionMesh { points, quads, on_curve, .. } = &mut face.mesh;
    let corners = quads.as_flattened();
    let at = Bins::of(points.len(), corners.len(), |k| corners[k] as usize);
    for p in 0..points.len() {
        let around = at.at(p);
        let mut fans = Sets::new(around.len());
        for (i, &k) in around.iter().enumerate() {
            for (j, &l) in around.iter().enumerate().take(i) {
                if share_an_edge(&quads[k as usize / 4], &quads[l as usize / 4]) {
                    fans.join(i as u32, j as u32, false);
                }
            }
        }
        let first = points.len() as u32;
        for (&k, fan) in around.iter().zip(fans.numbers()).filter(|(_, fan)| *fan > 0) {
            if first + fan > points.len() as u32 {
                points.push(points[p]);
                on_curve.push(on_curve[p]);
            }
            quads[k as usize / 4][k as usize % 4] = first + fan - 1;
        }
    }
    face
}

/// The heights of all layers along the direction, ascending.
fn layers(solid: &SolidModel, direction: Point, options: &SweepOptions) -> Result<Vec<f64>, SweepError> {
    let &SweepOptions { edge_length, max_hexes, tolerance } = options;
    if edge_length.is_nan() || edge_length <= 0.0 || edge_length.is_infinite() {
        return Err(FaceError::EdgeLength(edge_length).into());
    }
    let direction = direction.try_normalize().ok_or(FaceError::Direction)?;
    let levels = levels(solid, direction, edge_length, tolerance);
    let about = (levels[levels.len() - 1] - levels[0]) / edge_length;
    if about > max_hexes as f64 {
        return Err(SweepError::TooManyHexes { hexes: about, limit: max_hexes });
    }
    Ok(heights(&levels, edge_length))
}

/// The heights of all layers: steps of about the edge length from level to level.
fn heights(levels: &[f64], edge_length: f64) -> Vec<f64> {
    let mut heights = vec![levels[0]];
    for pair in levels.windows(2) {
        let edges = (pair[1] - pair[0]) / edge_length;
        let steps = if edges < ONE_STEP { 1.0 } else { (edges + ROUNDED).round().max(2.0) } as usize;
        let step = (pair[1] - pair[0]) / steps as f64;
        heights.extend((1..steps).map(|k| pair[0] + step * k as f64));
        heights.push(pair[1]);
    }
    heights
}

/// The mesh without nodes of no hex.
fn without_unused(mesh: HexMesh) -> HexMesh {
    let mut used = vec![false; mesh.positions.len()];
    mesh.hexes.as_flattened().iter().for_each(|n| used[n.index()] = true);
    let mut number = vec![NodeId(0); mesh.positions.len()];
    let in_use: Vec<usize> = (0..used.len()).filter(|&n| used[n]).collect();
    in_use.iter().enumerate().for_each(|(k, &n)| number[n] = NodeId::new(k));
    HexMesh {
        positions: in_use.iter().map(|&n| mesh.positions[n]).collect(),
        hexes: mesh.hexes.iter().map(|hex| hex.map(|n| number[n.index()])).collect(),
        ..HexMesh::default()
    }
}

#[cfg(test)]
mod tests;
