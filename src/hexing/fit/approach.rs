//! Brings mesh and solid near enough to each other where cells are good and they are not: cells may become fair for it. That
//! spares another attempt with smaller cells, which takes as long again and whose transitions cost cells as well.
//!
//! Where nodes have no room to come nearer, cells around them are smoothed and they try once more, in one way after the other:
//! what is far stays where it is meanwhile, or slides, which takes it away at first, but also out of places from which
//! no step leads nearer. What came nearer counts, place by place. In the end what made room is evened out.

use super::super::correspondence::Correspondence;
use super::even::{even, sliding};
use super::holds::Hold;
use super::near::{Nearness, SHARE, Terms, far, mark, near};
use super::patches::keep_nearer;
use super::rings::widen;
use super::soften::SMOOTHING;
use super::survey::Survey;
use super::target::OnSolid;
use super::{APPROACH, FITTING, FitReport, Fitted, GOOD, off, quality};
use crate::mesh::{HexMesh, NodeId};
use crate::monitor::Part;
use crate::optimize::{Evening, smooth};
use crate::{Cancelled, Monitor};

/// A way to make room: so many rings of cells around what is far are evened out, or only the worst of them smoothed; what is far
/// stays where it is, or slides.
#[derive(Clone, Copy, Debug)]
struct Way {
    rings: usize,
    evens: bool,
    stays: bool,
}

/// The ways in their order; the first follows the last.
const WAYS: [Way; 4] = [
    Way { rings: 2, evens: false, stays: true },
    Way { rings: 2, evens: false, stays: false },
    Way { rings: 4, evens: true, stays: true },
    Way { rings: 4, evens: true, stays: false },
];

/// So many rounds of making room at most.
const ROUNDS: usize = 12;

/// A round, or a place in one, brought something if they are nearer than before by this share.
const GAIN: f64 = 0.01;

/// A trial ends after so many rounds if they all brought less than this share of what mesh and solid were apart before them.
const TRIAL: usize = 3;
const PROMISE: f64 = 0.05;

/// Rings of cells around what is farther than enough within which nodes come nearer, and around those that are looked at meanwhile.
const RINGS: [usize; 2] = [12, 6];

/// What is farther than this share of the farthest is not evened out in the end.
const CLOSE: f64 = 0.6;

/// The share of the work that is done before room is made, and before the end.
const ROOM: f64 = 0.2;
const LAST: f64 = 0.9;

/// How near to go.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ApproachOptions {
    /// How near mesh and solid are brought to each other, in model units.
    pub near: f64,
    /// The least scaled Jacobian that is left in cells that have a greater one; no more than a good one is asked for.
    pub fair: f64,
    /// It ends after so many rounds that brought nothing where they are farthest, sooner if no way of making room moved
    /// anything at all.
    pub patience: usize,
    /// Is there something else to try, so that it ends where the first rounds bring hardly anything?
    pub is_trial: bool,
    /// How far mesh and solid may be from each other, in model units: nodes leave where they belong by half of that at most, if
    /// they are not farther already.
    pub max_distance: f64,
}

impl Fitted {
    /// Brings mesh and solid as near to each other as the `options` say, as far as that is possible with cells that they call
    /// fair: `mesh` and `on` are as the fit left them, and the `survey` is one of them. Returns what came of the fit with that, and
    /// whether it ended as a trial that brought hardly anything.
    ///
    /// # Errors
    /// [`Cancelled`] when the monitor says so; nodes that have moved by then stay where they are.
    pub fn approach(
        &self,
        mesh: &mut HexMesh,
        on: &Correspondence,
        survey: &mut Survey,
        options: &ApproachOptions,
        monitor: &dyn Monitor,
    ) -> Result<(FitReport, bool), Cancelled> {
        let &ApproachOptions { max_distance, near: enough, fair, .. } = options;
        let evening = Evening::ALL[0];
        let terms = Terms { leave: 0.5 * max_distance, evening, enough, fair: fair.min(GOOD) };
        survey.renew(mesh, monitor)?;
        let (mut sweeps, mut gave_up) = (self.report.sweeps, false);
        if survey.farthest() > enough {
            let (quads, heeded) = around(mesh, on, survey, enough, monitor)?;
            let faces = quads.iter().map(|&k| on.faces[k as usize]).collect();
            let part = Correspondence { faces, ..on.clone() };
            let survey_of_part = survey.part(&quads, heeded, monitor)?;
            let mut there = There { on: &part, holds: &self.holds, terms, survey: survey_of_part };
            let more;
            (more, gave_up) = there.approach(mesh, options, monitor)?;
            sweeps += more;
            survey.renew(mesh, monitor)?;
        }
        let apart = survey.farthest();
        let off = off(mesh, on, &self.holds, &OnSolid::new(survey.solid, &on.reduction));
        let (worst, mean) = quality(mesh);
        let taken_back = self.report.taken_back;
        Ok((FitReport { taken_back, sweeps, off, worst, mean, inverted: Vec::new(), apart }, gave_up))
    }
}

