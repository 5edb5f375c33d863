//! What holds for every run.

use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};

use hexmill::{Cancelled, Monitor, Stage};

use super::pillow::pillowed;
use super::*;

#[test]
fn the_worst_never_falls() {
    for seed in 0..12 {
        let (input, hexes) = grid(6);
        let mut noise = Noise(seed);
        let amount = 0.05 + 0.03 * seed as f64;
        let inside = |p: &Point| p.min_element() > 0.0 && p.max_element() < 6.0;
        let mut positions: Vec<Point> =
            input.iter().map(|p| if inside(p) { *p + amount * noise.point() } else { *p }).collect();
        let before = measured(&positions, &hexes);
        let report = optimized(&input, &mut positions, &hexes, &vec![true; input.len()]);
        let after = measured(&positions, &hexes);
        let least = |q: &HexQuality| q.scaled_jacobian.iter().copied().fold(f32::INFINITY, f32::min);
        assert!(least(&after) >= least(&before), "seed {seed}");
        // Cells that are good enough are left alone; worse ones become better.
        let target = OptimizeOptions::default().target;
        let [worst, now] = [report.worst_before, report.worst_after].map(|w| w.expect("cells"));
        assert!(if worst < target { now > worst } else { now == worst }, "seed {seed}: {report:?}");
    }
}

#[test]
fn a_perfect_grid_stays_as_it_is() {
    let (input, hexes) = grid(5);
    let mut positions = input.clone();
    let report = optimized(&input, &mut positions, &hexes, &vec![true; input.len()]);
    assert_eq!(positions, input);
    assert_eq!((report.moved, report.worst_before, report.worst_after), (0, Some(1.0), Some(1.0)));
}

#[test]
fn nothing_to_move_is_no_work() {
    let (mut positions, hexes) = grid(2);
    let report = optimized(&positions.clone(), &mut positions, &hexes, &[false; 27]);
    assert_eq!((report.cells, report.worst_before, report.sweeps), (0, None, 0));
    let none = optimize(&mut [], &[], &[], &Constraints::none(0), &OptimizeOptions::default(), &Silent);
    assert_eq!(none.unwrap().cells, 0);
}

#[test]
fn points_that_are_no_numbers_are_left_and_listed() {
    let (input, hexes) = grid(3);
    let mut positions = input.clone();
    positions[21] = Point::NAN;
    positions[22] = Point::splat(f64::MAX);
    let movable = vec![true; input.len()];
    let report = optimized(&input, &mut positions, &hexes, &movable);
    assert!(!report.inverted.is_empty());
}

#[test]
fn the_same_bytes_for_any_number_of_threads() {
    let world = || pillowed(8, |c| c.iter().all(|x| (1..3).contains(x)));
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| {
            let mut world = world();
            let input = world.positions.clone();
            let report = optimized(&input, &mut world.positions, &world.hexes, &world.movable);
            (report, world.positions)
        })
    };
    let one = with(1);
    assert_eq!(one, with(2));
    assert_eq!(one, with(4));
}

/// Cancels at the `n`th question, and holds progress to its promise.
struct Impatient {
    questions: AtomicUsize,
    patience: usize,
    last: Mutex<Option<(Stage, f64)>>,
}

impl Impatient {
    fn new(patience: usize) -> Self {
        Self { questions: AtomicUsize::new(0), patience, last: Mutex::new(None) }
    }
}

impl Monitor for Impatient {
    fn progress(&self, stage: Stage, fraction: f64) {
        let mut last = self.last.lock().unwrap();
        assert!((0.0..=1.0).contains(&fraction));
        assert!(
            last.is_none_or(|(before, least)| before != stage || least <= fraction),
            "{stage:?} {fraction}"
        );
        *last = Some((stage, fraction));
    }

    fn cancelled(&self) -> bool {
        self.questions.fetch_add(1, Ordering::Relaxed) >= self.patience
    }
}

#[test]
fn cancelled_work_stops_and_leaves_the_nodes() {
    let (input, hexes) = grid(6);
    let mut noise = Noise(8);
    let start: Vec<Point> = input.iter().map(|p| *p + 0.6 * noise.point()).collect();
    let constraints = Constraints::none(start.len());
    let movable = vec![true; start.len()];
    // Of two threads each may ask before either has heard the answer.
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
    let run = |patience| {
        let mut positions = start.clone();
        let monitor = Impatient::new(patience);
        let options = OptimizeOptions::default();
        let done = one_thread
            .install(|| optimize(&mut positions, &hexes, &movable, &constraints, &options, &monitor));
        (done, positions, monitor.questions.into_inner())
    };
    let (done, _, questions) = run(usize::MAX);
    done.expect("patient");
    for patience in [0, 1, questions / 3, questions - 1] {
        let (done, positions, asked) = run(patience);
        assert_eq!(done, Err(Cancelled));
        assert_eq!((positions == start, asked), (true, patience + 1));
    }
}
