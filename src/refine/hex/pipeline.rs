//! Conforming refinement of hex meshes, from the input to the result (section 3).
//!
//! 1. Decide what to refine and close the trees ([`HexPlan`]).
//! 2. Level by level, coarse to fine, on the positions as they are: refine what the trees refine, with the
//!    transitions of the method (`stage`), then untangle and smooth these (`attempt`), and mend what that leaves
//!    poor (`poor`).
//! 3. Where an interface cannot be separated, or a hex stays inside out, refine the coarse elements there too and go back
//!    to the coarsest level that this changes. Each time the trees grow, so that this ends; it is given up after
//!    [`MOST_RESTARTS`].
//!
//! **Promises.** The mesh conforms and is a manifold with boundary if the input is one; every hex has a positive
//! Jacobian, at its corners and inside. Boundary nodes stay on the input's boundary faces, its ridges and its corners, and
//! nodes between materials and on groups of faces between hexes on these faces of the input. Of meshes that were made to be cut
//! ([`StageMesh::has_free_boundary`]) nodes of the transitions may leave the boundary, and its parts touch.

use std::sync::Mutex;

use super::attempt::{Attempt, attempt};
use super::input::boundary_surface;
use super::options::{Growth, HexOptions, HexRefineError, Method, RefinedHexes, check_size};
use super::plan::{Decided, HexPlan, INSEPARABLE};
use super::stage::{NO_ELEMENT, StageMesh, StageReport, StageResult};
use crate::geometry::Point;
use crate::mesh::HexMesh;
use crate::optimize::BoundarySurface;
use crate::{Cancelled, Monitor, Stage};

/// Refines a hex mesh.
///
/// # Errors
/// See [`HexRefineError`]; nothing is returned in part.
///
/// ```
/// use hexmill::Silent;
/// use hexmill::geometry::{Aabb, Point};
/// use hexmill::mesh::{GridOptions, check_hexes, hex_grid};
/// use hexmill::refine::hex::{HexOptions, refine_hexes};
/// use hexmill::sizing::{Region, Shape, Target};
///
/// let grid = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 64 };
/// let cube = hex_grid(Aabb { min: Point::ZERO, max: Point::splat(3.0) }, &grid)?;
/// let ball = Shape::Sphere { center: Point::splat(1.5), radius: 0.2 };
/// let options = HexOptions { regions: vec![Region { shape: ball, target: Target::Level(2) }], ..HexOptions::default() };
/// let refined = refine_hexes(&cube, &options, &Silent)?;
/// assert!(check_hexes(&refined.mesh).is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn refine_hexes(
    input: &HexMesh,
    options: &HexOptions,
    monitor: &dyn Monitor,
) -> Result<RefinedHexes, HexRefineError> {
    HexPlan::new(input, options, monitor)?.carry_out(monitor)
}

/// Stages that are made again because more must be refined, at most: hexes that cannot be untangled by then are those
/// of a mesh that is too distorted.
const MOST_RESTARTS: usize = 64;

/// A mesh between stages is kept for restarts as long as it has less than this share of the hexes of the next.
const KEPT: usize = 4;

impl HexPlan<'_> {
    /// Makes the mesh.
    ///
    /// # Errors
    /// If the transitions bring the mesh over the limit of hexes or cannot be untangled, or the monitor stops it.
    pub fn carry_out(mut self, monitor: &dyn Monitor) -> Result<RefinedHexes, HexRefineError> {
        let monitor = &Rising { inner: monitor, told: Mutex::default() };
        let mut made = Made::before(&self, monitor)?;
        if self.outline.is_some() {
            let surface = match self.has_free_boundary {
                true => BoundarySurface::default(),
                false => boundary_surface(&self.input, monitor)?,
            };
            let mut restarts = 0;
            while let Some(attempt) = self.next_stage(&made, &surface, monitor)? {
                let (hexes, tangled) = match attempt {
                    Attempt::Made(next) => {
                        made.push(*next);
                        continue;
                    }
                    Attempt::Conflict(hexes) => (hexes, None),
                    Attempt::Tangled { coarse, hexes } => (coarse, Some(hexes)),
                };
                if self.options.growth == Growth::Refuse {
                    return Err(growth_refused(&made, &hexes, tangled.is_some()));
                }
                restarts += 1;
                let more = self.refine_too(made.number, &elements_of(&made.mesh, &hexes), monitor)?;
                if more.elements == 0 || restarts > MOST_RESTARTS {
                    return Err(match tangled {
                        Some(count) => HexRefineError::Tangled(count),
                        None => HexRefineError::NoTemplate(hexes.len()),
                    });
                }
                *(if tangled.is_some() { &mut self.added.repairs } else { &mut self.added.conflicts }) +=
                    more.elements;
                made.back_to(more.coarsest, &self, monitor)?;
            }
        }
        let Self { input, added, decided, .. } = self;
        let Decided { capped, turned, .. } = decided;
        let Made { mesh, reports: stages, .. } = made;
        Ok(RefinedHexes { added, capped, turned, stages, ..RefinedHexes::new(&input, mesh) })
    }

    /// The next stage, if there is one: refines what the trees refine of the next level.
    fn next_stage(
        &self,
        made: &Made,
        surface: &BoundarySurface,
        monitor: &dyn Monitor,
    ) -> Result<Option<Attempt>, HexRefineError> {
        let Some(outline) = self.outline.as_ref().filter(|outline| made.number < outline.refined.len())
        else {
            return Ok(None);
        };
        let (number, mesh) = (made.number, &made.mesh);
        let monitor = &OfLevel { inner: monitor, number, last: outline.refined.len() };
        let is_refined = outline.is_refined(number, self.input.hexes.len());
        let of_hex = |h: usize| {
            let element = mesh.element[h];
            usize::from(mesh.level[h]) == number && element != NO_ELEMENT && is_refined[element as usize]
        };
        let refined: Vec<bool> = (0..mesh.hexes.len()).map(of_hex).collect();
        drop(is_refined);
        let method = match self.options.method {
            // What the plan refines can be grouped.
            Method::Auto => Method::Two,
            method => method,
        };
        let mut attempt = attempt(mesh, &refined, method, surface, monitor)?;
        if let Attempt::Made(next) = &mut attempt {
            check_size(&self.options, number as u8 + 1, next.mesh.hexes.len() as u64)?;
            number_as_trees(next, mesh, &outline.refined[number], outline.children);
        }
        Ok(Some(attempt))
    }
}

