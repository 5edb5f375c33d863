//! Hexes in columns over the quads of a face, of which some are left out.
//!
//! ```text
//!   +---+---+      Of the four hexes around the node in the middle two are kept, which share an edge alone: the mesh would
//!   |in |   |      not be a manifold there. The others are taken back in.
//!   +---o---+
//!   |   |in |
//!   +---+---+
//! ```

use crate::mesh::topology::{Bins, Sets};
use crate::{Cancelled, Monitor};

/// Which hexes are kept: numbered layer by layer, in each as the quads are.
pub(super) struct Columns<'a> {
    quads: &'a [[u32; 4]],
    points: usize,
    /// Corners of quads, 4 q + i, by their points.
    corners_at: Bins,
    is_kept: Vec<bool>,
}

/// Do two quads have two points in common?
pub(super) fn share_an_edge(a: &[u32; 4], b: &[u32; 4]) -> bool {
    a.iter().filter(|p| b.contains(p)).count() >= 2
}

impl<'a> Columns<'a> {
    /// Quads over so many points, of which each has one fan of quads, and whether each hex over them is kept.
    pub fn new(points: usize, quads: &'a [[u32; 4]], is_kept: Vec<bool>) -> Self {
        let corners = quads.as_flattened();
        let corners_at = Bins::of(points, corners.len(), |k| corners[k] as usize);
        Self { quads, points, corners_at, is_kept }
    }

    /// Takes hexes back in until those that are kept are a manifold with boundary; their numbers, ascending. Around a node
    /// that is pinched all come back, so that it ends.
    pub fn made_manifold(mut self, monitor: &dyn Monitor) -> Result<Vec<u32>, Cancelled> {
        let layers = self.is_kept.len() / self.quads.len() + 1;
        let mut nodes: Vec<usize> = (0..self.points * layers).collect();
        while !nodes.is_empty() {
            monitor.proceed()?;
            let mut changed = Vec::new();
            for node in nodes {
                let around = self.around(node);
                if self.is_pinched(node, &around) {
                    changed.extend(around.into_iter().filter(|&hex| !self.is_kept[hex]));
                    changed.iter().for_each(|&hex| self.is_kept[hex] = true);
                }
            }
            nodes = changed.into_iter().flat_map(|hex| self.nodes_of(hex)).collect();
            nodes.sort_unstable();
            nodes.dedup();
        }
        Ok((0..self.is_kept.len() as u32).filter(|&hex| self.is_kept[hex as usize]).collect())
    }

    fn nodes_of(&self, hex: usize) -> [usize; 8] {
        let (quad, layer) = (self.quads[hex % self.quads.len()], hex / self.quads.len());
        [0, 1, 2, 3, 4, 5, 6, 7].map(|k| quad[k % 4] as usize + (layer + k / 4) * self.points)
    }

    /// The hexes around a node.
    fn around(&self, node: usize) -> Vec<usize> {
        let (point, level) = (node % self.points, node / self.points);
        let layers = self.is_kept.len() / self.quads.len();
        let beside = level.saturating_sub(1)..layers.min(level + 1);
        let quads = self.corners_at.at(point).iter().map(|&k| k as usize / 4);
        beside.flat_map(|layer| quads.clone().map(move |quad| quad + layer * self.quads.len())).collect()
    }

    /// Do the hexes around a node that are kept not hang together by faces there, or what is around them?
    fn is_pinched(&self, node: usize, around: &[usize]) -> bool {
        let kept = around.iter().filter(|&&hex| self.is_kept[hex]).count();
        if kept == 0 || kept == around.len() {
            return false;
        }
        let count = self.quads.len();
        // The last is what lies beyond the columns.
        let mut parts = Sets::new(around.len() + 1);
        let beyond = around.len();
        for (i, &a) in around.iter().enumerate() {
            for (j, &b) in around.iter().enumerate().take(i) {
                let is_above = a % count == b % count;
                let is_beside = a / count == b / count && self.are_beside(a % count, b % count);
                if (is_above || is_beside) && self.is_kept[a] == self.is_kept[b] {
                    parts.join(i as u32, j as u32, false);
                }
            }
            if !self.is_kept[a] && self.is_at_rim(node, a) {
                parts.join(i as u32, beyond as u32, false);
            }
        }
        let of = parts.numbers();
        let mut inside: Vec<u32> = (0..beyond).filter(|&i| self.is_kept[around[i]]).map(|i| of[i]).collect();
        let mut outside: Vec<u32> =
            (0..beyond).filter(|&i| !self.is_kept[around[i]]).map(|i| of[i]).collect();
        if around.iter().any(|&hex| self.is_at_rim(node, hex)) {
            outside.push(of[beyond]);
        }
        [&mut inside, &mut outside].into_iter().any(|parts| {
            parts.sort_unstable();
            parts.dedup();
            parts.len() > 1
        })
    }

    fn are_beside(&self, a: usize, b: usize) -> bool {
        share_an_edge(&self.quads[a], &self.quads[b])
    }

    /// Has a hex a face at a node beyond which there are no columns?
    fn is_at_rim(&self, node: usize, hex: usize) -> bool {
        let (point, level) = (node % self.points, node / self.points);
        let layers = self.is_kept.len() / self.quads.len();
        if level == 0 || level == layers {
            return true;
        }
        let quad = &self.quads[hex % self.quads.len()];
        let at = quad.iter().position(|&p| p as usize == point).expect("a corner of the quad");
        [quad[(at + 1) % 4], quad[(at + 3) % 4]].into_iter().any(|other| {
            let with_both = |&&k: &&u32| self.quads[k as usize / 4].contains(&other);
            self.corners_at.at(point).iter().filter(with_both).count() == 1
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Silent;

    /// A square of `n` x `n` quads.
    fn square(n: u32) -> Vec<[u32; 4]> {
        let at = |x, y| x + (n + 1) * y;
        let quad = |k: u32| (k % n, k / n);
        (0..n * n).map(quad).map(|(x, y)| [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)]).collect()
    }

    #[test]
    fn what_touches_at_an_edge_or_a_node_is_joined() {
        let quads = square(3);
        let manifold = |kept: &[usize]| {
            let is_kept = (0..27).map(|hex| kept.contains(&hex)).collect();
            Columns::new(16, &quads, is_kept).made_manifold(&Silent).unwrap().len()
        };
        // Two that share a face, an edge along the columns, one across them, a node, nothing.
        assert_eq!(manifold(&[0, 1]), 2);
        assert_eq!(manifold(&[0, 4]), 4);
        assert_eq!(manifold(&[0, 10]), 4);
        assert_eq!(manifold(&[0, 13]), 8);
        assert_eq!(manifold(&[0, 26]), 2);
        // A bubble stays; so does all.
        let all: Vec<usize> = (0..27).collect();
        assert_eq!(manifold(&all), 27);
        assert_eq!(manifold(&all.iter().copied().filter(|&hex| hex != 13).collect::<Vec<_>>()), 26);
    }
}
