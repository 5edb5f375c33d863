//! Applies templates to hexes and welds what they share.
//!
//! A new node is known by the edge, face or hex that it divides, and by its rank there (`template::hex`). Each
//! edge and face belongs to the first hex of the list that divides it; nodes are numbered in the order of
//! their owners. So the numbers follow from the list alone, and all loops run over blocks of hexes at once.
//!
//! 1. Number the edges and faces of the hexes (`skeleton`).
//! 2. Find the owner of each edge and face that is divided.
//! 3. Number the nodes by owner, and place them.
//! 4. Write the cells.

use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

use super::blocks::{BLOCK, cut, offsets};
use super::skeleton::Skeleton;
use crate::geometry::Point;
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::{EDGES, FACES};
use crate::parallel;
use crate::template::hex::{INSIDE, SIDES, Template, in_frame};
use crate::{Cancelled, Monitor, Stage};

/// The stage that this file reports.
const TEMPLATES: Stage = Stage("templates");

/// A hex that a template divides.
#[derive(Clone, Copy)]
pub(super) struct Divided {
    /// Its nodes, in VTK order.
    pub(super) hex: [NodeId; 8],
    /// What it becomes.
    pub(super) template: &'static Template,
    /// The symmetry that places the template: template corner `k` stands at corner `SYMMETRIES[symmetry][k]`.
    pub(super) symmetry: u8,
}

impl Divided {
    fn frame(&self) -> [NodeId; 8] {
        in_frame(&self.hex, self.symmetry)
    }
}

/// No hex divides the edge or face.
const NONE: u32 = u32::MAX;

/// Applies their templates to `hexes`. Appends the new nodes to `positions`, and the new cells to `cells`, hex after hex,
/// each hex's in the order of its template: hex `k` becomes the new cells from `offsets[k]` to `offsets[k + 1]`, which is
/// returned. Hexes that share an edge or a face must divide it alike.
///
/// # Errors
/// If the monitor stops it.
pub(super) fn divide(
    positions: &mut Vec<Point>,
    cells: &mut Vec<[NodeId; 8]>,
    hexes: &[Divided],
    monitor: &dyn Monitor,
) -> Result<Vec<u32>, Cancelled> {
    monitor.checkpoint(TEMPLATES, 0.0)?;
    let sides = Sides::of(positions.len(), hexes, monitor)?;
    monitor.checkpoint(TEMPLATES, 0.5)?;
    let counts = parallel::collect(hexes.len(), |h| sides.owned_nodes(h, &hexes[h]));
    let mut nodes_of = offsets(counts.into_iter());
    let first_node = NodeId::new(positions.len()).0;
    NodeId::new(positions.len() + *nodes_of.last().expect("never empty") as usize);
    nodes_of.iter_mut().for_each(|offset| *offset += first_node);
    sides.number(hexes, &nodes_of);
    place(positions, hexes, &sides, &nodes_of, monitor)?;
    monitor.checkpoint(TEMPLATES, 0.75)?;
    let cells_of = offsets(hexes.iter().map(|hex| hex.template.cell_count() as u32));
    write(cells, hexes, &sides, &nodes_of, &cells_of, monitor)?;
    monitor.checkpoint(TEMPLATES, 1.0)?;
    Ok(cells_of)
}

/// The edges and faces of the hexes, as far as they are divided.
struct Sides {
    /// For each hex and side of its template the number of the edge, or of the face after all edges; sides
    /// that the template does not divide have none.
    of_hex: Vec<[u32; SIDES]>,
    /// The hex that owns each.
    owner: Vec<AtomicU32>,
    /// The first of each one's nodes.
    first: Vec<AtomicU32>,
}

impl Sides {
    fn of(node_count: usize, hexes: &[Divided], monitor: &dyn Monitor) -> Result<Self, Cancelled> {
        let skeleton = Skeleton::new(node_count, hexes, |hex| &hex.hex, monitor)?;
        let edge_count = skeleton.edge_count();
        let count = edge_count + skeleton.face_count();
        let none = || parallel::collect(count, |_| AtomicU32::new(NONE));
        let (owner, first) = (none(), none());
        let of_hex = parallel::try_collect(hexes.len(), monitor, |h| {
            let hex = &hexes[h];
            let (frame, mut sides) = (hex.frame(), [NONE; SIDES]);
            for part in hex.template.parts().iter().filter(|part| part.side < INSIDE) {
                let side = usize::from(part.side);
                let number = if side < 12 {
                    skeleton.edge(EDGES[side].map(|k| frame[usize::from(k)]))
                } else {
                    edge_count + skeleton.face(FACES[side - 12].map(|k| frame[usize::from(k)]))
                };
                owner[number].fetch_min(h as u32, Relaxed);
                sides[side] = number as u32;
            }
            sides
        })?;
        Ok(Self { of_hex, owner, first })
    }

