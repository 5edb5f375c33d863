//! Which boundary quads stand for which surfaces (paper 5.2.3): flood fill between the paths.
//!
//! 1. Quads that no path parts are one region.
//! 2. A path gives the regions at its left and right the surfaces at its curve's left and right. Surfaces that one
//!    region gets become one.
//! 3. A region that gets none, because no path bounds it, takes the surface that most of it is nearest to.
//! 4. A surface that no region got, because all its curves were given up, becomes one with the surface of the quads that
//!    are nearest to it; it is lost if they are too few for its area, and no surface that
//!    it is one with anyhow is found.

use std::collections::BTreeMap;

use super::boundary::{Boundary, NONE};
use crate::geometry::Point;
use crate::mesh::topology::Sets;
use crate::parallel;
use crate::solid::{SolidModel, Surface, SurfaceId};
use crate::{Cancelled, Monitor};

/// The quads nearest to a surface have to have this share of its area for it not to be lost.
const PRESENT: f64 = 0.3;

/// Edges: how far before a quad the surface is looked for that it stands for.
const BEFORE: f64 = 0.25;

/// Surfaces that are one, and the surface of each quad.
pub(super) struct Labels {
    pub of_quads: Vec<SurfaceId>,
    /// Per surface the one that stands for it.
    pub surfaces: Vec<SurfaceId>,
    pub is_lost: Vec<bool>,
}

/// Labels all quads. `sides` names, for each spoke on a path, the surface at its left; `one` pairs of surfaces that are one.
pub(super) fn label_quads(
    boundary: &Boundary,
    solid: &SolidModel,
    sides: &[Option<SurfaceId>],
    one: &[[SurfaceId; 2]],
    monitor: &dyn Monitor,
) -> Result<Labels, Cancelled> {
    let (regions, count) = regions(boundary, sides);
    monitor.proceed()?;
    let mut united = Sets::new(solid.surfaces().len());
    let mut surface_of: Vec<Option<SurfaceId>> = vec![None; count];
    for (spoke, side) in boundary.spokes.iter().zip(sides) {
        let Some(side) = *side else { continue };
        let known = surface_of[regions[spoke.left as usize] as usize].get_or_insert(side);
        united.join(known.0, side.0, false);
    }
    let mut is_found = vec![false; solid.surfaces().len()];
    for surface in sides.iter().flatten() {
        is_found[surface.index()] = true;
    }
    let mut is_lost = vec![false; solid.surfaces().len()];
    if is_found.contains(&false) || surface_of.contains(&None) {
        let nearest = nearest_surfaces(boundary, solid, monitor)?;
        for surface in name_regions(boundary, &regions, &mut surface_of, &nearest) {
            is_found[surface.index()] = true;
        }
        let present = present(boundary, solid, &regions, &nearest);
        for surface in (0..is_found.len()).filter(|&s| !is_found[s]) {
            match present[surface].and_then(|region| surface_of[region as usize]) {
                Some(other) => _ = united.join(surface as u32, other.0, false),
                None => is_lost[surface] = true,
            }
        }
    }
    while let Some(&[a, b]) = one.iter().find(|pair| is_lost[pair[0].index()] != is_lost[pair[1].index()]) {
        united.join(a.0, b.0, false);
        [a, b].iter().for_each(|side| is_lost[side.index()] = false);
    }
    let surfaces: Vec<SurfaceId> = (0..is_lost.len()).map(|s| SurfaceId(united.root(s as u32).0)).collect();
    let of_region = |region: u32| surface_of[region as usize].map_or(SurfaceId(0), |s| surfaces[s.index()]);
    Ok(Labels { of_quads: regions.into_iter().map(of_region).collect(), surfaces, is_lost })
}

/// The region of each quad, and how many there are.
fn regions(boundary: &Boundary, sides: &[Option<SurfaceId>]) -> (Vec<u32>, usize) {
    let mut sets = Sets::new(boundary.quads.len());
    for (spoke, side) in boundary.spokes.iter().zip(sides) {
        if side.is_none() && spoke.twin != NONE {
            sets.join(spoke.left, boundary.spokes[spoke.twin as usize].left, false);
        }
    }
    let mut number = vec![NONE; boundary.quads.len()];
    let mut count = 0;
    for root in sets.roots() {
        number[root as usize] = count;
        count += 1;
    }
    let regions = (0..boundary.quads.len() as u32).map(|q| number[sets.root(q).0 as usize]).collect();
    (regions, count as usize)
}

/// For each quad the surface nearest to its middle, or to a place before it where the mesh's faces look the way the solid's do: of a
/// thin shell the middle may be nearer to the other side.
fn nearest_surfaces(
    boundary: &Boundary,
    solid: &SolidModel,
    monitor: &dyn Monitor,
) -> Result<Vec<SurfaceId>, Cancelled> {
    parallel::try_collect(boundary.quads.len(), monitor, |q| {
        let corners = boundary.quads[q].map(|n| boundary.points[n as usize]);
        let middle = corners.into_iter().sum::<Point>() / 4.0;
        let before =
            if boundary.looks_alike { BEFORE * boundary.lengths[boundary.quads[q][0] as usize] } else { 0.0 };
        let place = middle + boundary.area_vector(q as u32).normalize_or_zero() * before;
        solid.surface_of(solid.nearest(place).triangle as usize)
    })
}

/// Gives regions without a surface the one that most of their area is nearest to; these.
fn name_regions(
    boundary: &Boundary,
    regions: &[u32],
    surface_of: &mut [Option<SurfaceId>],
    nearest: &[SurfaceId],
) -> Vec<SurfaceId> {
    let mut votes: BTreeMap<u32, BTreeMap<SurfaceId, f64>> = BTreeMap::new();
    for (quad, &region) in (0..).zip(regions) {
        if surface_of[region as usize].is_none() {
            let of_region = votes.entry(region).or_default();
            *of_region.entry(nearest[quad as usize]).or_insert(0.0) += boundary.area_vector(quad).length();
        }
    }
    let mut given = Vec::new();
    for (region, of_region) in votes {
        let most = of_region.into_iter().max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)));
        surface_of[region as usize] = most.map(|(surface, _)| surface);
        given.extend(most.map(|(surface, _)| surface));
    }
    given
}

/// For each surface the region with most of the quads that are nearest to it, if they are enough for its area.
fn present(
    boundary: &Boundary,
    solid: &SolidModel,
    regions: &[u32],
    nearest: &[SurfaceId],
) -> Vec<Option<u32>> {
    let mut areas: Vec<BTreeMap<u32, f64>> = vec![BTreeMap::new(); solid.surfaces().len()];
    for (quad, surface) in (0..).zip(nearest) {
        let of_surface = areas[surface.index()].entry(regions[quad as usize]).or_insert(0.0);
        *of_surface += boundary.area_vector(quad).length();
    }
    let of_surface = |(areas, surface): (BTreeMap<u32, f64>, &Surface)| {
        let total: f64 = areas.values().sum();
        let most = areas.into_iter().max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0)))?;
        (total >= PRESENT * surface.area).then_some(most.0)
    };
    areas.into_iter().zip(solid.surfaces()).map(of_surface).collect()
}