/// The quads around those that are farther from the solid than `least`, those within which nodes come nearer first, and how many
/// these are.
fn around(
    mesh: &HexMesh,
    on: &Correspondence,
    survey: &Survey,
    least: f64,
    monitor: &dyn Monitor,
) -> Result<(Vec<u32>, usize), Cancelled> {
    let mut is_near = vec![false; mesh.positions.len()];
    mark(&mut is_near, (&on.faces, &survey.distances), least, true);
    let (mut quads, mut heeded) = (Vec::new(), 0);
    let mut taken = vec![false; mesh.positions.len()];
    for rings in RINGS {
        heeded = quads.len();
        widen(mesh, &mut is_near, rings, monitor)?;
        let is_in = |quad: &[NodeId; 4], marks: &[bool]| quad.iter().all(|n| marks[n.index()]);
        let new = (0..).zip(&on.faces).filter(|(_, (quad, _))| is_in(quad, &is_near) && !is_in(quad, &taken));
        quads.extend(new.map(|(k, _)| k));
        taken.clone_from(&is_near);
    }
    Ok((quads, heeded))
}

/// What is near enough to what is far to be looked at.
struct There<'a> {
    /// Where the nodes of the mesh stand for what; of its boundary these quads alone, of which the survey is.
    on: &'a Correspondence,
    holds: &'a [Hold],
    terms: Terms,
    survey: Survey<'a>,
}

