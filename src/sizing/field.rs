//! Where elements are to be refined: options and regions made ready for many questions.

use std::cell::LazyCell;

use super::curvature::turn_per_length;
use super::error::{SizingError, validate};
use super::overlap::{Overlap, Probe};
use super::{Region, Target};
use crate::geometry::{Aabb, BoxIndex, Corners, Point};
use crate::mesh::numbering::hex::{CORNERS, EDGES};
use crate::mesh::{FaceId, HexMesh, PolygonMesh};
use crate::parallel;
use crate::{Cancelled, Monitor};

/// An element that asks whether it is to be refined: a quad with 4 corners, a hex with 8.
#[derive(Clone, Copy, Debug)]
pub struct SizedElement<const N: usize = 4> {
    /// The positions of its nodes, in the order of the reference element.
    pub corners: [Point; N],
    /// The length of its longest edge.
    pub longest: f64,
    /// Its refinement level.
    pub level: u8,
    /// The input face that it is part of, which has the limit of curvature; a hex is part of none.
    pub root: Option<FaceId>,
}

/// What a size field is made of. Lengths are in model units.
#[derive(Clone, Copy, Debug)]
pub struct SizeOptions<'a> {
    /// No edge longer than this, anywhere.
    pub edge_length: Option<f64>,
    /// Turn of the surface's normal that one edge may span, in degrees.
    pub curvature: Option<f64>,
    /// How much larger an element may be than its neighbour, 1 < gradation <= 2: at a distance d from a region
    /// with a target size, no edge is longer than size + (gradation - 1) · d. With 2 strong balance sees to that.
    pub gradation: f64,
    /// Where to refine further.
    pub regions: &'a [Region],
}

/// Tells which elements are to be refined.
#[derive(Debug)]
pub struct SizeField {
    /// No edge longer than this, anywhere.
    edge_length: f64,
    /// For each input face: no edge longer than this in it. Empty if curvature asks for nothing.
    by_face: Vec<f64>,
    regions: Vec<Graded>,
    /// Of the regions' boxes, if there are many.
    index: Option<BoxIndex>,
    /// How far from the regions their sizes are felt, as a multiple of what an element is longer than its target.
    spread: f64,
    /// No target is shorter.
    finest: f64,
    /// No region asks for a level beyond this.
    deepest: u8,
    /// No element of level 1 has a longer edge than this.
    longest: f64,
}

/// A region made ready.
#[derive(Debug)]
struct Graded {
    overlap: Overlap,
    target: Target,
}

/// So many regions are asked one after the other; among more an index finds those that are near.
const FEW: usize = 12;

/// So many cells are held against the regions between two questions to the monitor.
const CELLS_AT_ONCE: usize = 4096;

impl SizeField {
    /// Checks the options and prepares them.
    ///
    /// # Errors
    /// If an option or a region is out of range, or the monitor stops it.
    ///
    /// # Panics
    /// If `input` has node ids out of range.
    pub fn new(
        input: &PolygonMesh,
        options: SizeOptions<'_>,
        monitor: &dyn Monitor,
    ) -> Result<Self, SizingError> {
        validate(&options)?;
        let by_face = match options.curvature {
            Some(angle) => limits_by_curvature(input, angle, monitor)?,
            None => Vec::new(),
        };
        let longest = parallel::try_greatest(input.face_count(), monitor, |f| longest_child_edge(input, f))?;
        Ok(Self::over(by_face, longest, options))
    }

    /// As [`SizeField::new`], for a hex mesh.
    ///
    /// # Errors
    /// If an option or a region is out of range; hexes have no curvature.
    ///
    /// # Panics
    /// If `input` has node ids out of range.
    pub fn of_hexes(input: &HexMesh, options: SizeOptions<'_>) -> Result<Self, SizingError> {
        validate(&options)?;
        if options.curvature.is_some() {
            return Err(SizingError::CurvatureOfHexes);
        }
        let longest_edge = parallel::greatest(input.hexes.len(), |h| {
            let at = input.hexes[h].map(|n| input.positions[n.index()]);
            let lengths = EDGES.map(|[a, b]| at[usize::from(a)].distance_squared(at[usize::from(b)]));
            lengths.into_iter().fold(0.0, f64::max)
        });
        // An edge of a child is half of a mean of edges of its parent.
        let longest = 0.5 * longest_edge.sqrt();
        Ok(Self::over(Vec::new(), longest, options))
    }

