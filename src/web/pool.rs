//! rayon's threads on web workers (feature `threads`), or all work on the calling thread.
//!
//! Order of events:
//! 1. the worker that meshes calls [`prepare_pool`], which leaves one start-up ticket a thread;
//! 2. every other worker that shares this module's memory calls [`run_pool_thread`], which takes a ticket and does
//!    not return;
//! 3. [`on_pool`] puts the calling worker to sleep until the pool's threads have done the work.
//!
//! Only a worker may sleep, never a page's main thread.

/// Runs `work` on the pool's threads, or on this one where there is no pool.
#[cfg(feature = "threads")]
pub use shared::on_pool;

/// Runs `work` on this thread.
#[cfg(not(feature = "threads"))]
pub fn on_pool<R>(work: impl FnOnce() -> R) -> R {
    work()
}

#[cfg(feature = "threads")]
mod shared {
    use std::sync::{Mutex, OnceLock, PoisonError};

    use rayon::{ThreadBuilder, ThreadPool, ThreadPoolBuilder};
    use wasm_bindgen::prelude::wasm_bindgen;

    use crate::web::errors::Failure;

    static TICKETS: Mutex<Vec<ThreadBuilder>> = Mutex::new(Vec::new());
    static POOL: OnceLock<ThreadPool> = OnceLock::new();

    /// Makes a pool whose `threads` threads are workers that have yet to call [`run_pool_thread`].
    ///
    /// # Errors
    /// If there is a pool already.
    #[wasm_bindgen(js_name = preparePool)]
    pub fn prepare_pool(threads: usize) -> Result<(), Failure> {
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .spawn_handler(|thread| {
                TICKETS.lock().unwrap_or_else(PoisonError::into_inner).push(thread);
                Ok(())
            })
            .build()
            .map_err(|error| Failure::internal("pool-failed", &error))?;
        POOL.set(pool).map_err(|_| Failure::internal("pool-failed", &"the pool was made before"))
    }

    /// Makes the calling worker one of the pool's threads. Returns at once if none is missing, else never.
    #[wasm_bindgen(js_name = runPoolThread)]
    pub fn run_pool_thread() {
        let ticket = TICKETS.lock().unwrap_or_else(PoisonError::into_inner).pop();
        if let Some(thread) = ticket {
            thread.run();
        }
    }

    /// Runs `work` on the pool's threads while this one sleeps, or on this one where there is no pool.
    pub fn on_pool<R: Send>(work: impl FnOnce() -> R + Send) -> R {
        match POOL.get() {
            Some(pool) => pool.install(work),
            None => work(),
        }
    }
}
