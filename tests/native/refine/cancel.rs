//! How often long work asks whether to stop: often enough for any size, because each question is followed by a bounded
//! number of elements.

use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

use hexmill::forest::QuadForest;
use hexmill::geometry::Point;
use hexmill::mesh::{Edges, PolygonMesh};
use hexmill::refine::{QuadOptions, QuadRefinement, RefineError};
use hexmill::{Cancelled, Monitor, Stage};

use super::results::StopAt;
use super::worlds::mapped_grid;

/// Between two questions there are no more elements than this, in each loop over them.
const BATCH: usize = 1 << 17;

/// Counts the questions.
#[derive(Default)]
struct Counter(AtomicUsize);

impl Monitor for Counter {
    fn progress(&self, _: Stage, _: f64) {}
    fn cancelled(&self) -> bool {
        self.0.fetch_add(1, Relaxed);
        false
    }
}

/// How often `work` asks.
fn questions<T>(work: impl FnOnce(&dyn Monitor) -> T) -> (T, usize) {
    let counter = Counter::default();
    let done = work(&counter);
    (done, counter.0.into_inner())
}

/// A bent sheet of 360 000 quads.
fn sheet() -> PolygonMesh {
    mapped_grid(600, 600, |x, y| Point::new(x, y, (0.1 * x).sin() + (0.1 * y).cos()))
}

#[test]
fn work_asks_for_every_batch_of_elements() {
    let input = sheet();
    let (faces, corners) = (input.face_count() / BATCH, input.corners.len() / BATCH);
    let (edges, asked) = questions(|monitor| Edges::monitored(&input, monitor).unwrap());
    assert!(asked >= faces && edges == Edges::of_polygons(&input), "edges ask {asked} times");
    let edges = edges.len() / BATCH;

    let (forest, asked) = questions(|monitor| QuadForest::refined_once(&input, monitor).unwrap());
    assert!(asked >= 3 * faces + corners + 2 * edges, "the base asks {asked} times");
    drop(forest);

    let options = QuadOptions { curvature: Some(90.0), levels: Some(1), ..QuadOptions::default() };
    let (refinement, asked) = questions(|monitor| QuadRefinement::new(&input, &options, monitor).unwrap());
    assert!(asked >= 5 * faces + edges, "curvature and sizes ask {asked} times");
    let mut refinement = refinement;
    while refinement.advance(None, &Counter::default()).unwrap() {}
    // A target here and there, so that there are edges to complete and templates to place.
    let mut targets = vec![f64::INFINITY; refinement.candidates().centers.len()];
    targets.iter_mut().step_by(40).for_each(|target| *target = f64::MIN_POSITIVE);
    let (deeper, asked) = questions(|monitor| refinement.advance(Some(&targets), monitor));
    assert_eq!(deeper, Ok(true));
    assert!(asked >= targets.len() / BATCH, "a level asks {asked} times");
    let (refined, asked) = questions(|monitor| refinement.finish(monitor).unwrap());
    assert!(
        asked >= 2 * targets.len() / BATCH,
        "the templates for {} ask {asked} times",
        refined.mesh.quads.len()
    );
}

#[test]
fn the_base_and_the_sizes_can_be_cancelled_anywhere() {
    let input = sheet();
    let options = QuadOptions { curvature: Some(90.0), keep_coarse: true, ..QuadOptions::default() };
    for call in [0, 1, 3, 6, 12, 18] {
        let stopped = QuadRefinement::new(&input, &options, &StopAt::call(call)).err();
        assert_eq!(stopped, Some(RefineError::Cancelled(Cancelled)), "call {call}");
        assert_eq!(
            QuadForest::refined_once(&input, &StopAt::call(call)).err(),
            Some(Cancelled),
            "call {call}"
        );
    }
}
