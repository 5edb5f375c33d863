//! Pushes the cells of new sheets open, all nodes free, and leaves out sheets where that fails.
//!
//! A cell can be folded inside while its corners are as good as steps of single nodes make them. Before a sheet over a
//! whole surface is left out for a few such cells, nodes around them are put between their neighbours, and pushed anew.

use super::super::correspondence::Correspondence;
use super::super::sheets::SheetReport;
use super::FITTING;
use super::holds::Holds;
use super::target::Target;
use crate::geometry::Point;
use crate::mesh::HexMesh;
use crate::mesh::numbering::hex::NEIGHBOURS;
use crate::monitor::Part;
use crate::optimize::{OptimizeOptions, Problem, untangle};
use crate::{Cancelled, Monitor};

/// Rings of cells around those that stay folded whose nodes are put between their neighbours, in turn.
const RINGS: [usize; 3] = [1, 2, 3];

/// How often in a row they are.
const ROUNDS: usize = 5;

/// What inflating came to.
pub(super) struct Inflated {
    /// All of the mesh, each node movable.
    pub(super) problem: Problem,
    pub(super) sweeps: usize,
    /// Sheets, wedges and collars that were left out.
    pub(super) taken_back: usize,
}

/// Moves nodes until all cells are positive. Of the sheets, collars and wedges that have a part in cells that cannot become
/// so the last ones are left out, and all is done again from where the nodes were; without sheets it is given up.
pub(super) fn inflate(
    mesh: &mut HexMesh,
    on: &mut Correspondence,
    sheets: &mut SheetReport,
    target: &dyn Target,
    monitor: &dyn Monitor,
) -> Result<Inflated, Cancelled> {
    let (mut sweeps, mut taken_back) = (0, 0);
    let mut range = [0.0, 0.5];
    loop {
        let mut problem = Problem::new(&mesh.positions, &mesh.hexes, &|_| true);
        let holds = Holds::free(target, &on.anchors);
        let part = Part { whole: monitor, stage: FITTING, range };
        sweeps += untangle(&mut problem, &holds, &OptimizeOptions::default(), &part)?;
        problem.find_positive();
        for rings in RINGS {
            let of_sheets = |(layer, cells): (usize, Vec<u32>)| sheets.is_sheet(layer).then_some(cells);
            // Without a collar or wedge a few cells are flat or thin, without a sheet those of whole surfaces.
            let culprits = sheets.culprits(mesh, &tangled(&problem));
            let folded: Vec<u32> = culprits.into_iter().filter_map(of_sheets).flatten().collect();
            if folded.is_empty() {
                break;
            }
            even_out(&mut problem, &folded, rings);
            sweeps += untangle(&mut problem, &holds, &OptimizeOptions::default(), &part)?;
            problem.find_positive();
        }
        range = [range[1], range[1].midpoint(1.0)];
        let mut culprits: Vec<usize> =
            sheets.culprits(mesh, &tangled(&problem)).into_iter().map(|(layer, _)| layer).collect();
        culprits.sort_unstable();
        culprits.dedup();
        if culprits.is_empty() {
            return Ok(Inflated { problem, sweeps, taken_back });
        }
        taken_back += culprits.len();
        let part = Part { whole: monitor, stage: FITTING, range: [range[0]; 2] };
        sheets.leave_out(mesh, on, &culprits, &part)?;
    }
}

/// The cells that are not positive.
fn tangled(problem: &Problem) -> Vec<u32> {
    (0u32..).zip(&problem.positive).filter(|(_, positive)| !**positive).map(|(h, _)| h).collect()
}

/// Puts the nodes of the cells, and of `rings` around them, between their neighbours.
fn even_out(problem: &mut Problem, cells: &[u32], rings: usize) {
    let cells: Vec<usize> = cells.iter().map(|&cell| cell as usize).collect();
    let near = problem.rings_around(&cells, rings);
    for _ in 0..ROUNDS {
        for node in (0..problem.movable() as u32).filter(|&n| near[n as usize]) {
            let (mut sum, mut count) = (Point::ZERO, 0.0);
            for (cell, corner) in problem.star(node) {
                for beside in NEIGHBOURS[corner] {
                    sum += problem.points[problem.cells[cell][usize::from(beside)] as usize];
                    count += 1.0;
                }
            }
            problem.points[node as usize] = sum / count;
        }
    }
    problem.find_positive();
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::geometry::Aabb;
    use crate::mesh::{GridOptions, hex_grid};

    /// The middle cell of five by five by five is turned inside out, and those around it are folded.
    #[test]
    fn folded_cells_are_evened_out() {
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 1000 };
        let mut mesh = hex_grid(Aabb { min: Point::ZERO, max: Point::splat(5.0) }, &options).unwrap();
        let middle = Point::splat(2.5);
        for p in mesh.positions.iter_mut().filter(|p| p.distance(middle) < 1.0) {
            *p = middle * 2.0 - *p;
        }
        let inside: Vec<bool> =
            mesh.positions.iter().map(|p| (*p - middle).abs().max_element() < 2.0).collect();
        let mut problem = Problem::new(&mesh.positions, &mesh.hexes, &|n| inside[n.index()]);
        let folded = tangled(&problem);
        assert!(folded.len() > 1);
        even_out(&mut problem, &folded, 0);
        assert!(tangled(&problem).is_empty());
    }
}
