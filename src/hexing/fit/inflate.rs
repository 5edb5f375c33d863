//! Pushes the cells of new sheets open, all nodes free, and takes sheets back where that fails.

use super::super::correspondence::Correspondence;
use super::super::sheets::SheetReport;
use super::FITTING;
use super::holds::Holds;
use super::progress::Part;
use super::target::Target;
use crate::mesh::HexMesh;
use crate::optimize::{OptimizeOptions, Problem, untangle};
use crate::{Cancelled, Monitor};

/// What inflating came to.
pub(super) struct Inflated {
    /// All of the mesh, each node movable.
    pub(super) problem: Problem,
    pub(super) sweeps: usize,
    /// Sheets and collars that were taken back.
    pub(super) taken_back: usize,
}

/// Moves nodes until all cells are positive. Where they cannot become so, the sheets are taken back from the last to the
/// one that has a part in it, and all is done again from where the nodes were; without sheets it is given up.
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
        let mut problem = Problem::new(&mesh.positions, &mesh.hexes, |_| true);
        let holds = Holds::free(target, &on.anchors);
        let part = Part { whole: monitor, stage: FITTING, range };
        sweeps += untangle(&mut problem, &holds, &OptimizeOptions::default(), &part)?;
        range = [range[1], range[1].midpoint(1.0)];
        problem.find_positive();
        let tangled: Vec<u32> =
            (0u32..).zip(&problem.positive).filter(|(_, positive)| !**positive).map(|(h, _)| h).collect();
        let Some(layer) = sheets.last_with(mesh, &tangled) else {
            return Ok(Inflated { problem, sweeps, taken_back });
        };
        while sheets.len() > layer && sheets.take_back(mesh, on) {
            taken_back += 1;
        }
    }
}
