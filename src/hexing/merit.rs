//! Which of two attempts a user would rather have.
//!
//! First the one that is nearer to the solid's kind, then one within the distance allowed. Between two like that
//! small things and great ones are weighed against each other: a curve lost that is shorter than a cell is no reason to
//! take a mesh that is far off elsewhere. What an attempt costs is the sum of
//!
//! | what | as |
//! |---|---|
//! | how far mesh and solid are from each other | edges, twice; beyond the distance allowed, in units of that |
//! | curves and surfaces that are lost | share of all; half of it on free forms |
//! | the mean scaled Jacobian | what it lacks to 1, four times, and to [`FAIR`], ten times |
//! | the least scaled Jacobian | twice the share of a good one that it lacks, and [`FAULT`] if it lacks any |

use std::cmp::Ordering;

use super::options::HexingOptions;
use super::report::{AttemptReport, FeatureReport};
use crate::solid::SolidModel;

/// What is asked of the mesh of a solid of some kind.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Taste {
    /// A least scaled Jacobian with which there is nothing to mend.
    pub(super) good: f64,
    /// What the share of the curves and surfaces that are lost weighs.
    lost: f64,
    /// Mesh and solid may be so many edges from each other before smaller cells are tried, or a share of the solid (`misses`).
    pub(super) near: f64,
    /// What is farther from the solid than so many edges does not show some part of it, that another background may show.
    pub(super) astray: f64,
    /// What shows less than this share of the curves and surfaces is not what was asked for.
    pub(super) shown: f64,
    /// An attempt that loses a greater share of the features than another by this is given up before it is fitted.
    loss: f64,
}

impl Taste {
    /// For solids that somebody drew.
    const DRAWN: Self = Self { good: 0.35, lost: 1.0, near: 0.2, astray: 0.4, shown: 0.5, loss: 0.02 };

    /// For free forms: nobody drew their curves, and nothing tells cells where to be poor. Smaller cells take more of the mean
    /// than what they show of a scan is worth. What is near enough not to be refined (`attempt`) is not astray.
    const FREE_FORM: Self = Self { good: 0.45, lost: 0.5, near: 0.5, astray: 0.6, shown: 0.0, loss: 1.0 };

    /// For this solid.
    pub(super) fn of(solid: &SolidModel) -> Self {
        if solid.is_free_form() { Self::FREE_FORM } else { Self::DRAWN }
    }
}

/// What the distance weighs, and a lack of the least scaled Jacobian.
const APART: f64 = 2.0;
const WORST: f64 = 2.0;

/// What it costs that the least scaled Jacobian is no good one, however little it lacks.
const FAULT: f64 = 0.25;

/// What a lack of mean scaled Jacobian weighs.
const MEAN: f64 = 4.0;

/// A mean scaled Jacobian that smaller cells must not cost, and what each lack of it weighs.
pub(super) const FAIR: f64 = 0.85;
const UNFAIR: f64 = 10.0;

/// A draft whose losses weigh more than this waits for one with smaller cells, if that loses so much less.
const MUCH: f64 = 0.1;
const SOME: f64 = 0.05;
const LESS: f64 = 0.1;

/// Smaller cells for the sake of what was lost alone have to show so much more, as a share of the features, or half of it.
const CLEARLY: f64 = 0.02;

/// What an attempt has to reach to be worth going on with.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bar {
    off_kind: u64,
    /// The share of the features that it may lose.
    lost: f64,
}

impl Bar {
    /// That of the best attempt so far. Another than one that is astray may lose more, as much as weighs no more than what
    /// it may bring mesh and solid nearer.
    pub(super) fn of(best: &AttemptReport, options: &HexingOptions, taste: Taste) -> Self {
        let apart = best.mesh.as_ref().map_or(0.0, |mesh| mesh.distance.hausdorff() / options.edge_length);
        let gain = APART * (apart - taste.astray).max(0.0);
        Self {
            off_kind: best.core.off_kind(),
            lost: lost(best.features.as_ref()) + taste.loss + gain / taste.lost,
        }
    }

