//! Where elements are to be refined: options and regions made ready for many questions.

use super::curvature::turn_per_length;
use super::probe::{self, Probe, TOUCH};
use super::region::Region;
use super::zone::{Zone, positive};
use super::{SizingError, Target};
use crate::geometry::{Aabb, Point};
use crate::mesh::{FaceId, PolygonMesh};

/// An element that asks whether it is to be refined.
#[derive(Clone, Copy, Debug)]
pub struct SizedElement {
    /// The positions of its nodes, in order around it.
    pub corners: [Point; 4],
    /// The length of its longest edge.
    pub longest: f64,
    /// Its refinement level.
    pub level: u8,
    /// The input face that it is part of.
    pub root: FaceId,
}

/// What a size field is made of.
#[derive(Clone, Copy, Debug)]
pub struct SizeOptions<'a> {
    /// No edge longer than this, anywhere.
    pub edge_length: Option<f64>,
    /// Turn of the surface's normal that one edge may span, in degrees.
    pub curvature: Option<f64>,
    /// How much larger an element may be than its neighbour, 1 < gradation <= 2. Outside a region of
    /// size `s`, at distance `d`, an element may be `s + (gradation - 1) * d` long; at 2, strong
    /// balance sees to that.
    pub gradation: f64,
    /// Where to refine further.
    pub regions: &'a [Region],
}

/// What is asked of an element.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Demand {
    /// No edge longer than this; infinite where any will do.
    pub length: f64,
    /// At least this level.
    pub level: u8,
}

/// An edge longer than its target by less than this share is not refined: exact halves of what the user
/// typed must not fail for the rounding of decimal coordinates.
const SLACK: f64 = 1e-6;

impl Demand {
    /// Nothing is asked.
    pub const NONE: Self = Self { length: f64::INFINITY, level: 0 };

    fn length(length: f64) -> Self {
        Self { length, ..Self::NONE }
    }

    /// True if the element falls short of the demand, so that it is to be refined.
    pub fn refines(&self, element: &SizedElement) -> bool {
        element.level < self.level || element.longest > self.length * (1.0 + SLACK)
    }

    /// What both ask.
    pub fn and(self, other: Self) -> Self {
        Self { length: self.length.min(other.length), level: self.level.max(other.level) }
    }
}

/// Tells which elements are to be refined. Made once, asked from many threads; answers depend on the
/// element and the options alone.
///
/// An element is refined while it overlaps a region by more than a touch (a thousandth of its size) and
/// is longer than the region's target, or its level is below the region's; or while it is longer than
/// the edge length, what curvature allows, or what gradation allows at its distance from a region.
#[derive(Debug)]
pub struct SizeField {
    edge_length: f64,
    /// For each input face the edge length that curvature allows; empty without curvature.
    curvature: Vec<f64>,
    /// Growth of the target per unit of distance from a region; `None` if balance sees to it.
    growth: Option<f64>,
    /// The most demanding first, so that most answers come early.
    regions: Vec<Prepared>,
}

#[derive(Debug)]
struct Prepared {
    zone: Zone,
    bounds: Aabb,
    target: Target,
}

impl SizeField {
    /// Checks the options and prepares them.
    ///
    /// # Errors
    /// If a number is out of range or a region makes no sense; says which and what to do.
    ///
    /// # Panics
    /// If curvature is asked for and `input` names nodes out of range.
    pub fn new(input: &PolygonMesh, options: SizeOptions<'_>) -> Result<Self, SizingError> {
        let SizeOptions { edge_length, curvature, gradation, regions } = options;
        if let Some(length) = edge_length.filter(|l| !l.is_finite() || *l <= 0.0) {
            return Err(SizingError::EdgeLength(length));
        }
        if let Some(degrees) = curvature.filter(|d| !d.is_finite() || *d <= 0.0) {
            return Err(SizingError::Curvature(degrees));
        }
        if !(gradation > 1.0 && gradation <= 2.0) {
            return Err(SizingError::Gradation(gradation));
        }
        let mut regions: Vec<_> =
            regions.iter().enumerate().map(|(i, r)| prepare(i, r)).collect::<Result<_, _>>()?;
        regions.sort_by(|a, b| rank(a.target).total_cmp(&rank(b.target)));
        let allowed =
            |degrees: f64| turn_per_length(input).into_iter().map(move |turn| degrees / turn).collect();
        Ok(Self {
            edge_length: edge_length.unwrap_or(f64::INFINITY),
            curvature: curvature.map_or_else(Vec::new, allowed),
            growth: (gradation < 2.0).then_some(gradation - 1.0),
            regions,
        })
    }

