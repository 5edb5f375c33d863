//! Conforming refinement of quad meshes (Ebeida, Patney, Owens, Mestreau: section 2).

use serde::{Deserialize, Serialize};

use crate::mesh::{FaceId, PolygonMesh, QuadMesh, Tags};
use crate::sizing::Region;
use crate::{Cancelled, Monitor};

/// What [`refine_quads`] is to do. Lengths are in model units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct QuadOptions {
    /// No edge longer than this, anywhere.
    pub edge_length: Option<f64>,
    /// Refine everything at least this many times.
    pub levels: Option<u8>,
    /// Where to refine further.
    pub regions: Vec<Region>,
    /// Turn of the surface's normal that one edge may span, in degrees.
    pub curvature: Option<f64>,
    /// How much larger an element may be than its neighbour, 1 < gradation <= 2; strong balance gives 2.
    pub gradation: f64,
    /// Leave untouched quads at level 0 (beyond the paper; all-quad, two-colourable input only).
    pub keep_coarse: bool,
    /// No element is refined beyond this level.
    pub max_levels: u8,
    /// Refuse a mesh of more quads than this.
    pub max_quads: u64,
}

impl Default for QuadOptions {
    fn default() -> Self {
        Self {
            edge_length: None,
            levels: None,
            regions: Vec::new(),
            curvature: None,
            gradation: 2.0,
            keep_coarse: false,
            max_levels: 12,
            max_quads: 64_000_000,
        }
    }
}

/// A conforming quad mesh and where its quads came from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RefinedQuads {
    /// The mesh.
    pub mesh: QuadMesh,
    /// The refinement level of each quad (a transition quad has its element's level).
    pub level: Vec<u8>,
    /// The input face that each quad is part of.
    pub parent: Vec<FaceId>,
    /// The parents' tags.
    pub tags: Tags,
}

/// How large a mesh will be, told before the work.
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
    /// True if the figures are exact.
    pub exact: bool,
}

/// Why a mesh was not refined.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RefineError {
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

/// Refines `input` to a conforming quad mesh.
pub fn refine_quads(
    _input: &PolygonMesh,
    _options: &QuadOptions,
    _monitor: &dyn Monitor,
) -> Result<RefinedQuads, RefineError> {
    Ok(RefinedQuads::default())
}

/// Tells how large the result of [`refine_quads`] will be.
pub fn estimate_quads(_input: &PolygonMesh, _options: &QuadOptions) -> Result<Estimate, RefineError> {
    Ok(Estimate { quads: 0, nodes: 0, bytes: 0, levels: 0, exact: false })
}
