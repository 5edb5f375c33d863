//! The part of a mesh that moves, numbered for itself: the nodes that move, the cells around them, and who may move
//! at the same time.

use crate::geometry::Point;
use crate::mesh::numbering::hex::EDGES;
use crate::mesh::quality::{Certainty, four, is_positive};
use crate::mesh::{HexId, NodeId};
use crate::monitor::batches;
use crate::{Cancelled, Monitor, Silent, parallel};

/// No node of the problem.
const NONE: u32 = u32::MAX;

/// Nodes that are coloured between two questions whether to stop.
const ASKED: u32 = 1 << 14;

/// The cells around the movable nodes. Nodes of the problem are numbered in the mesh's order, movable ones first.
pub(crate) struct Problem {
    /// The mesh's node of each node, and where the node is.
    pub(crate) nodes: Vec<NodeId>,
    pub(crate) points: Vec<Point>,
    /// The nodes of each cell, and the mesh's hex.
    pub(crate) cells: Vec<[u32; 8]>,
    hexes: Vec<HexId>,
    /// The cube of each cell's mean edge at first: what its determinants are measured against.
    pub(crate) volume: Vec<f64>,
    /// The cells that are positive in all of their inside.
    pub(crate) positive: Vec<bool>,
    /// The cells whose inside is looked at whenever one of their nodes moves.
    pub(crate) guarded: Vec<bool>,
    /// Where the cells of each movable node start in `around`: eight times a cell, and which of its corners the node is.
    starts: Vec<u32>,
    around: Vec<u32>,
    /// Movable nodes by colour, ascending: two of one colour share no cell. Sweeps follow this order.
    pub(crate) colours: Vec<Vec<u32>>,
}

impl Problem {
    /// The cells around the nodes that move.
    pub(crate) fn new(
        positions: &[Point],
        hexes: &[[NodeId; 8]],
        moves: &(dyn Fn(NodeId) -> bool + Sync),
    ) -> Self {
        Self::within(positions, hexes, moves, &Silent).expect("nobody stops it")
    }

    /// As [`Problem::new`], unless the monitor stops it.
    pub(crate) fn within(
        positions: &[Point],
        hexes: &[[NodeId; 8]],
        moves: &(dyn Fn(NodeId) -> bool + Sync),
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let touched = parallel::try_filter(hexes.len(), monitor, |h| hexes[h].iter().any(|&n| moves(n)))?;
        let nodes_of = |k: usize| hexes[touched[k] as usize].map(NodeId::index);
        let used = parallel::flags(positions.len(), touched.len(), nodes_of);
        let of_kind = |wanted: bool| {
            let is = |n: usize| (used[n] && moves(NodeId::new(n)) == wanted).then(|| NodeId::new(n));
            parallel::filter_map(positions.len(), is)
        };
        let mut nodes: Vec<NodeId> = of_kind(true);
        let movable_count = nodes.len();
        nodes.extend(of_kind(false));
        monitor.proceed()?;
        let mut local = vec![NONE; positions.len()];
        for (i, n) in (0u32..).zip(&nodes) {
            local[n.index()] = i;
        }
        let cells: Vec<[u32; 8]> = parallel::try_collect(touched.len(), monitor, |c| {
            hexes[touched[c] as usize].map(|n| local[n.index()])
        })?;
        drop(local);
        let points: Vec<Point> =
            parallel::try_collect(nodes.len(), monitor, |n| positions[nodes[n].index()])?;
        let (starts, around) = stars(&cells, movable_count, monitor)?;
        let size = |c: usize| cell_size(&cells[c].map(|n| points[n as usize]));
        let mut problem = Self {
            hexes: touched.into_iter().map(HexId).collect(),
            volume: parallel::try_collect(cells.len(), monitor, size)?,
            positive: Vec::new(),
            guarded: vec![false; cells.len()],
            colours: Vec::new(),
            nodes,
            points,
            cells,
            starts,
            around,
        };
        problem.colours = problem.colour(monitor)?;
        problem.positive = problem.are_positive(monitor)?;
        Ok(problem)
    }

    /// How many nodes may move: they are numbered first.
    pub(crate) fn movable(&self) -> usize {
        self.starts.len() - 1
    }

