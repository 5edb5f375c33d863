//! Numbers for edges and faces: equal sets of nodes have one number.

use std::ops::Range;

use crate::mesh::NodeId;

/// Sets of `N` nodes, numbered in the order in which they were first met.
///
/// Linear time and no hashing: each set hangs in a list at that of its nodes where fewest cells meet (see
/// [`Edges`](super::Edges)), its owner.
pub(crate) struct NodeSets<'a, const N: usize> {
    /// Cells at each node.
    degrees: &'a [u32],
    /// The nodes whose sets these are.
    owners: Range<usize>,
    /// The newest set in each owner's list.
    head: Vec<u32>,
    /// The set that follows each set in its list.
    next: Vec<u32>,
    nodes: Vec<[NodeId; N]>,
}

/// How many cells there are at each node, from the corners of all cells.
pub(crate) fn degrees(node_count: usize, corners: &[NodeId]) -> Vec<u32> {
    let mut degrees = vec![0u32; node_count];
    for c in corners {
        degrees[c.index()] += 1;
    }
    degrees
}

/// No set: the end of a list.
const NONE: u32 = u32::MAX;

impl<'a, const N: usize> NodeSets<'a, N> {
    /// No sets yet, of nodes with so many cells; about `expected` sets will come.
    pub fn new(degrees: &'a [u32], expected: usize) -> Self {
        Self::of_owners(degrees, 0..degrees.len(), expected)
    }

    /// The same for those sets that some of the nodes own.
    pub fn of_owners(degrees: &'a [u32], owners: Range<usize>, expected: usize) -> Self {
        let expected = expected + expected / 16;
        Self {
            degrees,
            head: vec![NONE; owners.len()],
            owners,
            next: Vec::with_capacity(expected),
            nodes: Vec::with_capacity(expected),
        }
    }

    /// The number of the set of `nodes`, in whatever order they come.
    ///
    /// # Panics
    /// If it is another's.
    pub fn number(&mut self, nodes: [NodeId; N]) -> u32 {
        let owner = self.owner(nodes);
        self.number_of(owner, nodes)
    }

    /// The same, if it is one of these.
    pub fn number_if_owned(&mut self, nodes: [NodeId; N]) -> Option<u32> {
        let owner = self.owner(nodes);
        self.owners.contains(&owner).then(|| self.number_of(owner, nodes))
    }

    fn owner(&self, nodes: [NodeId; N]) -> usize {
        let mut owner = (u32::MAX, NodeId(u32::MAX));
        for n in nodes {
            owner = owner.min((self.degrees[n.index()], n));
        }
        owner.1.index()
    }

    fn number_of(&mut self, owner: usize, nodes: [NodeId; N]) -> u32 {
        let head = &mut self.head[owner - self.owners.start];
        let mut s = *head;
        while s != NONE {
            if is_same_set(&self.nodes[s as usize], &nodes) {
                return s;
            }
            s = self.next[s as usize];
        }
        let new = u32::try_from(self.nodes.len()).expect("more than 2^32 edges or faces");
        self.nodes.push(nodes);
        self.next.push(*head);
        *head = new;
        new
    }

    /// The nodes of each set, as they first came.
    pub fn into_nodes(self) -> Vec<[NodeId; N]> {
        self.nodes
    }
}

fn is_same_set<const N: usize>(a: &[NodeId; N], b: &[NodeId; N]) -> bool {
    a.iter().all(|n| b.contains(n)) && b.iter().all(|n| a.contains(n))
}
