//! What the meshing of a solid is to do, and why it refuses.

use serde::{Deserialize, Serialize};

use super::background::{Background, BackgroundError};
use crate::Cancelled;
use crate::mesh::SecondOrderHex;
use crate::sizing::Region;
use crate::solid::{SolidError, SolidOptions};

/// What [`hex_solid`](super::hex_solid) is to do. Lengths are in model units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct HexingOptions {
    /// How long edges of cells are to be; 0, the default, is refused.
    pub edge_length: f64,
    /// Where cells are to be smaller; levels count from cells of the edge length, an octree's from twice that.
    pub regions: Vec<Region>,
    /// What the core is cut out of.
    pub background: Background,
    /// Degrees that the boundary may turn along an edge, 15 to 20 usually: by default cells are made no smaller for that.
    pub curvature: Option<f64>,
    /// Triangles that meet at more than this are parts of different surfaces, in degrees.
    pub feature_angle: f64,
    /// How far mesh and solid may be from each other: by default as far as the edge length makes them. Where it takes that cells
    /// are smaller, there or everywhere, as many levels as they may be.
    pub max_distance: Option<f64>,
    /// How many levels finer cells may become, so that nothing is missed and as `curvature` wants it.
    pub max_levels: u8,
    /// Refuse a background mesh of more hexes than this.
    pub max_hexes: u64,
    /// Hexes of the second order, if wanted: those that the mesh has with more nodes.
    pub second_order: Option<SecondOrderHex>,
}

impl HexingOptions {
    /// The most hexes that can be asked for: ids of nodes, edges and faces have 32 bits.
    pub const MOST_HEXES: u64 = 1 << 28;
    /// The most levels that can be asked for.
    pub const MOST_LEVELS: u8 = 4;

    /// How the solid is found in its surface; without an edge length features are kept that would else be noise.
    pub fn solid(&self) -> SolidOptions {
        SolidOptions {
            feature_angle: self.feature_angle,
            edge_length: (self.edge_length != 0.0).then_some(self.edge_length),
            ..SolidOptions::default()
        }
    }
}

impl Default for HexingOptions {
    fn default() -> Self {
        Self {
            edge_length: 0.0,
            regions: Vec::new(),
            background: Background::Auto,
            curvature: None,
            feature_angle: 35.0,
            max_distance: None,
            max_levels: 2,
            max_hexes: 4_000_000,
            second_order: None,
        }
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
    #[error("some hexes ({0}) cannot be made positive; give another edge length, and report the solid")]
    Tangled(usize),
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl HexingError {
    /// A stable name of the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Solid(error) => error.code(),
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
    for (option, value) in [("curvature", options.curvature), ("maxDistance", options.max_distance)] {
        if let Some(value) = value.filter(|value| !(value.is_finite() && *value > 0.0)) {
            return out_of_range(option, value, "give a number above 0");
        }
    }
    if options.max_levels > HexingOptions::MOST_LEVELS {
        return out_of_range("maxLevels", options.max_levels.into(), "give at most 4");
    }
    if options.max_hexes > HexingOptions::MOST_HEXES {
        return out_of_range("maxHexes", options.max_hexes as f64, "give at most 2^28");
    }
    Ok(())
}
