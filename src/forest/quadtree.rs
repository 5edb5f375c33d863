//! Quadtrees over unstructured coarse faces: levels, edges, and the 1 -> 4 split.
//!
//! ```text
//!   r3---m2---r2        child i = (r_i, m_i, c, m_{i-1})
//!   | 3   |  2 |        its edges: half of e_i at r_i, interior i,
//!   m3----c---m1                   interior i-1, half of e_{i-1} at r_i
//!   | 0   |  1 |        interior i joins m_i to c
//!   r0---m0---r1        e_i joins r_i to r_{i+1}
//! ```

use crate::geometry::Point;
use crate::mesh::{EdgeId, FaceId, NodeId};
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
    /// The node that divides each edge, or [`UNDIVIDED`]. Nothing divides edges that it is too short for.
    pub middle: Vec<NodeId>,
    /// The edges that are divided by the split of an element, in the order in which they were: ascending in runs.
    split: Vec<EdgeId>,
    /// Where the runs of `split` end whose edges do not have their halves yet.
    runs: Vec<usize>,
    /// The first of each split edge's two halves, the one at its edge node, among the edges of the next level. It may
    /// be too short for edges that have none.
    halves: Vec<EdgeId>,
    /// How many of `split` have their halves.
    halved: usize,
}

/// What stands in [`LevelEdges::middle`] for an edge that no node divides.
pub(super) const UNDIVIDED: NodeId = NodeId(u32::MAX);

impl Level {
    /// The base level of a forest.
    pub(crate) fn base(elements: Vec<[NodeId; 4]>, roots: Vec<FaceId>, edges: LevelEdges) -> Self {
        Self { elements, roots, siblings: 0, edges, refined: Vec::new() }
    }

    /// The coarse face that element `e` is part of.
    pub fn root(&self, e: usize) -> FaceId {
        self.roots[e >> self.siblings]
    }

    /// True if every element is refined.
    pub fn is_full(&self) -> bool {
        self.refined.len() == self.elements.len()
    }

    /// For each element: is it refined?
    pub fn are_refined(&self) -> Vec<bool> {
        parallel::flags(self.elements.len(), self.refined.len(), |k| [self.refined[k] as usize])
    }
}

impl LevelEdges {
    /// The edges of a base level.
    pub(crate) fn base(of_element: Vec<[EdgeId; 4]>, ends: Vec<[NodeId; 2]>) -> Self {
        Self { of_element, ends, ..Self::default() }
    }

    /// The edges of `marked` elements that nothing divides, in order.
    fn undivided_of(&self, marked: &[u32]) -> Vec<EdgeId> {
        let every = marked.len() == self.of_element.len();
        if every && self.split.is_empty() {
            return parallel::collect(self.ends.len(), EdgeId::new);
        }
        let sides = |e: u32| self.of_element[e as usize];
        if marked.len() * FEW < self.of_element.len() {
            let all = marked.iter().flat_map(|&e| sides(e));
            let mut undivided: Vec<EdgeId> = all.filter(|&e| self.is_undivided(e)).collect();
            parallel::sort(&mut undivided);
            undivided.dedup();
            return undivided;
        }
        let is_side = parallel::flags(self.ends.len(), marked.len(), |k| sides(marked[k]).map(EdgeId::index));
        parallel::filter_map(self.ends.len(), |e| {
            Some(EdgeId::new(e)).filter(|&edge| is_side[e] && self.is_undivided(edge))
        })
    }

    /// True if no node divides edge `e`.
    #[inline]
    pub(crate) fn is_undivided(&self, e: EdgeId) -> bool {
        self.middle.get(e.index()).is_none_or(|&middle| middle == UNDIVIDED)
    }

    /// Lets the nodes from `first_node` on divide the edges `divided`, which ascend.
    pub(crate) fn divide(
        &mut self,
        divided: &[EdgeId],
        first_node: usize,
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        let node = |k: usize| NodeId::new(first_node + k);
        put(&mut self.middle, UNDIVIDED, self.ends.len(), divided, node, monitor)
    }

    /// Undoes [`divide`](Self::divide), as far as it went.
    fn unite(&mut self, divided: &[EdgeId]) {
        for edge in divided {
            if let Some(middle) = self.middle.get_mut(edge.index()) {
                *middle = UNDIVIDED;
            }
        }
    }

    /// Makes the halves of the edges that were split since it was last called, as the next edges of `ends`. Stopped, it
    /// can be called again: it goes on where it was.
    fn halve(&mut self, ends: &mut Vec<[NodeId; 2]>, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        while let Some(&run) = self.runs.first() {
            let newly_split = &self.split[self.halved..run];
            let first_half = ends.len();
            let half = |k: usize| EdgeId::new(first_half + 2 * k);
            put(&mut self.halves, EdgeId::default(), self.ends.len(), newly_split, half, monitor)?;
            parallel::try_extend_arrays(ends, newly_split.len(), monitor, |k| {
                let edge = newly_split[k].index();
                self.ends[edge].map(|end| [self.middle[edge], end])
            })?;
            self.halved = run;
            self.runs.remove(0);
        }
        Ok(())
    }

    /// The half of edge `e` at local node `corner` of an element that has it. Edge nodes are local nodes 1
    /// and 3, and the first half is theirs.
    #[inline]
    fn half(&self, e: EdgeId, corner: usize) -> EdgeId {
        EdgeId(self.halves[e.index()].0 + u32::from(corner.is_multiple_of(2)))
    }
}

