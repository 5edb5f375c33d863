//! A mesh of one body: attempts, until there is nothing left to mend (design, section 5; issue: refine and retry).
//!
//! 1. The background of choice, as it is.
//! 2. Where that missed something that somebody drew, or is too far from the solid, cells a level smaller there, as often as
//!    the options allow, and as long as it helps: before such an attempt is fitted it has to show clearly more, unless it is
//!    made for more than what was lost. Of a core that is not of the solid's kind it is not always known where it differs:
//!    then thin walls, narrow gaps and short curves are refined. Where that would be many cells, what was lost alone.
//! 3. Where the best is a sweep that does not show some part of the solid, or whose cells are bad, a grid; one that is better
//!    but does not show all is refined in its turn.
//! 4. Where cells of a grid are bad, grids whose lines stand elsewhere.
//! 5. Where the best is still of another kind than the solid, far off it or without half of what somebody drew, an
//!    octree, and 2 for that. What shows less than half before it is fitted, or lacks some part of the solid, is not fitted
//!    before that.
//! 6. Where the best is still such, a sweep that was no choice, and 2 for that: walls and wedges that are thinner than cells.
//!
//! A mesh that is too far from the solid is first brought nearer with cells that are fair instead of good (`attempt`), unless
//! it misses more and a distance is asked for, or none is and many of its cells are poor. Where it is so far that this hardly
//! ever suffices, smaller cells are tried before that, and it is brought nearer if it is kept.
//!
//! The best attempt is kept (`merit`), and finished. Those that turn out to be worse than another are given up at once; and
//! how many times as large as the first another may be is bounded.

use super::attempt::{Meshed, off_euler};
use super::background::{Background, BackgroundError, Failure, Missed, retry};
use super::ground::{Plan, Site};
use super::options::{HexingError, HexingOptions};
use super::report::BodyReport;
use super::search::{Attempt, Search};
use crate::solid::SolidModel;
use crate::{Cancelled, Monitor};

/// How the lines of a grid are moved from try to try, as shares of an edge.
const SHIFTS: [[f64; 3]; 2] = [[0.5; 3], [0.25, 0.5, 0.75]];

/// The background of another try has at most so many times the hexes of the first of its kind.
const GROWTH: f64 = 4.0;

/// And at most so many times where a distance is asked for: once all cells at the boundary may become smaller.
const ASKED_GROWTH: f64 = 10.0;

/// And at most so many times where all that is too far from the solid has smaller cells: of a curved boundary that may be
/// nearly everything, and whoever gives an edge length wants cells of about that.
const FAR_GROWTH: f64 = 1.75;

/// An octree instead of another background has at most so many times the hexes of the first; or so many times, where that
/// is not of the solid's kind.
const OCTREE_GROWTH: f64 = 8.0;
const KIND_GROWTH: f64 = 24.0;

/// So many hexes are never too many for another try; or so many, for an octree where that is not of the solid's kind.
const FEW: u64 = 20_000;
const FEW_FOR_KIND: u64 = 150_000;

/// The best mesh of a body, and what was done for it.
pub(super) struct Body {
    /// None where no cell lies within the body.
    pub(super) best: Option<Best>,
    pub(super) report: BodyReport,
}

/// The mesh that is kept.
pub(super) struct Best {
    pub(super) meshed: Meshed,
    /// The place of its attempt.
    pub(super) number: usize,
}