    /// A field of valid options over cells whose children's longest edge is `longest`.
    fn over(by_face: Vec<f64>, longest: f64, options: SizeOptions<'_>) -> Self {
        let regions: Vec<Graded> = options.regions.iter().map(Graded::new).collect();
        let edge_length = options.edge_length.map_or(f64::INFINITY, limit);
        let sizes = regions.iter().map(Graded::finest);
        Self {
            finest: by_face.iter().copied().chain(sizes).fold(edge_length, f64::min),
            deepest: regions.iter().map(Graded::deepest).max().unwrap_or(0),
            longest,
            spread: if options.gradation < 2.0 { 1.0 / (options.gradation - 1.0) } else { 0.0 },
            index: (regions.len() > FEW).then(|| BoxIndex::new(regions.iter().map(|r| r.overlap.bounds))),
            edge_length,
            by_face,
            regions,
        }
    }

    /// True if no element of this level or deeper is to be refined, whatever its place.
    ///
    /// Edges of an element's children are at most half as long as its longest edge, so below some level all
    /// elements are shorter than every target.
    pub fn is_idle_from(&self, level: u8) -> bool {
        let longest = match level {
            0 => f64::INFINITY,
            _ => self.longest * 0.5_f64.powi(i32::from(level) - 1) * (1.0 + 0.5 * ROUNDING),
        };
        longest <= self.finest && level >= self.deepest
    }

    /// True if the element is to be refined.
    #[inline]
    pub fn wants<const N: usize>(&self, element: &SizedElement<N>) -> bool
    where
        [Point; N]: Corners,
    {
        let longest = element.longest;
        if longest <= self.finest && element.level >= self.deepest {
            return false;
        }
        longest > self.edge_length
            || element.root.and_then(|f| self.by_face.get(f.index())).is_some_and(|&limit| longest > limit)
            || self.some_region_wants(element)
    }

    /// How many levels more a hex of `level` with these corners is refined with all its descendants, at least; an edge is
    /// divided into `parts`. Told by the target for all, and by regions that hold the whole hex.
    pub fn sure_levels(&self, corners: &[Point; 8], level: u8, parts: f64) -> u8 {
        // Edges of descendants along an axis are means of those of the hex, divided: so long along the mean direction.
        let along = |axis: usize| {
            let edges = || {
                let all = EDGES.iter().map(|edge| edge.map(usize::from));
                let along = all.filter(|&[a, b]| CORNERS[a][axis] != CORNERS[b][axis]);
                along.map(|[a, b]| corners[b] - corners[a])
            };
            let direction = edges().sum::<Point>().normalize_or_zero();
            edges().map(|edge| edge.dot(direction)).fold(f64::INFINITY, f64::min)
        };
        let longest = LazyCell::new(|| (0..3).map(along).fold(0.0, f64::max));
        let to_size = |limit: f64| {
            if limit == f64::INFINITY {
                return 0;
            }
            let lengths = std::iter::successors(Some(*longest), |length| Some(length / parts));
            lengths.take(usize::from(u8::MAX)).take_while(|&length| length > limit).count() as u8
        };
        let of_region = |region: &Graded| {
            let wanted = match region.target {
                Target::Size(size) => to_size(limit(size)),
                Target::Level(wanted) => wanted.saturating_sub(level),
            };
            if wanted > 1 && region.overlap.holds(corners) { wanted } else { 0 }
        };
        let deepest = match &self.index {
            None => self.regions.iter().map(of_region).max(),
            Some(index) => index.touching(&Aabb::around(corners)).map(|i| of_region(&self.regions[i])).max(),
        };
        deepest.unwrap_or(0).max(to_size(self.edge_length))
    }

