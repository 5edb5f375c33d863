//! A mesh of one body: attempts, until there is nothing left to mend (design, section 5; issue: refine and retry).
//!
//! 1. The background of choice, as it is.
//! 2. Where a grid missed something that somebody drew, or is off the solid, one with lines in both sides of thin walls; first
//!    of all where the solid is nothing but such, and then a sweep for these as in 6 second.
//!    Where that missed something still, or is too far from the solid, cells a level smaller there, as often as
//!    the options allow, and as long as it helps: before such an attempt is fitted it has to show clearly more, unless it is
//!    made for more than what was lost. Of a core that is not of the solid's kind it is not always known where it differs:
//!    then thin walls, narrow gaps and short curves are refined. Where that would be many cells, what was lost alone.
//!    Before all of that comes a layer between two sides where the solid is a thin shell of which a grid would capture little; and
//!    here, where it is one of which cells are bad, or that is not shown.
//! 3. Where the best is a sweep that does not show some part of the solid, or whose cells are bad, a grid, unless an octree
//!    comes anyhow (5 second); one that is better but does not show all is refined in its turn.
//! 4. Where cells of a grid are bad, grids whose lines stand elsewhere.
//! 5. Where the best is still of another kind than the solid, far off it or without half of what somebody drew, an
//!    octree, and 2 for that. What shows less than half before it is fitted, or lacks some part of the solid, is not fitted
//!    before that; what is of another kind and shows hardly anything, not refined either.
//! 6. Where the best is still such, a sweep that was no choice, and 2 for that: walls and wedges that are thinner than cells;
//!    and where that is such, one that shows walls and steps however thin.
//!
//! A mesh that is too far from the solid is first brought nearer with cells that are fair instead of good (`attempt`), unless
//! no distance is asked for and many of its cells are poor; that is given up soon where it brings hardly anything and smaller
//! cells may do. Where it is so far that this hardly ever suffices, or it misses more and a distance is asked for, smaller
//! cells are tried before that, and it is brought nearer before 3 if it does not show some part of the solid, or else if it is
//! kept, as is one that lacks little (`meshed`). Where a distance is asked for and that does not suffice edges become shorter
//! before 3 (`asked`).
//!
//! The best attempt is kept (`merit`). Those that turn out to be worse than another are given up at once; and
//! how many times as large as the first another may be is bounded.

use super::asked::shorter;
use super::background::{Background, BackgroundError, Failure, Missed, retry};
use super::ground::{Plan, Site};
use super::merit::{captured, distance};
use super::meshed::Meshed;
use super::options::{HexingError, HexingOptions};
use super::report::{AttemptReport, BodyReport};
use super::search::{Attempt, Search};
use crate::Monitor;
use crate::solid::SolidModel;

/// How the lines of a grid are moved from try to try, as shares of an edge.
const SHIFTS: [[f64; 3]; 2] = [[0.5; 3], [0.25, 0.5, 0.75]];

/// The background of another try has at most so many times the hexes of the first of its kind.
const GROWTH: f64 = 4.0;

/// And at most so many times where all that is too far from the solid has smaller cells: of a curved boundary that may be
/// nearly everything, and whoever gives an edge length wants cells of about that.
const FAR_GROWTH: f64 = 1.75;

/// An octree instead of another background has at most so many times the hexes of the first; or so many times, where that
/// is not of the solid's kind.
const OCTREE_GROWTH: f64 = 8.0;
const KIND_GROWTH: f64 = 24.0;

/// A draft of another kind than the solid that shows less than this share of what somebody drew shows hardly anything: here and
/// there smaller cells do not mend that.
const HARDLY: f64 = 0.25;

/// A shell is first taken for one where a grid captures less than this share of its area.
const MOSTLY: f64 = 0.5;

/// Mesh and solid are as good as together where they are no farther from each other than this, in edge lengths.
const NEAR: f64 = 0.05;

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

