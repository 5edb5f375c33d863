//! Walls, rods, slots and holes that are thinner than cells, kept.
//!
//! ```text
//!   +---+---+---+---+       The cells whose centres are in a wall askew need not share faces: the wall falls apart.
//!   |   |   |  .|. /|       Those whose centres are within w/2 of its middle do, where n is its normal, e the edges of
//!   +---+---+.--/---+       a cell and
//!   |   |  .|. /|   |
//!   +---+.--/---+---+           w = |n . e1| + |n . e2| + |n . e3|        (h for a wall along the grid, sqrt 3 h at most)
//!   |  .|. /|   |   |
//!   +---/---+---+---+       That is the standard plane of digital geometry; for all normals of a rod, its standard line.
//! ```
//!
//! So where the solid is thinner than w, t thick, cells count as (w - t)/2 nearer to its inside; where what is between two
//! walls is thinner than w, as much nearer to the outside. The fit of the mesh to the solid makes them thin again.
//!
//! Reveillès, *Géométrie discrète, calcul en nombres entiers et algorithmique* (1991); Andres, Acharya, Sibata, *Discrete
//! analytical hyperplanes* (1997): planes so thick are joined through faces, and have no tunnels.

use super::cells::Cells;
use super::distance::Distances;
use crate::geometry::Point;
use crate::mesh::numbering::hex::EDGES;
use crate::{Cancelled, Monitor, parallel};

/// Share of w: what is thinner is lost.
const LEAST: f64 = 0.2;
/// The cosine between the normals of two walls that face each other, at most: -.5 where they meet at 60 degrees.
const FACING: f64 = -0.5;

/// The solid near a point.
#[derive(Clone, Copy, Debug)]
pub(super) struct Near {
    /// The distance from the boundary, negative inside.
    pub signed: f64,
    /// The nearest point of the boundary.
    pub foot: Point,
    /// The outward unit normal there.
    pub normal: Point,
}

/// Makes up for what is thinner than cells, in the distances of the cells nearby; how many cells that concerns.
pub(super) fn keep_thin(
    cells: &Cells<'_>,
    distances: &mut Distances,
    near: impl Fn(Point) -> Near + Sync,
    monitor: &dyn Monitor,
) -> Result<usize, Cancelled> {
    let shifts = parallel::try_collect(cells.len(), monitor, |cell| {
        // No w is more than sqrt 3 edges of a cube; a third more for cells that are none.
        if distances.signed[cell].abs() > 1.2 * distances.edge[cell] {
            0.0
        } else {
            shift(cells, cell, &near)
        }
    })?;
    distances.signed.iter_mut().zip(&shifts).for_each(|(signed, shift)| *signed += shift);
    Ok(shifts.iter().filter(|&&shift| shift != 0.0).count())
}

/// By how much a cell counts as further outside.
fn shift(cells: &Cells<'_>, cell: usize, near: &impl Fn(Point) -> Near) -> f64 {
    let center = cells.barycentre(cell);
    let here = near(center);
    // Around an edge of the solid the way to it turns with the centre, unlike the normals there.
    let normal = ((center - here.foot) / here.signed).try_normalize().unwrap_or(here.normal);
    let w = width(&cells.corners(cell), normal);
    if here.signed.abs() > 0.5 * w {
        return 0.0;
    }
    let lacking = |side: f64| {
        let beyond = near(here.foot + normal * (0.5 * w * side));
        let thickness = 0.5 * w + beyond.signed * side;
        let is_thin = thickness < w && thickness > LEAST * w && beyond.normal.dot(normal) < FACING;
        if is_thin { 0.5 * (w - thickness) } else { 0.0 }
    };
    lacking(1.0) - lacking(-1.0)
}

/// How thick a wall with this normal must be, so that the cells with centres in it share faces.
fn width(corners: &[Point; 8], normal: Point) -> f64 {
    let along = |[a, b]: [u8; 2]| (corners[usize::from(b)] - corners[usize::from(a)]).dot(normal).abs();
    EDGES.map(along).iter().sum::<f64>() / 4.0
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::numbering::hex::CORNERS;

    #[test]
    fn walls_along_the_grid_need_an_edge_and_those_askew_more() {
        let corners = CORNERS.map(|corner| Point::from(corner.map(f64::from)) * Point::new(1.0, 2.0, 1.0));
        assert!((width(&corners, Point::X) - 1.0).abs() < 1e-12);
        assert!((width(&corners, Point::Y) - 2.0).abs() < 1e-12);
        let askew = Point::new(1.0, 1.0, -1.0).normalize();
        assert!((width(&corners, askew) - 4.0 / 3.0_f64.sqrt()).abs() < 1e-12);
    }
}
