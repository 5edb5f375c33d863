//! A mesh of one body: attempts, until there is nothing left to mend (design, section 5; issue: refine and retry).
//!
//! 1. The background of choice, as it is.
//! 2. Where that missed something, cells a level smaller there, as often as the options allow, and as long as it helps.
//!    Of a core that is not of the solid's kind it is not always known where it differs: then thin walls, narrow gaps and
//!    short curves are refined.
//! 3. Where cells are bad, or mesh and solid still too far from each other: grids whose lines stand elsewhere; instead of
//!    a sweep, a grid.
//!
//! The best attempt is kept (`merit`). Those that turn out to be worse than another are given up at once; and none is
//! begun that would be many times as large as the first.

use super::attempt::{Meshed, attempt, off_euler};
use super::background::{Background, BackgroundError, retry};
use super::ground::{Plan, Site};
use super::merit::{Bar, GOOD, distance, is_better, is_far, worst};
use super::options::{HexingError, HexingOptions};
use super::report::{AttemptReport, BodyReport};
use crate::Monitor;
use crate::solid::SolidModel;

/// How the lines of a grid are moved from try to try, as shares of an edge.
const SHIFTS: [[f64; 3]; 2] = [[0.5; 3], [0.25, 0.5, 0.75]];

/// A least scaled Jacobian with which there is no grid tried instead of a sweep: it captures less.
const POOR: f64 = 0.2;

/// A sweep that is farther from the solid than so many edges does not show some part of it that a grid may show.
const ASTRAY: f64 = 0.5;

/// The background of another try has at most so many times the hexes of the first.
const GROWTH: u64 = 4;

/// So many hexes are never too many for another try.
const FEW: u64 = 20_000;

/// The best mesh of a body, and what was done for it.
pub(super) struct Body {
    /// None where no cell lies within the body.
    pub(super) best: Option<Best>,
    pub(super) report: BodyReport,
}

/// An attempt and what came of it.
pub(super) struct Best {
    pub(super) meshed: Meshed,
    /// Its place among the attempts.
    pub(super) number: usize,
    plan: Plan,
}

/// Meshes a body.
pub(super) fn mesh_body(
    solid: &SolidModel,
    options: &HexingOptions,
    monitor: &dyn Monitor,
) -> Result<Body, HexingError> {
    let site = Site::new(solid, options, monitor)?;
    let mut search = Search { site: &site, attempts: Vec::new(), best: None, tangled: None, monitor };
    let first = Plan::of(site.choice.kind);
    match search.attempt(first, options.max_hexes) {
        Err(HexingError::NothingLeft { .. }) => return Ok(search.end(&site)),
        // What may be swept, but not be refined as the options want it.
        Err(HexingError::Background(BackgroundError::Refine(_))) if site.may_be_grid() => {
            search.attempt(Plan::of(Background::Grid), options.max_hexes)?;
        }
        made => made?,
    }
    for round in 1..=options.max_levels {
        let Some(plan) = search.finer(round) else { break };
        let before = search.number();
        search.another(plan)?;
        if search.number() == before {
            break;
        }
    }
    let (shifts, least, farthest): (&[[f64; 3]], f64, f64) = match site.choice.kind {
        Background::Grid => (&SHIFTS, GOOD, f64::INFINITY),
        Background::Swept if site.may_be_grid() => (&[[0.0; 3]], POOR, ASTRAY * options.edge_length),
        _ => (&[], 0.0, f64::INFINITY),
    };
    for &shift in shifts {
        if !search.is_good(least, farthest) {
            search.another(Plan { shift, ..Plan::of(Background::Grid) })?;
        }
    }
    match (&search.best, search.tangled) {
        (None, Some(hexes)) => Err(HexingError::Tangled(hexes)),
        _ => Ok(search.end(&site)),
    }
}

struct Search<'a> {
    site: &'a Site<'a>,
    attempts: Vec<AttemptReport>,
    best: Option<Best>,
    /// Hexes that were inverted in an attempt that gave no mesh.
    tangled: Option<usize>,
    monitor: &'a dyn Monitor,
}

impl Search<'_> {
    /// Makes an attempt; keeps it if it is better than the best so far.
    fn attempt(&mut self, plan: Plan, max_hexes: u64) -> Result<(), HexingError> {
        let background = self.site.background(&plan, max_hexes, self.monitor)?;
        let bar = self.best_report().map(Bar::of);
        let (report, meshed) = match attempt(self.site, &plan, background, bar, self.monitor) {
            Err(HexingError::Tangled(hexes)) => {
                self.tangled = Some(hexes);
                return Ok(());
            }
            made => made?,
        };
        let number = self.attempts.len();
        let is_better = self.best_report().is_none_or(|best| is_better(&report, best, self.site.options));
        self.attempts.push(report);
        if let Some(meshed) = meshed.filter(|_| is_better) {
            self.best = Some(Best { meshed, number, plan });
        }
        Ok(())
    }

    /// Makes an attempt more, if that is not too much to ask for.
    fn another(&mut self, plan: Plan) -> Result<(), HexingError> {
        let first = self.attempts.first().map_or(0, |first| first.core.background as u64);
        let limit = self.site.options.max_hexes.min((GROWTH * first).max(FEW));
        match self.attempt(plan, limit) {
            // It was an attempt.
            Err(HexingError::Background(_) | HexingError::NothingLeft { .. }) => Ok(()),
            made => made,
        }
    }

    /// The best attempt, with smaller cells where it missed something; none if it missed nothing that these may show.
    fn finer(&self, round: u8) -> Option<Plan> {
        let Best { meshed, plan, number } = self.best.as_ref()?;
        let more = retry(&meshed.failures, self.site.edge_length(), self.site.finest());
        let has_place = !more.regions.is_empty();
        let is_wrong = off_euler(&self.attempts[*number].core) > 0;
        let details = if is_wrong && !has_place { round } else { plan.details };
        if !has_place && details == plan.details {
            return None;
        }
        let regions = [plan.regions.as_slice(), &more.regions].concat();
        Some(Plan { regions, details, ..plan.clone() })
    }

    fn best_report(&self) -> Option<&AttemptReport> {
        self.best.as_ref().map(|best| &self.attempts[best.number])
    }

    /// The place of the best attempt.
    fn number(&self) -> Option<usize> {
        self.best.as_ref().map(|best| best.number)
    }

    /// Is there nothing that another try could mend, where the worst cell may be so bad, and the mesh so far off?
    fn is_good(&self, least: f64, farthest: f64) -> bool {
        self.best_report().is_some_and(|best| {
            let is_near = !is_far(best, self.site.options) && distance(best) <= farthest;
            off_euler(&best.core) == 0 && is_near && worst(best) >= least
        })
    }

    fn end(self, site: &Site<'_>) -> Body {
        let report = BodyReport {
            place: site.solid.bounds().center().to_array(),
            choice: site.choice,
            directions: site.directions.clone(),
            kept: self.number(),
            attempts: self.attempts,
        };
        Body { best: self.best, report }
    }
}
