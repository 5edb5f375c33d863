//! Conforming refinement of quad meshes (Ebeida, Patney, Owens, Mestreau: section 2).
//!
//! [`refine_quads`] turns any polygon surface into a conforming all-quad mesh that is as fine as asked for.
//!
//! ```
//! use hexmill::geometry::Point;
//! use hexmill::mesh::{NodeId, PolygonMesh};
//! use hexmill::refine::{QuadOptions, refine_quads};
//! use hexmill::Silent;
//!
//! let mut square = PolygonMesh::default();
//! square.positions = vec![Point::ZERO, Point::X, Point::X + Point::Y, Point::Y];
//! square.push_face([0, 1, 2, 3].map(NodeId));
//! let options = QuadOptions { levels: Some(2), ..QuadOptions::default() };
//! let refined = refine_quads(&square, &options, &Silent)?;
//! assert_eq!(refined.mesh.quads.len(), 16);
//! # Ok::<(), hexmill::refine::RefineError>(())
//! ```

mod conform;
mod demand;
mod estimate;
pub mod hex;
mod options;
mod quad;
mod targets;

pub use estimate::{Estimate, estimate_quads, idle_regions};
pub use options::{QuadOptions, RefineError, RefinedQuads};
pub use quad::{Candidates, QuadRefinement, refine_quads};
