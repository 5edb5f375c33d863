//! The `$Elements` of an MSH file.

use std::collections::{BTreeMap, HashMap};

use super::file::{MshFile, Version};
use super::groups::Groups;
use super::nodes::Nodes;
use crate::io::cell_collector::CellCollector;
use crate::io::cell_kind::{CellKind, ONLY_THESE_CELLS, with_article};
use crate::io::refusal::{code, refuse};
use crate::io::{Format, ReadError};

/// Elements in the file's order, each with its number, kind, tag set and nodes.
#[derive(Default)]
pub(super) struct Elements {
    elements: Vec<Element>,
    /// The nodes of all elements, as the file numbers them.
    nodes: Vec<i64>,
}

#[derive(Clone, Copy)]
struct Element {
    number: i64,
    first_node: usize,
    node_count: u8,
    kind: CellKind,
    set: u32,
    /// In version 2, where elements come once for each group that their entity is in.
    entity: Option<i32>,
}

/// What the tags of an element say.
#[derive(Clone, Copy)]
struct Place {
    set: u32,
    entity: Option<i32>,
}

/// Bytes that an element takes at least: a number and a node in words.
const LEAST_ELEMENT: usize = 3;

impl Elements {
    /// Reads the section after its name.
    pub fn read(&mut self, file: &mut MshFile<'_>, groups: &mut Groups) -> Result<(), ReadError> {
        match file.version {
            Version::Two if file.is_binary() => self.read_version_2_binary(file, groups),
            Version::Two => self.read_version_2(file, groups),
            Version::Four => self.read_version_4(file, groups),
        }
    }

    fn read_version_2(&mut self, file: &mut MshFile<'_>, groups: &mut Groups) -> Result<(), ReadError> {
        for _ in 0..file.tokens.count("the number of elements", LEAST_ELEMENT)? {
            let number = file.int("the number of an element")?;
            let (kind, node_count) = element_type(file)?;
            let tags = file.int("the number of tags")?;
            let place = read_tags(file, groups, kind, tags)?;
            self.read_element(file, number, (kind, node_count), place, MshFile::int)?;
        }
        Ok(())
    }

    /// Binary: runs of elements of one type, all numbers `int`.
    fn read_version_2_binary(
        &mut self,
        file: &mut MshFile<'_>,
        groups: &mut Groups,
    ) -> Result<(), ReadError> {
        let mut left = file.tokens.count("the number of elements", 4)?;
        file.start_data();
        while left > 0 {
            let (kind, node_count) = element_type(file)?;
            let run = file.int("the number of elements of a run")?;
            let run = file.checked(run, 4, "the number of elements of a run")?;
            if run == 0 || run > left {
                let message = format!("a run has {run} elements where {left} are left");
                return Err(file.tokens.refuse(code::INCONSISTENT, message));
            }
            left -= run;
            let tags = file.int("the number of tags")?;
            for _ in 0..run {
                let number = file.int("the number of an element")?;
                let place = read_tags(file, groups, kind, tags)?;
                self.read_element(file, number, (kind, node_count), place, MshFile::int)?;
            }
        }
        Ok(())
    }

    fn read_version_4(&mut self, file: &mut MshFile<'_>, groups: &mut Groups) -> Result<(), ReadError> {
        let blocks = file.size("the number of blocks of elements")?;
        for what in ["the number of elements", "the least element number", "the greatest element number"] {
            file.size(what)?;
        }
        for _ in 0..blocks {
            let dimension = file.int("the dimension of an entity")?;
            let entity = file.int("the number of an entity")?;
            let (kind, node_count) = element_type(file)?;
            let place = Place { set: groups.set_of_entity(dimension, entity)?, entity: None };
            let count = file.size("the number of elements of a block")?;
            for _ in 0..file.checked(count, LEAST_ELEMENT, "the number of elements of a block")? {
                let number = file.size("the number of an element")?;
                self.read_element(file, number, (kind, node_count), place, MshFile::size)?;
            }
        }
        Ok(())
    }

    fn read_element<'a>(
        &mut self,
        file: &mut MshFile<'a>,
        number: i64,
        (kind, node_count): (CellKind, u8),
        Place { set, entity }: Place,
        read_number: fn(&mut MshFile<'a>, &str) -> Result<i64, ReadError>,
    ) -> Result<(), ReadError> {
        let first_node = self.nodes.len();
        for _ in 0..node_count {
            self.nodes.push(read_number(file, "a node of an element")?);
        }
        self.elements.push(Element { number, first_node, node_count, kind, set, entity });
        Ok(())
    }

