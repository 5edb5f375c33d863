//! How good are the cells, and how is that distributed.
//!
//! Quads and hexes are measured at their corners, as the Verdict library does (Stimpson et al., Sandia report
//! 2007-1751). That a hex is positive in its inside too is shown by bounds on its Jacobian ([`is_positive`]).

mod bernstein;
pub(crate) mod four;
mod hex;
mod quad;
mod second_order;
mod statistics;

pub use bernstein::{Certainty, JacobianBound, is_positive, min_jacobian_bound};
pub use hex::{
    HexQuality, HexQualityReport, aspect, corner_scaled_jacobians, hex_quality, hex_quality_within,
    scaled_jacobian,
};
pub use quad::{QuadQuality, QualityReport, quad_quality};
pub use second_order::second_order_jacobian;
pub use statistics::{Distribution, Histogram, Summary};
