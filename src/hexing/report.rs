//! What was done to mesh a solid, and what came of it.

use serde::Serialize;

use super::background::{Background, Choice};
use super::core::CoreReport;
use super::correspondence::{CurveFate, LostCurve, LostSurface, Reason, Reduction};
use super::direction::DirectionScore;
use super::fit::FitReport;
use super::second_order::SecondOrderReport;
use super::sheets::SheetReport;
use crate::mesh::Distances;
use crate::solid::{CornerId, CurveId, SolidModel, SolidReport, SurfaceId};

/// What was done to mesh a solid, and what came of it.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct HexingReport {
    /// The solid that was found in the surface.
    pub solid: SolidReport,
    /// What was done to each of its bodies.
    pub bodies: Vec<BodyReport>,
    /// What came of all of them.
    pub result: ResultReport,
    /// What came of the second order, if that was asked for.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub second_order: Option<SecondOrderReport>,
}

/// What was done to mesh one body.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct BodyReport {
    /// The middle of its box.
    pub place: [f64; 3],
    /// The background of choice, and why.
    pub choice: Choice,
    /// The candidates for the principal direction, the best first; none where nobody asked.
    pub directions: Vec<DirectionScore>,
    /// What came of each attempt.
    pub attempts: Vec<AttemptReport>,
    /// Attempts for which there was no background.
    pub refused: Vec<RefusedAttempt>,
    /// Which attempt was kept; none where the body is too thin for any cell, and not in the mesh.
    pub kept: Option<usize>,
}

/// An attempt for which there was no background.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct RefusedAttempt {
    /// What the core was to be cut out of.
    pub background: Background,
    /// How far the lines of a grid were to be moved, as a share of an edge along each axis.
    pub shift: [f64; 3],
    /// Was there to be a line of a grid, or a layer of a sweep, on both sides of what is thinner than cells?
    pub holds_walls: bool,
    /// How long the edges of cells were to be.
    pub edge_length: f64,
    /// How many hexes the background might have.
    pub limit: u64,
    /// Why there is none, by a stable name.
    pub code: &'static str,
    /// The same in words.
    pub reason: String,
}

/// What came of one pass from a background to a mesh.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct AttemptReport {
    /// What the core was cut out of.
    pub background: Background,
    /// How far the lines of a grid were moved, as a share of an edge along each axis.
    pub shift: [f64; 3],
    /// Was there a line of a grid, or a layer of a sweep, on both sides of what is thinner than cells?
    pub holds_walls: bool,
    /// How long the edges of cells were to be: shorter than asked for where the distance that was asked for takes that.
    pub edge_length: f64,
    /// Hexes of the background by level, from the coarsest.
    pub levels: Vec<usize>,
    /// Was what is thinner than cells made as thick as one?
    pub keep_thin: bool,
    /// The core.
    pub core: CoreReport,
    /// Was some part of the solid farther from the core than cells are large? Looked for where it lost some.
    pub lacks_part: bool,
    /// What became of the solid's features; not looked for where the core was worse than one before.
    pub features: Option<FeatureReport>,
    /// The mesh; not made where core or features were worse than those of an attempt before, or were left for a better one.
    #[serde(flatten)]
    pub mesh: Option<MeshedReport>,
}

/// The mesh that came of an attempt.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct MeshedReport {
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

/// What came of the attempts that were kept, of all bodies together.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct ResultReport {
    /// The Euler number of the mesh's boundary.
    pub euler: i64,
    /// The Euler number of the solid's boundary, with bodies that are not in the mesh.
    pub solid_euler: i64,
    /// Bodies that are not in the mesh, since no cell lies within them.
    pub lost_bodies: Vec<LostFeature>,
    /// Surfaces of which faces of the mesh go through others: with a place, and the square root of the area of these faces.
    pub crossings: Vec<LostFeature>,
    /// What became of the features of those that are.
    pub features: FeatureReport,
    /// Hexes of the mesh.
    pub hexes: usize,
    /// The least scaled Jacobian.
    pub worst: f64,
    /// The mean scaled Jacobian.
    pub mean: f64,
    /// How far the mesh's boundary and the solid's are from each other.
    pub distance: Distances,
    /// How far they were to be at most, if that was asked for, in model units.
    pub max_distance: Option<f64>,
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
    /// What there is of steps far lower than edges.
    #[serde(skip)]
    pub(super) low: LowSteps,
}

/// What a solid has of steps that are far lower than edges.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct LowSteps {
    /// Curves that were suppressed.
    pub(super) suppressed: usize,
    /// Curves in all.
    pub(super) curves: usize,
    /// Surfaces for which others stand.
    pub(super) surfaces: usize,
}

/// A feature, or a body, that the mesh does not show.
#[derive(Clone, Copy, Debug, PartialEq, Serialize)]
pub struct LostFeature {
    /// Its number.
    pub id: u32,
    /// The middle of it.
    pub place: [f64; 3],
    /// The length of a curve, the square root of a surface's area, or a body's diagonal, in model units.
    pub size: f64,
}

/// The sheets that were inserted and not taken back.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct SheetCounts {
    /// Sheets over groups of surfaces.
    pub sheets: usize,
    /// Pillows beside curves that have room for one hex alone.
    pub wedges: usize,
    /// Pillows around hexes at smooth curves.
    pub collars: usize,
    /// Hexes of all these.
    pub hexes: usize,
    /// Sheets, wedges and collars that were taken back, since their cells could not be pushed open.
    pub taken_back: usize,
    /// Nodes at which a sheet or wedge that was needed would have been pinched.
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
    /// Nodes that were drawn in, since they lay on other parts of the boundary or faces there went through others.
    pub drawn_in: usize,
}

