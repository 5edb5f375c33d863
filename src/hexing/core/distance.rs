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

/// Cells that one task measures one after the other.
const BLOCK: usize = 128;

impl Distances {
    /// Measures every cell. Where the centre of a cell before lies deeper than its own centre is away from it, by more
    /// than `far` edges, that difference is taken: the side is right, and the distance no less.
    pub fn of(
        cells: &Cells<'_>,
        signed_distance: impl Fn(Point) -> f64 + Sync,
        far: f64,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let edge = parallel::try_collect(cells.len(), monitor, |cell| cells.edge_length(cell))?;
        let signed = parallel::try_blocks(cells.len(), BLOCK, monitor, |block| {
            let mut measured = (Point::ZERO, 0.0);
            let measure = |cell: usize| {
                let center = cells.barycentre(cell);
                let (from, depth): (Point, f64) = measured;
                let least = depth.abs() - center.distance(from);
                if least > far * edge[cell] {
                    return least.copysign(depth);
                }
                measured = (center, signed_distance(center));
                measured.1
            };
            block.map(measure).collect::<Vec<f64>>()
        })?;
        Ok(Self { signed: parallel::concat(signed), edge })
    }

    /// The distances in edge lengths.
    pub fn depth(&self) -> Vec<f64> {
        self.signed.iter().zip(&self.edge).map(|(distance, edge)| distance / edge).collect()
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

    use super::*;
    use crate::Silent;
    use crate::geometry::Aabb;
    use crate::mesh::{GridOptions, hex_grid};

    #[test]
    fn what_is_near_is_measured_and_what_is_far_has_its_side() {
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 10_000 };
        let mesh = hex_grid(Aabb { min: Point::ZERO, max: Point::splat(20.0) }, &options).unwrap();
        let cells = Cells::of(&mesh, &Silent).unwrap();
        let measured = AtomicUsize::new(0);
        let ball = |p: Point| p.distance(Point::splat(9.7)) - 8.0;
        let counted = |p: Point| {
            measured.fetch_add(1, Relaxed);
            ball(p)
        };
        let found = Distances::of(&cells, counted, 2.0, &Silent).unwrap();
        assert!(found.edge.iter().all(|&edge| edge == 1.0));
        for (cell, &signed) in found.signed.iter().enumerate() {
            let exact = ball(cells.barycentre(cell));
            assert!(
                signed == exact || exact.abs() > 2.0 && (2.0..=exact.abs() + 1e-9).contains(&signed.abs())
            );
            assert_eq!(signed < 0.0, exact < 0.0);
        }
        assert!(measured.into_inner() < cells.len() * 3 / 4);
    }
}