/// Sets `of_edge` to `value(k)` at the edge `edges[k]`, for each `k`; these ascend. Where it is too short for all `count`
/// edges, `nothing` is appended.
fn put<T: Copy + Send + Sync>(
    of_edge: &mut Vec<T>,
    nothing: T,
    count: usize,
    edges: &[EdgeId],
    value: impl Fn(usize) -> T + Sync,
    monitor: &dyn Monitor,
) -> Result<(), Cancelled> {
    if of_edge.is_empty() && edges.len() == count {
        return parallel::try_extend(of_edge, count, monitor, value);
    }
    parallel::try_extend(of_edge, count - of_edge.len(), monitor, |_| nothing)?;
    parallel::try_scatter(of_edge, edges.len(), monitor, |k| edges[k].index(), value)
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

    /// Makes room for the nodes of `levels` more levels, in each of which all elements are split.
    ///
    /// # Errors
    /// If the monitor stops it.
    pub fn expect_levels(&mut self, levels: u8, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        let Some(last) = self.levels.last() else { return Ok(()) };
        let (mut faces, mut edges, mut nodes) = (last.elements.len(), last.edges.ends.len(), 0);
        for _ in 0..levels {
            nodes += edges + faces;
            (edges, faces) = (2 * edges + 4 * faces, 4 * faces);
        }
        parallel::try_reserve(&mut self.positions, nodes, monitor)
    }

    /// Makes room for the split of `count` elements of `levels[depth]`, at least one, so that it need not be made bit by
    /// bit.
    ///
    /// # Errors
    /// If the monitor stops it.
    pub fn expect(&mut self, depth: usize, count: usize, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        // A quad has about two edges of its own.
        parallel::try_reserve(&mut self.positions, 3 * count, monitor)?;
        let child = self.child_of(depth);
        parallel::try_reserve(&mut child.elements, 4 * with_slack(count), monitor)?;
        parallel::try_reserve(&mut child.roots, with_slack(count), monitor)
    }

    /// The level below `levels[depth]`.
    fn child_of(&mut self, depth: usize) -> &mut Level {
        if depth + 1 == self.levels.len() {
            self.levels.push(Level { siblings: 2, ..Level::default() });
        }
        &mut self.levels[depth + 1]
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
        let first_node = self.positions.len();
        let divided = self.levels[depth].edges.undivided_of(marked);
        let first_child = self.child_of(depth).elements.len();
        self.add_nodes(depth, marked, &divided, monitor)
            .and_then(|()| self.add_children(depth, marked, first_node + divided.len(), monitor))
            .inspect_err(|_| {
                self.positions.truncate(first_node);
                self.levels[depth + 1].elements.truncate(first_child);
                self.levels[depth].edges.unite(&divided);
            })?;
        let (parents, children) = self.levels.split_at_mut(depth + 1);
        let (parent, child) = (&mut parents[depth], &mut children[0]);
        parallel::extend(&mut child.roots, marked.len(), |k| parent.root(marked[k] as usize));
        parallel::extend_from_slice(&mut parent.refined, marked);
        append(&mut parent.edges.split, divided);
        parent.edges.runs.push(parent.edges.split.len());
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
        parallel::try_reserve(&mut self.positions, divided.len() + marked.len(), monitor)?;
        parallel::try_grow(&mut self.positions, divided.len(), monitor, |old, k| {
            midpoint(old, edges.ends[divided[k].index()])
        })?;
        parallel::try_grow(&mut self.positions, marked.len(), monitor, |old, k| {
            center(old, elements[marked[k] as usize])
        })?;
        edges.divide(divided, first_node, monitor)
    }

    /// Adds the four children of each of the `marked` elements, whose face nodes are numbered from `first_face_node`.
    fn add_children(
        &mut self,
        depth: usize,
        marked: &[u32],
        first_face_node: usize,
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        let (parents, children) = self.levels.split_at_mut(depth + 1);
        let Level { elements, edges, .. } = &parents[depth];
        parallel::try_extend_arrays(&mut children[0].elements, marked.len(), monitor, |k| {
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

        let new_halves = 2 * (parent.edges.split.len() - parent.edges.halved);
        let known = edges.of_element.len();
        let (children, parents) = (&elements[known..], &parent.refined[known / 4..]);
        parallel::try_reserve(&mut edges.ends, with_slack(new_halves + children.len()), monitor)?;
        parallel::try_reserve(&mut edges.of_element, with_slack(children.len()), monitor)?;
        parent.edges.halve(&mut edges.ends, monitor)?;
        let first_interior = edges.ends.len();
        parallel::try_extend(&mut edges.ends, children.len(), monitor, |c| [children[c][1], children[c][2]])?;
        parallel::try_extend_arrays::<_, 4>(&mut edges.of_element, parents.len(), monitor, |k| {
            let sides = parent.edges.of_element[parents[k] as usize];
            std::array::from_fn(|i| {
                let before = (i + 3) % 4;
                let half = |side: usize| parent.edges.half(sides[side], i);
                let interior = |i: usize| EdgeId::new(first_interior + 4 * k + i);
                [half(i), interior(i), interior(before), half(before)]
            })
        })
        .inspect_err(|_| edges.ends.truncate(first_interior))
    }
}

/// A little more than `count`: balance and templates add to what refinement makes.
fn with_slack(count: usize) -> usize {
    count + count / 16
}

/// Halfway between the ends of an edge.
#[inline]
pub(crate) fn midpoint(positions: &[Point], ends: [NodeId; 2]) -> Point {
    let (at, [a, b]) = (|n: NodeId| positions[n.index()], ends);
    (at(a) + at(b)) * 0.5
}

/// The mean of the four nodes of an element.
#[inline]
pub(crate) fn center(positions: &[Point], element: [NodeId; 4]) -> Point {
    let (at, [a, b, c, d]) = (|n: NodeId| positions[n.index()], element);
    ((at(a) + at(c)) + (at(b) + at(d))) * 0.25
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
