//! How large a mesh will be, told before the work.
//!
//! Small results are simply made and counted. For large ones every element of the base level is asked whether it is
//! wanted finer; from there on the trees are followed on a sample: of the elements of each level about [`SAMPLE`]
//! are kept, chosen by a hash of their place so that no pattern of the mesh falls in step with the choice, and each
//! stands for as many as were passed over. Topology is never built, so strong balance and templates are left out;
//! they add rings of elements around regions, little beside the regions' insides.

use serde::Serialize;

use super::demand::{Demand, corner_quad, corner_quads, face_points, outline};
use super::options::{QuadOptions, RefineError};
use super::quad::refine_within;
use crate::geometry::Point;
use crate::mesh::{FaceId, PolygonMesh};
use crate::parallel;
use crate::{Cancelled, Monitor};

/// Results of no more quads than this are made and counted.
const COUNTED: u64 = 60_000;

/// About how many elements of a level are looked at: their share that is wanted finer is then known to a percent.
const SAMPLE: usize = 20_000;

/// How large a mesh will be.
#[derive(Clone, Debug, PartialEq, Serialize)]
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
    /// The regions that overlap no part of the input, by their places among the options'. They refine nothing.
    pub idle_regions: Vec<u32>,
}

impl Estimate {
    /// Peak memory of refinement in bytes for each quad of the result: level arrays and the growing node array stand
    /// beside it. `cargo bench --bench memory` counts 68 where everything is refined alike and 91 to 93 where a region
    /// is; half as much again is left for inputs that share fewer nodes and for pages that an allocator keeps.
    pub const BYTES_PER_QUAD: u64 = 150;
}

/// Tells how large the result of [`refine_quads`](super::refine_quads) will be. The limit of quads in `options` is not held against the estimate.
///
/// # Errors
/// If the input is no valid surface, an option is out of range, or the monitor stops it.
pub fn estimate_quads(
    input: &PolygonMesh,
    options: &QuadOptions,
    monitor: &dyn Monitor,
) -> Result<Estimate, RefineError> {
    let demand = Demand::new(input, options, monitor)?;
    let size = size(input, &demand, options, monitor)?;
    Ok(Estimate { idle_regions: demand.idle_regions(input, monitor)?, ..size })
}

/// The regions that overlap no part of the input, by their places among the options': they refine nothing.
///
/// # Errors
/// If the input is no valid surface, an option is out of range, or the monitor stops it.
pub fn idle_regions(
    input: &PolygonMesh,
    options: &QuadOptions,
    monitor: &dyn Monitor,
) -> Result<Vec<u32>, RefineError> {
    // What the options are made ready for is not needed then.
    if options.regions.is_empty() {
        return Ok(Vec::new());
    }
    Ok(Demand::new(input, options, monitor)?.idle_regions(input, monitor)?)
}

