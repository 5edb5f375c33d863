//! Disjoint sets whose members know on which of two sides of their set they stand.

/// Union-find with a parity to the root. Roots are the least members, so what is read from the sets
/// depends on the relations alone, never on the order in which they came.
#[derive(Clone, Debug, Default)]
pub(crate) struct Sets {
    parent: Vec<u32>,
    /// Whether each member stands on the other side than its parent.
    odd: Vec<bool>,
}

impl Sets {
    /// `n` sets of one member each.
    pub(crate) fn new(n: usize) -> Self {
        let mut sets = Self::default();
        sets.reset(n);
        sets
    }

    /// Starts again with `n` sets of one member each.
    pub(crate) fn reset(&mut self, n: usize) {
        self.parent.clear();
        self.parent.extend(0..u32::try_from(n).expect("more than 2^32 members"));
        self.odd.clear();
        self.odd.resize(n, false);
    }

    /// The least member of `i`'s set, and whether `i` stands on the other side than it.
    pub(crate) fn root(&mut self, i: u32) -> (u32, bool) {
        let (mut at, mut odd) = (i as usize, false);
        loop {
            let up = self.parent[at] as usize;
            if up == at {
                return (at as u32, odd);
            }
            // Path halving: hang `at` on its grandparent (a root is its own parent, on its own side).
            self.odd[at] ^= self.odd[up];
            self.parent[at] = self.parent[up];
            odd ^= self.odd[at];
            at = self.parent[at] as usize;
        }
    }

    /// Puts `a` and `b` into one set, on opposite sides if `odd`. False if they are in one set
    /// already, on sides that contradict this.
    pub(crate) fn join(&mut self, a: u32, b: u32, odd: bool) -> bool {
        let ((ra, oa), (rb, ob)) = (self.root(a), self.root(b));
        let odd = odd ^ oa ^ ob;
        if ra == rb {
            return !odd;
        }
        let (low, high) = (ra.min(rb), ra.max(rb));
        self.parent[high as usize] = low;
        self.odd[high as usize] = odd;
        true
    }

    /// The number of each member's set; sets are numbered in the order of their least members.
    pub(crate) fn numbers(&mut self) -> Vec<u32> {
        let roots: Vec<u32> = self.roots().collect();
        let place = |root: u32| roots.partition_point(|&r| r < root) as u32;
        (0..self.parent.len() as u32).map(|m| place(self.root(m).0)).collect()
    }

    /// The least members of all sets, ascending.
    pub(crate) fn roots(&self) -> impl Iterator<Item = u32> {
        self.parent.iter().zip(0u32..).filter(|&(&p, i)| p == i).map(|(_, i)| i)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keeps_sides_through_chains_of_joins() {
        let mut sets = Sets::new(10);
        for i in (1..10).rev() {
            assert!(sets.join(i - 1, i, true));
        }
        for i in 0..10 {
            assert_eq!(sets.root(i), (0, i % 2 == 1));
        }
        assert!(sets.join(0, 9, true), "an odd chain agrees");
        assert!(!sets.join(0, 8, true), "an even chain contradicts");
        assert_eq!(sets.roots().collect::<Vec<_>>(), [0]);
    }
}
