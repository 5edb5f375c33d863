//! Brings mesh and solid nearer to each other where they are farthest.
//!
//! Where the solid bends within an edge the boundary cuts across, and how far depends on where its nodes stand: it is
//! nearest with nodes on the ridges. No gradient leads there, so each node there tries places around it, and towards what of the
//! solid is far: of those that keep the cells good it takes the one with the least that is apart (`Apart`). Nodes that are
//! held stay on their surface or curve; those that are off the solid go anywhere. The inside follows. What took mesh and
//! solid farther from each other in the end is taken back.

use super::super::correspondence::{Anchor, Correspondence};
use super::apart::{Apart, Probes, power};
use super::holds::Hold;
use super::rings::widen;
use super::survey::{Survey, mean_side, quads};
use super::target::{OnSolid, Target};
use super::{FITTING, LEAVE, quality};
use crate::geometry::Point;
use crate::mesh::{HexMesh, NodeId};
use crate::monitor::Part;
use crate::optimize::{
    Evening, Free, Moved, Problem, Star, Weights, even_out, keep_positive, wake, worst_kept,
};
use crate::solid::SurfaceId;
use crate::{Cancelled, Monitor, parallel};

/// What is farther apart than this share of the farthest, and than so many edges (those there, or the mean of all if that
/// is longer), is brought nearer.
pub(super) const SHARE: f64 = 0.8;
const LEAST: f64 = 0.085;

/// How often each node is tried, before what is inside follows, and how often that is done.
const TRIES: usize = 8;
const ROUNDS: usize = 6;

/// Another round is made where the farthest is so much nearer than it was before.
const ENOUGH: f64 = 0.98;

/// Another course is made where they stay apart by more than so many edges, and than this share of the solid's diagonal:
/// of small cells a share of an edge is next to nothing.
const FAR: f64 = 0.15;
const FAR_OF_SOLID: f64 = 0.0015;

/// Rings of cells around them whose inside follows.
const RINGS: usize = 2;

/// No cell is made worse than this by that, unless it is already: the less, the farther mesh and solid are apart there,
/// from `LEAST` edges to `MOST`. Nor worse than the worst of all, if that is below what is fair, or else that.
const FLOORS: [f64; 2] = [0.72, 0.35];
const MOST: f64 = 0.22;

/// Or to this share of the solid's diagonal, if that is less, but so many edges at least: how coarse a mesh is excuses no
/// distance that can be seen.
const MOST_OF_SOLID: f64 = 0.0025;
const LEAST_OF_MOST: f64 = 1.2 * LEAST;

/// What is apart has to become less by this share of it, or of what is so many edges apart if that is less: where something is far
/// that a node cannot help, it may still bring other things nearer.
const GAIN: f64 = 0.1;
const WORTH: f64 = 0.07;

/// How far places around a node are from it, in edges, and those towards a sample, as shares of the way.
const STEPS: [f64; 3] = [0.3, 0.15, 0.05];
const SHARES: [f64; 3] = [1.0, 0.5, 0.25];
const FARTHEST: usize = 8;

/// Nodes that are tried before any of them is moved.
const BATCH: usize = 256;

/// What came of it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Nearness {
    /// Sweeps over nodes.
    pub(super) sweeps: usize,
    /// How far mesh and solid were apart where they were farthest, and how far they are, in model units.
    pub(super) at_first: f64,
    pub(super) apart: f64,
    /// The nodes where they are too far.
    pub(super) far: Vec<bool>,
}

impl Nearness {
    /// Is another course worth its while, with edges of that length and a solid of that diagonal? Not where nodes found
    /// hardly better places than they had.
    pub(super) fn calls_for_more(&self, edge: f64, diagonal: f64) -> bool {
        let limit = (FAR * edge).max(FAR_OF_SOLID * diagonal);
        self.far.contains(&true) && self.apart > limit && self.apart <= ENOUGH * self.at_first
    }
}

