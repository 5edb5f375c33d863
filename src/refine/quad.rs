//! Algorithm 1: conforming refinement of quadrilateral meshes (Ebeida et al., section 2).
//!
//! 1. Refine every element of level 0 once; this tells edge nodes from the others (`forest::base`).
//! 2. Level by level, refine the elements that the sizing asks for (`sizing`).
//! 3. Strongly balance the forest (`forest::balance`).
//! 4. Apply a transition template to each element with active edge nodes (`conform`).
//!
//! **Promises.** The mesh conforms on every surface, open, closed or non-manifold; no node is unused, none is
//! repeated in a quad. From squares all angles are from 45 to 135 degrees. Orientation, Euler characteristic,
//! and on planar faces the area are the input's.
//!
//! **Refuses** surfaces with invalid faces, options out of range, and results over the limit of quads; the limit
//! is held against an estimate before the work, and against the count before each level is made.
//!
//! **Departures from the paper.** Polygons are welcome: an n-gon's first refinement makes n quads. If nothing is
//! to be refined, an all-quad mesh comes back as it is. Coarse quads can be kept (see `forest::base`).

use super::conform::conform;
use super::demand::{Demand, corner_quads, face_points, outline};
use super::estimate::refuse_absurd;
use super::options::{QuadOptions, RefineError, RefinedQuads};
use super::targets::{exceeds, first_bad_target};
use crate::forest::QuadForest;
use crate::geometry::Point;
use crate::mesh::{FaceId, NodeId, PolygonMesh};
use crate::{Cancelled, Monitor, Stage, parallel};

/// Elements are split in batches of this many, so that the monitor is asked several times a second.
const BATCH: usize = 1 << 20;

const REFINE: Stage = Stage("refine");
const BALANCE: Stage = Stage("balance");

/// Refines `input` to a conforming quad mesh.
///
/// # Errors
/// See [`RefineError`]; nothing is returned in part.
pub fn refine_quads(
    input: &PolygonMesh,
    options: &QuadOptions,
    monitor: &dyn Monitor,
) -> Result<RefinedQuads, RefineError> {
    refuse_absurd(input, &Demand::new(input, options, monitor)?, options, monitor)?;
    refine_within(input, options, monitor)
}

/// Refines `input`, and stops as soon as the limit of quads is passed.
pub(super) fn refine_within(
    input: &PolygonMesh,
    options: &QuadOptions,
    monitor: &dyn Monitor,
) -> Result<RefinedQuads, RefineError> {
    let mut refinement = QuadRefinement::new(input, options, monitor)?;
    while refinement.advance(None, monitor)? {}
    refinement.finish(monitor)
}

/// Refinement a level at a time, for callers that decide between levels how fine each element is to be.
pub struct QuadRefinement<'a> {
    input: &'a PolygonMesh,
    options: &'a QuadOptions,
    demand: Demand,
    /// The deepest level that the options call for.
    deepest: u8,
    /// None while the input's faces wait for the first decision.
    forest: Option<QuadForest>,
    /// Elements of the deepest level that would have been refined further, were it not for `max_levels`.
    capped: usize,
}

/// The elements of the deepest level, as a caller's size function wants them.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Candidates {
    /// The mean of each element's nodes.
    pub centers: Vec<Point>,
    /// The length of each element's longest edge.
    pub longest: Vec<f64>,
}

impl<'a> QuadRefinement<'a> {
    /// Checks input and options and prepares the sizing.
    ///
    /// # Errors
    /// If the input is no valid surface, an option is out of range, or the monitor stops it.
    pub fn new(
        input: &'a PolygonMesh,
        options: &'a QuadOptions,
        monitor: &dyn Monitor,
    ) -> Result<Self, RefineError> {
        let demand = Demand::new(input, options, monitor)?;
        let forest = if options.keep_coarse { Some(QuadForest::coarse(input, monitor)?) } else { None };
        let deepest = demand.deepest(options.max_levels);
        Ok(Self { input, options, demand, deepest, forest, capped: 0 })
    }

    /// The elements that the next [`advance`](Self::advance) decides on: the input's faces at first, then the
    /// elements that the last one made.
    pub fn candidates(&self) -> Candidates {
        let (centers, longest) = match &self.forest {
            None => parallel::collect(self.input.face_count(), |f| outline(&face_points(self.input, f))),
            Some(forest) => {
                let elements = last_elements(forest);
                parallel::collect(elements.len(), |e| outline(&corners(&forest.positions, &elements[e])))
            }
        }
        .into_iter()
        .unzip();
        Candidates { centers, longest }
    }

    fn candidate_count(&self) -> usize {
        self.forest.as_ref().map_or(self.input.face_count(), |forest| last_elements(forest).len())
    }

    /// Refines the candidates that options or `targets` ask for; `targets` holds the greatest edge length allowed
    /// for each candidate, or infinity. Returns false when there was nothing to refine, and the work can be finished.
    ///
    /// # Errors
    /// If there is not one target above 0 for each candidate, the monitor stops it, or the mesh would become too
    /// large.
    pub fn advance(&mut self, targets: Option<&[f64]>, monitor: &dyn Monitor) -> Result<bool, RefineError> {
        if let Some(targets) = targets {
            validate_targets(targets, self.candidate_count())?;
        }
        match &self.forest {
            None => self.refine_coarse(targets, monitor),
            Some(forest) => {
                let depth = forest.levels.len() - 1;
                let level = forest.base_level + depth as u8;
                monitor.checkpoint(REFINE, self.share_of_work(level))?;
                let marked = self.marked(forest, targets, monitor)?;
                if level >= self.options.max_levels {
                    self.capped = marked.len();
                    return Ok(false);
                }
                self.split(&marked, monitor)
            }
        }
    }

