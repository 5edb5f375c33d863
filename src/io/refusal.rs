//! Refusals that several formats share: their stable codes, and short ways to make the errors.

use std::fmt::Display;

use super::{Format, ReadError, WriteError};

/// Stable codes. A caller may match on them; the words of a message may change.
pub(super) mod code {
    /// The bytes do not begin as the format does.
    pub const NOT_THIS_FORMAT: &str = "not-this-format";
    /// The file ends, or its data end, before what it announced.
    pub const TRUNCATED: &str = "truncated";
    /// A word where a number was expected, or a number that does not fit.
    pub const BAD_NUMBER: &str = "bad-number";
    /// A coordinate is NaN or infinite.
    pub const NOT_FINITE: &str = "coordinate-not-finite";
    /// The file breaks its format's grammar.
    pub const SYNTAX: &str = "syntax";
    /// Two statements of the file contradict each other.
    pub const INCONSISTENT: &str = "inconsistent";
    /// A cell names a node that does not exist.
    pub const NODE_OUT_OF_RANGE: &str = "node-out-of-range";
    /// Two nodes, or two elements, have one number.
    pub const DUPLICATE_NUMBER: &str = "duplicate-number";
    /// A cell has too few nodes for its kind, or too many.
    pub const CELL_SIZE: &str = "cell-size";
    /// A kind of cell that is neither polygon of first order nor hexahedron.
    pub const UNSUPPORTED_CELL: &str = "unsupported-cell";
    /// A version of the format that is not read.
    pub const UNSUPPORTED_VERSION: &str = "unsupported-version";
    /// An encoding or a compression that is not read.
    pub const UNSUPPORTED_ENCODING: &str = "unsupported-encoding";
    /// A part of the format that is not read and cannot be skipped without changing the mesh.
    pub const UNSUPPORTED_FEATURE: &str = "unsupported-feature";
    /// The file holds neither faces nor hexahedra.
    pub const NO_CELLS: &str = "no-cells";
    /// The mesh has cells that the format cannot say.
    pub const FORMAT_HOLDS_NO_POLYGONS: &str = "format-holds-no-polygons";
    /// The format holds no hexes of the second order.
    pub const FORMAT_HOLDS_NO_SECOND_ORDER: &str = "format-holds-no-second-order";
    /// More nodes, cells or bytes than the format can number.
    pub const TOO_LARGE: &str = "too-large";
}

/// An error of reading.
pub(super) fn refuse(
    format: Format,
    line: impl Into<Option<u64>>,
    code: &'static str,
    message: impl Into<String>,
) -> ReadError {
    ReadError { format, line: line.into(), code, message: message.into() }
}

/// Refuses a node with a coordinate that is NaN or infinite. `number` is the node's own in the file.
pub(super) fn refuse_not_finite(
    format: Format,
    line: impl Into<Option<u64>>,
    number: impl Display,
) -> ReadError {
    let message = format!("node {number} has a coordinate that is NaN or infinite — correct it");
    refuse(format, line, code::NOT_FINITE, message)
}

/// An error of writing.
pub(super) fn refuse_writing(format: Format, code: &'static str, message: impl Into<String>) -> WriteError {
    WriteError { format, code, message: message.into() }
}

/// What stands in the file, short enough and clean enough for a message.
pub(super) fn excerpt(bytes: &[u8]) -> String {
    const LONGEST: usize = 40;
    let shown: String = String::from_utf8_lossy(&bytes[..bytes.len().min(LONGEST)])
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    if bytes.len() > LONGEST { format!("'{shown}...'") } else { format!("'{shown}'") }
}
