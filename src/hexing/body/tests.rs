//! What is tried for small bodies, and what is kept of it.

use glam::DMat3;

use super::*;
use crate::Silent;
use crate::geometry::Point;
use crate::hexing::asked::mesh_body;
use crate::hexing::attempt::draft;
use crate::hexing::search::Waiting;
use crate::mesh::PolygonMesh;
use crate::solid::testing::{bent, hollow_ball, lathe, moved, polygons, solid, voxels};

/// A sweep captures its walls, which no grid does, and shows all of the solid but a dimple in the top, so narrow and deep that
/// no cells of a sweep show it; one that is not so deep it shows once it is refined and came nearer.
#[test]
fn a_sweep_is_refined_before_a_grid_is_tried() {
    let fitted = |height: i32, depth: f64| {
        let top = f64::from(height);
        let dimple = |p: Point| depth * (1.0 - (p.truncate() - 10.0).length()).max(0.0);
        let bent = |p: Point| Point::new(p.x + 3.0 * libm::sin(p.y / 4.0), p.y, p.z);
        let plate = voxels([40, 40, height], |_| true);
        let surface = moved(plate, |p| bent(if p.z == top { p - Point::Z * dimple(p) } else { p }));
        let options = HexingOptions { edge_length: 1.5, ..HexingOptions::default() };
        let Body { report, .. } = mesh_body(&solid(&surface), &options, &Silent).unwrap();
        let fitted = report.attempts.iter().filter(|attempt| attempt.mesh.is_some());
        fitted.map(|a| (a.background, a.levels.len())).collect::<Vec<_>>()
    };
    assert_eq!(fitted(6, 4.0), [(Background::Swept, 2), (Background::Swept, 3)]);
    assert_eq!(fitted(10, 5.0)[..2], [(Background::Swept, 2), (Background::Grid, 1)]);
}

/// What is kept of a solid with such edges: its background, how far that is from the solid, and what of it was found.
fn kept(surface: &PolygonMesh, edge_length: f64) -> (Background, f64, bool) {
    kept_with(surface, &HexingOptions { edge_length, ..HexingOptions::default() })
}

