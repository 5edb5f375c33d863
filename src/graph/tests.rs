//! Minimum cuts against all cuts of small networks, and against another library's maximum flow on larger ones; cheapest
//! paths against that library's; cheapest assignments against all there are.

use petgraph::algo::{dijkstra, ford_fulkerson};
use petgraph::graph::{DiGraph, NodeIndex};
use proptest::prelude::*;

use super::{Choice, FlowNetwork, ShortestPaths, cheapest_assignment};
use crate::Silent;

/// What a network is made of.
#[derive(Clone, Debug)]
struct Parts {
    /// For each node the capacities from the source and to the sink.
    terminals: Vec<[u64; 2]>,
    edges: Vec<([u32; 2], [u64; 2])>,
}

impl Parts {
    fn network(&self) -> FlowNetwork {
        let mut network = FlowNetwork::new(self.terminals.len());
        for (node, [source, sink]) in (0..).zip(&self.terminals) {
            network.add_terminals(node, *source, *sink);
        }
        for ([tail, head], [there, back]) in &self.edges {
            network.add_edge(*tail, *head, *there, *back);
        }
        network
    }

    /// The capacity of the cut around the nodes of a set.
    fn cut(&self, holds: impl Fn(usize) -> bool) -> u64 {
        let terminals = self.terminals.iter().enumerate();
        let of_terminals: u64 =
            terminals.map(|(n, [source, sink])| if holds(n) { *sink } else { *source }).sum();
        let of_edges = self.edges.iter().map(|([tail, head], [there, back])| {
            match (holds(*tail as usize), holds(*head as usize)) {
                (true, false) => *there,
                (false, true) => *back,
                _ => 0,
            }
        });
        of_terminals + of_edges.sum::<u64>()
    }

    /// The maximum flow, as petgraph finds it.
    fn flow(&self) -> u64 {
        let mut graph = DiGraph::<(), u64>::new();
        let nodes: Vec<_> = self.terminals.iter().map(|_| graph.add_node(())).collect();
        let (source, sink) = (graph.add_node(()), graph.add_node(()));
        for (node, [from_source, to_sink]) in nodes.iter().zip(&self.terminals) {
            graph.add_edge(source, *node, *from_source);
            graph.add_edge(*node, sink, *to_sink);
        }
        for ([tail, head], [there, back]) in &self.edges {
            graph.add_edge(nodes[*tail as usize], nodes[*head as usize], *there);
            graph.add_edge(nodes[*head as usize], nodes[*tail as usize], *back);
        }
        ford_fulkerson(&graph, source, sink).0
    }
}

