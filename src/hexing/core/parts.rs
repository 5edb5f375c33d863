//! What hangs together: crumbs beside a body and bubbles within it are removed.

use super::cells::{Cells, NONE};
use crate::mesh::topology::Sets;

/// Share of an edge: a cavity with a cell whose centre is further from the solid stays.
const BUBBLE: f64 = 0.5;

/// Parts that were removed, as cells.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Removed {
    /// The cells of each part that was inside beside the largest of its body.
    pub crumbs: Vec<Vec<u32>>,
    /// The cells of each part that was outside, closed in.
    pub bubbles: Vec<Vec<u32>>,
}

/// Keeps the largest part of each body, and fills what is closed in but is no cavity of the solid. `body` tells the body
/// of a cell. Parts are joined through faces; where the boundary is a manifold it stays one.
pub(super) fn keep_bodies(
    cells: &Cells<'_>,
    depth: &[f64],
    body: impl Fn(usize) -> u32,
    inside: &mut [bool],
) -> Removed {
    let (crumbs, bubbles): (Vec<Part>, Vec<Part>) =
        parts(cells, depth, inside).into_iter().partition(|part| part.is_inside);
    // The largest first, of equal ones the one with the first cell.
    let mut crumbs: Vec<(u32, Part)> =
        crumbs.into_iter().map(|part| (body(part.deepest as usize), part)).collect();
    crumbs.sort_unstable_by_key(|(body, part)| (*body, std::cmp::Reverse(part.cells.len()), part.cells[0]));
    let crumbs = crumbs.chunk_by_mut(|a, b| a.0 == b.0);
    let crumbs =
        crumbs.flat_map(|of_body| of_body[1..].iter_mut().map(|(_, part)| std::mem::take(&mut part.cells)));
    let is_bubble = |part: &Part| !part.is_open && depth[part.deepest as usize].abs() < BUBBLE;
    let removed = Removed {
        crumbs: crumbs.collect(),
        bubbles: bubbles.into_iter().filter(is_bubble).map(|part| part.cells).collect(),
    };
    removed.crumbs.iter().flatten().for_each(|&cell| inside[cell as usize] = false);
    removed.bubbles.iter().flatten().for_each(|&cell| inside[cell as usize] = true);
    removed
}

struct Part {
    /// Ascending.
    cells: Vec<u32>,
    is_inside: bool,
    /// Does it reach the boundary of the background?
    is_open: bool,
    deepest: u32,
}

/// The parts that are joined through faces, in order of their first cells.
fn parts(cells: &Cells<'_>, depth: &[f64], inside: &[bool]) -> Vec<Part> {
    let mut sets = Sets::new(cells.len());
    for cell in 0..cells.len() {
        for other in cells.beside(cell).filter(|&other| cell < other && inside[cell] == inside[other]) {
            sets.join(cell as u32, other as u32, false);
        }
    }
    let mut part_of_root = vec![NONE; cells.len()];
    let mut parts: Vec<Part> = Vec::new();
    for cell in 0..cells.len() as u32 {
        let root = sets.root(cell).0 as usize;
        if part_of_root[root] == NONE {
            part_of_root[root] = parts.len() as u32;
            parts.push(Part { cells: Vec::new(), is_inside: inside[root], is_open: false, deepest: cell });
        }
        let part = &mut parts[part_of_root[root] as usize];
        part.cells.push(cell);
        part.is_open |= cells.neighbours[cell as usize].contains(&NONE);
        if depth[cell as usize].abs() > depth[part.deepest as usize].abs() {
            part.deepest = cell;
        }
    }
    parts
}
