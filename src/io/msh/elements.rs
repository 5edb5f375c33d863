//! The `$Elements` of an MSH file.

use super::file::{MshFile, Version};
use super::groups::Groups;
use super::nodes::Nodes;
use crate::io::cell_collector::CellCollector;
use crate::io::cell_kind::{CellKind, ONLY_THESE_CELLS};
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
            let set = read_tags(file, groups, kind, tags)?;
            self.read_element(file, number, kind, node_count, set, MshFile::int)?;
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
                let set = read_tags(file, groups, kind, tags)?;
                self.read_element(file, number, kind, node_count, set, MshFile::int)?;
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
            let set = groups.set_of_entity(dimension, entity)?;
            let count = file.size("the number of elements of a block")?;
            for _ in 0..file.checked(count, LEAST_ELEMENT, "the number of elements of a block")? {
                let number = file.size("the number of an element")?;
                self.read_element(file, number, kind, node_count, set, MshFile::size)?;
            }
        }
        Ok(())
    }

    fn read_element<'a>(
        &mut self,
        file: &mut MshFile<'a>,
        number: i64,
        kind: CellKind,
        node_count: u8,
        set: u32,
        read_number: fn(&mut MshFile<'a>, &str) -> Result<i64, ReadError>,
    ) -> Result<(), ReadError> {
        let first_node = self.nodes.len();
        for _ in 0..node_count {
            self.nodes.push(read_number(file, "a node of an element")?);
        }
        self.elements.push(Element { number, first_node, node_count, kind, set });
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
        let mut indices = [0; 8];
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

fn element_type(file: &mut MshFile<'_>) -> Result<(CellKind, u8), ReadError> {
    let number = file.int("the type of an element")?;
    CellKind::from_gmsh(number).map_err(|name| {
        let message = format!("the mesh has a {name} (Gmsh type {number}); {ONLY_THESE_CELLS}");
        file.tokens.refuse(code::UNSUPPORTED_CELL, message)
    })
}

/// The tags of an element of version 2: the first is the physical group, the others say nothing of it.
fn read_tags(
    file: &mut MshFile<'_>,
    groups: &mut Groups,
    kind: CellKind,
    count: i64,
) -> Result<u32, ReadError> {
    let mut group = 0;
    for index in 0..count {
        let tag = file.int("a tag of an element")?;
        if index == 0 {
            group = tag;
        }
    }
    groups.set_of_groups(dimension(kind), vec![group])
}

fn dimension(kind: CellKind) -> i64 {
    match kind {
        CellKind::Skipped => 0,
        CellKind::Polyline => 1,
        CellKind::Hex | CellKind::Voxel => 3,
        _ => 2,
    }
}
