//! Errors of readers and writers.

use super::Format;

/// Why bytes could not be read as a mesh.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{}{message}", .line.map(|l| format!("line {l}: ")).unwrap_or_default())]
pub struct ReadError {
    /// The format that was expected.
    pub format: Format,
    /// Where, from 1, in a text format.
    pub line: Option<u64>,
    /// A stable name of what is wrong, such as `obj-index-out-of-range`.
    pub code: &'static str,
    /// What is wrong and what to do.
    pub message: String,
}

impl ReadError {
    /// A stable name of what is wrong, such as `obj-index-out-of-range`.
    pub fn code(&self) -> &'static str {
        self.code
    }
}

/// Why a mesh could not be written.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{format}: {message}")]
pub struct WriteError {
    /// The format that was wanted.
    pub format: Format,
    /// A stable name of what is wrong, such as `format-holds-no-hexes`.
    pub code: &'static str,
    /// What is wrong and what to do.
    pub message: String,
}

impl WriteError {
    /// A stable name of what is wrong, such as `format-holds-no-hexes`.
    pub fn code(&self) -> &'static str {
        self.code
    }
}
