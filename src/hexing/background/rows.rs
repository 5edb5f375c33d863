//! Cells of a grid of which few are there, as runs along x.
//!
//! A **row** holds the cells of one y and z, as runs that neither overlap nor touch. Only rows with cells take memory,
//! so that work and memory grow with the cells that are there and not with the box around them.

use std::ops::Range;

use crate::mesh::NodeId;
use crate::mesh::numbering::hex::CORNERS;
use crate::parallel;

/// Cells of a grid.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Rows {
    /// Cells along x, y and z of the whole grid.
    counts: [u32; 3],
    /// The rows with cells, as `y + counts[1] * z`, ascending.
    rows: Vec<u64>,
    /// The runs of row `r` of the list are `runs[starts[r]..starts[r + 1]]`.
    starts: Vec<u32>,
    /// Cells from and up to, exclusive; ascending.
    runs: Vec<Range<u32>>,
    /// How many cells stand before each run.
    before: Vec<u64>,
}

/// A run by its row: row, start, end.
pub(super) type Run = (u64, u32, u32);

impl Rows {
    /// The cells of `runs`, which may overlap and come in any order.
    pub fn merged(counts: [u32; 3], mut runs: Vec<Run>) -> Self {
        parallel::sort(&mut runs);
        let mut cells = Self { counts, rows: Vec::new(), starts: vec![0], runs: Vec::new(), before: vec![0] };
        for (row, start, end) in runs {
            if cells.rows.last() != Some(&row) {
                cells.rows.push(row);
                cells.starts.push(cells.runs.len() as u32);
            }
            let first = cells.starts[cells.rows.len() - 1] as usize;
            match cells.runs[first..].last_mut() {
                Some(last) if start <= last.end => last.end = last.end.max(end),
                _ => cells.runs.push(start..end),
            }
            cells.starts[cells.rows.len()] = cells.runs.len() as u32;
        }
        for run in &cells.runs {
            let end = cells.before[cells.before.len() - 1] + u64::from(run.end - run.start);
            cells.before.push(end);
        }
        cells
    }

    /// How many cells there are.
    pub fn len(&self) -> u64 {
        self.before[self.runs.len()]
    }

    /// The number of the row at y and z.
    pub fn row(counts: [u32; 3], y: u32, z: u32) -> u64 {
        u64::from(y) + u64::from(counts[1]) * u64::from(z)
    }

    fn place(&self, r: usize) -> [u32; 2] {
        let across = u64::from(self.counts[1]);
        [self.rows[r] % across, self.rows[r] / across].map(|c| c as u32)
    }

    fn of_row(&self, r: usize) -> Range<usize> {
        self.starts[r] as usize..self.starts[r + 1] as usize
    }

    /// All runs, with y and z.
    fn all(&self) -> impl Iterator<Item = ([u32; 2], &Range<u32>)> {
        (0..self.rows.len())
            .flat_map(move |r| self.runs[self.of_row(r)].iter().map(move |run| (self.place(r), run)))
    }

    /// The run that holds a cell.
    fn run_at(&self, x: u32, y: u32, z: u32) -> Option<usize> {
        let r = self.rows.binary_search(&Self::row(self.counts, y, z)).ok()?;
        let of_row = self.of_row(r);
        let after = of_row.start + self.runs[of_row].partition_point(|run| run.start <= x);
        let run = after.checked_sub(1).filter(|&run| run >= self.starts[r] as usize)?;
        (x < self.runs[run].end).then_some(run)
    }

    /// The number of a cell, in order of x, then y, then z.
    fn number(&self, x: u32, y: u32, z: u32) -> Option<u64> {
        self.run_at(x, y, z).map(|run| self.before[run] + u64::from(x - self.runs[run].start))
    }

    /// Is the cell there?
    pub fn holds(&self, x: u32, y: u32, z: u32) -> bool {
        self.run_at(x, y, z).is_some()
    }

    /// These cells and the gaps between runs of a row whose first cell `is_inside`.
    pub fn filled(&self, is_inside: impl Fn([u32; 3]) -> bool + Sync) -> Self {
        let gaps = parallel::gather(self.rows.len(), |r, found: &mut Vec<Run>| {
            let [y, z] = self.place(r);
            for pair in self.runs[self.of_row(r)].windows(2) {
                if is_inside([pair[0].end, y, z]) {
                    found.push((self.rows[r], pair[0].end, pair[1].start));
                }
            }
        });
        self.with(gaps)
    }

