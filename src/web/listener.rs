//! Progress and panics on their way to JavaScript, and cancellation on its way back.
//!
//! Without shared memory progress is told by a call into JavaScript, and nothing can reach a running computation:
//! it is stopped by discarding the worker. With shared memory the threads write to a block of it, `CONTROL`,
//! that the main thread reads at leisure, and in which it raises the flag to stop.

use std::panic;

use wasm_bindgen::prelude::wasm_bindgen;

#[cfg(not(feature = "threads"))]
use crate::{Monitor, Stage};

#[wasm_bindgen]
extern "C" {
    /// Receives the message of a panic just before this instance dies of it.
    #[wasm_bindgen(js_namespace = hexmillWorker, js_name = panicked)]
    fn on_panic(message: &str);

    #[cfg(not(feature = "threads"))]
    #[wasm_bindgen(js_namespace = hexmillWorker, js_name = progressed)]
    fn on_progress(stage: &str, fraction: f64);
}

/// Sends messages of panics to JavaScript. Called once by every worker before anything else.
#[wasm_bindgen(js_name = reportPanics)]
pub fn report_panics() {
    panic::set_hook(Box::new(|info| on_panic(&info.to_string())));
}

/// The monitor of every computation that JavaScript starts.
pub struct Listener;

#[cfg(not(feature = "threads"))]
impl Monitor for Listener {
    fn progress(&self, stage: Stage, fraction: f64) {
        on_progress(stage.0, fraction);
    }

    fn cancelled(&self) -> bool {
        false
    }
}

#[cfg(feature = "threads")]
mod shared {
    use std::sync::atomic::{AtomicU32, AtomicU64, Ordering::Relaxed};

    use wasm_bindgen::prelude::wasm_bindgen;

    use super::Listener;
    use crate::{Monitor, Stage};

    /// The steps into which a stage's progress is divided.
    const STEPS: f64 = 65535.0;

    /// What the main thread reads and writes while this module computes. JavaScript knows this layout.
    #[repr(C)]
    struct Control {
        /// From the low bits up: address of the stage's name (32), its length (16), steps done of 65535 (16). One
        /// word, so that a reader never sees one stage's name with another's progress.
        progress: AtomicU64,
        /// Not zero: stop.
        cancelled: AtomicU32,
    }

    /// The one control block: JavaScript starts one computation at a time.
    static CONTROL: Control = Control { progress: AtomicU64::new(0), cancelled: AtomicU32::new(0) };

    /// Where the control block stands in memory, in bytes.
    #[wasm_bindgen(js_name = controlAddress)]
    pub fn control_address() -> usize {
        &raw const CONTROL as usize
    }

    impl Monitor for Listener {
        fn progress(&self, stage: Stage, fraction: f64) {
            let name = stage.0.as_ptr() as usize as u64 & 0xffff_ffff;
            let length = stage.0.len() as u64 & 0xffff;
            let steps = (fraction.clamp(0.0, 1.0) * STEPS) as u64;
            CONTROL.progress.store(name | length << 32 | steps << 48, Relaxed);
        }

        fn cancelled(&self) -> bool {
            CONTROL.cancelled.load(Relaxed) != 0
        }
    }
}
