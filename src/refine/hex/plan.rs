//! What is to be refined, decided before a hex is made: the octree of section 3.
//!
//! 1. Check and orient the input.
//! 2. Refine level 0 once everywhere, if anything is to be finer at all; it tells edge, face and volume nodes apart.
//! 3. Level by level, refine the elements that the sizing asks for.
//! 4. Close the forest: whole families around a volume node, strong balance, what the method's templates fit.

use super::options::{Added, HexOptions, HexRefineError, Method};
use crate::forest::HexForest;
use crate::geometry::Point;
use crate::mesh::check::{Defect, summary};
use crate::mesh::numbering::hex::EDGES;
use crate::mesh::quality::{Certainty, is_positive};
use crate::mesh::{HexId, HexMesh, NodeId, check_hexes, orient_hexes};
use crate::parallel;
use crate::sizing::{SizeField, SizeOptions, SizedElement};
use crate::{Monitor, Stage};

const REFINE: Stage = Stage("refine");
const CLOSE: Stage = Stage("close");

/// Hexes that an element of the octree becomes.
const CHILDREN: u64 = 8;

/// The octree of a refinement, and what closing it has added.
#[derive(Debug)]
pub struct HexPlan<'a> {
    pub(super) options: &'a HexOptions,
    /// The input, oriented, without unused nodes.
    pub(super) input: HexMesh,
    /// What is wanted finer.
    pub(super) field: SizeField,
    /// None if nothing is to be refined, and for 3-refinement, whose trees are no octrees.
    pub(super) forest: Option<HexForest>,
    pub(super) added: Added,
    pub(super) capped: usize,
    pub(super) turned: usize,
}

impl<'a> HexPlan<'a> {
    /// Decides what is to be refined.
    ///
    /// # Errors
    /// If the input does not conform, an option is out of range, there would be too many hexes, or the monitor stops
    /// it.
    pub fn new(
        input: &HexMesh,
        options: &'a HexOptions,
        monitor: &dyn Monitor,
    ) -> Result<Self, HexRefineError> {
        validate(options)?;
        let (input, turned) = oriented(input)?;
        monitor.proceed()?;
        let &HexOptions { edge_length, gradation, ref regions, .. } = options;
        let sizes = SizeOptions { edge_length, curvature: None, gradation, regions };
        let field = SizeField::of_hexes(&input, sizes)?;
        let mut plan =
            Self { options, input, field, forest: None, added: Added::default(), capped: 0, turned };
        if options.method != Method::Three {
            plan.refine(monitor)?;
            plan.close(monitor)?;
        }
        Ok(plan)
    }

    /// Elements that are refined beyond those that the options ask for, and why.
    pub fn added(&self) -> Added {
        self.added
    }

    /// Hexes of the octree; the mesh will have these and those of the transitions.
    pub fn octree_hexes(&self) -> usize {
        self.forest.as_ref().map_or(self.input.hexes.len(), HexForest::leaf_count)
    }

    /// Steps 2 and 3.
    fn refine(&mut self, monitor: &dyn Monitor) -> Result<(), HexRefineError> {
        monitor.checkpoint(REFINE, 0.0)?;
        let at_input = Level { elements: &self.input.hexes, positions: &self.input.positions, number: 0 };
        let wanted = at_input.wanted(&self.field, self.options, monitor)?.len();
        if wanted == 0 || self.options.max_levels == 0 {
            self.capped = wanted;
            return Ok(());
        }
        check_size(self.options, 1, CHILDREN * self.input.hexes.len() as u64)?;
        let mut forest = HexForest::refined_once(&self.input);
        loop {
            let depth = forest.levels.len() - 1;
            let number = forest.levels.len() as u8;
            let level =
                Level { elements: &forest.levels[depth].elements, positions: &forest.positions, number };
            let marked = level.wanted(&self.field, self.options, monitor)?;
            if marked.is_empty() {
                break;
            }
            if number >= self.options.max_levels {
                self.capped = marked.len();
                break;
            }
            let more = (CHILDREN - 1) * marked.len() as u64;
            check_size(self.options, number + 1, forest.leaf_count() as u64 + more)?;
            monitor.checkpoint(REFINE, f64::from(number) / f64::from(self.options.max_levels))?;
            forest.split(depth, &marked);
        }
        self.forest = Some(forest);
        Ok(())
    }

    /// Step 4.
    fn close(&mut self, monitor: &dyn Monitor) -> Result<(), HexRefineError> {
        let Some(forest) = &mut self.forest else { return Ok(()) };
        monitor.checkpoint(CLOSE, 0.0)?;
        let more = forest.close(self.options.method.admits(), monitor)?;
        let closure = &mut self.added.closure;
        closure.families += more.families;
        closure.balance += more.balance;
        closure.method += more.method;
        let deepest = forest.levels.len() as u8;
        check_size(self.options, deepest, forest.leaf_count() as u64)?;
        monitor.checkpoint(CLOSE, 1.0)?;
        Ok(())
    }

