//! Conforming refinement of hex meshes, from the input to the result (section 3).
//!
//! 1. Decide what to refine and close the octree ([`HexPlan`]).
//! 2. Level by level, coarse to fine, on the positions as they are: refine what the octree refines, with the
//!    transitions of the method (`stage`), then untangle and smooth these (`optimize`).
//!    3-refinement needs no octree: there the hexes themselves are asked level by level (`thirds`).
//! 3. Where an interface cannot be separated, or a hex stays inside out, refine the coarse family there too and begin
//!    again. Each time the octree grows, so that this ends.
//!
//! **Promises.** The mesh conforms and is a manifold with boundary if the input is one; every hex has a positive
//! Jacobian, at its corners and inside. Boundary nodes stay on the input's boundary faces, its ridges and its corners.

use std::sync::Mutex;

use super::attempt::{Attempt, attempt, without_template};
use super::options::{HexOptions, HexRefineError, Method, RefinedHexes};
use super::plan::{HexPlan, check_size};
use super::stage::{NO_ELEMENT, NO_OCTANT, Stage as Refined, StageMesh, stage};
use crate::mesh::topology::hex_boundary;
use crate::mesh::{HexMesh, QuadMesh};
use crate::optimize::BoundarySurface;
use crate::{Monitor, Stage};

/// Boundary faces that meet at more than this angle meet at a ridge, in degrees.
const RIDGE_DEGREES: f64 = 30.0;

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

impl HexPlan<'_> {
    /// Makes the mesh.
    ///
    /// # Errors
    /// If the transitions bring the mesh over the limit of hexes or cannot be untangled, or the monitor stops it.
    pub fn carry_out(mut self, monitor: &dyn Monitor) -> Result<RefinedHexes, HexRefineError> {
        let monitor = &Rising { inner: monitor, told: Mutex::default() };
        let surface = boundary_surface(&self.input);
        if self.options.method == Method::Three {
            return self.in_thirds(&surface, monitor);
        }
        loop {
            match self.stages(&surface, monitor)? {
                Outcome::Done(refined) => {
                    let (capped, turned) = (self.capped, self.turned);
                    return Ok(RefinedHexes { added: self.added, capped, turned, ..refined });
                }
                Outcome::Conflict { depth, elements } => {
                    let more = self.refine_too(depth, &elements, monitor)?;
                    if more == 0 {
                        return Err(HexRefineError::NoTemplate(elements.len()));
                    }
                    self.added.conflicts += more;
                }
                Outcome::Tangled { depth, elements, hexes } => {
                    let more = self.refine_too(depth, &elements, monitor)?;
                    if more == 0 {
                        return Err(HexRefineError::Tangled(hexes));
                    }
                    self.added.repairs += more;
                }
            }
        }
    }

    /// Step 2.
    fn stages(&self, surface: &BoundarySurface, monitor: &dyn Monitor) -> Result<Outcome, HexRefineError> {
        let (options, input) = (self.options, &self.input);
        // The octree refines whole families, which can be grouped.
        let method = if options.method == Method::Auto { Method::Two } else { options.method };
        let mut mesh = StageMesh::of_input(input.positions.clone(), input.hexes.clone());
        let Some(forest) = &self.forest else {
            return Ok(Outcome::Done(RefinedHexes::new(input, mesh)));
        };
        let mut reports = Vec::new();
        let last = forest.levels.iter().take_while(|level| !level.refined.is_empty()).count();
        let everything = vec![true; mesh.hexes.len()];
        mesh = stage(&mesh, &everything, method, monitor).map_err(without_template)?.mesh;
        for (depth, level) in forest.levels[..last].iter().enumerate() {
            let monitor = &OfLevel { inner: monitor, depth, last };
            let is_refined = |h: usize| {
                let element = mesh.element[h];
                usize::from(mesh.level[h]) == depth + 1
                    && element != NO_ELEMENT
                    && level.is_refined[element as usize]
            };
            let refined: Vec<bool> = (0..mesh.hexes.len()).map(is_refined).collect();
            let mut next = match attempt(&mesh, &refined, method, surface, monitor)? {
                Attempt::Made(next) => next,
                Attempt::Conflict(hexes) => {
                    return Ok(Outcome::Conflict { depth, elements: elements_of(&mesh, &hexes) });
                }
                Attempt::Tangled { coarse, hexes } => {
                    return Ok(Outcome::Tangled { depth, elements: elements_of(&mesh, &coarse), hexes });
                }
            };
            check_size(options, depth as u8 + 2, next.mesh.hexes.len() as u64)?;
            number_as_forest(&mut next, &mesh, &level.refined);
            reports.push(next.report);
            mesh = next.mesh;
        }
        Ok(Outcome::Done(RefinedHexes { stages: reports, ..RefinedHexes::new(input, mesh) }))
    }
}

