//! Parts of a problem that are judged each for itself: how far mesh and solid are from each other there.

use super::holds::{Hold, Holds};
use crate::geometry::{CutQuad, Point};
use crate::mesh::topology::Sets;
use crate::optimize::Problem;

/// What a node weighs that is off the solid, however near it is: so many edges.
const OFF: f64 = 0.25;

/// A mark may be so many edges off the mesh. Where it is farther, it may not get more than a tenth farther still.
const ALLOWED: f64 = 0.35;
const FARTHER: f64 = 1.1;

/// What the sum over nodes weighs against the farthest.
const SUM: f64 = 0.1;

/// A place of the solid that the mesh is to pass near by.
pub(super) struct Mark {
    /// The node whose place it was to be.
    pub(super) node: u32,
    pub(super) place: Point,
    /// The boundary quads around the node.
    pub(super) quads: Vec<[u32; 4]>,
}

impl Mark {
    /// How far the boundary around its node is from it.
    fn distance(&self, problem: &Problem) -> f64 {
        let patch = |quad: &[u32; 4]| CutQuad(quad.map(|n| problem.points[n as usize]));
        let squared = self.quads.iter().map(|quad| patch(quad).distance_squared(self.place));
        squared.fold(f64::INFINITY, f64::min).sqrt()
    }
}

/// The nodes that are drawn.
pub(super) fn drawn(problem: &Problem, holds: &Holds) -> impl Iterator<Item = u32> {
    (0..problem.movable() as u32).filter(|&n| holds.is(problem.nodes[n as usize], Hold::Drawn))
}

/// Parts of a problem that have no cell in common.
pub(super) struct Regions {
    /// The nodes of all of them.
    pub(super) moves: Vec<bool>,
    /// The region of each node.
    of: Vec<u32>,
}

/// How things stand in all regions at some time.
pub(super) struct State {
    points: Vec<Point>,
    holds: Vec<Hold>,
    /// For each region.
    off: Vec<f64>,
    /// How far the mesh is from each mark.
    distances: Vec<f64>,
}

/// How far mesh and solid are from each other, in edges.
#[derive(Clone, Copy, Debug, Default)]
struct Off {
    farthest: f64,
    sum: f64,
}

impl Regions {
    pub(super) fn new(problem: &Problem, moves: Vec<bool>) -> Self {
        let mut sets = Sets::new(problem.movable());
        for cell in &problem.cells {
            let mut nodes = cell.iter().copied().filter(|&n| moves.get(n as usize) == Some(&true));
            if let Some(first) = nodes.next() {
                nodes.for_each(|n| {
                    sets.join(first, n, false);
                });
            }
        }
        let of = (0..problem.movable() as u32).map(|n| sets.root(n).0).collect();
        Self { moves, of }
    }

    /// How things stand.
    pub(super) fn state(&self, problem: &Problem, holds: &Holds, marks: &[Mark]) -> State {
        State {
            points: problem.points.clone(),
            holds: holds.holds.clone(),
            off: self.off(problem, holds, marks),
            distances: marks.iter().map(|mark| mark.distance(problem)).collect(),
        }
    }

    /// Puts everything back as it was in the regions where that was better; in the others `moved` tells of the nodes that
    /// stand elsewhere. Returns by how much the region of each node got better, as a share of what it lacked; 0 where it was
    /// put back.
    pub(super) fn keep_better(
        &self,
        problem: &mut Problem,
        holds: &mut Holds,
        marks: &[Mark],
        before: State,
        moved: &mut [bool],
    ) -> Vec<f64> {
        let now = self.off(problem, holds, marks);
        let mut is_better: Vec<bool> =
            now.iter().zip(&before.off).map(|(now, before)| now < before).collect();
        for (mark, before) in marks.iter().zip(before.distances) {
            if mark.distance(problem) > FARTHER * before.max(ALLOWED * problem.edge(mark.node)) {
                is_better[self.of[mark.node as usize] as usize] = false;
            }
        }
        for n in (0..problem.movable()).filter(|&n| self.moves[n]) {
            if is_better[self.of[n] as usize] {
                moved[n] |= problem.points[n] != before.points[n];
            } else {
                problem.points[n] = before.points[n];
                let id = problem.nodes[n].index();
                holds.holds[id] = before.holds[id];
            }
        }
        problem.find_positive();
        let gain = |r: usize| if is_better[r] { 1.0 - now[r] / before.off[r] } else { 0.0 };
        self.of.iter().map(|&r| gain(r as usize)).collect()
    }

