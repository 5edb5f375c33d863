//! Why a size field cannot be made.

/// Why a size field cannot be made. Messages count regions from 1, as people do; the fields from 0.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SizingError {
    /// The edge length is no positive number.
    #[error("the edge length is {0}; give a positive length in the model's units")]
    EdgeLength(f64),
    /// The curvature is no positive number.
    #[error("the curvature is {0}; give the degrees that one edge may turn, such as 15")]
    Curvature(f64),
    /// The gradation is out of range.
    #[error("the gradation is {0}; give a number above 1 and at most 2")]
    Gradation(f64),
    /// A region makes no sense.
    #[error("region {} ({kind}): {fault}", .index + 1)]
    Region {
        /// Where the region stands among the regions.
        index: usize,
        /// The kind of its shape.
        kind: &'static str,
        /// What is wrong with it.
        fault: RegionFault,
    },
    /// A caller's size function gave too few or too many lengths.
    #[error("the size function gave {given} lengths for {wanted} elements; give one for each")]
    TargetCount {
        /// How many it gave.
        given: usize,
        /// How many elements there are.
        wanted: usize,
    },
    /// A caller's size function gave something that is no length.
    #[error(
        "the size function gave {value} for element {element}; give a positive length, or Infinity where any will do"
    )]
    TargetValue {
        /// Where the element stands among those asked about.
        element: usize,
        /// What it gave.
        value: f64,
    },
}

/// What can be wrong with a region.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum RegionFault {
    /// A number is infinite or not a number.
    #[error("{what} is {value}; give a finite number")]
    NotFinite {
        /// Which number.
        what: &'static str,
        /// What it is.
        value: f64,
    },
    /// A number that has to be positive is not.
    #[error("{what} is {value}; give a positive number")]
    NotPositive {
        /// Which number.
        what: &'static str,
        /// What it is.
        value: f64,
    },
    /// A number that must not be negative is.
    #[error("{what} is {value}; give 0 or more")]
    Negative {
        /// Which number.
        what: &'static str,
        /// What it is.
        value: f64,
    },
    /// A box is turned inside out.
    #[error("min {axis} is {min}, above max {axis}, {max}; swap them")]
    MinAboveMax {
        /// x, y or z.
        axis: char,
        /// Its least value as given.
        min: f64,
        /// Its greatest value as given.
        max: f64,
    },
    /// A rotation is no unit quaternion.
    #[error("the rotation is a quaternion of length {0}; give one of length 1, as x, y, z, w")]
    NotARotation(f64),
    /// A cylinder has no length, and so no direction.
    #[error("from and to are the same point; give the centres of two caps")]
    NoAxis,
    /// There are no points.
    #[error("there are no points; give at least one")]
    NoPoints,
    /// There are no triangles.
    #[error("there are no triangles; give at least one")]
    NoTriangles,
    /// A triangle names a node that does not exist.
    #[error("triangle {triangle} names node {node}, but there are only {nodes} nodes; ids count from 0")]
    NodeOutOfRange {
        /// The triangle, from 0.
        triangle: usize,
        /// What it names.
        node: u32,
        /// How many nodes there are.
        nodes: usize,
    },
}

impl SizingError {
    /// A stable name of the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            Self::EdgeLength(_) => "edge-length-invalid",
            Self::Curvature(_) => "curvature-invalid",
            Self::Gradation(_) => "gradation-out-of-range",
            Self::Region { fault, .. } => fault.code(),
            Self::TargetCount { .. } => "size-function-count",
            Self::TargetValue { .. } => "size-function-value",
        }
    }
}

impl RegionFault {
    /// A stable name of the kind of fault.
    pub fn code(&self) -> &'static str {
        match self {
            Self::NotFinite { .. } => "region-not-finite",
            Self::NotPositive { .. } => "region-not-positive",
            Self::Negative { .. } => "region-negative",
            Self::MinAboveMax { .. } => "region-min-above-max",
            Self::NotARotation(_) => "region-rotation-invalid",
            Self::NoAxis => "region-without-axis",
            Self::NoPoints => "region-without-points",
            Self::NoTriangles => "region-without-triangles",
            Self::NodeOutOfRange { .. } => "region-node-out-of-range",
        }
    }
}
