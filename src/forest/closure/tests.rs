use std::collections::{BTreeMap, BTreeSet};

use super::*;
use crate::Silent;
use crate::forest::testing::{grid, key_of, refined_once, split};

/// An element of a forest over [`grid`]: its level, and its least corner in units of its own size.
type Cell = (u32, [i64; 3]);

/// The cells of each level that are refined, level 0 aside.
fn refined_cells(forest: &HexForest) -> BTreeSet<Cell> {
    let mut cells = BTreeSet::new();
    for (depth, level) in (0..).zip(&forest.levels) {
        cells.extend(level.refined.iter().map(|&e| cell(forest, depth, e as usize)));
    }
    cells
}

fn cell(forest: &HexForest, depth: u32, e: usize) -> Cell {
    let at = key_of(forest.positions[forest.levels[depth as usize].elements[e][0].index()]);
    (depth + 1, at.map(|x| x >> (20 - depth - 1)))
}

/// The elements of `levels[depth]` by their cells.
fn by_cell(forest: &HexForest, depth: usize) -> BTreeMap<[i64; 3], u32> {
    let elements = forest.levels.get(depth).map_or(0, |l| l.elements.len());
    (0..elements as u32).map(|e| (cell(forest, depth as u32, e as usize).1, e)).collect()
}

/// Refines the children of the level `depth` cells in `parents`, with all that must be refined for them to be there.
fn refine_children(forest: &mut HexForest, depth: usize, parents: &[[i64; 3]]) {
    if depth > 0 {
        let above: Vec<[i64; 3]> = parents.iter().map(|p| p.map(|x| x >> 1)).collect();
        refine_children(forest, depth - 1, &above);
    }
    let known = by_cell(forest, depth);
    let wanted: BTreeSet<[i64; 3]> = parents.iter().flat_map(|p| children(*p)).collect();
    let marked: Vec<u32> = wanted.iter().map(|c| known[c]).collect();
    let marked: Vec<u32> =
        marked.into_iter().filter(|&e| !forest.levels[depth].is_refined[e as usize]).collect();
    split(forest, depth, &marked);
}

fn children(at: [i64; 3]) -> impl Iterator<Item = [i64; 3]> {
    (0..8).map(move |i| [2 * at[0] + (i & 1), 2 * at[1] + (i >> 1 & 1), 2 * at[2] + (i >> 2)])
}

/// The 26 cells around a cell, within a grid of `side` cells an axis.
fn around(at: [i64; 3], side: i64) -> impl Iterator<Item = [i64; 3]> {
    (0..27)
        .map(move |m| [at[0] + m % 3 - 1, at[1] + m / 3 % 3 - 1, at[2] + m / 9 - 1])
        .filter(move |c| *c != at && c.iter().all(|&x| (0..side).contains(&x)))
}

/// The least set of refined cells that holds `cells` and obeys the rules of families and of strong balance on a
/// grid of `side` coarse cells an axis: by the rules' words, one cell at a time.
fn closed(cells: &BTreeSet<Cell>, side: i64) -> BTreeSet<Cell> {
    let mut all = cells.clone();
    let mut open: Vec<Cell> = all.iter().copied().collect();
    while let Some((level, at)) = open.pop() {
        let parent = at.map(|x| x >> 1);
        let mut needed: Vec<Cell> = children(parent).map(|c| (level, c)).collect();
        if level > 1 {
            // The parent is doubly refined: all around it are refined, and so is what they are children of.
            needed.push((level - 1, parent));
            needed.extend(around(parent, side << (level - 1)).map(|c| (level - 1, c)));
        }
        open.extend(needed.into_iter().filter(|&c| all.insert(c)));
    }
    all
}

/// Every corner of a cell that is not doubly refined beside those that are: (faces, edges) of the cells of `doubly`
/// there.
fn corners_beside(doubly: &BTreeSet<[i64; 3]>, side: i64) -> Vec<(usize, usize)> {
    let beside: BTreeSet<[i64; 3]> =
        doubly.iter().flat_map(|&d| around(d, side)).filter(|c| !doubly.contains(c)).collect();
    let has = |at: [i64; 3], by: [i64; 3]| doubly.contains(&[0, 1, 2].map(|i| at[i] + by[i]));
    let mut all = Vec::new();
    for at in beside {
        for corner in 0..8 {
            let s = [0, 1, 2].map(|i| if corner >> i & 1 == 1 { 1 } else { -1 });
            let along = |axes: [i64; 3]| has(at, [0, 1, 2].map(|i| s[i] * axes[i]));
            let faces = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
            // The edge along an axis belongs to the cells beside it in the two other directions.
            let edge = |axis: usize| {
                let (u, v) = (faces[(axis + 1) % 3], faces[(axis + 2) % 3]);
                along(u) || along(v) || along([0, 1, 2].map(|i| u[i] + v[i]))
            };
            let count = faces.iter().filter(|f| along(**f)).count();
            all.push((count, (0..3).filter(|&axis| edge(axis)).count()));
        }
    }
    all
}

