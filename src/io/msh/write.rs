//! Writes MSH 4.1.

use std::collections::{BTreeMap, BTreeSet};

use super::UNTAGGED;
use crate::geometry::Aabb;
use crate::io::cell_view::{CellView, Cells, GroupedFaces};
use crate::io::tag_numbers::{Label, labels};
use crate::io::text::Text;
use crate::io::{Document, Format, WriteError};
use crate::mesh::{NodeId, TagSet, Tags};

/// The file as bytes: the same for any number of threads.
pub fn write(document: &Document) -> Result<Vec<u8>, WriteError> {
    let view = CellView::new(document, Format::Msh)?;
    view.refuse_polygons(Format::Msh)?;
    let parts = parts(&view);
    let mut file = Text::default();
    file.word("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n");
    write_names(&mut file, &parts);
    write_entities(&mut file, &view, &parts);
    write_nodes(&mut file, &view, parts[0].dimension);
    write_elements(&mut file, &parts);
    Ok(file.into_bytes())
}

/// The cells of one dimension.
struct Part<'a> {
    dimension: u8,
    /// The number of the cell before the first.
    before: usize,
    cells: Elements<'a>,
    tags: &'a Tags,
    groups: PhysicalGroups,
}

/// Cells of the mesh, or faces of hexes.
enum Elements<'a> {
    Cells(Cells<'a>),
    Faces(GroupedFaces),
}

impl Elements<'_> {
    fn len(&self) -> usize {
        match self {
            Self::Cells(cells) => cells.len(),
            Self::Faces(faces) => faces.len(),
        }
    }

    fn nodes(&self, k: usize) -> &[NodeId] {
        match self {
            Self::Cells(cells) => cells.nodes(k),
            Self::Faces(faces) => faces.face(k),
        }
    }

    /// Gmsh's type of an element.
    fn kind(&self, k: usize) -> u8 {
        match self.nodes(k).len() {
            3 => 2,
            4 => 3,
            8 if matches!(self, Self::Cells(_)) => 5,
            8 => 16,
            9 => 10,
            20 => 17,
            _ => 12,
        }
    }
}

/// The mesh's cells, and the faces of hexes that are in groups, if there are any.
fn parts<'a>(view: &CellView<'a>) -> Vec<Part<'a>> {
    let dimension = if view.cells.are_hexes() { 3 } else { 2 };
    let mut groups = PhysicalGroups::of(&view.tags.sets);
    if view.groups.is_empty() {
        return vec![Part {
            dimension,
            before: 0,
            cells: Elements::Cells(view.cells),
            tags: view.tags,
            groups,
        }];
    }
    if view.tags.sets.is_empty() {
        groups = PhysicalGroups::of(&[TagSet::default()]);
    }
    let faces = Elements::Faces(view.grouped_faces());
    let tags = view.groups.tags();
    let before = view.cells.len();
    vec![
        Part { dimension, before: 0, cells: Elements::Cells(view.cells), tags: view.tags, groups },
        Part { dimension: 2, before, cells: faces, tags, groups: PhysicalGroups::of(&tags.sets) },
    ]
}

/// The physical groups of each tag set, and the names of those that have one.
struct PhysicalGroups {
    of_set: Vec<Vec<i32>>,
    names: BTreeMap<i32, String>,
}

impl PhysicalGroups {
    /// A group for each label, with the label's number where Gmsh takes it and no other label has it. A name without a number
    /// is the same name with one, if there is that.
    fn of(sets: &[TagSet]) -> Self {
        let labels: Vec<Vec<Label<'_>>> = sets.iter().map(labels_or_untagged).collect();
        let mut number_of: BTreeMap<&Label<'_>, i32> = BTreeMap::new();
        let mut numbered: BTreeMap<&str, i32> = BTreeMap::new();
        let mut taken = BTreeSet::new();
        for label in labels.iter().flatten() {
            let own = label.number.and_then(|number| i32::try_from(number).ok()).filter(|&number| number > 0);
            if let Some(own) = own.filter(|&own| !number_of.contains_key(label) && taken.insert(own)) {
                number_of.insert(label, own);
                numbered.entry(&label.name).or_insert(own);
            }
        }
        let mut free = 1;
        for label in labels.iter().flatten() {
            number_of.entry(label).or_insert_with(|| {
                let same = numbered.get(&*label.name).filter(|_| label.number.is_none());
                same.copied().unwrap_or_else(|| {
                    while !taken.insert(free) {
                        free += 1;
                    }
                    free
                })
            });
        }
        let of_set = labels
            .iter()
            .map(|labels| {
                let mut groups: Vec<i32> = Vec::with_capacity(labels.len());
                for number in labels.iter().map(|label| number_of[label]) {
                    if !groups.contains(&number) {
                        groups.push(number);
                    }
                }
                groups
            })
            .collect();
        let named = number_of.iter().filter(|(label, _)| !label.name.is_empty());
        let names = named.map(|(label, &number)| (number, quotable(&label.name))).collect();
        Self { of_set, names }
    }
}

