//! What refinement of hexes is to do, what it returns, and why it refuses.

use serde::{Deserialize, Serialize};

use super::labels::of_groups;
use super::stage::{StageMesh, StageReport};
use crate::Cancelled;
use crate::forest::{Admits, Closure, admits_method_one};
use crate::geometry::Point;
use crate::mesh::check::listed;
use crate::mesh::{HexId, HexMesh, InvertedHexes};
use crate::sizing::{Region, SizingError};

/// How refined hexes and coarse ones are joined.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Method {
    /// Method I: layer templates. No hex is inverted, and the refined set grows to what they allow.
    One,
    /// Method II: a pillow, then one template. The refined set hardly grows; the layer is smoothed.
    Two,
    /// 3-refinement: a pillow, then hexes in 27 and a template that needs no groups. Any set.
    Three,
    /// Method II. The input's own hexes need no families where the interface within them can be grouped two by two. If it
    /// cannot, whole blocks of two by two by two hexes are refined, and hexes away from them stay as they are; only where
    /// that does not help, all hexes are refined once, as with Method II told by name. For a single stage: 3-refinement
    /// of sets whose interface cannot be grouped.
    #[default]
    Auto,
}

impl Method {
    /// Which sets the method's templates fit, if not all.
    pub(super) fn admits(self) -> Option<Admits> {
        (self == Self::One).then_some(admits_method_one)
    }
}

/// Whether the refined set may grow beyond what is asked for, so that a method can join it to the coarse hexes.
///
/// Growth is every hex that is refined although nothing asks for it ([`Added::growth`]), whichever the method: also those of
/// the input that Methods I and II refine once, unless level 1 is asked for everywhere. Only the siblings of refined
/// hexes and grading, levels that differ by one, are no growth: they are what refinement consists of.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase")]
pub enum Growth {
    /// It grows to what the method needs, and [`Added`] tells how far.
    #[default]
    Allow,
    /// Where it would have to grow nothing is done, and the error tells where and how far.
    Refuse,
}

/// What [`refine_hexes`](super::refine_hexes) is to do. Lengths are in model units.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "camelCase", default, deny_unknown_fields)]
pub struct HexOptions {
    /// How refined hexes and coarse ones are joined.
    pub method: Method,
    /// Whether more may be refined than is asked for.
    pub growth: Growth,
    /// Divide elements until none has an edge longer than this. Smoothing moves nodes near transitions afterwards, and
    /// may make an edge there somewhat longer again.
    pub edge_length: Option<f64>,
    /// Refine everything at least this many times.
    pub levels: Option<u8>,
    /// Where to refine further.
    pub regions: Vec<Region>,
    /// How much larger an element may be than its neighbour around a region with a target size,
    /// 1 < gradation <= 2. Strong balance gives 2, there and everywhere else.
    pub gradation: f64,
    /// No element is refined beyond this level, from 0 to [`HexOptions::DEEPEST_LEVEL`].
    pub max_levels: u8,
    /// Refuse a mesh of more hexes than this.
    pub max_hexes: u64,
}

impl HexOptions {
    /// The deepest level that can be asked for.
    pub const DEEPEST_LEVEL: u8 = 20;
    /// The most hexes that can be asked for: ids of nodes, edges and faces have 32 bits.
    pub const MOST_HEXES: u64 = 1 << 28;
}

impl Default for HexOptions {
    fn default() -> Self {
        Self {
            method: Method::default(),
            growth: Growth::default(),
            edge_length: None,
            levels: None,
            regions: Vec::new(),
            gradation: 2.0,
            max_levels: 8,
            max_hexes: 16_000_000,
        }
    }
}

/// Elements that were refined beyond those that the options ask for, and why.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Added {
    /// Hexes of the input that are refined once although nothing asks for it: all of them by Methods I and II, so that
    /// elements are in families of eight; those of blocks, or all, by [`Method::Auto`] where the interface cannot be grouped
    /// two by two.
    pub base: usize,
    /// What the rules of conforming refinement asked for; also after the elements below were added, whose siblings
    /// count among `families`.
    #[serde(flatten)]
    pub closure: Closure,
    /// At places where the interface cannot be separated.
    pub conflicts: usize,
    /// At transition hexes that could not be untangled.
    pub repairs: usize,
}

impl Added {
    /// How many of them are growth: all but the siblings of refined elements, and grading.
    pub fn growth(&self) -> usize {
        self.base + self.closure.method + self.conflicts + self.repairs
    }
}

/// A conforming hex mesh and where its hexes came from.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RefinedHexes {
    /// The mesh. Tags are the input's, by root; groups of faces too, by what each face is part of.
    pub mesh: HexMesh,
    /// The refinement level of each hex; a transition hex has that of the coarse hex it is part of.
    pub level: Vec<u8>,
    /// The input hex that each hex is part of.
    pub root: Vec<u32>,
    /// Elements that were refined beyond those asked for.
    pub added: Added,
    /// What each stage did, coarse to fine.
    pub stages: Vec<StageReport>,
    /// Elements that are larger than asked for, because `max_levels` was reached.
    pub capped: usize,
    /// Hexes of the input that were numbered inside out, and were turned.
    pub turned: usize,
}

impl RefinedHexes {
    /// The result after the last stage.
    pub(super) fn new(input: &HexMesh, mesh: StageMesh) -> Self {
        let StageMesh { positions, hexes, level, root, labels, .. } = mesh;
        let tags = input.tags.inherited(&root);
        let groups = input.groups.on(of_groups(&labels));
        Self { mesh: HexMesh { positions, hexes, tags, groups }, level, root, ..Self::default() }
    }
}

