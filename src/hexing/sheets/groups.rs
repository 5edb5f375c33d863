//! Surfaces in groups: those that meet so flatly, or at a concave curve, that one sheet has to lie over all of them.

use super::super::correspondence::{Anchor, Reduction};
use crate::mesh::topology::Sets;
use crate::solid::{Arm, Corner, CornerId, CurveId, SolidModel, SurfaceId};

/// Surfaces that meet at a greater angle inside the solid than this belong to one group, in degrees; so do those on both
/// sides of a sector of a surface that is wider than this at a corner. One hex at such a place would be nearly flat or
/// worse.
const FLAT: f64 = 140.0;

/// Where surfaces meet at a less angle than this, in degrees, two hexes are too thin.
const THIN: f64 = 75.0;

/// The groups of a solid's surfaces.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct Groups {
    /// The group of each surface, by the least surface in it.
    of_surface: Vec<u32>,
    /// The angle inside the solid at which the sides of each curve meet, in degrees.
    angles: Vec<f64>,
    /// The corners where a surface has a sector wider than [`FLAT`].
    wide: Vec<(CornerId, SurfaceId)>,
}

impl Groups {
    /// The groups of the surfaces of `solid` that stand for others after `reduction`.
    pub(super) fn of(solid: &SolidModel, reduction: &Reduction) -> Self {
        Self::with(solid, |surface| reduction.surface(surface), |corner| reduction.corner(corner))
    }

    /// The groups, where `surface` and `corner` tell what stands for each.
    pub(super) fn with(
        solid: &SolidModel,
        surface: impl Fn(SurfaceId) -> SurfaceId,
        corner: impl Fn(CornerId) -> CornerId,
    ) -> Self {
        let mut sets = Sets::new(solid.surfaces().len());
        let mut unite = |a: SurfaceId, b: SurfaceId| {
            sets.join(surface(a).0, surface(b).0, false);
        };
        for curve in solid.curves().iter().filter(|curve| curve.interior_angle > FLAT) {
            let [a, b] = curve.sides;
            unite(a, b);
        }
        let mut wide = Vec::new();
        for sector in sectors(solid) {
            if sector.degrees > FLAT {
                let [a, b] = sector.beside;
                unite(a, b);
                wide.push((corner(sector.corner), surface(sector.surface)));
            }
        }
        wide.sort_unstable();
        let group = |s: usize| sets.root(surface(SurfaceId::new(s)).0).0;
        let of_surface = (0..solid.surfaces().len()).map(group).collect();
        let angles = solid.curves().iter().map(|curve| curve.interior_angle).collect();
        Self { of_surface, angles, wide }
    }

    /// Makes one group of two.
    pub(super) fn unite(&mut self, a: u32, b: u32) {
        let (least, other) = (a.min(b), a.max(b));
        self.of_surface.iter_mut().filter(|group| **group == other).for_each(|group| *group = least);
    }

    /// The group of a surface.
    pub(super) fn group(&self, surface: SurfaceId) -> u32 {
        self.of_surface[surface.index()]
    }

    /// No group is numbered this or higher.
    pub(super) fn bound(&self) -> usize {
        self.of_surface.len()
    }

    /// The angle inside the solid at which the sides of the curve meet, in degrees.
    pub(super) fn angle(&self, curve: CurveId) -> f64 {
        self.angles[curve.index()]
    }

    /// Do the sides of the curve meet so flatly that no hex may have it for an edge of two boundary quads?
    pub(super) fn is_flat(&self, curve: CurveId) -> bool {
        self.angle(curve) > FLAT
    }

    /// Do the sides of the curve meet so sharply that there is room for one hex alone?
    pub(super) fn is_thin(&self, curve: CurveId) -> bool {
        self.angle(curve) < THIN
    }

    /// Is a quad of the surface flat at a node there, if both of its edges lie on curves?
    pub(super) fn is_wide(&self, at: Anchor, surface: SurfaceId) -> bool {
        match at {
            Anchor::Corner(corner) => self.wide.binary_search(&(corner, surface)).is_ok(),
            _ => true, // a smooth curve
        }
    }
}

/// What is between two arms of a corner.
struct Sector {
    corner: CornerId,
    surface: SurfaceId,
    degrees: f64,
    /// The surfaces across the two arms.
    beside: [SurfaceId; 2],
}

/// The sectors of all corners.
fn sectors(solid: &SolidModel) -> impl Iterator<Item = Sector> {
    // A curve's left side comes after it where it starts, its right side where it ends.
    let surface = |arm: &Arm| solid.curves()[arm.curve.index()].sides[usize::from(!arm.at_start)];
    (0..).map(CornerId).zip(solid.corners()).flat_map(move |(corner, Corner { arms, .. })| {
        let count = arms.len();
        let sector = move |k: usize| Sector {
            corner,
            surface: surface(&arms[k]),
            degrees: arms[k].sector.to_degrees(),
            beside: [k + count - 1, k + 1].map(|k| surface(&arms[k % count])),
        };
        (0..count).map(sector)
    })
}

#[cfg(test)]
impl Groups {
    /// Groups as given, all curves between groups sharp and all sectors narrow.
    pub(super) fn given(of_surface: &[u32], is_flat: &[bool]) -> Self {
        let angles = is_flat.iter().map(|&is_flat| if is_flat { 180.0 } else { 90.0 }).collect();
        Self { of_surface: of_surface.to_vec(), angles, wide: Vec::new() }
    }

    /// The same, where these curves leave room for one hex alone.
    pub(super) fn with_thin(mut self, curves: &[CurveId]) -> Self {
        curves.iter().for_each(|curve| self.angles[curve.index()] = 60.0);
        self
    }
}