    /// That of smaller cells where the best attempt lost something and has nothing else to mend.
    pub(super) fn of_refined(best: &AttemptReport) -> Self {
        let was = lost(best.features.as_ref());
        Self { off_kind: best.core.off_kind(), lost: (was - CLEARLY).max(0.5 * was) }
    }

    /// That of a draft that [loses much](loses_much). What may show a part that the draft lacks may lose anything.
    pub(super) fn of_draft(draft: &AttemptReport, taste: Taste) -> Self {
        let was = lost(draft.features.as_ref());
        let lost = if draft.lacks_part { f64::INFINITY } else { was - LESS / taste.lost };
        Self { off_kind: draft.core.off_kind(), lost }
    }

    /// Is a core that is so far from the solid's Euler number, with these features if they are known, not worth it?
    pub(super) fn is_above(&self, off_kind: u64, features: Option<&FeatureReport>) -> bool {
        let loses_more = features.is_some() && lost(features) > self.lost;
        off_kind > self.off_kind || off_kind == self.off_kind && loses_more
    }
}

/// The share of the curves and surfaces that are lost; all of them where nobody looked. Curves that are contracted or of
/// low steps, and surfaces for which others stand, are not: they are as small as a cell.
fn lost(features: Option<&FeatureReport>) -> f64 {
    features.map_or(1.0, |features| {
        let found = features.curves.found + features.surfaces.found;
        (features.lost() - features.low.suppressed) as f64 / found.max(1) as f64
    })
}

/// The share of the curves and surfaces that have edges and faces of their own, be they small or not, but for those of low
/// steps; none where nobody looked.
pub(super) fn captured(features: Option<&FeatureReport>) -> f64 {
    features.map_or(0.0, |features| {
        let [curves, surfaces] = [features.curves, features.surfaces];
        let found = curves.found + surfaces.found - features.low.curves - features.low.surfaces;
        (curves.captured + surfaces.captured) as f64 / found.max(1) as f64
    })
}

/// Does a draft lose so many features that it may lack a part?
pub(super) fn loses_some(draft: &AttemptReport, taste: Taste) -> bool {
    taste.lost * lost(draft.features.as_ref()) > SOME
}

/// Does a draft lose so many features that it is worth looking first whether smaller cells lose less?
pub(super) fn loses_much(draft: &AttemptReport, taste: Taste) -> bool {
    taste.lost * lost(draft.features.as_ref()) > MUCH
}

/// Does the draft `a` show more of the solid than `b`, be that a mesh or not?
pub(super) fn shows_more(a: &AttemptReport, b: &AttemptReport) -> bool {
    let lacks = |report: &AttemptReport| (report.core.off_kind(), report.lacks_part);
    let order = lacks(a).cmp(&lacks(b));
    order.then(lost(a.features.as_ref()).total_cmp(&lost(b.features.as_ref()))) == Ordering::Less
}

/// Are mesh and solid farther from each other than allowed?
pub(super) fn is_far(report: &AttemptReport, options: &HexingOptions) -> bool {
    options.max_distance.is_some_and(|limit| distance(report) > limit)
}

/// The least scaled Jacobian.
pub(super) fn worst(report: &AttemptReport) -> f64 {
    report.mesh.as_ref().map_or(f64::NEG_INFINITY, |mesh| mesh.worst)
}

/// How far mesh and solid are from each other; infinite without a mesh.
pub(super) fn distance(report: &AttemptReport) -> f64 {
    report.mesh.as_ref().map_or(f64::INFINITY, |mesh| mesh.distance.hausdorff())
}

/// Is `a` better than `b`? One without a mesh is better than none.
pub(super) fn is_better(a: &AttemptReport, b: &AttemptReport, options: &HexingOptions, taste: Taste) -> bool {
    let first = |report: &AttemptReport| (report.core.off_kind(), is_far(report, options));
    let cost = |report: &AttemptReport| cost(report, options, taste);
    let order = first(a).cmp(&first(b)).then(cost(a).total_cmp(&cost(b)));
    order == Ordering::Less
}