/// What is asked of it, and what it may cost.
#[derive(Clone, Copy, Debug)]
pub(super) struct Terms {
    /// How far nodes may leave where they belong, in model units, if they are not farther already.
    pub(super) leave: f64,
    /// How what is inside follows.
    pub(super) evening: Evening,
    /// It ends when they are no farther from each other than this, in model units.
    pub(super) enough: f64,
    /// No cell is made worse than this, unless it is already.
    pub(super) fair: f64,
}

/// Moves boundary nodes where mesh and solid are farthest from each other. The `survey` may have looked at another mesh before,
/// and in the end.
pub(super) fn near(
    mesh: &mut HexMesh,
    on: &Correspondence,
    holds: &[Hold],
    survey: &mut Survey,
    terms: Terms,
    monitor: &dyn Monitor,
) -> Result<Nearness, Cancelled> {
    let solid = survey.solid;
    let target = OnSolid::new(solid, &on.reduction);
    let mut came = Nearness { sweeps: 0, at_first: f64::INFINITY, apart: f64::INFINITY, far: Vec::new() };
    let mut best = Vec::new();
    let worst = quality(mesh).0.map_or(terms.fair, |worst| worst.min(terms.fair));
    for round in 0..=ROUNDS {
        let part = |from: f64, to: f64| Part {
            whole: monitor,
            stage: FITTING,
            range: [from, to].map(|share| (round as f64 + share) / (ROUNDS + 1) as f64),
        };
        survey.renew(mesh, monitor)?;
        let farthest = survey.farthest();
        if farthest > came.apart {
            mesh.positions = best;
            break;
        }
        if round == 0 {
            came.at_first = farthest;
        }
        let is_last = round == ROUNDS || farthest > ENOUGH * came.apart || farthest <= terms.enough;
        came.far = far(mesh, on, holds, survey, SHARE * farthest);
        came.apart = farthest;
        if is_last || !came.far.contains(&true) {
            break;
        }
        best = mesh.positions.clone();
        let moves = |n: NodeId| came.far[n.index()];
        let mut problem = Problem::within(&mesh.positions, &mesh.hexes, &moves, monitor)?;
        let gaps = Apart::new(&problem, &on.faces, survey);
        let places = Places { on, holds, target: &target, apart: gaps, worst, leave: terms.leave };
        let tries = places.try_all(&mut problem, &part(0.0, 0.7))?;
        problem.write_back(&mut mesh.positions);
        if tries == 0 {
            break;
        }
        came.sweeps += tries + follow(mesh, on, &problem, terms.evening, &part(0.7, 1.0))?;
    }
    Ok(came)
}

/// The nodes of the quads that are heeded and farther than `LEAST` edges and `least`, if they may move.
pub(super) fn far(
    mesh: &HexMesh,
    on: &Correspondence,
    holds: &[Hold],
    survey: &Survey,
    least: f64,
) -> Vec<bool> {
    let quads = quads(mesh, &on.faces);
    let mut is_far = vec![false; mesh.positions.len()];
    let heeded = survey.distances.iter().take(survey.heeded);
    for (((quad, _), places), &distance) in on.faces.iter().zip(&quads).zip(heeded) {
        let edge = mean_side(places).max(survey.edge);
        if distance > least.max(LEAST * edge) {
            quad.iter().for_each(|n| is_far[n.index()] = true);
        }
    }
    let is_placed = |n: usize| holds[n] == Hold::Held && on.anchors[n].freedom() == 0;
    (0..is_far.len()).map(|n| is_far[n] && !is_placed(n)).collect()
}

/// Marks the nodes of those of the quads that are farther than this, or takes their marks.
pub(super) fn mark(
    marks: &mut [bool],
    (faces, distances): (&[([NodeId; 4], SurfaceId)], &[f64]),
    least: f64,
    marked: bool,
) {
    for ((quad, _), &distance) in faces.iter().zip(distances) {
        if distance > least {
            quad.iter().for_each(|n| marks[n.index()] = marked);
        }
    }
}