/// As [`estimate_quads`], of the figures alone.
fn size(
    input: &PolygonMesh,
    demand: &Demand,
    options: &QuadOptions,
    monitor: &dyn Monitor,
) -> Result<Estimate, RefineError> {
    let small = QuadOptions { max_quads: COUNTED, ..options.clone() };
    match refine_within(input, &small, monitor) {
        Ok(refined) => {
            let quads = refined.mesh.quads.len() as u64;
            let levels = refined.level.iter().copied().max().unwrap_or(0);
            let nodes = refined.mesh.positions.len() as u64;
            let bytes = quads * Estimate::BYTES_PER_QUAD;
            Ok(Estimate { quads, nodes, bytes, levels, exact: true, idle_regions: Vec::new() })
        }
        Err(RefineError::TooManyQuads { .. }) => Ok(follow_sample(input, demand, options, monitor)?),
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
    monitor: &dyn Monitor,
) -> Result<(), RefineError> {
    let deepest = demand.deepest(options.max_levels);
    // Level 1 has a quad at each corner of the input.
    let most = input.corners.len() as f64 * 4_f64.powi(i32::from(deepest) - 1);
    if most <= options.max_quads as f64 {
        return Ok(());
    }
    let Estimate { quads, levels: level, .. } = follow_sample(input, demand, options, monitor)?;
    let limit = options.max_quads;
    if quads as f64 > SAMPLING_ERROR * limit as f64 {
        return Err(RefineError::TooManyQuads { level, quads, limit });
    }
    Ok(())
}

/// An element of the sample.
#[derive(Clone, Copy)]
struct Sampled {
    corners: [Point; 4],
    root: FaceId,
}

impl Sampled {
    fn child(&self, corner: usize) -> Self {
        let (center, _) = outline(&self.corners);
        Self { corners: corner_quad(&self.corners, center, corner), root: self.root }
    }
}

/// Follows the trees from the base level down.
fn follow_sample(
    input: &PolygonMesh,
    demand: &Demand,
    options: &QuadOptions,
    monitor: &dyn Monitor,
) -> Result<Estimate, Cancelled> {
    let mut level = if options.keep_coarse { 0 } else { 1 };
    let wants = |level: u8, s: &Sampled| {
        level < options.max_levels && demand.wants(s.corners, outline(&s.corners).1, level, s.root)
    };
    let base_count = if options.keep_coarse { input.face_count() } else { input.corners.len() };
    let wanted = parallel::try_gather(input.face_count(), monitor, |f, found| {
        let elements = base(input, f, level).into_iter().enumerate();
        found.extend(elements.filter(|(_, s)| wants(level, s)).map(|(corner, _)| (f, corner)));
    })?;
    let mut quads = (base_count - wanted.len()) as f64;
    let kept = chosen(wanted.len(), level);
    let mut weight = wanted.len() as f64 / kept.len().max(1) as f64;
    let mut parents: Vec<Sampled> = kept
        .into_iter()
        .filter_map(|k| {
            let (face, corner) = wanted[k];
            base(input, face, level).into_iter().nth(corner)
        })
        .collect();
    while !parents.is_empty() {
        level += 1;
        let children = 4 * parents.len();
        let kept = chosen(children, level);
        weight *= children as f64 / kept.len() as f64;
        parents = parallel::try_gather(kept.len(), monitor, |k, found| {
            let (parent, corner) = (&parents[kept[k] / 4], kept[k] % 4);
            found.extend(Some(parent.child(corner)).filter(|s| wants(level, s)));
        })?;
        quads += weight * (kept.len() - parents.len()) as f64;
    }
    let quads = quads as u64;
    let (nodes, bytes) = (quads.saturating_add(quads / 64), quads.saturating_mul(Estimate::BYTES_PER_QUAD));
    Ok(Estimate { quads, nodes, bytes, levels: level, exact: false, idle_regions: Vec::new() })
}

/// About [`SAMPLE`] of the numbers below `count`, or all of them.
fn chosen(count: usize, level: u8) -> Vec<usize> {
    if count <= SAMPLE {
        return (0..count).collect();
    }
    let threshold = (u64::MAX as f64 * (SAMPLE as f64 / count as f64)) as u64;
    let kept: Vec<usize> = (0..count).filter(|&k| scrambled(k as u64, level) <= threshold).collect();
    if kept.is_empty() { vec![0] } else { kept }
}

/// A number that tells nothing of `k` (the finaliser of MurmurHash3).
fn scrambled(k: u64, level: u8) -> u64 {
    let mut h = k + (u64::from(level) << 56);
    for factor in [0xff51_afd7_ed55_8ccd, 0xc4ce_b9fe_1a85_ec53] {
        h = (h ^ (h >> 33)).wrapping_mul(factor);
    }
    h ^ (h >> 33)
}

/// The elements of the base level that are part of face `f`.
fn base(input: &PolygonMesh, f: usize, level: u8) -> Vec<Sampled> {
    let (points, root) = (face_points(input, f), FaceId::new(f));
    match <[Point; 4]>::try_from(&*points) {
        Ok(corners) if level == 0 => vec![Sampled { corners, root }],
        _ => corner_quads(&points).map(|corners| Sampled { corners, root }).collect(),
    }
}
