//! One pass from a background to a draft, from there to a mesh, and what came of it.

use super::background::{Background, Failure, Missed, OctreeMesh};
use super::core::{Core, CoreOptions, core, whole_core};
use super::correspondence::{Correspondence, correspond, correspond_alike};
use super::fit::{FitOptions, Survey, fit};
use super::ground::{Plan, Site};
use super::merit::{Bar, FAIR, loses_some};
use super::meshed::{Approach, Meshed, distances};
use super::misses::{FineCells, misses, tolerance};
use super::options::HexingError;
use super::report::{AttemptReport, FeatureReport, FitCounts, MeshedReport, SheetCounts};
use super::sheets::insert_sheets;
use crate::mesh::{Distances, HexMesh, MeshHash, Quads, Triangles, farthest_from_quads, mesh_hash};
use crate::solid::SolidModel;
use crate::{Cancelled, Monitor};

/// A mesh that is farther from its solid than so many times what is near approaches only if it is kept: smaller cells are tried
/// first, since those it has hardly ever get near enough.
const HOPELESS: f64 = 1.4;

/// Unless somebody asked for the distance, smaller cells are tried only where mesh and solid are farther from each other than so
/// many times what is near: that takes as long again, and brings little where little is missing.
pub(super) const TOO_FAR: f64 = 1.2;

/// A sweep is refined only where they are farther from each other than so many times what is near: the cells that are cut for
/// that are poorer than those of a grid, and the cells beside them.
const TOO_FAR_FROM_SWEEP: f64 = 2.0;

/// A solid is nowhere so many edges from a core that shows all of it: cells whose middle is within the solid are in it, and
/// half the diagonal of a cube is .87 of its edge.
const PART: f64 = 1.2;

/// Fair cells are better than good ones have to be by this: rounding, and smoothing once more, do not make them bad.
const SPARE: f64 = 0.01;

/// A core of a body and where it stands for what, not fitted yet.
pub(super) struct Draft {
    kind: Background,
    core: Core,
    on: Correspondence,
    /// The cells of its background that are finer than others.
    cells: FineCells,
    pub(super) report: AttemptReport,
}

/// Cuts a core out of a background and finds the solid's features on it. It is given up, with nothing but a report, as soon
/// as it is known not to reach `bar`.
pub(super) fn draft(
    site: &Site<'_>,
    plan: &Plan,
    background: OctreeMesh,
    bar: Option<Bar>,
    monitor: &dyn Monitor,
) -> Result<Result<Draft, AttemptReport>, HexingError> {
    let mut report = AttemptReport {
        background: plan.kind,
        shift: plan.shift,
        holds_walls: plan.holds_walls,
        edge_length: site.options.edge_length,
        levels: levels_of(&background),
        ..AttemptReport::default()
    };
    let core;
    (core, report.keep_thin) = if plan.kind == Background::Shell {
        (whole_core(&background.mesh, site.solid, monitor)?, false)
    } else {
        best_core(&background.mesh, site.solid, monitor)?
    };
    report.core = core.report;
    let cells = FineCells::of(&background);
    drop(background);
    if core.mesh.hexes.is_empty() {
        return Err(HexingError::NothingLeft { edge_length: site.options.edge_length });
    }
    let off = core.report.off_kind();
    let is_behind = |features: Option<&FeatureReport>| bar.is_some_and(|bar| bar.is_above(off, features));
    if is_behind(None) {
        return Ok(Err(report));
    }
    let on = if plan.kind == Background::Shell {
        correspond_alike(&core.mesh, site.solid, monitor)?
    } else {
        correspond(&core.mesh, site.solid, monitor)?
    };
    report.features = Some(FeatureReport::new(site.solid, &on.reduction));
    if is_behind(report.features.as_ref()) {
        return Ok(Err(report));
    }
    report.lacks_part = loses_some(&report, site.taste) && lacks_part(&core.mesh, &on, site, monitor)?;
    Ok(Ok(Draft { kind: plan.kind, core, on, cells, report }))
}

