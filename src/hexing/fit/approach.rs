//! Brings mesh and solid near enough to each other where cells are good and they are not: cells may become fair for it. That
//! spares another attempt with smaller cells, which takes as long again and whose transitions cost cells as well.
//!
//! Where nodes have no room to come nearer, the worst cells around them are smoothed and they try once more. They stay where
//! they are meanwhile in one round, and slide in the next: that takes them away at first, but also out of places from which
//! no step leads nearer.

use super::super::correspondence::Correspondence;
use super::holds::{Hold, Holds};
use super::near::{Terms, near};
use super::rings::widen;
use super::soften::SMOOTHING;
use super::survey::Survey;
use super::target::OnSolid;
use super::{APPROACH, FITTING, FitOptions, FitReport, Fitted, GOOD, course, off, quality};
use crate::mesh::{HexMesh, NodeId};
use crate::monitor::Part;
use crate::optimize::{Evening, Problem, smooth};
use crate::solid::SolidModel;
use crate::{Cancelled, Monitor};

/// It goes on until they are this share of what is near from each other, if that is asked for, or else this one.
const ENOUGH_ASKED: f64 = 0.8;
const ENOUGH: f64 = 0.55;

/// So many rounds of making room, as long as one of the last few brought something; where they are near, one of the last two, which
/// make it in either way.
const ROUNDS: usize = 8;
const IN_VAIN: usize = 3;
const IN_VAIN_NEAR: usize = 2;

/// That is something: this share of how far they are apart.
const GAIN: f64 = 0.01;

/// Rings of cells around what is far that are smoothed.
const RINGS: usize = 2;

/// The share of the work that is done before room is made.
const ROOM: f64 = 0.4;

impl Fitted {
    /// Brings mesh and solid as near to each other as the `options` say, as far as that is possible with cells that they call
    /// fair: `mesh` and `on` are as the fit left them, and the `survey`, if it was kept. Returns what came of the fit with that.
    ///
    /// # Errors
    /// [`Cancelled`] when the monitor says so; nodes that have moved by then stay where they are.
    pub fn approach(
        &self,
        mesh: &mut HexMesh,
        on: &Correspondence,
        (solid, survey): (&SolidModel, Option<Survey>),
        options: &FitOptions,
        monitor: &dyn Monitor,
    ) -> Result<FitReport, Cancelled> {
        let &FitOptions { max_distance, near: limit, fair, .. } = options;
        let part = |from: f64, to: f64| Part {
            whole: monitor,
            stage: FITTING,
            range: [from, to].map(|share| APPROACH + (1.0 - APPROACH) * share),
        };
        let evening = Evening::ALL[0];
        let enough = limit * if max_distance.is_finite() { ENOUGH_ASKED } else { ENOUGH };
        let terms = Terms { leave: 0.5 * max_distance, evening, enough, fair: fair.min(GOOD) };
        let mut survey = survey.unwrap_or_else(|| Survey::new(mesh, &on.faces, solid));
        let mut came = course(mesh, on, &self.holds, (&mut survey, &self.far), terms, &part(0.0, ROOM))?;
        let mut sweeps = self.report.sweeps + came.sweeps;
        let mut in_vain = 0;
        for round in 0..ROUNDS {
            let patience = if came.apart <= limit { IN_VAIN_NEAR } else { IN_VAIN };
            if came.apart <= terms.enough || in_vain >= patience {
                break;
            }
            let [from, middle, to] =
                [0.0, 0.5, 1.0].map(|share| ROOM + (1.0 - ROOM) * (round as f64 + share) / ROUNDS as f64);
            let before = mesh.positions.clone();
            let stay = round % 2 == 0;
            sweeps += self.make_room(mesh, on, solid, (&came.far, stay), &part(from, middle))?;
            let now = near(mesh, on, &self.holds, &mut survey, terms, &part(middle, to))?;
            sweeps += now.sweeps;
            in_vain = if now.apart < (1.0 - GAIN) * came.apart { 0 } else { in_vain + 1 };
            if now.apart <= came.apart {
                came = now;
            } else {
                mesh.positions = before;
            }
        }
        let off = off(mesh, on, &self.holds, &OnSolid::new(solid, &on.reduction));
        let (worst, mean) = quality(mesh);
        let (taken_back, apart) = (self.report.taken_back, came.apart);
        Ok(FitReport { taken_back, sweeps, off, worst, mean, inverted: Vec::new(), apart })
    }

