//! Cheapest assignments of rows to columns, where each row may take a few columns only.
//!
//! Rows come one after the other, each along a shortest augmenting path on reduced costs (Jonker and Volgenant, *A
//! shortest augmenting path algorithm for dense and sparse linear assignment problems*, Computing 38, 1987). A row that
//! competes with few others costs little, however many there are.

use std::collections::{BTreeMap, BTreeSet};

/// A column that a row may take, and what it costs.
pub type Choice = (u32, u64);

/// What it costs a row to get nothing: more than any exchange between rows.
const NOTHING: i64 = 1 << 50;

/// Gives as many rows as can be a column of their own from their choices, at the least cost. `None` for rows that get
/// none. Costs have to stay below 2^32, and there have to be fewer than 2^16 rows that compete for a column.
///
/// ```
/// use hexmill::graph::cheapest_assignment;
/// let choices = [vec![(7, 1), (8, 9)], vec![(7, 2)], vec![(7, 0)]];
/// assert_eq!(cheapest_assignment(&choices), [Some(8), None, Some(7)]);
/// ```
pub fn cheapest_assignment(choices: &[Vec<Choice>]) -> Vec<Option<u32>> {
    let mut assignment = Assignment {
        choices,
        owners: BTreeMap::new(),
        prices: BTreeMap::new(),
        taken: vec![None; choices.len()],
    };
    for row in 0..choices.len() {
        assignment.add(row);
    }
    assignment.taken.into_iter().map(|column| column.and_then(|c| u32::try_from(c).ok())).collect()
}

struct Assignment<'a> {
    choices: &'a [Vec<Choice>],
    /// The row that has each column that is taken.
    owners: BTreeMap<u64, usize>,
    /// Dual values of the columns, never positive; 0 where not named.
    prices: BTreeMap<u64, i64>,
    taken: Vec<Option<u64>>,
}

/// A way to a column.
#[derive(Clone, Copy)]
struct Way {
    cost: i64,
    /// The row that would take the column.
    row: usize,
}

impl Assignment<'_> {
    /// Gives `row` a column, and others another one where that costs less.
    fn add(&mut self, row: usize) {
        let mut ways: BTreeMap<u64, Way> = BTreeMap::new();
        let mut open: BTreeSet<(i64, u64)> = BTreeSet::new();
        let mut settled: Vec<u64> = Vec::new();
        let (mut at, mut base) = (row, 0);
        let (end, least) = loop {
            for (column, cost) in self.columns_of(at) {
                let cost = base + cost - self.price(column);
                let old = ways.get(&column).map(|way| way.cost);
                if old.is_none_or(|old| cost < old) {
                    if let Some(old) = old {
                        open.remove(&(old, column));
                    }
                    ways.insert(column, Way { cost, row: at });
                    open.insert((cost, column));
                }
            }
            // A row's own column for nothing is always open to it.
            let (cost, column) = open.pop_first().expect("a column is open");
            let Some(&owner) = self.owners.get(&column) else { break (column, cost) };
            settled.push(column);
            let own = self.columns_of(owner).find(|&(c, _)| c == column).map_or(0, |(_, cost)| cost);
            (at, base) = (owner, cost - (own - self.price(column)));
        };
        for column in settled {
            *self.prices.entry(column).or_insert(0) += ways[&column].cost - least;
        }
        self.shift(row, end, &ways);
    }

    /// Every row on the way to `end` takes the column that it leads to.
    fn shift(&mut self, row: usize, end: u64, ways: &BTreeMap<u64, Way>) {
        let mut column = end;
        loop {
            let taker = ways[&column].row;
            self.owners.insert(column, taker);
            let before = self.taken[taker].replace(column);
            if taker == row {
                return;
            }
            column = before.expect("a row on the way has a column");
        }
    }

    /// The row's choices, and last a column of its own that stands for nothing.
    fn columns_of(&self, row: usize) -> impl Iterator<Item = (u64, i64)> + use<'_> {
        let nothing = (1 << 32) + row as u64;
        let choices = self.choices[row].iter().map(|&(column, cost)| (u64::from(column), cost as i64));
        choices.chain([(nothing, NOTHING)])
    }

    fn price(&self, column: u64) -> i64 {
        self.prices.get(&column).copied().unwrap_or(0)
    }
}
