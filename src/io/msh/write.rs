//! Writes MSH 4.1.

use std::collections::{BTreeMap, BTreeSet};

use super::UNTAGGED;
use crate::geometry::Aabb;
use crate::io::cell_view::{CellView, Cells};
use crate::io::tag_numbers::labels;
use crate::io::text::Text;
use crate::io::{Document, Format, WriteError};
use crate::mesh::{TagSet, Tags};

/// The file as bytes: the same for any number of threads.
pub fn write(document: &Document) -> Result<Vec<u8>, WriteError> {
    let view = CellView::new(document, Format::Msh)?;
    view.refuse_polygons(Format::Msh)?;
    let dimension = if view.cells.are_hexes() { 3 } else { 2 };
    let groups = PhysicalGroups::of(view.tags);
    let mut file = Text::default();
    file.word("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
    write_names(&mut file, &groups, dimension);
    write_entities(&mut file, &view, &groups, dimension);
    write_nodes(&mut file, &view, dimension);
    write_elements(&mut file, &view, dimension);
    Ok(file.into_bytes())
}

/// The physical groups of each tag set, and the names of those that have one.
struct PhysicalGroups {
    of_set: Vec<Vec<i32>>,
    names: BTreeMap<i32, String>,
}

impl PhysicalGroups {
    /// A group for each label, and one without a name for the number of each set. A set with one label
    /// and a number gives the label that number, as Gmsh's own groups have it.
    fn of(tags: &Tags) -> Self {
        let mut taken = BTreeSet::new();
        let own: Vec<Option<i32>> = tags
            .sets
            .iter()
            .map(|set| set.number.filter(|&number| number > 0 && taken.insert(number)))
            .collect();
        let labels: Vec<Vec<String>> =
            tags.sets.iter().zip(&own).map(|(set, own)| labels_or_untagged(set, *own)).collect();
        let mut number_of: BTreeMap<&str, i32> = BTreeMap::new();
        for (own, labels) in own.iter().zip(&labels) {
            if let ([label], Some(number)) = (labels.as_slice(), own) {
                number_of.entry(label).or_insert(*number);
            }
        }
        let mut free = 1;
        for label in labels.iter().flatten() {
            number_of.entry(label).or_insert_with(|| {
                while !taken.insert(free) {
                    free += 1;
                }
                free
            });
        }
        let of_set = own
            .into_iter()
            .zip(&labels)
            .map(|(own, labels)| {
                let mut groups: Vec<i32> = own.into_iter().collect();
                for label in labels {
                    let number = number_of[label.as_str()];
                    if !groups.contains(&number) {
                        groups.push(number);
                    }
                }
                groups
            })
            .collect();
        let names = number_of.into_iter().map(|(label, number)| (number, quotable(label))).collect();
        Self { of_set, names }
    }
}

fn labels_or_untagged(set: &TagSet, own: Option<i32>) -> Vec<String> {
    let labels = labels(set);
    if labels.is_empty() && own.is_none() {
        return vec![UNTAGGED.to_owned()];
    }
    labels
}

/// A name as it can stand between double quotes on a line, with at most the 127 bytes that Gmsh reads.
fn quotable(name: &str) -> String {
    let mut quoted: String = name.replace('"', "'").replace(['\n', '\r'], " ");
    let end = (0..=quoted.len().min(127)).rev().find(|&end| quoted.is_char_boundary(end));
    quoted.truncate(end.unwrap_or(0));
    quoted
}

fn write_names(file: &mut Text, groups: &PhysicalGroups, dimension: u8) {
    if groups.names.is_empty() {
        return;
    }
    file.word("$PhysicalNames\n").integer(groups.names.len()).word("\n");
    for (&number, name) in &groups.names {
        file.integer(dimension).word(" ").integer(number).word(" \"").word(name).word("\"\n");
    }
    file.word("$EndPhysicalNames\n");
}

/// An entity for each tag set, numbered from 1; one in all for a mesh without tags.
fn write_entities(file: &mut Text, view: &CellView<'_>, groups: &PhysicalGroups, dimension: u8) {
    let entities = groups.of_set.len().max(1);
    let bounds = Aabb::around(view.positions);
    let corners =
        if view.positions.is_empty() { [[0.0; 3]; 2] } else { [bounds.min, bounds.max].map(Into::into) };
    file.word("$Entities\n0 0 ").word(if dimension == 2 { "" } else { "0 " }).integer(entities);
    file.word(if dimension == 2 { " 0\n" } else { "\n" });
    for entity in 0..entities {
        file.integer(entity + 1);
        for coordinate in corners.as_flattened() {
            file.word(" ").float(*coordinate);
        }
        let groups = groups.of_set.get(entity).map_or(&[][..], Vec::as_slice);
        file.word(" ").integer(groups.len());
        for &group in groups {
            file.word(" ").integer(group);
        }
        file.word(" 0\n");
    }
    file.word("$EndEntities\n");
}

fn write_nodes(file: &mut Text, view: &CellView<'_>, dimension: u8) {
    let count = view.positions.len();
    file.word("$Nodes\n1 ").integer(count).word(" 1 ").integer(count).word("\n");
    file.integer(dimension).word(" 1 0 ").integer(count).word("\n");
    file.items(count, |line, node| {
        line.integer(node + 1).word("\n");
    });
    file.items(count, |line, node| {
        let p = view.positions[node];
        line.float(p.x).word(" ").float(p.y).word(" ").float(p.z).word("\n");
    });
    file.word("$EndNodes\n");
}

/// Elements in blocks of one entity and one type, each with the number that its place in the mesh gives.
fn write_elements(file: &mut Text, view: &CellView<'_>, dimension: u8) {
    let cells = view.cells;
    let mut blocks: BTreeMap<(u32, u8), Vec<u32>> = BTreeMap::new();
    for cell in 0..cells.len() {
        let set = view.tags.of_element.get(cell).copied().unwrap_or(0);
        blocks.entry((set, element_type(cells, cell))).or_default().push(cell as u32);
    }
    file.word("$Elements\n").integer(blocks.len()).word(" ").integer(cells.len());
    file.word(" 1 ").integer(cells.len()).word("\n");
    for ((set, kind), members) in &blocks {
        file.integer(dimension).word(" ").integer(set + 1).word(" ").integer(*kind);
        file.word(" ").integer(members.len()).word("\n");
        file.items(members.len(), |line, index| {
            let cell = members[index];
            line.integer(cell + 1);
            for node in cells.nodes(cell as usize) {
                line.word(" ").integer(u64::from(node.0) + 1);
            }
            line.word("\n");
        });
    }
    file.word("$EndElements\n");
}

fn element_type(cells: Cells<'_>, cell: usize) -> u8 {
    match cells {
        Cells::Hexes(_) => 5,
        _ if cells.nodes(cell).len() == 3 => 2,
        _ => 3,
    }
}
