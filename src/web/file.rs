//! Files that JavaScript gave.

use super::errors::Failure;
use super::pool::on_pool;
use crate::io::{self, Document, Format};

/// What a file of the named format holds; without a name the content tells the format.
///
/// # Errors
/// What the format's reader refuses, and unknown formats.
pub(super) fn read(bytes: &[u8], format: Option<String>) -> Result<Document, Failure> {
    let format = format.map_or_else(|| Ok(io::detect(bytes)?), |name| format_named(&name))?;
    Ok(on_pool(|| io::read(bytes, format))?)
}

/// The format of a name that JavaScript gave.
pub(super) fn format_named(name: &str) -> Result<Format, Failure> {
    Format::from_extension(name).ok_or_else(|| {
        let known: Vec<_> = Format::ALL.iter().map(|f| f.name()).collect();
        let message = format!("there is no format {name:?}; the formats are {}", known.join(", "));
        Failure::options("format-unknown", &message)
    })
}