    /// The regions that overlap none of `count` cells, by their places among the options'. `elements` gives the elements
    /// that a cell consists of.
    ///
    /// # Errors
    /// If the monitor stops it.
    pub fn idle_regions<const N: usize, E>(
        &self,
        count: usize,
        monitor: &dyn Monitor,
        elements: impl Fn(usize) -> E + Sync,
    ) -> Result<Vec<u32>, Cancelled>
    where
        [Point; N]: Corners,
        E: IntoIterator<Item = SizedElement<N>>,
    {
        if self.regions.is_empty() {
            return Ok(Vec::new());
        }
        let met = parallel::try_blocks(count, CELLS_AT_ONCE, monitor, |cells| {
            let mut met = vec![false; self.regions.len()];
            for probe in cells.flat_map(&elements).map(|element| Probe::new(&element)) {
                let mut look = |i: usize| met[i] = met[i] || self.regions[i].overlap.is_met(&probe, 0.0);
                match &self.index {
                    None => (0..self.regions.len()).for_each(&mut look),
                    Some(index) => index.touching(&probe.bounds_within(0.0)).for_each(&mut look),
                }
            }
            met
        })?;
        let is_idle = |i: &usize| !met.iter().any(|block| block[*i]);
        Ok((0..self.regions.len()).filter(is_idle).map(|i| i as u32).collect())
    }

    fn some_region_wants<const N: usize>(&self, element: &SizedElement<N>) -> bool
    where
        [Point; N]: Corners,
    {
        let probe = Probe::new(element);
        let wants = |region: &Graded| region.wants(element, &probe, self.spread);
        match &self.index {
            None => self.regions.iter().any(wants),
            Some(index) => {
                let near = probe.bounds_within(element.longest * self.spread);
                index.touching(&near).any(|i| wants(&self.regions[i]))
            }
        }
    }
}

/// Midpoints are rounded, and so are the lengths between them: a tenth of an edge may come out longer than 0.1. An edge
/// is longer than its target if it is so by more than this share.
const ROUNDING: f64 = 1e-9;

/// The greatest length that is not longer than `target`.
pub(crate) fn limit(target: f64) -> f64 {
    target * (1.0 + ROUNDING)
}

impl Graded {
    fn new(region: &Region) -> Self {
        Self { overlap: Overlap::new(&region.shape), target: region.target }
    }

    fn finest(&self) -> f64 {
        match self.target {
            Target::Size(size) => limit(size),
            Target::Level(_) => f64::INFINITY,
        }
    }

    fn deepest(&self) -> u8 {
        match self.target {
            Target::Size(_) => 0,
            Target::Level(level) => level,
        }
    }

    #[inline]
    fn wants<const N: usize>(&self, element: &SizedElement<N>, probe: &Probe<N>, spread: f64) -> bool
    where
        [Point; N]: Corners,
    {
        match self.target {
            Target::Level(level) => element.level < level && self.overlap.is_met(probe, 0.0),
            Target::Size(size) => {
                element.longest > limit(size) && self.overlap.is_met(probe, (element.longest - size) * spread)
            }
        }
    }
}

/// The edge length along which each face turns by `angle` degrees; empty if the surface is flat all over.
fn limits_by_curvature(
    input: &PolygonMesh,
    angle: f64,
    monitor: &dyn Monitor,
) -> Result<Vec<f64>, Cancelled> {
    let mut turns = turn_per_length(input, monitor)?;
    if turns.iter().all(|&turn| turn == 0.0) {
        return Ok(Vec::new());
    }
    turns.iter_mut().for_each(|turn| *turn = limit(angle / *turn));
    Ok(turns)
}

/// The longest edge of the quads into which face `f` is split: half of its edges, or from their middles to the
/// centre.
fn longest_child_edge(input: &PolygonMesh, f: usize) -> f64 {
    let points: Vec<Point> = input.face(f).iter().map(|n| input.positions[n.index()]).collect();
    let center = points.iter().sum::<Point>() / points.len() as f64;
    let next = points.iter().skip(1).chain(points.first());
    let edges = points.iter().zip(next).map(|(&a, &b)| {
        let middle = a.midpoint(b);
        a.distance_squared(middle).max(middle.distance_squared(center))
    });
    edges.fold(0.0, f64::max).sqrt()
}