fn cost(report: &AttemptReport, options: &HexingOptions, taste: Taste) -> f64 {
    let Some(mesh) = &report.mesh else { return f64::INFINITY };
    let allowed = options.max_distance.filter(|_| is_far(report, options));
    let unit = allowed.unwrap_or(options.edge_length);
    let lacking = (taste.good - mesh.worst).max(0.0) / taste.good;
    APART * distance(report) / unit
        + taste.lost * lost(report.features.as_ref())
        + MEAN * (1.0 - mesh.mean)
        + UNFAIR * (FAIR - mesh.mean).max(0.0)
        + WORST * lacking
        + if lacking > 0.0 { FAULT } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::super::attempt::TOO_FAR;
    use super::super::core::CoreReport;
    use super::super::report::{Captured, FitCounts, LostFeature, MeshedReport, SheetCounts};
    use super::*;
    use crate::geometry::Point;
    use crate::mesh::Distances;

    fn options() -> HexingOptions {
        HexingOptions { edge_length: 2.0, ..HexingOptions::default() }
    }

    /// An attempt of a solid with 70 curves and 30 surfaces that lost so many curves.
    fn attempt(euler: i64, lost: u32, distance: f64, worst: f64, mean: f64) -> AttemptReport {
        let mut apart = Distances::none();
        apart.mesh_to_surface.max = distance;
        let suppressed = (0..lost).map(|id| LostFeature { id, place: [0.0; 3], size: 1.0 }).collect();
        let features = FeatureReport {
            curves: Captured { found: 70, captured: 70 - lost as usize },
            surfaces: Captured { found: 30, captured: 30 },
            suppressed,
            ..FeatureReport::default()
        };
        let mesh = MeshedReport {
            sheets: SheetCounts::default(),
            fit: FitCounts::default(),
            hexes: 1000,
            worst,
            mean,
            distance: apart,
        };
        AttemptReport {
            core: CoreReport { euler, solid_euler: 2, volume_ratio: 1.0, ..CoreReport::default() },
            features: Some(features),
            mesh: Some(mesh),
            ..AttemptReport::default()
        }
    }

    #[test]
    fn the_right_euler_number_comes_first() {
        let right = attempt(2, 9, 1.0, 0.1, 0.7);
        assert!(is_better(&right, &attempt(0, 0, 0.0, 0.9, 0.99), &options(), Taste::DRAWN));
        assert!(!is_better(&attempt(0, 0, 0.0, 0.9, 0.99), &right, &options(), Taste::DRAWN));
    }

    #[test]
    fn one_small_feature_does_not_outweigh_a_far_worse_mesh() {
        let (lost_one, all_kept) = (attempt(2, 1, 0.9, 0.44, 0.93), attempt(2, 0, 2.9, 0.4, 0.87));
        assert!(is_better(&lost_one, &all_kept, &options(), Taste::DRAWN));
        // Of two that are alike else it does count.
        assert!(is_better(&attempt(2, 0, 0.9, 0.44, 0.93), &lost_one, &options(), Taste::DRAWN));
    }

    #[test]
    fn a_few_more_features_are_not_worth_a_poor_mean() {
        let (fewer, more) = (attempt(2, 27, 1.0, 0.345, 0.865), attempt(2, 3, 0.85, 0.335, 0.8));
        assert!(is_better(&fewer, &more, &options(), Taste::DRAWN));
        assert!(is_better(&attempt(2, 3, 0.85, 0.335, 0.85), &fewer, &options(), Taste::DRAWN));
    }

    #[test]
    fn distance_and_a_bad_worst_cell_outweigh_a_little_mean() {
        let (near, far) = (attempt(2, 0, 0.482, 0.36, 0.926), attempt(2, 0, 0.568, 0.36, 0.942));
        assert!(is_better(&near, &far, &options(), Taste::DRAWN));
        let (bad, good) = (attempt(2, 0, 0.6, 0.281, 0.949), attempt(2, 0, 0.836, 0.333, 0.967));
        assert!(is_better(&good, &bad, &options(), Taste::DRAWN));
    }

    #[test]
    fn a_good_worst_cell_is_worth_some_distance() {
        let (good, near) = (attempt(2, 0, 0.5, 0.351, 0.95), attempt(2, 0, 0.3, 0.349, 0.95));
        assert!(is_better(&good, &near, &options(), Taste::DRAWN));
        assert!(is_better(&near, &attempt(2, 0, 0.6, 0.351, 0.95), &options(), Taste::DRAWN));
    }

    /// Of two attempts on the bunny one had more creases of the scan, and poorer cells.
    #[test]
    fn creases_of_free_forms_weigh_less_than_cells() {
        let (good, creased) = (attempt(2, 23, 0.718, 0.45, 0.895), attempt(2, 13, 0.768, 0.443, 0.893));
        assert!(is_better(&good, &creased, &options(), Taste::FREE_FORM));
        assert!(is_better(&creased, &good, &options(), Taste::DRAWN));
        // Whichever comes first, the other is gone on with.
        for [first, second] in [[&good, &creased], [&creased, &good]] {
            assert!(!Bar::of(first, &options(), Taste::FREE_FORM).is_above(0, second.features.as_ref()));
        }
        // They count all the same: ten of a hundred as much as half of that share of two edges.
        let smooth = |distance| attempt(2, 10, distance, 0.45, 0.895);
        let creased = attempt(2, 0, 0.7, 0.45, 0.895);
        assert!(is_better(&smooth(0.64), &creased, &options(), Taste::FREE_FORM));
        assert!(is_better(&creased, &smooth(0.66), &options(), Taste::FREE_FORM));
        assert!(is_better(&creased, &smooth(0.61), &options(), Taste::DRAWN));
    }

    #[test]
    fn tastes_are_those_of_solids() {
        use crate::solid::testing::{cuboid, moved, solid};
        let cube = cuboid([6, 6, 6]);
        let ball = moved(cube.clone(), |p| (p - Point::splat(3.0)).normalize());
        assert_eq!(Taste::of(&solid(&cube)), Taste::DRAWN);
        assert_eq!(Taste::of(&solid(&ball)), Taste::FREE_FORM);
    }

    #[test]
    fn what_is_within_the_distance_allowed_is_better() {
        let allowed = HexingOptions { max_distance: Some(0.1), ..options() };
        let (near, far) = (attempt(2, 0, 0.09, 0.2, 0.8), attempt(2, 0, 0.11, 0.6, 0.95));
        assert!(
            is_better(&near, &far, &allowed, Taste::DRAWN)
                && is_better(&far, &near, &options(), Taste::DRAWN)
        );
    }

    /// Smaller cells that bring a mesh on the way there are worth a poorer mean, as long as it is too far, and only then.
    #[test]
    fn beyond_the_distance_allowed_the_nearer_is_better() {
        let (near, far) = (attempt(2, 0, 0.3, 0.39, 0.9), attempt(2, 0, 0.4, 0.39, 0.95));
        for (limit, expected) in [(None, false), (Some(0.5), false), (Some(0.35), true), (Some(0.2), true)] {
            let allowed = HexingOptions { max_distance: limit, ..options() };
            assert_eq!(is_better(&near, &far, &allowed, Taste::DRAWN), expected, "{limit:?}");
            assert_eq!(is_better(&far, &near, &allowed, Taste::DRAWN), !expected, "{limit:?}");
        }
    }

    #[test]
    fn what_is_captured_is_a_share_of_curves_and_surfaces() {
        let share = |lost| captured(attempt(2, lost, 0.0, 0.0, 0.0).features.as_ref());
        assert_eq!([share(0), share(40)], [1.0, 0.6]);
        assert_eq!(captured(None), 0.0);
    }

    #[test]
    fn attempts_that_lose_much_more_are_not_gone_on_with() {
        let bar = Bar::of(&attempt(2, 3, 0.5, 0.4, 0.9), &options(), Taste::DRAWN);
        let losing = |lost| attempt(2, lost, 0.0, 0.0, 0.0).features;
        assert!(!bar.is_above(0, None) && bar.is_above(2, None));
        assert!(!bar.is_above(0, losing(4).as_ref()) && bar.is_above(0, losing(6).as_ref()));
    }

    #[test]
    fn what_is_near_enough_not_to_be_refined_is_not_astray() {
        for taste in [Taste::DRAWN, Taste::FREE_FORM] {
            assert!(taste.astray >= TOO_FAR * taste.near, "{taste:?}");
        }
    }

    /// It is a tenth of an edge beyond astray, which weighs a fifth of the features.
    #[test]
    fn attempts_after_one_that_is_astray_may_lose_what_nearness_weighs() {
        let bar = Bar::of(&attempt(2, 3, 1.0, 0.4, 0.9), &options(), Taste::DRAWN);
        let is_above = |lost| bar.is_above(0, attempt(2, lost, 0.0, 0.0, 0.0).features.as_ref());
        assert_eq!([24, 26].map(is_above), [false, true]);
        let draft = AttemptReport { mesh: None, ..attempt(2, 3, 0.0, 0.0, 0.0) };
        let bar = Bar::of(&draft, &options(), Taste::DRAWN);
        assert!(bar.is_above(0, attempt(2, 6, 0.0, 0.0, 0.0).features.as_ref()));
    }

    #[test]
    fn smaller_cells_for_what_was_lost_alone_have_to_show_clearly_more() {
        for (was, enough) in [(20, 18), (10, 8), (3, 1), (1, 0)] {
            let bar = Bar::of_refined(&attempt(2, was, 0.1, 0.4, 0.9));
            let is_above = |lost| bar.is_above(0, attempt(2, lost, 0.0, 0.0, 0.0).features.as_ref());
            assert_eq!([enough, enough + 1].map(is_above), [false, true], "{was}");
        }
    }

    #[test]
    fn of_drafts_that_wait_one_that_lacks_no_part_is_first() {
        let draft = |lost, lacks_part| AttemptReport { lacks_part, ..attempt(2, lost, 0.0, 0.0, 0.0) };
        let [lacking, whole, other] = [
            draft(9, true),
            draft(30, false),
            AttemptReport { lacks_part: true, ..attempt(0, 0, 0.0, 0.0, 0.0) },
        ];
        assert!(shows_more(&whole, &lacking) && !shows_more(&lacking, &whole));
        assert!(shows_more(&lacking, &other) && shows_more(&draft(8, true), &lacking));
        let bar = Bar::of_draft(&lacking, Taste::DRAWN);
        assert!(!bar.is_above(0, draft(60, false).features.as_ref()));
        assert!(bar.is_above(2, draft(0, false).features.as_ref()));
    }

    #[test]
    fn a_draft_that_loses_much_waits_for_one_that_loses_clearly_less() {
        let draft = |lost| AttemptReport { mesh: None, ..attempt(2, lost, 0.0, 0.0, 0.0) };
        assert_eq!([9, 11].map(|lost| loses_much(&draft(lost), Taste::DRAWN)), [false, true]);
        assert_eq!([19, 21].map(|lost| loses_much(&draft(lost), Taste::FREE_FORM)), [false, true]);
        assert_eq!([4, 6].map(|lost| loses_some(&draft(lost), Taste::DRAWN)), [false, true]);
        let bar = Bar::of_draft(&draft(30), Taste::DRAWN);
        assert_eq!([19, 21].map(|lost| bar.is_above(0, draft(lost).features.as_ref())), [false, true]);
        assert!(bar.is_above(1, draft(0).features.as_ref()));
    }

    #[test]
    fn of_drafts_the_kind_comes_first() {
        let [right, wrong, fewer] =
            [attempt(2, 9, 0.0, 0.0, 0.0), attempt(0, 0, 0.0, 0.0, 0.0), attempt(2, 8, 0.0, 0.0, 0.0)];
        assert!(shows_more(&right, &wrong) && !shows_more(&wrong, &right));
        assert!(shows_more(&fewer, &right) && !shows_more(&right, &right));
    }
}