fn kept_with(surface: &PolygonMesh, options: &HexingOptions) -> (Background, f64, bool) {
    let Body { best, report } = mesh_body(&solid(surface), options, &Silent).unwrap();
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

/// Of these voxels, with planes at such places along each axis.
fn walls(places: [&[f64]; 3], is_there: impl Fn([i32; 3]) -> bool) -> PolygonMesh {
    let size = places.map(|places| places.len() as i32 - 1);
    moved(voxels(size, is_there), |p| Point::from([0, 1, 2].map(|k| places[k][p[k] as usize])))
}

/// Walls along the axes of a grid are a layer of right-angled hexes, whether the plain grid shows nothing of them, part of
/// them, or all, but off.
#[test]
fn thin_walls_are_a_layer_of_hexes() {
    for thickness in [0.05, 0.1, 0.3] {
        let t = thickness;
        let angle = walls([&[0.0, t, 6.0], &[0.0, t, 5.0], &[0.0, 4.0]], |[x, y, _]| x == 0 || y == 0);
        let tray = walls([&[0.0, t, 6.0 - t, 6.0], &[0.0, t, 5.0 - t, 5.0], &[0.0, t, 3.0]], |at| {
            at[2] == 0 || at[0] != 1 || at[1] != 1
        });
        for surface in [angle, tray] {
            let (background, apart, shows_all) = kept(&surface, 1.0);
            let is_shown = apart < 1e-9 && shows_all;
            assert!(background == Background::Grid && is_shown, "{t}: {background:?} {apart}");
        }
    }
}

/// A sheet that is bent by 60 degrees, sharply or along an arc, is swept across its thickness: layers follow the bend.
#[test]
fn bent_sheets_are_swept() {
    for (thickness, radius, pieces) in [(0.05, 0.0, 0), (0.1, 1.0, 12), (0.3, 1.0, 12)] {
        let ways = |angle: f64| {
            let (sin, cos) = libm::sincos(angle);
            [Point::new(cos, sin, 0.0), Point::new(sin, -cos, 0.0)]
        };
        let bend = 60.0_f64.to_radians();
        let (start, end) = (ways(0.0), ways(bend));
        // For each place along the sheet one within, and the way through the sheet.
        let mut places = vec![(start[0] * -5.0 + start[1] * radius, start[1])];
        if pieces == 0 {
            places.push((Point::ZERO, ways(0.5 * bend)[1] / libm::cos(0.5 * bend)));
        } else {
            let out = |k: i32| ways(bend * f64::from(k) / f64::from(pieces))[1];
            places.extend((0..=pieces).map(|k| (out(k) * radius, out(k))));
        }
        places.push((end[0] * 5.0 + end[1] * radius, end[1]));
        let sheet = voxels([places.len() as i32 - 1, 1, 1], |_| true);
        let bent = moved(sheet, |p| {
            let (inside, out) = places[p.x as usize];
            inside + out * (thickness * (1.0 - p.y)) + Point::Z * 4.0 * p.z
        });
        let (background, apart, shows_all) = kept(&bent, 1.0);
        let is_shown = apart < 0.03 && shows_all;
        assert!(background == Background::Swept && is_shown, "{thickness}: {background:?} {apart}");
    }
}

/// Of a cup as thin as a tenth of an edge neither bottom nor wall can be told apart within the usual tolerances.
#[test]
fn thin_walls_are_swept_where_all_else_misses_them() {
    let cup = lathe(&[[4.0, 0.0], [4.0, 5.0], [3.9, 5.0], [3.9, 0.1]], 48);
    for background in [Background::Auto, Background::Swept] {
        let options = HexingOptions { edge_length: 1.0, background, ..HexingOptions::default() };
        let (background, apart, shows_all) = kept_with(&cup, &options);
        assert!(background == Background::Swept && apart < 0.03 && shows_all, "{background:?} {apart}");
    }
}

/// However thin it is, and whichever way it is bent, a shell is a layer of good hexes at once.
#[test]
fn shells_are_layers_from_side_to_side() {
    for thickness in [0.1, 0.4] {
        let saddle = bent(20, thickness, |x, y| 0.02 * (x * x - y * y));
        for surface in [saddle, hollow_ball(16, 6.0, thickness)] {
            let solid = solid(&surface);
            let options = HexingOptions { edge_length: 1.0, ..HexingOptions::default() };
            let Body { report, .. } = mesh_body(&solid, &options, &Silent).unwrap();
            let [attempt] = report.attempts.as_slice() else { panic!("{:?}", report.attempts.len()) };
            let mesh = attempt.mesh.as_ref().unwrap();
            assert!(
                attempt.background == Background::Shell && attempt.features.as_ref().unwrap().lost() == 0
            );
            assert!(mesh.worst > 0.6 && mesh.mean > 0.85, "{} {}", mesh.worst, mesh.mean);
            assert!(distance(attempt) < 0.1, "{}", distance(attempt));
        }
    }
}

/// A bent plate is one where that is asked for, also where it is thick, and none where a grid is; a cube is none.
#[test]
fn shells_are_made_where_they_are_asked_for() {
    let options =
        HexingOptions { edge_length: 1.0, background: Background::Shell, ..HexingOptions::default() };
    let plate = bent(16, 4.0, |x, _| 0.01 * x * x);
    assert_eq!(kept_with(&plate, &options).0, Background::Shell);
    let thin = solid(&bent(12, 0.3, |x, y| 0.03 * (x * x - y * y)));
    let grids = HexingOptions { background: Background::Grid, ..options.clone() };
    let Body { report, .. } = mesh_body(&thin, &grids, &Silent).unwrap();
    assert!(report.attempts.iter().all(|attempt| attempt.background == Background::Grid));
    let cube = solid(&voxels([4, 4, 4], |_| true));
    let refused = mesh_body(&cube, &options, &Silent).err();
    assert_eq!(refused, Some(HexingError::Background(BackgroundError::NoShell)));
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

/// How many hexes an octree may have after a first attempt with this Euler number and so many cells.
fn limit_of_octree((euler, lacks_part): (i64, bool), background: usize, max_hexes: u64) -> u64 {
    let solid = solid(&voxels([4, 4, 4], |_| true));
    let options = HexingOptions { edge_length: 1.0, max_hexes, ..HexingOptions::default() };
    let site = Site::new(&solid, &options, &Silent).unwrap();
    let mut search = Search::new(&site, &Silent);
    search.attempt(site.plan(Background::Grid), max_hexes).unwrap();
    let attempt = &mut search.attempts[0];
    (attempt.core.euler, attempt.core.background, attempt.lacks_part) = (euler, background, lacks_part);
    search.limit_of_octree()
}

/// Where a coarse grid has another Euler number, or lacks a part, an octree may have as many hexes as small holes take.
#[test]
fn an_octree_may_be_larger_where_the_kind_is_wrong() {
    let many = 1_000_000;
    let kinds = [(2, false), (0, false), (2, true)];
    assert_eq!(kinds.map(|kind| limit_of_octree(kind, 2446, many)), [20_000, 150_000, 150_000]);
    assert_eq!(kinds.map(|kind| limit_of_octree(kind, 10_000, many)), [80_000, 240_000, 240_000]);
    assert_eq!(kinds.map(|kind| limit_of_octree(kind, 10_000, 50_000)), [50_000; 3]);
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

/// Smaller cells here and there do not help what shows next to nothing and is of another kind; others are refined, and so is this
/// where an octree was refused.
#[test]
fn a_draft_of_another_kind_that_shows_hardly_anything_is_not_refined_before_an_octree_was_tried() {
    let solid = solid(&voxels([4, 4, 4], |_| true));
    let options = HexingOptions { edge_length: 1.0, ..HexingOptions::default() };
    let site = Site::new(&solid, &options, &Silent).unwrap();
    let attempts = |euler: i64, curves: usize, octree_limit: Option<u64>| {
        let mut search = with_draft(&site, euler);
        let features = search.attempts[0].features.as_mut().unwrap();
        (features.curves.captured, features.surfaces.captured) = (curves, 0);
        let lost = Failure { points: vec![Point::ZERO], level: 0, missed: Missed::Lost };
        search.best.as_mut().unwrap().failures = vec![lost];
        if let Some(limit) = octree_limit {
            assert!(!search.another(site.plan(Background::Octree), limit).unwrap());
        }
        search.refine(options.max_hexes).unwrap();
        search.attempts.len()
    };
    // Four of 18 curves and surfaces are less than a quarter.
    assert_eq!(attempts(0, 4, None), 1);
    for tried in [attempts(0, 5, None), attempts(2, 4, None), attempts(0, 4, Some(1))] {
        assert!(tried > 1, "{tried}");
    }
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
    let recessed = voxels([20, 20, 6], |[x, y, z]| z < 5 || !(8..11).contains(&x) || !(8..11).contains(&y));
    let shallow = moved(recessed, |p| p.with_z(p.z.min(5.0) + 0.4 * (p.z - 5.0).max(0.0)));
    let options = HexingOptions { edge_length: 1.0, max_distance: Some(0.09), ..HexingOptions::default() };
    let Body { best, report } = mesh_body(&solid(&shallow), &options, &Silent).unwrap();
    let distances: Vec<f64> = report.attempts.iter().map(distance).collect();
    let kept = best.unwrap().number;
    assert!(distances[0] > 0.1 && kept > 0 && distances[kept] < 0.09, "{distances:?} {kept}");
}
