//! **hexmill**: conforming quadrilateral meshes of any surface, and conforming refinement of hex meshes.
//!
//! The crate is one core for three front ends: a page in the browser, an npm package and a command
//! line. It does no I/O, reads no clock and logs nothing; progress and cancellation come in through
//! one parameter, [`Monitor`].
//!
//! # Reading order
//!
//! Modules may use what stands above them, never what stands below (`tests/layers.rs` holds them to it).
//!
//! | module | what it holds |
//! |---|---|
//! | [`parallel`] | loops over many threads with the same results for any number |
//! | [`geometry`] | points, boxes, distances; knows no mesh |
//! | [`mesh`] | ids, reference elements, meshes, topology, checks, quality |
//! | [`template`] | refinement templates as data |
//! | [`sizing`] | where to refine and how far |
//! | [`graph`] | minimum cuts; knows no mesh |
//! | [`solid`] | the CAD model: corners, curves, surfaces, inside and outside |
//! | [`forest`] | quadtrees and octrees over unstructured coarse cells, strong balance, closure |
//! | [`optimize`] | untangling and smoothing of hexes |
//! | [`refine`] | conforming refinement (Ebeida, Patney, Owens, Mestreau) |
//! | [`hexing`] | all-hex meshes of solids |
//! | [`io`] | bytes in, bytes out: OBJ, STL, VTU, VTK, MSH, INP, MEDIT, GLB |
//! | [`scene`] | meshes as f32 draw buffers; no GPU |

pub mod geometry;
pub mod mesh;
mod monitor;
pub mod parallel;

pub mod graph;
pub mod sizing;
pub mod solid;
pub mod template;

pub mod forest;

pub mod optimize;

pub mod refine;

pub mod hexing;

pub mod io;
pub mod scene;

#[cfg(feature = "viewer")]
pub mod render;
#[cfg(any(feature = "bindings", feature = "viewer"))]
mod web;

pub use monitor::{Cancelled, Monitor, Silent, Stage};
