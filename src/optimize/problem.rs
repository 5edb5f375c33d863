//! The part of a mesh that moves, numbered for itself: the nodes that move, the cells around them, and who may move
//! at the same time.

use crate::geometry::Point;
use crate::mesh::numbering::hex::EDGES;
use crate::mesh::quality::{Certainty, is_positive, scaled_jacobian};
use crate::mesh::{HexId, NodeId};
use crate::parallel;

/// No node of the problem.
const NONE: u32 = u32::MAX;

/// The cells around the movable nodes. Nodes of the problem are numbered in the mesh's order, movable ones first.
pub(crate) struct Problem {
    /// The mesh's node of each node, and where the node is, and was at first.
    pub(crate) nodes: Vec<NodeId>,
    pub(crate) points: Vec<Point>,
    pub(crate) anchors: Vec<Point>,
    /// The nodes of each cell, and the mesh's hex.
    pub(crate) cells: Vec<[u32; 8]>,
    hexes: Vec<HexId>,
    /// The cube of each cell's mean edge at first: what its determinants are measured against.
    pub(crate) volume: Vec<f64>,
    /// The cells that are positive in all of their inside.
    pub(crate) positive: Vec<bool>,
    /// The cells whose inside is looked at whenever one of their nodes moves.
    pub(crate) guarded: Vec<bool>,
    /// Where the cells of each movable node start in `around`: a cell, and which of its corners the node is.
    starts: Vec<u32>,
    around: Vec<(u32, u8)>,
    /// Movable nodes by colour, ascending: two of one colour share no cell. Sweeps follow this order.
    pub(crate) colours: Vec<Vec<u32>>,
}

impl Problem {
    /// The cells around the nodes that move.
    pub(crate) fn new(
        positions: &[Point],
        hexes: &[[NodeId; 8]],
        moves: impl Fn(NodeId) -> bool + Sync,
    ) -> Self {
        let touched = parallel::filter(hexes.len(), |h| hexes[h].iter().any(|&n| moves(n)));
        let mut used = vec![false; positions.len()];
        for &h in &touched {
            for n in hexes[h as usize] {
                used[n.index()] = true;
            }
        }
        let of_kind = |wanted: bool| {
            let (used, moves) = (&used, &moves);
            (0..positions.len()).map(NodeId::new).filter(move |&n| used[n.index()] && moves(n) == wanted)
        };
        let mut nodes: Vec<NodeId> = of_kind(true).collect();
        let movable_count = nodes.len();
        nodes.extend(of_kind(false));
        let mut local = vec![NONE; positions.len()];
        for (i, n) in (0u32..).zip(&nodes) {
            local[n.index()] = i;
        }
        let cells: Vec<[u32; 8]> =
            touched.iter().map(|&h| hexes[h as usize].map(|n| local[n.index()])).collect();
        let points: Vec<Point> = nodes.iter().map(|n| positions[n.index()]).collect();
        let (starts, around) = stars(&cells, movable_count);
        let mut problem = Self {
            anchors: points.clone(),
            hexes: touched.into_iter().map(HexId).collect(),
            volume: parallel::collect(cells.len(), |c| cell_size(&cells[c].map(|n| points[n as usize]))),
            positive: Vec::new(),
            guarded: vec![false; cells.len()],
            colours: Vec::new(),
            nodes,
            points,
            cells,
            starts,
            around,
        };
        problem.colours = problem.colour();
        problem.find_positive();
        problem
    }

    /// How many nodes may move: they are numbered first.
    pub(crate) fn movable(&self) -> usize {
        self.starts.len() - 1
    }

    /// The cells around a movable node, each with the node's corner.
    pub(crate) fn star(&self, node: u32) -> &[(u32, u8)] {
        &self.around[self.starts[node as usize] as usize..self.starts[node as usize + 1] as usize]
    }

    /// Where a movable node of the mesh is.
    ///
    /// # Panics
    /// If it is no movable node of a cell.
    pub(crate) fn place(&self, node: NodeId) -> Point {
        let local = self.nodes[..self.movable()].binary_search(&node).expect("a movable node");
        self.points[local]
    }

    /// Where the corners of a cell are.
    pub(crate) fn corners(&self, cell: usize) -> [Point; 8] {
        self.cells[cell].map(|n| self.points[n as usize])
    }

    /// Asks every cell again whether it is positive.
    pub(crate) fn find_positive(&mut self) {
        self.positive = parallel::collect(self.cells.len(), |cell| self.is_positive(cell));
    }

    /// Is the cell positive in all of its inside, where its nodes are now?
    pub(crate) fn is_positive(&self, cell: usize) -> bool {
        is_positive(&self.corners(cell)) == Certainty::Positive
    }

    /// The scaled Jacobian of each cell.
    pub(crate) fn scaled_jacobians(&self) -> Vec<f64> {
        parallel::collect(self.cells.len(), |cell| scaled_jacobian(&self.corners(cell)))
    }

