//! Surfaces: what a flood over the triangles reaches without crossing a feature edge.

use super::class::classify;
use super::entities::{Curve, CurveId, Surface, SurfaceId};
use super::shell::Shell;
use crate::geometry::{Aabb, Point, area_vector};
use crate::mesh::topology::Sets;
use crate::mesh::{FaceId, TagSet, Tags};

/// The surface of each triangle; surfaces are numbered in the order of their least triangles.
pub(super) fn flood(shell: &Shell, is_feature: &[bool]) -> Vec<SurfaceId> {
    let numbers = sets_across(shell, |k| !is_feature[k as usize]).numbers();
    numbers.into_iter().map(SurfaceId).collect()
}

/// The connected component of each triangle, numbered in the order of their least triangles.
pub(super) fn components(shell: &Shell) -> Vec<u32> {
    sets_across(shell, |_| true).numbers()
}

/// Triangles united across the half-edges that are `open`.
fn sets_across(shell: &Shell, open: impl Fn(u32) -> bool) -> Sets {
    let mut sets = Sets::new(shell.mesh.triangles.len());
    for k in 0..shell.len() as u32 {
        if k < shell.twin(k) && open(k) {
            sets.join(k / 3, shell.twin(k) / 3, false);
        }
    }
    sets
}

/// The surfaces, from the surface and the body of each triangle.
pub(super) fn surfaces(shell: &Shell, of: &[SurfaceId], body_of: &[u32], curves: &[Curve]) -> Vec<Surface> {
    let count = of.iter().max().map_or(0, |s| s.index() + 1);
    let mut triangles = vec![Vec::new(); count];
    for (t, s) in of.iter().enumerate() {
        triangles[s.index()].push(t as u32);
    }
    let mut bounding = vec![Vec::new(); count];
    for (c, curve) in curves.iter().enumerate() {
        let [left, right] = curve.sides;
        bounding[left.index()].push(CurveId::new(c));
        if right != left {
            bounding[right.index()].push(CurveId::new(c));
        }
    }
    let surface = |(triangles, curves): (Vec<u32>, Vec<CurveId>)| {
        let areas = || triangles.iter().map(|&t| area_vector(&shell.mesh.at(t as usize)));
        let corners: Vec<Point> = triangles.iter().flat_map(|&t| shell.mesh.at(t as usize)).collect();
        Surface {
            area: areas().map(Point::length).sum(),
            class: classify(areas()),
            bounds: Aabb::around(&corners),
            body: body_of[triangles[0] as usize],
            curves,
            triangles,
        }
    };
    triangles.into_iter().zip(bounding).map(surface).collect()
}

/// For each surface the names that the file has for all of it, from the file's face of each triangle; nothing if the file
/// has no names.
pub(super) fn groups_of_file(surfaces: &[Surface], tags: &Tags, face_of: &[FaceId]) -> Vec<Vec<String>> {
    if tags.of_element.is_empty() {
        return Vec::new();
    }
    let names: Vec<Vec<String>> = tags.sets.iter().map(TagSet::names).collect();
    let groups = |surface: &Surface| {
        let set_of = |t: u32| tags.of_element[face_of[t as usize].index()] as usize;
        let mut last = set_of(surface.triangles[0]);
        let mut common = names[last].clone();
        for &t in &surface.triangles {
            let set = set_of(t);
            if set != last {
                common.retain(|name| names[set].contains(name));
                last = set;
            }
        }
        common
    };
    surfaces.iter().map(groups).collect()
}
