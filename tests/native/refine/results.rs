//! What a result holds beside its quads, and what is refused.

use hexmill::geometry::Point;
use hexmill::mesh::check::check_quads;
use hexmill::mesh::{Group, TagSet, Tags};
use hexmill::refine::{QuadOptions, QuadRefinement, RefineError, RefinedQuads, refine_quads};
use hexmill::sizing::{Region, Shape, Target};
use hexmill::{Cancelled, Monitor, Silent, Stage};

use super::worlds::{cube, grid, mixed_strip, surface};
use super::{judge, refine_where};

fn refuse(input: &hexmill::mesh::PolygonMesh, options: QuadOptions) -> (&'static str, String) {
    let error = refine_quads(input, &options, &Silent).expect_err("a refusal");
    (error.code(), error.to_string())
}

fn ball(center: [f64; 3], radius: f64, level: u8) -> QuadOptions {
    let shape = Shape::Sphere { center: Point::from(center), radius };
    QuadOptions { regions: vec![Region { shape, target: Target::Level(level) }], ..QuadOptions::default() }
}

/// Quads per template: children of refined elements less those refined again, and 1, 3 or 4 a leaf.
#[test]
fn counts_follow_from_the_templates() {
    let uniform = |levels| QuadOptions { levels: Some(levels), ..QuadOptions::default() };
    for levels in 0..6 {
        let n = 2_usize.pow(u32::from(levels));
        let refined = refine_quads(&grid(3, 2), &uniform(levels), &Silent).unwrap();
        assert_eq!(refined.mesh.quads.len(), 6 * n * n);
        assert_eq!(refined.mesh.positions.len(), (3 * n + 1) * (2 * n + 1));
    }
    // One of 4 x 4 squares refined once more. The element at (1, 1) of the level-1 mesh has edge nodes (2, 1) and
    // (1, 2); around it one neighbour has both, so template 2, and four have one, so template 1.
    let one = |level: usize, p: Point| {
        level == 0 || level == 1 && (0.5..1.0).contains(&p.x) && (0.5..1.0).contains(&p.y)
    };
    let refined = refine_where(&grid(2, 2), &QuadOptions::default(), one);
    let by_hand = count_by_templates(&refined);
    assert_eq!(refined.mesh.quads.len(), by_hand);
}

/// 16 level-1 quads; each refined or template-2 quad counts 4, each template-1 quad 3.
fn count_by_templates(refined: &RefinedQuads) -> usize {
    let active = [[2.0, 1.0], [1.0, 2.0]].map(|[x, y]| Point::new(x / 2.0, y / 2.0, 0.0));
    let cells = (0..4).flat_map(|y| (0..4).map(move |x| (f64::from(x) / 2.0, f64::from(y) / 2.0)));
    let corners = |(x, y): (f64, f64)| [[x, y], [x + 0.5, y], [x + 0.5, y + 0.5], [x, y + 0.5]];
    assert!(refined.level.iter().all(|&l| l == 1 || l == 2));
    cells
        .map(|cell| {
            let has =
                corners(cell).iter().filter(|[x, y]| active.iter().any(|a| a.x == *x && a.y == *y)).count();
            [1, 3, 4][has]
        })
        .sum()
}

#[test]
fn nothing_asked_for_returns_quads_as_they_are_and_splits_other_polygons() {
    let refined = refine_quads(&cube(), &QuadOptions::default(), &Silent).unwrap();
    assert_eq!((refined.mesh.quads.len(), refined.mesh.positions.len()), (6, 8));
    assert_eq!(refined.level, [0; 6]);
    let refined = refine_quads(&mixed_strip(), &QuadOptions::default(), &Silent).unwrap();
    assert_eq!(refined.mesh.quads.len(), 3 + 4 + 5);
    judge::assert_conforming(&mixed_strip(), &refined);
}

#[test]
fn quads_know_their_parent_and_its_tags() {
    let mut input = grid(3, 3);
    let named = |name: &str| TagSet { groups: vec![name.into()], ..TagSet::default() };
    input.tags =
        Tags { sets: vec![named("odd"), named("even")], of_element: (0..9).map(|f| (f + 1) % 2).collect() };
    let refined = refine_quads(&input, &ball([1.0, 1.0, 0.0], 0.7, 3), &Silent).unwrap();
    for (q, quad) in refined.mesh.quads.iter().enumerate() {
        let center = quad.iter().map(|n| refined.mesh.positions[n.index()]).sum::<Point>() / 4.0;
        let face = center.x.floor() as u32 + 3 * center.y.floor() as u32;
        assert_eq!(refined.parent[q].0, face);
        let name = if face.is_multiple_of(2) { "even" } else { "odd" };
        assert_eq!(refined.tags.of(q).unwrap().groups, [Group::from(name)]);
    }
}

