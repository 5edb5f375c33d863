//! What will be refined, decided before a hex is made: the trees of section 3, closed.
//!
//! 1. Decide level by level what is wanted finer ([`HexRefinement`]).
//! 2. Close the trees. Octrees: whole families around a volume node, strong balance, what the method's templates fit, and
//!    whole blocks where hexes of level 0 stand in blocks of two by two by two; trees of 27: graded levels.
//! 3. With [`Method::Auto`], ask whether the interface within level 0 can be grouped two by two. If it cannot, whole
//!    blocks of hexes are refined (`grouping`), or, where there are none, all of level 0, which makes families of
//!    everything.
//! 4. Look at each level's interface (`forecast`). Where it cannot be separated, refine more, and close again.

use std::borrow::Cow;

use super::attempt::without_template;
use super::forecast::{HexForecast, StageForecast, foresee};
use super::grouping::Grouping;
use super::heritage::Heritage;
use super::options::{Added, Growth, HexOptions, HexRefineError, Method, check_size};
use super::outline::Outline;
use super::part::Part;
use super::refinement::HexRefinement;
use super::stage::{Joining, StageError, StageMesh, joining};
use super::trees::{TreeLevel, Trees};
use crate::geometry::Point;
use crate::mesh::HexMesh;
use crate::{Cancelled, Monitor, Stage};

const CLOSE: Stage = Stage("close");

/// Why conflicts are refined.
pub(super) const INSEPARABLE: &str = "where the interface cannot be separated";

/// What is refined, what closing the trees has added, and what will come of it.
#[derive(Debug)]
pub struct HexPlan<'a> {
    /// Without its regions.
    pub(super) options: HexOptions,
    /// The blocks of the input's hexes, if these stand in blocks.
    pub(super) blocks: Option<&'a HexBlocks>,
    /// See [`StageMesh::has_free_boundary`].
    pub(super) has_free_boundary: bool,
    /// The input, oriented, without unused nodes.
    pub(super) input: Cow<'a, HexMesh>,
    /// None if nothing is to be refined.
    pub(super) outline: Option<Outline>,
    pub(super) added: Added,
    pub(super) decided: Decided,
    forecast: HexForecast,
}

/// What is known of a refinement before its trees are closed.
#[derive(Debug)]
pub(super) struct Decided {
    /// Elements that are larger than asked for, because `max_levels` was reached.
    pub(super) capped: usize,
    /// Hexes of the input that were numbered inside out, and were turned.
    pub(super) turned: usize,
    /// See [`Added::base`].
    pub(super) base: usize,
    /// The regions that overlap no part of the input, by their places among the options'.
    pub(super) idle_regions: Vec<u32>,
    /// Nodes of the input that stand exactly where earlier ones do.
    pub(super) coincident_nodes: usize,
}

/// Hexes in blocks of two by two by two: what the families of deeper levels are, in the input.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(crate) struct HexBlocks {
    /// The block of each hex.
    pub(crate) block: Vec<u32>,
    /// Which of the corners of its block each hex is at, if all hexes of a block are numbered alike.
    pub(crate) octant: Vec<u8>,
}

/// What a plan was given more to refine.
pub(super) struct More {
    /// Elements that were asked for and were not refined yet.
    pub(super) elements: usize,
    /// The coarsest level with elements that are refined now and were not before.
    pub(super) coarsest: usize,
}

impl<'a> HexPlan<'a> {
    /// Decides what is to be refined.
    ///
    /// # Errors
    /// If the input does not conform, an option is out of range, there would be too many hexes, or the monitor stops
    /// it.
    pub fn new(input: &HexMesh, options: &HexOptions, monitor: &dyn Monitor) -> Result<Self, HexRefineError> {
        HexRefinement::new(input, options, monitor)?.decided(monitor)?.plan(monitor)
    }

