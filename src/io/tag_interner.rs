//! Tags while a file is read: one copy of each distinct set.

use std::collections::{HashMap, HashSet};

use super::name_budget::NameBudget;
use super::refusal::{code, refuse};
use super::tag_numbers::Names;
use super::{Format, ReadError};
use crate::mesh::topology::Side;
use crate::mesh::{FaceGroups, Group, TagSet, Tags};

/// The tags of the cells of a file, of any kind, in the file's order.
#[derive(Default)]
pub(super) struct CellTags {
    sets: Vec<TagSet>,
    index_of: HashMap<TagSet, u32>,
    of_cell: Vec<u32>,
    /// The sets that are made of several others.
    unions: HashMap<Vec<u32>, u32>,
    budget: NameBudget,
}

impl CellTags {
    /// No tags yet, for a file of `size` bytes.
    pub fn new(size: usize) -> Self {
        Self { budget: NameBudget::new(size), ..Self::default() }
    }

    /// Tags from the number of each cell, as MEDIT and VTK have them: 0 is no tag. `named` are the sets
    /// that a number stands for where the file says more than the number; for faces of hexes these are others.
    pub fn from_numbers(numbers: &[i64], named: &Names, is_face: impl Fn(usize) -> bool) -> Self {
        let mut tags = Self::new(0);
        let mut index_of_number = HashMap::new();
        for (cell, &number) in numbers.iter().enumerate() {
            let of_face = is_face(cell);
            let index = *index_of_number.entry((number, of_face)).or_insert_with(|| {
                tags.index(named.get(number, of_face).cloned().unwrap_or_else(|| TagSet {
                    number: Some(number).filter(|&n| n != 0),
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
        let tags = self.in_order_of_use(cells.iter().map(|&cell| self.of_cell.get(cell as usize).copied()));
        if tags.sets.iter().all(|set| *set == TagSet::default()) { Tags::default() } else { tags }
    }

    /// The groups of faces: cells of the file by the sides that they are, ascending. A side is in the groups
    /// of all its cells; those of cells without tags are in none.
    ///
    /// # Errors
    /// If the names of all sets take more memory than the file is worth.
    pub fn of_sides(&mut self, cells: &[(Side, u32)], format: Format) -> Result<FaceGroups, ReadError> {
        let (mut sides, mut sets, mut here) = (Vec::new(), Vec::new(), Vec::new());
        for same in cells.chunk_by(|a, b| a.0 == b.0) {
            here.clear();
            let known = same.iter().filter_map(|&(_, cell)| self.of_cell.get(cell as usize).copied());
            here.extend(known.filter(|&set| self.sets[set as usize] != TagSet::default()));
            here.sort_unstable();
            here.dedup();
            let set = match here.as_slice() {
                [] => continue,
                &[set] => set,
                several => self.union_of(several, format)?,
            };
            sides.push(same[0].0);
            sets.push(set);
        }
        let tags = self.in_order_of_use(sets.into_iter().map(Some));
        Ok(FaceGroups::new(sides, tags).expect("sides ascend, each with a set"))
    }

    /// The index of the set that says what several do, which is added unless it is there.
    ///
    /// # Errors
    /// If the names of all sets take more memory than the file is worth.
    pub fn union_of(&mut self, several: &[u32], format: Format) -> Result<u32, ReadError> {
        if let Some(&set) = self.unions.get(several) {
            return Ok(set);
        }
        let set = self.intern(union(several.iter().map(|&s| &self.sets[s as usize])), format)?;
        self.unions.insert(several.to_vec(), set);
        Ok(set)
    }

    /// What the tags of the given cells are called, each once, in order of first use: their groups, or else their number.
    pub fn names_of(&self, cells: &[u32]) -> Vec<String> {
        let (mut is_told, mut known, mut names) = (vec![false; self.sets.len()], HashSet::new(), Vec::new());
        for set in cells.iter().filter_map(|&cell| self.of_cell.get(cell as usize)) {
            if std::mem::replace(&mut is_told[*set as usize], true) {
                continue;
            }
            let set = &self.sets[*set as usize];
            let number = set.number.filter(|_| set.groups.is_empty()).map(|number| number.to_string());
            let groups = set.groups.iter().map(Group::to_string);
            names.extend(groups.chain(number).filter(|name| known.insert(name.clone())));
        }
        names
    }

    /// Tags of elements with the given sets, which are renumbered in order of first use.
    fn in_order_of_use(&self, elements: impl Iterator<Item = Option<u32>>) -> Tags {
        let mut tags = Tags::default();
        let mut new_index: Vec<Option<u32>> = vec![None; self.sets.len()];
        let mut untagged = None;
        for old in elements {
            let slot = old.map_or(&mut untagged, |set| &mut new_index[set as usize]);
            let index = *slot.get_or_insert_with(|| {
                tags.sets.push(old.map(|set| self.sets[set as usize].clone()).unwrap_or_default());
                tags.sets.len() as u32 - 1
            });
            tags.of_element.push(index);
        }
        tags
    }
}

/// What several sets say together: all groups, and the first object, material and number. Further numbers are of groups
/// without names.
fn union<'a>(sets: impl Iterator<Item = &'a TagSet>) -> TagSet {
    let mut union = TagSet::default();
    let mut known = HashSet::new();
    for set in sets {
        union.object = union.object.or_else(|| set.object.clone());
        union.material = union.material.or_else(|| set.material.clone());
        let is_groups = |number: i64| set.groups.iter().any(|group| group.number == Some(number));
        let nameless =
            set.number.filter(|&number| union.number.is_some_and(|u| u != number) && !is_groups(number));
        union.number = union.number.or(set.number);
        let nameless = nameless.map(|number| Group::new("", number));
        union.groups.extend(
            nameless.into_iter().chain(set.groups.iter().cloned()).filter(|g| known.insert(g.clone())),
        );
    }
    union
}