    /// Smooths the worst cells around nodes that are `far`, which stay where they are or slide. Returns the number of sweeps.
    fn make_room(
        &self,
        mesh: &mut HexMesh,
        on: &Correspondence,
        solid: &SolidModel,
        (far, stay): (&[bool], bool),
        monitor: &dyn Monitor,
    ) -> Result<usize, Cancelled> {
        let mut moves = far.to_vec();
        widen(mesh, &mut moves, RINGS, monitor)?;
        let is_moved = |n: NodeId| moves[n.index()];
        let mut problem = Problem::within(&mesh.positions, &mesh.hexes, &is_moved, monitor)?;
        problem.order_by(4, |n| on.anchors[n.index()].freedom());
        let target = OnSolid::new(solid, &on.reduction);
        let mut guide = Holds::kept(&target, &on.anchors, &self.holds, &mesh.positions);
        if stay {
            (0..far.len()).filter(|&n| far[n]).for_each(|n| guide.holds[n] = Hold::Pinned);
        }
        let sweeps = smooth(&mut problem, &guide, &SMOOTHING, None, monitor)?;
        problem.write_back(&mut mesh.positions);
        Ok(sweeps)
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::target::Target;
    use super::super::testing::{farthest, held, house};
    use super::*;
    use crate::Silent;
    use crate::hexing::correspondence::correspond;

    /// Distance, worst cell and sweeps.
    type Came = (f64, f64, usize);

    /// What comes of approaching with a house whose ridge turns so much that good cells do not follow it.
    fn approached(aside: f64, near: f64, fair: f64) -> Came {
        let (solid, mut mesh) = house(aside);
        let on = correspond(&mesh, &solid, &Silent).unwrap();
        let target = OnSolid::new(&solid, &on.reduction);
        for (place, &anchor) in mesh.positions.iter_mut().zip(&on.anchors) {
            *place = target.foot(anchor, *place).map_or(*place, |foot| foot.point);
        }
        assert!(farthest(&mesh, &on, &solid) > 0.07);
        let far = vec![true; mesh.positions.len()];
        let fitted = Fitted { report: FitReport::default(), holds: held(&on), far };
        let options = FitOptions { near, fair, ..FitOptions::default() };
        let report = fitted.approach(&mut mesh, &on, (&solid, None), &options, &Silent).unwrap();
        assert_eq!((report.worst, report.mean), quality(&mesh));
        assert_eq!(report.off, []);
        (farthest(&mesh, &on, &solid), report.worst.unwrap(), report.sweeps)
    }

    #[test]
    fn cells_become_fair_for_the_sake_of_distance() {
        let near = 0.06;
        let [(good, best, most), (fair, worst, sweeps)] =
            [GOOD, 0.36].map(|least| approached(0.5, near, least));
        assert!(good <= near && best >= GOOD, "{good} {best}");
        assert!(fair <= near && (0.36..GOOD).contains(&worst), "{fair} {worst}");
        assert!(sweeps < most, "it is near sooner: {sweeps} {most}");
        // Good is all that is ever asked for, and what is near enough stays so.
        assert_eq!(approached(0.5, near, 0.6), approached(0.5, near, GOOD));
        assert!(approached(0.5, 1.0, 0.36).2 < sweeps);
    }

    #[test]
    fn room_is_made_where_they_stay_apart() {
        let (alone, _, few) = approached(0.65, 0.18, GOOD);
        let (with_room, best, many) = approached(0.65, 0.05, GOOD);
        assert!(with_room < 0.95 * alone && best >= GOOD && many > few, "{with_room} {alone} {best}");
    }
}
