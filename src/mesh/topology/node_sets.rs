//! Numbers for edges and faces: equal sets of nodes have one number.

use crate::mesh::NodeId;

/// Sets of `N` nodes, numbered in the order in which they were first met.
///
/// Linear time and no hashing: each set hangs in a list at that of its nodes where fewest cells meet (see
/// [`Edges`](super::Edges)).
pub(crate) struct NodeSets<const N: usize> {
    /// Cells at each node.
    degree: Vec<u32>,
    /// The newest set in each node's list.
    head: Vec<u32>,
    /// The set that follows each set in its list.
    next: Vec<u32>,
    nodes: Vec<[NodeId; N]>,
}

/// No set: the end of a list.
const NONE: u32 = u32::MAX;

impl<const N: usize> NodeSets<N> {
    /// No sets yet, of `node_count` nodes with the corners of all cells; about `expected` sets will come.
    pub fn new(node_count: usize, corners: &[NodeId], expected: usize) -> Self {
        let mut degree = vec![0u32; node_count];
        for c in corners {
            degree[c.index()] += 1;
        }
        let expected = expected + expected / 16;
        Self {
            degree,
            head: vec![NONE; node_count],
            next: Vec::with_capacity(expected),
            nodes: Vec::with_capacity(expected),
        }
    }

    /// The number of the set of `nodes`, in whatever order they come.
    pub fn number(&mut self, nodes: [NodeId; N]) -> u32 {
        let mut owner = (u32::MAX, NodeId(u32::MAX));
        for n in nodes {
            owner = owner.min((self.degree[n.index()], n));
        }
        let owner = owner.1.index();
        let mut s = self.head[owner];
        while s != NONE {
            if is_same_set(&self.nodes[s as usize], &nodes) {
                return s;
            }
            s = self.next[s as usize];
        }
        let new = u32::try_from(self.nodes.len()).expect("more than 2^32 edges or faces");
        self.nodes.push(nodes);
        self.next.push(self.head[owner]);
        self.head[owner] = new;
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