impl HexingReport {
    /// What came of the attempts that were kept, of all bodies together.
    pub fn result(&self) -> &ResultReport {
        &self.result
    }
}

impl ResultReport {
    /// Is the mesh's boundary of the solid's kind, as far as the Euler number tells?
    pub fn has_right_euler(&self) -> bool {
        self.euler == self.solid_euler
    }

    /// Are mesh and solid farther from each other than was asked for?
    pub fn is_too_far(&self) -> bool {
        self.max_distance.is_some_and(|limit| self.distance.hausdorff() > limit)
    }

    /// That of no body yet.
    pub(super) fn none(max_distance: Option<f64>) -> Self {
        Self {
            euler: 0,
            solid_euler: 0,
            lost_bodies: Vec::new(),
            crossings: Vec::new(),
            features: FeatureReport::default(),
            hexes: 0,
            worst: f64::INFINITY,
            mean: 0.0,
            distance: Distances::none(),
            max_distance,
        }
    }

    /// Adds what came of a body.
    pub(super) fn add(&mut self, core: &CoreReport, features: &FeatureReport, mesh: &MeshedReport) {
        self.euler += core.euler;
        self.solid_euler += core.solid_euler;
        self.features.add(features);
        let [before, more] = [self.hexes, mesh.hexes].map(|hexes| hexes as f64);
        self.mean = (self.mean * before + mesh.mean * more) / (before + more);
        self.hexes += mesh.hexes;
        self.worst = self.worst.min(mesh.worst);
        self.distance = self.distance.joined(&mesh.distance);
    }
}

impl FeatureReport {
    pub(super) fn new(solid: &SolidModel, reduction: &Reduction) -> Self {
        let curve = |lost: &LostCurve| LostFeature {
            id: lost.curve.0,
            place: lost.place.to_array(),
            size: lost.length,
        };
        let surface = |lost: &LostSurface| LostFeature {
            id: lost.surface.0,
            place: lost.place.to_array(),
            size: lost.area.sqrt(),
        };
        let with =
            |fate| reduction.lost_curves.iter().filter(move |lost| lost.fate == fate).map(curve).collect();
        let ids = |count: usize| 0..count as u32;
        let corners = ids(solid.corners().len()).map(CornerId);
        let own_corner = |c: &CornerId| reduction.corner(*c) == *c && !reduction.lost_corners.contains(c);
        let own_surface = |s: &SurfaceId| reduction.members(*s).first() == Some(s);
        let low_curves: Vec<&LostCurve> =
            reduction.lost_curves.iter().filter(|lost| lost.reason == Reason::Low).collect();
        let is_low = |c: &CurveId| low_curves.binary_search_by_key(c, |lost| lost.curve).is_ok();
        let is_at_step =
            |s: &SurfaceId| !own_surface(s) && solid.surfaces()[s.index()].curves.iter().any(is_low);
        Self {
            corners: Captured { found: solid.corners().len(), captured: corners.filter(own_corner).count() },
            curves: Captured { found: solid.curves().len(), captured: reduction.count(CurveFate::Captured) },
            surfaces: Captured {
                found: solid.surfaces().len(),
                captured: ids(solid.surfaces().len()).map(SurfaceId).filter(own_surface).count(),
            },
            contracted: with(CurveFate::Contracted),
            suppressed: with(CurveFate::Suppressed),
            lost_surfaces: reduction.lost_surfaces.iter().map(surface).collect(),
            low: LowSteps {
                suppressed: low_curves.iter().filter(|lost| lost.fate == CurveFate::Suppressed).count(),
                curves: low_curves.len(),
                surfaces: ids(solid.surfaces().len()).map(SurfaceId).filter(is_at_step).count(),
            },
        }
    }

    /// How many curves and surfaces the mesh does not show.
    pub fn lost(&self) -> usize {
        self.suppressed.len() + self.lost_surfaces.len()
    }

    /// Gives curves and surfaces other numbers.
    pub(super) fn renumber(&mut self, curves: &[CurveId], surfaces: &[SurfaceId]) {
        let of_curves = self.contracted.iter_mut().chain(&mut self.suppressed);
        of_curves.for_each(|lost| lost.id = curves[lost.id as usize].0);
        self.lost_surfaces.iter_mut().for_each(|lost| lost.id = surfaces[lost.id as usize].0);
    }

    fn add(&mut self, other: &Self) {
        let counts = [&mut self.corners, &mut self.curves, &mut self.surfaces];
        for (all, more) in counts.into_iter().zip([other.corners, other.curves, other.surfaces]) {
            all.found += more.found;
            all.captured += more.captured;
        }
        self.low.suppressed += other.low.suppressed;
        self.low.curves += other.low.curves;
        self.low.surfaces += other.low.surfaces;
        self.contracted.extend(&other.contracted);
        self.suppressed.extend(&other.suppressed);
        self.lost_surfaces.extend(&other.lost_surfaces);
    }
}

impl SheetCounts {
    pub(super) fn new(sheets: &SheetReport, fitted: &FitReport) -> Self {
        Self {
            sheets: sheets.sheets,
            wedges: sheets.wedges,
            collars: sheets.collars,
            hexes: sheets.hexes,
            taken_back: fitted.taken_back,
            pinched: sheets.pinched.len(),
        }
    }
}

impl FitCounts {
    pub(super) fn new(fitted: &FitReport, drawn_in: usize) -> Self {
        let farthest = fitted.off.first();
        Self {
            sweeps: fitted.sweeps,
            off: fitted.off.len(),
            farthest: farthest.map_or(0.0, |off| off.distance),
            place: farthest.map(|off| off.place.to_array()),
            drawn_in,
        }
    }
}
