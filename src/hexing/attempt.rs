//! One pass from a background to a mesh, and what came of it.

use super::background::{Failure, OctreeMesh};
use super::core::{Core, CoreOptions, CoreReport, core};
use super::correspondence::{Correspondence, Reduction, correspond};
use super::fit::{FitOptions, fit};
use super::ground::{Plan, Site};
use super::merit::Bar;
use super::misses::{FineCells, boundary_triangles, misses, tolerance, too_far};
use super::options::HexingError;
use super::report::{AttemptReport, FeatureReport, FitCounts, MeshedReport, SheetCounts};
use super::separate::separate;
use super::sheets::insert_sheets;
use crate::mesh::{Distances, HexMesh, NodeId, Triangles};
use crate::solid::{CurveId, SolidModel, SurfaceId};
use crate::{Cancelled, Monitor};

/// A mesh of a body and where it stands for what.
#[derive(Clone, Debug)]
pub(super) struct Meshed {
    pub(super) mesh: HexMesh,
    /// All boundary quads, outward, each with the surface that it stands for.
    pub(super) faces: Vec<([NodeId; 4], SurfaceId)>,
    /// All boundary edges on curves, the lesser node first, sorted.
    pub(super) edges: Vec<([NodeId; 2], CurveId)>,
    /// What stands for what was given up.
    pub(super) reduction: Reduction,
    /// What it missed and smaller cells may show.
    pub(super) failures: Vec<Failure>,
}

/// How far a core is from the solid's kind.
pub(super) fn off_euler(core: &CoreReport) -> u64 {
    core.euler.abs_diff(core.solid_euler)
}

/// Makes a mesh out of a background. It is given up as soon as it is known not to reach `bar`.
pub(super) fn attempt(
    site: &Site<'_>,
    plan: &Plan,
    background: OctreeMesh,
    bar: Option<Bar>,
    monitor: &dyn Monitor,
) -> Result<(AttemptReport, Option<Meshed>), HexingError> {
    let (solid, options) = (site.solid, site.options);
    let mut report = AttemptReport {
        background: plan.kind,
        shift: plan.shift,
        levels: levels_of(&background),
        ..AttemptReport::default()
    };
    let mut cut;
    (cut, report.keep_thin) = best_core(&background.mesh, solid, monitor)?;
    report.core = cut.report;
    let cells = FineCells::of(&background);
    drop(background);
    if cut.mesh.hexes.is_empty() {
        return Err(HexingError::NothingLeft { edge_length: options.edge_length });
    }
    let off = off_euler(&cut.report);
    let is_behind = |features: Option<&FeatureReport>| bar.is_some_and(|bar| bar.is_above(off, features));
    if is_behind(None) {
        return Ok((report, None));
    }

    let mut mesh = std::mem::take(&mut cut.mesh);
    let mut on = correspond(&mesh, solid, monitor)?;
    report.features = Some(FeatureReport::new(solid, &on.reduction));
    if is_behind(report.features.as_ref()) {
        return Ok((report, None));
    }

    let mut sheets = insert_sheets(&mut mesh, &mut on, solid, monitor)?;
    let max_distance = options.max_distance.unwrap_or(f64::INFINITY);
    let fit_options = FitOptions { max_distance, ..FitOptions::default() };
    let fitted = fit(&mut mesh, &mut on, &mut sheets, solid, &fit_options, monitor)?;
    report.features = Some(FeatureReport::new(solid, &on.reduction));
    if !fitted.inverted.is_empty() {
        return Err(HexingError::Tangled(fitted.inverted.len()));
    }
    let drawn_in = separate(&mut mesh, monitor)?;
    report.mesh = Some(MeshedReport {
        sheets: SheetCounts::new(&sheets, &fitted),
        fit: FitCounts::new(&fitted, drawn_in),
        hexes: mesh.hexes.len(),
        worst: fitted.worst.unwrap_or_default(),
        mean: fitted.mean,
        distance: distances(&mesh, solid, monitor)?,
    });
    let far = too_far(&mesh, solid, tolerance(options, site.taste), monitor)?;
    let failures = misses(site, plan.kind, &cut, &on.reduction, far, &cells);
    let Correspondence { faces, edges, reduction, .. } = on;
    Ok((report, Some(Meshed { mesh, faces, edges, reduction, failures })))
}

/// The core; where it is not of the solid's kind, that with what is thinner than cells, if it is nearer. Is it this one?
fn best_core(
    background: &HexMesh,
    solid: &SolidModel,
    monitor: &dyn Monitor,
) -> Result<(Core, bool), Cancelled> {
    let with =
        |keep_thin| core(background, solid, &CoreOptions { keep_thin, ..CoreOptions::default() }, monitor);
    let plain = with(false)?;
    if plain.report.has_right_euler() && !plain.mesh.hexes.is_empty() {
        return Ok((plain, false));
    }
    let thin = with(true)?;
    let rank = |core: &Core| (core.mesh.hexes.is_empty(), off_euler(&core.report));
    Ok(if rank(&thin) < rank(&plain) { (thin, true) } else { (plain, false) })
}

/// Hexes of each level.
fn levels_of(background: &OctreeMesh) -> Vec<usize> {
    let finest = background.level.iter().max().map_or(0, |&level| usize::from(level));
    let mut counts = vec![0; finest + 1];
    background.level.iter().for_each(|&level| counts[usize::from(level)] += 1);
    counts
}

/// How far the boundaries of a mesh and a solid are from each other.
fn distances(mesh: &HexMesh, solid: &SolidModel, monitor: &dyn Monitor) -> Result<Distances, Cancelled> {
    let triangles = boundary_triangles(mesh);
    let boundary = Triangles { positions: &mesh.positions, triangles: &triangles };
    let surface = Triangles { positions: solid.points(), triangles: solid.triangles() };
    Distances::between(boundary, surface, monitor)
}
