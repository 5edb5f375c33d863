//! A mesh of a body: how it comes nearer to its solid, if it is worth it, and what is done once it is kept.

use super::correspondence::Correspondence;
use super::fit::{ApproachOptions, FINISHED, FINISHING, Fitted, NEARER, Survey, quality};
use super::report::{FitCounts, MeshedReport};
use super::separate::separate;
use crate::geometry::Point;
use crate::mesh::{Distances, HexMesh, Quads, Triangles};
use crate::monitor::Part;
use crate::solid::SolidModel;
use crate::{Cancelled, Monitor};

/// An approach goes on until mesh and solid are this share of what is near from each other, if that is asked for, or else this one.
const ENOUGH_ASKED: f64 = 0.8;
const ENOUGH: f64 = 0.55;

/// A mesh that is kept, and is farther from its solid than the first of these shares of the diagonal but not than the second, lacks
/// little: it is brought as near as the first, with cells that stay good.
const LITTLE: [f64; 2] = [0.002, 0.003];

/// Cells that stay good are no price: so much may be left then.
const LITTLE_LEFT: f64 = 0.98;

/// An approach ends after so many rounds in vain, and one that lacks little.
const PATIENCE: usize = 5;
const LITTLE_PATIENCE: usize = 4;

/// A mesh of a body and where it stands for what.
#[derive(Clone, Debug)]
pub(super) struct Meshed {
    pub(super) mesh: HexMesh,
    pub(super) on: Correspondence,
    pub(super) fitted: Fitted,
    /// How it approaches the solid if it is kept, if it is to.
    pub(super) approach: Option<Approach>,
}

/// How a mesh is brought nearer to its solid.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Approach {
    options: ApproachOptions,
    /// It counts where they are so near then, in model units, or no more than such a share is left of what they were apart.
    near: f64,
    left: f64,
}

impl Approach {
    /// One with which they come so near if that is possible with cells that are fair, and nearer if it is.
    pub(super) fn new(max_distance: Option<f64>, near: f64, fair: f64) -> Self {
        let enough = near * if max_distance.is_some() { ENOUGH_ASKED } else { ENOUGH };
        let max_distance = max_distance.unwrap_or(f64::INFINITY);
        let options =
            ApproachOptions { near: enough, fair, patience: PATIENCE, is_trial: false, max_distance };
        Self { options, near, left: NEARER }
    }

    /// The same, which is given up soon where it brings hardly anything.
    pub(super) fn tried(mut self) -> Self {
        self.options.is_trial = true;
        self
    }

    /// What is to follow this one where a distance is asked for and it did not suffice, the first last: the same once more, from
    /// where it came, and one with cells that stay good.
    pub(super) fn again(&self) -> [Self; 2] {
        [Self::with_good_cells(self.near), Self { left: LITTLE_LEFT, ..self.clone() }]
    }

    /// One for a mesh that is kept, where it lacks little: cells stay good.
    pub(super) fn of_little(apart: f64, diagonal: f64) -> Option<Self> {
        let [near, far] = LITTLE.map(|share| share * diagonal);
        (near < apart && apart <= far).then(|| Self::with_good_cells(near))
    }

    /// One in which cells stay good, so that it counts however little it brings.
    fn with_good_cells(near: f64) -> Self {
        let (fair, patience, max_distance) = (f64::INFINITY, LITTLE_PATIENCE, f64::INFINITY);
        let options = ApproachOptions { near, fair, patience, is_trial: false, max_distance };
        Self { options, near, left: LITTLE_LEFT }
    }
}

impl Meshed {
    /// Finishes the mesh that is kept, and says in the `report` what came of that.
    pub(super) fn finish(
        &mut self,
        solid: &SolidModel,
        report: &mut MeshedReport,
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        self.approach_as_put_off(solid, monitor)?;
        let Self { mesh, on, fitted, .. } = self;
        let mut drawn_in = Vec::new();
        // Once more where nodes were drawn in: what is inside makes up for that.
        for _ in 0..2 {
            fitted.finish(mesh, on, solid, monitor)?;
            let moved = separate(mesh, &on.faces, monitor)?;
            if moved.is_empty() {
                break;
            }
            fitted.take_off(&moved);
            drawn_in.extend(moved);
        }
        drawn_in.sort_unstable();
        drawn_in.dedup();
        report.fit = FitCounts::new(&fitted.report, drawn_in.len());
        let (worst, mean) = quality(mesh);
        (report.worst, report.mean) = (worst.unwrap_or_default(), mean);
        let rest = Part { whole: monitor, stage: FINISHING, range: [FINISHED, 1.0] };
        (report.distance, _) = distances(mesh, on, solid, f64::INFINITY, &rest)?;
        Ok(())
    }

    /// Brings it nearer to the solid already, if it is to approach that once it is kept, and says in the `report` what came of it.
    pub(super) fn approach_first(
        &mut self,
        solid: &SolidModel,
        report: &mut MeshedReport,
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        if self.approach_as_put_off(solid, monitor)? {
            let came = &self.fitted.report;
            report.fit = FitCounts::new(came, 0);
            (report.worst, report.mean) = (came.worst.unwrap_or_default(), came.mean);
            (report.distance, _) = distances(&self.mesh, &self.on, solid, f64::INFINITY, monitor)?;
        }
        Ok(())
    }

    /// Makes the approach that was put off, if there is one.
    fn approach_as_put_off(&mut self, solid: &SolidModel, monitor: &dyn Monitor) -> Result<bool, Cancelled> {
        let approach = self.approach.take();
        if let Some(approach) = &approach {
            let mut survey = Survey::new(&self.mesh, &self.on.faces, solid);
            self.approach(&mut survey, approach, monitor)?;
        }
        Ok(approach.is_some())
    }

    /// Brings it nearer to the solid, unless that brings little. Was it given up soon?
    pub(super) fn approach(
        &mut self,
        survey: &mut Survey,
        Approach { options, near, left }: &Approach,
        monitor: &dyn Monitor,
    ) -> Result<bool, Cancelled> {
        let Self { mesh, on, fitted, .. } = self;
        let before = mesh.positions.clone();
        let (report, gave_up) = fitted.approach(mesh, on, survey, options, monitor)?;
        if report.apart <= *near || report.apart <= left * fitted.report.apart {
            fitted.report = report;
        } else {
            mesh.positions = before;
        }
        Ok(gave_up)
    }
}

/// How far the boundaries of a mesh and a solid are from each other, and the places where that is more than the limit.
pub(super) fn distances(
    mesh: &HexMesh,
    on: &Correspondence,
    solid: &SolidModel,
    limit: f64,
    monitor: &dyn Monitor,
) -> Result<(Distances, Vec<Point>), Cancelled> {
    let quads = on.quads();
    let boundary = Quads { positions: &mesh.positions, quads: &quads };
    let surface = Triangles { positions: solid.points(), triangles: solid.triangles() };
    Distances::with_samples_beyond(limit, boundary, (surface, &|p| solid.distance(p)), monitor)
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;

    #[test]
    fn a_mesh_that_lacks_little_is_brought_as_near_as_that() {
        let near = |apart: f64| Approach::of_little(apart, 10.0).map(|approach| approach.near);
        assert_eq!([0.02, 0.0201, 0.03, 0.0301].map(near), [None, Some(0.02), Some(0.02), None]);
    }
}
