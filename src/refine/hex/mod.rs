//! Conforming refinement of hex meshes (Ebeida, Patney, Owens, Mestreau: section 3).
//!
//! A mesh is refined in stages, coarse to fine. A [`stage`] divides a set of hexes of one level and puts
//! transition hexes between them and the rest, so that the mesh conforms before and after it:
//!
//! 1. Find the interface between refined hexes and coarse ones (`interface`).
//! 2. Make a layer of transition hexes at it: by a pillow (Method II and 3-refinement: `pinch`, `regions`, `shift`,
//!    `folds`, `pillow`), or by cutting coarse hexes (Method I: `layers`).
//! 3. Give each transition hex its template (`couple`, `quarters`).
//! 4. Divide refined hexes and transition hexes, and weld what they share (`skeleton`, `divide`, `transition`).
//!
//! Between the stages the caller refines what a [`StageError::Conflict`] names, and may smooth the layer
//! ([`StageResult::layer_nodes`]).
//!
//! **Promises.** The mesh conforms: hexes share whole faces, by node ids. Boundary nodes stay on the boundary's faces
//! and ridges where these are planar and straight, and so do nodes between materials (`materials`). Method I inverts no
//! hex of a mesh of convex hexes with planar faces; Method II and 3-refinement may leave inverted hexes where the
//! interface turns sharply, which smoothing of the layer removes.
//!
//! ```
//! use hexmill::Silent;
//! use hexmill::geometry::Point;
//! use hexmill::mesh::NodeId;
//! use hexmill::refine::hex::{Method, StageMesh, stage};
//!
//! // One cube, divided three times: into 8, then 64, then one corner's family of the 64 again.
//! let corners = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]];
//! let corners = corners.map(|[x, y, z]| Point::new(f64::from(x), f64::from(y), f64::from(z)));
//! let mut mesh = StageMesh::of_input(corners.to_vec(), vec![[0, 1, 2, 3, 4, 5, 6, 7].map(NodeId)]);
//! for _ in 0..2 {
//!     let all = vec![true; mesh.hexes.len()];
//!     mesh = stage(&mesh, &all, Method::Two, &Silent)?.mesh;
//! }
//! let family: Vec<bool> = mesh.element.iter().map(|&element| element < 8).collect();
//! let refined = stage(&mesh, &family, Method::Two, &Silent)?;
//! assert_eq!(refined.mesh.hexes.len(), 64 + 7 * 8 + 7 * 12);
//! # Ok::<(), hexmill::refine::hex::StageError>(())
//! ```

mod attempt;
mod blocks;
mod bounds;
mod couple;
mod divide;
mod folds;
mod forecast;
mod grouping;
mod heritage;
mod input;
mod interface;
mod labels;
mod layers;
mod local;
mod materials;
mod open;
mod options;
mod outline;
mod part;
mod pillow;
mod pinch;
mod pipeline;
mod plan;
mod poor;
mod quarters;
mod refinement;
mod regions;
mod ridges;
mod sheets;
mod shift;
mod skeleton;
mod stage;
#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests;
mod thirds;
mod transition;
mod trees;

pub use forecast::{HexForecast, StageForecast};
pub use options::{Added, Growth, HexOptions, HexRefineError, Method, RefinedHexes};
pub use pipeline::refine_hexes;
pub(crate) use plan::HexBlocks;
pub use plan::HexPlan;
pub use refinement::HexRefinement;
pub use stage::{NO_ELEMENT, NO_OCTANT, StageError, StageMesh, StageReport, StageResult, stage};
