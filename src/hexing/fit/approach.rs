//! Brings mesh and solid near enough to each other where cells are good and they are not: cells may become fair for it. That
//! spares another attempt with smaller cells, which takes as long again and whose transitions cost cells as well.

use super::super::correspondence::Correspondence;
use super::near::Terms;
use super::progress::Part;
use super::survey::Survey;
use super::target::OnSolid;
use super::{APPROACH, FITTING, FitOptions, FitReport, Fitted, GOOD, course, off, quality};
use crate::mesh::HexMesh;
use crate::optimize::Evening;
use crate::solid::SolidModel;
use crate::{Cancelled, Monitor};

/// It goes on until they are this share of what is near from each other.
const ENOUGH: f64 = 0.75;

impl Fitted {
    /// Brings mesh and solid as near to each other as the `options` say, as far as that is possible with cells that they call
    /// fair: `mesh` and `on` are as the fit left them. Returns what came of the fit with that.
    ///
    /// # Errors
    /// [`Cancelled`] when the monitor says so; nodes that have moved by then stay where they are.
    pub fn approach(
        &self,
        mesh: &mut HexMesh,
        on: &Correspondence,
        solid: &SolidModel,
        options: &FitOptions,
        monitor: &dyn Monitor,
    ) -> Result<FitReport, Cancelled> {
        let &FitOptions { max_distance, near, fair, .. } = options;
        let part = Part { whole: monitor, stage: FITTING, range: [APPROACH, 1.0] };
        let evening = Evening::ALL[0];
        let terms = Terms { leave: 0.5 * max_distance, evening, enough: ENOUGH * near, fair: fair.min(GOOD) };
        let mut survey = Survey::new(mesh, &on.faces, solid, &part)?;
        let came = course(mesh, on, &self.holds, (&mut survey, &self.far), terms, &part)?;
        let sweeps = self.report.sweeps + came.sweeps;
        let off = off(mesh, on, &self.holds, &OnSolid::new(solid, &on.reduction));
        let (worst, mean) = quality(mesh);
        Ok(FitReport { taken_back: self.report.taken_back, sweeps, off, worst, mean, inverted: Vec::new() })
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::target::Target;
    use super::super::testing::{farthest, held, house};
    use super::*;
    use crate::Silent;
    use crate::hexing::correspondence::correspond;

    /// The ridge of the house turns so much that good cells do not follow it.
    #[test]
    fn cells_become_fair_for_the_sake_of_distance() {
        let (solid, mut mesh) = house(0.5);
        let on = correspond(&mesh, &solid, &Silent).unwrap();
        let target = OnSolid::new(&solid, &on.reduction);
        for (place, &anchor) in mesh.positions.iter_mut().zip(&on.anchors) {
            *place = target.foot(anchor, *place).map_or(*place, |foot| foot.point);
        }
        assert!(farthest(&mesh, &on, &solid) > 0.1);
        let approached = |near: f64, fair: f64| {
            let mut mesh = mesh.clone();
            let far = vec![true; mesh.positions.len()];
            let fitted = Fitted { report: FitReport::default(), holds: held(&on), far };
            let options = FitOptions { near, fair, ..FitOptions::default() };
            let report = fitted.approach(&mut mesh, &on, &solid, &options, &Silent).unwrap();
            assert_eq!((report.worst, report.mean), quality(&mesh));
            assert_eq!(report.off, []);
            (farthest(&mesh, &on, &solid), report.worst.unwrap(), report.sweeps)
        };
        let near = 0.06;
        let [(good, best, _), (fair, worst, sweeps)] = [GOOD, 0.36].map(|least| approached(near, least));
        assert!(good > near && best >= GOOD, "{good} {best}");
        assert!(fair <= near && (0.36..GOOD).contains(&worst), "{fair} {worst}");
        // Good is all that is ever asked for, and what is near enough stays so.
        assert_eq!(approached(near, 0.6), approached(near, GOOD));
        assert!(approached(1.0, 0.36).2 < sweeps);
    }
}
