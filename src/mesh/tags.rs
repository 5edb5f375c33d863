//! Names that a file gives to its elements: object, groups, material.

/// What a file says of one set of elements.
#[derive(Clone, Debug, Default, PartialEq, Eq, Hash)]
pub struct TagSet {
    /// OBJ `o`.
    pub object: Option<String>,
    /// OBJ `g` (there may be several), MSH physical groups, INP element sets.
    pub groups: Vec<String>,
    /// OBJ `usemtl`.
    pub material: Option<String>,
    /// MEDIT reference, MSH physical number, VTU `Tag`.
    pub number: Option<i32>,
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