    /// True if no element of this level or deeper is to be refined, whatever its size and place.
    pub fn is_idle_from(&self, level: u8) -> bool {
        self.edge_length.is_infinite()
            && self.curvature.iter().all(|length| length.is_infinite())
            && self.regions.iter().all(|r| matches!(r.target, Target::Level(l) if l <= level))
    }

    /// True if the element is to be refined.
    pub fn wants(&self, element: &SizedElement) -> bool {
        self.everywhere(element).refines(element) || self.demands(element).any(|d| d.refines(element))
    }

    /// What is asked of the element. Regions count only if they ask for more than the element has, so
    /// where nothing asks for its refinement the answer may be [`Demand::NONE`].
    pub fn target(&self, element: &SizedElement) -> Demand {
        self.demands(element).fold(self.everywhere(element), Demand::and)
    }

    /// What is asked of the element whatever the regions.
    fn everywhere(&self, element: &SizedElement) -> Demand {
        let curved = self.curvature.get(element.root.index()).copied().unwrap_or(f64::INFINITY);
        Demand::length(self.edge_length.min(curved))
    }

    /// What each region asks that asks for more than the element has.
    fn demands<'a>(&'a self, element: &'a SizedElement) -> impl Iterator<Item = Demand> + 'a {
        let bounds = probe::bounds(element);
        // A thin region is taken to be a touch thick.
        let reach = bounds.grown(2.0 * TOUCH * element.longest);
        let mut probe = None;
        self.regions.iter().filter_map(move |region| {
            let inside = match region.target {
                Target::Size(size) => Demand::length(size),
                Target::Level(level) => Demand { level, ..Demand::NONE },
            };
            if !inside.refines(element) {
                return None;
            }
            let far = !region.bounds.touches(&reach);
            match (self.growth, region.target) {
                (Some(growth), Target::Size(size)) => {
                    let at = |distance: f64| Demand::length(size + growth * distance);
                    if !at(gap(&region.bounds, &bounds)).refines(element) {
                        return None;
                    }
                    let probe = probe.get_or_insert_with(|| Probe::of(element));
                    Some(if !far && region.zone.overlaps(probe) {
                        inside
                    } else {
                        at(region.zone.distance(probe))
                    })
                }
                _ if far => None,
                _ => {
                    let probe = probe.get_or_insert_with(|| Probe::of(element));
                    region.zone.overlaps(probe).then_some(inside)
                }
            }
        })
    }
}

fn prepare(index: usize, region: &Region) -> Result<Prepared, SizingError> {
    let fault = |fault| SizingError::Region { index, kind: region.shape.kind(), fault };
    if let Target::Size(size) = region.target {
        positive("the size", size).map_err(fault)?;
    }
    let zone = Zone::new(&region.shape).map_err(fault)?;
    Ok(Prepared { bounds: zone.bounds(), zone, target: region.target })
}

/// Orders targets by how much they ask for: levels first, the deepest before others, then sizes, the
/// smallest first.
fn rank(target: Target) -> f64 {
    match target {
        Target::Level(level) => -f64::from(level),
        Target::Size(size) => size,
    }
}

/// The distance between two boxes.
fn gap(a: &Aabb, b: &Aabb) -> f64 {
    (a.min - b.max).max(b.min - a.max).max(Point::ZERO).length()
}

#[cfg(test)]
mod tests;
