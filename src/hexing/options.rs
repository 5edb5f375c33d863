//! What the meshing of a solid is to do, and why it refuses.

use serde::{Deserialize, Serialize};

use super::background::BackgroundError;
use crate::Cancelled;
use crate::solid::SolidError;

/// What [`hex_solid`](super::hex_solid) is to do. Lengths are in model units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct HexingOptions {
    /// How long edges of cells are to be; 0, the default, is refused.
    pub edge_length: f64,
    /// Triangles that meet at more than this are parts of different surfaces, in degrees.
    pub feature_angle: f64,
    /// Refuse a background mesh of more hexes than this.
    pub max_hexes: u64,
}

impl HexingOptions {
    /// The most hexes that can be asked for: ids of nodes, edges and faces have 32 bits.
    pub const MOST_HEXES: u64 = 1 << 28;
}

impl Default for HexingOptions {
    fn default() -> Self {
        Self { edge_length: 0.0, feature_angle: 35.0, max_hexes: 4_000_000 }
    }
}

/// Why a solid was not meshed.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum HexingError {
    /// The surface bounds no solid.
    #[error(transparent)]
    Solid(SolidError),
    /// There is no background mesh.
    #[error(transparent)]
    Background(BackgroundError),
    /// An option has a value that cannot be met.
    #[error("{option} is {value}; {wanted}")]
    Option {
        /// The option's name.
        option: &'static str,
        /// The value given.
        value: f64,
        /// What it may be.
        wanted: &'static str,
    },
    /// No cell stands for the solid.
    #[error("an edge length of {edge_length} is too large: no cell lies within the solid; lower it")]
    NothingLeft {
        /// The edge length.
        edge_length: f64,
    },
    /// Some hexes could not be made positive.
    #[error("{0} hexes cannot be made positive; give another edge length, and report the solid")]
    Tangled(usize),
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl HexingError {
    /// A stable name of the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Solid(_) => "solid-refused",
            Self::Background(error) => error.code(),
            Self::Option { .. } => "option-out-of-range",
            Self::NothingLeft { .. } => "edge-length-too-large",
            Self::Tangled(_) => "mesh-tangled",
            Self::Cancelled(_) => "cancelled",
        }
    }
}

impl From<SolidError> for HexingError {
    fn from(error: SolidError) -> Self {
        match error {
            SolidError::Cancelled(cancelled) => Self::Cancelled(cancelled),
            error => Self::Solid(error),
        }
    }
}

impl From<BackgroundError> for HexingError {
    fn from(error: BackgroundError) -> Self {
        match error {
            BackgroundError::Cancelled(cancelled) => Self::Cancelled(cancelled),
            error => Self::Background(error),
        }
    }
}

/// Refuses options out of range.
pub(super) fn validate(options: &HexingOptions) -> Result<(), HexingError> {
    let out_of_range = |option, value, wanted| Err(HexingError::Option { option, value, wanted });
    if !(options.edge_length.is_finite() && options.edge_length > 0.0) {
        return out_of_range("edgeLength", options.edge_length, "give a length above 0");
    }
    if options.max_hexes > HexingOptions::MOST_HEXES {
        return out_of_range("maxHexes", options.max_hexes as f64, "give at most 2^28");
    }
    Ok(())
}