impl There<'_> {
    /// Brings mesh and solid nearer to each other, and makes room for that until they are near enough or as many rounds as the
    /// `options` say brought nothing where they are farthest. Returns the number of sweeps, and whether it ended as a trial.
    fn approach(
        &mut self,
        mesh: &mut HexMesh,
        options: &ApproachOptions,
        monitor: &dyn Monitor,
    ) -> Result<(usize, bool), Cancelled> {
        let part = |from: f64, to: f64| Part {
            whole: monitor,
            stage: FITTING,
            range: [from, to].map(|share| APPROACH + (1.0 - APPROACH) * share),
        };
        let at_first = mesh.positions.clone();
        let mut came = near(mesh, self.on, self.holds, &mut self.survey, self.terms, &part(0.0, ROOM))?;
        let promising = (1.0 - PROMISE) * came.apart;
        let (mut in_vain, mut idle, mut gave_up) = (0, 0, false);
        for round in 0..ROUNDS {
            let way = WAYS[round % WAYS.len()];
            // Where no way moved anything, none ever will.
            if came.apart <= self.terms.enough || in_vain == options.patience || idle == WAYS.len() {
                break;
            }
            gave_up = options.is_trial && round == TRIAL && came.apart > promising;
            if gave_up {
                break;
            }
            let from = |round: usize| ROOM + (LAST - ROOM) * round as f64 / ROUNDS as f64;
            let part = part(from(round), from(round + 1));
            let was = came.apart;
            let room = |this: &Self, mesh: &mut HexMesh, far: &[bool], monitor: &dyn Monitor| {
                this.make_room(mesh, far, way, monitor)
            };
            let has_moved;
            (came, has_moved) = self.again(mesh, came, 1.0 - GAIN, &room, &part)?;
            idle = if has_moved { 0 } else { idle + 1 };
            in_vain = if came.apart < (1.0 - GAIN) * was { 0 } else { in_vain + 1 };
        }
        let mut moves: Vec<bool> = mesh.positions.iter().zip(&at_first).map(|(p, q)| p != q).collect();
        if !moves.contains(&true) {
            return Ok((came.sweeps, gave_up));
        }
        let part = part(LAST, 1.0);
        self.survey.renew(mesh, monitor)?;
        mark(&mut moves, (&self.on.faces, &self.survey.distances), CLOSE * came.apart, false);
        let settle = |this: &Self, mesh: &mut HexMesh, _: &[bool], monitor: &dyn Monitor| {
            this.even(mesh, &|n| moves[n.index()], monitor)
        };
        let (came, _) = self.again(mesh, came, 1.0, &settle, &part)?;
        Ok((came.sweeps, gave_up))
    }

    /// Smooths cells around nodes that are `far` in a way. Returns the number of sweeps.
    fn make_room(
        &self,
        mesh: &mut HexMesh,
        far: &[bool],
        way: Way,
        monitor: &dyn Monitor,
    ) -> Result<usize, Cancelled> {
        let mut moves = far.to_vec();
        widen(mesh, &mut moves, way.rings, monitor)?;
        if way.evens {
            return self.even(mesh, &|n| moves[n.index()] && !(way.stays && far[n.index()]), monitor);
        }
        let is_moved = |n: NodeId| moves[n.index()];
        sliding(mesh, self.on, self.holds, self.survey.solid, &is_moved, monitor, &|problem, guide| {
            if way.stays {
                (0..far.len()).filter(|&n| far[n]).for_each(|n| guide.holds[n] = Hold::Pinned);
            }
            smooth(problem, guide, &SMOOTHING, None, monitor)
        })
    }

    /// Evens out the cells around the nodes that move. Returns the number of sweeps.
    fn even(
        &self,
        mesh: &mut HexMesh,
        moves: &(dyn Fn(NodeId) -> bool + Sync),
        monitor: &dyn Monitor,
    ) -> Result<usize, Cancelled> {
        even(mesh, self.on, self.holds, self.survey.solid, self.terms.evening, moves, monitor)
    }

    /// Moves what gives room, brings nearer what is far, and takes back what did not help: of what was apart no more than a share
    /// is to be left. Returns what came of all until then, and whether any node is elsewhere now.
    fn again(
        &mut self,
        mesh: &mut HexMesh,
        came: Nearness,
        share: f64,
        room: Room<'_, Self>,
        monitor: &dyn Monitor,
    ) -> Result<(Nearness, bool), Cancelled> {
        let before = mesh.positions.clone();
        self.survey.renew(mesh, monitor)?;
        let was = self.survey.distances.clone();
        let half = |range| Part { whole: monitor, stage: FITTING, range };
        let room = room(self, mesh, &came.far, &half([0.0, 0.5]))?;
        let now = near(mesh, self.on, self.holds, &mut self.survey, self.terms, &half([0.5, 1.0]))?;
        self.survey.renew(mesh, monitor)?;
        keep_nearer(mesh, &before, (&self.on.faces, &was, &self.survey.distances), share);
        self.survey.renew(mesh, monitor)?;
        let sweeps = came.sweeps + room + now.sweeps;
        let apart = self.survey.farthest();
        if apart > came.apart {
            mesh.positions = before;
            return Ok((Nearness { sweeps, ..came }, false));
        }
        let far = far(mesh, self.on, self.holds, &self.survey, SHARE * apart);
        Ok((Nearness { sweeps, apart, far, ..came }, mesh.positions != before))
    }
}

