//! Quadtrees over unstructured coarse faces: levels, edges, and the 1 -> 4 split.
//!
//! ```text
//!   r3---m2---r2        child i = (r_i, m_i, c, m_{i-1})
//!   | 3   |  2 |        its edges: half of e_i at r_i, interior i,
//!   m3----c---m1                   interior i-1, half of e_{i-1} at r_i
//!   | 0   |  1 |        interior i joins m_i to c
//!   r0---m0---r1        e_i joins r_i to r_{i+1}
//! ```

use std::sync::atomic::{AtomicBool, Ordering::Relaxed};

use crate::geometry::Point;
use crate::mesh::{EdgeId, FaceId, NodeId};
use crate::monitor::batches;
use crate::parallel;
use crate::template::quad::{SPLIT, place};
use crate::{Cancelled, Monitor};

/// Where fewer than one in so many elements of a level are split, their edges are sorted; elsewhere all edges of the
/// level are looked through.
const FEW: usize = 16;

/// The elements of one level.
#[derive(Debug, Default)]
pub struct Level {
    /// The four nodes of each element; local nodes 1 and 3 are its edge nodes.
    pub elements: Vec<[NodeId; 4]>,
    /// For each element that is refined, in the order in which they were: element `refined[k]` has the
    /// elements `4k..4k + 4` of the next level as its children.
    pub refined: Vec<u32>,
    /// For each element: is it refined?
    pub is_refined: Vec<bool>,
    /// The edges, as far as they were needed.
    pub(crate) edges: LevelEdges,
    /// The coarse face of each run of `1 << siblings` elements.
    roots: Vec<FaceId>,
    /// Whether each element has its own entry in `roots` (0, at the base) or four siblings share one (2).
    siblings: u8,
}

/// The edges of one level. They are made when an element of the level is first refined.
#[derive(Debug, Default)]
pub(crate) struct LevelEdges {
    /// The edges of each element; edge `i` joins its local nodes `i` and `i + 1`.
    pub of_element: Vec<[EdgeId; 4]>,
    /// The ends of each edge: its edge node, then the other.
    pub ends: Vec<[NodeId; 2]>,
    /// The node that divides each edge, or [`UNDIVIDED`].
    pub middle: Vec<NodeId>,
    /// The edges that are divided by the split of an element, in the order in which they were.
    split: Vec<EdgeId>,
    /// The first of each split edge's two halves, the one at its edge node, among the edges of the next level.
    halves: Vec<EdgeId>,
    /// How many of `split` have their halves.
    halved: usize,
}

/// What stands in [`LevelEdges::middle`] for an edge that no node divides.
pub(crate) const UNDIVIDED: NodeId = NodeId(u32::MAX);

impl Level {
    /// The base level of a forest.
    pub(crate) fn base(elements: Vec<[NodeId; 4]>, roots: Vec<FaceId>, edges: LevelEdges) -> Self {
        Self {
            is_refined: vec![false; elements.len()],
            elements,
            roots,
            siblings: 0,
            edges,
            refined: Vec::new(),
        }
    }

    /// The coarse face that element `e` is part of.
    pub fn root(&self, e: usize) -> FaceId {
        self.roots[e >> self.siblings]
    }
}

impl LevelEdges {
    /// The edges of a base level.
    pub(crate) fn base(of_element: Vec<[EdgeId; 4]>, ends: Vec<[NodeId; 2]>) -> Self {
        let (middle, halves) = (vec![UNDIVIDED; ends.len()], vec![EdgeId::default(); ends.len()]);
        Self { of_element, ends, middle, halves, ..Self::default() }
    }

    /// The edges of `marked` elements that nothing divides, in order.
    fn undivided_of(&self, marked: &[u32]) -> Vec<EdgeId> {
        let is_undivided = |e: EdgeId| self.middle[e.index()] == UNDIVIDED;
        let undivided_if = |is_wanted: &(dyn Fn(EdgeId) -> bool + Sync)| {
            parallel::filter_map(self.ends.len(), |e| {
                let edge = EdgeId(e as u32);
                (is_wanted(edge) && is_undivided(edge)).then_some(edge)
            })
        };
        if marked.len() == self.of_element.len() {
            return undivided_if(&|_| true);
        }
        let sides = |e: u32| self.of_element[e as usize];
        if marked.len() * FEW < self.of_element.len() {
            let all = marked.iter().flat_map(|&e| sides(e));
            let mut undivided: Vec<EdgeId> = all.filter(|&e| is_undivided(e)).collect();
            parallel::sort(&mut undivided);
            undivided.dedup();
            return undivided;
        }
        // Every thread sets flags to the same value, so that their order does not matter.
        let is_side = parallel::collect(self.ends.len(), |_| AtomicBool::new(false));
        parallel::for_each(marked.len(), |k| {
            sides(marked[k]).iter().for_each(|side| is_side[side.index()].store(true, Relaxed));
        });
        undivided_if(&|e| is_side[e.index()].load(Relaxed))
    }

