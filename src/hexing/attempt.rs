//! One pass from a background to a mesh, and what came of it.

use serde::Serialize;

use super::core::{CoreOptions, CoreReport, core};
use super::correspondence::{CurveFate, Reduction, correspond};
use super::fit::{FitOptions, FitReport, fit};
use super::options::HexingError;
use super::separate::separate;
use super::sheets::{SheetReport, insert_sheets};
use crate::Monitor;
use crate::mesh::topology::hex_boundary;
use crate::mesh::{Distances, HexMesh, NodeId, Triangles};
use crate::solid::{SolidModel, SurfaceId};

/// How to try.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Try {
    /// How far the lines of the background are moved, as a share of an edge along each axis.
    pub(super) shift: [f64; 3],
    /// Is what is thinner than cells to be kept?
    pub(super) keep_thin: bool,
}

/// A mesh of a body and where it stands for what.
#[derive(Clone, Debug)]
pub(super) struct Attempt {
    pub(super) mesh: HexMesh,
    /// All boundary quads, outward, each with the surface that it stands for.
    pub(super) faces: Vec<([NodeId; 4], SurfaceId)>,
    pub(super) report: AttemptReport,
}

/// What came of one pass.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct AttemptReport {
    /// How far the lines of the background were moved, as a share of an edge along each axis.
    pub shift: [f64; 3],
    /// Was what is thinner than cells made as thick as one?
    pub keep_thin: bool,
    /// The core.
    pub core: CoreReport,
    /// What became of the solid's features.
    pub features: FeatureReport,
    /// The sheets that were inserted.
    pub sheets: SheetCounts,
    /// How the nodes came to the solid.
    pub fit: FitCounts,
    /// Hexes of the mesh.
    pub hexes: usize,
    /// The least scaled Jacobian.
    pub worst: f64,
    /// The mean scaled Jacobian.
    pub mean: f64,
    /// How far the mesh's boundary and the solid's are from each other.
    pub distance: Distances,
}

/// How many of one kind of feature the solid has, and what became of them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
pub struct Captured {
    /// Of the solid.
    pub found: usize,
    /// With nodes, edges or faces of their own.
    pub captured: usize,
}

/// What became of the solid's features.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct FeatureReport {
    /// Corners.
    pub corners: Captured,
    /// Curves.
    pub curves: Captured,
    /// Surfaces.
    pub surfaces: Captured,
    /// Curves that shrank to a corner.
    pub contracted: Vec<LostFeature>,
    /// Curves that nothing stands for.
    pub suppressed: Vec<LostFeature>,
    /// Surfaces that no face stands for.
    pub lost_surfaces: Vec<LostFeature>,
}

/// A feature that the mesh does not show.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LostFeature {
    /// Its number.
    pub id: u32,
    /// The middle of it.
    pub place: [f64; 3],
    /// The length of a curve or the square root of a surface's area, in model units.
    pub size: f64,
}

/// The sheets that were inserted and not taken back.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct SheetCounts {
    /// Sheets over groups of surfaces.
    pub sheets: usize,
    /// Pillows around hexes at smooth curves.
    pub collars: usize,
    /// Hexes of both.
    pub hexes: usize,
    /// Sheets and collars that were taken back, since their cells could not be pushed open.
    pub taken_back: usize,
    /// Nodes at which a sheet that was needed would have been pinched.
    pub pinched: usize,
}

/// How the nodes came to the solid.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct FitCounts {
    /// Sweeps over nodes.
    pub sweeps: usize,
    /// Boundary nodes that are not on their corner, curve or surface.
    pub off: usize,
    /// The farthest, in model units.
    pub farthest: f64,
    /// Where that is.
    pub place: Option<[f64; 3]>,
    /// Nodes that were drawn in, since they lay on other parts of the boundary.
    pub drawn_in: usize,
}