    /// What each region lacks: how far its drawn nodes are off the solid, and the marks off the mesh.
    fn off(&self, problem: &Problem, holds: &Holds, marks: &[Mark]) -> Vec<f64> {
        let mut off = vec![Off::default(); self.of.len()];
        let mut add = |n: u32, distance: f64, more: f64| {
            let off = &mut off[self.of[n as usize] as usize];
            let edges = distance / problem.edge(n);
            off.farthest = off.farthest.max(edges);
            off.sum += edges + more;
        };
        for n in drawn(problem, holds) {
            let (id, place) = (problem.nodes[n as usize], problem.points[n as usize]);
            let foot = holds.target.foot(holds.anchors[id.index()], place);
            add(n, foot.map_or(0.0, |foot| foot.point.distance(place)), OFF);
        }
        for mark in marks {
            add(mark.node, mark.distance(problem), 0.0);
        }
        off.into_iter().map(|Off { farthest, sum }| farthest + SUM * sum).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::super::target::{Foot, Target};
    use super::*;
    use crate::geometry::Aabb;
    use crate::hexing::correspondence::Anchor;
    use crate::mesh::topology::hex_boundary;
    use crate::mesh::{GridOptions, HexMesh, NodeId, hex_grid};
    use crate::solid::SurfaceId;

    /// What is at the boundary belongs into the plane z = 2.
    struct Plane;

    impl Target for Plane {
        fn foot(&self, anchor: Anchor, p: Point) -> Option<Foot> {
            let on_plane = Foot { point: p.with_z(2.0), direction: Point::Z };
            (anchor != Anchor::Inside).then_some(on_plane)
        }
    }

    /// Cubes, 12 by 2 by 2, and the nodes in the middle of the top at both ends.
    fn bar() -> (HexMesh, [NodeId; 2]) {
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 100 };
        let mesh = hex_grid(Aabb { min: Point::ZERO, max: Point::new(12.0, 2.0, 2.0) }, &options).unwrap();
        let at = |p: Point| NodeId::new(mesh.positions.iter().position(|&q| q == p).unwrap());
        let ends = [1.0, 11.0].map(|x| at(Point::new(x, 1.0, 2.0)));
        (mesh, ends)
    }

    #[test]
    fn each_region_is_judged_for_itself() {
        let (mesh, ends) = bar();
        let mut problem = Problem::new(&mesh.positions, &mesh.hexes, &|_| true);
        let mut anchors = vec![Anchor::Inside; mesh.positions.len()];
        ends.iter().for_each(|n| anchors[n.index()] = Anchor::Surface(SurfaceId(0)));
        let mut holds = Holds::drawn(&Plane, &anchors);
        let [a, b] = ends.map(|n| problem.local(n) as usize);
        (problem.points[a].z, problem.points[b].z) = (1.5, 1.5);
        let is_near = |n: usize| (mesh.positions[problem.nodes[n].index()].x - 6.0).abs() > 3.0;
        let regions = Regions::new(&problem, (0..problem.movable()).map(is_near).collect());
        let before = regions.state(&problem, &holds, &[]);
        (problem.points[a].z, problem.points[b].z) = (1.9, 1.4);
        let mut moved = vec![false; problem.movable()];
        let gains = regions.keep_better(&mut problem, &mut holds, &[], before, &mut moved);
        let lacks = |off: f64| off + SUM * (off + OFF);
        assert!((gains[a] - (1.0 - lacks(0.1) / lacks(0.5))).abs() < 1e-12, "{}", gains[a]);
        assert_eq!(gains[b], 0.0);
        let middle = problem.local(NodeId::new(mesh.positions.iter().position(|p| p.x == 6.0).unwrap()));
        assert_eq!(gains[middle as usize], 0.0, "it is in no region");
        assert_eq!((0..moved.len()).filter(|&n| moved[n]).collect::<Vec<_>>(), [a]);
        assert_eq!((problem.points[a].z, problem.points[b].z), (1.9, 1.5));
    }

    #[test]
    fn what_takes_the_mesh_away_from_a_mark_is_taken_back() {
        let (mesh, [end, _]) = bar();
        let mut problem = Problem::new(&mesh.positions, &mesh.hexes, &|_| true);
        let mut anchors = vec![Anchor::Inside; mesh.positions.len()];
        anchors[end.index()] = Anchor::Surface(SurfaceId(0));
        let mut holds = Holds::drawn(&Plane, &anchors);
        let is_above = |quad: &[NodeId; 4]| quad.iter().all(|n| mesh.positions[n.index()].z == 2.0);
        let around = hex_boundary(&mesh.hexes).into_iter().map(|(quad, _)| quad);
        let around = around.filter(|quad| quad.contains(&end) && is_above(quad));
        let quads: Vec<[u32; 4]> = around.map(|quad| quad.map(|n| problem.local(n))).collect();
        assert_eq!(quads.len(), 4);
        let node = problem.local(end);
        let regions = Regions::new(&problem, vec![true; problem.movable()]);
        // Both times the node gets nearer to the plane.
        for (mark, kept) in [(1.0, true), (0.6, false)] {
            problem.points[node as usize].z = 1.1;
            let place = problem.points[node as usize].with_z(mark);
            let marks = [Mark { node, place, quads: quads.clone() }];
            let before = regions.state(&problem, &holds, &marks);
            problem.points[node as usize].z = 1.3;
            let mut moved = vec![false; problem.movable()];
            let gains = regions.keep_better(&mut problem, &mut holds, &marks, before, &mut moved);
            assert_eq!((gains[node as usize] > 0.0, moved[node as usize]), (kept, kept));
            assert_eq!(problem.points[node as usize].z, if kept { 1.3 } else { 1.1 });
        }
    }
}