/// How the stages ended.
enum Outcome {
    Done(RefinedHexes),
    /// These elements of `levels[depth]` are to be refined too: the interface cannot be separated there.
    Conflict {
        depth: usize,
        elements: Vec<u32>,
    },
    /// The same, for so many hexes that stay inside out.
    Tangled {
        depth: usize,
        elements: Vec<u32>,
        hexes: usize,
    },
}

/// The elements that hexes of a mesh are.
fn elements_of(mesh: &StageMesh, hexes: &[u32]) -> Vec<u32> {
    hexes.iter().map(|&h| mesh.element[h as usize]).filter(|&e| e != NO_ELEMENT).collect()
}

/// Gives the children that a stage made the numbers that they have in the forest, where families stand in the order in
/// which elements were refined.
fn number_as_forest(next: &mut Refined, before: &StageMesh, refined: &[u32]) {
    let count = refined.iter().max().map_or(0, |&most| most as usize + 1);
    let mut rank = vec![0; count];
    for (k, &element) in refined.iter().enumerate() {
        rank[element as usize] = k as u32;
    }
    for (h, &from) in next.from.iter().enumerate() {
        let is_child = next.mesh.level[h] > before.level[from as usize];
        if is_child && next.mesh.octant[h] != NO_OCTANT {
            let family = rank[before.element[from as usize] as usize];
            next.mesh.element[h] = 8 * family + u32::from(next.mesh.octant[h]);
        }
    }
}

/// The input's boundary, on which boundary nodes are kept.
fn boundary_surface(input: &HexMesh) -> BoundarySurface {
    let quads = hex_boundary(&input.hexes).into_iter().map(|(face, _)| face).collect();
    BoundarySurface::new(&QuadMesh { positions: input.positions.clone(), quads }, RIDGE_DEGREES)
}

/// Tells the progress of one level's stages as a part of all levels'.
struct OfLevel<'a> {
    inner: &'a dyn Monitor,
    depth: usize,
    last: usize,
}

impl Monitor for OfLevel<'_> {
    fn progress(&self, stage: Stage, fraction: f64) {
        self.inner.progress(stage, (self.depth as f64 + fraction) / self.last as f64);
    }

    fn cancelled(&self) -> bool {
        self.inner.cancelled()
    }
}

/// Keeps progress from falling where the work begins again.
struct Rising<'a> {
    inner: &'a dyn Monitor,
    told: Mutex<Vec<(Stage, f64)>>,
}

impl Monitor for Rising<'_> {
    fn progress(&self, stage: Stage, fraction: f64) {
        let mut told = self.told.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        match told.iter_mut().find(|(known, _)| *known == stage) {
            Some((_, most)) if *most >= fraction => return,
            Some((_, most)) => *most = fraction,
            None => told.push((stage, fraction)),
        }
        self.inner.progress(stage, fraction);
    }

    fn cancelled(&self) -> bool {
        self.inner.cancelled()
    }
}
