//! All-hex meshes of CAD solids (the second paper: "Non-Regular Background Mesh based Hex Meshing").
//!
//! A background mesh is made around a [`solid`](crate::solid), its core is cut out of it, corners, curves and surfaces
//! of the solid are found on the core's boundary, sheets are inserted where cells would be bad, and the nodes are
//! moved to the solid without a cell ever being inverted.

mod across;
pub mod background;
pub mod core;
pub mod correspondence;
mod crossings;
pub mod direction;
mod extent;
pub mod face;
pub mod fit;
pub mod sheets;

mod asked;
mod attempt;
mod body;
mod forecast;
mod ground;
mod groups;
mod merit;
mod meshed;
mod misses;
mod options;
mod pipeline;
mod report;
mod search;
mod second_order;
mod separate;
mod steps;

pub use background::Background;
pub use forecast::{SolidForecast, forecast_hexes};
pub use groups::{body_tags, surface_groups};
pub use options::{HexingError, HexingOptions};
pub use pipeline::{HexedSolid, hex_solid};
pub use report::{
    AttemptReport, BodyReport, Captured, FeatureReport, FitCounts, HexingReport, LostFeature, MeshedReport,
    RefusedAttempt, ResultReport, SheetCounts,
};
pub use second_order::SecondOrderReport;
