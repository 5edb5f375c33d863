//! The progress of a part of a stage.

use crate::{Monitor, Stage};

/// What the stages of a part report is progress between the ends of its range in the stage of the whole.
pub(in super::super) struct Part<'a> {
    pub(in super::super) whole: &'a dyn Monitor,
    pub(in super::super) stage: Stage,
    pub(in super::super) range: [f64; 2],
}

impl Monitor for Part<'_> {
    fn progress(&self, _: Stage, fraction: f64) {
        let [from, to] = self.range;
        self.whole.progress(self.stage, from + fraction * (to - from));
    }

    fn cancelled(&self) -> bool {
        self.whole.cancelled()
    }
}
