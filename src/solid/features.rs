//! Which edges are feature edges: where the surface is sharp, and where the file says so; without noise.
//!
//! Noise is what a mesh of a given edge length could not follow: chains of feature edges that end within a surface and
//! are shorter than an edge, and connected sets of feature edges that are shorter than two.

use super::shell::{Shell, triangle_of};
use crate::geometry::Point;
use crate::mesh::topology::Sets;
use crate::parallel;

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
                    chain.into_iter().for_each(|k| self.drop_edge(k));
                }
            }
            if dropped == before {
                return dropped;
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

    fn drop_edge(&mut self, k: u32) {
        for k in [k, self.shell.twin(k)] {
            self.is_feature[k as usize] = false;
            self.valence[self.shell.from(k) as usize] -= 1;
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
        small.iter().for_each(|&k| self.drop_edge(k));
        small.len()
    }
}
