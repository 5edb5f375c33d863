//! The clock and the progress bar: what the library's monitor tells, by stage.

use std::sync::{Mutex, MutexGuard};
use std::time::{Duration, Instant};

use hexmill::{Monitor, Stage};
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use serde::Serialize;

use super::allocator::give_back_what_is_free;

/// Steps of a full bar.
const STEPS: u64 = 1000;

/// What is free is given back where a stage begins, and at such shares of it.
const TIDY: f64 = 0.25;

/// Takes the time of each stage, and shows a bar on stderr if that is a terminal.
pub(crate) struct Progress {
    bar: ProgressBar,
    start: Instant,
    stages: Mutex<Stages>,
}

struct Stages {
    /// The stages so far in order of first appearance, with the time spent in each.
    done: Vec<(&'static str, Duration)>,
    current: Option<(&'static str, Instant)>,
    /// How far the current one was when memory was given back last.
    tidied: f64,
}

/// Seconds spent in a stage.
#[derive(Debug, Serialize)]
pub(crate) struct StageSeconds {
    /// The stage's name.
    pub(crate) stage: &'static str,
    /// Its duration.
    pub(crate) seconds: f64,
}

impl Progress {
    /// Starts the clock; a quiet one shows no bar.
    pub(crate) fn new(quiet: bool) -> Self {
        let target =
            if quiet { ProgressDrawTarget::hidden() } else { ProgressDrawTarget::stderr_with_hz(10) };
        let style = ProgressStyle::with_template("{prefix:>9} [{bar:40}] {percent:>3}% {elapsed}")
            .expect("the template is valid")
            .progress_chars("=> ");
        let bar = ProgressBar::with_draw_target(Some(STEPS), target).with_style(style);
        Self {
            bar,
            start: Instant::now(),
            stages: Mutex::new(Stages { done: Vec::new(), current: None, tidied: 0.0 }),
        }
    }

    fn stages(&self) -> MutexGuard<'_, Stages> {
        self.stages.lock().unwrap_or_else(|poisoned| poisoned.into_inner())
    }

    /// Runs `work` as the stage `name`.
    pub(crate) fn stage<T>(&self, name: &'static str, work: impl FnOnce() -> T) -> T {
        self.enter(name, 0.0);
        let result = work();
        self.enter(name, 1.0);
        result
    }

    fn enter(&self, name: &'static str, fraction: f64) {
        let mut stages = self.stages();
        if stages.current.is_none_or(|(current, _)| current != name) {
            stages.close();
            stages.current = Some((name, Instant::now()));
            self.bar.set_prefix(name);
            stages.tidied = f64::INFINITY;
        }
        if (fraction - stages.tidied).abs() >= TIDY {
            stages.tidied = fraction;
            give_back_what_is_free();
        }
        drop(stages);
        self.bar.set_position((fraction.clamp(0.0, 1.0) * STEPS as f64) as u64);
    }

    /// Removes the bar and returns the seconds of each stage, and of everything.
    pub(crate) fn finish(&self) -> (Vec<StageSeconds>, f64) {
        self.bar.finish_and_clear();
        let mut stages = self.stages();
        stages.close();
        let seconds = |&(stage, time): &(_, Duration)| StageSeconds { stage, seconds: time.as_secs_f64() };
        (stages.done.iter().map(seconds).collect(), self.start.elapsed().as_secs_f64())
    }
}

impl Stages {
    /// Ends the current stage.
    fn close(&mut self) {
        let Some((name, start)) = self.current.take() else { return };
        match self.done.iter_mut().find(|(stage, _)| *stage == name) {
            Some((_, time)) => *time += start.elapsed(),
            None => self.done.push((name, start.elapsed())),
        }
    }
}

impl Monitor for Progress {
    fn progress(&self, stage: Stage, fraction: f64) {
        self.enter(stage.0, fraction);
    }

    /// Never: Ctrl-C ends the program at once.
    fn cancelled(&self) -> bool {
        false
    }
}

impl Drop for Progress {
    /// An error's message is not to stand behind a bar.
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}