/// Networks of up to `most` nodes: many capacities are equal, some are zero, some edges double or from a node to
/// itself.
fn parts(most: usize) -> impl Strategy<Value = Parts> {
    let capacity = || prop_oneof![Just(0), 1..4_u64, 0..1000_u64];
    (1..=most).prop_flat_map(move |nodes| {
        let n = nodes as u32;
        let terminals = prop::collection::vec([capacity(), capacity()], nodes);
        let edges = prop::collection::vec(([0..n, 0..n], [capacity(), capacity()]), 0..4 * nodes);
        (terminals, edges).prop_map(|(terminals, edges)| Parts { terminals, edges })
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(1000))]

    /// The cut has the least capacity of all cuts, and no minimum cut lacks one of its nodes.
    #[test]
    fn small_cuts_are_the_least_of_all(parts in parts(8)) {
        let nodes = parts.terminals.len();
        let found = parts.network().minimum_cut(&Silent).unwrap();
        prop_assert_eq!(parts.cut(|n| found.source_side[n]), found.flow);
        for set in 0..1_u32 << nodes {
            let capacity = parts.cut(|n| set >> n & 1 == 1);
            prop_assert!(capacity >= found.flow, "{set:b}");
            let lacks = (0..nodes).any(|n| found.source_side[n] && set >> n & 1 == 0);
            prop_assert!(capacity > found.flow || !lacks, "{set:b}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(100))]

    #[test]
    fn flows_are_those_of_another_library(parts in parts(60)) {
        let found = parts.network().minimum_cut(&Silent).unwrap();
        prop_assert_eq!(found.flow, parts.flow());
        prop_assert_eq!(parts.cut(|n| found.source_side[n]), found.flow);
    }
}

/// A grid of cells with a ball in it, as a core is cut out of a background.
fn ball(n: usize) -> Parts {
    let id = |[x, y, z]: [usize; 3]| ((z * n + y) * n + x) as u32;
    let cells = || (0..n).flat_map(move |z| (0..n).flat_map(move |y| (0..n).map(move |x| [x, y, z])));
    let depth = |c: [usize; 3]| {
        let from_middle = c.map(|x| x as f64 + 0.5 - n as f64 / 2.0);
        let noise = (c[0] * 7 + c[1] * 13 + c[2] * 29) % 11;
        n as f64 / 3.0 - from_middle.iter().map(|x| x * x).sum::<f64>().sqrt() + noise as f64 * 0.1 - 0.5
    };
    let terminals = cells().map(|c| {
        let capacity = (depth(c).abs().min(1.0) * 1000.0) as u64;
        if depth(c) > 0.0 { [capacity, 0] } else { [0, capacity] }
    });
    let edges = cells().flat_map(|c| {
        (0..3).filter(move |&axis| c[axis] + 1 < n).map(move |axis| {
            let mut next = c;
            next[axis] += 1;
            ([id(c), id(next)], [120, 120])
        })
    });
    Parts { terminals: terminals.collect(), edges: edges.collect() }
}

#[test]
fn a_ball_is_cut_out_of_a_grid() {
    let parts = ball(12);
    let found = parts.network().minimum_cut(&Silent).unwrap();
    assert_eq!(found.flow, parts.flow());
    let inside = found.source_side.iter().filter(|&&side| side).count();
    assert!((230..300).contains(&inside), "{inside} cells of a ball of 268");
}

#[test]
fn no_nodes_no_flow() {
    let cut = FlowNetwork::new(0).minimum_cut(&Silent).unwrap();
    assert_eq!((cut.flow, cut.source_side), (0, vec![]));
}

#[test]
fn terminals_add_up() {
    let mut network = FlowNetwork::new(1);
    network.add_terminals(0, 3, 1);
    network.add_terminals(0, 1, 5);
    let cut = network.minimum_cut(&Silent).unwrap();
    assert_eq!((cut.flow, cut.source_side), (4, vec![false]));
}

#[test]
#[should_panic(expected = "add up to less than 2^63")]
fn capacities_that_overflow_are_refused() {
    let mut network = FlowNetwork::new(2);
    network.add_edge(0, 1, u64::MAX / 2, 0);
    network.add_edge(0, 1, 1, 0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Costs are another library's, and each path adds up to its cost. One search leaves nothing to the next.
    #[test]
    fn paths_cost_what_another_library_says(
        arcs in prop::collection::vec((0..30_u32, 0..30_u32, 0..9_u64), 0..120),
        searches in prop::collection::vec((0..30_u32, 0..30_u32), 1..5),
    ) {
        let graph = DiGraph::<(), u64>::from_edges(arcs.iter().copied().chain([(29, 29, 0)]));
        let leaving = |node: u32, out: &mut Vec<(u32, u64)>| {
            out.extend(arcs.iter().filter(|arc| arc.0 == node).map(|arc| (arc.1, arc.2)));
        };
        let mut paths = ShortestPaths::new(30);
        for (start, end) in searches {
            let costs = dijkstra(&graph, start.into(), None, |edge| *edge.weight());
            let found = paths.search(&[(start, 7)], leaving, |node| node == end);
            prop_assert_eq!(found.as_ref().map(|path| path.cost - 7), costs.get(&NodeIndex::from(end)).copied());
            let Some(path) = found else { continue };
            prop_assert_eq!((path.nodes[0], path.nodes[path.nodes.len() - 1]), (start, end));
            let cheapest = |pair: &[u32]| {
                arcs.iter().filter(|arc| (arc.0, arc.1) == (pair[0], pair[1])).map(|arc| arc.2).min().unwrap()
            };
            prop_assert_eq!(path.nodes.windows(2).map(cheapest).sum::<u64>() + 7, path.cost);
        }
    }

    #[test]
    fn assignments_are_the_cheapest_of_all(
        choices in prop::collection::vec(prop::collection::btree_map(0..6_u32, 0..20_u64, 0..5), 0..6),
    ) {
        let choices: Vec<Vec<Choice>> = choices.into_iter().map(|row| row.into_iter().collect()).collect();
        let found = cheapest_assignment(&choices);
        let mut taken: Vec<u32> = found.iter().flatten().copied().collect();
        taken.sort_unstable();
        prop_assert!(taken.windows(2).all(|pair| pair[0] < pair[1]));
        let cost = |(row, column): (&Vec<Choice>, &Option<u32>)| {
            column.map_or((1, 0), |c| (0, row.iter().find(|choice| choice.0 == c).unwrap().1))
        };
        let sum = |a: (usize, u64), b: (usize, u64)| (a.0 + b.0, a.1 + b.1);
        let total = choices.iter().zip(&found).map(cost).fold((0, 0), sum);
        prop_assert_eq!(total, least(&choices, &mut Vec::new()));
    }
}

/// Rows that get nothing, and then cost, of the best of all assignments.
fn least(choices: &[Vec<Choice>], taken: &mut Vec<u32>) -> (usize, u64) {
    let Some((row, others)) = choices.split_first() else { return (0, 0) };
    let (nothing, cost) = least(others, taken);
    let mut best = (nothing + 1, cost);
    for &(column, cost) in row {
        if !taken.contains(&column) {
            taken.push(column);
            let (nothing, others) = least(others, taken);
            taken.pop();
            best = best.min((nothing, others + cost));
        }
    }
    best
}

#[test]
fn paths_start_where_it_costs_least() {
    let line = |node: u32, out: &mut Vec<(u32, u64)>| out.extend([(node + 1, 2)]);
    let path = ShortestPaths::new(9).search(&[(0, 0), (2, 5), (3, 1)], line, |node| node >= 4).unwrap();
    assert_eq!((path.cost, path.nodes), (3, vec![3, 4]));
    assert_eq!(ShortestPaths::new(9).search(&[], line, |_| true), None);
}
