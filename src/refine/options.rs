//! What refinement of quads is to do, what it returns, and why it refuses.

use serde::{Deserialize, Serialize};

use crate::forest::BaseError;
use crate::geometry::Extent;
use crate::mesh::check::{check_faces, summary};
use crate::mesh::{FaceId, PolygonMesh, QuadMesh, Tags};
use crate::sizing::{Region, SizingError};
use crate::{Cancelled, Monitor};

/// What [`refine_quads`](super::refine_quads) is to do. Lengths are in model units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct QuadOptions {
    /// No edge longer than this, anywhere.
    pub edge_length: Option<f64>,
    /// Refine everything at least this many times.
    pub levels: Option<u8>,
    /// Where to refine further.
    pub regions: Vec<Region>,
    /// Turn of the surface's normal that one edge may span, in degrees.
    pub curvature: Option<f64>,
    /// How much larger an element may be than its neighbour around a region with a target size,
    /// 1 < gradation <= 2. Strong balance gives 2, there and everywhere else.
    pub gradation: f64,
    /// Leave untouched quads at level 0 (beyond the paper; all-quad, two-colourable input only).
    pub keep_coarse: bool,
    /// No element is refined beyond this level, from 0 to [`QuadOptions::DEEPEST_LEVEL`].
    pub max_levels: u8,
    /// Refuse a mesh of more quads than this.
    pub max_quads: u64,
}

impl QuadOptions {
    /// The deepest level that can be asked for: beyond it midpoints of the input's edges run out of digits.
    pub const DEEPEST_LEVEL: u8 = 30;
    /// The most quads that can be asked for: ids of nodes and edges have 32 bits.
    pub const MOST_QUADS: u64 = 1 << 30;
}

impl Default for QuadOptions {
    fn default() -> Self {
        Self {
            edge_length: None,
            levels: None,
            regions: Vec::new(),
            curvature: None,
            gradation: 2.0,
            keep_coarse: false,
            max_levels: 12,
            max_quads: 64_000_000,
        }
    }
}

/// A conforming quad mesh and where its quads came from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RefinedQuads {
    /// The mesh.
    pub mesh: QuadMesh,
    /// The refinement level of each quad (a transition quad has its element's level).
    pub level: Vec<u8>,
    /// The input face that each quad is part of.
    pub parent: Vec<FaceId>,
    /// The parents' tags.
    pub tags: Tags,
    /// Elements that are larger than asked for, because `max_levels` was reached.
    pub capped: usize,
}

/// Why a mesh was not refined.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RefineError {
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The input has no faces.
    #[error("the surface has no faces; give one with at least one polygon")]
    NoFaces,
    /// The input is no polygon mesh; each kind of defect in words.
    #[error("the surface cannot be refined: {}", .0.join("; "))]
    InvalidInput(Vec<String>),
    /// The coarse quads cannot be kept.
    #[error(transparent)]
    Base(BaseError),
    /// An option has a value that cannot be met.
    #[error("{option} is {value}; {wanted}")]
    Option {
        /// The option's name.
        option: &'static str,
        /// The value given.
        value: String,
        /// What it may be.
        wanted: &'static str,
    },
    /// A size, a region or the curvature cannot be met.
    #[error(transparent)]
    Sizing(SizingError),
    /// There is not one target for each candidate.
    #[error("there are {given} targets for {wanted} candidates; give one for each")]
    TargetCount {
        /// How many were given.
        given: usize,
        /// How many candidates there are.
        wanted: usize,
    },
    /// A target is no length.
    #[error(
        "the target of candidate {candidate} is {value}; give a length above 0, or infinity to leave it as it is"
    )]
    Target {
        /// Which candidate, from 0.
        candidate: usize,
        /// Its target.
        value: f64,
    },
    /// The coordinates are too large or too close together for lengths, areas and volumes to be numbers.
    #[error(
        "the surface measures {size:e} and reaches {reach:e} from the origin; sizes from 1e-60 to 1e60 can be \
         refined: scale the surface, or move it towards the origin"
    )]
    Extent {
        /// The diagonal of the box around the nodes.
        size: f64,
        /// The greatest coordinate, without its sign.
        reach: f64,
    },
    /// The coordinates have too few digits for so many levels.
    #[error(
        "{level} levels would divide edges {longest:e} long beyond the digits of coordinates that reach \
         {reach:e}: ask for fewer levels or larger elements, or move the surface towards the origin"
    )]
    TooFewDigits {
        /// The level asked for.
        level: u8,
        /// The longest edge of the input.
        longest: f64,
        /// The greatest coordinate, without its sign.
        reach: f64,
    },
    /// The mesh would have more quads than allowed.
    #[error(
        "level {level} would bring the mesh to about {quads} quads, more than the limit of {limit}; \
         raise the edge length or the limit"
    )]
    TooManyQuads {
        /// The level that would do so.
        level: u8,
        /// How many quads it would come to, about.
        quads: u64,
        /// The limit.
        limit: u64,
    },
}

