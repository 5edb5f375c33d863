//! The directions that matter in a solid, each with the area that speaks for it.
//!
//! 1. Triangles are united to planar facets: a flood from the largest that is left, over neighbours whose normals agree
//!    with its own. So a plane is found also where it goes over into a fillet and both are one surface.
//! 2. A facet that goes over smoothly into others of about its size is a strip of a curved surface, and speaks for nothing.
//! 3. Planes, and the axes of extruded surfaces, are clustered from the largest down; the two ends of a direction are one.

use crate::geometry::{Point, area_vector};
use crate::parallel::{greatest_first, put_greatest_first};
use crate::solid::{SolidModel, Surface, SurfaceClass};

/// The cosine of 0.1 degrees: normals that differ by less are of one plane.
const COPLANAR: f64 = 1.0 - 1.5e-6;
/// The cosine of 2 degrees: directions that differ by less are one.
pub(in crate::hexing) const PARALLEL: f64 = 0.999_390_827;
/// The sine of 2 degrees: directions whose dot product is less are perpendicular.
pub(in crate::hexing) const PERPENDICULAR: f64 = 0.034_899_497;
/// A facet so many times as large as any that it goes over into smoothly is a plane between fillets. A curved surface has
/// strips of about one width.
const WIDER: f64 = 4.0;
/// A surface whose mean normal is shorter than this looks everywhere.
const CLEAR: f64 = 0.1;
/// So many of the largest planes are clustered: what smaller ones say comes to little, and the time may go with the
/// square of their number.
const PLANES: usize = 4096;

/// A unit direction, with an area.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Weighted {
    pub direction: Point,
    pub area: f64,
}

/// Puts those of the largest area first.
fn largest_first(all: &mut Vec<Weighted>) {
    put_greatest_first(all, |weighted| weighted.area);
}

/// Are two unit directions one, up to the sign?
pub(super) fn is_parallel(a: Point, b: Point) -> bool {
    a.dot(b).abs() > PARALLEL
}

/// Are two unit directions perpendicular?
pub(super) fn is_perpendicular(a: Point, b: Point) -> bool {
    a.dot(b).abs() < PERPENDICULAR
}

/// The planes of the boundary, the largest first: facets that are no strips of a curved surface.
pub(super) fn planes(solid: &SolidModel) -> Vec<Weighted> {
    let (facet_of, facets) = facets(solid);
    // The largest facet beside each that goes over into it smoothly.
    let mut beside = vec![0.0_f64; facets.len()];
    for t in 0..facet_of.len() {
        for u in (0..3).map(|side| solid.across(t, side) as usize) {
            if solid.surface_of(t) == solid.surface_of(u) && facet_of[t] != facet_of[u] {
                let beside = &mut beside[facet_of[t] as usize];
                *beside = beside.max(facets[facet_of[u] as usize].length());
            }
        }
    }
    let of_plane = |(area, beside): (Point, f64)| {
        let size = area.length();
        (size > WIDER * beside).then(|| Weighted { direction: area / size, area: size })
    };
    let mut planes: Vec<Weighted> = facets.into_iter().zip(beside).filter_map(of_plane).collect();
    largest_first(&mut planes);
    planes.truncate(PLANES);
    planes
}

/// The facet of each triangle, and the area vector of each facet.
fn facets(solid: &SolidModel) -> (Vec<u32>, Vec<Point>) {
    let areas: Vec<Point> = (0..solid.triangles().len()).map(|t| area_vector(&solid.corners_of(t))).collect();
    let sizes: Vec<f64> = areas.iter().map(|a| a.length()).collect();
    let by_size = greatest_first(sizes.iter().copied()).map(|t| t as u32);
    let mut facet_of = vec![u32::MAX; areas.len()];
    let mut facets = Vec::new();
    let mut front = Vec::new();
    for seed in by_size {
        if facet_of[seed as usize] != u32::MAX {
            continue;
        }
        let (facet, normal) = (facets.len() as u32, areas[seed as usize].normalize_or_zero());
        facet_of[seed as usize] = facet;
        front.push(seed);
        let mut sum = Point::ZERO;
        while let Some(t) = front.pop() {
            sum += areas[t as usize];
            for u in (0..3).map(|side| solid.across(t as usize, side) as usize) {
                if facet_of[u] == u32::MAX && areas[u].dot(normal) >= COPLANAR * sizes[u] {
                    facet_of[u] = facet;
                    front.push(u as u32);
                }
            }
        }
        facets.push(sum);
    }
    (facet_of, facets)
}

/// The axes of the extruded surfaces.
pub(super) fn axes(solid: &SolidModel) -> Vec<Weighted> {
    let axis = |s: &Surface| match s.class {
        SurfaceClass::Cylindrical { axis } => Some(Weighted { direction: axis, area: s.area }),
        _ => None,
    };
    solid.surfaces().iter().filter_map(axis).collect()
}

/// The mean normals of the surfaces that are neither planar nor extruded, if they have one.
pub(super) fn means(solid: &SolidModel) -> Vec<Weighted> {
    let mean = |s: &Surface| {
        let sum: Point = s.triangles.iter().map(|&t| area_vector(&solid.corners_of(t as usize))).sum();
        let is_one = s.class == SurfaceClass::General && sum.length() > CLEAR * s.area;
        is_one.then(|| Weighted { direction: sum.normalize(), area: s.area })
    };
    solid.surfaces().iter().filter_map(mean).collect()
}

/// Clusters of directions, the largest first. A cluster has the direction of its largest member.
pub(super) fn clusters(mut members: Vec<Weighted>) -> Vec<Weighted> {
    largest_first(&mut members);
    let mut clusters: Vec<Weighted> = Vec::new();
    for member in members {
        match clusters.iter_mut().find(|c| is_parallel(c.direction, member.direction)) {
            Some(cluster) => cluster.area += member.area,
            None => clusters.push(member),
        }
    }
    largest_first(&mut clusters);
    clusters
}
