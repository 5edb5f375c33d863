//! The one parameter through which long work tells how far it is and learns that it is to stop.

use std::ops::Range;

/// A stage of long work, in the order in which stages run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Stage(pub &'static str);

/// Receives progress and says when to stop. Implemented by the front ends; the core only calls it.
pub trait Monitor: Sync {
    /// `fraction` of `stage` is done, from 0 to 1, never falling within a stage.
    fn progress(&self, stage: Stage, fraction: f64);

    /// True once the caller wants the work to stop. Asked between the steps of the work, and several times a second
    /// within the steps that grow with the result.
    fn cancelled(&self) -> bool;

    /// Stops the caller with `?` if the work was cancelled.
    fn proceed(&self) -> Result<(), Cancelled> {
        if self.cancelled() { Err(Cancelled) } else { Ok(()) }
    }

    /// Reports progress, and stops the caller with `?` if the work was cancelled.
    fn checkpoint(&self, stage: Stage, fraction: f64) -> Result<(), Cancelled> {
        self.proceed()?;
        self.progress(stage, fraction);
        Ok(())
    }
}

/// A part of a stage: what is told of any stage of the part is progress between the ends of its range in the stage of the
/// whole.
pub(crate) struct Part<'a> {
    pub(crate) whole: &'a dyn Monitor,
    pub(crate) stage: Stage,
    pub(crate) range: [f64; 2],
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

/// Elements between two questions to the monitor: a few milliseconds of work.
const BATCH: usize = 1 << 17;

/// The numbers below `count` in ranges that are soon worked off; the monitor is asked before each.
pub(crate) fn batches(
    count: usize,
    monitor: &dyn Monitor,
) -> impl Iterator<Item = Result<Range<usize>, Cancelled>> + '_ {
    let ranges = (0..count).step_by(BATCH).map(move |first| first..(first + BATCH).min(count));
    ranges.map(|range| monitor.proceed().map(|()| range))
}

/// A monitor that listens to nothing and never stops the work.
pub struct Silent;

impl Monitor for Silent {
    fn progress(&self, _: Stage, _: f64) {}
    fn cancelled(&self) -> bool {
        false
    }
}

/// The work was stopped by its [`Monitor`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;
