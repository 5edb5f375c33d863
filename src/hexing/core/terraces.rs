//! Levels steps: the core's boundary gets few creases.
//!
//! ```text
//!           +---+---+           Where the solid is a little askew to the cells, the core has steps. At a crease, an edge
//!           |   |   |           of its boundary, one cell of the core is there, or three, and not two. Once a sheet lies
//!   +---+---o---+---+---+       around the core three or five cells meet there, not four, and no smoothing gives these good
//!   |   |   |   |   |   |       angles. Flat layers are bent by the fit as well.
//!   +---+---+---+---+---+
//! ```
//!
//! A **terrace** is all quads of the boundary that are joined through flat edges, where two cells are. To move it is to
//! take the cells below it out, or those above it in. What moves need not be all of it: cells near curves of the solid
//! stay, for the boundary is to have creases there; so do those far from the solid, single layers, and those where the
//! solid is turned away from the terrace, as at the tips of horns.
//!
//! A move saves creases, and costs how far its cells then are on the wrong side: the sum over cells of squares, in edge
//! lengths. The moves that save most are made until none saves anything. A boundary that was a manifold stays one, with
//! its Euler number.

use super::cells::{Cells, NONE, distinct};
use super::link::Link;
use crate::geometry::Point;
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::{
    EDGE_BETWEEN, EDGES, EDGES_OF_FACE, FACES, FACES_AT, FACES_AT_EDGE, NONE as NO_EDGE, OPPOSITE_FACE,
};
use crate::{Cancelled, Monitor, parallel};

/// In edge lengths: cells whose centres lie deeper stay on their side.
const DEEPEST: f64 = 1.0;

/// The cosine between the outward normals of a terrace and of the solid, at least: 50 degrees.
const TURNED: f64 = 0.64;

/// How many creases a move saves, at least, less what it costs.
const LEAST: f64 = 1.0;

/// Moves terraces in or out, as long as that saves something. `outward` tells the solid's unit normal near a cell; none
/// where the cell is to stay. Returns the number of moves.
pub(super) fn level(
    cells: &Cells<'_>,
    depth: &[f64],
    outward: impl Fn(usize) -> Option<Point> + Sync,
    inside: &mut [bool],
    monitor: &dyn Monitor,
) -> Result<usize, Cancelled> {
    let shallow = parallel::filter(cells.len(), |cell| depth[cell].abs() <= DEEPEST);
    let normals = parallel::try_collect(shallow.len(), monitor, |k| outward(shallow[k] as usize))?;
    let site = Leveller { cells, depth, shallow, normals };
    let mut awake = vec![true; cells.len()];
    let mut count = 0;
    loop {
        let set = Set { cells, inside };
        let terraces = set.terraces(&awake);
        let look = |k: usize, found: &mut Vec<Move>| site.moves(&set, &terraces[k], found);
        let mut moves = parallel::try_gather(terraces.len(), monitor, look)?;
        if moves.is_empty() {
            return Ok(count);
        }
        moves.sort_unstable_by(|a, b| b.gain.total_cmp(&a.gain).then_with(|| a.cells.cmp(&b.cells)));
        awake.fill(false);
        let mut changed = vec![false; cells.len()];
        for Move { cells: moved, .. } in moves {
            // What a move saves depends on the cells at its nodes.
            if moved.iter().any(|&cell| changed[cell as usize]) {
                continue;
            }
            count += 1;
            for &cell in &moved {
                inside[cell as usize] = !inside[cell as usize];
                let nodes = cells.mesh.hexes[cell as usize].iter();
                nodes.flat_map(|&n| cells.around(n)).for_each(|(cell, _)| changed[cell] = true);
            }
        }
        // Whether a quad may move depends on the cells two below and two above it, too.
        for cell in (0..cells.len()).filter(|&cell| changed[cell]) {
            awake[cell] = true;
            cells.beside(cell).for_each(|cell| awake[cell] = true);
        }
    }
}

/// A quad of the boundary: the cell that is in, and its face.
type Quad = (u32, u8);

/// Cells that change sides, ascending, and what that saves.
struct Move {
    cells: Vec<u32>,
    gain: f64,
}

/// Which cells are in.
struct Set<'a> {
    cells: &'a Cells<'a>,
    inside: &'a [bool],
}

