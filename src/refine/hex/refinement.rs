//! What is to be refined, decided level by level, by the options and by a caller's size function.

use std::borrow::Cow;

use super::input::{coincident_nodes, longest_edge, longest_edge_of, oriented, refuse_unfit};
use super::options::{Growth, HexOptions, HexRefineError, Method, RefinedHexes, check_size, validate};
use super::plan::{Decided, HexPlan};
use super::trees::Trees;
use crate::geometry::{Extent, Point};
use crate::mesh::{HexMesh, NodeId};
use crate::refine::Candidates;
use crate::refine::targets::{exceeds, first_bad_target};
use crate::sizing::{SizeField, SizeOptions, SizedElement};
use crate::{Cancelled, Monitor, Stage, parallel};

const REFINE: Stage = Stage("refine");

/// Refinement a level at a time, for callers that decide between levels how fine each element is to be.
///
/// ```
/// use hexmill::Silent;
/// use hexmill::geometry::{Aabb, Point};
/// use hexmill::mesh::{GridOptions, hex_grid};
/// use hexmill::refine::hex::{HexOptions, HexRefinement};
///
/// let grid = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 64 };
/// let cubes = hex_grid(Aabb { min: Point::ZERO, max: Point::splat(2.0) }, &grid)?;
/// let options = HexOptions::default();
/// let mut refinement = HexRefinement::new(&cubes, &options, &Silent)?;
/// loop {
///     let candidates = refinement.candidates(&Silent)?;
///     let targets: Vec<f64> = candidates.centers.iter().map(|p| 0.1 + p.length() / 2.0).collect();
///     if !refinement.advance(Some(&targets), &Silent)? {
///         break;
///     }
/// }
/// let refined = refinement.finish(&Silent)?;
/// assert_eq!(refined.level.iter().max(), Some(&3));
/// assert!(refined.mesh.hexes.len() > 64);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct HexRefinement<'a> {
    /// Without its regions, which are in the `field`.
    options: HexOptions,
    /// Oriented, without unused nodes.
    input: Cow<'a, HexMesh>,
    /// What the options want finer.
    field: SizeField,
    /// None as long as nothing is refined.
    trees: Option<Trees>,
    /// Elements of the deepest level that would have been refined further, were it not for `max_levels`.
    capped: usize,
    turned: usize,
    /// Hexes of the input that are refined so that all are in families.
    base: usize,
    extent: Extent,
    /// The longest edge of the input.
    longest: f64,
}

impl<'a> HexRefinement<'a> {
    /// Checks input and options and prepares the sizing.
    ///
    /// # Errors
    /// If the input does not conform, an option is out of range, or the monitor stops it.
    pub fn new(input: &HexMesh, options: &HexOptions, monitor: &dyn Monitor) -> Result<Self, HexRefineError> {
        validate(options)?;
        let (input, turned) = oriented(input, monitor)?;
        Self::of_oriented(Cow::Owned(input), turned, options, monitor)
    }

    /// The same for a mesh that was made here: it conforms, its hexes are turned the right way, and all of its nodes are
    /// used.
    ///
    /// # Errors
    /// If a hex is not positive, an option is out of range, or the monitor stops it.
    pub(super) fn of_conforming(
        input: &'a HexMesh,
        options: &HexOptions,
        monitor: &dyn Monitor,
    ) -> Result<Self, HexRefineError> {
        validate(options)?;
        refuse_unfit(input, monitor)?;
        Self::of_oriented(Cow::Borrowed(input), 0, options, monitor)
    }

    fn of_oriented(
        input: Cow<'a, HexMesh>,
        turned: usize,
        options: &HexOptions,
        monitor: &dyn Monitor,
    ) -> Result<Self, HexRefineError> {
        let &HexOptions { edge_length, gradation, ref regions, .. } = options;
        let sizes = SizeOptions { edge_length, curvature: None, gradation, regions };
        let field = SizeField::of_hexes(&input, sizes)?;
        let (extent, longest) = (Extent::of(&input.positions), longest_edge_of(&input, monitor)?);
        let options = HexOptions { regions: Vec::new(), ..*options };
        Ok(Self { options, input, field, trees: None, capped: 0, turned, base: 0, extent, longest })
    }

    /// The elements that the next [`advance`](Self::advance) decides on: the input's hexes at first, then the
    /// elements that the last one made.
    ///
    /// # Errors
    /// If the monitor stops it.
    pub fn candidates(&mut self, monitor: &dyn Monitor) -> Result<Candidates, Cancelled> {
        self.make_last(monitor)?;
        let level = self.last_level();
        let corners = |e: usize| level.corners(&level.elements[e]);
        let count = level.elements.len();
        Ok(Candidates {
            centers: parallel::try_collect(count, monitor, |e| corners(e).iter().sum::<Point>() / 8.0)?,
            longest: parallel::try_collect(count, monitor, |e| longest_edge(&corners(e)))?,
        })
    }