    fn with(&self, mut more: Vec<Run>) -> Self {
        more.extend(self.all().map(|([y, z], run)| (Self::row(self.counts, y, z), run.start, run.end)));
        Self::merged(self.counts, more)
    }

    /// These cells and the others of their blocks, of two by two by two cells each, within the grid.
    pub fn in_blocks(&self) -> Self {
        let [nx, ny, nz] = self.counts;
        let of_block = |c: u32, count: u32| c & !1..((c | 1) + 1).min(count);
        let whole = self.all().flat_map(|([y, z], run)| {
            let (start, end) = (run.start & !1, (((run.end - 1) | 1) + 1).min(nx));
            let rows = of_block(z, nz).flat_map(move |z| of_block(y, ny).map(move |y| [y, z]));
            rows.map(move |[y, z]| (Self::row(self.counts, y, z), start, end))
        });
        Self::merged(self.counts, whole.collect())
    }

    /// These cells and as few others that around each node the cells that are there share faces, and the others too:
    /// then they fill a manifold with boundary.
    pub fn made_manifold(mut self) -> Self {
        loop {
            let nodes = self.nodes();
            let pinched = parallel::gather(nodes.rows.len(), |r, found: &mut Vec<Run>| {
                let [y, z] = nodes.place(r);
                for run in &nodes.runs[nodes.of_row(r)] {
                    for x in run.clone() {
                        if !is_manifold(self.around([x, y, z])) {
                            found.extend(self.block_at([x, y, z]));
                        }
                    }
                }
            });
            if pinched.is_empty() {
                return self;
            }
            self = self.with(pinched);
        }
    }

    /// Which of the eight cells around a node are there: bit `x + 2 y + 4 z`.
    fn around(&self, [x, y, z]: [u32; 3]) -> u8 {
        (0..8).fold(0, |mask, k| {
            let cell = [(x, k & 1), (y, k >> 1 & 1), (z, k >> 2)].map(|(c, up)| (c + up).checked_sub(1));
            let is_there =
                matches!(cell, [Some(x), Some(y), Some(z)] if y < self.counts[1] && self.holds(x, y, z));
            mask | u8::from(is_there) << k
        })
    }

    /// The cells around a node, within the grid.
    fn block_at(&self, [x, y, z]: [u32; 3]) -> impl Iterator<Item = Run> {
        let [nx, ny, nz] = self.counts;
        let around = |c: u32, count: u32| c.saturating_sub(1)..(c + 1).min(count);
        let rows = around(z, nz).flat_map(move |z| around(y, ny).map(move |y| [y, z]));
        let (start, end) = (x.saturating_sub(1), (x + 1).min(nx));
        rows.map(move |[y, z]| (Self::row(self.counts, y, z), start, end))
    }

    /// The corners of the cells, as cells of a grid with one more along each axis.
    pub fn nodes(&self) -> Self {
        let counts = self.counts.map(|count| count + 1);
        let corners = self.all().flat_map(|([y, z], run)| {
            [[y, z], [y + 1, z], [y, z + 1], [y + 1, z + 1]]
                .map(|[y, z]| (Self::row(counts, y, z), run.start, run.end + 1))
        });
        Self::merged(counts, corners.collect())
    }

    /// What `make` gives for each cell, in their order.
    pub fn map<T: Send>(&self, make: impl Fn([u32; 3]) -> T + Sync) -> Vec<T> {
        parallel::gather(self.rows.len(), |r, made| {
            let [y, z] = self.place(r);
            let cells = self.runs[self.of_row(r)].iter().cloned().flatten();
            made.extend(cells.map(|x| make([x, y, z])));
        })
    }

    /// The nodes of each cell, numbered as `nodes` are, which are those of [`Rows::nodes`].
    pub fn hexes(&self, nodes: &Self) -> Vec<[NodeId; 8]> {
        parallel::gather(self.rows.len(), |r, made| {
            let [y, z] = self.place(r);
            for run in &self.runs[self.of_row(r)] {
                // The nodes along a run stand in one run.
                let first = CORNERS.map(|[cx, cy, cz]| {
                    let node = nodes.number(run.start, y + u32::from(cy), z + u32::from(cz));
                    node.expect("the corner of a cell") as usize + usize::from(cx)
                });
                made.extend((0..run.len()).map(|x| first.map(|n| NodeId::new(n + x))));
            }
        })
    }
}