/// Why a hex mesh was not refined.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum HexRefineError {
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
    /// The input has no hexes.
    #[error("the mesh has no hexes; give one with at least one")]
    NoHexes,
    /// The coordinates are too large or too close together for lengths, areas and volumes to be numbers.
    #[error(
        "the mesh measures {size:e} and reaches {reach:e} from the origin; sizes from 1e-60 to 1e60 can be \
         refined: scale the mesh, or move it towards the origin"
    )]
    Extent {
        /// The diagonal of the box around the hexes' nodes.
        size: f64,
        /// The greatest coordinate, without its sign.
        reach: f64,
    },
    /// The coordinates have too few digits for the hexes, or for so many levels.
    #[error(
        "edges of level {level} would be at most {longest:e} long, beyond the digits of coordinates that reach {reach:e}: \
         move the mesh towards the origin, or ask for fewer levels or larger elements"
    )]
    TooFewDigits {
        /// The first level of which that is so; 0 is the input.
        level: u8,
        /// How long its longest edge would be.
        longest: f64,
        /// The greatest coordinate, without its sign.
        reach: f64,
    },
    /// The input does not conform; each kind of defect in words.
    #[error("the mesh cannot be refined: {}", .0.join("; "))]
    InvalidInput(Vec<String>),
    /// Some hexes of the input are inside out in part.
    #[error(transparent)]
    Inverted(#[from] InvertedHexes),
    /// Some hexes of the input are flat, or inside out between their corners.
    #[error(
        "some hexes ({}) are flat or inside out somewhere within: {} (counted from 0, in the file's order); move their nodes, \
         for example by smoothing the mesh",
        .0.len(), listed(.0)
    )]
    NotPositive(Vec<HexId>),
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
    /// A size or a region cannot be met.
    #[error(transparent)]
    Sizing(SizingError),
    /// A caller gave another number of targets than there are candidates.
    #[error("there are {given} targets for {wanted} candidates; give one for each")]
    TargetCount {
        /// How many were given.
        given: usize,
        /// How many candidates there are.
        wanted: usize,
    },
    /// A caller's target is no length above 0.
    #[error(
        "the target of candidate {candidate} is {value}; give a length above 0, or infinity to leave it as it is"
    )]
    Target {
        /// Which candidate, from 0.
        candidate: usize,
        /// Its target.
        value: f64,
    },
    /// More would have to be refined than is asked for, and the options refuse that.
    #[error(
        "elements of level {level} that nothing asks for ({elements}) would be refined {reason}, the first around {}, {}, \
         {}; allow that growth, ask for it (level 1 everywhere, or a larger region there), or use another method", .near.x, .near.y, .near.z
    )]
    GrowthRefused {
        /// How many.
        elements: usize,
        /// The level of the first.
        level: u8,
        /// What for.
        reason: &'static str,
        /// The first one's centre.
        near: Point,
    },
    /// The mesh would have more hexes than allowed.
    #[error(
        "level {level} would bring the mesh to {hexes} hexes or more, over the limit of {limit}; ask for a larger edge \
         length, fewer levels or smaller regions, or raise the limit"
    )]
    TooManyHexes {
        /// The level that would do so.
        level: u8,
        /// How many hexes it would come to, at least.
        hexes: u64,
        /// The limit.
        limit: u64,
    },
    /// There is no template for so many hexes, though the octree was closed for the method: an error of this library.
    #[error("the method has no template for some hexes ({0}); use another method, and report the mesh")]
    NoTemplate(usize),
    /// Transition hexes stay inside out, and there is nothing left to refine beside them.
    #[error(
        "some transition hexes ({0}) cannot be untangled; the mesh's own hexes there are too distorted to be divided"
    )]
    Tangled(usize),
}

impl HexRefineError {
    /// A stable name of the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Cancelled(_) => "cancelled",
            Self::NoHexes => "mesh-empty",
            Self::Extent { .. } => "mesh-extent",
            Self::TooFewDigits { .. } => "too-few-digits",
            Self::InvalidInput(_) => "mesh-invalid",
            Self::Inverted(_) => "mesh-inverted",
            Self::Sizing(error) => error.code(),
            Self::Option { .. } => "option-out-of-range",
            Self::TargetCount { .. } => "target-count",
            Self::Target { .. } => "target-out-of-range",
            Self::GrowthRefused { .. } => "growth-refused",
            Self::TooManyHexes { .. } => "too-many-hexes",
            Self::NotPositive(_) => "mesh-not-positive",
            Self::NoTemplate(_) => "no-template",
            Self::Tangled(_) => "mesh-tangled",
        }
    }
}

impl From<SizingError> for HexRefineError {
    fn from(error: SizingError) -> Self {
        match error {
            SizingError::Cancelled(cancelled) => Self::Cancelled(cancelled),
            error => Self::Sizing(error),
        }
    }
}

/// Refuses options out of range.
pub(super) fn validate(options: &HexOptions) -> Result<(), HexRefineError> {
    let out_of_range = |option, value: String, wanted| Err(HexRefineError::Option { option, value, wanted });
    if options.max_levels > HexOptions::DEEPEST_LEVEL {
        return out_of_range("maxLevels", options.max_levels.to_string(), "give at most 20");
    }
    if let Some(levels) = options.levels.filter(|&l| l > options.max_levels) {
        return out_of_range("levels", levels.to_string(), "give at most maxLevels, or raise that");
    }
    if options.max_hexes > HexOptions::MOST_HEXES {
        return out_of_range("maxHexes", options.max_hexes.to_string(), "give at most 2^28");
    }
    Ok(())
}

/// Refuses a mesh of more hexes than the options allow.
pub(super) fn check_size(options: &HexOptions, level: u8, hexes: u64) -> Result<(), HexRefineError> {
    let limit = options.max_hexes;
    if hexes > limit { Err(HexRefineError::TooManyHexes { level, hexes, limit }) } else { Ok(()) }
}