fn labels_or_untagged(set: &TagSet) -> Vec<Label<'_>> {
    let labels = labels(set);
    if labels.is_empty() { vec![Label { name: UNTAGGED.into(), number: None }] } else { labels }
}

/// The groups whose numbers are others in a file, in words.
pub(in crate::io) fn renumbered(tags: &Tags) -> Vec<String> {
    let groups = PhysicalGroups::of(&tags.sets);
    let mut others = BTreeSet::new();
    for (set, numbers) in tags.sets.iter().zip(&groups.of_set) {
        for label in labels(set) {
            if label.number.is_some_and(|n| !numbers.iter().any(|&m| i64::from(m) == n)) {
                others.insert(label);
            }
        }
    }
    others
        .into_iter()
        .map(|label| match (label.number, label.name.is_empty()) {
            (Some(number), false) => format!("{} ({number})", label.name),
            _ => label.to_string(),
        })
        .collect()
}

/// A name as it can stand between double quotes on a line, with at most the 127 bytes that Gmsh reads.
fn quotable(name: &str) -> String {
    let mut quoted: String = name.replace('"', "'").replace(['\n', '\r'], " ");
    let end = (0..=quoted.len().min(127)).rev().find(|&end| quoted.is_char_boundary(end));
    quoted.truncate(end.unwrap_or(0));
    quoted
}

/// Elements of so many nodes and more are hexes of the second order.
const SECOND_ORDER: usize = 20;

/// Gmsh's order of the nodes of hexes of the second order, as places in VTK's.
const IN_ORDER: [usize; 27] =
    [0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14, 24, 22, 20, 21, 23, 25, 26];

fn write_names(file: &mut Text, parts: &[Part<'_>]) {
    let count: usize = parts.iter().map(|part| part.groups.names.len()).sum();
    if count == 0 {
        return;
    }
    file.word("$PhysicalNames\n").integer(count).word("\n");
    for part in parts {
        for (&number, name) in &part.groups.names {
            file.integer(part.dimension).word(" ").integer(number).word(" \"").word(name).word("\"\n");
        }
    }
    file.word("$EndPhysicalNames\n");
}

/// An entity for each tag set, numbered from 1; one in all for cells without tags. Surfaces come before volumes.
fn write_entities(file: &mut Text, view: &CellView<'_>, parts: &[Part<'_>]) {
    let of = |dimension: u8| parts.iter().find(|part| part.dimension == dimension);
    let count = |part: &Part<'_>| part.groups.of_set.len().max(1);
    let bounds = Aabb::around(&*view.positions);
    let corners =
        if view.positions.is_empty() { [[0.0; 3]; 2] } else { [bounds.min, bounds.max].map(Into::into) };
    file.word("$Entities\n0 0 ").integer(of(2).map_or(0, count));
    file.word(" ").integer(of(3).map_or(0, count)).word("\n");
    for part in [of(2), of(3)].into_iter().flatten() {
        for entity in 0..count(part) {
            file.integer(entity + 1);
            for coordinate in corners.as_flattened() {
                file.word(" ").float(*coordinate);
            }
            let groups = part.groups.of_set.get(entity).map_or(&[][..], Vec::as_slice);
            file.word(" ").integer(groups.len());
            for &group in groups {
                file.word(" ").integer(group);
            }
            file.word(" 0\n");
        }
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

/// Elements in blocks of one entity and one type, each with the number that its place in the mesh gives; faces
/// of hexes are numbered after these.
fn write_elements(file: &mut Text, parts: &[Part<'_>]) {
    let blocks: Vec<_> = parts.iter().map(|part| (part, blocks(part))).collect();
    let count: usize = parts.iter().map(|part| part.cells.len()).sum();
    file.word("$Elements\n").integer(blocks.iter().map(|(_, blocks)| blocks.len()).sum::<usize>());
    file.word(" ").integer(count).word(" 1 ").integer(count).word("\n");
    for (part, blocks) in &blocks {
        for ((set, kind), members) in blocks {
            file.integer(part.dimension).word(" ").integer(set + 1).word(" ").integer(*kind);
            file.word(" ").integer(members.len()).word("\n");
            file.items(members.len(), |line, index| {
                let cell = members[index] as usize;
                line.integer(part.before + cell + 1);
                let nodes = part.cells.nodes(cell);
                for k in 0..nodes.len() {
                    let node = nodes[if nodes.len() < SECOND_ORDER { k } else { IN_ORDER[k] }];
                    line.word(" ").integer(u64::from(node.0) + 1);
                }
                line.word("\n");
            });
        }
    }
    file.word("$EndElements\n");
}

/// The elements of each tag set and type.
fn blocks(part: &Part<'_>) -> BTreeMap<(u32, u8), Vec<u32>> {
    let mut blocks: BTreeMap<(u32, u8), Vec<u32>> = BTreeMap::new();
    for cell in 0..part.cells.len() {
        let set = part.tags.of_element.get(cell).copied().unwrap_or(0);
        blocks.entry((set, part.cells.kind(cell))).or_default().push(cell as u32);
    }
    blocks
}
