//! Tags while a file is read: one copy of each distinct set.

use std::collections::HashMap;

use super::name_budget::NameBudget;
use super::refusal::{code, refuse};
use super::{Format, ReadError};
use crate::mesh::{TagSet, Tags};

/// The tags of the cells of a file, of any kind, in the file's order.
#[derive(Default)]
pub(super) struct CellTags {
    sets: Vec<TagSet>,
    index_of: HashMap<TagSet, u32>,
    of_cell: Vec<u32>,
    budget: NameBudget,
}

impl CellTags {
    /// No tags yet, for a file of `size` bytes.
    pub fn new(size: usize) -> Self {
        Self { budget: NameBudget::new(size), ..Self::default() }
    }

    /// Tags from the number of each cell, as MEDIT and VTK have them: 0 is no tag. `named` are the sets
    /// that a number stands for where the file says more than the number.
    pub fn from_numbers(numbers: &[i64], named: &HashMap<i64, TagSet>) -> Self {
        let mut tags = Self::default();
        let mut index_of_number = HashMap::new();
        for &number in numbers {
            let index = *index_of_number.entry(number).or_insert_with(|| {
                tags.index(named.get(&number).cloned().unwrap_or_else(|| TagSet {
                    number: i32::try_from(number).ok().filter(|&n| n != 0),
                    ..TagSet::default()
                }))
            });
            tags.of_cell.push(index);
        }
        tags
    }

    /// The index of `set`, which is added unless it is there.
    ///
    /// # Errors
    /// If the names of all sets take more memory than the file is worth.
    pub fn intern(&mut self, set: TagSet, format: Format) -> Result<u32, ReadError> {
        if !self.index_of.contains_key(&set) && !self.budget.take(&set) {
            let message = "the names of groups combine to more memory than a file of this size is worth — give cells \
                           fewer or shorter names";
            return Err(refuse(format, None, code::TOO_LARGE, message));
        }
        Ok(self.index(set))
    }

    fn index(&mut self, set: TagSet) -> u32 {
        if let Some(&index) = self.index_of.get(&set) {
            return index;
        }
        let index = u32::try_from(self.sets.len()).expect("a set takes more than a byte of the file");
        self.sets.push(set.clone());
        self.index_of.insert(set, index);
        index
    }

    /// Says that the next cell has the set with this index.
    pub fn push(&mut self, set: u32) {
        self.of_cell.push(set);
    }

    /// The tags of the given cells alone, with the sets in order of first use: no tags at all if none
    /// of the cells has any. Cells without an entry are without tags.
    pub fn of_cells(&self, cells: &[u32]) -> Tags {
        let mut tags = Tags::default();
        let mut new_index: Vec<Option<u32>> = vec![None; self.sets.len()];
        let mut untagged = None;
        for &cell in cells {
            let old = self.of_cell.get(cell as usize);
            let slot = old.map_or(&mut untagged, |&set| &mut new_index[set as usize]);
            let index = *slot.get_or_insert_with(|| {
                tags.sets.push(old.map(|&set| self.sets[set as usize].clone()).unwrap_or_default());
                tags.sets.len() as u32 - 1
            });
            tags.of_element.push(index);
        }
        if tags.sets.iter().all(|set| *set == TagSet::default()) { Tags::default() } else { tags }
    }
}
