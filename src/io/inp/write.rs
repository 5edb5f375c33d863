//! Writes Abaqus input decks.

use std::collections::{BTreeMap, HashMap, HashSet};

use super::{MATERIAL, NUMBER, OBJECT};
use crate::io::cell_view::CellView;
use crate::io::tag_numbers;
use crate::io::text::Text;
use crate::io::{Document, Format, WriteError};
use crate::mesh::{self, TagSet, Tags};

/// Characters of a number that Abaqus and CalculiX read.
const NUMBER_WIDTH: usize = 20;

/// Characters of a name that Abaqus reads.
const NAME_WIDTH: usize = 80;

/// Numbers on a line of an element or an element set.
const PER_LINE: usize = 16;

/// The order of the nodes of C3D27, as places in VTK's: the one inside stands before those on faces.
const IN_ORDER: [usize; 27] =
    [0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16, 17, 18, 19, 26, 24, 25, 22, 21, 23, 20];

/// The file as bytes: the same for any number of threads.
pub fn write(document: &Document) -> Result<Vec<u8>, WriteError> {
    let view = CellView::new(document, Format::Inp)?;
    view.refuse_polygons(Format::Inp)?;
    let mut file = Text::default();
    file.word("*HEADING\nhexmill\n*NODE\n");
    file.items(view.positions.len(), |line, node| {
        line.integer(node + 1);
        for coordinate in view.positions[node].to_array() {
            line.word(", ");
            short_float(line, coordinate);
        }
        line.word("\n");
    });
    let kinds: &[(usize, &str)] = if view.cells.are_hexes() {
        &[(8, "C3D8"), (20, "C3D20"), (27, "C3D27")]
    } else {
        &[(4, "S4"), (3, "S3")]
    };
    for &(size, kind) in kinds {
        write_elements(&mut file, &view, size, kind);
    }
    write_surfaces(&mut file, &view);
    for (name, members) in members_of_labels(view.tags) {
        file.word("*ELSET, ELSET=").word(&name).word("\n");
        file.items(members.len().div_ceil(PER_LINE), |line, row| {
            let members = &members[row * PER_LINE..members.len().min((row + 1) * PER_LINE)];
            for (column, &element) in members.iter().enumerate() {
                line.word(if column == 0 { "" } else { ", " }).integer(u64::from(element) + 1);
            }
            line.word("\n");
        });
    }
    Ok(file.into_bytes())
}

/// The elements of `size` nodes, each with the number that its place in the mesh gives.
fn write_elements(file: &mut Text, view: &CellView<'_>, size: usize, kind: &str) {
    let cells = view.cells;
    let members: Vec<usize> = (0..cells.len()).filter(|&cell| cells.nodes(cell).len() == size).collect();
    if members.is_empty() {
        return;
    }
    file.word("*ELEMENT, TYPE=").word(kind).word("\n");
    file.items(members.len(), |line, index| {
        line.integer(members[index] + 1);
        let nodes = cells.nodes(members[index]);
        for k in 0..nodes.len() {
            // A line that ends with a comma goes on.
            line.word(if k > 0 && (k + 1) % PER_LINE == 0 { ",\n" } else { ", " });
            let node = nodes[if nodes.len() < IN_ORDER.len() { k } else { IN_ORDER[k] }];
            line.integer(u64::from(node.0) + 1);
        }
        line.word("\n");
    });
}

/// Adds the number in at most [`NUMBER_WIDTH`] characters, with as many digits as these hold.
fn short_float(line: &mut Text, value: f64) {
    let mut shortest = zmij::Buffer::new();
    let shortest = shortest.format_finite(value);
    if shortest.len() <= NUMBER_WIDTH {
        line.word(shortest);
        return;
    }
    let digits = (0..=15).rev().map(|digits| format!("{value:.digits$e}"));
    line.word(&digits.into_iter().find(|text| text.len() <= NUMBER_WIDTH).unwrap_or_default());
}

/// The faces of hexes that are in groups, as surfaces.
fn write_surfaces(file: &mut Text, view: &CellView<'_>) {
    let sides = view.groups.sides();
    for (name, members) in members_of_labels(view.groups.tags()) {
        file.word("*SURFACE, TYPE=ELEMENT, NAME=").word(&name).word("\n");
        file.items(members.len(), |line, index| {
            let side = sides[members[index] as usize];
            line.integer(side / 6 + 1).word(", S").integer(side % 6 + 1).word("\n");
        });
    }
}

/// The elements of each label, in order of first use by an element: a number without a name comes before all names of the
/// same elements, whose own it would be if it came after one.
fn members_of_labels(tags: &Tags) -> Vec<(String, Vec<u32>)> {
    let mut names = Names::default();
    let mut of_set: Vec<Option<Vec<usize>>> = vec![None; tags.sets.len()];
    let mut members: BTreeMap<usize, Vec<u32>> = BTreeMap::new();
    for (element, &set) in (0..).zip(&tags.of_element) {
        let of_set = of_set[set as usize].get_or_insert_with(|| {
            labels(&tags.sets[set as usize]).into_iter().map(|label| names.index(label)).collect()
        });
        for &label in &*of_set {
            members.entry(label).or_default().push(element);
        }
    }
    members.into_iter().map(|(label, members)| (names.names[label].clone(), members)).collect()
}

/// The labels of a set. The number of a group comes after its name, and those without a name come first.
fn labels(set: &TagSet) -> Vec<String> {
    let (nameless, named): (Vec<_>, Vec<_>) =
        tag_numbers::labels(set).into_iter().partition(|l| l.name.is_empty());
    let names = |name: &str| {
        let prefixed = |ours: &str, prefix: &str| Some(format!("{ours}{}", name.strip_prefix(prefix)?));
        let object = prefixed(OBJECT, mesh::OBJECT);
        object.or_else(|| prefixed(MATERIAL, mesh::MATERIAL)).unwrap_or_else(|| name.to_owned())
    };
    nameless
        .iter()
        .chain(&named)
        .flat_map(|label| {
            let name = (!label.name.is_empty()).then(|| names(&label.name));
            let number = label.number.filter(|&number| number != 0);
            name.into_iter().chain(number.map(|number| format!("{NUMBER}{number}")))
        })
        .collect()
}

/// Names that Abaqus takes, one for each label. It does not tell `Wing` from `WING`, so the second gets
/// a number.
#[derive(Default)]
struct Names {
    index_of: HashMap<String, usize>,
    names: Vec<String>,
    taken: HashSet<String>,
}

impl Names {
    fn index(&mut self, label: String) -> usize {
        if let Some(&index) = self.index_of.get(&label) {
            return index;
        }
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        let mut name: String = label.chars().map(|c| if plain(c) { c } else { '_' }).collect();
        if !name.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
            name.insert(0, '_');
        }
        name.truncate(NAME_WIDTH);
        let mut distinct = name.clone();
        let mut copy = 2;
        while !self.taken.insert(distinct.to_ascii_uppercase()) {
            let end = format!("_{copy}");
            distinct = format!("{}{end}", &name[..name.len().min(NAME_WIDTH - end.len())]);
            copy += 1;
        }
        self.names.push(distinct);
        self.index_of.insert(label, self.names.len() - 1);
        self.names.len() - 1
    }
}
