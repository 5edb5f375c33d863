//! The attempts at a body: drafts and meshes, and which of them is the best.
//!
//! A draft, a core that is not fitted yet, tells already whether it is of the solid's kind and which features it loses. One of
//! another kind is fitted only if none of the solid's kind is found; one that lacks a part of the solid, only if the others do;
//! one that loses much, only if smaller cells lose hardly less, or have something to mend.

use super::attempt::{Draft, draft};
use super::background::{Background, Failure, Missed};
use super::ground::{Plan, Site};
use super::merit::{Bar, captured, distance, is_better, is_far, loses_much, shows_more, worst};
use super::meshed::Meshed;
use super::options::HexingError;
use super::report::{AttemptReport, RefusedAttempt};
use crate::Monitor;
use crate::mesh::MeshHash;

/// What was tried.
pub(super) struct Search<'a> {
    pub(super) site: &'a Site<'a>,
    pub(super) attempts: Vec<AttemptReport>,
    pub(super) refused: Vec<RefusedAttempt>,
    /// The cores of the drafts that were gone on with.
    cores: Vec<MeshHash>,
    pub(super) best: Option<Attempt>,
    /// The plans of which meshes were made.
    fitted: Vec<Plan>,
    /// Plans without a background of so many hexes at most.
    without: Vec<(Plan, u64)>,
    /// Drafts that wait: each is at least about as good as those before.
    pub(super) waiting: Vec<Waiting>,
    /// Hexes that were inverted in an attempt that gave no mesh.
    pub(super) tangled: Option<usize>,
    pub(super) monitor: &'a dyn Monitor,
}

/// What came of an attempt.
pub(super) struct Attempt {
    /// None as long as it is a draft.
    pub(super) meshed: Option<Meshed>,
    /// What it missed and smaller cells may show.
    pub(super) failures: Vec<Failure>,
    /// Its place among the attempts.
    pub(super) number: usize,
    pub(super) plan: Plan,
}

/// A draft that waits.
pub(super) struct Waiting {
    /// Its place among the attempts.
    pub(super) number: usize,
    pub(super) plan: Plan,
    /// Only the last one is kept, which is fitted first: the others are made again.
    pub(super) draft: Option<Draft>,
}

impl<'a> Search<'a> {
    pub(super) fn new(site: &'a Site<'a>, monitor: &'a dyn Monitor) -> Self {
        Self {
            site,
            attempts: Vec::new(),
            refused: Vec::new(),
            cores: Vec::new(),
            fitted: Vec::new(),
            without: Vec::new(),
            best: None,
            waiting: Vec::new(),
            tangled: None,
            monitor,
        }
    }

    /// Makes an attempt; keeps it if it is better than the best so far. A draft of another kind than the solid waits, as does
    /// one that lacks a part of it, or loses so much that smaller cells are tried first; unless another that waits shows more.
    /// Between planes of the solid there may be as many lines of a grid as before: one with the core of another is given up.
    pub(super) fn attempt(&mut self, plan: Plan, max_hexes: u64) -> Result<(), HexingError> {
        let number = self.attempts.len();
        let draft = match self.draft(&plan, max_hexes, self.bar(&plan))? {
            Ok(draft) => draft,
            Err(report) => {
                self.attempts.push(report);
                return Ok(());
            }
        };
        self.attempts.push(draft.report.clone());
        let core = draft.core_hash();
        if plan.shift != [0.0; 3] && self.cores.contains(&core) {
            return Ok(());
        }
        self.cores.push(core);
        let failures = draft.failures(self.site);
        let is_of_kind = draft.report.core.off_kind() == 0;
        let has_rival = self.best.is_some() && !self.waits();
        let may_wait = !has_rival && !failures.is_empty();
        let waits = may_wait && (draft.report.lacks_part || loses_much(&draft.report, self.site.taste));
        if is_of_kind && !waits {
            return self.fit(draft, plan, number);
        }
        if self.best_report().is_none_or(|best| shows_more(&draft.report, best)) {
            self.best = Some(Attempt { meshed: None, failures, number, plan: plan.clone() });
        } else if self.waits() {
            return Ok(());
        }
        if let Some(last) = self.waiting.last_mut() {
            last.draft = None;
        }
        self.waiting.push(Waiting { number, plan, draft: Some(draft) });
        Ok(())
    }

    /// What another attempt has to reach to be gone on with.
    fn bar(&self, plan: &Plan) -> Option<Bar> {
        let (options, taste) = (self.site.options, self.site.taste);
        let (best, report) = (self.best.as_ref()?, self.best_report()?);
        let lost_alone = best.failures.iter().all(|failure| failure.missed == Missed::Lost);
        let is_refined = self.is_good() && best.plan.kind == plan.kind;
        Some(if self.waits() {
            Bar::of_draft(report, taste)
        } else if is_refined && lost_alone {
            Bar::of_refined(report)
        } else {
            Bar::of(report, options, taste)
        })
    }

