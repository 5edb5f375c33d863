//! The principal face of a solid along a direction (the paper's §4.1.2), meshed with quads.

use glam::DVec2;

use super::cover::cover;
use super::embed::{Embedding, TOLERANCE};
use super::graph::{Arc, Graph};
use super::mesher::{FaceError, mesh};
use super::project::{Projected, project};
use super::region::{RegionMesh, RegionOptions, region_mesh};
use super::relax::{part, relax};
use super::sample::{SampleError, sample};
use super::scale::Projection;
use super::shadow::Shadow;
use crate::geometry::Point;
use crate::hexing::extent::Extent;
use crate::solid::SolidModel;
use crate::{Monitor, Stage};

/// Curves that do not bound what is covered, and are closer than this to others are taken to lie on them: 0.4 h.
const INNER_TOLERANCE: f64 = 0.2;

/// Where less than this share of what the solid covers is left, since the sides of thin walls fell together, curves are laid
/// again with this share of the tolerances, and that again, down to a share.
const COVERED: f64 = 0.9;
const FINER: f64 = 0.25;
const FINEST: f64 = 1.0 / 256.0;

const PROJECT: Stage = Stage("project");

/// What a solid covers along a direction, in quads that follow its projected curves.
#[derive(Clone, Debug, PartialEq)]
pub struct PrincipalFace {
    /// Unit vectors of the face's plane, and the direction, right-handed: a point (x, y) of the mesh stands at
    /// x `axes[0]` + y `axes[1]`, anywhere along the direction.
    pub axes: [Point; 3],
    /// The quads. Nothing is told of dropped curves.
    pub mesh: RegionMesh,
    /// Arcs inside of the face, and holes too short to go around, that were given up (the paper's constraints
    /// relaxation).
    pub given_up: usize,
}

/// Projects a solid along `direction` and meshes what it covers with quads, about as long as `options` say. `tolerance` is
/// the share of the usual tolerances within which curves are one, 1 for those.
///
/// 1. `project`: feature curves, rims, where the surface turns away from the direction (`shadow` says which of them bound
///    what is covered), and rectangles around round holes and pins across it that are a few edges thick at most;
/// 2. `embed`: those are laid one after another, the outline first; what falls together nearly is one curve. A feature curve
///    along the direction is a node;
/// 3. `cover`: which parts between them the solid covers, and so which curves are the outline;
/// 4. `relax`: curves inside that would spoil the quads are given up, and those that cannot be told apart;
/// 5. the stages of [`quad_region`](super::quad_region) from `sample` on.
///
/// # Errors
/// See [`FaceError`].
pub fn principal_face(
    solid: &SolidModel,
    direction: Point,
    options: &RegionOptions,
    tolerance: f64,
    monitor: &dyn Monitor,
) -> Result<PrincipalFace, FaceError> {
    monitor.checkpoint(PROJECT, 0.0)?;
    let projection = Projection::new(solid.points(), direction, options.edge_length)?;
    let shadow = Shadow::new(solid, &projection);
    let projected = project(solid, &projection, &shadow, tolerance);
    let length: f64 =
        projected.curves().flat_map(|c| c.windows(2)).map(|pair: &[DVec2]| pair[0].distance(pair[1])).sum();
    options.refuse_quads(length)?;
    let mut finer = tolerance;
    let (mut graph, area) = loop {
        let mut graph = laid(&projected, finer, monitor)?;
        let area = cover(&mut graph, &shadow, monitor)?;
        if area >= COVERED * least_cover(solid, &projection) || finer <= FINEST {
            break (graph, area);
        }
        finer *= FINER;
    };
    let mut given_up = relax(&mut graph);
    if graph.segments.is_empty() {
        return Err(FaceError::Empty);
    }
    options.refuse_quads(4.0 * area)?;
    monitor.checkpoint(PROJECT, 1.0)?;
    let samples = loop {
        let arcs = graph.arcs();
        let crowded: Vec<Arc> = match sample(&graph, &arcs, tolerance < 1.0, monitor) {
            Err(SampleError::Crowded(crowded)) => crowded.iter().map(|&a| arcs[a].clone()).collect(),
            sampled => break sampled?,
        };
        match part(&mut graph, &crowded) {
            0 => return Err(FaceError::TooClose),
            parted => given_up += parted,
        }
    };
    let quads = mesh(&samples, area, monitor)?;
    Ok(PrincipalFace { axes: projection.axes, mesh: region_mesh(quads, &projection.scale), given_up })
}

/// Lays all that was projected, with this share of the usual tolerances.
fn laid(projected: &Projected, tolerance: f64, monitor: &dyn Monitor) -> Result<Graph, FaceError> {
    let mut embedding = Embedding::new(Graph::default(), tolerance * TOLERANCE);
    let count = projected.curves().count() as f64;
    for (k, curve) in projected.curves().enumerate() {
        monitor.checkpoint(PROJECT, k as f64 / count)?;
        if k == projected.outlines {
            embedding.tolerance = tolerance * INNER_TOLERANCE;
        }
        embedding.lay(curve);
    }
    for &point in &projected.points {
        embedding.keep(point);
    }
    Ok(embedding.graph)
}

/// The area that a solid covers at least along the direction, in units: its volume by its height.
fn least_cover(solid: &SolidModel, projection: &Projection) -> f64 {
    let height = Extent::of(solid.points().iter().copied(), projection.direction()).thickness();
    let unit = 2.0 * projection.scale.edge_length();
    solid.volume() / (height * unit * unit)
}

#[cfg(test)]
mod tests;
