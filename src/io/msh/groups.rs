//! Physical groups of an MSH file, and the tag sets that they make.

use std::collections::{HashMap, HashSet};

use super::UNTAGGED;
use super::file::MshFile;
use crate::io::refusal::{code, excerpt};
use crate::io::tag_interner::CellTags;
use crate::io::tag_numbers::set_of_labels;
use crate::io::{Format, ReadError};
use crate::mesh::Group;

/// What the file says of physical groups. Entities and groups are known by dimension and number.
#[derive(Default)]
pub(super) struct Groups {
    names: HashMap<(i64, i64), String>,
    of_entity: HashMap<(i64, i64), Vec<i64>>,
    /// The tags of the elements.
    pub tags: CellTags,
    /// The sets that are made, by entity and by groups.
    set_of_entity: HashMap<(i64, i64), u32>,
    set_of_groups: HashMap<(i64, Vec<i64>), u32>,
}

impl Groups {
    /// No groups yet, for a file of `size` bytes.
    pub fn new(size: usize) -> Self {
        Self { tags: CellTags::new(size), ..Self::default() }
    }

    /// Reads `$PhysicalNames` after its name.
    pub fn read_names(&mut self, file: &mut MshFile<'_>) -> Result<(), ReadError> {
        for _ in 0..file.tokens.count("the number of names", 6)? {
            let dimension = file.tokens.integer("the dimension of a group")?;
            let number = file.tokens.integer("the number of a group")?;
            let text = file.tokens.rest_of_line();
            let name =
                text.strip_prefix(b"\"").and_then(|text| text.strip_suffix(b"\"")).ok_or_else(|| {
                    let message =
                        format!("the name of a group is {}; it must stand in double quotes", excerpt(text));
                    file.tokens.refuse(code::SYNTAX, message)
                })?;
            self.names.insert((dimension, number), String::from_utf8_lossy(name).into_owned());
        }
        Ok(())
    }

    /// Reads `$Entities` after its name: only the groups of each entity matter.
    pub fn read_entities(&mut self, file: &mut MshFile<'_>) -> Result<(), ReadError> {
        self.set_of_entity.clear();
        let mut counts = [0; 4];
        for count in &mut counts {
            *count = file.size("a number of entities")?;
        }
        for (dimension, count) in (0..).zip(counts) {
            for _ in 0..count {
                let number = file.int("the number of an entity")?;
                for _ in 0..if dimension == 0 { 3 } else { 6 } {
                    file.double("the box of an entity")?;
                }
                let groups = file.size("the number of groups of an entity")?;
                let groups = file.checked(groups, 2, "the number of groups of an entity")?;
                let groups: Vec<i64> =
                    (0..groups).map(|_| file.int("the number of a group")).collect::<Result<_, _>>()?;
                self.of_entity.insert((dimension, number), groups);
                if dimension > 0 {
                    for _ in 0..file.size("the number of bounding entities")? {
                        file.int("the number of a bounding entity")?;
                    }
                }
            }
        }
        Ok(())
    }

    /// The groups of points and of curves, by their names or else their numbers.
    pub fn below_surfaces(&self) -> Vec<String> {
        let named = self.names.keys().copied();
        let of_entities = self.of_entity.iter().map(|(&(dimension, _), groups)| (dimension, groups));
        let of_elements = self.set_of_groups.keys().map(|(dimension, groups)| (*dimension, groups));
        let used = of_entities.chain(of_elements);
        let used =
            used.flat_map(|(dimension, all)| all.iter().map(move |&g| (dimension, g.saturating_abs())));
        let is_meant = |&(dimension, group): &(i64, i64)| dimension < 2 && group != 0;
        let mut all: Vec<(i64, i64)> = named.chain(used).filter(is_meant).collect();
        all.sort_unstable();
        all.dedup();
        let name = |key: &(i64, i64)| self.names.get(key).cloned().unwrap_or_else(|| key.1.to_string());
        all.iter().map(name).filter(|name| name != UNTAGGED).collect()
    }

    /// The tag set of the elements of an entity.
    pub fn set_of_entity(&mut self, dimension: i64, entity: i64) -> Result<u32, ReadError> {
        let key = (dimension, entity);
        if let Some(&set) = self.set_of_entity.get(&key) {
            return Ok(set);
        }
        let groups = self.of_entity.get(&key).cloned().unwrap_or_default();
        let set = self.set_of_groups(dimension, groups)?;
        self.set_of_entity.insert(key, set);
        Ok(set)
    }

    /// The tag set of elements in these groups: the names and numbers of all. A
    /// negative number is a group that the entity is in with the other orientation; a group that comes
    /// twice counts once.
    pub fn set_of_groups(&mut self, dimension: i64, mut groups: Vec<i64>) -> Result<u32, ReadError> {
        let mut seen = HashSet::new();
        groups.iter_mut().for_each(|group| *group = group.saturating_abs());
        groups.retain(|&group| group != 0 && seen.insert(group));
        let key = (dimension, groups);
        if let Some(&set) = self.set_of_groups.get(&key) {
            return Ok(set);
        }
        let name = |group: i64| self.names.get(&(dimension, group)).cloned().unwrap_or_default();
        let groups = key.1.iter().map(|&group| Group::new(name(group), group));
        let set = set_of_labels(groups.filter(|group| group.name != UNTAGGED));
        let index = self.tags.intern(set, Format::Msh)?;
        self.set_of_groups.insert(key, index);
        Ok(index)
    }
}