/// Meshes a body.
pub(super) fn mesh_body(
    solid: &SolidModel,
    options: &HexingOptions,
    monitor: &dyn Monitor,
) -> Result<Body, HexingError> {
    let site = Site::new(solid, options, monitor)?;
    let mut search = Search::new(&site, monitor);
    let first = site.plan(site.choice.kind);
    match search.attempt(first, options.max_hexes) {
        // Others may keep what is thinner than its cells.
        Err(HexingError::NothingLeft { .. }) => {}
        // What may be swept, but not be refined as the options want it.
        Err(HexingError::Background(BackgroundError::Refine(_))) if site.may_be_grid() => {
            search.attempt(site.plan(Background::Grid), options.max_hexes)?;
        }
        made => made?,
    }
    search.refine(options.max_hexes)?;
    let is_astray = search.is_astray();
    if site.may_be_grid() && (is_astray || !search.is_good()) && !search.has_tried(Background::Grid) {
        search.another(site.plan(Background::Grid), search.limit())?;
        if is_astray && search.is_on(Background::Grid) {
            search.refine(options.max_hexes)?;
        }
    }
    if search.is_on(Background::Grid) {
        for shift in SHIFTS {
            if !search.is_good() {
                search.another(Plan { shift, ..site.plan(Background::Grid) }, search.limit())?;
            }
        }
    }
    if site.may_be_octree() && search.is_other() {
        search.octree()?;
        if search.waits() {
            search.fit_best()?;
            search.refine(options.max_hexes)?;
        }
    }
    if search.is_other() && !search.has_tried(Background::Swept) && site.may_be_swept(monitor)? {
        search.another(site.plan(Background::Swept), options.max_hexes)?;
        if search.is_on(Background::Swept) {
            search.refine(options.max_hexes)?;
        }
    }
    search.settle()?;
    match (&search.best, search.tangled) {
        (None, Some(hexes)) => Err(HexingError::Tangled(hexes)),
        _ => Ok(search.end()?),
    }
}

