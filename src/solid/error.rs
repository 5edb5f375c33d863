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
    /// Edges of one triangle alone.
    #[error(
        "the surface is open: {edges} edges belong to one face only, the first at {at} of face {face}; close the holes"
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
        "{edges} edges belong to more than two faces, the first at {at} of the faces {}; \
         separate the parts that touch there, or unite them", listed(.faces)
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
        "the surface crosses or touches itself in {pairs} pairs of triangles, the first at {at} of the faces {} and {}; \
         unite the parts, or move them apart", .faces[0], .faces[1]
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

impl SolidError {
    /// A stable name of the kind of error.
    pub fn code(&self) -> &'static str {
        match self {
            Self::Option { .. } => "option-out-of-range",
            Self::Empty => "surface-empty",
            Self::Broken(_) => "surface-invalid",
            Self::Open { .. } => "surface-open",
            Self::NonManifold { .. } => "surface-non-manifold",
            Self::SelfIntersection { .. } => "surface-self-intersecting",
            Self::OneSided { .. } => "surface-one-sided",
            Self::NoVolume { .. } => "surface-without-volume",
            Self::Cancelled(_) => "cancelled",
        }
    }
}