    /// As [`HexPlan::new`], for a mesh that was made here to be cut: it conforms, its hexes are turned the right way, and all of
    /// its nodes are used, so that less has to be asked of it; and nodes of the transitions may leave its boundary. Where its
    /// hexes stand in blocks, whole ones are refined: then hexes away from them can stay as they are.
    ///
    /// # Panics
    /// If there are blocks, and not one block and one octant for each hex.
    pub(crate) fn of_conforming(
        input: &'a HexMesh,
        blocks: Option<&'a HexBlocks>,
        options: &HexOptions,
        monitor: &dyn Monitor,
    ) -> Result<Self, HexRefineError> {
        if let Some(HexBlocks { block, octant }) = blocks {
            let count = input.hexes.len();
            assert_eq!([block.len(), octant.len()], [count; 2], "a block and an octant for each hex");
        }
        let refinement = HexRefinement::of_conforming(input, options, monitor)?.decided(monitor)?;
        let (plan, trees) = refinement.unsettled(monitor)?;
        Self { blocks, has_free_boundary: true, ..plan }.settled(trees, monitor)
    }

    /// How many hexes the trees have that refine what the options ask for and nothing else: no mesh of theirs has fewer. Of a mesh
    /// that was made here.
    pub(crate) fn fewest_hexes(
        input: &HexMesh,
        options: &HexOptions,
        monitor: &dyn Monitor,
    ) -> Result<usize, HexRefineError> {
        let refinement = HexRefinement::of_conforming(input, options, monitor)?.decided(monitor)?;
        Ok(refinement.leaf_count())
    }

    /// Nothing to be refined yet.
    pub(super) fn of_input(options: HexOptions, input: Cow<'a, HexMesh>, decided: Decided) -> Self {
        let forecast = HexForecast::new(input.hexes.len(), Vec::new());
        let added = Added { base: decided.base, ..Added::default() };
        Self {
            options,
            blocks: None,
            has_free_boundary: false,
            input,
            outline: None,
            added,
            decided,
            forecast,
        }
    }

    /// With these trees over the input, closed.
    pub(super) fn settled(
        mut self,
        trees: Option<Trees>,
        monitor: &dyn Monitor,
    ) -> Result<Self, HexRefineError> {
        if let Some(trees) = trees {
            self.settle(trees, monitor)?;
        }
        Ok(self)
    }

    /// Elements that are refined beyond those that the options ask for, and why.
    pub fn added(&self) -> Added {
        self.added
    }

    /// Elements that will be larger than asked for, because `max_levels` was reached.
    pub fn capped(&self) -> usize {
        self.decided.capped
    }

    /// Hexes of the input that were numbered inside out, and were turned.
    pub fn turned(&self) -> usize {
        self.decided.turned
    }

    /// The regions that overlap no part of the input, by their places among the options'. They refine nothing.
    pub fn idle_regions(&self) -> &[u32] {
        &self.decided.idle_regions
    }

    /// Nodes of the input that stand exactly where earlier ones do. Hexes there that do not share nodes are no neighbours:
    /// their levels do not follow each other's, and smoothing may part them.
    pub fn coincident_nodes(&self) -> usize {
        self.decided.coincident_nodes
    }

    /// How large the mesh will be, and what its transitions will take.
    pub fn forecast(&self) -> &HexForecast {
        &self.forecast
    }

    /// Hexes of the trees; the mesh will have these and those of the transitions.
    pub fn tree_hexes(&self) -> usize {
        let hexes = self.input.hexes.len();
        self.outline.as_ref().map_or(hexes, |outline| outline.leaf_count(hexes))
    }

    /// Steps 2 to 4.
    fn settle(&mut self, mut trees: Trees, monitor: &dyn Monitor) -> Result<(), HexRefineError> {
        monitor.checkpoint(CLOSE, 0.0)?;
        let heritage = Heritage::of_input(&self.input, self.has_free_boundary, monitor)?;
        let stages = loop {
            self.close(&mut trees, monitor)?;
            self.group(&mut trees, monitor)?;
            monitor.checkpoint(CLOSE, 0.5)?;
            match self.foresee(&trees, &heritage, monitor)? {
                Ok(stages) => break stages,
                Err((number, more)) => {
                    self.may_grow(&trees, (number, &more), INSEPARABLE)?;
                    self.added.conflicts += more.len();
                    trees.split(number, &more, monitor)?;
                }
            }
        };
        self.forecast = HexForecast::new(self.input.hexes.len(), stages);
        self.outline = Some(Outline::of(&trees));
        monitor.checkpoint(CLOSE, 1.0)?;
        Ok(())
    }

