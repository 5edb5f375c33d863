//! How large a mesh will be, told before the work.
//!
//! Small results are simply made and counted. For large ones the trees are followed on a sample: of the elements
//! of each level no more than [`SAMPLE`] are kept, evenly spaced in their order, and each stands for as many as
//! were passed over. Topology is never built, so strong balance and templates are left out of the sample; they
//! add rings of elements around regions, little beside the regions' insides.

use serde::Serialize;

use super::demand::{Demand, corner_quads, face_points, outline};
use super::options::{QuadOptions, RefineError};
use super::quad::refine_within;
use crate::Silent;
use crate::geometry::Point;
use crate::mesh::{FaceId, PolygonMesh};

/// Results of no more quads than this are made and counted.
const COUNTED: u64 = 60_000;

/// The most elements of a level that are looked at: enough for a few percent, and a few milliseconds.
const SAMPLE: usize = 20_000;

/// Peak memory of refinement over the size of the result, measured with `cargo bench --bench refine`: level
/// arrays and the growing node array stand beside the result.
const BYTES_PER_QUAD: u64 = 110;

/// How large a mesh will be.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Estimate {
    /// Quads of the mesh, about.
    pub quads: u64,
    /// Nodes of the mesh, about.
    pub nodes: u64,
    /// Peak memory of the work in bytes, about.
    pub bytes: u64,
    /// The deepest level.
    pub levels: u8,
    /// True if the figures but `bytes` are exact.
    pub exact: bool,
}

/// Tells how large the result of [`refine_quads`](super::refine_quads) will be, in a few milliseconds beyond one look at each face.
/// The limit of quads in `options` is not held against the estimate.
///
/// # Errors
/// If the input is no valid surface or an option is out of range.
pub fn estimate_quads(input: &PolygonMesh, options: &QuadOptions) -> Result<Estimate, RefineError> {
    let small = QuadOptions { max_quads: COUNTED, ..options.clone() };
    match refine_within(input, &small, &Silent) {
        Ok(refined) => {
            let quads = refined.mesh.quads.len() as u64;
            let levels = refined.level.iter().copied().max().unwrap_or(0);
            let nodes = refined.mesh.positions.len() as u64;
            Ok(Estimate { quads, nodes, bytes: quads * BYTES_PER_QUAD, levels, exact: true })
        }
        Err(RefineError::TooManyQuads { .. }) => {
            let demand = Demand::new(input, options)?;
            Ok(follow_sample(input, &demand, options))
        }
        Err(error) => Err(error),
    }
}

/// How far an estimate may be over the limit before the work is refused for it: the sample's own error.
const SAMPLING_ERROR: f64 = 1.1;

/// Refuses a result that will be far over the limit before any of it is made.
pub(super) fn refuse_absurd(
    input: &PolygonMesh,
    demand: &Demand,
    options: &QuadOptions,
) -> Result<(), RefineError> {
    let deepest = demand.deepest(options.max_levels);
    let most = input.corners.len() as f64 * 4_f64.powi(i32::from(deepest));
    if most <= options.max_quads as f64 {
        return Ok(());
    }
    let Estimate { quads, levels: level, .. } = follow_sample(input, demand, options);
    let limit = options.max_quads;
    if quads as f64 > SAMPLING_ERROR * limit as f64 {
        return Err(RefineError::TooManyQuads { level, quads, limit });
    }
    Ok(())
}

/// An element of the sample.
struct Sampled {
    corners: [Point; 4],
    root: FaceId,
}

/// Follows the trees on a sample of each level.
fn follow_sample(input: &PolygonMesh, demand: &Demand, options: &QuadOptions) -> Estimate {
    let mut level = if options.keep_coarse { 0 } else { 1 };
    let base_count = if options.keep_coarse { input.face_count() } else { input.corners.len() };
    let faces = (0..input.face_count()).step_by(input.face_count().div_ceil(SAMPLE));
    let mut sample: Vec<Sampled> = faces.flat_map(|f| base(input, f, level)).collect();
    let mut weight = base_count as f64 / sample.len() as f64;
    let mut quads = 0.0;
    loop {
        let count = sample.len();
        let kept: Vec<Sampled> = sample.into_iter().step_by(count.div_ceil(SAMPLE)).collect();
        weight *= count as f64 / kept.len() as f64;
        let (wanted, left): (Vec<_>, Vec<_>) = kept.into_iter().partition(|s| {
            level < options.max_levels && demand.wants(s.corners, outline(&s.corners).1, level, s.root)
        });
        quads += weight * left.len() as f64;
        if wanted.is_empty() {
            break;
        }
        sample = wanted.iter().flat_map(|s| split(&s.corners, s.root)).collect();
        level += 1;
    }
    let quads = quads as u64;
    let (nodes, bytes) = (quads.saturating_add(quads / 64), quads.saturating_mul(BYTES_PER_QUAD));
    Estimate { quads, nodes, bytes, levels: level, exact: false }
}

/// The elements of the base level that are part of face `f`.
fn base(input: &PolygonMesh, f: usize, level: u8) -> Vec<Sampled> {
    let (points, root) = (face_points(input, f), FaceId::new(f));
    match <[Point; 4]>::try_from(&*points) {
        Ok(corners) if level == 0 => vec![Sampled { corners, root }],
        _ => split(&points, root).collect(),
    }
}

/// The elements into which a polygon is refined.
fn split(points: &[Point], root: FaceId) -> impl Iterator<Item = Sampled> + '_ {
    corner_quads(points).map(move |corners| Sampled { corners, root })
}