    /// Refines more elements of `levels[depth]`, with what this calls for; returns how many there were to refine.
    pub(super) fn refine_too(
        &mut self,
        depth: usize,
        elements: &[u32],
        monitor: &dyn Monitor,
    ) -> Result<usize, HexRefineError> {
        let Some(forest) = &mut self.forest else { return Ok(0) };
        let coarse = |e: &u32| !forest.levels[depth].is_refined[*e as usize];
        let mut more: Vec<u32> = elements.iter().copied().filter(coarse).collect();
        more.sort_unstable();
        more.dedup();
        forest.split(depth, &more);
        self.close(monitor)?;
        Ok(more.len())
    }
}

/// The elements of one level.
pub(super) struct Level<'a> {
    pub elements: &'a [[NodeId; 8]],
    pub positions: &'a [Point],
    pub number: u8,
}

impl Level<'_> {
    /// The elements that are wanted finer.
    pub fn wanted(
        &self,
        field: &SizeField,
        options: &HexOptions,
        monitor: &dyn Monitor,
    ) -> Result<Vec<u32>, HexRefineError> {
        if options.levels.is_some_and(|levels| self.number < levels) {
            return Ok((0..self.elements.len() as u32).collect());
        }
        if field.is_idle_from(self.number) {
            return Ok(Vec::new());
        }
        Ok(parallel::try_filter(self.elements.len(), monitor, |e| self.wants(field, e))?)
    }

    fn wants(&self, field: &SizeField, e: usize) -> bool {
        let corners = self.elements[e].map(|n| self.positions[n.index()]);
        let length = |[a, b]: [u8; 2]| corners[usize::from(a)].distance_squared(corners[usize::from(b)]);
        let longest = EDGES.map(length).into_iter().fold(0.0, f64::max).sqrt();
        field.wants(&SizedElement { corners, longest, level: self.number, root: None })
    }
}

/// Step 1: the input with its hexes turned the right way, all of them positive inside, without unused nodes; and how
/// many were turned.
fn oriented(input: &HexMesh) -> Result<(HexMesh, usize), HexRefineError> {
    if input.hexes.is_empty() {
        return Err(HexRefineError::NoHexes);
    }
    let mut mesh = input.clone();
    let ids_are_good = mesh.hexes.as_flattened().iter().all(|n| n.index() < mesh.positions.len());
    let turned = if ids_are_good { orient_hexes(&mut mesh)? } else { 0 };
    let mut defects = check_hexes(&mesh);
    defects.retain(|defect| !matches!(defect, Defect::UnusedNode { .. }));
    if !defects.is_empty() {
        let kinds = summary(&defects).iter().map(ToString::to_string).collect();
        return Err(HexRefineError::InvalidInput(kinds));
    }
    let is_doubtful = |h: usize| {
        let corners = mesh.hexes[h].map(|n| mesh.positions[n.index()]);
        (is_positive(&corners) != Certainty::Positive).then_some(HexId::new(h))
    };
    let doubtful: Vec<HexId> = parallel::filter_map(mesh.hexes.len(), is_doubtful);
    if !doubtful.is_empty() {
        return Err(HexRefineError::NotPositive(doubtful));
    }
    drop_unused_nodes(&mut mesh);
    Ok((mesh, turned))
}

fn drop_unused_nodes(mesh: &mut HexMesh) {
    let mut is_used = vec![false; mesh.positions.len()];
    mesh.hexes.iter().flatten().for_each(|n| is_used[n.index()] = true);
    let mut number = Vec::with_capacity(is_used.len());
    let mut count = 0;
    for &used in &is_used {
        number.push(NodeId(count));
        count += u32::from(used);
    }
    let mut used = is_used.iter();
    mesh.positions.retain(|_| *used.next().expect("a flag a node"));
    parallel::for_each_mut(&mut mesh.hexes, |_, hex| *hex = hex.map(|n| number[n.index()]));
}

/// Refuses options out of range.
fn validate(options: &HexOptions) -> Result<(), HexRefineError> {
    let out_of_range = |option, value: String, wanted| Err(HexRefineError::Option { option, value, wanted });
    if options.max_levels > HexOptions::DEEPEST_LEVEL {
        return out_of_range("maxLevels", options.max_levels.to_string(), "give at most 20");
    }
    if let Some(levels) = options.levels.filter(|&l| l > options.max_levels) {
        return out_of_range("levels", levels.to_string(), "give at most maxLevels, or raise that");
    }
    if options.max_hexes > HexOptions::MOST_HEXES {
        return out_of_range("maxHexes", options.max_hexes.to_string(), "give at most 2^28");
    }
    Ok(())
}

/// Refuses a mesh of more hexes than the options allow.
pub(super) fn check_size(options: &HexOptions, level: u8, hexes: u64) -> Result<(), HexRefineError> {
    let limit = options.max_hexes;
    if hexes > limit { Err(HexRefineError::TooManyHexes { level, hexes, limit }) } else { Ok(()) }
}