    /// Hands the elements to `collector` in the order of their numbers, and their sets to `groups`.
    pub fn collect(
        mut self,
        nodes: &Nodes,
        groups: &mut Groups,
        collector: &mut CellCollector,
    ) -> Result<(), ReadError> {
        if !self.elements.is_sorted_by_key(|element| element.number) {
            self.elements.sort_by_key(|element| element.number);
        }
        self.merge_repeated(groups)?;
        let mut indices = [0; 27];
        for element in &self.elements {
            let indices = &mut indices[..usize::from(element.node_count)];
            for (index, &number) in indices.iter_mut().zip(&self.nodes[element.first_node..]) {
                *index = nodes.numbers.index(number).map(i64::from).ok_or_else(|| {
                    let message = format!(
                        "element {} names node {number}, which the file does not have — correct the number or \
                         add the node",
                        element.number
                    );
                    refuse(Format::Msh, None, code::NODE_OUT_OF_RANGE, message)
                })?;
            }
            collector.push(element.kind, indices, None)?;
            groups.tags.push(element.set);
        }
        Ok(())
    }
}

impl Elements {
    /// Leaves one of the elements that are the same but for their groups, the first, and puts it into the groups of all. A
    /// true repetition, in a group for the second time, stays.
    fn merge_repeated(&mut self, groups: &mut Groups) -> Result<(), ReadError> {
        let mut set_of: HashMap<(CellKind, i32), u32> = HashMap::new();
        let is_repeated = |element: &Element| {
            element.entity.is_some_and(|entity| {
                *set_of.entry((element.kind, entity)).or_insert(element.set) != element.set
            })
        };
        if !self.elements.iter().any(is_repeated) {
            return Ok(());
        }
        let mut sorted = self.nodes.clone();
        for element in &self.elements {
            sorted[element.first_node..][..usize::from(element.node_count)].sort_unstable();
        }
        let mut first_of: HashMap<(CellKind, Option<i32>, &[i64]), usize> = HashMap::new();
        let mut sets_of: BTreeMap<usize, Vec<u32>> = BTreeMap::new();
        let mut is_kept = vec![true; self.elements.len()];
        for (k, element) in self.elements.iter().enumerate() {
            let nodes = &sorted[element.first_node..][..usize::from(element.node_count)];
            let first = *first_of.entry((element.kind, element.entity, nodes)).or_insert(k);
            if first == k {
                continue;
            }
            let sets = sets_of.entry(first).or_insert_with(|| vec![self.elements[first].set]);
            if !sets.contains(&element.set) {
                sets.push(element.set);
                is_kept[k] = false;
            }
        }
        drop(first_of);
        for (first, sets) in sets_of {
            self.elements[first].set = groups.tags.union_of(&sets, Format::Msh)?;
        }
        let mut is_kept = is_kept.into_iter();
        self.elements.retain(|_| is_kept.next().unwrap_or(true));
        Ok(())
    }
}

fn element_type(file: &mut MshFile<'_>) -> Result<(CellKind, u8), ReadError> {
    let number = file.int("the type of an element")?;
    CellKind::from_gmsh(number).map_err(|name| {
        let name = with_article(name);
        let message = format!("the mesh has {name} (Gmsh type {number}); {ONLY_THESE_CELLS}");
        file.tokens.refuse(code::UNSUPPORTED_CELL, message)
    })
}

/// The tags of an element of version 2: the first is the physical group, the second the entity.
fn read_tags(
    file: &mut MshFile<'_>,
    groups: &mut Groups,
    kind: CellKind,
    count: i64,
) -> Result<Place, ReadError> {
    let (mut group, mut entity) = (0, 0);
    for index in 0..count {
        let tag = file.int("a tag of an element")?;
        match index {
            0 => group = tag,
            1 => entity = tag,
            _ => {}
        }
    }
    let set = groups.set_of_groups(dimension(kind), vec![group])?;
    Ok(Place { set, entity: i32::try_from(entity).ok() })
}

fn dimension(kind: CellKind) -> i64 {
    match kind {
        CellKind::Skipped => 0,
        CellKind::Polyline | CellKind::Edge3 => 1,
        kind if kind.is_hex() => 3,
        _ => 2,
    }
}