impl Draft {
    /// Tells its core from others.
    pub(super) fn core_hash(&self) -> MeshHash {
        mesh_hash(&self.core.mesh.positions, &self.core.mesh.hexes)
    }

    /// What it misses before it is fitted, and smaller cells may show.
    pub(super) fn failures(&self, site: &Site<'_>) -> Vec<Failure> {
        misses(site, self.kind, &self.core, &self.on.reduction, Vec::new(), &self.cells)
    }

    /// Makes a mesh of it; what that missed and smaller cells may show.
    pub(super) fn fit(
        self,
        site: &Site<'_>,
        monitor: &dyn Monitor,
    ) -> Result<(AttemptReport, Meshed, Vec<Failure>), HexingError> {
        let Self { kind, mut core, mut on, cells, mut report } = self;
        let (solid, options) = (site.solid, site.options);
        let mut mesh = std::mem::take(&mut core.mesh);
        let mut sheets = insert_sheets(&mut mesh, &mut on, solid, monitor)?;
        let max_distance = options.max_distance.unwrap_or(f64::INFINITY);
        let near = tolerance(site, kind);
        let fit_options = FitOptions { max_distance, ..FitOptions::default() };
        let (fitted, survey) = fit(&mut mesh, &mut on, &mut sheets, solid, &fit_options, monitor)?;
        report.features = Some(FeatureReport::new(solid, &on.reduction));
        if !fitted.report.inverted.is_empty() {
            return Err(HexingError::Tangled(fitted.report.inverted.len()));
        }
        let misses_features = || !misses(site, kind, &core, &on.reduction, Vec::new(), &cells).is_empty();
        let is_asked = options.max_distance.is_some();
        let may_approach = core.report.off_kind() == 0 && (is_asked || fitted.report.mean >= FAIR);
        let apart = fitted.report.apart;
        // Where a distance is asked for smaller cells come first if more is missed.
        let is_hopeless = apart > HOPELESS * near || is_asked && misses_features();
        let mut approaches = vec![Approach::new(options.max_distance, near, site.taste.good + SPARE)];
        if is_asked {
            approaches.splice(0..0, Approach::again(&approaches[0]));
        }
        let mut meshed = Meshed { mesh, on, fitted, approach: None };
        let too_far = if is_asked { near } else { TOO_FAR * near };
        let look = |meshed: &Meshed| -> Result<(Distances, Vec<Failure>), Cancelled> {
            let Meshed { mesh, on, .. } = meshed;
            let (distance, far) = distances(mesh, on, solid, too_far, monitor)?;
            Ok((distance, misses(site, kind, &core, &on.reduction, far, &cells)))
        };
        let is_layered = matches!(kind, Background::Swept | Background::Shell);
        let has_other = !is_asked && !is_layered && apart > too_far;
        // What a survey sees is too far need not be looked at before that is mended.
        let mut survey = survey.filter(|_| may_approach && apart > near && !is_hopeless);
        let (distance, mut failures) = loop {
            if let Some(mut survey) = survey.take()
                && let Some(approach) = approaches.pop()
            {
                let tried = if has_other { approach.clone().tried() } else { approach.clone() };
                // Where it was given up it is made to the end once the mesh is kept.
                let gave_up = meshed.approach(&mut survey, &tried, monitor)?;
                meshed.approach = gave_up.then_some(approach);
            }
            let seen = look(&meshed)?;
            let is_far = seen.1.iter().any(|failure| failure.missed == Missed::Far);
            if !may_approach || !is_far || approaches.is_empty() {
                break seen;
            }
            if is_hopeless {
                meshed.approach = approaches.pop();
                break seen;
            }
            survey = Some(Survey::new(&meshed.mesh, &meshed.on.faces, solid));
        };
        let may_stay = is_layered && distance.hausdorff() <= TOO_FAR_FROM_SWEEP * near;
        // Smaller cells elsewhere bring them no nearer where none may be smaller.
        let is_finest = || cells.finest(&[distance.farthest()])[0] >= site.finest(kind);
        if !is_asked && (may_stay || is_finest()) {
            failures.retain(|failure| failure.missed != Missed::Far);
        }
        if may_approach && meshed.approach.is_none() && !is_asked {
            meshed.approach = Approach::of_little(distance.hausdorff(), solid.diagonal());
        }
        let came = &meshed.fitted.report;
        report.mesh = Some(MeshedReport {
            sheets: SheetCounts::new(&sheets, came),
            fit: FitCounts::new(came, 0),
            hexes: meshed.mesh.hexes.len(),
            worst: came.worst.unwrap_or_default(),
            mean: came.mean,
            distance,
        });
        Ok((report, meshed, failures))
    }
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
    if plain.report.is_of_kind() && !plain.mesh.hexes.is_empty() {
        return Ok((plain, false));
    }
    let thin = with(true)?;
    let rank = |core: &Core| (core.mesh.hexes.is_empty(), core.report.off_kind());
    Ok(if rank(&thin) < rank(&plain) { (thin, true) } else { (plain, false) })
}

