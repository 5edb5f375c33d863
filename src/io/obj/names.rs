//! `o`, `g` and `usemtl`: which names each face has.

use std::collections::HashMap;

use super::cursor::{Result, error};
use crate::io::name_budget::NameBudget;
use crate::mesh::{TagSet, Tags};

/// Gathers the tags of the faces, in order.
pub(super) struct Names {
    current: TagSet,
    /// The index of `current` in `tags.sets`, once a face has it.
    index: Option<u32>,
    seen: HashMap<TagSet, u32>,
    tags: Tags,
    faces: usize,
    budget: NameBudget,
}

impl Names {
    pub(super) fn new(file_length: usize) -> Self {
        Self {
            current: TagSet::default(),
            index: None,
            seen: HashMap::new(),
            tags: Tags::default(),
            faces: 0,
            budget: NameBudget::new(file_length),
        }
    }

    /// `o`: faces from here on belong to this object.
    pub(super) fn set_object(&mut self, rest: &[u8]) {
        self.current.object = name(rest);
        self.index = None;
    }

    /// `usemtl`: faces from here on have this material.
    pub(super) fn set_material(&mut self, rest: &[u8]) {
        self.current.material = name(rest);
        self.index = None;
    }

    /// `g`: faces from here on belong to these groups.
    pub(super) fn set_groups<'a>(&mut self, words: impl Iterator<Item = &'a [u8]>) {
        self.current.groups = words.map(|word| text(word).into()).collect();
        self.index = None;
    }

    /// Gives the next face the current names; `line` is where it stands.
    pub(super) fn push_face(&mut self, line: u64) -> Result<()> {
        self.faces += 1;
        if self.tags.sets.is_empty() && self.current == TagSet::default() {
            return Ok(());
        }
        let index = match self.index {
            Some(index) => index,
            None => self.index_of_current(line)?,
        };
        self.tags.of_element.push(index);
        Ok(())
    }

    fn index_of_current(&mut self, line: u64) -> Result<u32> {
        if self.tags.sets.is_empty() && self.faces > 1 {
            // Faces before the first name.
            self.tags.of_element = vec![self.add(TagSet::default(), line)?; self.faces - 1];
        }
        let index = match self.seen.get(&self.current) {
            Some(&index) => index,
            None => self.add(self.current.clone(), line)?,
        };
        self.index = Some(index);
        Ok(index)
    }

    fn add(&mut self, set: TagSet, line: u64) -> Result<u32> {
        if !self.budget.take(&set) {
            let message = "the names of groups, objects and materials combine to more memory than this file \
                           is worth: give faces fewer or shorter names";
            return Err(error(line, "obj-too-many-names", message));
        }
        let index = self.tags.sets.len() as u32;
        self.seen.insert(set.clone(), index);
        self.tags.sets.push(set);
        Ok(index)
    }

    pub(super) fn finish(self) -> Tags {
        self.tags
    }
}

/// The name that the rest of a statement gives, if any. Continued lines are joined.
fn name(rest: &[u8]) -> Option<String> {
    let mut name = text(rest);
    if name.contains(['\n', '\r']) {
        name = ["\\\r\n", "\\\n", "\\\r"].into_iter().fold(name, |name, end| name.replace(end, " "));
    }
    let name = name.trim_ascii();
    (!name.is_empty()).then(|| name.to_owned())
}

/// Names are UTF-8, or else Latin-1, which takes any bytes and keeps different names different.
fn text(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&b| char::from(b)).collect(),
    }
}