/// The best mesh of a body with edges of about such a length, not finished yet. Other backgrounds are not tried for one that is
/// farther from the body than was asked for, as long as edges as short as the `shortest` may mend that.
pub(super) fn best_mesh(
    solid: &SolidModel,
    options: &HexingOptions,
    shortest: f64,
    monitor: &dyn Monitor,
) -> Result<Body, HexingError> {
    let site = Site::new(solid, options, monitor)?;
    let mut search = Search::new(&site, monitor);
    let walls_first =
        site.is_thin_walled() && site.choice.kind == Background::Grid && site.has_walls(monitor)?;
    let is_askew = site.choice.kind == Background::Grid && site.choice.grid_capture < MOSTLY;
    let shell_first = is_askew && !walls_first && site.may_be_shell(monitor)?;
    let kind = if shell_first { Background::Shell } else { site.choice.kind };
    let first = Plan { holds_walls: walls_first, ..site.plan(kind) };
    match search.attempt(first, options.max_hexes) {
        // Others may keep what is thinner than its cells.
        Err(HexingError::NothingLeft { .. }) => {}
        // What may be swept, but not be refined as the options want it.
        Err(HexingError::Background(BackgroundError::Refine(_)))
            if site.may_be_grid() && kind != Background::Grid =>
        {
            search.attempt(site.plan(Background::Grid), options.max_hexes)?;
        }
        made => made?,
    }
    if search.has_tried(Background::Grid) || site.choice.kind == Background::Grid {
        search.hold_walls()?;
    }
    if site.is_thin_walled() {
        search.sweep_walls()?;
    }
    search.refine(options.max_hexes)?;
    if search.shows_kind() && shorter(search.apart(), options, shortest).is_some() {
        return Ok(search.end());
    }
    search.approach()?;
    if search.is_other() || !search.is_good() {
        search.shell()?;
    }
    let is_astray = search.is_astray();
    let is_missed = is_astray || !search.is_good();
    let is_for_octree = search.waits() && search.octree_is_first();
    if site.may_be_grid() && is_missed && !is_for_octree && !search.has_tried(Background::Grid) {
        search.another(site.plan(Background::Grid), search.limit())?;
        search.hold_walls()?;
        if is_astray && search.is_on(Background::Grid) {
            search.refine(options.max_hexes)?;
        }
    }
    if search.is_on(Background::Grid) {
        for shift in SHIFTS {
            if !search.is_good() {
                let holds_walls = search.best.as_ref().is_some_and(|best| best.plan.holds_walls);
                let plan = Plan { shift, holds_walls, ..site.plan(Background::Grid) };
                search.another(plan, search.limit())?;
            }
        }
    }
    if site.may_be_octree() && search.is_other() {
        search.octree()?;
        if search.waits() {
            search.fit_best()?;
            search.refine(options.max_hexes)?;
        } else if search.shows_hardly_any() && !search.is_on(Background::Octree) {
            search.refine(options.max_hexes)?;
        }
    }
    if search.is_other() && !search.has_tried(Background::Swept) && site.may_be_swept(monitor)? {
        search.another(site.plan(Background::Swept), options.max_hexes)?;
        if search.is_on(Background::Swept) {
            search.refine(options.max_hexes)?;
        }
    }
    search.sweep_walls()?;
    search.settle()?;
    match (&search.best, search.tangled) {
        (None, Some(hexes)) => Err(HexingError::Tangled(hexes)),
        _ => Ok(search.end()),
    }
}

