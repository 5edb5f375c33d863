//! How many threads the library's work runs on.

use super::failure::Failure;

/// Makes the library's work run on `threads` threads.
pub(super) fn use_threads(threads: Option<u16>) -> Result<(), Failure> {
    let Some(threads) = threads else { return Ok(()) };
    rayon::ThreadPoolBuilder::new().num_threads(usize::from(threads)).build_global().map_err(|error| {
        Failure::refused(
            "threads-not-started",
            format!("{threads} threads cannot be started: {error}; give fewer"),
        )
    })
}