#[test]
fn results_pass_the_projects_own_check() {
    for input in [cube(), grid(4, 3), mixed_strip()] {
        let refined = refine_quads(&input, &ball([1.0, 0.5, 0.2], 0.6, 5), &Silent).unwrap();
        assert_eq!(check_quads(&refined.mesh), []);
        assert_eq!(refined.level.iter().max(), Some(&5));
    }
}

#[test]
fn unused_nodes_are_left_out() {
    let mut input = cube();
    input.positions.insert(0, Point::splat(9.0));
    for n in &mut input.corners {
        n.0 += 1;
    }
    for options in [QuadOptions::default(), ball([0.0; 3], 0.3, 2)] {
        let refined = refine_quads(&input, &options, &Silent).unwrap();
        assert_eq!(check_quads(&refined.mesh), []);
    }
}

#[test]
fn the_cap_on_levels_is_told() {
    let options = QuadOptions { edge_length: Some(0.1), max_levels: 2, ..QuadOptions::default() };
    let refined = refine_quads(&grid(2, 2), &options, &Silent).unwrap();
    assert_eq!((refined.mesh.quads.len(), refined.capped), (64, 64));
}

#[test]
fn refusals_say_what_and_what_to_do() {
    let none = QuadOptions::default();
    assert_eq!(refuse(&surface(&[], &[]), none.clone()).0, "surface-empty");
    let (code, text) = refuse(&surface(&[[0.; 3]; 3], &[&[0, 1, 7]]), none.clone());
    assert_eq!(code, "surface-invalid");
    assert!(text.contains("face 0 names node 7"), "{text}");
    let nan = [[f64::NAN, 0., 0.], [1., 0., 0.], [0., 1., 0.]];
    assert!(refuse(&surface(&nan, &[&[0, 1, 2]]), none.clone()).1.contains("node 0 has a coordinate"));
    assert!(refuse(&surface(&[[0.; 3]; 3], &[&[0, 1, 1]]), none.clone()).1.contains("meets node 1 twice"));

    let keep = QuadOptions { keep_coarse: true, ..QuadOptions::default() };
    assert_eq!(refuse(&mixed_strip(), keep.clone()).0, "keep-coarse-needs-quads");
    let prism: Vec<[f64; 3]> = (0..6).map(|k| [f64::from(k % 3), f64::from(k / 3), 0.0]).collect();
    let odd = surface(&prism, &[&[0, 1, 4, 3], &[1, 2, 5, 4], &[2, 0, 3, 5]]);
    assert_eq!(refuse(&odd, keep).0, "keep-coarse-needs-two-colours");

    let levels = QuadOptions { levels: Some(13), ..QuadOptions::default() };
    assert_eq!(refuse(&cube(), levels).0, "option-out-of-range");
    let limit = QuadOptions { levels: Some(3), max_quads: 100, ..QuadOptions::default() };
    let (code, text) = refuse(&cube(), limit);
    assert_eq!(code, "too-many-quads");
    assert!(text.contains("384") && text.contains("100"), "{text}");
}

#[test]
fn the_limit_holds_for_the_result() {
    let region = ball([0.5, 0.5, 0.0], 0.3, 4);
    let quads = refine_quads(&grid(3, 3), &region, &Silent).unwrap().mesh.quads.len() as u64;
    let limited = |max_quads| QuadOptions { max_quads, ..region.clone() };
    assert!(refine_quads(&grid(3, 3), &limited(quads), &Silent).is_ok());
    let (code, text) = refuse(&grid(3, 3), limited(quads - 1));
    assert_eq!(code, "too-many-quads");
    assert!(text.contains(&format!("about {quads} quads")), "{text}");
}

#[test]
fn size_and_place_of_the_model_do_not_matter_within_the_numbers() {
    let refined = |scale: f64, shift: f64| {
        let mut input = grid(3, 3);
        for p in &mut input.positions {
            *p = *p * scale + Point::splat(shift);
        }
        let shape = Shape::Sphere { center: Point::new(1.0, 1.0, 0.0) * scale + shift, radius: 0.7 * scale };
        let regions = vec![Region { shape, target: Target::Size(0.1 * scale) }];
        refine_quads(&input, &QuadOptions { regions, ..QuadOptions::default() }, &Silent)
    };
    let expected = refined(1.0, 0.0).unwrap().mesh.quads;
    for scale in [2.0_f64.powi(-190), 2.0_f64.powi(-20), 2.0_f64.powi(20), 2.0_f64.powi(190)] {
        assert_eq!(refined(scale, 0.0).unwrap().mesh.quads, expected, "scale {scale}");
    }
    assert_eq!(refined(1.0, 1048576.0).unwrap().mesh.quads, expected);
    assert_eq!(refined(1e-70, 0.0).unwrap_err().code(), "surface-extent");
    assert_eq!(refined(1e200, 0.0).unwrap_err().code(), "surface-extent");
    assert_eq!(refined(1.0, 1e15).unwrap_err().code(), "too-few-digits");
}

