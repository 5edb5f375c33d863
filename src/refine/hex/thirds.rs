//! 3-refinement, level by level: any set of hexes can be refined, so that there is no octree to close.

use super::attempt::{Attempt, attempt};
use super::options::{HexRefineError, RefinedHexes};
use super::plan::{HexPlan, Level, check_size};
use super::stage::StageMesh;
use crate::Monitor;
use crate::optimize::BoundarySurface;

/// Hexes that a hex becomes.
const CHILDREN: u64 = 27;

impl HexPlan<'_> {
    /// Divides what is wanted finer in 27, again and again.
    pub(super) fn in_thirds(
        mut self,
        surface: &BoundarySurface,
        monitor: &dyn Monitor,
    ) -> Result<RefinedHexes, HexRefineError> {
        let mut mesh = StageMesh::of_input(self.input.positions.clone(), self.input.hexes.clone());
        let mut stages = Vec::new();
        for number in 0.. {
            let mut refined = self.wanted_of(&mesh, number, monitor)?;
            let count = refined.iter().filter(|&&wanted| wanted).count();
            if count == 0 {
                break;
            }
            if number >= self.options.max_levels {
                self.capped = count;
                break;
            }
            let hexes = mesh.hexes.len() as u64 + (CHILDREN - 1) * count as u64;
            check_size(self.options, number + 1, hexes)?;
            let next = self.stage_in_thirds(&mesh, &mut refined, surface, monitor)?;
            check_size(self.options, number + 1, next.mesh.hexes.len() as u64)?;
            stages.push(next.report);
            mesh = next.mesh;
        }
        let (added, capped, turned) = (self.added, self.capped, self.turned);
        Ok(RefinedHexes { added, capped, turned, stages, ..RefinedHexes::new(&self.input, mesh) })
    }

    /// For each hex: is it of this level, and wanted finer? Transition hexes are of the level of their coarse hex,
    /// which was not.
    fn wanted_of(
        &self,
        mesh: &StageMesh,
        number: u8,
        monitor: &dyn Monitor,
    ) -> Result<Vec<bool>, HexRefineError> {
        let of_level: Vec<usize> = (0..mesh.hexes.len()).filter(|&h| mesh.level[h] == number).collect();
        let elements: Vec<_> = of_level.iter().map(|&h| mesh.hexes[h]).collect();
        let level = Level { elements: &elements, positions: &mesh.positions, number };
        let mut refined = vec![false; mesh.hexes.len()];
        for e in level.wanted(&self.field, self.options, monitor)? {
            refined[of_level[e as usize]] = true;
        }
        Ok(refined)
    }

    /// One stage; what stands in its way is refined too.
    fn stage_in_thirds(
        &mut self,
        mesh: &StageMesh,
        refined: &mut [bool],
        surface: &BoundarySurface,
        monitor: &dyn Monitor,
    ) -> Result<super::Stage, HexRefineError> {
        loop {
            match attempt(mesh, refined, self.options.method, surface, monitor)? {
                Attempt::Made(next) => return Ok(*next),
                Attempt::Conflict(hexes) => match add(refined, &hexes) {
                    0 => return Err(HexRefineError::NoTemplate(hexes.len())),
                    more => self.added.conflicts += more,
                },
                Attempt::Tangled { coarse, hexes } => match add(refined, &coarse) {
                    0 => return Err(HexRefineError::Tangled(hexes)),
                    more => self.added.repairs += more,
                },
            }
        }
    }
}

/// Refines more hexes; returns how many there were to refine.
fn add(refined: &mut [bool], hexes: &[u32]) -> usize {
    let mut more = 0;
    for &h in hexes {
        more += usize::from(!refined[h as usize]);
        refined[h as usize] = true;
    }
    more
}
