//! Nodes, elements and element sets of one part, which numbers them by itself.

use std::collections::HashMap;

use super::lines::{Keyword, Line, Lines};
use crate::geometry::Point;
use crate::io::cell_kind::{CellKind, ONLY_THESE_CELLS, with_article};
use crate::io::node_numbers::NodeNumbers;
use crate::io::refusal::{code, excerpt, refuse_not_finite};
use crate::io::{Format, ReadError};

/// A part; or what stands outside of parts.
#[derive(Default)]
pub(super) struct Part {
    pub positions: Vec<Point>,
    node_numbers: NodeNumbers,
    pub elements: Vec<Element>,
    /// The nodes of all elements, as indices.
    nodes: Vec<u32>,
    /// Indices of elements by number.
    element_numbers: NodeNumbers,
    /// Elements by number, sorted, for `GENERATE`; made when it is first needed.
    sorted: Vec<(i64, u32)>,
    pub sets: Vec<ElementSet>,
    /// Sets by instance and by name in capitals.
    set_of_name: HashMap<(Option<usize>, String), usize>,
    /// Members of all sets together, and how many there may be.
    member_count: usize,
    member_limit: usize,
}

/// An element of a part.
pub(super) struct Element {
    pub number: i64,
    pub kind: CellKind,
    pub line: u64,
    first_node: usize,
    node_count: u8,
}

/// A named set of elements, by their indices.
pub(super) struct ElementSet {
    pub name: String,
    /// The instance that the set is of; `None` if it is of the part.
    pub instance: Option<usize>,
    pub members: Vec<u32>,
    /// Was it made by a program for itself, for a surface say?
    pub is_internal: bool,
}

/// Members that the element sets may have together for each byte of the file. A few words can name many
/// elements, so that a small file could ask for any amount of memory.
const MEMBERS_PER_BYTE: usize = 16;

impl Part {
    /// A part of a file of `size` bytes.
    pub fn new(size: usize) -> Self {
        Self { member_limit: size.saturating_mul(MEMBERS_PER_BYTE), ..Self::default() }
    }

    /// Reads the data of `*NODE`.
    pub fn read_nodes(&mut self, keyword: &Keyword, lines: &mut Lines<'_>) -> Result<(), ReadError> {
        if keyword.get("SYSTEM").is_some_and(|system| !system.eq_ignore_ascii_case("R")) {
            let message = "the nodes are in cylindrical or spherical coordinates, which are not read — write \
                           them in rectangular ones";
            return Err(keyword.refuse(code::UNSUPPORTED_FEATURE, message.into()));
        }
        while let Some(line) = lines.next_data() {
            let mut fields = line.fields();
            let number = line.integer(fields.next().unwrap_or_default(), "the number of a node")?;
            let mut coordinate = || line.float(fields.next().unwrap_or_default(), "a coordinate");
            let position = Point::new(coordinate()?, coordinate()?, coordinate()?);
            if !position.is_finite() {
                return Err(refuse_not_finite(Format::Inp, line.number, number));
            }
            if self.node_numbers.add(number).is_none() {
                let message = format!("node {number} comes twice — give one of the two another number");
                return Err(line.refuse(code::DUPLICATE_NUMBER, message));
            }
            self.positions.push(position);
        }
        Ok(())
    }

    /// Reads the data of `*ELEMENT`.
    pub fn read_elements(&mut self, keyword: &Keyword, lines: &mut Lines<'_>) -> Result<(), ReadError> {
        let kind_name = keyword.require("TYPE")?.to_ascii_uppercase();
        let kind = CellKind::from_abaqus(&kind_name).map_err(|name| {
            let (word, name) = (excerpt(kind_name.as_bytes()), with_article(name));
            let message = format!("{word} is {name}; {ONLY_THESE_CELLS}");
            keyword.refuse(code::UNSUPPORTED_CELL, message)
        })?;
        if kind == CellKind::Skipped {
            return Ok(());
        }
        let first = self.elements.len() as u32;
        while let Some(line) = lines.next_data() {
            self.read_element(kind, line, lines)?;
        }
        if let Some(name) = keyword.get("ELSET").filter(|name| !name.is_empty()) {
            let set = self.set(name, None);
            self.sets[set].members.extend(first..self.elements.len() as u32);
            self.member_count += self.elements.len() - first as usize;
        }
        Ok(())
    }