/// What the stages have made so far.
struct Made {
    /// The mesh before the stage of level `number`.
    mesh: StageMesh,
    number: usize,
    reports: Vec<StageReport>,
    /// Meshes before earlier stages, with their levels.
    kept: Vec<(usize, StageMesh)>,
}

impl Made {
    /// Nothing but the plan's input; its hexes know how they stand in blocks, if they do.
    fn before(plan: &HexPlan, monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let mut mesh = StageMesh::of_mesh(&plan.input, monitor)?;
        mesh.has_free_boundary = plan.has_free_boundary;
        if let Some(blocks) = plan.blocks {
            mesh.octant.clone_from(&blocks.octant);
        }
        Ok(Self { mesh, number: 0, reports: Vec::new(), kept: Vec::new() })
    }

    fn push(&mut self, next: StageResult) {
        let before = std::mem::replace(&mut self.mesh, next.mesh);
        if KEPT * before.hexes.len() < self.mesh.hexes.len() {
            self.kept.push((self.number, before));
        }
        self.number += 1;
        self.reports.push(next.report);
    }

    /// Goes back to the mesh before the stage of level `number`, or to an earlier one.
    fn back_to(&mut self, number: usize, plan: &HexPlan, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        while self.number > number {
            match self.kept.pop() {
                Some((kept, mesh)) => (self.number, self.mesh) = (kept, mesh),
                None => *self = Self::before(plan, monitor)?,
            }
        }
        self.reports.truncate(self.number);
        Ok(())
    }
}

/// Hexes of the mesh would have to be refined, and nothing asks for it.
fn growth_refused(made: &Made, hexes: &[u32], are_tangled: bool) -> HexRefineError {
    let mesh = &made.mesh;
    let centre =
        |&h: &u32| mesh.hexes[h as usize].iter().map(|n| mesh.positions[n.index()]).sum::<Point>() / 8.0;
    HexRefineError::GrowthRefused {
        elements: hexes.len(),
        level: made.number as u8,
        reason: if are_tangled { "where transition hexes stay inside out" } else { INSEPARABLE },
        near: hexes.first().map(centre).unwrap_or_default(),
    }
}

/// The elements that hexes of a mesh are.
fn elements_of(mesh: &StageMesh, hexes: &[u32]) -> Vec<u32> {
    hexes.iter().map(|&h| mesh.element[h as usize]).filter(|&e| e != NO_ELEMENT).collect()
}

/// Gives the children that a stage made the numbers that they have in the trees, where families stand in the order in
/// which elements were refined.
fn number_as_trees(next: &mut StageResult, before: &StageMesh, refined: &[u32], children: usize) {
    let count = refined.iter().max().map_or(0, |&most| most as usize + 1);
    let mut rank = vec![0; count];
    for (k, &element) in refined.iter().enumerate() {
        rank[element as usize] = k as u32;
    }
    let children = children as u32;
    for (h, &from) in next.from.iter().enumerate().take(next.first_transition) {
        if next.mesh.level[h] > before.level[from as usize] {
            let family = rank[before.element[from as usize] as usize];
            next.mesh.element[h] = children * family + next.mesh.element[h] % children;
        }
    }
}

/// Tells the progress of one level's stages as a part of all levels'.
struct OfLevel<'a> {
    inner: &'a dyn Monitor,
    number: usize,
    last: usize,
}

impl Monitor for OfLevel<'_> {
    fn progress(&self, stage: Stage, fraction: f64) {
        self.inner.progress(stage, (self.number as f64 + fraction) / self.last as f64);
    }

    fn cancelled(&self) -> bool {
        self.inner.cancelled()
    }
}

/// Keeps progress from falling where the work begins again, of which it goes on to tell.
struct Rising<'a> {
    inner: &'a dyn Monitor,
    told: Mutex<Vec<(Stage, f64)>>,
}

impl Monitor for Rising<'_> {
    fn progress(&self, stage: Stage, fraction: f64) {
        let mut told = self.told.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        let place = told.iter().position(|(known, _)| *known == stage).unwrap_or(told.len());
        if place == told.len() {
            told.push((stage, fraction));
        }
        let most = &mut told[place].1;
        *most = most.max(fraction);
        self.inner.progress(stage, *most);
    }

    fn cancelled(&self) -> bool {
        self.inner.cancelled()
    }
}