    /// The half of edge `e` at local node `corner` of an element that has it. Edge nodes are local nodes 1
    /// and 3, and the first half is theirs.
    fn half(&self, e: EdgeId, corner: usize) -> EdgeId {
        EdgeId(self.halves[e.index()].0 + u32::from(corner.is_multiple_of(2)))
    }
}

/// A forest of quadtrees: the nodes of all levels and the elements of each.
#[derive(Debug)]
pub struct QuadForest {
    /// Coordinates of all nodes.
    pub positions: Vec<Point>,
    /// The levels, from the base.
    pub levels: Vec<Level>,
    /// The refinement level of `levels[0]`: 1 after the first split of every face, 0 with coarse quads kept.
    pub base_level: u8,
}

impl QuadForest {
    /// Number of elements that are not refined.
    pub fn leaf_count(&self) -> usize {
        self.levels.iter().map(|l| l.elements.len() - l.refined.len()).sum()
    }

    /// Splits the elements `marked` of `levels[depth]`, none of which is refined yet, into four each.
    ///
    /// # Errors
    /// If the monitor stops it; then no element is split.
    pub fn split(&mut self, depth: usize, marked: &[u32], monitor: &dyn Monitor) -> Result<(), Cancelled> {
        if marked.is_empty() {
            return Ok(());
        }
        self.complete_edges_of(depth, monitor)?;
        if depth + 1 == self.levels.len() {
            self.levels.push(Level { siblings: 2, ..Level::default() });
        }
        let first_node = self.positions.len();
        let mut divided = self.levels[depth].edges.undivided_of(marked);
        let made = self
            .add_nodes(depth, marked, &divided, monitor)
            .and_then(|()| self.children(depth, marked, first_node + divided.len(), monitor));
        let blocks = made.inspect_err(|_| self.take_back_nodes(depth, first_node, &divided))?;
        let (parents, children) = self.levels.split_at_mut(depth + 1);
        let (parent, child) = (&mut parents[depth], &mut children[0]);
        parent.edges.split.append(&mut divided);
        append(&mut child.elements, blocks.into_flattened());
        child.is_refined.resize(child.elements.len(), false);
        child.roots.extend(marked.iter().map(|&e| parent.root(e as usize)));
        for &e in marked {
            parent.is_refined[e as usize] = true;
        }
        parent.refined.extend_from_slice(marked);
        Ok(())
    }

    /// Adds the nodes that divide the edges `divided`, in their order, and the face nodes of the `marked` elements.
    fn add_nodes(
        &mut self,
        depth: usize,
        marked: &[u32],
        divided: &[EdgeId],
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        let Level { elements, edges, .. } = &mut self.levels[depth];
        let first_node = self.positions.len();
        let count = divided.len() + marked.len();
        parallel::try_grow(&mut self.positions, count, monitor, |old, k| match divided.get(k) {
            Some(edge) => midpoint(old, edges.ends[edge.index()]),
            None => center(old, elements[marked[k - divided.len()] as usize]),
        })?;
        for batch in batches(divided.len(), monitor) {
            batch?.for_each(|k| edges.middle[divided[k].index()] = NodeId::new(first_node + k));
        }
        Ok(())
    }

    /// Undoes [`add_nodes`](Self::add_nodes), as far as it went.
    fn take_back_nodes(&mut self, depth: usize, first_node: usize, divided: &[EdgeId]) {
        self.positions.truncate(first_node);
        let middle = &mut self.levels[depth].edges.middle;
        divided.iter().for_each(|edge| middle[edge.index()] = UNDIVIDED);
    }

    /// The four children of each of the `marked` elements, whose face nodes are numbered from `first_face_node`.
    fn children(
        &self,
        depth: usize,
        marked: &[u32],
        first_face_node: usize,
        monitor: &dyn Monitor,
    ) -> Result<Vec<[[NodeId; 4]; 4]>, Cancelled> {
        let Level { elements, edges, .. } = &self.levels[depth];
        parallel::try_collect(marked.len(), monitor, |k| {
            let e = marked[k] as usize;
            let [r0, r1, r2, r3] = elements[e];
            let [m0, m1, m2, m3] = edges.of_element[e].map(|e| edges.middle[e.index()]);
            place(&SPLIT, &[r0, r1, r2, r3, m0, m1, m2, m3, NodeId::new(first_face_node + k)])
        })
    }

    /// Makes all edges of the levels that have refined elements.
    pub(crate) fn complete_edges(&mut self, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        for depth in 1..self.levels.len() {
            if !self.levels[depth].refined.is_empty() {
                self.complete_edges_of(depth, monitor)?;
            }
        }
        Ok(())
    }