    /// Balances the forest, applies the templates, and returns the mesh.
    ///
    /// # Errors
    /// If the monitor stops it, or balance and templates make the mesh too large.
    pub fn finish(self, monitor: &dyn Monitor) -> Result<RefinedQuads, RefineError> {
        let mut forest = match self.forest {
            Some(forest) => forest,
            None => QuadForest::untouched(self.input, monitor)?,
        };
        monitor.checkpoint(BALANCE, 0.0)?;
        forest.balance(monitor)?;
        monitor.checkpoint(BALANCE, 1.0)?;
        let refined = conform(forest, &self.input.tags, self.options.max_quads, monitor)?;
        Ok(RefinedQuads { capped: self.capped, ..refined })
    }

    /// The first decision: refine every face of the input once, or leave all of them.
    fn refine_coarse(&mut self, targets: Option<&[f64]>, monitor: &dyn Monitor) -> Result<bool, RefineError> {
        monitor.checkpoint(REFINE, 0.0)?;
        let input = self.input;
        let wants = |f: usize| {
            let points = face_points(input, f);
            let (_, longest) = outline(&points);
            exceeds(targets, f, longest) || self.wants_face(f, &points, longest)
        };
        let wanted = parallel::try_any(input.face_count(), monitor, wants)?;
        let all_quad = input.is_all_quad();
        if all_quad && !(wanted && self.options.max_levels > 0) {
            self.capped = if wanted { input.face_count() } else { 0 };
            return Ok(false);
        }
        check_size(self.options, 1, input.corners.len() as u64)?;
        let mut forest = QuadForest::refined_once(input, monitor)?;
        let levels = self.demand.uniform_levels_from(forest.base_level, self.options.max_levels);
        let quads = input.corners.len() as f64 * 4_f64.powi(levels.into());
        if quads <= self.options.max_quads as f64 {
            forest.expect_levels(levels, monitor)?;
        }
        self.forest = Some(forest);
        Ok(true)
    }

    /// True if some part of face `f` is wanted finer.
    fn wants_face(&self, f: usize, points: &[Point], longest: f64) -> bool {
        corner_quads(points).any(|corners| self.demand.wants(corners, longest, 0, FaceId::new(f)))
    }

    /// The elements of the deepest level that options or `targets` want finer.
    fn marked(
        &self,
        forest: &QuadForest,
        targets: Option<&[f64]>,
        monitor: &dyn Monitor,
    ) -> Result<Vec<u32>, Cancelled> {
        let level = forest.levels.last().expect("a forest has a base level");
        let number = forest.base_level + (forest.levels.len() - 1) as u8;
        if self.demand.is_uniform_at(number) {
            return Ok((0..level.elements.len() as u32).collect());
        }
        if targets.is_none() && self.demand.is_idle_from(number) {
            return Ok(Vec::new());
        }
        let wants = |e: usize| {
            let corners = corners(&forest.positions, &level.elements[e]);
            let (_, longest) = outline(&corners);
            exceeds(targets, e, longest) || self.demand.wants(corners, longest, number, level.root(e))
        };
        parallel::try_filter(level.elements.len(), monitor, wants)
    }

    /// Splits elements of the deepest level, if the limit allows it.
    fn split(&mut self, marked: &[u32], monitor: &dyn Monitor) -> Result<bool, RefineError> {
        let forest = self.forest.as_ref().expect("the forest that was marked");
        let depth = forest.levels.len() - 1;
        let level = forest.base_level + depth as u8 + 1;
        let quads = forest.leaf_count() as u64 + 3 * marked.len() as u64;
        check_size(self.options, level, quads)?;
        if marked.is_empty() {
            return Ok(false);
        }
        let (from, to) = (self.share_of_work(level - 1), self.share_of_work(level));
        let forest = self.forest.as_mut().expect("the forest that was marked");
        forest.expect(depth, marked.len(), monitor)?;
        for (k, batch) in marked.chunks(BATCH).enumerate() {
            let share = (k * BATCH) as f64 / marked.len() as f64;
            monitor.checkpoint(REFINE, from + share * (to - from))?;
            forest.split(depth, batch, monitor)?;
        }
        Ok(true)
    }

    /// How much of the refinement is done once all elements of `level` are made: each level is about four times
    /// the work of the one before. A caller's targets may lead deeper than was expected.
    fn share_of_work(&self, level: u8) -> f64 {
        0.25_f64.powi(i32::from(self.deepest) - i32::from(level)).min(1.0)
    }
}

/// Refuses a mesh of more quads than the options allow.
fn check_size(options: &QuadOptions, level: u8, quads: u64) -> Result<(), RefineError> {
    let limit = options.max_quads;
    if quads > limit { Err(RefineError::TooManyQuads { level, quads, limit }) } else { Ok(()) }
}

/// The deepest level's elements; none of them is refined.
fn last_elements(forest: &QuadForest) -> &[[NodeId; 4]] {
    &forest.levels.last().expect("a forest has a base level").elements
}

#[inline]
fn corners(positions: &[Point], element: &[NodeId; 4]) -> [Point; 4] {
    let (at, &[a, b, c, d]) = (|n: NodeId| positions[n.index()], element);
    [at(a), at(b), at(c), at(d)]
}

/// Refuses targets that are not one length above 0 for each candidate.
fn validate_targets(targets: &[f64], candidates: usize) -> Result<(), RefineError> {
    if targets.len() != candidates {
        return Err(RefineError::TargetCount { given: targets.len(), wanted: candidates });
    }
    match first_bad_target(targets) {
        Some(candidate) => Err(RefineError::Target { candidate, value: targets[candidate] }),
        None => Ok(()),
    }
}