    /// Is the best attempt a draft of the solid's kind?
    pub(super) fn waits(&self) -> bool {
        self.best
            .as_ref()
            .is_some_and(|best| best.meshed.is_none() && self.attempts[best.number].core.off_kind() == 0)
    }

    /// Fits a draft; keeps the mesh if it is better than the best so far.
    fn fit(&mut self, draft: Draft, plan: Plan, number: usize) -> Result<(), HexingError> {
        let (report, meshed, failures) = match draft.fit(self.site, self.monitor) {
            Err(HexingError::Tangled(hexes)) => {
                self.tangled = Some(hexes);
                return Ok(());
            }
            made => made?,
        };
        let is_better = self
            .best_report()
            .is_none_or(|best| is_better(&report, best, self.site.options, self.site.taste));
        self.attempts[number] = report;
        self.fitted.push(plan.clone());
        if is_better {
            self.best = Some(Attempt { meshed: Some(meshed), failures, number, plan });
        }
        Ok(())
    }

    /// Fits drafts that wait, the last and best first, until there is a mesh with nothing to mend; those that are farther from
    /// the solid's kind than a mesh, or lack a part that it does not, are passed over.
    pub(super) fn settle(&mut self) -> Result<(), HexingError> {
        self.best = self.best.take().filter(|best| best.meshed.is_some());
        while !self.is_good()
            && let Some(waiting) = self.waiting.pop()
        {
            let lacks = |report: &AttemptReport| (report.core.off_kind(), report.lacks_part);
            if self.best_report().is_none_or(|best| lacks(&self.attempts[waiting.number]) <= lacks(best)) {
                self.fit_waiting(waiting)?;
            }
        }
        Ok(())
    }

    /// Fits the best attempt, a draft that waits.
    pub(super) fn fit_best(&mut self) -> Result<(), HexingError> {
        self.best = None;
        self.waiting.pop().map_or(Ok(()), |waiting| self.fit_waiting(waiting))
    }

    /// Fits a draft that waited, or if it is not kept any more, the same made again.
    fn fit_waiting(&mut self, waiting: Waiting) -> Result<(), HexingError> {
        let Waiting { number, plan, draft } = waiting;
        let made = match draft {
            Some(draft) => Ok(draft),
            None => self.draft(&plan, self.site.options.max_hexes, None)?,
        };
        match made {
            Ok(draft) => self.fit(draft, plan, number),
            Err(_) => Ok(()),
        }
    }

    /// Makes a draft, unless it turns out not to reach the `bar`.
    fn draft(
        &self,
        plan: &Plan,
        max_hexes: u64,
        bar: Option<Bar>,
    ) -> Result<Result<Draft, AttemptReport>, HexingError> {
        let background = self.site.background(plan, max_hexes, self.monitor)?;
        draft(self.site, plan, background, bar, self.monitor)
    }

    /// Makes an attempt more, if its background has no more than `limit` hexes. False if there is no such background, which
    /// is noted. No mesh is made twice, and what was refused is not asked for again.
    #[inline(never)] // Compiled once for all that call it.
    pub(super) fn another(&mut self, plan: Plan, limit: u64) -> Result<bool, HexingError> {
        if self.best.as_ref().is_some_and(|best| best.meshed.is_some()) && self.fitted.contains(&plan) {
            return Ok(true);
        }
        if self.without.iter().any(|(other, within)| *other == plan && *within == limit) {
            return Ok(false);
        }
        let Plan { kind: background, shift, holds_walls, .. } = plan;
        match self.attempt(plan.clone(), limit) {
            Err(HexingError::Background(error)) => {
                let (code, reason) = (error.code(), error.to_string());
                let edge_length = self.site.options.edge_length;
                let refused =
                    RefusedAttempt { background, shift, holds_walls, edge_length, limit, code, reason };
                self.refused.push(refused);
                self.without.push((plan, limit));
                Ok(false)
            }
            // It was an attempt.
            Err(HexingError::NothingLeft { .. }) => Ok(true),
            made => made.map(|()| true),
        }
    }

    /// Is the best attempt a mesh of the solid's kind that lacks no part of it?
    pub(super) fn shows_kind(&self) -> bool {
        self.best_report().is_some_and(|best| best.core.off_kind() == 0 && !best.lacks_part)
    }

    /// How far the best attempt is from the solid; infinitely without a mesh.
    pub(super) fn apart(&self) -> f64 {
        self.best_report().map_or(f64::INFINITY, distance)
    }

    pub(super) fn best_report(&self) -> Option<&AttemptReport> {
        self.best.as_ref().map(|best| &self.attempts[best.number])
    }

    /// The place of the best attempt.
    pub(super) fn number(&self) -> Option<usize> {
        self.best.as_ref().map(|best| best.number)
    }

    /// Is the best attempt of this kind?
    pub(super) fn is_on(&self, kind: Background) -> bool {
        self.best_report().is_some_and(|best| best.background == kind)
    }

    /// Has something been made of a background of this kind?
    pub(super) fn has_tried(&self, kind: Background) -> bool {
        self.attempts.iter().any(|attempt| attempt.background == kind)
    }