impl Set<'_> {
    fn is_in(&self, cell: u32) -> bool {
        cell != NONE && self.inside[cell as usize]
    }

    fn is_on_boundary(&self, (cell, face): Quad) -> bool {
        self.is_in(cell) && !self.is_in(self.cells.neighbours[cell as usize][usize::from(face)])
    }

    /// The terraces that have quads at cells that are awake.
    fn terraces(&self, awake: &[bool]) -> Vec<Vec<Quad>> {
        let mut seen = vec![0u8; self.cells.len()];
        let mut see = |(cell, face): Quad| {
            let is_new = seen[cell as usize] >> face & 1 == 0;
            seen[cell as usize] |= 1 << face;
            is_new
        };
        let mut terraces = Vec::new();
        for cell in (0..self.cells.len() as u32).filter(|&cell| awake[cell as usize]) {
            for quad in (0..6).map(|face| (cell, face)).filter(|&quad| self.is_on_boundary(quad)) {
                if see(quad) {
                    terraces.push(self.joined(quad, &mut see));
                }
            }
        }
        terraces
    }

    /// The quad and those that are joined to it through flat edges, of those that `take` takes.
    fn joined(&self, quad: Quad, take: &mut impl FnMut(Quad) -> bool) -> Vec<Quad> {
        let mut quads = vec![quad];
        let mut next = 0;
        while let Some(&quad) = quads.get(next) {
            next += 1;
            quads.extend((0..4).filter_map(|edge| self.over(quad, edge)).filter(|&other| take(other)));
        }
        quads
    }

    /// The quad over the `k`-th edge of another, if this is flat.
    fn over(&self, (cell, face): Quad, k: usize) -> Option<Quad> {
        let edge = EDGES_OF_FACE[usize::from(face)][k];
        let other = self.cells.neighbours[cell as usize][usize::from(beyond_edge(edge, face))];
        if !self.is_in(other) {
            return None;
        }
        let ends =
            EDGES[usize::from(edge)].map(|corner| self.cells.mesh.hexes[cell as usize][usize::from(corner)]);
        let there = edge_of(&self.cells.mesh.hexes[other as usize], ends)?;
        let quad = (other, beyond_edge(there, self.face_to(other, cell)));
        self.is_on_boundary(quad).then_some(quad)
    }

    /// The face of a cell that is another's too.
    fn face_to(&self, cell: u32, other: u32) -> u8 {
        let faces = &self.cells.neighbours[cell as usize];
        faces.iter().position(|&beside| beside == other).expect("cells with a common face") as u8
    }
}

/// The other face at an edge.
fn beyond_edge(edge: u8, face: u8) -> u8 {
    let [a, b] = FACES_AT_EDGE[usize::from(edge)];
    if a == face { b } else { a }
}

/// The edge of a hex between two nodes, if there is one.
fn edge_of(hex: &[NodeId; 8], ends: [NodeId; 2]) -> Option<u8> {
    let [a, b] = ends.map(|end| hex.iter().position(|&n| n == end));
    Some(EDGE_BETWEEN[a?][b?]).filter(|&edge| edge != NO_EDGE)
}

/// What moves depend on.
struct Leveller<'a> {
    cells: &'a Cells<'a>,
    depth: &'a [f64],
    /// The cells that are not deep, ascending, and for each the normal of the solid there, unless it is to stay.
    shallow: Vec<u32>,
    normals: Vec<Option<Point>>,
}