    /// Makes the edges of `levels[depth]` that the splits of its parents have called for. Stopped, it can be called
    /// again: it goes on where it was.
    fn complete_edges_of(&mut self, depth: usize, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        let Some(above) = depth.checked_sub(1) else { return Ok(()) };
        let (parents, children) = self.levels.split_at_mut(depth);
        let (parent, child) = (&mut parents[above], &mut children[0]);
        let Level { elements, edges, .. } = child;

        let first_split = parent.edges.halved;
        let first_block = edges.of_element.len() / 4;
        let (new_splits, new_blocks) =
            (parent.edges.split.len() - first_split, parent.refined.len() - first_block);
        edges.ends.reserve(2 * new_splits + 4 * new_blocks);
        edges.of_element.reserve(4 * new_blocks);
        for batch in batches(new_splits, monitor) {
            let batch = batch?;
            let newly_split = &parent.edges.split[first_split + batch.start..first_split + batch.end];
            let first_half = edges.ends.len();
            for (k, edge) in newly_split.iter().enumerate() {
                parent.edges.halves[edge.index()] = EdgeId::new(first_half + 2 * k);
            }
            parallel::extend(&mut edges.ends, 2 * newly_split.len(), |half| {
                let edge = newly_split[half / 2].index();
                [parent.edges.middle[edge], parent.edges.ends[edge][half % 2]]
            });
            parent.edges.halved = first_split + batch.end;
        }
        for batch in batches(new_blocks, monitor) {
            let batch = batch?;
            let (first, last) = (first_block + batch.start, first_block + batch.end);
            let first_interior = edges.ends.len();
            let (children, parents) = (&elements[4 * first..4 * last], &parent.refined[first..last]);
            parallel::extend(&mut edges.ends, children.len(), |c| [children[c][1], children[c][2]]);
            parallel::extend(&mut edges.of_element, children.len(), |c| {
                let (k, i) = (c / 4, c % 4);
                let sides = parent.edges.of_element[parents[k] as usize];
                let before = (i + 3) % 4;
                let half = |side: usize| parent.edges.half(sides[side], i);
                let interior = |i: usize| EdgeId((first_interior + 4 * k + i) as u32);
                [half(i), interior(i), interior(before), half(before)]
            });
        }
        edges.middle.resize(edges.ends.len(), UNDIVIDED);
        edges.halves.resize(edges.ends.len(), EdgeId::default());
        Ok(())
    }
}

/// Halfway between the ends of an edge.
pub(crate) fn midpoint(positions: &[Point], ends: [NodeId; 2]) -> Point {
    let [a, b] = ends.map(|n| positions[n.index()]);
    (a + b) * 0.5
}

/// The mean of the four nodes of an element.
pub(crate) fn center(positions: &[Point], element: [NodeId; 4]) -> Point {
    let [a, b, c, d] = element.map(|n| positions[n.index()]);
    ((a + c) + (b + d)) * 0.25
}

/// Appends `more` to `all`, without a copy where `all` is empty.
pub(super) fn append<T>(all: &mut Vec<T>, mut more: Vec<T>) {
    if all.is_empty() {
        *all = more;
    } else {
        all.append(&mut more);
    }
}

#[cfg(test)]
mod tests {
    use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

    use super::*;
    use crate::mesh::PolygonMesh;
    use crate::{Silent, Stage};

    /// Says stop at a question.
    struct StopsAt(usize, AtomicUsize);

    impl Monitor for StopsAt {
        fn progress(&self, _: Stage, _: f64) {}
        fn cancelled(&self) -> bool {
            self.1.fetch_add(1, Relaxed) == self.0
        }
    }

    /// Two quads, each split once, one of the eight split again.
    fn forest() -> QuadForest {
        let positions = [[0., 0.], [1., 0.], [1., 1.], [0., 1.], [2., 0.], [2., 1.]];
        let mut mesh = PolygonMesh {
            positions: positions.map(|[x, y]| Point::new(x, y, 0.0)).to_vec(),
            ..PolygonMesh::default()
        };
        mesh.push_face([0, 1, 2, 3].map(NodeId));
        mesh.push_face([1, 4, 5, 2].map(NodeId));
        let mut forest = QuadForest::refined_once(&mesh, &Silent).expect("two quads");
        forest.split(0, &[0], &Silent).expect("nobody stops it");
        forest
    }

    /// Wherever it is stopped, a split leaves a forest that can be split as if it had never been tried.
    #[test]
    fn a_split_that_is_stopped_changes_nothing() {
        let nodes = forest().positions.len();
        let mut whole = forest();
        whole.split(0, &[3, 5], &Silent).expect("nobody stops it");
        let mut stops = 0;
        for question in 0.. {
            let mut forest = forest();
            if forest.split(0, &[3, 5], &StopsAt(question, AtomicUsize::new(0))).is_ok() {
                break;
            }
            stops += 1;
            assert_eq!(forest.positions.len(), nodes, "stopped at question {question}");
            forest.split(0, &[3, 5], &Silent).expect("nobody stops it");
            assert_eq!(forest.positions, whole.positions);
            assert_eq!(forest.levels[1].elements, whole.levels[1].elements);
        }
        assert!(stops >= 3, "it was asked {stops} times");
    }
}