/// Stops at the given call of `cancelled`.
pub struct StopAt(std::sync::atomic::AtomicI64);

impl StopAt {
    pub fn call(number: i64) -> Self {
        Self(number.into())
    }
}

impl Monitor for StopAt {
    fn progress(&self, _: Stage, _: f64) {}
    fn cancelled(&self) -> bool {
        self.0.fetch_sub(1, std::sync::atomic::Ordering::Relaxed) <= 0
    }
}

#[test]
fn work_can_be_cancelled_anywhere() {
    let (input, options) = (grid(6, 6), ball([3.0, 3.0, 0.0], 1.0, 3));
    let mut stopped = 0;
    for call in 0.. {
        match refine_quads(&input, &options, &StopAt::call(call)) {
            Err(error) => {
                assert_eq!(error, RefineError::Cancelled(Cancelled));
                stopped += 1;
            }
            Ok(_) => break,
        }
    }
    assert!(stopped > 1000, "asked only {stopped} times");
}

#[test]
fn the_same_bytes_for_any_number_of_threads() {
    let run = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| refine_quads(&grid(9, 7), &ball([4.0, 3.0, 0.0], 2.5, 6), &Silent)).unwrap()
    };
    let one = run(1);
    for threads in [2, 3, 4] {
        assert_eq!(run(threads), one);
    }
}

#[test]
fn targets_that_are_no_lengths_are_refused() {
    let (input, options) = (grid(2, 1), QuadOptions::default());
    for (targets, code, text) in [
        (&[1.0][..], "target-count", "there are 1 targets for 2 candidates"),
        (&[1.0, 1.0, 1.0], "target-count", "3 targets for 2"),
        (&[], "target-count", "0 targets for 2"),
        (&[1.0, f64::NAN], "target-out-of-range", "the target of candidate 1 is NaN; give a length above 0"),
        (&[0.0, 1.0], "target-out-of-range", "the target of candidate 0 is 0"),
        (&[-0.0, -1.0], "target-out-of-range", "the target of candidate 0 is -0"),
        (&[1.0, f64::NEG_INFINITY], "target-out-of-range", "the target of candidate 1 is -inf"),
    ] {
        let mut refinement = QuadRefinement::new(&input, &options, &Silent).unwrap();
        let error = refinement.advance(Some(targets), &Silent).expect_err(text);
        assert_eq!(error.code(), code);
        assert!(error.to_string().contains(text), "{error}");
        // The refinement is as it was.
        assert_eq!(refinement.advance(Some(&[0.5; 2]), &Silent), Ok(true));
        assert_eq!(refinement.advance(Some(&[0.5; 2]), &Silent).unwrap_err().code(), "target-count");
        assert_eq!(refinement.advance(Some(&[f64::INFINITY; 8]), &Silent), Ok(false));
        assert_eq!(refinement.finish(&Silent).unwrap().mesh.quads.len(), 8);
    }
}

#[test]
fn targets_have_the_rounding_of_the_edge_length() {
    // A quarter of this edge comes out longer than a quarter of its length: neither way of asking refines for that.
    let input = surface(&[[0.1, 0., 0.], [0.4, 0., 0.], [0.4, 0.3, 0.], [0.1, 0.3, 0.]], &[&[0, 1, 2, 3]]);
    let target = 0.3 / 4.0;
    let options = QuadOptions { edge_length: Some(target), ..QuadOptions::default() };
    let by_length = refine_quads(&input, &options, &Silent).unwrap();
    let none = QuadOptions::default();
    let mut refinement = QuadRefinement::new(&input, &none, &Silent).unwrap();
    loop {
        let targets = vec![target; refinement.candidates().longest.len()];
        if !refinement.advance(Some(&targets), &Silent).unwrap() {
            break;
        }
    }
    let longest = refinement.candidates().longest.into_iter().fold(0.0, f64::max);
    assert!(longest > target, "the case has no rounding in it");
    let by_target = refinement.finish(&Silent).unwrap();
    assert_eq!((by_target.mesh.quads.len(), by_target), (16, by_length));
}
