//! What people are told: results on standard output, all else on standard error.

use std::io::{self, ErrorKind, Write};
use std::path::Path;

use super::failure::Failure;

/// Prints a result. A reader that has gone away, such as `head`, wants no more of it, which is no failure.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    let mut output = io::stdout().lock();
    match output.write_all(text.as_bytes()).and_then(|()| output.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::file("output-not-written", "written", Path::new("standard output"), &error))
        }
        _ => Ok(()),
    }
}

/// Tells something beside the result. If that cannot be, there is nobody to be told so.
pub(super) fn tell(text: &str) {
    let _ = io::stderr().lock().write_all(text.as_bytes());
}