    /// Step 2.
    fn close(&mut self, trees: &mut Trees, monitor: &dyn Monitor) -> Result<(), HexRefineError> {
        loop {
            self.close_once(trees, monitor)?;
            let rest = self.blocks.map_or_else(Vec::new, |of| rest_of_blocks(&of.block, trees.level(0)));
            if rest.is_empty() {
                return Ok(());
            }
            self.may_grow(trees, (0, &rest), "for whole blocks")?;
            self.added.closure.families += rest.len();
            trees.split(0, &rest, monitor)?;
        }
    }

    fn close_once(&mut self, trees: &mut Trees, monitor: &dyn Monitor) -> Result<(), HexRefineError> {
        let (admits, limit) = (self.options.method.admits(), self.options.max_hexes);
        if self.options.growth == Growth::Refuse && admits.is_some() {
            // What the method adds is what is refined after families and grading are complete.
            let more = trees.close(None, limit, monitor)?;
            let before: Vec<usize> = (0..trees.depth()).map(|n| trees.level(n).refined.len()).collect();
            trees.close(admits, limit, monitor)?;
            for (number, &before) in before.iter().enumerate() {
                self.may_grow(
                    trees,
                    (number, &trees.level(number).refined[before..]),
                    "for the method's templates",
                )?;
            }
            self.added.closure += more;
            return Ok(());
        }
        self.added.closure += trees.close(admits, limit, monitor)?;
        Ok(())
    }

    /// Step 3.
    fn group(&mut self, trees: &mut Trees, monitor: &dyn Monitor) -> Result<(), HexRefineError> {
        let base = trees.level(0);
        if self.options.method != Method::Auto
            || self.blocks.is_some()
            || base.refined.len() == base.elements.len()
        {
            return Ok(());
        }
        // A second copy of the input would be a good part of what all of this takes.
        let mut mesh = StageMesh::taken_from(self.input.to_mut(), monitor)?;
        mesh.has_free_boundary = self.has_free_boundary;
        let grouped = self.group_in(&mesh, trees, monitor);
        mesh.give_back(self.input.to_mut());
        grouped
    }

    fn group_in(
        &mut self,
        mesh: &StageMesh,
        trees: &mut Trees,
        monitor: &dyn Monitor,
    ) -> Result<(), HexRefineError> {
        let mut joined = joined_around(mesh, trees.level(0), monitor)?;
        if matches!(joined, Joining::Possible) {
            return Ok(());
        }
        let grouping = Grouping::of(mesh.positions.len(), &mesh.hexes, monitor)?;
        loop {
            let base = trees.level(0);
            let at_fault = match &joined {
                Joining::Possible => return Ok(()),
                Joining::Ungrouped(hexes) => hexes.clone(),
                Joining::Conflict(_) => {
                    (0..base.elements.len() as u32).filter(|&e| base.is_refined[e as usize]).collect()
                }
            };
            let of_blocks = rest_of_blocks(&grouping.blocks(base.is_refined, &at_fault, monitor)?, base);
            match joined {
                _ if !of_blocks.is_empty() => self.refine_unasked(trees, &of_blocks, monitor)?,
                Joining::Conflict(more) => {
                    self.may_grow(trees, (0, &more), INSEPARABLE)?;
                    self.added.conflicts += more.len();
                    trees.split(0, &more, monitor)?;
                    self.close(trees, monitor)?;
                }
                _ => {
                    let all = grouping.bodies_of(&at_fault, monitor)?;
                    let is_rest = |e: &u32| all[*e as usize] && !base.is_refined[*e as usize];
                    let rest: Vec<u32> = (0..base.elements.len() as u32).filter(is_rest).collect();
                    self.refine_unasked(trees, &rest, monitor)?;
                }
            }
            joined = joined_around(mesh, trees.level(0), monitor)?;
        }
    }

    /// Refines hexes of the input for the interface's sake.
    fn refine_unasked(
        &mut self,
        trees: &mut Trees,
        rest: &[u32],
        monitor: &dyn Monitor,
    ) -> Result<(), HexRefineError> {
        let leaves = trees.leaf_count() + (trees.children() - 1) * rest.len();
        check_size(&self.options, 1, leaves as u64)?;
        self.may_grow(trees, (0, rest), "because the interface cannot be grouped two by two")?;
        self.added.base += rest.len();
        trees.split(0, rest, monitor)?;
        self.close(trees, monitor)
    }