    /// Refines the candidates that options or `targets` ask for; `targets` holds the greatest edge length allowed
    /// for each candidate, or infinity. Returns false when there was nothing to refine, and the work can be finished.
    ///
    /// With Methods I and II, told by name, all hexes of the input are refined once if one of them is.
    ///
    /// # Errors
    /// If there is not one target above 0 for each candidate, the monitor stops it, the mesh would become too large, or
    /// all hexes would be refined and the options refuse growth.
    pub fn advance(
        &mut self,
        targets: Option<&[f64]>,
        monitor: &dyn Monitor,
    ) -> Result<bool, HexRefineError> {
        let HexOptions { method, max_levels, .. } = self.options;
        let (number, count) = self.last();
        if let Some(targets) = targets {
            validate_targets(targets, count)?;
        }
        monitor.checkpoint(REFINE, f64::from(number) / f64::from(max_levels.max(number).max(1)))?;
        let mut marked = self.wanted(targets, monitor)?;
        if marked.is_empty() {
            return Ok(false);
        }
        if number >= max_levels {
            self.capped = marked.len();
            return Ok(false);
        }
        if number == 0 && matches!(method, Method::One | Method::Two) {
            self.base = count - marked.len();
            self.may_refine_all(&marked)?;
            marked = (0..count as u32).collect();
        }
        self.may_divide(&marked, monitor)?;
        let is_in_thirds = method == Method::Three;
        let mut trees = match self.trees.take() {
            Some(trees) => trees,
            None if is_in_thirds => Trees::thirds(&self.input),
            None => Trees::octrees(&self.input, monitor)?,
        };
        trees.split(number.into(), &marked, monitor)?;
        self.trees = Some(trees);
        Ok(true)
    }

    /// Refuses to divide the marked elements of the deepest level, and those of their descendants that are sure to be wanted
    /// finer too, beyond the limit of hexes or the digits of coordinates.
    fn may_divide(&mut self, marked: &[u32], monitor: &dyn Monitor) -> Result<(), HexRefineError> {
        let (number, _) = self.last();
        let parts: u8 = if self.options.method == Method::Three { 3 } else { 2 };
        let longest = self.longest / f64::from(parts).powi(i32::from(number) + 1);
        if !self.extent.has_digits_for(longest) {
            return Err(HexRefineError::TooFewDigits {
                level: number + 1,
                longest,
                reach: self.extent.reach,
            });
        }
        let sure = self.sure_levels(marked, monitor)?;
        let before = self.leaf_count() as u64;
        let mut of_levels = [0_u64; HexOptions::DEEPEST_LEVEL as usize + 1];
        sure.into_iter().for_each(|levels| of_levels[usize::from(levels)] += 1);
        let children = u64::from(parts).pow(3);
        let after = |level: u8| {
            let made = (0..).zip(of_levels).map(|(levels, elements): (u8, u64)| {
                elements.saturating_mul(children.saturating_pow(u32::from(levels.min(level))) - 1)
            });
            made.fold(before, u64::saturating_add)
        };
        (1..=self.options.max_levels - number)
            .try_for_each(|level| check_size(&self.options, number + level, after(level)))
    }

    /// How many levels more each of the marked elements of the deepest level is refined with all its descendants, at least.
    fn sure_levels(&mut self, marked: &[u32], monitor: &dyn Monitor) -> Result<Vec<u8>, HexRefineError> {
        let HexOptions { method, levels, max_levels, .. } = self.options;
        let (number, _) = self.last();
        let most = max_levels - number;
        let everywhere = levels.unwrap_or(0).saturating_sub(number).clamp(1, most);
        if everywhere == most || self.field.is_idle_from(number + everywhere) {
            return Ok(vec![everywhere; marked.len()]);
        }
        self.make_last(monitor)?;
        let level = self.last_level();
        let parts = if method == Method::Three { 3.0 } else { 2.0 };
        Ok(parallel::try_collect(marked.len(), monitor, |k| {
            let corners = level.corners(&level.elements[marked[k] as usize]);
            everywhere.max(self.field.sure_levels(&corners, number, parts).min(most))
        })?)
    }

