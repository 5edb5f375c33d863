//! Errors on their way to JavaScript.

use std::fmt::Display;

use serde::Serialize;
use wasm_bindgen::JsValue;

use crate::Cancelled;
use crate::hexing::HexingError;
use crate::hexing::background::BackgroundError;
use crate::io::{ReadError, WriteError};
use crate::mesh::GridError;
use crate::refine::RefineError;
use crate::refine::hex::HexRefineError;
use crate::solid::SolidError;

/// Which class of error JavaScript is to throw.
#[derive(Clone, Copy, Debug, Serialize)]
#[serde(rename_all = "camelCase")]
enum Kind {
    /// A file or array is not what it should be.
    Input,
    /// An option is out of range or unknown.
    Options,
    /// The work would be larger than allowed.
    Limit,
    /// The caller stopped the work.
    Cancelled,
    /// A bug of this project.
    Internal,
}

/// An error as JavaScript receives it: an object with these fields.
#[derive(Clone, Debug, Serialize)]
pub struct Failure {
    kind: Kind,
    code: &'static str,
    message: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    line: Option<u64>,
}

impl Failure {
    fn new(kind: Kind, code: &'static str, message: &impl Display) -> Self {
        Self { kind, code, message: message.to_string(), line: None }
    }

    /// The caller gave a file or arrays that cannot be used.
    pub fn input(code: &'static str, message: &impl Display) -> Self {
        Self::new(Kind::Input, code, message)
    }

    /// The caller gave an option that cannot be met.
    pub fn options(code: &'static str, message: &impl Display) -> Self {
        Self::new(Kind::Options, code, message)
    }

    /// The work would be larger than allowed.
    pub fn limit(code: &'static str, message: &impl Display) -> Self {
        Self::new(Kind::Limit, code, message)
    }

    /// Something happened that should be impossible.
    pub fn internal(code: &'static str, message: &impl Display) -> Self {
        Self::new(Kind::Internal, code, message)
    }
}

impl From<Failure> for JsValue {
    fn from(failure: Failure) -> Self {
        serde_wasm_bindgen::to_value(&failure).unwrap_or_else(|error| error.into())
    }
}

impl From<ReadError> for Failure {
    fn from(error: ReadError) -> Self {
        Self { line: error.line, ..Self::input(error.code, &error) }
    }
}

impl From<WriteError> for Failure {
    fn from(error: WriteError) -> Self {
        Self::options(error.code, &error)
    }
}

impl From<Cancelled> for Failure {
    fn from(cancelled: Cancelled) -> Self {
        Self::new(Kind::Cancelled, "cancelled", &cancelled)
    }
}

impl From<RefineError> for Failure {
    fn from(error: RefineError) -> Self {
        let kind = match error {
            RefineError::Cancelled(_) => Kind::Cancelled,
            RefineError::NoFaces | RefineError::InvalidInput(_) | RefineError::Extent { .. } => Kind::Input,
            RefineError::Base(_)
            | RefineError::Option { .. }
            | RefineError::Sizing(_)
            | RefineError::TargetCount { .. }
            | RefineError::Target { .. } => Kind::Options,
            RefineError::TooManyQuads { .. } | RefineError::TooFewDigits { .. } => Kind::Limit,
        };
        Self::new(kind, error.code(), &error)
    }
}

impl From<HexRefineError> for Failure {
    fn from(error: HexRefineError) -> Self {
        let kind = match error {
            HexRefineError::Cancelled(_) => Kind::Cancelled,
            HexRefineError::NoHexes
            | HexRefineError::InvalidInput(_)
            | HexRefineError::Extent { .. }
            | HexRefineError::Inverted(_)
            | HexRefineError::NotPositive(_)
            | HexRefineError::Tangled(_) => Kind::Input,
            HexRefineError::Option { .. }
            | HexRefineError::Sizing(_)
            | HexRefineError::TargetCount { .. }
            | HexRefineError::Target { .. }
            | HexRefineError::GrowthRefused { .. } => Kind::Options,
            HexRefineError::TooManyHexes { .. } | HexRefineError::TooFewDigits { .. } => Kind::Limit,
            HexRefineError::NoTemplate(_) => Kind::Internal,
        };
        Self::new(kind, error.code(), &error)
    }
}

impl From<GridError> for Failure {
    fn from(error: GridError) -> Self {
        let kind = match error {
            GridError::Spacing(_) | GridError::Margin(_) => Kind::Options,
            GridError::Empty => Kind::Input,
            GridError::TooManyHexes { .. } | GridError::TooFewDigits { .. } => Kind::Limit,
        };
        Self::new(kind, error.code(), &error)
    }
}

impl From<HexingError> for Failure {
    fn from(error: HexingError) -> Self {
        let kind = match error {
            HexingError::Background(BackgroundError::Refine(error)) => return error.into(),
            HexingError::Cancelled(_)
            | HexingError::Solid(SolidError::Cancelled(_))
            | HexingError::Background(BackgroundError::Cancelled(_)) => Kind::Cancelled,
            HexingError::Option { .. }
            | HexingError::NothingLeft { .. }
            | HexingError::Solid(SolidError::Option { .. })
            | HexingError::Background(
                BackgroundError::EdgeLength(_)
                | BackgroundError::NoDirection
                | BackgroundError::NoShell
                | BackgroundError::Face(_),
            ) => Kind::Options,
            HexingError::Solid(_) | HexingError::Tangled(_) => Kind::Input,
            HexingError::Background(
                BackgroundError::TooManyHexes { .. } | BackgroundError::TooFewDigits { .. },
            ) => Kind::Limit,
        };
        Self::new(kind, error.code(), &error)
    }
}

/// Options that serde could not read: unknown names, wrong types.
impl From<serde_wasm_bindgen::Error> for Failure {
    fn from(error: serde_wasm_bindgen::Error) -> Self {
        Self::options("options-invalid", &error)
    }
}
