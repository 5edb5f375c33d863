//! Work can be stopped wherever it asks.

use std::sync::atomic::{AtomicUsize, Ordering};

use hexmill::hexing::{Background, HexingError, HexingOptions, hex_solid};
use hexmill::{Monitor, Stage};

use super::csg::random_part;
use super::motions::step;

/// Stops the work when it asks for the n-th time.
struct StopsAt {
    asked: AtomicUsize,
    stop: usize,
}

impl Monitor for StopsAt {
    fn progress(&self, _: Stage, _: f64) {}

    fn cancelled(&self) -> bool {
        self.asked.fetch_add(1, Ordering::Relaxed) >= self.stop
    }
}

#[test]
fn work_that_is_stopped_anywhere_ends_as_cancelled() {
    for (part, background) in [
        (random_part(2), Background::Auto),
        (random_part(2), Background::Octree),
        (step(), Background::Swept),
    ] {
        let bounds = part.bounds();
        let edge_length = (bounds.max - bounds.min).max_element() / 6.0;
        let options = HexingOptions { edge_length, background, max_levels: 1, ..HexingOptions::default() };
        let mut stop = 0;
        loop {
            let monitor = StopsAt { asked: AtomicUsize::new(0), stop };
            match hex_solid(&part, &options, &monitor) {
                Err(HexingError::Cancelled(_)) => stop = 2 * stop + 1,
                made => {
                    assert!(made.is_ok(), "{made:?}");
                    assert!(stop > 50, "it asks but {stop} times");
                    break;
                }
            }
        }
    }
}