    /// Does hex `h` own its side?
    fn owns(&self, h: usize, side: u8) -> bool {
        side == INSIDE || self.owner[self.of_hex[h][usize::from(side)] as usize].load(Relaxed) == h as u32
    }

    /// How many nodes hex `h` owns.
    fn owned_nodes(&self, h: usize, hex: &Divided) -> u32 {
        let owned = hex.template.parts().iter().filter(|part| self.owns(h, part.side));
        owned.map(|part| u32::from(part.count)).sum()
    }

    /// Gives the divided edges and faces their first nodes.
    fn number(&self, hexes: &[Divided], nodes_of: &[u32]) {
        parallel::for_each(hexes.len(), |h| {
            let hex = &hexes[h];
            let mut next = nodes_of[h];
            for part in hex.template.parts().iter().filter(|part| self.owns(h, part.side)) {
                if part.side < INSIDE {
                    self.first[self.of_hex[h][usize::from(part.side)] as usize].store(next, Relaxed);
                }
                next += u32::from(part.count);
            }
        });
    }

    /// The first node of part `k` of hex `h`. The nodes inside the hex come last.
    fn first(&self, h: usize, hex: &Divided, k: usize, nodes_of: &[u32]) -> NodeId {
        let part = &hex.template.parts()[k];
        if part.side == INSIDE {
            return NodeId(nodes_of[h + 1] - u32::from(part.count));
        }
        NodeId(self.first[self.of_hex[h][usize::from(part.side)] as usize].load(Relaxed))
    }
}

/// The ends of the blocks of hexes, in what `offsets` counts from `first`.
fn block_ends(offsets: &[u32], first: u32) -> impl Iterator<Item = usize> + '_ {
    let hexes = offsets.len() - 1;
    (0..hexes.div_ceil(BLOCK)).map(move |k| (offsets[((k + 1) * BLOCK).min(hexes)] - first) as usize)
}

/// Appends the points of the new nodes.
fn place(
    positions: &mut Vec<Point>,
    hexes: &[Divided],
    sides: &Sides,
    nodes_of: &[u32],
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    let first_node = nodes_of[0];
    let count = nodes_of[hexes.len()] as usize;
    positions.reserve_exact(count - positions.len());
    positions.resize(count, Point::ZERO);
    let (old, new) = positions.split_at_mut(first_node as usize);
    let mut blocks = cut(new, block_ends(nodes_of, first_node));
    parallel::try_for_each_mut(&mut blocks, monitor, |k, points| {
        let mut next = 0;
        for (h, hex) in hexes.iter().enumerate().skip(k * BLOCK).take(BLOCK) {
            let frame = hex.frame();
            let corners = frame.map(|n| old[n.index()]);
            for part in hex.template.parts().iter().filter(|part| sides.owns(h, part.side)) {
                for (local, rank) in part.ranked(&frame) {
                    points[next + rank as usize] = hex.template.point(local, &corners);
                }
                next += usize::from(part.count);
            }
        }
    })
}

/// Appends the cells.
fn write(
    cells: &mut Vec<[NodeId; 8]>,
    hexes: &[Divided],
    sides: &Sides,
    nodes_of: &[u32],
    cells_of: &[u32],
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    let first = cells.len();
    cells.resize(first + cells_of[hexes.len()] as usize, [NodeId(0); 8]);
    let mut blocks = cut(&mut cells[first..], block_ends(cells_of, 0));
    parallel::try_for_each_mut(&mut blocks, monitor, |k, cells| {
        let mut cells = cells.iter_mut();
        for (h, hex) in hexes.iter().enumerate().skip(k * BLOCK).take(BLOCK) {
            let numbers = hex.template.number(&hex.frame(), |k| sides.first(h, hex, k, nodes_of));
            for (nodes, cell) in hex.template.place(&numbers, hex.symmetry).zip(cells.by_ref()) {
                *cell = nodes;
            }
        }
    })
}
