//! Why a surface bounds no solid.

use crate::Cancelled;
use crate::geometry::Point;
use crate::mesh::FaceId;
use crate::mesh::check::listed;

/// Why a surface bounds no solid. Each message says where and what to do; face ids are those of the surface given.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SolidError {
    /// An option is out of range.
    #[error("{option} is {value}; give {wanted}")]
    Option {
        /// The option.
        option: &'static str,
        /// Its value.
        value: f64,
        /// What it may be.
        wanted: &'static str,
    },
    /// There are no faces.
    #[error("the surface has no faces; give a closed surface of triangles or polygons")]
    Empty,
    /// The faces do not add up or have coordinates that are no numbers.
    #[error("{0}; correct the file")]
    Broken(crate::mesh::Defect),
    /// The coordinates are too large or too close together for lengths, areas and volumes to be numbers, or have too few digits.
    #[error(
        "the surface measures {size:e} and reaches {reach:e} from the origin: coordinates tell no sizes but from 1e-60 to \
         1e60, and have 16 digits; scale the surface, or move it towards the origin"
    )]
    Extent {
        /// The diagonal of the box around the nodes.
        size: f64,
        /// The greatest coordinate, without its sign.
        reach: f64,
    },
    /// Edges of one triangle alone.
    #[error(
        "the surface is open: {} to one face only, the first at {at} of face {face}; close the holes", belong(*.edges)
    )]
    Open {
        /// How many edges.
        edges: usize,
        /// The middle of the first.
        at: Point,
        /// The face there.
        face: FaceId,
    },
    /// Edges at which three or more triangles meet.
    #[error(
        "{} to more than two faces, the first at {at} of the faces {}; \
         separate the parts that touch there, or unite them", belong(*.edges), listed(.faces)
    )]
    NonManifold {
        /// How many edges.
        edges: usize,
        /// The middle of the first.
        at: Point,
        /// The faces there.
        faces: Vec<FaceId>,
    },
    /// Parts of the surface go through one another, or lie on one another.
    #[error(
        "the surface crosses or touches itself in {}, the first at {at} of {}", counted(*.pairs), who_crosses(*.faces)
    )]
    SelfIntersection {
        /// How many pairs of triangles.
        pairs: usize,
        /// A place of the first.
        at: Point,
        /// The faces there.
        faces: [FaceId; 2],
    },
    /// The surface has one side only.
    #[error(
        "the surface at {at} (face {face}) has no inside: it is one-sided, like a Moebius strip; model it again"
    )]
    OneSided {
        /// A point of it.
        at: Point,
        /// The face there.
        face: FaceId,
    },
    /// A closed part of the surface holds no volume.
    #[error(
        "the part of the surface at {at} (face {face}) encloses no volume; remove it or give it a thickness"
    )]
    NoVolume {
        /// A point of it.
        at: Point,
        /// The face there.
        face: FaceId,
    },
    /// The monitor asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

fn belong(edges: usize) -> String {
    if edges == 1 { "1 edge belongs".into() } else { format!("{edges} edges belong") }
}

fn counted(pairs: usize) -> String {
    if pairs == 1 { "1 pair of triangles".into() } else { format!("{pairs} pairs of triangles") }
}

/// The faces, and what to do.
fn who_crosses([one, other]: [FaceId; 2]) -> String {
    if one == other {
        format!("face {one} itself; divide it into simple polygons")
    } else {
        format!("the faces {one} and {other}; unite the parts, or move them apart")
    }
}

impl SolidError {
    /// A stable name of the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Option { .. } => "option-out-of-range",
            Self::Empty => "surface-empty",
            Self::Broken(_) => "surface-invalid",
            Self::Extent { .. } => "surface-extent",
            Self::Open { .. } => "surface-open",
            Self::NonManifold { .. } => "surface-non-manifold",
            Self::SelfIntersection { .. } => "surface-self-intersecting",
            Self::OneSided { .. } => "surface-one-sided",
            Self::NoVolume { .. } => "surface-without-volume",
            Self::Cancelled(_) => "cancelled",
        }
    }
}