impl Search<'_> {
    /// Refines where the best attempt missed something, and tries again, as often as that helps, with at most so many
    /// hexes. What is known of a draft may not be all: if smaller cells there are not better it is fitted, and refined by
    /// what that missed, unless an octree comes first.
    fn refine(&mut self, max_hexes: u64) -> Result<(), HexingError> {
        for round in 1..=self.site.options.max_levels {
            if !self.is_refined(round, max_hexes)? {
                if !self.waits() || self.octree_is_first() {
                    return Ok(());
                }
                self.fit_best()?;
                if !self.is_refined(round, max_hexes)? {
                    break;
                }
            }
        }
        if self.waits() && !self.octree_is_first() { self.fit_best() } else { Ok(()) }
    }

    /// Makes an attempt with smaller cells where the best missed something. False if it is no better.
    fn is_refined(&mut self, round: u8, max_hexes: u64) -> Result<bool, HexingError> {
        let Some(plan) = self.finer(round, |_| true) else { return Ok(false) };
        let before = self.number();
        // Where too much is too far, what was lost alone.
        if !self.another(plan, self.limit_of_far().min(max_hexes))?
            && let Some(plan) = self.finer(round, |failure| failure.missed == Missed::Lost)
        {
            self.another(plan, self.limit().min(max_hexes))?;
        }
        Ok(self.number() != before)
    }

    /// Will an octree be tried, whatever comes of a fit, since the best draft shows too little, or lacks a part?
    fn octree_is_first(&self) -> bool {
        let may_be_octree = self.site.may_be_octree() && self.site.options.max_levels > 0;
        let lacks_part = self.best_report().is_some_and(|best| best.lacks_part);
        may_be_octree && !self.has_tried(Background::Octree) && (self.shows_little() || lacks_part)
    }

    /// Tries an octree, with cells as small in details as there can be, and refines it if that is better.
    fn octree(&mut self) -> Result<(), HexingError> {
        let (finest, limit) = (self.site.plan(Background::Octree), self.limit_of_octree());
        for details in (1..=finest.details).rev() {
            if self.another(Plan { details, ..finest.clone() }, limit)? {
                break;
            }
        }
        if self.is_on(Background::Octree) {
            self.refine(limit)?;
        }
        Ok(())
    }

    /// How many hexes the background of another attempt may have.
    fn limit(&self) -> u64 {
        self.grown(GROWTH).max(FEW).min(self.site.options.max_hexes)
    }

    /// How many if all that is too far from the solid has smaller cells.
    fn limit_of_far(&self) -> u64 {
        match self.site.options.max_distance {
            Some(_) => self.grown(ASKED_GROWTH).max(FEW).min(self.site.options.max_hexes),
            None => self.grown(FAR_GROWTH).min(self.site.options.max_hexes),
        }
    }

    /// How many an octree may have, and what is refined of it.
    fn limit_of_octree(&self) -> u64 {
        let is_wrong = self.best_report().is_none_or(|best| off_euler(&best.core) > 0);
        let (growth, few) = if is_wrong { (KIND_GROWTH, FEW_FOR_KIND) } else { (OCTREE_GROWTH, FEW) };
        let first = self.attempts.first().map_or(0, |first| first.core.background);
        ((growth * first as f64) as u64).max(few).min(self.site.options.max_hexes)
    }

    /// So many times the hexes of the background that was the first of its kind.
    fn grown(&self, growth: f64) -> u64 {
        let kind = self.best_report().map(|best| best.background);
        let first = self.attempts.iter().find(|attempt| Some(attempt.background) == kind);
        (growth * first.map_or(0, |first| first.core.background) as f64) as u64
    }

    /// The best attempt, with smaller cells where it missed something of what is `looked_at`; none if it missed nothing of
    /// that which these may show.
    fn finer(&self, round: u8, looked_at: impl Fn(&Failure) -> bool) -> Option<Plan> {
        let Attempt { failures, plan, number, .. } = self.best.as_ref()?;
        let failures: Vec<Failure> = failures.iter().filter(|f| looked_at(f)).cloned().collect();
        let more = retry(&failures, self.site.edge_length(plan.kind), self.site.finest(plan.kind));
        let has_place = !more.is_empty();
        let is_wrong = off_euler(&self.attempts[*number].core) > 0;
        let details = if is_wrong && !has_place { round.max(plan.details) } else { plan.details };
        if !has_place && details == plan.details {
            return None;
        }
        let regions = [plan.regions.as_slice(), &more].concat();
        let in_blocks = plan.in_blocks || failures.iter().any(|failure| failure.missed == Missed::Far);
        Some(Plan { regions, details, in_blocks, ..plan.clone() })
    }

    /// Finishes the best attempt.
    fn end(mut self) -> Result<Body, Cancelled> {
        let site = self.site;
        let best = self.best.take().and_then(|best| Some(Best { meshed: best.meshed?, number: best.number }));
        let mut body = Body {
            report: BodyReport {
                place: site.solid.bounds().center().to_array(),
                choice: site.choice,
                directions: site.directions.clone(),
                kept: best.as_ref().map(|best| best.number),
                attempts: self.attempts,
                refused: self.refused,
            },
            best,
        };
        if let Some(Best { meshed, number }) = &mut body.best {
            let report = body.report.attempts[*number].mesh.as_mut().expect("a mesh is kept");
            meshed.finish(site.solid, report, self.monitor)?;
        }
        Ok(body)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::attempt::draft;
    use super::super::merit::distance;
    use super::super::report::AttemptReport;
    use super::super::search::Waiting;
    use glam::DMat3;

    use super::*;
    use crate::Silent;
    use crate::geometry::Point;
    use crate::mesh::PolygonMesh;
    use crate::solid::testing::{moved, polygons, solid, voxels};

    /// A sweep captures its walls, which no grid does, and shows all of the solid but a dimple in the top, be it shallow or so
    /// narrow and deep that no cells of a sweep show it.
    #[test]
    fn a_sweep_is_refined_before_a_grid_is_tried() {
        for (depth, radius) in [(0.4, 3.0), (4.0, 1.0)] {
            let dimple = |p: Point| depth * (1.0 - (p.truncate() - 10.0).length() / radius).max(0.0);
            let bent = |p: Point| Point::new(p.x + 3.0 * libm::sin(p.y / 4.0), p.y, p.z);
            let plate = voxels([20, 20, 6], |_| true);
            let surface = moved(plate, |p| bent(if p.z == 6.0 { p - Point::Z * dimple(p) } else { p }));
            let options =
                HexingOptions { edge_length: 1.5, max_distance: Some(0.095), ..HexingOptions::default() };
            let solid = solid(&surface);
            let Body { report, .. } = mesh_body(&solid, &options, &Silent).unwrap();
            let fitted = report.attempts.iter().filter(|attempt| attempt.mesh.is_some());
            let kinds: Vec<_> = fitted.map(|a| (a.background, a.levels.len())).collect();
            assert_eq!(kinds[..2], [(Background::Swept, 1), (Background::Swept, 2)], "{depth}");
            let site = Site::new(&solid, &options, &Silent).unwrap();
            let is_astray = distance(&report.attempts[0]) > site.taste.astray * options.edge_length;
            assert_eq!(is_astray, depth > 1.0);
            assert_eq!(kinds.contains(&(Background::Grid, 1)), is_astray);
        }
    }

    /// What is kept of a solid with such edges: its background, how far that is from the solid, and what of it was found.
    fn kept(surface: &PolygonMesh, edge_length: f64) -> (Background, f64, bool) {
        let options = HexingOptions { edge_length, ..HexingOptions::default() };
        let Body { best, report } = mesh_body(&solid(surface), &options, &Silent).unwrap();
        let kept = &report.attempts[best.expect("there is a mesh").number];
        let features = kept.features.as_ref().unwrap();
        let shows_all = [features.corners, features.curves, features.surfaces].map(|n| n.captured == n.found);
        (kept.background, distance(kept), shows_all == [true; 3])
    }

    /// A plate that is a twelfth of an edge thick and stands askew is one layer.
    #[test]
    fn a_sheet_is_a_layer_of_hexes() {
        let turn = DMat3::from_rotation_z(0.4) * DMat3::from_rotation_x(0.7);
        let plate = moved(voxels([4, 4, 1], |_| true), |p| turn * (p * Point::new(1.0, 1.0, 0.04)));
        let (background, apart, shows_all) = kept(&plate, 0.5);
        assert!(background == Background::Grid && apart < 1e-9 && shows_all, "{background:?} {apart}");
    }

    /// Nothing but layers that end in its edge shows a wedge of five degrees, though the quads there are poor.
    #[test]
    fn a_wedge_is_swept_where_all_else_misses_it() {
        let back = libm::tan(5.0_f64.to_radians());
        let ends = [0.0, 1.0].map(|y| [[0.0, y, 0.0], [1.0, y, 0.0], [1.0, y, back]]);
        let faces = [[0, 1, 2], [5, 4, 3], [0, 3, 4], [0, 4, 1], [1, 4, 5], [1, 5, 2], [2, 5, 3], [2, 3, 0]];
        let wedge = polygons(ends.as_flattened(), &faces);
        let (background, apart, shows_all) = kept(&wedge, 0.1);
        assert!(background == Background::Swept && apart < 0.05 && shows_all, "{background:?} {apart}");
    }

    /// Euler numbers of a first attempt on a background of so many hexes, and how many an octree may have then.
    fn limit_of_octree(euler: i64, background: usize, max_hexes: u64) -> u64 {
        let solid = solid(&voxels([4, 4, 4], |_| true));
        let options = HexingOptions { edge_length: 1.0, max_hexes, ..HexingOptions::default() };
        let site = Site::new(&solid, &options, &Silent).unwrap();
        let mut search = Search::new(&site, &Silent);
        search.attempt(site.plan(Background::Grid), max_hexes).unwrap();
        (search.attempts[0].core.euler, search.attempts[0].core.background) = (euler, background);
        search.limit_of_octree()
    }

    /// Where a coarse grid has another Euler number an octree may have as many hexes as small holes take.
    #[test]
    fn an_octree_may_be_larger_where_the_kind_is_wrong() {
        let many = 1_000_000;
        assert_eq!([2, 0].map(|euler| limit_of_octree(euler, 2446, many)), [20_000, 150_000]);
        assert_eq!([2, 0].map(|euler| limit_of_octree(euler, 10_000, many)), [80_000, 240_000]);
        assert_eq!([2, 0].map(|euler| limit_of_octree(euler, 10_000, 50_000)), [50_000, 50_000]);
    }

    /// A plate with nine pegs, of which large cells show none: drafts wait as long as there are smaller cells to try.
    #[test]
    fn a_draft_that_loses_much_waits_for_smaller_cells() {
        let is_peg = |k: i32| k % 4 == 2;
        let pegs = voxels([13, 13, 4], |[x, y, z]| z < 3 || is_peg(x) && is_peg(y));
        let solid = solid(&pegs);
        for max_levels in [0, 2] {
            let options = HexingOptions { edge_length: 2.4, max_levels, ..HexingOptions::default() };
            let Body { report, .. } = mesh_body(&solid, &options, &Silent).unwrap();
            let fitted = report.attempts.iter().position(|attempt| attempt.mesh.is_some()).unwrap();
            assert_eq!(fitted > 0, max_levels > 0);
            let lost = report.attempts[..=fitted].iter().map(|a| a.features.as_ref().unwrap().lost());
            assert!(lost.is_sorted_by(|a, b| a > b));
        }
    }

    /// A search whose first attempt is a draft of a cube that has this Euler number, as far as it knows.
    fn with_draft<'a>(site: &'a Site<'a>, euler: i64) -> Search<'a> {
        let (mut search, plan) = (Search::new(site, &Silent), site.plan(Background::Grid));
        let background = site.background(&plan, u64::MAX, &Silent).unwrap();
        let draft = draft(site, &plan, background, None, &Silent).unwrap().ok();
        let mut report = draft.as_ref().unwrap().report.clone();
        report.core.euler = euler;
        search.attempts.push(report);
        search.waiting.push(Waiting { number: 0, plan: plan.clone(), draft });
        search.best = Some(Attempt { meshed: None, failures: Vec::new(), number: 0, plan });
        search
    }

    /// One of another kind not before all else was tried.
    #[test]
    fn a_draft_that_smaller_cells_do_not_better_is_fitted() {
        let solid = solid(&voxels([4, 4, 4], |_| true));
        let options = HexingOptions { edge_length: 1.0, ..HexingOptions::default() };
        let site = Site::new(&solid, &options, &Silent).unwrap();
        let mut of_kind = with_draft(&site, 2);
        assert!(of_kind.waits() && !of_kind.is_good());
        of_kind.refine(options.max_hexes).unwrap();
        assert!(!of_kind.waits() && of_kind.is_good() && of_kind.attempts.len() == 1);
        let mut other = with_draft(&site, 0);
        assert!(!other.waits() && !other.is_good());
        other.settle().unwrap();
        assert!(other.waiting.is_empty() && other.is_good() && other.attempts.len() == 1);
    }

    #[test]
    fn a_draft_is_fitted_alike_be_it_kept_or_made_again() {
        let solid = solid(&voxels([4, 4, 4], |[x, y, z]| x + y + z < 9));
        let options = HexingOptions { edge_length: 0.7, ..HexingOptions::default() };
        let site = Site::new(&solid, &options, &Silent).unwrap();
        let fitted = |is_kept: bool| {
            let mut search = with_draft(&site, 2);
            search.waiting[0].draft.take_if(|_| !is_kept);
            search.fit_best().unwrap();
            let best = search.best.unwrap();
            (search.attempts, best.meshed.unwrap().mesh, best.failures)
        };
        assert_eq!(fitted(true), fitted(false));
    }

    #[test]
    fn of_the_drafts_that_wait_only_the_last_is_kept() {
        let pegs = voxels([13, 13, 4], |[x, y, z]| z < 3 || x % 4 == 2 && y % 4 == 2);
        let solid = solid(&pegs);
        let options = HexingOptions { edge_length: 2.4, ..HexingOptions::default() };
        let site = Site::new(&solid, &options, &Silent).unwrap();
        let mut search = Search::new(&site, &Silent);
        search.attempt(site.plan(Background::Grid), u64::MAX).unwrap();
        // The same again, as though it lost half of what the first did.
        search.attempts[0].features.as_mut().map(|f| f.suppressed.extend(f.suppressed.clone())).unwrap();
        search.attempt(site.plan(Background::Grid), u64::MAX).unwrap();
        let kept: Vec<bool> = search.waiting.iter().map(|waiting| waiting.draft.is_some()).collect();
        assert_eq!((kept, search.number()), (vec![false, true], Some(1)));
    }

    /// It is tried whatever comes of the fit.
    #[test]
    fn a_draft_that_shows_little_is_not_fitted_before_an_octree_was_tried() {
        let solid = solid(&voxels([4, 4, 4], |_| true));
        let options = HexingOptions { edge_length: 1.0, ..HexingOptions::default() };
        let site = Site::new(&solid, &options, &Silent).unwrap();
        let showing = |curves: usize| {
            let mut search = with_draft(&site, 2);
            let features = search.attempts[0].features.as_mut().unwrap();
            assert_eq!((features.curves.captured, features.surfaces.captured), (12, 6));
            features.curves.captured = curves;
            search
        };
        for (curves, waits) in [(3, false), (2, true)] {
            let mut search = showing(curves);
            search.refine(options.max_hexes).unwrap();
            assert_eq!((search.waits(), search.is_other()), (waits, waits));
        }
        let mut search = showing(2);
        search.attempts.push(AttemptReport { background: Background::Octree, ..search.attempts[0].clone() });
        search.refine(options.max_hexes).unwrap();
        assert!(!search.waits() && search.is_good());
    }

    /// A block with a hole that is narrower than cells.
    fn drilled(depth: i32) -> SolidModel {
        solid(&voxels([12, 12, 12], |[x, y, z]| (x, y) != (6, 6) || z < 12 - depth))
    }

    #[test]
    fn a_draft_that_lacks_a_part_waits_for_an_octree() {
        let options = HexingOptions { edge_length: 3.0, ..HexingOptions::default() };
        for (depth, lacks_part) in [(3, false), (6, true)] {
            let solid = drilled(depth);
            let site = Site::new(&solid, &options, &Silent).unwrap();
            let mut search = Search::new(&site, &Silent);
            search.attempt(site.plan(Background::Grid), u64::MAX).unwrap();
            assert_eq!(search.attempts[0].lacks_part, lacks_part, "{depth}");
            search.refine(100).unwrap();
            assert_eq!(search.waits(), lacks_part, "{depth}");
        }
        let Body { report, .. } = mesh_body(&drilled(6), &options, &Silent).unwrap();
        let kept = &report.attempts[report.kept.unwrap()];
        assert!(!kept.lacks_part && distance(kept) < 0.5, "{}", distance(kept));
    }

    /// The same once more shows nothing more.
    #[test]
    fn of_drafts_that_lack_a_part_only_better_ones_wait() {
        let options = HexingOptions { edge_length: 3.0, ..HexingOptions::default() };
        let solid = drilled(6);
        let site = Site::new(&solid, &options, &Silent).unwrap();
        let mut search = Search::new(&site, &Silent);
        for _ in 0..2 {
            search.attempt(site.plan(Background::Grid), u64::MAX).unwrap();
        }
        assert_eq!((search.attempts.len(), search.waiting.len(), search.number()), (2, 1, Some(0)));
        // A mesh that lacks none is not put off for it, be its cells good or not.
        for (lacks_part, fitted) in [(false, false), (true, true)] {
            let mut search = Search::new(&site, &Silent);
            search.attempt(site.plan(Background::Grid), u64::MAX).unwrap();
            search.fit_best().unwrap();
            search.attempts[0].lacks_part = lacks_part;
            search.attempts[0].mesh.as_mut().unwrap().worst = 0.1;
            let report = AttemptReport { lacks_part: true, mesh: None, ..search.attempts[0].clone() };
            search.attempts.push(report);
            search.waiting.push(Waiting { number: 1, plan: site.plan(Background::Grid), draft: None });
            search.settle().unwrap();
            assert_eq!(search.attempts[1].mesh.is_some(), fitted);
        }
    }

    #[test]
    fn a_recess_shallower_than_half_an_edge_is_shown_by_smaller_cells() {
        let recessed =
            voxels([20, 20, 6], |[x, y, z]| z < 5 || !(8..11).contains(&x) || !(8..11).contains(&y));
        let shallow = moved(recessed, |p| p.with_z(p.z.min(5.0) + 0.4 * (p.z - 5.0).max(0.0)));
        let options =
            HexingOptions { edge_length: 1.0, max_distance: Some(0.09), ..HexingOptions::default() };
        let Body { best, report } = mesh_body(&solid(&shallow), &options, &Silent).unwrap();
        let distances: Vec<f64> = report.attempts.iter().map(distance).collect();
        let kept = best.unwrap().number;
        assert!(distances[0] > 0.1 && kept > 0 && distances[kept] < 0.09, "{distances:?} {kept}");
    }
}
