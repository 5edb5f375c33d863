//! How long work goes without asking whether to stop, and without telling how far it is.

use std::sync::{Mutex, OnceLock};
use std::time::{Duration, Instant};

use hexmill::{Monitor, Stage};

/// How long nothing was heard.
#[derive(Clone, Copy)]
pub struct Silence {
    /// By the clock, in seconds.
    wall: f64,
    /// What this process had of the processors meanwhile, in seconds: what is left of `wall` where the machine does nothing
    /// else.
    worked: f64,
    /// The stage that was told last.
    after: &'static str,
}

impl std::fmt::Display for Silence {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let [wall, worked] = [self.wall, self.worked].map(|seconds| 1e3 * seconds);
        write!(f, "at most {wall:.0} ms of silence, {worked:.0} ms of work, after {}", self.after)
    }
}

impl Silence {
    const NONE: Self = Self { wall: 0.0, worked: 0.0, after: "nothing" };

    /// What the work itself took of it.
    fn own(&self) -> f64 {
        self.worked.min(self.wall)
    }
}

/// When something was heard last, and the longest silence before.
#[derive(Clone, Copy)]
struct Heard {
    last: Instant,
    worked: Duration,
    longest: Silence,
}

impl Heard {
    fn now(&mut self, after: &'static str) {
        let (now, worked) = (Instant::now(), worked());
        let [wall, own] = [now - self.last, worked - self.worked].map(|time| time.as_secs_f64());
        let silence = Silence { wall, worked: own, after };
        if silence.own() > self.longest.own() {
            self.longest = silence;
        }
        (self.last, self.worked) = (now, worked);
    }
}

/// Hears the work, and never stops it.
pub struct Listening(Mutex<Listened>);

struct Listened {
    stage: &'static str,
    asked: Heard,
    told: Heard,
}

impl Listening {
    pub fn new() -> Self {
        let heard = Heard { last: Instant::now(), worked: worked(), longest: Silence::NONE };
        Self(Mutex::new(Listened { stage: Silence::NONE.after, asked: heard, told: heard }))
    }

    /// The longest silence between two questions whether to stop, and between two tellings of how far the work is.
    pub fn longest(self) -> [Silence; 2] {
        let mut heard = self.0.into_inner().expect("no panic");
        let stage = heard.stage;
        [&mut heard.asked, &mut heard.told].map(|heard| {
            heard.now(stage);
            heard.longest
        })
    }
}

impl Monitor for Listening {
    fn progress(&self, stage: Stage, _: f64) {
        let mut heard = self.0.lock().expect("no panic");
        let before = std::mem::replace(&mut heard.stage, stage.0);
        heard.told.now(before);
    }

    fn cancelled(&self) -> bool {
        let mut heard = self.0.lock().expect("no panic");
        let stage = heard.stage;
        heard.asked.now(stage);
        false
    }
}

/// How long processors have worked on this process, to a hundredth of a second; the time of day where the system does not
/// tell.
fn worked() -> Duration {
    let told = std::fs::read_to_string("/proc/self/stat").ok().and_then(|line| {
        // The name in brackets may hold anything; the times are the 12th and the 13th word behind it.
        let words = line.rsplit(')').next()?.split_whitespace().skip(11).take(2);
        words.map(|ticks| ticks.parse::<u64>().ok()).sum::<Option<u64>>()
    });
    let since_start = || START.get_or_init(Instant::now).elapsed();
    told.map_or_else(since_start, |ticks| Duration::from_millis(10 * ticks))
}

static START: OnceLock<Instant> = OnceLock::new();