impl RefineError {
    /// A stable name of the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Cancelled(_) => "cancelled",
            Self::NoFaces => "surface-empty",
            Self::InvalidInput(_) => "surface-invalid",
            Self::Base(BaseError::NotAQuad { .. }) => "keep-coarse-needs-quads",
            Self::Base(BaseError::OddCycle(_)) => "keep-coarse-needs-two-colours",
            Self::Base(BaseError::Cancelled(_)) => "cancelled",
            Self::Sizing(error) => error.code(),
            Self::TargetCount { .. } => "target-count",
            Self::Target { .. } => "target-out-of-range",
            Self::Option { .. } => "option-out-of-range",
            Self::Extent { .. } => "surface-extent",
            Self::TooFewDigits { .. } => "too-few-digits",
            Self::TooManyQuads { .. } => "too-many-quads",
        }
    }
}

impl From<BaseError> for RefineError {
    fn from(error: BaseError) -> Self {
        match error {
            BaseError::Cancelled(cancelled) => Self::Cancelled(cancelled),
            error => Self::Base(error),
        }
    }
}

impl From<SizingError> for RefineError {
    fn from(error: SizingError) -> Self {
        match error {
            SizingError::Cancelled(cancelled) => Self::Cancelled(cancelled),
            error => Self::Sizing(error),
        }
    }
}

/// Refuses options out of range and surfaces with invalid faces.
pub(super) fn validate(
    input: &PolygonMesh,
    options: &QuadOptions,
    monitor: &dyn Monitor,
) -> Result<(), RefineError> {
    if input.face_count() == 0 {
        return Err(RefineError::NoFaces);
    }
    let defects = check_faces(input, monitor)?;
    if !defects.is_empty() {
        return Err(RefineError::InvalidInput(summary(&defects).iter().map(ToString::to_string).collect()));
    }
    let extent = Extent::of(&input.positions);
    if !extent.is_in_range() {
        return Err(RefineError::Extent { size: extent.size, reach: extent.reach });
    }
    let out_of_range = |option, value: String, wanted| Err(RefineError::Option { option, value, wanted });
    if options.max_levels > QuadOptions::DEEPEST_LEVEL {
        return out_of_range("maxLevels", options.max_levels.to_string(), "give at most 30");
    }
    if let Some(levels) = options.levels.filter(|&l| l > options.max_levels) {
        return out_of_range("levels", levels.to_string(), "give at most maxLevels, or raise that");
    }
    if options.max_quads > QuadOptions::MOST_QUADS {
        return out_of_range("maxQuads", options.max_quads.to_string(), "give at most 2^30");
    }
    Ok(())
}

/// Refuses levels that would divide the longest edges until their nodes fall together.
pub(super) fn validate_digits(input: &PolygonMesh, longest: f64, level: u8) -> Result<(), RefineError> {
    let extent = Extent::of(&input.positions);
    if level > 0 && !extent.has_digits_for(longest * 0.5_f64.powi(level.into())) {
        return Err(RefineError::TooFewDigits { level, longest, reach: extent.reach });
    }
    Ok(())
}
