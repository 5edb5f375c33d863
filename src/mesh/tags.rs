//! Names that a file gives to its elements: object, groups, material.

/// A group of elements, by its name, its number or both.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct Group {
    /// Its name; empty if it is known by its number alone.
    pub name: String,
    /// The number that the file gives to the name, as an MSH file does: `None` where it gives none.
    pub number: Option<i64>,
}

impl Group {
    /// A group with a name and a number.
    pub fn new(name: impl Into<String>, number: i64) -> Self {
        Self { name: name.into(), number: Some(number) }
    }
}

impl From<String> for Group {
    fn from(name: String) -> Self {
        Self { name, number: None }
    }
}

impl From<&str> for Group {
    fn from(name: &str) -> Self {
        name.to_owned().into()
    }
}

/// The group in words: its name, or else its number.
impl std::fmt::Display for Group {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.number.filter(|_| self.name.is_empty()) {
            Some(number) => write!(f, "{number}"),
            None => f.write_str(&self.name),
        }
    }
}

/// What a file says of one set of elements.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct TagSet {
    /// OBJ `o`.
    pub object: Option<String>,
    /// OBJ `g` (there may be several), MSH physical groups, INP element sets.
    pub groups: Vec<Group>,
    /// OBJ `usemtl`.
    pub material: Option<String>,
    /// The one number of an element where a format has one: MEDIT reference, VTU `Tag`; of MSH the number of the first
    /// physical group. If none of `groups` has it, it is that of one more group, which has no name.
    pub number: Option<i64>,
}

/// What is before the names of objects and of materials where they stand among those of groups.
pub(crate) const OBJECT: &str = "object:";
pub(crate) const MATERIAL: &str = "material:";

impl TagSet {
    /// Its groups in words, its object behind `object:`, its material behind `material:`; the number of a set that has none of
    /// these.
    pub fn names(&self) -> Vec<String> {
        let mut names: Vec<String> =
            self.groups.iter().map(Group::to_string).chain(self.prefixed()).collect();
        if let (true, Some(number @ (..=-1 | 1..))) = (names.is_empty(), self.number) {
            names.push(number.to_string());
        }
        names
    }

    /// Its object and its material, each behind what says so.
    pub(crate) fn prefixed(&self) -> impl Iterator<Item = String> {
        let names = [(OBJECT, &self.object), (MATERIAL, &self.material)];
        names.into_iter().filter_map(|(prefix, name)| Some([prefix, name.as_ref()?].concat()))
    }
}

/// The tag set of each element. `of_element` is empty when no element is tagged; else it has one
/// entry an element, an index into `sets`.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Tags {
    /// The distinct sets, in order of first use.
    pub sets: Vec<TagSet>,
    /// For each element the index of its set.
    pub of_element: Vec<u32>,
}

impl Tags {
    /// The set of element `index`, if any element is tagged.
    pub fn of(&self, index: usize) -> Option<&TagSet> {
        self.of_element.get(index).map(|&s| &self.sets[s as usize])
    }

    /// The tags of elements made from others: child `i` has the tags of element `parent[i]`.
    pub fn inherited(&self, parent: &[u32]) -> Self {
        if self.of_element.is_empty() {
            return Self::default();
        }
        Self {
            sets: self.sets.clone(),
            of_element: parent.iter().map(|&p| self.of_element[p as usize]).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_set_is_known_by_its_names_or_else_by_its_number() {
        let set = |groups: Vec<Group>, object: Option<&str>, material: Option<&str>, number: Option<i64>| {
            let [object, material] = [object, material].map(|name| name.map(str::to_owned));
            TagSet { object, groups, material, number }.names()
        };
        let groups = vec!["inlet".into(), Group::new("", 7), Group::new("wall", 3)];
        let named = set(groups, Some("part"), Some("steel"), Some(3));
        assert_eq!(named, ["inlet", "7", "wall", "object:part", "material:steel"]);
        assert_eq!(set(vec![], None, None, Some(-4)), ["-4"]);
        assert_eq!(set(vec![], None, None, Some(0)), Vec::<String>::new());
        assert_eq!(set(vec![], None, None, None), Vec::<String>::new());
    }
}
