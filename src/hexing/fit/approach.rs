//! Brings mesh and solid near enough to each other where cells are good and they are not: cells may become fair for it. That
//! is better than another attempt with smaller cells, whose transitions would be no better.

use super::super::correspondence::Correspondence;
use super::apart::Survey;
use super::near::Terms;
use super::progress::Part;
use super::target::OnSolid;
use super::{APPROACH, FITTING, FitOptions, Fitted, GOOD, course, off, quality};
use crate::mesh::HexMesh;
use crate::optimize::Evening;
use crate::solid::SolidModel;
use crate::{Cancelled, Monitor};

/// It goes on until they are this share of what is near from each other.
const ENOUGH: f64 = 0.75;

impl Fitted {
    /// Brings mesh and solid as near to each other as the `options` say, if that is possible with cells that they call fair:
    /// `mesh` and `on` are as the fit left them. If it is not, nodes stay where they are.
    ///
    /// # Errors
    /// [`Cancelled`] when the monitor says so; then nodes are where they were.
    pub fn approach(
        &mut self,
        mesh: &mut HexMesh,
        on: &Correspondence,
        solid: &SolidModel,
        options: &FitOptions,
        monitor: &dyn Monitor,
    ) -> Result<bool, Cancelled> {
        let &FitOptions { max_distance, near, fair, .. } = options;
        let part = Part { whole: monitor, stage: FITTING, range: [APPROACH, 1.0] };
        let evening = Evening::ALL[0];
        let terms = Terms { leave: 0.5 * max_distance, evening, enough: ENOUGH * near, fair: fair.min(GOOD) };
        let before = mesh.positions.clone();
        let mut came = || {
            let mut survey = Survey::new(mesh, &on.faces, solid, &part)?;
            course(mesh, on, &self.holds, (&mut survey, &self.far), terms, &part)
        };
        let came = came();
        let is_near = came.as_ref().is_ok_and(|came| came.apart <= near);
        if is_near {
            (self.report.worst, self.report.mean) = quality(mesh);
            self.report.off = off(mesh, on, &self.holds, &OnSolid::new(solid, &on.reduction));
        } else {
            mesh.positions = before;
        }
        self.report.sweeps += came?.sweeps;
        Ok(is_near)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::FitReport;
    use super::super::target::Target;
    use super::super::testing::{farthest, held, house};
    use super::*;
    use crate::hexing::correspondence::correspond;
    use crate::{Silent, Stage};

    /// Stops the work when most of the approach is done.
    struct Late(std::sync::atomic::AtomicBool);

    impl Monitor for Late {
        fn progress(&self, _: Stage, fraction: f64) {
            self.0.fetch_or(fraction > 0.5 * (APPROACH + 1.0), std::sync::atomic::Ordering::Relaxed);
        }

        fn cancelled(&self) -> bool {
            self.0.load(std::sync::atomic::Ordering::Relaxed)
        }
    }

    /// The ridge of the house turns so much that good cells do not follow it.
    #[test]
    fn cells_become_fair_where_that_is_near_enough() {
        let (solid, mut mesh) = house(0.5);
        let on = correspond(&mesh, &solid, &Silent).unwrap();
        let target = OnSolid::new(&solid, &on.reduction);
        for (place, &anchor) in mesh.positions.iter_mut().zip(&on.anchors) {
            *place = target.foot(anchor, *place).map_or(*place, |foot| foot.point);
        }
        let far = vec![true; mesh.positions.len()];
        let mut fitted = Fitted { report: FitReport::default(), holds: held(&on), far };
        let mut approach = |mesh: &mut HexMesh, near: f64, fair: f64, monitor: &dyn Monitor| {
            let options = FitOptions { near, fair, ..FitOptions::default() };
            let came = fitted.approach(mesh, &on, &solid, &options, monitor);
            (came, fitted.report.clone())
        };
        let before = (mesh.positions.clone(), farthest(&mesh, &on, &solid));
        assert!(before.1 > 0.1, "{}", before.1);

        // Too near, too good, too soon.
        let refused = [(1e-3, 0.36), (0.06, GOOD), (0.06, 0.6)];
        for (near, fair) in refused {
            let (came, report) = approach(&mut mesh, near, fair, &Silent);
            assert!(came == Ok(false) && mesh.positions == before.0, "{near} {fair}: {came:?}");
            assert!(report.worst.is_none() && report.sweeps > 0);
        }
        let (stopped, _) = approach(&mut mesh, 0.06, 0.36, &Late(false.into()));
        assert!(stopped == Err(Cancelled) && mesh.positions == before.0, "{stopped:?}");

        let (came, report) = approach(&mut mesh, 0.06, 0.36, &Silent);
        assert_eq!((came, (report.worst, report.mean)), (Ok(true), quality(&mesh)));
        assert!(farthest(&mesh, &on, &solid) <= 0.06);
        assert!((0.36..GOOD).contains(&report.worst.unwrap()), "{report:?}");
        assert_eq!(report.off, []);
    }
}