    /// Was a background of this kind made, or refused, that shows walls however thin?
    pub(super) fn has_held_walls(&self, kind: Background) -> bool {
        let made = self.attempts.iter().map(|attempt| (attempt.background, attempt.holds_walls));
        let refused = self.refused.iter().map(|refused| (refused.background, refused.holds_walls));
        made.chain(refused).any(|tried| tried == (kind, true))
    }

    /// Is what came of it so far not what was asked for: of another kind, or far off, or without many of the features?
    pub(super) fn is_other(&self) -> bool {
        self.is_astray() || self.shows_little()
    }

    /// Does the best attempt show less of the features than was asked for?
    pub(super) fn shows_little(&self) -> bool {
        let is_little = |best: &AttemptReport| captured(best.features.as_ref()) < self.site.taste.shown;
        self.best_report().is_none_or(is_little)
    }

    /// Is the best attempt so far off that it does not show some part of the solid?
    pub(super) fn is_astray(&self) -> bool {
        let is_off_kind = self.best_report().is_none_or(|best| best.core.off_kind() > 0);
        is_off_kind || self.apart() > self.site.taste.astray * self.site.options.edge_length
    }

    /// Where the best attempt is far off the solid, but may come nearer with the cells it has, it does that at once: then nothing
    /// else may have to be tried.
    pub(super) fn approach(&mut self) -> Result<(), HexingError> {
        if self.shows_kind()
            && self.is_astray()
            && let Some(Attempt { meshed: Some(meshed), number, .. }) = &mut self.best
            && let Some(report) = &mut self.attempts[*number].mesh
        {
            meshed.approach_first(self.site.solid, report, self.monitor)?;
        }
        Ok(())
    }

    /// Is there nothing that another try could mend?
    pub(super) fn is_good(&self) -> bool {
        self.best_report().is_some_and(|best| {
            let is_near = !is_far(best, self.site.options);
            best.core.off_kind() == 0 && is_near && worst(best) >= self.site.taste.good
        })
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::fit::testing::house;
    use super::super::merit::Taste;
    use super::super::options::HexingOptions;
    use super::*;
    use crate::Silent;
    use crate::geometry::Point;
    use crate::solid::testing::{cuboid, moved, solid};

    /// Between a cube's planes there are as many lines with either shift; a ball has no planes.
    #[test]
    fn a_grid_that_cannot_stand_elsewhere_is_fitted_once() {
        let cube = cuboid([6, 6, 6]);
        let ball = moved(cube.clone(), |p| (p - Point::splat(3.0)).normalize() * 3.0);
        for (surface, expected) in [(cube, [true, false]), (ball, [true, true])] {
            let options =
                HexingOptions { edge_length: 1.0, background: Background::Grid, ..HexingOptions::default() };
            let solid = solid(&surface);
            let site = Site::new(&solid, &options, &Silent).unwrap();
            let mut search = Search::new(&site, &Silent);
            for shift in [[0.3; 3], [0.4; 3]] {
                search.another(Plan { shift, ..site.plan(Background::Grid) }, u64::MAX).unwrap();
            }
            let is_fitted: Vec<bool> = search.attempts.iter().map(|attempt| attempt.mesh.is_some()).collect();
            assert_eq!(is_fitted, expected);
        }
    }

    #[test]
    fn no_mesh_is_made_twice_and_what_was_refused_is_not_asked_for_again() {
        let options =
            HexingOptions { edge_length: 1.0, background: Background::Grid, ..HexingOptions::default() };
        let solid = solid(&cuboid([6, 6, 6]));
        let site = Site::new(&solid, &options, &Silent).unwrap();
        let mut search = Search::new(&site, &Silent);
        let mut has_background = |limit: u64| search.another(site.plan(Background::Grid), limit).unwrap();
        assert_eq!([5, 5, 6, u64::MAX, u64::MAX].map(&mut has_background), [false, false, false, true, true]);
        assert_eq!((search.refused.len(), search.attempts.len()), (2, 1));
    }

    #[test]
    fn what_is_astray_comes_nearer_before_all_else() {
        // Which waits until it is kept, and how far it is off then, in edges.
        let came = |aside: f64| {
            let solid = house(aside).0;
            let options =
                HexingOptions { edge_length: 0.24, background: Background::Grid, ..HexingOptions::default() };
            let site = Site::new(&solid, &options, &Silent).unwrap();
            let mut search = Search::new(&site, &Silent);
            search.attempt(site.plan(Background::Grid), u64::MAX).unwrap();
            let apart = |search: &Search| search.apart() / options.edge_length;
            let was = apart(&search);
            search.approach().unwrap();
            let waits = search.best.as_ref().unwrap().meshed.as_ref().unwrap().approach.is_some();
            (waits, was, apart(&search))
        };
        let astray = Taste::of(&house(0.0).0).astray;
        let (waits, was, is) = came(0.55);
        assert!(waits && was == is && is <= astray, "{was} {is}");
        let (waits, was, is) = came(0.74);
        assert!(!waits && was > astray && is < 0.5 * was, "{was} {is}");
    }
}