/// Is some part of a solid that somebody drew so far from the core that cells are missing there, or too many?
fn lacks_part(
    core: &HexMesh,
    on: &Correspondence,
    site: &Site<'_>,
    monitor: &dyn Monitor,
) -> Result<bool, Cancelled> {
    let (solid, edge) = (site.solid, site.options.edge_length);
    if solid.is_free_form() {
        return Ok(false);
    }
    let quads = on.quads();
    let boundary = Quads { positions: &core.positions, quads: &quads };
    let surface = Triangles { positions: solid.points(), triangles: solid.triangles() };
    Ok(farthest_from_quads(surface, boundary, edge, monitor)? > PART * edge)
}

/// Hexes of each level.
fn levels_of(background: &OctreeMesh) -> Vec<usize> {
    let finest = background.level.iter().max().map_or(0, |&level| usize::from(level));
    let mut counts = vec![0; finest + 1];
    background.level.iter().for_each(|&level| counts[usize::from(level)] += 1);
    counts
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

    use super::super::fit::testing::house;
    use super::super::fit::{APPROACH, NEARER};
    use super::super::merit::{Taste, distance};
    use super::super::options::HexingOptions;
    use super::*;
    use crate::geometry::Point;
    use crate::solid::testing::{moved, solid, voxels};
    use crate::{Silent, Stage};

    /// Hears whether a mesh approaches its solid.
    #[derive(Default)]
    struct Hearing(AtomicBool);

    impl Monitor for Hearing {
        fn progress(&self, stage: Stage, fraction: f64) {
            self.0.fetch_or(stage == Stage("fitting") && fraction > APPROACH, Relaxed);
        }
        fn cancelled(&self) -> bool {
            false
        }
    }

    /// What comes of a fit to a house with such a ridge.
    struct Came {
        approached: bool,
        mean: f64,
        /// How much it misses that smaller cells may show.
        failures: usize,
        distance: f64,
        worst: f64,
    }

    fn fitted(aside: f64, max_distance: f64) -> Came {
        fitted_with(0.4, aside, Some(max_distance))
    }

    /// The same with other edges.
    fn fitted_with(edge_length: f64, aside: f64, max_distance: Option<f64>) -> Came {
        let (solid, _) = house(aside);
        let hearing = Hearing::default();
        let (report, _, failures) = made(&solid, edge_length, max_distance, &hearing);
        let MeshedReport { worst, mean, .. } = *report.mesh.as_ref().unwrap();
        let approached = hearing.0.into_inner();
        Came { approached, mean, failures: failures.len(), distance: distance(&report), worst }
    }

    /// What a first attempt makes of a solid.
    fn made(
        solid: &SolidModel,
        edge_length: f64,
        max_distance: Option<f64>,
        monitor: &dyn Monitor,
    ) -> (AttemptReport, Meshed, Vec<Failure>) {
        let background = Background::Grid;
        let options = HexingOptions { edge_length, background, max_distance, ..HexingOptions::default() };
        first_attempt(solid, &options, monitor)
    }

    fn first_attempt(
        solid: &SolidModel,
        options: &HexingOptions,
        monitor: &dyn Monitor,
    ) -> (AttemptReport, Meshed, Vec<Failure>) {
        let site = Site::new(solid, options, &Silent).unwrap();
        let plan = site.plan(site.choice.kind);
        let background = site.background(&plan, u64::MAX, &Silent).unwrap();
        let draft = draft(&site, &plan, background, None, &Silent).unwrap().ok().unwrap();
        draft.fit(&site, monitor).unwrap()
    }

    #[test]
    fn a_mesh_that_is_too_far_approaches_with_fair_cells() {
        let good = fitted(0.5, 0.06);
        assert!(!good.approached && good.failures == 0);
        assert!((0.05..0.06).contains(&good.distance));
        let fair = fitted(0.5, 0.05);
        assert!(fair.approached && fair.failures == 0 && (0.35..good.worst).contains(&fair.worst));
        assert!(fair.distance < 0.05);
    }

    #[test]
    fn a_mesh_that_gets_hardly_nearer_stays_as_good_as_it_was() {
        let [before, after] = [0.045, 0.04].map(|max_distance| fitted(0.3, max_distance));
        assert!(!before.approached && before.failures == 0);
        assert!(after.approached && after.failures > 0);
        assert_eq!((after.distance, after.worst), (before.distance, before.worst));
    }

    #[test]
    fn a_mesh_that_gets_much_nearer_is_kept_though_not_near_enough() {
        let [before, after] = [0.06, 0.04].map(|max_distance| fitted(0.4, max_distance));
        assert!(after.approached && after.failures > 0);
        assert!((0.04..NEARER * before.distance).contains(&after.distance));
    }

    #[test]
    fn a_mesh_that_is_far_too_far_waits() {
        let (solid, _) = house(0.56);
        let waits = |max_distance: Option<f64>| {
            let hearing = Hearing::default();
            let (report, meshed, failures) = made(&solid, 0.24, max_distance, &hearing);
            assert!(!failures.is_empty() && distance(&report) > 0.06);
            (meshed.approach.is_some(), hearing.0.into_inner())
        };
        assert_eq!([None, Some(0.04)].map(waits), [(true, false); 2]);
    }

    /// How near the first rounds bring it is chance: of some houses one gets hardly nearer.
    #[test]
    fn a_mesh_that_gets_hardly_nearer_at_first_is_to_approach_once_it_is_kept() {
        let waits = |k: u32| {
            let (solid, _) = house(f64::from(k) * 0.005);
            let near = Taste::of(&solid).near * 0.26;
            let hearing = Hearing::default();
            let (_, meshed, failures) = made(&solid, 0.26, None, &hearing);
            let tried = hearing.0.into_inner() && meshed.fitted.report.apart <= HOPELESS * near;
            let given_up = meshed.approach.filter(|_| tried);
            given_up.is_some_and(|approach| {
                assert!(!failures.is_empty());
                assert_eq!(approach, Approach::new(None, near, Taste::of(&solid).good + SPARE));
                true
            })
        };
        assert!((112..117).any(waits));
    }

    #[test]
    fn a_mesh_that_is_to_approach_does_so_once_it_is_kept() {
        let (solid, _) = house(0.5);
        let (report, meshed, _) = made(&solid, 0.4, None, &Silent);
        assert!(meshed.approach.is_none(), "it is near enough");
        let finished = |approach: Option<Approach>| {
            let (mut kept, mut report) = (meshed.clone(), report.mesh.clone().unwrap());
            kept.approach = approach;
            kept.finish(&solid, &mut report, &Silent).unwrap();
            (report.distance.hausdorff(), report.worst)
        };
        let (before, good) = finished(None);
        let (after, fair) = finished(Some(Approach::new(None, 0.03, 0.36)));
        assert!(after < NEARER * before && (0.36..good).contains(&fair), "{before} {after} {fair}");
    }

    /// Many cells of so coarse a mesh are poor.
    #[test]
    fn a_mesh_of_poor_cells_approaches_where_a_distance_is_asked_for() {
        let [unasked, asked] = [None, Some(0.12)].map(|limit| fitted_with(0.9, 0.5, limit));
        assert!(!unasked.approached && unasked.mean < FAIR && unasked.distance > 0.12);
        assert!(asked.approached);
    }

    #[test]
    fn a_mesh_that_misses_more_than_distance_approaches_unless_that_is_asked_for() {
        let [lost, both] = [10.0, 0.03].map(|max_distance| fitted(0.69, max_distance));
        assert!(lost.failures > 0 && lost.distance < 10.0, "it misses something else");
        assert!(both.failures > lost.failures && both.distance > 0.03 && !both.approached);
        let unasked = fitted_with(0.4, 0.69, None);
        assert!(unasked.approached && unasked.failures == lost.failures);
    }

    #[test]
    fn what_is_hardly_too_far_is_not_missed_where_nobody_asked() {
        let edge_length = 0.3;
        let near = Taste::of(&house(0.0).0).near * edge_length;
        let [hardly, clearly] = [0.55, 0.68].map(|aside| fitted_with(edge_length, aside, None));
        assert!(near < hardly.distance && hardly.distance < TOO_FAR * near && hardly.failures == 0);
        assert!(clearly.distance > TOO_FAR * near && clearly.failures > 0);
    }

    #[test]
    fn what_no_cells_may_be_smaller_for_is_not_missed_where_nobody_asked() {
        let edge_length = 0.3;
        let missed = |max_levels, max_distance| {
            let background = Background::Grid;
            let options = HexingOptions {
                edge_length,
                background,
                max_levels,
                max_distance,
                ..HexingOptions::default()
            };
            let (.., failures) = first_attempt(&house(0.68).0, &options, &Silent);
            failures.iter().filter(|failure| failure.missed == Missed::Far).count()
        };
        let asked = Some(0.06);
        assert!(missed(1, None) > 0 && missed(0, asked) > 0);
        assert_eq!(missed(0, None), 0);
    }

    /// A bent plate with a dimple that no cells of a sweep show.
    #[test]
    fn a_sweep_is_refined_only_where_it_is_far_off_unless_a_distance_is_asked_for() {
        let missed = |depth: f64, max_distance: Option<f64>| {
            let dimple = |p: Point| depth * (1.0 - (p.truncate() - 10.0).length()).max(0.0);
            let bent = |p: Point| Point::new(p.x + 3.0 * libm::sin(p.y / 4.0), p.y, p.z);
            let plate = voxels([20, 20, 6], |_| true);
            let surface = moved(plate, |p| bent(if p.z == 6.0 { p - Point::Z * dimple(p) } else { p }));
            let options = HexingOptions { edge_length: 1.5, max_distance, ..HexingOptions::default() };
            let solid = solid(&surface);
            let (report, _, failures) = first_attempt(&solid, &options, &Silent);
            assert_eq!(report.background, Background::Swept);
            (
                distance(&report) / (Taste::of(&solid).near * 1.5),
                failures.iter().filter(|failure| failure.missed == Missed::Far).count(),
            )
        };
        let [stays, asked, far] = [(1.42, None), (1.42, Some(TOO_FAR * 0.3)), (1.6, None)]
            .map(|(depth, asked)| missed(depth, asked));
        let between = TOO_FAR..TOO_FAR_FROM_SWEEP;
        assert!(between.contains(&stays.0) && stays.1 == 0 && asked.1 > 0, "{stays:?} {asked:?}");
        assert!(far.0 > TOO_FAR_FROM_SWEEP && far.1 > 0, "{far:?}");
    }
}
