//! Tags as whole numbers and as labels, for the formats that number or name the groups of their cells.

use std::collections::{HashMap, HashSet};

use crate::mesh::{TagSet, Tags};

/// The number of each of `tags.sets`: its own where it has one that no set before it has, else the
/// least positive number that none has. A set that says nothing has the number 0.
pub(super) fn number_sets(tags: &Tags) -> Vec<i32> {
    let mut taken: HashSet<i32> = HashSet::from([0]);
    let own: Vec<Option<i32>> =
        tags.sets.iter().map(|set| set.number.filter(|&number| taken.insert(number))).collect();
    let mut free = 1;
    tags.sets
        .iter()
        .zip(own)
        .map(|(set, own)| {
            if names_nothing(set) {
                return 0;
            }
            own.unwrap_or_else(|| {
                while !taken.insert(free) {
                    free += 1;
                }
                free
            })
        })
        .collect()
}

/// The number of each cell, or nothing if no cell is tagged.
pub(super) fn cell_numbers(tags: &Tags) -> Vec<i32> {
    let numbers = number_sets(tags);
    tags.of_element.iter().map(|&set| numbers[set as usize]).collect()
}

fn names_nothing(set: &TagSet) -> bool {
    has_no_names(set) && set.number.unwrap_or(0) == 0
}

/// True if a set says at most a number.
pub(super) fn has_no_names(set: &TagSet) -> bool {
    set.object.is_none() && set.groups.is_empty() && set.material.is_none()
}

const OBJECT: &str = "object:";
const MATERIAL: &str = "material:";

/// The labels of a set: its groups as they are, its object and material with a prefix that says so.
pub(super) fn labels(set: &TagSet) -> Vec<String> {
    let mut labels = set.groups.clone();
    labels.extend(set.object.iter().map(|name| format!("{OBJECT}{name}")));
    labels.extend(set.material.iter().map(|name| format!("{MATERIAL}{name}")));
    labels
}

/// The set that has these labels.
pub(super) fn set_of_labels<'a>(labels: impl IntoIterator<Item = &'a str>, number: Option<i32>) -> TagSet {
    let mut set = TagSet { number, ..TagSet::default() };
    for label in labels {
        if let Some(name) = label.strip_prefix(OBJECT) {
            set.object = Some(name.to_owned());
        } else if let Some(name) = label.strip_prefix(MATERIAL) {
            set.material = Some(name.to_owned());
        } else {
            set.groups.push(label.to_owned());
        }
    }
    set
}

/// The dimension of the sets of faces of hexes: their numbers are others than those of the hexes.
const FACES: u64 = 2;

/// The sets by their numbers as JSON, for a format that keeps numbers with the cells and has room for
/// text elsewhere. Sets without names are left out. Those of faces of hexes have a dimension.
pub(super) fn names_to_json(cells: &Tags, faces: &Tags) -> Option<Vec<u8>> {
    let numbered = |tags: &Tags, dimension: Option<u64>| {
        let sets: Vec<TagSet> = tags.sets.clone();
        sets.into_iter().zip(number_sets(tags)).map(move |(set, number)| (set, number, dimension))
    };
    let named: Vec<serde_json::Value> = numbered(cells, None)
        .chain(numbered(faces, Some(FACES)))
        .filter(|(set, ..)| !has_no_names(set))
        .map(|(set, number, dimension)| {
            let mut entry = serde_json::Map::new();
            entry.insert("number".into(), number.into());
            if let Some(dimension) = dimension {
                entry.insert("dimension".into(), dimension.into());
            }
            if let Some(object) = &set.object {
                entry.insert("object".into(), object.as_str().into());
            }
            if !set.groups.is_empty() {
                entry.insert("groups".into(), set.groups.clone().into());
            }
            if let Some(material) = &set.material {
                entry.insert("material".into(), material.as_str().into());
            }
            entry.into()
        })
        .collect();
    (!named.is_empty()).then(|| serde_json::Value::from(named).to_string().into_bytes())
}

/// The tag sets that numbers stand for.
#[derive(Default)]
pub(super) struct Names {
    of_cells: HashMap<i64, TagSet>,
    of_faces: HashMap<i64, TagSet>,
}

impl Names {
    /// The set that a number stands for, of a face of hexes or of another cell.
    pub fn get(&self, number: i64, of_face: bool) -> Option<&TagSet> {
        if of_face { &self.of_faces } else { &self.of_cells }.get(&number)
    }
}

/// The sets by their numbers from [`names_to_json`]; nothing if the text is not of that form.
pub(super) fn names_from_json(json: &[u8]) -> Names {
    let mut names = Names::default();
    let Ok(serde_json::Value::Array(entries)) = serde_json::from_slice(json) else { return names };
    let text = |value: &serde_json::Value| value.as_str().map(str::to_owned);
    for entry in &entries {
        let number = entry["number"].as_i64().and_then(|number| i32::try_from(number).ok());
        let Some(number) = number else { continue };
        let set = TagSet {
            object: text(&entry["object"]),
            groups: entry["groups"].as_array().into_iter().flatten().filter_map(text).collect(),
            material: text(&entry["material"]),
            number: Some(number),
        };
        let of_face = entry["dimension"].as_u64() == Some(FACES);
        let of_kind = if of_face { &mut names.of_faces } else { &mut names.of_cells };
        of_kind.insert(number.into(), set);
    }
    names
}