/// Makes a mesh of `solid` out of a background.
pub(super) fn attempt(
    background: HexMesh,
    Try { shift, keep_thin }: Try,
    solid: &SolidModel,
    edge_length: f64,
    monitor: &dyn Monitor,
) -> Result<Attempt, HexingError> {
    let cut = core(&background, solid, &CoreOptions { keep_thin, ..CoreOptions::default() }, monitor)?;
    drop(background);
    let mut mesh = cut.mesh;
    if mesh.hexes.is_empty() {
        return Err(HexingError::NothingLeft { edge_length });
    }
    let mut on = correspond(&mesh, solid, monitor)?;
    let mut sheets = insert_sheets(&mut mesh, &mut on, solid, monitor)?;
    let fitted = fit(&mut mesh, &mut on, &mut sheets, solid, &FitOptions::default(), monitor)?;
    if !fitted.inverted.is_empty() {
        return Err(HexingError::Tangled(fitted.inverted.len()));
    }
    let drawn_in = separate(&mut mesh, monitor)?;
    let report = AttemptReport {
        shift,
        keep_thin,
        core: cut.report,
        features: FeatureReport::new(solid, &on.reduction),
        sheets: sheet_counts(&sheets, &fitted),
        fit: FitCounts { drawn_in, ..fit_counts(&fitted) },
        hexes: mesh.hexes.len(),
        worst: fitted.worst.unwrap_or_default(),
        mean: fitted.mean,
        distance: distances(&mesh, solid, monitor)?,
    };
    Ok(Attempt { mesh, faces: on.faces, report })
}

impl FeatureReport {
    fn new(solid: &SolidModel, reduction: &Reduction) -> Self {
        let curve = |lost: &super::correspondence::LostCurve| LostFeature {
            id: lost.curve.0,
            place: lost.place.to_array(),
            size: lost.length,
        };
        let with =
            |fate| reduction.lost_curves.iter().filter(move |lost| lost.fate == fate).map(curve).collect();
        let ids = |count: usize| 0..count as u32;
        let corners = ids(solid.corners().len()).map(crate::solid::CornerId);
        let own_corner =
            |c: &crate::solid::CornerId| reduction.corner(*c) == *c && !reduction.lost_corners.contains(c);
        let own_surface = |s: &SurfaceId| reduction.members(*s).first() == Some(s);
        Self {
            corners: Captured { found: solid.corners().len(), captured: corners.filter(own_corner).count() },
            curves: Captured { found: solid.curves().len(), captured: reduction.count(CurveFate::Captured) },
            surfaces: Captured {
                found: solid.surfaces().len(),
                captured: ids(solid.surfaces().len()).map(SurfaceId).filter(own_surface).count(),
            },
            contracted: with(CurveFate::Contracted),
            suppressed: with(CurveFate::Suppressed),
            lost_surfaces: (reduction.lost_surfaces.iter())
                .map(|lost| LostFeature {
                    id: lost.surface.0,
                    place: lost.place.to_array(),
                    size: lost.area.sqrt(),
                })
                .collect(),
        }
    }

    /// How many curves and surfaces the mesh does not show.
    pub fn lost(&self) -> usize {
        self.suppressed.len() + self.lost_surfaces.len()
    }
}

fn sheet_counts(sheets: &SheetReport, fitted: &FitReport) -> SheetCounts {
    SheetCounts {
        sheets: sheets.sheets,
        collars: sheets.collars,
        hexes: sheets.hexes,
        taken_back: fitted.taken_back,
        pinched: sheets.pinched.len(),
    }
}

fn fit_counts(fitted: &FitReport) -> FitCounts {
    let farthest = fitted.off.first();
    FitCounts {
        sweeps: fitted.sweeps,
        off: fitted.off.len(),
        farthest: farthest.map_or(0.0, |off| off.distance),
        place: farthest.map(|off| off.place.to_array()),
        drawn_in: 0,
    }
}

/// How far the boundaries of a mesh and a solid are from each other.
fn distances(mesh: &HexMesh, solid: &SolidModel, monitor: &dyn Monitor) -> Result<Distances, HexingError> {
    let halves = |quad: [NodeId; 4]| {
        let [a, b, c, d] = quad.map(|n| n.0);
        [[a, b, c], [a, c, d]]
    };
    let triangles: Vec<[u32; 3]> =
        hex_boundary(&mesh.hexes).into_iter().flat_map(|(quad, _)| halves(quad)).collect();
    let boundary = Triangles { positions: &mesh.positions, triangles: &triangles };
    let surface = Triangles { positions: solid.points(), triangles: solid.triangles() };
    Ok(Distances::between(boundary, surface, monitor)?)
}
