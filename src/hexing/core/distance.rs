//! How deep the cells of a background lie in the solid.

use super::cells::Cells;
use crate::geometry::Point;
use crate::{Cancelled, Monitor, parallel};

/// How deep cells lie.
pub(super) struct Distances {
    /// The distance of each cell's centre from the solid's boundary; negative inside.
    pub signed: Vec<f64>,
    /// The mean edge length of each cell.
    pub edge: Vec<f64>,
}

impl Distances {
    /// Measures every cell.
    pub fn of(
        cells: &Cells<'_>,
        signed_distance: impl Fn(Point) -> f64 + Sync,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        Ok(Self {
            signed: parallel::try_collect(cells.len(), monitor, |c| signed_distance(cells.barycentre(c)))?,
            edge: parallel::try_collect(cells.len(), monitor, |c| cells.edge_length(c))?,
        })
    }

    /// The distances in edge lengths.
    pub fn depth(&self) -> Vec<f64> {
        self.signed.iter().zip(&self.edge).map(|(distance, edge)| distance / edge).collect()
    }
}
