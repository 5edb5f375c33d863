//! The solid to mesh: a closed surface of triangles with its features: corners, curves and surfaces.
//!
//! [`SolidModel::new`] makes one from the polygons of a file and says in a [`SolidReport`] what it found and mended; what
//! it cannot mend is a [`SolidError`] with its place. A model answers where the nearest point of its boundary, of one of
//! its surfaces or curves is, and how far inside or outside a point lies.
//!
//! ```
//! use hexmill::Silent;
//! use hexmill::solid::{SolidModel, SolidOptions, SurfaceClass};
//! let cube = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
//!     f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
//! let surface = hexmill::io::obj::read(cube)?.into_surface().unwrap();
//! let (solid, _) = SolidModel::new(&surface, &SolidOptions::default(), &Silent)?;
//! assert_eq!((solid.corners().len(), solid.curves().len(), solid.surfaces().len()), (8, 12, 6));
//! assert!(matches!(solid.surfaces()[0].class, SurfaceClass::Planar { .. }));
//! assert_eq!(solid.signed_distance(hexmill::geometry::Point::new(0.5, 0.5, 0.25)), -0.25);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod class;
mod curves;
mod entities;
mod error;
mod features;
mod import;
mod model;
mod options;
mod search;
mod shell;
mod surfaces;

pub use entities::{Arm, Corner, CornerId, Curve, CurveId, Surface, SurfaceClass, SurfaceId};
pub use error::SolidError;
pub use model::SolidModel;
pub use options::{FilledHole, SolidOptions, SolidReport};
pub use search::{CurveFoot, Foot};

#[cfg(test)]
pub(crate) mod testing;
#[cfg(test)]
mod tests;