fn parents_of(forest: &HexForest, depth: usize) -> BTreeSet<[i64; 3]> {
    let level = depth as u32 + 1;
    let cells = refined_cells(forest).into_iter().filter(|c| c.0 == level);
    cells.map(|(_, at)| at.map(|x| x >> 1)).collect()
}

/// The subset `mask` of a block of 2 x 2 x 2 cells from `corner`.
fn block(mask: u32, corner: i64) -> Vec<[i64; 3]> {
    (0..8)
        .filter(|i| mask >> i & 1 == 1)
        .map(|i| [corner + (i & 1), corner + (i >> 1 & 1), corner + (i >> 2)])
        .collect()
}

/// Every subset of 2 x 2 x 2 coarse hexes inside 4 x 4 x 4, doubly refined, closed for Method I.
#[test]
fn all_256_blocks_of_coarse_hexes_for_method_one() {
    for mask in 0..256 {
        let mut forest = refined_once(&grid(4));
        refine_children(&mut forest, 0, &block(mask, 1));
        let before = parents_of(&forest, 0);
        let added = forest.close(Some(admits_method_one), u64::MAX, &Silent).unwrap();
        let after = parents_of(&forest, 0);
        assert!(after.is_superset(&before));
        assert_eq!((added.families, added.balance), (0, 0));
        assert_eq!(added.method, 8 * (after.len() - before.len()));
        let odd: Vec<_> =
            corners_beside(&after, 4).into_iter().filter(|&(f, e)| !admits_method_one(f, e)).collect();
        assert_eq!(odd, [], "{mask}");
        let admissible = corners_beside(&before, 4).into_iter().all(|(f, e)| admits_method_one(f, e));
        assert_eq!(admissible, before == after, "{mask}: what is admissible stays as it is");
    }
}

/// The design's figure: an L of six becomes the block of eight.
#[test]
fn method_one_fills_an_l_prism_to_a_block() {
    let mut forest = refined_once(&grid(4));
    let prism = 0b1111_1111 & !(1 << 3 | 1 << 7);
    refine_children(&mut forest, 0, &block(prism, 1));
    let added = forest.close(Some(admits_method_one), u64::MAX, &Silent).unwrap();
    assert_eq!(added, Closure { families: 0, balance: 0, method: 2 * 8 });
    assert_eq!(parents_of(&forest, 0), block(255, 1).into_iter().collect());
}

/// Every subset of 2 x 2 x 2 level-1 elements inside 4 x 4 x 4 coarse hexes, off the coarse hexes' middles, closed
/// without a method: the least forest that obeys the rules.
#[test]
fn all_256_blocks_a_level_deeper_are_balanced_as_the_rules_say() {
    for mask in 0..256 {
        let mut forest = refined_once(&grid(4));
        refine_children(&mut forest, 1, &block(mask, 3));
        let before = refined_cells(&forest);
        let added = forest.close(None, u64::MAX, &Silent).unwrap();
        let after = refined_cells(&forest);
        assert_eq!(after, closed(&before, 4), "{mask}");
        assert_eq!(added.families + added.balance, after.len() - before.len());
        assert_eq!(added.method, 0);
        assert_eq!(forest.close(None, u64::MAX, &Silent).unwrap(), Closure::default(), "closed is closed");
    }
}

/// Method I a level deeper needs balance around what it fills, and the reverse.
#[test]
fn rules_work_together_over_three_levels() {
    for mask in (1..256).step_by(5) {
        let mut forest = refined_once(&grid(3));
        refine_children(&mut forest, 2, &block(mask, 5));
        let before = refined_cells(&forest);
        let added = forest.close(Some(admits_method_one), u64::MAX, &Silent).unwrap();
        let after = refined_cells(&forest);
        assert_eq!(added.families + added.balance + added.method, after.len() - before.len());
        assert_eq!(after, closed(&after, 3), "{mask}: balanced");
        for depth in 0..3 {
            let doubly = parents_of(&forest, depth);
            let corners = corners_beside(&doubly, 3 << depth);
            assert!(corners.iter().all(|&(f, e)| admits_method_one(f, e)), "{mask} at depth {depth}");
        }
    }
}

/// Refining towards a point makes the number of levels grow; each is balanced on the next.
#[test]
fn a_corner_is_refined_deeply() {
    let mut forest = refined_once(&grid(2));
    for depth in 0..7 {
        let known = by_cell(&forest, depth);
        split(&mut forest, depth, &[known[&[(2 << depth) - 1; 3]]]);
    }
    let before = refined_cells(&forest);
    let added = forest.close(None, u64::MAX, &Silent).unwrap();
    assert_eq!(refined_cells(&forest), closed(&before, 2));
    assert!(added.families > 0 && added.balance > 0);
}

#[test]
fn stops_when_told() {
    struct Stop;
    impl Monitor for Stop {
        fn progress(&self, _: crate::Stage, _: f64) {}
        fn cancelled(&self) -> bool {
            true
        }
    }
    assert_eq!(refined_once(&grid(2)).close(None, u64::MAX, &Stop), Err(CloseError::Cancelled(Cancelled)));
}