impl Search<'_> {
    /// Refines where the best attempt missed something, and tries again, as often as that helps, with at most so many
    /// hexes. What is known of a draft may not be all: if smaller cells there are not better it is fitted, and refined by
    /// what that missed, unless an octree comes first.
    #[inline(never)] // Compiled once for all that call it.
    fn refine(&mut self, max_hexes: u64) -> Result<(), HexingError> {
        let is_for_octree = self.may_try_octree() && self.shows_hardly_any();
        let most = if is_for_octree { 0 } else { self.site.options.max_levels };
        for round in 1..=most {
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

    /// Tries a layer between the sides of a shell, if the solid is one, and refines it.
    fn shell(&mut self) -> Result<(), HexingError> {
        if self.has_tried(Background::Shell) || !self.site.may_be_shell(self.monitor)? {
            return Ok(());
        }
        self.another(self.site.plan(Background::Shell), self.site.options.max_hexes)?;
        if self.is_on(Background::Shell) { self.refine(self.site.options.max_hexes) } else { Ok(()) }
    }

    /// Where a grid missed something that somebody drew, or is off the solid, tries one with lines in both sides of walls and
    /// slots that are thinner than its cells.
    fn hold_walls(&mut self) -> Result<(), HexingError> {
        let near = NEAR * self.site.options.edge_length;
        let shows_all =
            |best: &AttemptReport| captured(best.features.as_ref()) >= 1.0 && distance(best) <= near;
        let is_done = self.best_report().is_some_and(shows_all) || self.has_held_walls(Background::Grid);
        if is_done || !self.site.has_walls(self.monitor)? {
            return Ok(());
        }
        let plan = Plan { holds_walls: true, ..self.site.plan(Background::Grid) };
        self.another(plan, self.limit_of_walls())?;
        Ok(())
    }

    /// Where the best attempt is not what was asked for, tries a sweep that shows walls and steps however thin, and refines it.
    fn sweep_walls(&mut self) -> Result<(), HexingError> {
        let is_done = !self.is_other() || self.has_held_walls(Background::Swept);
        if is_done || !self.site.may_hold_walls(self.monitor)? {
            return Ok(());
        }
        let plan = Plan { holds_walls: true, ..self.site.plan(Background::Swept) };
        self.another(plan, self.limit_of_walls())?;
        if self.is_on(Background::Swept) { self.refine(self.site.options.max_hexes) } else { Ok(()) }
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
        let lacks_part = self.best_report().is_some_and(|best| best.lacks_part);
        self.may_try_octree() && (self.shows_little() || lacks_part)
    }

    /// Is the best a draft of another kind than the solid that shows hardly anything of it?
    fn shows_hardly_any(&self) -> bool {
        self.best_report().is_some_and(|best| {
            let is_other_draft = best.mesh.is_none() && best.core.off_kind() > 0;
            is_other_draft && captured(best.features.as_ref()) < HARDLY
        })
    }

    /// May there be an octree, that was neither tried nor refused yet?
    fn may_try_octree(&self) -> bool {
        let is_refused = self.refused.iter().any(|refused| refused.background == Background::Octree);
        let may_be_octree = self.site.may_be_octree() && self.site.options.max_levels > 0;
        may_be_octree && !self.has_tried(Background::Octree) && !is_refused
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
        self.grown(FAR_GROWTH).min(self.site.options.max_hexes)
    }

    /// How many if walls and steps are shown however thin.
    fn limit_of_walls(&self) -> u64 {
        self.grown(FAR_GROWTH).max(FEW).min(self.site.options.max_hexes)
    }

    /// How many an octree may have, and what is refined of it.
    fn limit_of_octree(&self) -> u64 {
        let is_wrong = self.best_report().is_none_or(|best| best.core.off_kind() > 0 || best.lacks_part);
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
        let is_wrong = self.attempts[*number].core.off_kind() > 0;
        let details = if is_wrong && !has_place { round.max(plan.details) } else { plan.details };
        if !has_place && details == plan.details {
            return None;
        }
        let regions = [plan.regions.as_slice(), &more].concat();
        let in_blocks = plan.in_blocks || failures.iter().any(|failure| failure.missed == Missed::Far);
        Some(Plan { regions, details, in_blocks, ..plan.clone() })
    }

    /// What came of it.
    fn end(mut self) -> Body {
        let site = self.site;
        let best = self.best.take().and_then(|best| Some(Best { meshed: best.meshed?, number: best.number }));
        Body {
            report: BodyReport {
                place: site.solid.bounds().center().to_array(),
                choice: site.choice,
                directions: site.directions.clone(),
                kept: best.as_ref().map(|best| best.number),
                attempts: self.attempts,
                refused: self.refused,
            },
            best,
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests;