/// Do the cells around a node that are in `mask` share faces, and the others too?
fn is_manifold(mask: u8) -> bool {
    is_joined(mask) && is_joined(!mask)
}

/// Can one go from each of these cells around a node to each other through faces?
fn is_joined(mask: u8) -> bool {
    let mut reached = mask & mask.wrapping_neg();
    loop {
        let [x, y, z] = [(1, 0x55), (2, 0x33), (4, 0x0f)]
            .map(|(step, low): (u32, u8)| (reached & low) << step | reached >> step & low);
        let more = (reached | x | y | z) & mask;
        if more == reached {
            return reached == mask;
        }
        reached = more;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const COUNTS: [u32; 3] = [6, 5, 4];

    /// The cells of a grid that a test holds for, one by one.
    fn cells(is: impl Fn([u32; 3]) -> bool) -> Vec<[u32; 3]> {
        let [nx, ny, nz] = COUNTS;
        let all = (0..nz).flat_map(|z| (0..ny).flat_map(move |y| (0..nx).map(move |x| [x, y, z])));
        all.filter(|&cell| is(cell)).collect()
    }

    fn rows(cells: &[[u32; 3]]) -> Rows {
        Rows::merged(COUNTS, cells.iter().map(|&[x, y, z]| (Rows::row(COUNTS, y, z), x, x + 1)).collect())
    }

    #[test]
    fn rows_hold_what_they_were_made_of_in_order() {
        let some = cells(|[x, y, z]| (x * 7 + y * 5 + z * 3) % 4 < 2);
        let rows = rows(&some.iter().rev().copied().chain(some.iter().copied()).collect::<Vec<_>>());
        assert_eq!(rows.len(), some.len() as u64);
        assert_eq!(rows.map(|cell| cell), some);
        for (number, &[x, y, z]) in some.iter().enumerate() {
            assert_eq!(rows.number(x, y, z), Some(number as u64));
        }
        assert_eq!(cells(|[x, y, z]| rows.holds(x, y, z)), some);
    }

    #[test]
    fn blocks_are_completed_within_the_grid() {
        let some = [[0, 0, 0], [3, 2, 1], [4, 4, 3]];
        let together = |a: [u32; 3], b: [u32; 3]| (0..3).all(|i| a[i] / 2 == b[i] / 2);
        let whole = rows(&cells(|cell| some.iter().any(|&s| together(s, cell))));
        assert_eq!(rows(&some).in_blocks(), whole);
        assert_eq!(whole.in_blocks(), whole);
    }

    #[test]
    fn gaps_are_filled_where_their_first_cell_says_so() {
        let shell = cells(|[x, y, _]| x == 1 || x == 4 || y == 0);
        let filled = rows(&shell).filled(|[x, y, z]| x == 2 && y > 1 && z > 0);
        assert_eq!(
            filled,
            rows(&cells(|[x, y, z]| {
                x == 1 || x == 4 || y == 0 || (y > 1 && z > 0 && (2..4).contains(&x))
            }))
        );
    }

    #[test]
    fn a_node_is_pinched_where_cells_or_what_is_between_them_touch_only() {
        // One cell, two that share a face, two across an edge, two across the node.
        assert_eq!([0b1, 0b11, 0b1001, 0b1000_0001].map(is_manifold), [true, true, false, false]);
        assert!(is_manifold(0) && is_manifold(0xff));
        for mask in 0..=u8::MAX {
            assert_eq!(is_manifold(mask), is_manifold(!mask));
        }
    }

    #[test]
    fn hexes_of_pinched_cells_become_a_manifold() {
        use crate::geometry::Point;
        use crate::mesh::{HexMesh, check_hexes};
        for some in
            [vec![[1, 1, 1], [2, 2, 2]], vec![[1, 1, 1], [2, 2, 1], [4, 3, 1]], vec![[0, 0, 0], [1, 1, 0]]]
        {
            let cells = rows(&some).made_manifold();
            let nodes = cells.nodes();
            let positions = nodes.map(|at| Point::from(at.map(f64::from)));
            let mesh = HexMesh { positions, hexes: cells.hexes(&nodes), ..Default::default() };
            assert_eq!(check_hexes(&mesh), []);
            assert!(some.iter().all(|&[x, y, z]| cells.holds(x, y, z)));
        }
    }
}
