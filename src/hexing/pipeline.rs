//! All-hex meshes of solids, from the surface to the mesh (section 3).
//!
//! 1. The solid, its corners, curves and surfaces ([`solid`](crate::solid)).
//! 2. A background mesh (`background`, section 4).
//! 3. Its core (`core`, 5.1), where the solid's features are on the core's boundary (`correspondence`, 5.2), sheets and
//!    the fit (`sheets`, `fit`, section 6): one `attempt`.
//! 4. Where that missed something, another attempt; the best is kept.
//!
//! **Promises.** The mesh conforms, its boundary is a 2-manifold, every hex has a positive Jacobian, at its corners and
//! inside. What of the solid it does not show is reported with its place.

use serde::Serialize;

use super::attempt::{Attempt, AttemptReport, Try, attempt};
use super::background::{AlignedGrid, grid};
use super::direction::best_frame;
use super::groups::groups_of;
use super::options::{HexingError, HexingOptions, validate};
use crate::mesh::{HexMesh, NodeId, PolygonMesh};
use crate::solid::{SolidModel, SolidOptions, SolidReport, SurfaceId};
use crate::{Monitor, Stage};

/// A mesh of a solid.
#[derive(Clone, Debug)]
pub struct HexedSolid {
    /// The mesh. The surfaces of the solid are groups of its boundary faces: `surface-1` and so on.
    pub mesh: HexMesh,
    /// All boundary quads, outward, each with the surface that it stands for.
    pub faces: Vec<([NodeId; 4], SurfaceId)>,
    /// What was done, and what came of it.
    pub report: HexingReport,
}

/// What was done to mesh a solid, and what came of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct HexingReport {
    /// The solid that was found in the surface.
    pub solid: SolidReport,
    /// What came of each attempt.
    pub attempts: Vec<AttemptReport>,
    /// Which attempt was kept.
    pub kept: usize,
}

impl HexingReport {
    /// What came of the attempt that was kept.
    pub fn result(&self) -> &AttemptReport {
        &self.attempts[self.kept]
    }
}

/// The stage in which the surface becomes a solid.
const SOLID: Stage = Stage("solid");

/// What is tried, one after the other, until a mesh has nothing left to mend.
const TRIES: [Try; 3] = [
    Try { shift: [0.0; 3], keep_thin: false },
    Try { shift: [0.0; 3], keep_thin: true },
    Try { shift: [0.5; 3], keep_thin: false },
];

/// A least scaled Jacobian with which there is no other try.
const GOOD: f64 = 0.35;

/// Fills the solid that a closed surface bounds with hexes.
///
/// # Errors
/// See [`HexingError`]; nothing is returned in part.
///
/// ```
/// use hexmill::hexing::{HexingOptions, hex_solid};
/// use hexmill::{Silent, mesh::check_hexes};
/// let cube = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
///     f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
/// let surface = hexmill::io::obj::read(cube)?.into_surface().unwrap();
/// let options = HexingOptions { edge_length: 0.25, ..HexingOptions::default() };
/// let hexed = hex_solid(&surface, &options, &Silent)?;
/// assert_eq!(hexed.mesh.hexes.len(), 64);
/// assert!(check_hexes(&hexed.mesh).is_empty() && hexed.report.result().worst > 0.999);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn hex_solid(
    surface: &PolygonMesh,
    options: &HexingOptions,
    monitor: &dyn Monitor,
) -> Result<HexedSolid, HexingError> {
    validate(options)?;
    monitor.checkpoint(SOLID, 0.0)?;
    let solid_options = SolidOptions {
        feature_angle: options.feature_angle,
        edge_length: Some(options.edge_length),
        ..SolidOptions::default()
    };
    let (solid, found) = SolidModel::new(surface, &solid_options, monitor)?;
    monitor.checkpoint(SOLID, 1.0)?;
    let axes = best_frame(&solid).axes();
    let mut attempts = Vec::new();
    let mut best: Option<(usize, Attempt)> = None;
    for next in TRIES {
        // Thicker walls mend nothing but the solid's kind.
        if next.keep_thin && best.as_ref().is_some_and(|(_, best)| best.report.core.has_right_euler()) {
            continue;
        }
        let aligned = AlignedGrid {
            axes,
            shift: next.shift,
            max_hexes: options.max_hexes,
            edge_length: options.edge_length,
        };
        let background = grid(&solid, &aligned, monitor)?;
        let made = match attempt(background, next, &solid, options.edge_length, monitor) {
            // Another try may do better.
            Err(HexingError::NothingLeft { .. } | HexingError::Tangled(_)) if best.is_some() => continue,
            made => made?,
        };
        let number = attempts.len();
        attempts.push(made.report.clone());
        if best.as_ref().is_none_or(|(_, best)| is_better(&made.report, &best.report)) {
            best = Some((number, made));
        }
        if attempts[number].is_good() {
            break;
        }
    }
    let (kept, Attempt { mut mesh, faces, .. }) = best.expect("the first attempt gives a mesh or an error");
    mesh.groups = groups_of(&mesh, &faces);
    Ok(HexedSolid { mesh, faces, report: HexingReport { solid: found, attempts, kept } })
}

impl AttemptReport {
    /// Is there nothing that another try could mend?
    fn is_good(&self) -> bool {
        self.core.has_right_euler() && self.features.lost() == 0 && self.worst >= GOOD
    }
}

/// Is `a` better than `b`: of the solid's kind first, then with more of its features, then nearer, then with better
/// cells.
fn is_better(a: &AttemptReport, b: &AttemptReport) -> bool {
    let rank = |r: &AttemptReport| (!r.core.has_right_euler(), r.features.lost());
    let merit = |r: &AttemptReport| r.worst;
    rank(a) < rank(b) || rank(a) == rank(b) && merit(a) > merit(b)
}
