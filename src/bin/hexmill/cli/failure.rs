//! Why a command did not do what was asked, in one line, and its exit code.

use std::fmt;
use std::path::Path;
use std::process::ExitCode;

use hexmill::io::{ReadError, WriteError};
use hexmill::refine::RefineError;

/// Why a command did not do what was asked.
#[derive(Debug)]
pub(crate) enum Failure {
    /// The command line makes no sense: exit code 2.
    Usage(String),
    /// A file or mesh was refused: exit code 1.
    Refused {
        /// A stable name of the reason.
        code: &'static str,
        /// Where, what, and what to do.
        message: String,
    },
}

impl Failure {
    /// A refusal with the code `code`.
    pub(crate) fn refused(code: &'static str, message: impl Into<String>) -> Self {
        Self::Refused { code, message: message.into() }
    }

    /// `path` could not be opened, read or written.
    pub(crate) fn file(code: &'static str, action: &str, path: &Path, error: &std::io::Error) -> Self {
        let advice = match error.kind() {
            std::io::ErrorKind::NotFound => "check the path",
            std::io::ErrorKind::PermissionDenied => "check the permissions",
            std::io::ErrorKind::StorageFull => "free some space",
            _ => "check the file and its folder",
        };
        // The system's own words come with "(os error 2)", which helps nobody.
        let reason = error.to_string();
        let reason = reason.split(" (os error").next().unwrap_or_default().to_lowercase();
        Self::refused(code, format!("{}: cannot be {action}: {reason}; {advice}", path.display()))
    }

    /// The contents of `path` were refused.
    pub(crate) fn read(path: &Path, error: &ReadError) -> Self {
        Self::refused(error.code(), format!("{}: {error}", path.display()))
    }

    /// The mesh cannot be written in the format of `path`.
    pub(crate) fn write(path: &Path, error: &WriteError) -> Self {
        Self::refused(error.code(), format!("{}: {error}", path.display()))
    }

    /// The surface in `path` was not refined, or the options make no sense.
    pub(crate) fn refine(path: &Path, error: &RefineError) -> Self {
        match error {
            RefineError::Option { .. } | RefineError::Sizing(_) => Self::Usage(error.to_string()),
            _ => Self::refused(error.code(), format!("{}: {error}", path.display())),
        }
    }

    /// 1 for refusals, 2 for usage.
    pub(crate) fn exit_code(&self) -> ExitCode {
        match self {
            Self::Usage(_) => ExitCode::from(2),
            Self::Refused { .. } => ExitCode::from(1),
        }
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Usage(message) => write!(f, "error: {message}\n\nFor more information, try '--help'."),
            Self::Refused { code, message } => write!(f, "error[{code}]: {message}"),
        }
    }
}