/// What gives room to nodes that are far. Returns the number of sweeps.
type Room<'a, T> = &'a dyn Fn(&T, &mut HexMesh, &[bool], &dyn Monitor) -> Result<usize, Cancelled>;

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::super::target::Target;
    use super::super::testing::{farthest, held, house};
    use super::*;
    use crate::Silent;
    use crate::geometry::Point;
    use crate::hexing::correspondence::correspond;
    use crate::mesh::{GridOptions, hex_grid};
    use crate::solid::testing::{cuboid, solid};

    /// Distance, worst cell and sweeps.
    type Came = (f64, f64, usize);

    /// What comes of approaching with a house whose ridge turns so much that good cells do not follow it.
    fn approached(aside: f64, near: f64, fair: f64) -> Came {
        approached_with(aside, near, fair, 5, false).0
    }

    /// The same with other patience, or as a trial, and whether that was given up.
    fn approached_with(aside: f64, near: f64, fair: f64, patience: usize, is_trial: bool) -> (Came, bool) {
        let (solid, mut mesh) = house(aside);
        let on = correspond(&mesh, &solid, &Silent).unwrap();
        let target = OnSolid::new(&solid, &on.reduction);
        for (place, &anchor) in mesh.positions.iter_mut().zip(&on.anchors) {
            *place = target.foot(anchor, *place).map_or(*place, |foot| foot.point);
        }
        assert!(farthest(&mesh, &on, &solid) > 0.07);
        let fitted = Fitted { report: FitReport::default(), holds: held(&on) };
        let options = ApproachOptions { near, fair, patience, is_trial, max_distance: f64::INFINITY };
        let mut survey = Survey::new(&mesh, &on.faces, &solid);
        let (report, gave_up) = fitted.approach(&mut mesh, &on, &mut survey, &options, &Silent).unwrap();
        assert_eq!((report.worst, report.mean), quality(&mesh));
        assert_eq!(report.off, []);
        ((farthest(&mesh, &on, &solid), report.worst.unwrap(), report.sweeps), gave_up)
    }

    #[test]
    fn cells_become_fair_for_the_sake_of_distance() {
        let (near, enough) = (0.06, 0.033);
        let [(good, best, _), (fair, worst, _)] = [GOOD, 0.36].map(|least| approached(0.5, enough, least));
        assert!(good <= near && best >= GOOD, "{good} {best}");
        assert!(fair <= near && (0.36..GOOD).contains(&worst), "{fair} {worst}");
        assert!(fair < good, "{fair} {good}");
        // Good is all that is ever asked for.
        assert_eq!(approached(0.5, enough, 0.6), approached(0.5, enough, GOOD));
    }

    #[test]
    fn what_is_near_enough_stays_as_it_is() {
        let (before, good, none) = approached(0.5, 1.0, GOOD);
        assert!(before > 0.07 && none == 0, "{before} {good} {none}");
    }

    #[test]
    fn room_is_made_where_they_stay_apart() {
        let (alone, _, few) = approached(0.65, 0.1, GOOD);
        let (with_room, best, many) = approached(0.65, 0.03, GOOD);
        assert!(with_room < 0.95 * alone && best >= GOOD && many > few, "{with_room} {alone} {best}");
    }

    #[test]
    fn it_ends_once_every_way_was_tried_in_vain() {
        let [hasty, patient, more] =
            [2, 4, 9].map(|patience| approached_with(0.3, 0.03, GOOD, patience, false).0);
        assert!(hasty.0 == patient.0 && hasty.2 < patient.2, "{hasty:?} {patient:?}");
        assert_eq!(patient, more);
    }

    #[test]
    fn a_trial_is_given_up_where_it_brings_hardly_anything() {
        let made = |aside: f64| [false, true].map(|is_trial| approached_with(aside, 0.03, GOOD, 5, is_trial));
        let [(whole, _), (tried, gave_up)] = made(0.3);
        assert!(gave_up && tried.0 == whole.0 && tried.2 < whole.2, "{tried:?} {whole:?}");
        let [whole, tried] = made(0.65);
        assert!(!tried.1 && tried == whole, "{tried:?} {whole:?}");
    }

    /// A node at the end of a bar is off.
    #[test]
    fn what_is_heeded_is_near_what_is_too_far_and_more_is_seen() {
        let solid = solid(&cuboid([40, 1, 1]));
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: true, max_hexes: 100 };
        let mut mesh = hex_grid(solid.bounds(), &options).unwrap();
        let on = correspond(&mesh, &solid, &Silent).unwrap();
        let end = mesh.positions.iter_mut().find(|p| **p == Point::ZERO).unwrap();
        end.y = -0.2;
        let mut survey = Survey::new(&mesh, &on.faces, &solid);
        survey.renew(&mesh, &Silent).unwrap();
        let (quads, heeded) = around(&mesh, &on, &survey, 0.1, &Silent).unwrap();
        let ends_at = |quads: &[u32]| {
            let nodes = quads.iter().flat_map(|&k| on.faces[k as usize].0);
            nodes.map(|n| mesh.positions[n.index()].x).fold(0.0, f64::max)
        };
        // The quads that are too far end at 1.
        assert_eq!(ends_at(&quads[..heeded]), (1 + RINGS[0]) as f64);
        assert_eq!(ends_at(&quads), (1 + RINGS[0] + RINGS[1]) as f64);
        let mut part = survey.part(&quads, heeded, &Silent).unwrap();
        let faces = quads.iter().map(|&k| on.faces[k as usize]).collect();
        let part_of = Correspondence { faces, ..on.clone() };
        let farthest = survey.farthest();
        let is_far =
            |survey: &Survey| far(&mesh, &part_of, &held(&on), survey, SHARE * farthest).contains(&true);
        assert!(is_far(&part));
        part.heeded = 0;
        assert!(!is_far(&part) && part.farthest() == farthest);
    }
}
