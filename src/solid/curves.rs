//! Corners and curves: the graph of the feature edges.
//!
//! 1. A vertex is a corner if one feature edge ends there or more than two meet, or if the two that meet turn sharply.
//! 2. Curves are walked from the corners, in the order of their vertices and, at each, counter-clockwise.
//! 3. What is left are closed curves without a corner. Each starts at its least half-edge.

use super::entities::{Arm, Corner, CornerId, Curve, CurveId, SurfaceId};
use super::features::interior_angle;
use super::shell::{NONE, Shell, triangle_of};
use crate::geometry::Point;

/// Unit vectors whose difference is below this are one direction: far above rounding, far below what shows.
const SAME: f64 = 1e-6;

/// The corners and curves of a shell, with the surface of each of its triangles.
pub(super) struct CurveGraph {
    pub corners: Vec<Corner>,
    pub curves: Vec<Curve>,
}

/// Walks the feature edges.
pub(super) fn curve_graph(
    shell: &Shell,
    normals: &[Point],
    is_feature: &[bool],
    surface_of: &[SurfaceId],
    corner_angle: f64,
) -> CurveGraph {
    let out = shell.out_of();
    let arms_at: Vec<Vec<u32>> = out.iter().map(|&k| feature_arms(shell, is_feature, k)).collect();
    let cosine = libm::cos(corner_angle.to_radians());
    let is_corner: Vec<bool> = arms_at.iter().map(|arms| is_corner(shell, arms, cosine)).collect();
    let mut walk = Walk { shell, arms_at: &arms_at, is_corner: &is_corner, place: vec![None; shell.len()] };
    let corner_vertices: Vec<u32> = (0..out.len() as u32).filter(|&v| is_corner[v as usize]).collect();
    let starts = corner_vertices.iter().flat_map(|&v| arms_at[v as usize].iter().copied());
    let loops = (0..shell.len() as u32).filter(|&k| is_feature[k as usize]);
    let mut chains: Vec<Vec<u32>> = Vec::new();
    for k in starts.chain(loops) {
        if walk.place[k as usize].is_none() {
            let chain = walk.chain(k, CurveId::new(chains.len()));
            chains.push(chain);
        }
    }
    let mut corner_of = vec![NONE; out.len()];
    for (c, &v) in corner_vertices.iter().enumerate() {
        corner_of[v as usize] = c as u32;
    }
    let corner = |&vertex: &u32| {
        let arms = &arms_at[vertex as usize];
        let arm = |(&k, sector)| Arm { sector, ..walk.place[k as usize].expect("walked") };
        Corner {
            vertex,
            point: shell.mesh.points[vertex as usize],
            arms: arms.iter().zip(sectors(shell, arms)).map(arm).collect(),
        }
    };
    let curve = |chain: &Vec<u32>| curve(shell, normals, surface_of, &corner_of, chain);
    CurveGraph {
        corners: corner_vertices.iter().map(corner).collect(),
        curves: chains.iter().map(curve).collect(),
    }
}

/// The feature half-edges out of the start of `k`, counter-clockwise.
fn feature_arms(shell: &Shell, is_feature: &[bool], k: u32) -> Vec<u32> {
    shell.fan(k).filter(|&l| is_feature[l as usize]).collect()
}

/// Do curves end at the vertex that these feature half-edges leave?
fn is_corner(shell: &Shell, arms: &[u32], cosine: f64) -> bool {
    match *arms {
        [] => false,
        [k, l] => {
            let [a, b] = [k, l].map(|k| shell.along(k).normalize_or_zero());
            -a.dot(b) < cosine
        }
        _ => true,
    }
}

/// The angles between these half-edges, which leave one vertex and are in their order there.
fn sectors(shell: &Shell, arms: &[u32]) -> Vec<f64> {
    let mut sectors: Vec<f64> = Vec::with_capacity(arms.len());
    for k in shell.fan(arms[0]) {
        if arms.get(sectors.len()) == Some(&k) {
            sectors.push(0.0);
        }
        let [a, b] = [k, shell.around(k)].map(|k| shell.along(k));
        *sectors.last_mut().expect("the first is an arm") += libm::atan2(a.cross(b).length(), a.dot(b));
    }
    sectors
}

struct Walk<'a> {
    shell: &'a Shell,
    arms_at: &'a [Vec<u32>],
    is_corner: &'a [bool],
    /// For each half-edge that is walked, the curve of which it is part, and whether it runs along it or against it. No
    /// sectors yet.
    place: Vec<Option<Arm>>,
}

impl Walk<'_> {
    /// Walks from `k` to the next corner, or around to `k`.
    fn chain(&mut self, first: u32, curve: CurveId) -> Vec<u32> {
        let mut chain = vec![first];
        let mut k = first;
        loop {
            let back = self.shell.twin(k);
            self.place[k as usize] = Some(Arm { curve, at_start: true, sector: 0.0 });
            self.place[back as usize] = Some(Arm { curve, at_start: false, sector: 0.0 });
            let vertex = self.shell.from(back) as usize;
            if self.is_corner[vertex] {
                return chain;
            }
            let arms = &self.arms_at[vertex];
            k = if arms[0] == back { arms[1] } else { arms[0] };
            if k == first {
                return chain;
            }
            chain.push(k);
        }
    }
}

fn curve(
    shell: &Shell,
    normals: &[Point],
    surface_of: &[SurfaceId],
    corner_of: &[u32],
    chain: &[u32],
) -> Curve {
    let (first, last) = (chain[0], *chain.last().expect("an edge"));
    let mut vertices: Vec<u32> = chain.iter().map(|&k| shell.from(k)).collect();
    vertices.push(shell.to(last));
    let corner = |v: u32| Some(corner_of[v as usize]).filter(|&c| c != NONE).map(CornerId);
    let length: f64 = chain.iter().map(|&k| shell.along(k).length()).sum();
    let angles = chain.iter().map(|&k| shell.along(k).length() * interior_angle(shell, normals, k));
    let direction = |&k: &u32| shell.along(k).normalize_or_zero();
    Curve {
        ends: corner(shell.from(first)).zip(corner(shell.to(last))).map(|(a, b)| [a, b]),
        sides: [first, shell.twin(first)].map(|k| surface_of[triangle_of(k)]),
        interior_angle: angles.sum::<f64>() / length,
        is_straight: chain.iter().all(|k| direction(k).distance(direction(&first)) <= SAME),
        length,
        vertices,
    }
}