    /// The cells around the nodes, each once, ascending.
    pub(crate) fn cells_around(&self, nodes: &[u32]) -> Vec<u32> {
        let mut is_near = vec![false; self.cells.len()];
        for &node in nodes {
            self.star(node).iter().for_each(|&(cell, _)| is_near[cell as usize] = true);
        }
        (0..self.cells.len() as u32).filter(|&cell| is_near[cell as usize]).collect()
    }

    /// How the cells are now.
    pub(crate) fn state(&mut self) -> State {
        self.find_positive();
        State { jacobians: self.scaled_jacobians(), positive: self.positive.clone() }
    }

    /// Has the nodes of lower rank swept first: colours are split by ranks, which are below `ranks`.
    pub(crate) fn order_by(&mut self, ranks: usize, rank: impl Fn(NodeId) -> usize) {
        let colours = std::mem::take(&mut self.colours);
        for wanted in 0..ranks {
            let of_rank = |colour: &Vec<u32>| -> Vec<u32> {
                colour.iter().copied().filter(|&n| rank(self.nodes[n as usize]) == wanted).collect()
            };
            self.colours.extend(colours.iter().map(of_rank).filter(|colour| !colour.is_empty()));
        }
    }

    /// Greedy colours in the order of nodes.
    fn colour(&self) -> Vec<Vec<u32>> {
        let mut colour_of = vec![NONE; self.movable()];
        let mut colours: Vec<Vec<u32>> = Vec::new();
        let mut taken_by: Vec<u32> = Vec::new();
        for node in 0..self.movable() as u32 {
            for &(cell, _) in self.star(node) {
                for other in self.cells[cell as usize] {
                    if let Some(&colour) = colour_of.get(other as usize)
                        && colour != NONE
                    {
                        taken_by[colour as usize] = node;
                    }
                }
            }
            let colour = taken_by.iter().position(|&by| by != node).unwrap_or(colours.len());
            if colour == colours.len() {
                colours.push(Vec::new());
                taken_by.push(NONE);
            }
            colour_of[node as usize] = colour as u32;
            colours[colour].push(node);
        }
        colours
    }

    /// Copies the nodes back into the mesh; how many stand elsewhere than before.
    pub(crate) fn write_back(&self, positions: &mut [Point]) -> usize {
        let bits = |p: Point| p.to_array().map(f64::to_bits);
        let mut moved = 0;
        for (node, point) in self.nodes.iter().zip(&self.points).take(self.movable()) {
            moved += usize::from(bits(positions[node.index()]) != bits(*point));
            positions[node.index()] = *point;
        }
        moved
    }
}

/// The cells around each of the first `count` nodes, by a counting sort.
fn stars(cells: &[[u32; 8]], count: usize) -> (Vec<u32>, Vec<(u32, u8)>) {
    let mut starts = vec![0u32; count + 1];
    let corners = || {
        cells
            .iter()
            .enumerate()
            .flat_map(|(c, cell)| (0u8..).zip(cell).map(move |(k, &n)| (c, k, n as usize)))
    };
    for (_, _, node) in corners().filter(|&(_, _, n)| n < count) {
        starts[node + 1] += 1;
    }
    for node in 0..count {
        starts[node + 1] += starts[node];
    }
    let mut next = starts.clone();
    let mut around = vec![(0, 0); starts[count] as usize];
    for (cell, k, node) in corners().filter(|&(_, _, n)| n < count) {
        around[next[node] as usize] = (cell as u32, k);
        next[node] += 1;
    }
    (starts, around)
}

fn cell_size(corners: &[Point; 8]) -> f64 {
    let total: f64 =
        EDGES.iter().map(|&[a, b]| corners[usize::from(a)].distance(corners[usize::from(b)])).sum();
    let mean = total / EDGES.len() as f64;
    mean * mean * mean
}

/// How the cells are at some time.
#[derive(Clone)]
pub(crate) struct State {
    jacobians: Vec<f64>,
    positive: Vec<bool>,
}

impl State {
    pub(crate) fn worst(&self) -> Option<f64> {
        self.jacobians.iter().copied().reduce(f64::min)
    }

    pub(crate) fn mean(&self) -> f64 {
        self.jacobians.iter().sum::<f64>() / self.jacobians.len().max(1) as f64
    }

    pub(crate) fn inverted(&self, problem: &Problem) -> Vec<HexId> {
        let cells = self.positive.iter().zip(&problem.hexes);
        cells.filter(|(positive, _)| !**positive).map(|(_, &hex)| hex).collect()
    }

    /// More cells that are not positive, or as many and the worst is worse.
    pub(crate) fn is_worse_than(&self, other: &Self) -> bool {
        let count = |state: &Self| state.positive.iter().filter(|&&p| !p).count();
        let (mine, theirs) = (count(self), count(other));
        mine > theirs || mine == theirs && self.worst() < other.worst()
    }
}
