//! Which edges are feature edges: where the surface is sharp, and where the file says so; without noise.
//!
//! A crease may fade for a short way, such as where a fillet's triangles are smaller: it is taken to go on there.
//!
//! Noise is what a mesh of a given edge length could not follow: chains of feature edges that end within a surface and
//! are shorter than an edge, and connected sets of feature edges that are shorter than two.

use super::shell::{Shell, triangle_of};
use crate::geometry::Point;
use crate::mesh::topology::Sets;
use crate::parallel;

/// A crease goes on where the normals differ by more than this share of the feature angle.
const FADED: f64 = 0.4;

/// For so far at most, as a share of what there is of it on one side.
const GAP: f64 = 0.05;

/// The cosine of 45 degrees: it turns by less from edge to edge there.
const AHEAD: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// For each half-edge whether the normals of its two triangles differ by more than `feature_angle` degrees.
pub(super) fn sharp_edges(shell: &Shell, normals: &[Point], feature_angle: f64) -> Vec<bool> {
    let cosine = libm::cos(feature_angle.to_radians());
    parallel::collect(shell.len(), |k| {
        let twin = shell.twins[k];
        normals[triangle_of(k as u32)].dot(normals[triangle_of(twin)]) < cosine
    })
}

/// The angle inside the solid between the two triangles at a half-edge, in degrees.
pub(super) fn interior_angle(shell: &Shell, normals: &[Point], k: u32) -> f64 {
    let [left, right] = [k, shell.twin(k)].map(|k| normals[triangle_of(k)]);
    let across = left.cross(right);
    let turn = libm::atan2(across.length(), left.dot(right)).to_degrees();
    180.0 - turn.copysign(across.dot(shell.along(k)))
}

/// Takes noise out of the feature edges, for a mesh of the given edge length; what the file marks is none. Returns how
/// many edges it was.
pub(super) fn drop_noise(shell: &Shell, is_feature: &mut [bool], tagged: &[bool], edge_length: f64) -> usize {
    let mut graph = FeatureGraph::new(shell, is_feature, tagged);
    let loose = graph.drop_loose_ends(edge_length);
    loose + graph.drop_small_sets(2.0 * edge_length)
}

/// Closes gaps in creases: where a chain of feature edges ends within a surface, and ahead along edges that are nearly as
/// sharp another one does, or the same. What the file marks ends where it ends.
pub(super) fn close_gaps(
    shell: &Shell,
    normals: &[Point],
    is_feature: &mut [bool],
    tagged: &[bool],
    feature_angle: f64,
) {
    let is_faded = sharp_edges(shell, normals, FADED * feature_angle);
    let mut graph = FeatureGraph::new(shell, is_feature, tagged);
    for v in 0..graph.valence.len() as u32 {
        if graph.valence[v as usize] == 1 {
            graph.gap(v, &is_faded).into_iter().for_each(|k| graph.set_edge(k, true));
        }
    }
}

struct FeatureGraph<'a> {
    shell: &'a Shell,
    is_feature: &'a mut [bool],
    tagged: &'a [bool],
    /// A half-edge out of each vertex.
    out: Vec<u32>,
    /// Feature edges at each vertex.
    valence: Vec<u32>,
}

impl<'a> FeatureGraph<'a> {
    fn new(shell: &'a Shell, is_feature: &'a mut [bool], tagged: &'a [bool]) -> Self {
        let mut valence = vec![0; shell.mesh.points.len()];
        for k in (0..shell.len() as u32).filter(|&k| is_feature[k as usize]) {
            valence[shell.from(k) as usize] += 1;
        }
        Self { shell, is_feature, tagged, out: shell.out_of(), valence }
    }

    /// Drops chains that end within a surface and are shorter than `length`, until there are none.
    fn drop_loose_ends(&mut self, length: f64) -> usize {
        let mut dropped = 0;
        loop {
            let before = dropped;
            for v in 0..self.valence.len() as u32 {
                if self.valence[v as usize] == 1 {
                    let chain = self.loose_chain(v, length);
                    dropped += chain.len();
                    chain.into_iter().for_each(|k| self.set_edge(k, false));
                }
            }
            if dropped == before {
                return dropped;
            }
        }
    }

    /// The way from the end of a chain to another end; empty if there is none.
    fn gap(&self, end: u32, is_faded: &[bool]) -> Vec<u32> {
        let chain = self.loose_chain(end, f64::INFINITY);
        let length: f64 = chain.iter().map(|&k| self.shell.along(k).length()).sum();
        let mut way = chain.first().map_or(Point::ZERO, |&k| -self.shell.along(k).normalize_or_zero());
        let (mut gap, mut so_far, mut vertex) = (Vec::new(), 0.0, end);
        loop {
            let arms = self.shell.fan(self.out[vertex as usize]);
            let faded = arms.filter(|&k| is_faded[k as usize] && !self.is_feature[k as usize]);
            let ahead = |k: u32| self.shell.along(k).normalize_or_zero().dot(way);
            let Some(k) = faded.filter(|&k| ahead(k) > AHEAD).max_by(|&k, &l| ahead(k).total_cmp(&ahead(l)))
            else {
                return Vec::new();
            };
            so_far += self.shell.along(k).length();
            gap.push(k);
            (vertex, way) = (self.shell.to(k), self.shell.along(k).normalize_or_zero());
            match self.valence[vertex as usize] {
                0 if so_far < GAP * length => {}
                1 if so_far < GAP * length => return gap,
                _ => return Vec::new(),
            }
        }
    }

    /// The chain from an end to where it branches or ends; empty if it is not shorter than `length`, or marked.
    fn loose_chain(&self, end: u32, length: f64) -> Vec<u32> {
        let (mut chain, mut so_far, mut vertex) = (Vec::new(), 0.0, end);
        loop {
            let back = chain.last().map(|&k| self.shell.twin(k));
            let mut arms = self.shell.fan(self.out[vertex as usize]);
            let Some(k) = arms.find(|&k| self.is_feature[k as usize] && Some(k) != back) else {
                return chain;
            };
            so_far += self.shell.along(k).length();
            if so_far >= length || self.tagged[k as usize] {
                return Vec::new();
            }
            chain.push(k);
            vertex = self.shell.to(k);
            if self.valence[vertex as usize] != 2 {
                return chain;
            }
        }
    }

    fn set_edge(&mut self, k: u32, is_feature: bool) {
        for k in [k, self.shell.twin(k)] {
            self.is_feature[k as usize] = is_feature;
            let valence = &mut self.valence[self.shell.from(k) as usize];
            *valence = if is_feature { *valence + 1 } else { *valence - 1 };
        }
    }

    /// Drops connected sets of feature edges that are shorter than `length` in all.
    fn drop_small_sets(&mut self, length: f64) -> usize {
        let shell = self.shell;
        let features: Vec<u32> =
            (0..shell.len() as u32).filter(|&k| self.is_feature[k as usize] && k < shell.twin(k)).collect();
        let mut sets = Sets::new(self.valence.len());
        for &k in &features {
            sets.join(shell.from(k), shell.to(k), false);
        }
        let mut lengths = vec![0.0; self.valence.len()];
        for &k in &features {
            let length = if self.tagged[k as usize] { f64::INFINITY } else { shell.along(k).length() };
            lengths[sets.root(shell.from(k)).0 as usize] += length;
        }
        let is_small = |k: &u32| lengths[sets.root(shell.from(*k)).0 as usize] < length;
        let small: Vec<u32> = features.into_iter().filter(is_small).collect();
        small.iter().for_each(|&k| self.set_edge(k, false));
        small.len()
    }
}
