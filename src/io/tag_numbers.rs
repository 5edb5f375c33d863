//! Tags as whole numbers and as labels, for the formats that number or name the groups of their cells.

use std::borrow::Cow;
use std::collections::{HashMap, HashSet};

use crate::mesh::{Group, MATERIAL, OBJECT, TagSet, Tags};

/// The number of each of `tags.sets`, for a format that has one a cell: that of the set or of one of its groups which no set
/// before it has, sets that have a number alone or with one name first; else the least positive number that none has. A
/// set that says nothing has the number 0.
pub(super) fn number_sets(tags: &Tags) -> Vec<i64> {
    let mut taken: HashSet<i64> = HashSet::from([0]);
    let labels: Vec<Vec<Label<'_>>> = tags.sets.iter().map(labels).collect();
    let mut numbers: Vec<Option<i64>> = tags
        .sets
        .iter()
        .zip(&labels)
        .map(|(set, labels)| set.number.filter(|&number| labels.len() < 2 && taken.insert(number)))
        .collect();
    for ((number, set), labels) in numbers.iter_mut().zip(&tags.sets).zip(&labels) {
        let own = set.number.into_iter().chain(labels.iter().filter_map(|label| label.number));
        *number = number.or_else(|| own.into_iter().find(|&number| taken.insert(number)));
    }
    let mut free = 1;
    numbers
        .into_iter()
        .zip(&labels)
        .map(|(number, labels)| {
            if labels.is_empty() {
                return 0;
            }
            number.unwrap_or_else(|| {
                while !taken.insert(free) {
                    free += 1;
                }
                free
            })
        })
        .collect()
}

/// The number of each cell, or nothing if no cell is tagged.
pub(super) fn cell_numbers(tags: &Tags) -> Vec<i64> {
    let numbers = number_sets(tags);
    tags.of_element.iter().map(|&set| numbers[set as usize]).collect()
}

/// True if a set says at most a number.
pub(super) fn has_no_names(set: &TagSet) -> bool {
    set.object.is_none() && set.groups.is_empty() && set.material.is_none()
}

/// One of the ways in which a set names or numbers its cells.
#[derive(Clone, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Label<'a> {
    /// Its name, empty if there is none; objects and materials with a prefix that says so.
    pub name: Cow<'a, str>,
    /// The number that goes with it.
    pub number: Option<i64>,
}

impl std::fmt::Display for Label<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.number.filter(|_| self.name.is_empty()) {
            Some(number) => write!(f, "{number}"),
            None => f.write_str(&self.name),
        }
    }
}

/// The labels of a set. Its number is that of its one name or of one of its groups; else of a label without a name.
pub(super) fn labels(set: &TagSet) -> Vec<Label<'_>> {
    let mut labels: Vec<Label<'_>> = Vec::new();
    labels.extend(set.groups.iter().map(|group| Label { name: (&*group.name).into(), number: group.number }));
    labels.extend(set.prefixed().map(|name| Label { name: name.into(), number: None }));
    let own = set.number.filter(|&number| number != 0 && labels.iter().all(|l| l.number != Some(number)));
    match labels.as_mut_slice() {
        [Label { name, number: number @ None }] if !name.is_empty() => *number = own,
        _ => labels
            .splice(..0, own.map(|number| Label { name: "".into(), number: Some(number) }))
            .for_each(drop),
    }
    labels
}

/// The set of these groups, each with a name, a number or both. Names with a prefix are those of objects and materials. The
/// number of the first is that of the set.
pub(super) fn set_of_labels(labels: impl IntoIterator<Item = Group>) -> TagSet {
    let mut set = TagSet::default();
    for (k, label) in labels.into_iter().enumerate() {
        if k == 0 {
            set.number = label.number;
        }
        if let Some(name) = label.name.strip_prefix(OBJECT) {
            set.object = Some(name.to_owned());
        } else if let Some(name) = label.name.strip_prefix(MATERIAL) {
            set.material = Some(name.to_owned());
        } else if k > 0 || !label.name.is_empty() {
            set.groups.push(label);
        }
    }
    set
}

/// The dimension of the sets of faces of hexes: their numbers are others than those of the hexes.
const FACES: u64 = 2;

/// The sets by their numbers as JSON, for a format that keeps numbers with the cells and has room for
/// text elsewhere. Sets without names are left out. Those of faces of hexes have a dimension. Where the number of a set is
/// not the one that it has in the file, `own` tells it.
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
            if set.number != Some(number) && labels(&set).len() > 1 {
                entry.insert("own".into(), set.number.into());
            }
            if !set.groups.is_empty() {
                let names: Vec<&str> = set.groups.iter().map(|group| &*group.name).collect();
                entry.insert("groups".into(), names.into());
            }
            if set.groups.iter().any(|group| group.number.is_some()) {
                let numbers: Vec<Option<i64>> = set.groups.iter().map(|group| group.number).collect();
                entry.insert("groupNumbers".into(), numbers.into());
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
        let Some(number) = entry["number"].as_i64() else { continue };
        let own = entry.get("own").map_or(Some(number), serde_json::Value::as_i64);
        let groups = entry["groups"].as_array().into_iter().flatten().enumerate().filter_map(|(k, name)| {
            Some(Group { name: text(name)?, number: entry["groupNumbers"][k].as_i64() })
        });
        let set = TagSet {
            object: text(&entry["object"]),
            groups: groups.collect(),
            material: text(&entry["material"]),
            number: own,
        };
        let of_face = entry["dimension"].as_u64() == Some(FACES);
        let of_kind = if of_face { &mut names.of_faces } else { &mut names.of_cells };
        of_kind.insert(number, set);
    }
    names
}
