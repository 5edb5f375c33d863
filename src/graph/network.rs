//! A graph with capacities, and its minimum cut.

use super::max_flow::Search;
use crate::{Cancelled, Monitor};

/// A directed graph with capacities whose nodes are also joined to a source and a sink.
///
/// Capacities are whole numbers: the flow is exact, and the cut the same on every machine. The sum of all capacities
/// has to stay below 2^63.
#[derive(Clone, Debug, Default)]
pub struct FlowNetwork {
    /// For each node the capacity from the source less that to the sink.
    excess: Vec<i64>,
    /// What flows from the source straight to the sink, through one node.
    direct: u64,
    /// The ends of each edge, and its capacities there and back.
    edges: Vec<([u32; 2], [u64; 2])>,
    /// The sum of all capacities.
    total: u64,
}

/// A set of nodes with the least capacity of the edges that lead out of it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct MinimumCut {
    /// The capacity that is cut: the maximum flow.
    pub flow: u64,
    /// The nodes on the source's side: of all minimum cuts the one with the fewest.
    pub source_side: Vec<bool>,
}

impl FlowNetwork {
    /// `nodes` nodes without edges.
    ///
    /// # Panics
    /// If there are 2^32 - 2 or more.
    pub fn new(nodes: usize) -> Self {
        assert!(nodes < u32::MAX as usize - 1, "{nodes} nodes have no 32 bit numbers");
        Self { excess: vec![0; nodes], ..Self::default() }
    }

    /// How many nodes there are, source and sink not counted.
    pub fn node_count(&self) -> usize {
        self.excess.len()
    }

    /// Adds capacity from the source to `node` and from `node` to the sink.
    ///
    /// # Panics
    /// If there is no such node, or the capacities add up to 2^63 or more.
    pub fn add_terminals(&mut self, node: u32, from_source: u64, to_sink: u64) {
        self.count(from_source);
        self.count(to_sink);
        let excess = &mut self.excess[node as usize];
        // What is there already may flow straight through with what comes.
        let (mut source, mut sink) = (from_source, to_sink);
        if *excess > 0 {
            source += excess.unsigned_abs();
        } else {
            sink += excess.unsigned_abs();
        }
        self.direct += source.min(sink);
        *excess = source as i64 - sink as i64;
    }

    /// Adds an edge between two nodes with a capacity `there`, from `tail` to `head`, and one `back`.
    ///
    /// # Panics
    /// If there are no such nodes, there are 2^31 edges, or the capacities add up to 2^63 or more.
    pub fn add_edge(&mut self, tail: u32, head: u32, there: u64, back: u64) {
        let nodes = self.excess.len();
        assert!(
            (tail as usize) < nodes && (head as usize) < nodes,
            "an edge {tail}, {head} of {nodes} nodes"
        );
        assert!(self.edges.len() < u32::MAX as usize / 2, "too many edges for 32 bit numbers");
        self.count(there);
        self.count(back);
        if tail != head {
            self.edges.push(([tail, head], [there, back]));
        }
    }

    fn count(&mut self, capacity: u64) {
        let total = self.total.checked_add(capacity).filter(|&total| total < 1 << 63);
        self.total = total.expect("the capacities add up to less than 2^63");
    }

    /// The minimum cut, by the algorithm of Boykov and Kolmogorov.
    ///
    /// ```
    /// use hexmill::{Silent, graph::FlowNetwork};
    /// let mut network = FlowNetwork::new(2);
    /// network.add_terminals(0, 5, 1);
    /// network.add_terminals(1, 0, 4);
    /// network.add_edge(0, 1, 2, 0);
    /// let cut = network.minimum_cut(&Silent).unwrap();
    /// assert_eq!((cut.flow, cut.source_side), (3, vec![true, false]));
    /// ```
    ///
    /// # Errors
    /// [`Cancelled`] when the monitor says so.
    pub fn minimum_cut(self, monitor: &dyn Monitor) -> Result<MinimumCut, Cancelled> {
        let mut search = Search::new(&self.edges, self.excess);
        let flow = search.run(monitor)?;
        Ok(MinimumCut { flow: self.direct + flow, source_side: search.source_side() })
    }
}
