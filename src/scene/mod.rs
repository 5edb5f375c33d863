//! Meshes as draw buffers, camera, picking, regions and their handles. No GPU: all of it is tested
//! natively; `render` only uploads and draws what is made here.
//!
//! # Spaces
//!
//! *World* is the model's own space, f64. *Scene* is world moved to the middle of the mesh and scaled
//! to about unit size, f32: far-from-origin and tiny or huge models keep all of f32's digits, see
//! [`Frame`]. *Pixels* are CSS pixels, x to the right and y down from the canvas's upper left corner.
//! Transforms are named `to_from`: `clip_from_scene` takes scene points to clip space.

mod bvh;
mod camera;
mod colour;
mod cutaway;
mod features;
mod frame;
mod framing;
mod handle;
mod hexes;
mod overlay;
mod region;
mod section;
mod state;
mod surface;
mod theme;

pub use bvh::{Bvh, Hit};
pub use camera::{Axis, Camera, Projection, Ray, Up, Viewport};
pub use colour::{ColourMap, NO_VALUE, Palette, colour_index};
pub use cutaway::Cutaway;
pub use features::{FeatureKind, FeatureLine};
pub use frame::Frame;
pub use handle::{Drag, Grip, Handle};
pub use hexes::{Cut, Hexes, Shown};
pub use overlay::{Disc, FrontBuffers, RegionBuffers, Segment, SolidVertex};
pub use region::{Placement, Solid, SurfacePoint};
pub use section::Section;
pub use state::{Scene, Style};
pub use surface::{Surface, SurfaceError, TriangleBuffers};
pub use theme::{Background, Rgba, Theme};

pub use crate::geometry::triangulate;