/// Smooths what is inside around the nodes that moved. Returns the number of sweeps.
fn follow(
    mesh: &mut HexMesh,
    on: &Correspondence,
    moved: &Problem,
    evening: Evening,
    monitor: &dyn Monitor,
) -> Result<usize, Cancelled> {
    let mut is_near = vec![false; mesh.positions.len()];
    moved.nodes.iter().for_each(|n| is_near[n.index()] = true);
    widen(mesh, &mut is_near, RINGS, monitor)?;
    let moves = |n: NodeId| is_near[n.index()] && on.anchors[n.index()] == Anchor::Inside;
    let mut inside = Problem::within(&mesh.positions, &mesh.hexes, &moves, monitor)?;
    let sweeps = even_out(&mut inside, &Free, evening, monitor)?;
    inside.write_back(&mut mesh.positions);
    Ok(sweeps)
}

/// The scaled Jacobian that is left where mesh and a solid of that diagonal are so far apart, all in edges.
fn floor(distance: f64, diagonal: f64) -> f64 {
    let most = MOST.min((MOST_OF_SOLID * diagonal).max(LEAST_OF_MOST));
    let share = ((distance - LEAST) / (most - LEAST)).clamp(0.0, 1.0);
    FLOORS[0] + share * (FLOORS[1] - FLOORS[0])
}

/// Where nodes may go.
struct Places<'a> {
    on: &'a Correspondence,
    holds: &'a [Hold],
    target: &'a OnSolid<'a>,
    apart: Apart<'a>,
    /// No cell is to be worse.
    worst: f64,
    /// How far nodes may leave where they belong, in model units.
    leave: f64,
}