    /// The cells around a movable node, each with the node's corner.
    #[inline]
    pub(crate) fn star(&self, node: u32) -> impl Iterator<Item = (usize, usize)> + '_ {
        self.uses(node).iter().map(|&place| (place as usize / 8, place as usize % 8))
    }

    /// The same, each as eight times the cell, and which of its corners the node is.
    #[inline]
    pub(crate) fn uses(&self, node: u32) -> &[u32] {
        &self.around[self.starts[node as usize] as usize..self.starts[node as usize + 1] as usize]
    }

    /// The mean edge of the cells around a movable node, as they were at first.
    pub(crate) fn edge(&self, node: u32) -> f64 {
        let (count, total) = self
            .star(node)
            .fold((0.0, 0.0), |(count, total), (cell, _)| (count + 1.0, total + self.volume[cell]));
        libm::cbrt(total / count)
    }

    /// Where a movable node of the mesh is.
    ///
    /// # Panics
    /// If it is no movable node of a cell.
    pub(crate) fn place(&self, node: NodeId) -> Point {
        self.points[self.local(node) as usize]
    }

    /// The number of a movable node of the mesh.
    ///
    /// # Panics
    /// If it is no movable node of a cell.
    pub(crate) fn local(&self, node: NodeId) -> u32 {
        self.nodes[..self.movable()].binary_search(&node).expect("a movable node") as u32
    }

    /// Where the corners of a cell are.
    #[inline]
    pub(crate) fn corners(&self, cell: usize) -> [Point; 8] {
        let mut corners = [Point::ZERO; 8];
        for (corner, &n) in corners.iter_mut().zip(&self.cells[cell]) {
            *corner = self.points[n as usize];
        }
        corners
    }

    /// Asks every cell again whether it is positive.
    pub(crate) fn find_positive(&mut self) {
        self.positive = self.are_positive(&Silent).expect("nobody stops it");
    }

    /// Is the cell positive in all of its inside, where its nodes are now?
    pub(crate) fn is_positive(&self, cell: usize) -> bool {
        is_positive(&self.corners(cell)) == Certainty::Positive
    }

    fn are_positive(&self, monitor: &dyn Monitor) -> Result<Vec<bool>, Cancelled> {
        four::are_positive(self.cells.len(), monitor, |cell| self.corners(cell))
    }

    /// The scaled Jacobian of each cell.
    pub(crate) fn scaled_jacobians(&self, monitor: &dyn Monitor) -> Result<Vec<f64>, Cancelled> {
        four::scaled_jacobians(self.cells.len(), monitor, |cell| self.corners(cell))
    }

    /// The cells around the nodes, each once, ascending.
    pub(crate) fn cells_around(&self, nodes: &[u32]) -> Vec<u32> {
        self.cells_around_within(nodes, &Silent).expect("nobody stops it")
    }

    /// As [`Problem::cells_around`], unless the monitor stops it.
    pub(crate) fn cells_around_within(
        &self,
        nodes: &[u32],
        monitor: &dyn Monitor,
    ) -> Result<Vec<u32>, Cancelled> {
        monitor.proceed()?;
        let mut is_near = vec![false; self.cells.len()];
        parallel::raise_some(&mut is_near, nodes.len(), |k, is_near| {
            self.star(nodes[k]).for_each(|(cell, _)| is_near.raise(cell));
        });
        parallel::try_filter(self.cells.len(), monitor, |cell| is_near[cell])
    }

    /// How the cells are now; `positive` is up to date.
    pub(crate) fn state(&self, monitor: &dyn Monitor) -> Result<State, Cancelled> {
        Ok(State { jacobians: self.scaled_jacobians(monitor)?, positive: self.positive.clone() })
    }

    /// Has the nodes of lower rank swept first in each block: colours are split by ranks, which are below `ranks`.
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
    fn colour(&self, monitor: &dyn Monitor) -> Result<Vec<Vec<u32>>, Cancelled> {
        let mut colour_of = vec![NONE; self.movable()];
        let mut colours: Vec<Vec<u32>> = Vec::new();
        let mut taken_by: Vec<u32> = Vec::new();
        for node in 0..self.movable() as u32 {
            if node.is_multiple_of(ASKED) {
                monitor.proceed()?;
            }
            for (cell, _) in self.star(node) {
                for other in self.cells[cell] {
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
        Ok(colours)
    }

    /// Takes the nodes back to where the mesh has them.
    pub(crate) fn put_back(&mut self, positions: &[Point]) {
        for (node, point) in self.nodes.iter().zip(&mut self.points) {
            *point = positions[node.index()];
        }
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
fn stars(cells: &[[u32; 8]], count: usize, monitor: &dyn Monitor) -> Result<(Vec<u32>, Vec<u32>), Cancelled> {
    let of_cells = cells.as_flattened();
    let mut starts = vec![0u32; count + 1];
    for batch in batches(of_cells.len(), monitor) {
        for &node in of_cells[batch?].iter().filter(|&&n| (n as usize) < count) {
            starts[node as usize + 1] += 1;
        }
    }
    for node in 0..count {
        starts[node + 1] += starts[node];
    }
    let mut next = starts.clone();
    let mut around = vec![0; starts[count] as usize];
    for batch in batches(of_cells.len(), monitor) {
        for place in batch? {
            let node = of_cells[place] as usize;
            if node < count {
                around[next[node] as usize] = u32::try_from(place).expect("more than 2^29 cells");
                next[node] += 1;
            }
        }
    }
    Ok((starts, around))
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
