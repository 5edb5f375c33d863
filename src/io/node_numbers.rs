//! Node numbers of formats that number their nodes freely, as Gmsh and Abaqus do.

use std::collections::HashMap;

/// From a file's node numbers to indices. Numbers that count up by one, as nearly all files have them,
/// take no memory.
#[derive(Default)]
pub(super) struct NodeNumbers {
    /// The first number, and how many follow it one by one.
    first: i64,
    run: u32,
    /// Indices of the numbers beyond the run.
    others: HashMap<i64, u32>,
}

impl NodeNumbers {
    /// Gives the next index to `number`; `None` if the number has one or there are too many.
    pub fn add(&mut self, number: i64) -> Option<u32> {
        let index = u32::try_from(self.len()).ok()?;
        if self.index(number).is_some() {
            return None;
        }
        if index == 0 {
            self.first = number;
        }
        if self.others.is_empty() && self.first.checked_add(i64::from(self.run)) == Some(number) {
            self.run = self.run.checked_add(1)?;
        } else {
            self.others.insert(number, index);
        }
        Some(index)
    }

    /// How many numbers there are.
    pub fn len(&self) -> usize {
        self.run as usize + self.others.len()
    }

    /// The index of `number`.
    pub fn index(&self, number: i64) -> Option<u32> {
        let in_run = number.checked_sub(self.first).and_then(|step| u32::try_from(step).ok());
        in_run.filter(|&step| step < self.run).or_else(|| self.others.get(&number).copied())
    }
}