impl Places<'_> {
    /// Tries other places for all nodes, and again for those around one that moved. Returns how often.
    fn try_all(&self, problem: &mut Problem, monitor: &dyn Monitor) -> Result<usize, Cancelled> {
        let all = vec![true; problem.movable()];
        let mut awake = all.clone();
        for tried in 0..TRIES {
            monitor.checkpoint(FITTING, tried as f64 / TRIES as f64)?;
            let (_, moved) = keep_positive(problem, &mut awake, monitor, |problem, awake| {
                self.round(problem, awake, monitor)
            })?;
            if moved.nodes.is_empty() {
                return Ok(tried);
            }
            awake.fill(false);
            wake(problem, &moved.nodes, &all, &mut awake);
        }
        Ok(TRIES)
    }

    /// Moves each node that is awake to its best place.
    fn round(
        &self,
        problem: &mut Problem,
        awake: &[bool],
        monitor: &dyn Monitor,
    ) -> Result<Moved, Cancelled> {
        let mut moved = Moved::default();
        for colour in 0..problem.colours.len() {
            let nodes: Vec<u32> =
                problem.colours[colour].iter().copied().filter(|&n| awake[n as usize]).collect();
            for batch in nodes.chunks(BATCH) {
                let best = parallel::try_collect(batch.len(), monitor, |k| {
                    self.best(problem, batch[k], &mut Star::default())
                })?;
                for (&node, to) in batch.iter().zip(best) {
                    if let Some(to) = to {
                        moved.take(problem, node, to);
                    }
                }
            }
        }
        Ok(moved)
    }

    /// The best place for a node, if that is not where it is.
    fn best(&self, problem: &Problem, node: u32, star: &mut Star) -> Option<Point> {
        let from = problem.points[node as usize];
        star.gather(problem, node, 0.0);
        let shape = Weights { doublings: 0, mu: 0.0 };
        let in_edges = |length: f64| length / problem.edge(node);
        let [apart, diagonal] = [self.apart.farthest(node), self.apart.solid.diagonal()].map(in_edges);
        let floor = floor(apart, diagonal).max(self.worst);
        let before = star.read(from, shape, f64::INFINITY)?.worst;
        let probes = self.apart.probes(problem, node);
        let mut least = probes.error - GAIN * probes.error.min(power(WORTH * problem.edge(node)));
        let id = problem.nodes[node as usize];
        let from_foot = |p: Point| {
            let foot = self.target.foot(self.on.anchors[id.index()], p);
            foot.map_or(0.0, |foot| foot.point.distance(p))
        };
        let leash = from_foot(from).max(self.leave.min(LEAVE * problem.edge(node)));
        let reach = self.apart.reach(from);
        let stays = |to: Point| match self.holds[id.index()] {
            // Planes go on beyond their surface.
            Hold::Held => self.apart.is_within(to, reach),
            Hold::Leashed => from_foot(to) <= leash,
            _ => true,
        };
        let mut best = None;
        for to in self.places(problem, node, from, &probes) {
            let after = star.read(to, shape, f64::INFINITY).map(|reading| reading.worst);
            if !after.is_some_and(|after| after <= worst_kept(before, floor)) {
                continue;
            }
            let error = self.apart.error(problem, node, to, &probes, least);
            if let Some(error) = error.filter(|_| star.stays_positive(to) && stays(to)) {
                (least, best) = (error, Some(to));
            }
        }
        best
    }

    /// Places that a node may go to.
    fn places(&self, problem: &Problem, node: u32, from: Point, probes: &Probes) -> Vec<Point> {
        let id = problem.nodes[node as usize];
        let anchor = self.on.anchors[id.index()];
        let edge = problem.edge(node);
        let is_held = self.holds[id.index()] == Hold::Held;
        let foot = self.target.foot(anchor, from);
        let mut to: Vec<Point> = Vec::new();
        let directions: Vec<Point> = match (anchor, foot) {
            (Anchor::Surface(_), Some(foot)) if is_held => {
                let (a, b) = foot.direction.any_orthonormal_pair();
                let [c, d] = [a + b, a - b].map(|v| v * std::f64::consts::FRAC_1_SQRT_2);
                vec![a, b, c, d]
            }
            (Anchor::Curve(_), Some(foot)) if is_held => vec![foot.direction],
            _ => Point::AXES.to_vec(),
        };
        for step in STEPS {
            to.extend(directions.iter().flat_map(|&v| [from + v * (step * edge), from - v * (step * edge)]));
        }
        let mut samples: Vec<Point> = probes.farthest_samples().take(FARTHEST).collect();
        if !is_held {
            samples.extend(foot.map(|foot| foot.point));
        }
        to.extend(samples.iter().flat_map(|&s| SHARES.map(|share| from.lerp(s, share))));
        if is_held {
            to.into_iter().filter_map(|p| Some(self.target.foot(anchor, p)?.point)).collect()
        } else {
            to
        }
    }
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

    use super::super::testing::{RISE, farthest, held, house};
    use super::super::{EVEN, FitOptions, GOOD, fit};
    use super::*;
    use crate::hexing::correspondence::correspond;
    use crate::hexing::sheets::insert_sheets;
    use crate::mesh::quality::scaled_jacobian;
    use crate::solid::SolidModel;
    use crate::{Silent, Stage};

    /// Brings them nearer with the first course.
    fn brought(
        mesh: &mut HexMesh,
        on: &Correspondence,
        holds: &[Hold],
        solid: &SolidModel,
        max_distance: f64,
    ) -> Nearness {
        let mut survey = Survey::new(mesh, &on.faces, solid);
        let evening = Evening::ALL[0];
        let terms = Terms { leave: 0.5 * max_distance, evening, enough: 0.0, fair: GOOD };
        near(mesh, on, holds, &mut survey, terms, &Silent).unwrap()
    }

    #[test]
    fn a_survey_that_is_renewed_is_like_a_new_one() {
        let (solid, mut mesh) = house(0.0);
        let on = correspond(&mesh, &solid, &Silent).unwrap();
        let mut survey = Survey::new(&mesh, &on.faces, &solid);
        survey.renew(&mesh, &Silent).unwrap();
        let before = survey.distances.clone();
        let moved = (0..on.anchors.len()).find(|&n| matches!(on.anchors[n], Anchor::Surface(_))).unwrap();
        mesh.positions[moved] += Point::splat(0.1);
        survey.renew(&mesh, &Silent).unwrap();
        let farthest_of_all = survey.distances.iter().copied().fold(0.0, f64::max);
        assert!(survey.distances != before && farthest_of_all == farthest(&mesh, &on, &solid));
        mesh.positions[moved] -= Point::splat(0.1);
        survey.renew(&mesh, &Silent).unwrap();
        assert_eq!(survey.distances, before);
    }

    /// A node of the part moves, and what is seen there is what is seen of all.
    #[test]
    fn a_survey_of_a_part_sees_what_that_of_all_sees_there() {
        let (solid, mut mesh) = house(0.2);
        let on = correspond(&mesh, &solid, &Silent).unwrap();
        let mut all = Survey::new(&mesh, &on.faces, &solid);
        all.renew(&mesh, &Silent).unwrap();
        let inner = |quad: &[NodeId; 4]| quad.iter().all(|n| mesh.positions[n.index()].y > 0.9);
        let quads: Vec<u32> =
            (0..on.faces.len() as u32).filter(|&k| inner(&on.faces[k as usize].0)).collect();
        assert!(quads.len() > 10 && 2 * quads.len() < on.faces.len());
        let mut part = all.part(&quads, quads.len(), &Silent).unwrap();
        let seen = |all: &Survey| quads.iter().map(|&k| all.distances[k as usize]).collect::<Vec<_>>();
        assert_eq!(part.distances, seen(&all));
        let far = mesh.bounds().max.y - 1e-9;
        let moved = (0..on.anchors.len()).find(|&n| mesh.positions[n].y > far).unwrap();
        mesh.positions[moved] += Point::splat(0.03);
        part.renew(&mesh, &Silent).unwrap();
        assert!(part.distances != seen(&all), "it sees what moved");
        all.renew(&mesh, &Silent).unwrap();
        assert_eq!((part.distances.clone(), part.farthest()), (seen(&all), all.farthest()));
    }

    #[test]
    fn nodes_slide_to_a_ridge_that_is_no_feature() {
        let (solid, mut mesh) = house(0.0);
        let on = correspond(&mesh, &solid, &Silent).unwrap();
        let before = farthest(&mesh, &on, &solid);
        assert!((0.045..0.055).contains(&before), "a fifth of an edge and more: {before}");
        assert!(brought(&mut mesh, &on, &held(&on), &solid, f64::INFINITY).sweeps > 0);
        let after = farthest(&mesh, &on, &solid);
        assert!(after < 0.4 * before, "{before} {after}");
        for (anchor, p) in on.anchors.iter().zip(&mesh.positions) {
            assert!(*anchor == Anchor::Inside || solid.nearest(*p).distance < 1e-12, "{anchor:?} {p}");
        }
        let jacobian = |hex: &[NodeId; 8]| scaled_jacobian(&hex.map(|n| mesh.positions[n.index()]));
        assert!(mesh.hexes.iter().map(jacobian).fold(1.0, f64::min) > GOOD);
    }

    /// Nodes that may leave the solid do so by no more than half of how far the mesh may be from it.
    #[test]
    fn leashes_are_as_long_as_the_distance_allowed() {
        let (solid, mut mesh) = house(0.3);
        let on = correspond(&mesh, &solid, &Silent).unwrap();
        let target = OnSolid::new(&solid, &on.reduction);
        for (place, &anchor) in mesh.positions.iter_mut().zip(&on.anchors) {
            *place = target.foot(anchor, *place).map_or(*place, |foot| foot.point);
        }
        let leashed: Vec<Hold> =
            held(&on).into_iter().map(|hold| if hold == Hold::Held { Hold::Leashed } else { hold }).collect();
        let off = |max_distance: f64| {
            let mut mesh = mesh.clone();
            brought(&mut mesh, &on, &leashed, &solid, max_distance);
            let boundary = (0..on.anchors.len()).filter(|&n| on.anchors[n] != Anchor::Inside);
            boundary.map(|n| solid.nearest(mesh.positions[n]).distance).fold(0.0, f64::max)
        };
        assert!(off(1e-4) <= 0.5e-4 + 1e-12, "{}", off(1e-4));
        assert!(off(f64::INFINITY) > 0.6e-4, "{}", off(f64::INFINITY));
    }

    #[test]
    fn what_is_near_stays_where_it_is() {
        let (solid, mut mesh) = house(0.0);
        let on = correspond(&mesh, &solid, &Silent).unwrap();
        // With nodes on the ridge there is nothing to do.
        mesh.positions.iter_mut().filter(|p| (p.x - 0.8).abs() < 1e-9).for_each(|p| {
            p.z *= (1.5 + RISE) / (1.5 + 0.8 * RISE);
            p.x = 1.0;
        });
        let before = mesh.positions.clone();
        let came = brought(&mut mesh, &on, &held(&on), &solid, f64::INFINITY);
        assert!(came.sweeps == 0 && !came.far.contains(&true) && came.apart < LEAST * 0.4, "{}", came.apart);
        assert_eq!(mesh.positions, before);
    }

    #[test]
    fn another_course_is_made_where_that_may_help() {
        let calls = |at_first: f64, apart: f64, is_far: bool, diagonal: f64| {
            Nearness { sweeps: 0, at_first, apart, far: vec![false, is_far] }.calls_for_more(1.0, diagonal)
        };
        assert!(calls(0.5, 0.16, true, 50.0));
        assert!(!calls(0.5, 0.14, true, 50.0), "near for an edge");
        assert!(!calls(0.5, 0.16, true, 110.0), "near for the solid");
        assert!(!calls(0.5, 0.16, false, 50.0), "no node that may move is far");
        assert!(!calls(0.5, 0.495, true, 50.0), "there was no better place");
    }

    #[test]
    fn cells_may_be_worse_where_mesh_and_solid_are_farther_apart() {
        let middle = 0.5 * (FLOORS[0] + FLOORS[1]);
        for (diagonal, most) in [(1e3, MOST), (0.15 / MOST_OF_SOLID, 0.15), (1.0, LEAST_OF_MOST)] {
            let least = [0.0, LEAST, 0.5 * (LEAST + most), most, 1.0].map(|apart| floor(apart, diagonal));
            let expected = [FLOORS[0], FLOORS[0], middle, FLOORS[1], FLOORS[1]];
            assert!(least.iter().zip(expected).all(|(a, b)| (a - b).abs() < 1e-12), "{diagonal}: {least:?}");
        }
    }

    /// Stops the work when it has come to the last step.
    struct AtLast(AtomicBool);

    impl Monitor for AtLast {
        fn progress(&self, _: Stage, fraction: f64) {
            self.0.fetch_or(fraction > EVEN, Relaxed);
        }

        fn cancelled(&self) -> bool {
            self.0.load(Relaxed)
        }
    }

    #[test]
    fn a_fit_that_is_stopped_at_last_leaves_no_cell_inverted() {
        let (solid, mut mesh) = house(0.1);
        let mut on = correspond(&mesh, &solid, &Silent).unwrap();
        let mut sheets = insert_sheets(&mut mesh, &mut on, &solid, &Silent).unwrap();
        let mut fitted = |mesh: &mut HexMesh, monitor: &dyn Monitor| {
            fit(mesh, &mut on, &mut sheets, &solid, &FitOptions::default(), monitor).err()
        };
        let before = mesh.positions.clone();
        assert_eq!(fitted(&mut mesh, &AtLast(AtomicBool::new(false))), Some(Cancelled));
        assert!(mesh.positions != before, "it was on its way");
        assert!(quality(&mesh).0 > Some(0.0));
        assert_eq!(fitted(&mut mesh, &Silent), None);
    }
}
