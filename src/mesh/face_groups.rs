//! Groups of faces of a hex mesh: where loads, supports, inlets are on its boundary, and cracks, baffles, contacts within.

use super::Tags;
use super::topology::Side;

/// Faces of a hex mesh with the tags that a file gave to them. A face is known by its hex and its number there, so that
/// groups take no memory for faces that are in none. One between two hexes is known by one of them, from which it looks
/// to the other.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct FaceGroups {
    sides: Vec<Side>,
    tags: Tags,
}

impl FaceGroups {
    /// Groups of the given sides, ascending, each with an entry in `tags`; `None` if they are not ascending, or
    /// the tags are not theirs. That each is a side of a hex, and no face is there from both its hexes, is for `check_hexes`
    /// to tell.
    ///
    /// ```
    /// use hexmill::mesh::{FaceGroups, TagSet, Tags};
    /// let inlet = TagSet { groups: vec!["inlet".into()], ..TagSet::default() };
    /// let tags = Tags { sets: vec![inlet], of_element: vec![0, 0] };
    /// // The faces z = 0 and x = 1 of hex 2.
    /// let groups = FaceGroups::new(vec![12, 15], tags.clone()).unwrap();
    /// assert_eq!(groups.sides(), [12, 15]);
    /// assert!(FaceGroups::new(vec![15, 12], tags).is_none());
    /// ```
    pub fn new(sides: Vec<Side>, tags: Tags) -> Option<Self> {
        let fits = tags.of_element.len() == sides.len()
            && tags.of_element.iter().all(|&set| (set as usize) < tags.sets.len());
        (fits && sides.is_sorted_by(|a, b| a < b)).then_some(Self { sides, tags })
    }

    /// The faces that are in groups, ascending: face `k` of hex `h`, in the order of `numbering::hex::FACES`, as
    /// `6 * h + k`.
    pub fn sides(&self) -> &[Side] {
        &self.sides
    }

    /// The tags of the sides.
    pub fn tags(&self) -> &Tags {
        &self.tags
    }

    /// True if no face is in a group.
    pub fn is_empty(&self) -> bool {
        self.sides.is_empty()
    }

    /// Each side with the number of its tag set.
    pub fn labels(&self) -> impl Iterator<Item = (Side, u32)> + '_ {
        self.sides.iter().copied().zip(self.tags.of_element.iter().copied())
    }

    /// The same groups on other sides, given ascending, each with the number of its tag set.
    pub(crate) fn on(&self, labels: impl IntoIterator<Item = (Side, u32)>) -> Self {
        let (sides, of_element): (Vec<Side>, Vec<u32>) = labels.into_iter().unzip();
        debug_assert!(sides.is_sorted_by(|a, b| a < b), "sides are told once, in their order");
        let sets = if sides.is_empty() { Vec::new() } else { self.tags.sets.clone() };
        Self { sides, tags: Tags { sets, of_element } }
    }

    /// Renumbers the faces of each hex.
    pub(crate) fn renumber(&mut self, side: impl Fn(Side) -> Side) {
        let mut labels: Vec<(Side, u32)> = self.labels().map(|(s, label)| (side(s), label)).collect();
        labels.sort_unstable();
        *self = self.on(labels);
    }
}
