//! The cells of a grid that a surface touches.

use super::pieces::pieces;
use super::rows::{Rows, Run};
use crate::geometry::Point;
use crate::parallel;
use crate::{Cancelled, Monitor};

/// The cells between `lines`, which ascend along each axis, that the triangles touch, and some of their neighbours: what is no
/// farther from a line than the share `reach` of its cell touches both sides. All triangles lie within the lines.
///
/// A triangle is halved across its longest edge until its box lies in no more than two cells along each axis; then all that
/// the box touches count as touched. So the work grows with the area and with the number of triangles.
pub(super) fn touched(
    lines: &[Vec<f64>; 3],
    reach: f64,
    triangle_count: usize,
    triangle: impl Fn(usize) -> [Point; 3] + Sync,
    monitor: &dyn Monitor,
) -> Result<Rows, Cancelled> {
    let counts = lines.each_ref().map(|lines| lines.len() as u32 - 1);
    let runs = parallel::try_blocks(triangle_count, BLOCK, monitor, |block| {
        let mut runs = Vec::new();
        let is_small =
            |piece: &[Point; 3]| cells_around(lines, 0.0, piece).iter().all(|[from, to]| to - from <= 1);
        block.for_each(|t| {
            pieces(triangle(t), is_small, &mut |piece| {
                runs_of(counts, cells_around(lines, reach, &piece), &mut runs);
            });
        });
        // Small triangles touch the same cells again and again.
        runs.sort_unstable();
        runs.dedup();
        runs
    })?;
    Ok(Rows::merged(counts, parallel::concat(runs)))
}

/// Triangles that one task looks at.
const BLOCK: usize = 256;

/// The least and the greatest cell along each axis.
type Cells = [[u32; 2]; 3];

/// The cells that the box around a triangle touches.
fn cells_around(lines: &[Vec<f64>; 3], reach: f64, [a, b, c]: &[Point; 3]) -> Cells {
    let (min, max) = (a.min(*b).min(*c), a.max(*b).max(*c));
    std::array::from_fn(|i| cells_between(&lines[i], reach, [min[i], max[i]]))
}

/// The least and the greatest cell that an interval touches.
fn cells_between(lines: &[f64], reach: f64, [from, to]: [f64; 2]) -> [u32; 2] {
    let last = lines.len() - 2;
    let at = |x: f64| lines.partition_point(|&line| line <= x).saturating_sub(1).min(last);
    let (mut least, mut most) = (at(from), at(to));
    let near = |cell: usize| reach * (lines[cell + 1] - lines[cell]);
    if least > 0 && from - lines[least] <= near(least) {
        least -= 1;
    }
    if most < last && lines[most + 1] - to <= near(most) {
        most += 1;
    }
    [least as u32, most as u32]
}

fn runs_of(counts: [u32; 3], [[x0, x1], y, z]: Cells, runs: &mut Vec<Run>) {
    for z in z[0]..=z[1] {
        runs.extend((y[0]..=y[1]).map(|y| (Rows::row(counts, y, z), x0, x1 + 1)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Silent;

    fn even(count: u32) -> Vec<f64> {
        (0..=count).map(f64::from).collect()
    }

    /// All cells that a dense sample of the triangle lies in must be found; none further away than a cell.
    #[test]
    fn what_a_triangle_passes_through_is_touched_and_little_else() {
        let lines = [even(9), vec![0.0, 1.0, 1.5, 3.0, 4.0, 5.0, 6.0, 6.5, 8.0, 9.0], even(9)];
        for k in 0..40 {
            let at = |i: u32| {
                let p = [i * 17 + k * 29, i * 31 + k * 11, i * 13 + k * 37].map(|c| f64::from(c % 83) / 10.0);
                Point::from(p) + Point::splat(0.3)
            };
            let corners = [at(1), at(2), at(5)];
            let found = touched(&lines, 0.0, 1, |_| corners, &Silent).unwrap();
            let mut within = Vec::new();
            for i in 0..=100 {
                for j in 0..=100 - i {
                    let (u, v) = (f64::from(i) / 100.0, f64::from(j) / 100.0);
                    let p = corners[0] * (1.0 - u - v) + corners[1] * u + corners[2] * v;
                    within.push([0, 1, 2].map(|i| lines[i].partition_point(|&line| line <= p[i]) as u32 - 1));
                }
            }
            assert!(within.iter().all(|&[x, y, z]| found.holds(x, y, z)), "{corners:?}");
            let is_near = |cell: [u32; 3]| within.iter().any(|w| (0..3).all(|i| w[i].abs_diff(cell[i]) <= 1));
            assert!(found.map(|cell| cell).into_iter().all(is_near), "{corners:?}");
        }
    }

    #[test]
    fn what_lies_on_lines_touches_both_sides() {
        let lines = [even(6), even(6), even(6)];
        let corners = [Point::new(2.0, 2.0, 3.0), Point::new(4.0, 2.0, 3.0), Point::new(2.0, 4.0, 3.0)];
        let found = touched(&lines, 0.0, 1, |_| corners, &Silent).unwrap();
        for [x, y] in [[1, 1], [2, 2], [4, 1], [1, 4], [3, 2]] {
            assert!(found.holds(x, y, 2) && found.holds(x, y, 3), "{x} {y}");
        }
    }

    /// A triangle in the middle of a cell, but for one axis.
    #[test]
    fn what_comes_near_to_a_line_touches_the_cell_beyond() {
        let lines = [even(6), even(6), even(6)];
        for (x, beyond) in [(3.1, Some(2)), (3.24, Some(2)), (3.26, None), (3.74, None), (3.76, Some(4))] {
            let corners =
                [[0.0, 0.0], [0.02, 0.0], [0.0, 0.02]].map(|[y, z]| Point::new(x, 3.5 + y, 3.5 + z));
            let found = touched(&lines, 0.25, 1, |_| corners, &Silent).unwrap();
            let mut expected: Vec<[u32; 3]> = beyond.into_iter().chain([3]).map(|x| [x, 3, 3]).collect();
            expected.sort_unstable();
            assert_eq!(found.map(|cell| cell), expected, "{x}");
        }
    }
}