    /// Refuses to refine all hexes of the input where those `marked` alone are asked for, if the options say so.
    fn may_refine_all(&self, marked: &[u32]) -> Result<(), HexRefineError> {
        if self.base == 0 || self.options.growth == Growth::Allow {
            return Ok(());
        }
        // The marked ones ascend: up to the first that is not, each has its place.
        let first = marked.iter().zip(0..).take_while(|&(&marked, place)| marked == place).count();
        let corners = self.input.hexes[first].map(|n| self.input.positions[n.index()]);
        Err(HexRefineError::GrowthRefused {
            elements: self.base,
            level: 0,
            reason: "so that all are in families of eight",
            near: corners.iter().sum::<Point>() / 8.0,
        })
    }

    /// Refines all that the options ask for.
    pub(super) fn decided(mut self, monitor: &dyn Monitor) -> Result<Self, HexRefineError> {
        while self.advance(None, monitor)? {}
        Ok(self)
    }

    /// Refines what the rules of conforming refinement ask for, besides; says what will be made.
    ///
    /// # Errors
    /// If the mesh would become too large, or the monitor stops it.
    pub fn plan(self, monitor: &dyn Monitor) -> Result<HexPlan<'a>, HexRefineError> {
        let (plan, trees) = self.unsettled(monitor)?;
        plan.settled(trees, monitor)
    }

    /// A plan, and the trees that it has yet to be given.
    pub(super) fn unsettled(
        self,
        monitor: &dyn Monitor,
    ) -> Result<(HexPlan<'a>, Option<Trees>), HexRefineError> {
        let Self { options, input, field, trees, capped, turned, base, .. } = self;
        let idle_regions = field.idle_regions(input.hexes.len(), monitor, |h| {
            let corners = input.hexes[h].map(|n| input.positions[n.index()]);
            [SizedElement { corners, longest: longest_edge(&corners), level: 0, root: None }]
        })?;
        let coincident_nodes = coincident_nodes(&input.positions);
        let decided = Decided { capped, turned, base, idle_regions, coincident_nodes };
        Ok((HexPlan::of_input(options, input, decided), trees))
    }

    /// Makes the mesh.
    ///
    /// # Errors
    /// See [`HexRefineError`].
    pub fn finish(self, monitor: &dyn Monitor) -> Result<RefinedHexes, HexRefineError> {
        self.plan(monitor)?.carry_out(monitor)
    }

    /// How many elements are not refined so far.
    pub(super) fn leaf_count(&self) -> usize {
        self.trees.as_ref().map_or(self.input.hexes.len(), Trees::leaf_count)
    }

    /// The number of the deepest level, and how many elements it has.
    fn last(&self) -> (u8, usize) {
        match &self.trees {
            None => (0, self.input.hexes.len()),
            Some(trees) => {
                let number = trees.depth() - 1;
                (number as u8, trees.level(number).is_refined.len())
            }
        }
    }

    /// The elements of the deepest level that are wanted finer. They are made only if it depends on where they are.
    fn wanted(&mut self, targets: Option<&[f64]>, monitor: &dyn Monitor) -> Result<Vec<u32>, HexRefineError> {
        let (number, count) = self.last();
        if self.options.levels.is_some_and(|levels| number < levels) {
            return Ok((0..count as u32).collect());
        }
        if targets.is_none() && self.field.is_idle_from(number) {
            return Ok(Vec::new());
        }
        self.make_last(monitor)?;
        let level = self.last_level();
        let wants = |e: usize| {
            let corners = level.corners(&level.elements[e]);
            let longest = longest_edge(&corners);
            exceeds(targets, e, longest)
                || self.field.wants(&SizedElement { corners, longest, level: number, root: None })
        };
        Ok(parallel::try_filter(count, monitor, wants)?)
    }

    fn make_last(&mut self, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        self.trees.as_mut().map_or(Ok(()), |trees| trees.make_last(monitor))
    }

    /// The deepest level, which is made; none of its elements is refined.
    fn last_level(&self) -> Level<'_> {
        match &self.trees {
            None => Level { elements: &self.input.hexes, positions: &self.input.positions },
            Some(trees) => {
                Level { elements: trees.level(trees.depth() - 1).elements, positions: trees.positions() }
            }
        }
    }
}

/// The elements of one level.
struct Level<'a> {
    elements: &'a [[NodeId; 8]],
    positions: &'a [Point],
}

impl Level<'_> {
    fn corners(&self, element: &[NodeId; 8]) -> [Point; 8] {
        element.map(|n| self.positions[n.index()])
    }
}

/// Refuses targets that are not one length above 0 for each candidate.
fn validate_targets(targets: &[f64], candidates: usize) -> Result<(), HexRefineError> {
    if targets.len() != candidates {
        return Err(HexRefineError::TargetCount { given: targets.len(), wanted: candidates });
    }
    match first_bad_target(targets) {
        Some(candidate) => Err(HexRefineError::Target { candidate, value: targets[candidate] }),
        None => Ok(()),
    }
}