    fn read_element<'a>(
        &mut self,
        kind: CellKind,
        first: Line<'a>,
        lines: &mut Lines<'a>,
    ) -> Result<(), ReadError> {
        let mut line = first;
        let mut fields = line.fields();
        let number = line.integer(fields.next().unwrap_or_default(), "the number of an element")?;
        if self.element_numbers.add(number).is_none() {
            let message = format!("element {number} comes twice — give one of the two another number");
            return Err(line.refuse(code::DUPLICATE_NUMBER, message));
        }
        let first_node = self.nodes.len();
        let size = kind.size();
        let (least, most) = (*size.start(), *size.end());
        while self.nodes.len() < first_node + most {
            let Some(field) = fields.next() else {
                let found = self.nodes.len() - first_node;
                if found >= least && !lines.continue_element(line, most - found) {
                    break;
                }
                line = lines.next_data().ok_or_else(|| {
                    let message = format!("element {number} has {found} nodes; its type needs {least}");
                    line.refuse(code::CELL_SIZE, message)
                })?;
                fields = line.fields();
                continue;
            };
            let node = line.integer(field, "a node of an element")?;
            let index = self.node_numbers.index(node).ok_or_else(|| {
                let message = format!(
                    "element {number} names node {node}, which stands nowhere before it — correct the number or \
                     add the node"
                );
                line.refuse(code::NODE_OUT_OF_RANGE, message)
            })?;
            self.nodes.push(index);
        }
        if let Some(more) = fields.next().filter(|field| !field.is_empty()) {
            let message = format!(
                "element {number} has more than the {most} nodes of its type: {} follows",
                excerpt(more)
            );
            return Err(line.refuse(code::CELL_SIZE, message));
        }
        let node_count = (self.nodes.len() - first_node) as u8;
        self.elements.push(Element { number, kind, line: first.number, first_node, node_count });
        Ok(())
    }

    /// Reads the data of `*ELSET` into the set of that name, of the part or of an instance. Numbers of
    /// elements of kinds that are skipped are left out.
    pub fn read_set(
        &mut self,
        keyword: &Keyword,
        lines: &mut Lines<'_>,
        instance: Option<usize>,
    ) -> Result<(), ReadError> {
        let set = self.set(keyword.require("ELSET")?, instance);
        self.sets[set].is_internal |= keyword.get("INTERNAL").is_some();
        let before = self.sets[set].members.len();
        let generate = keyword.get("GENERATE").is_some();
        while let Some(line) = lines.next_data() {
            if generate {
                self.generate(set, line)?;
            } else {
                for field in line.fields().filter(|field| !field.is_empty()) {
                    self.add_members(set, field, line)?;
                }
            }
        }
        self.remove_repeated(set);
        self.member_count += self.sets[set].members.len().saturating_sub(before);
        if self.member_count > self.member_limit {
            let message =
                "the element sets have more members than a file of this size should name".to_owned();
            return Err(keyword.refuse(code::TOO_LARGE, message));
        }
        Ok(())
    }

    /// Adds what a field of `*ELSET` names: an element or another set.
    fn add_members(&mut self, set: usize, field: &[u8], line: Line<'_>) -> Result<(), ReadError> {
        if field[0].is_ascii_digit() {
            let number = line.integer(field, "the number of an element")?;
            self.sets[set].members.extend(self.element_numbers.index(number));
            return Ok(());
        }
        let name = String::from_utf8_lossy(field).trim_matches('"').to_ascii_uppercase();
        let instance = self.sets[set].instance;
        let of_instance = self.set_of_name.get(&(instance, name.clone()));
        let Some(&other) = of_instance.or_else(|| self.set_of_name.get(&(None, name))) else {
            let message = format!("the element set {} stands nowhere before this line", excerpt(field));
            return Err(line.refuse(code::INCONSISTENT, message));
        };
        let members = self.sets[other].members.clone();
        self.sets[set].members.extend(members);
        self.limit_repeated(set);
        Ok(())
    }

    /// Keeps a set that is named again and again from growing without end.
    fn limit_repeated(&mut self, set: usize) {
        if self.sets[set].members.len() > 2 * self.elements.len() {
            self.remove_repeated(set);
        }
    }

    fn remove_repeated(&mut self, set: usize) {
        self.sets[set].members.sort_unstable();
        self.sets[set].members.dedup();
    }

    /// Adds the elements with the numbers first, first + step, ... last, as far as there are such.
    fn generate(&mut self, set: usize, line: Line<'_>) -> Result<(), ReadError> {
        let numbers: Vec<i64> = line
            .fields()
            .map(|field| line.integer(field, "first, last or step"))
            .collect::<Result<_, _>>()?;
        let (first, last, step) = match numbers[..] {
            [first, last] => (first, last, 1),
            [first, last, step] if step > 0 => (first, last, step),
            _ => {
                let message = "GENERATE needs a first number, a last and a step above 0".to_owned();
                return Err(line.refuse(code::SYNTAX, message));
            }
        };
        if self.sorted.len() != self.elements.len() {
            self.sorted = self.elements.iter().map(|element| element.number).zip(0..).collect();
            self.sorted.sort_unstable();
        }
        let from = self.sorted.partition_point(|&(number, _)| number < first);
        let within = self.sorted[from..].iter().take_while(|&&(number, _)| number <= last);
        let chosen = within.filter(|(number, _)| number.abs_diff(first).is_multiple_of(step.unsigned_abs()));
        self.sets[set].members.extend(chosen.map(|&(_, index)| index));
        self.limit_repeated(set);
        Ok(())
    }

    /// How much there is to place with each instance: nodes of elements, element sets and their members.
    pub fn places(&self) -> usize {
        self.nodes.len() + self.sets.len() + self.sets.iter().map(|set| set.members.len()).sum::<usize>()
    }

    /// The members of the set with this name, in capitals, of the part or of an instance.
    pub fn set_members(&self, name: &str, instance: Option<usize>) -> Option<&[u32]> {
        let set = self.set_of_name.get(&(instance, name.to_owned()))?;
        Some(&self.sets[*set].members)
    }

    /// The names, in capitals, of sets that are of an instance, each with the instance.
    pub fn sets_of_instances(&self) -> impl Iterator<Item = (&str, usize)> {
        self.set_of_name.keys().filter_map(|(instance, name)| Some((name.as_str(), (*instance)?)))
    }

    /// The place of the element with this number.
    pub fn place_of(&self, number: i64) -> Option<u32> {
        self.element_numbers.index(number)
    }

    /// The nodes of an element, as indices into the positions.
    pub fn nodes_of(&self, element: &Element) -> &[u32] {
        &self.nodes[element.first_node..element.first_node + usize::from(element.node_count)]
    }

    /// The place of the set with this name in any case, which is added unless it is there.
    fn set(&mut self, name: &str, instance: Option<usize>) -> usize {
        *self.set_of_name.entry((instance, name.to_ascii_uppercase())).or_insert_with(|| {
            self.sets.push(ElementSet {
                name: name.to_owned(),
                instance,
                members: Vec::new(),
                is_internal: false,
            });
            self.sets.len() - 1
        })
    }
}