    /// Refuses to refine more elements of a level than are asked for, if the options say so.
    fn may_grow(
        &self,
        trees: &Trees,
        (number, elements): (usize, &[u32]),
        reason: &'static str,
    ) -> Result<(), HexRefineError> {
        let Some(&first) = elements.first().filter(|_| self.options.growth == Growth::Refuse) else {
            return Ok(());
        };
        let corners = trees.level(number).elements[first as usize];
        let near = corners.iter().map(|n| trees.positions()[n.index()]).sum::<Point>() / 8.0;
        Err(HexRefineError::GrowthRefused { elements: elements.len(), level: number as u8, reason, near })
    }

    /// Step 4: what the stages will make; or a level and its elements that must be refined too.
    #[expect(clippy::type_complexity, reason = "a conflict is no error")]
    fn foresee(
        &self,
        trees: &Trees,
        of_input: &Heritage,
        monitor: &dyn Monitor,
    ) -> Result<Result<Vec<StageForecast>, (usize, Vec<u32>)>, HexRefineError> {
        let mut stages = Vec::new();
        let mut hexes = self.input.hexes.len();
        let mut heritage = Cow::Borrowed(of_input);
        for number in 0..trees.depth() - 1 {
            let (level, within) = (trees.level(number), (trees.positions(), trees.children()));
            let mut stage = match foresee((level, &heritage), within, self.options.method, monitor) {
                Ok(stage) => stage,
                Err(StageError::Conflict(more)) => return Ok(Err((number, more))),
                Err(error) => return Err(without_template(error)),
            };
            heritage = Cow::Owned(heritage.inherited(level, trees.children()));
            hexes += stage.hexes;
            stage.hexes = hexes;
            check_size(&self.options, number as u8 + 1, hexes as u64)?;
            stages.push(stage);
        }
        Ok(Ok(stages))
    }

    /// Refines more elements of level `number`, with what this calls for.
    pub(super) fn refine_too(
        &mut self,
        number: usize,
        elements: &[u32],
        monitor: &dyn Monitor,
    ) -> Result<More, HexRefineError> {
        let nothing = More { elements: 0, coarsest: number };
        let Some(before) = self.outline.take() else { return Ok(nothing) };
        let is_refined = before.is_refined(number, self.input.hexes.len());
        let mut more: Vec<u32> = elements.iter().copied().filter(|&e| !is_refined[e as usize]).collect();
        more.sort_unstable();
        more.dedup();
        if more.is_empty() {
            return Ok(nothing);
        }
        let mut trees = before.trees(&self.input, monitor)?;
        trees.split(number, &more, monitor)?;
        self.settle(trees, monitor)?;
        let after = self.outline.as_ref().map_or(&[][..], |outline| &outline.refined);
        let same = before.refined.iter().zip(after).take_while(|(before, after)| before.len() == after.len());
        Ok(More { elements: more.len(), coarsest: same.count().min(number) })
    }
}

/// As [`joining`], with the part around the refined hexes alone where these are few.
fn joined_around(mesh: &StageMesh, base: TreeLevel, monitor: &dyn Monitor) -> Result<Joining, Cancelled> {
    let Some(part) = Part::around(mesh.whole(), base.refined, monitor)? else {
        return joining(mesh, base.is_refined, monitor);
    };
    let mut joined = joining(&part.mesh, &part.flags(base.is_refined), monitor)?;
    if let Joining::Conflict(hexes) | Joining::Ungrouped(hexes) = &mut joined {
        part.number_as_whole(hexes);
    }
    Ok(joined)
}

/// The hexes of level 0 in blocks that are refined in part, and are not refined yet.
fn rest_of_blocks(blocks: &[u32], base: TreeLevel) -> Vec<u32> {
    let bound = blocks.iter().max().map_or(0, |&last| last as usize + 1);
    let mut is_wanted = vec![false; bound];
    base.refined.iter().for_each(|&e| is_wanted[blocks[e as usize] as usize] = true);
    let is_rest = |&e: &u32| is_wanted[blocks[e as usize] as usize] && !base.is_refined[e as usize];
    (0..blocks.len() as u32).filter(is_rest).collect()
}