impl Leveller<'_> {
    /// Finds the moves of a terrace that save something.
    fn moves(&self, set: &Set<'_>, terrace: &[Quad], found: &mut Vec<Move>) {
        for out in [true, false] {
            let mut left: Vec<Quad> =
                terrace.iter().copied().filter(|&quad| self.moved(set, quad, out).is_some()).collect();
            left.sort_unstable();
            let mut is_left = vec![true; left.len()];
            let mut take =
                |quad: Quad| left.binary_search(&quad).is_ok_and(|k| std::mem::take(&mut is_left[k]));
            for &quad in &left {
                if take(quad) {
                    let part = set.joined(quad, &mut take);
                    let mut cells: Vec<u32> =
                        part.into_iter().filter_map(|quad| self.moved(set, quad, out)).collect();
                    cells.sort_unstable();
                    cells.dedup();
                    found.extend(self.gain(set, &cells).map(|gain| Move { cells, gain }));
                }
            }
        }
    }

    /// The cell that goes out, or in, where a quad moves; none where it is to stay.
    fn moved(&self, set: &Set<'_>, (cell, face): Quad, out: bool) -> Option<u32> {
        let neighbours = &self.cells.neighbours;
        let (moved, stays) = if out {
            let below = neighbours[cell as usize][usize::from(OPPOSITE_FACE[usize::from(face)])];
            (cell, set.is_in(below))
        } else {
            let above = neighbours[cell as usize][usize::from(face)];
            if above == NONE {
                return None;
            }
            let beyond = OPPOSITE_FACE[usize::from(set.face_to(above, cell))];
            (above, !set.is_in(neighbours[above as usize][usize::from(beyond)]))
        };
        let normal = self.shallow.binary_search(&moved).ok().and_then(|k| self.normals[k])?;
        (stays && normal.dot(self.normal_of((cell, face))) >= TURNED).then_some(moved)
    }

    /// The unit normal of a quad.
    fn normal_of(&self, (cell, face): Quad) -> Point {
        let at = FACES[usize::from(face)]
            .map(|k| self.cells.mesh.positions[self.cells.mesh.hexes[cell as usize][usize::from(k)].index()]);
        (at[2] - at[0]).cross(at[3] - at[1]).normalize_or_zero()
    }

    /// What is saved where cells change sides; none if that is too little, or the boundary would be another.
    fn gain(&self, set: &Set<'_>, moved: &[u32]) -> Option<f64> {
        let before = |cell: usize| set.inside[cell];
        let after = |cell: usize| set.inside[cell] != moved.binary_search(&(cell as u32)).is_ok();
        let hexes = || moved.iter().map(|&cell| &self.cells.mesh.hexes[cell as usize]);
        let edges = distinct(hexes().flat_map(ends_of_edges).collect());
        let creases = |edge: [NodeId; 2]| self.creases(edge, before) - self.creases(edge, after);
        let saved: i64 = edges.into_iter().map(creases).sum();
        let wrong = |cell: u32| {
            let depth = self.depth[cell as usize];
            if (depth < 0.0) == before(cell as usize) { -depth * depth } else { depth * depth }
        };
        let gain = saved as f64 + moved.iter().map(|&cell| wrong(cell)).sum::<f64>();
        if gain < LEAST {
            return None;
        }
        let nodes = distinct(hexes().flatten().copied().collect());
        let mut link = Link::default();
        let is_manifold = nodes.iter().all(|&node| !link.is_pinched(self.cells, node, after));
        (is_manifold && self.euler(&nodes, moved, before) == self.euler(&nodes, moved, after)).then_some(gain)
    }

    /// How many cells more or less than two are in at an edge of the boundary; 0 at other edges.
    fn creases(&self, ends: [NodeId; 2], is_in: impl Fn(usize) -> bool) -> i64 {
        let mut count = 0i64;
        let mut is_on_boundary = false;
        for (cell, _) in self.cells.around(ends[0]).filter(|&(cell, _)| is_in(cell)) {
            let Some(edge) = edge_of(&self.cells.mesh.hexes[cell], ends) else { continue };
            count += 1;
            is_on_boundary |= FACES_AT_EDGE[usize::from(edge)].iter().any(|&face| {
                let other = self.cells.neighbours[cell][usize::from(face)];
                other == NONE || !is_in(other as usize)
            });
        }
        if is_on_boundary { (count - 2).abs() } else { 0 }
    }

    /// What some cells have of the boundary's Euler number: that of a manifold of quads is its nodes less its quads.
    fn euler(&self, nodes: &[NodeId], cells: &[u32], is_in: impl Fn(usize) -> bool) -> i64 {
        let is_in_there = |other: u32| other != NONE && is_in(other as usize);
        let has_out = |(cell, corner): (usize, usize)| {
            let faces = FACES_AT[corner].map(|(face, _)| self.cells.neighbours[cell][usize::from(face)]);
            !is_in(cell) || faces.contains(&NONE)
        };
        let is_on_boundary = |&&node: &&NodeId| {
            self.cells.around(node).any(|(cell, _)| is_in(cell)) && self.cells.around(node).any(has_out)
        };
        let quads = |&cell: &u32| {
            let here = is_in(cell as usize);
            self.cells.neighbours[cell as usize].iter().filter(|&&other| is_in_there(other) != here).count()
        };
        nodes.iter().filter(is_on_boundary).count() as i64 - cells.iter().map(quads).sum::<usize>() as i64
    }
}

/// The ends of a hex's edges, the lesser node first.
fn ends_of_edges(hex: &[NodeId; 8]) -> [[NodeId; 2]; 12] {
    EDGES.map(|edge| {
        let [a, b] = edge.map(|corner| hex[usize::from(corner)]);
        [a.min(b), a.max(b)]
    })
}

#[cfg(test)]
mod tests;
