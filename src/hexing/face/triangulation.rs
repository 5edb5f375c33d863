//! The constrained Delaunay triangulation of spade, as the planar mesher uses it.
//!
//! Points are numbered in the order in which they are inserted; one that falls together with another has its number.

use std::collections::VecDeque;

use glam::DVec2;
use spade::Triangulation as _;
use spade::handles::{FixedFaceHandle, FixedVertexHandle, InnerTag};
use spade::{
    ConstrainedDelaunayTriangulation, Intersection, LineIntersectionIterator, Point2, PositionInTriangulation,
};

use crate::{Cancelled, Monitor};

/// Insertions between two questions to the monitor.
const BATCH: usize = 1 << 10;

/// No triangle is beside an edge.
pub(super) const NONE: u32 = u32::MAX;

/// Points, constrained segments between them, and triangles.
pub(super) struct Triangulation {
    cdt: ConstrainedDelaunayTriangulation<Point2<f64>>,
    last: FixedVertexHandle,
    operations: usize,
}

/// What became of a segment that was to be constrained.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Outcome {
    Added,
    /// Both ends are the same point.
    Degenerate,
    /// It goes through this point.
    Touches(u32),
    /// It is constrained already.
    Exists,
    /// It crosses this constrained segment.
    Crosses([u32; 2]),
}

/// Triangles of a region.
#[derive(Clone, Debug, Default)]
pub(super) struct Triangles {
    /// Counter-clockwise.
    pub(super) corners: Vec<[u32; 3]>,
    /// The triangle beyond the edge from corner k to the next one; [`NONE`] outside of the region.
    pub(super) beyond: Vec<[u32; 3]>,
    /// Is that edge constrained?
    pub(super) constrained: Vec<[bool; 3]>,
}

impl Triangulation {
    pub(super) fn new() -> Self {
        let cdt = ConstrainedDelaunayTriangulation::new();
        Self { cdt, last: FixedVertexHandle::from_index(0), operations: 0 }
    }

    fn ask(&mut self, monitor: &dyn Monitor) -> Result<(), Cancelled> {
        self.operations += 1;
        if self.operations.is_multiple_of(BATCH) { monitor.proceed() } else { Ok(()) }
    }

    /// Adds a point, or finds the one that is there.
    pub(super) fn insert(&mut self, point: DVec2, monitor: &dyn Monitor) -> Result<u32, Cancelled> {
        self.ask(monitor)?;
        let [x, y] = [point.x, point.y];
        let at = spade::mitigate_underflow(Point2::new(x, y));
        let inserted = if self.cdt.num_vertices() == 0 {
            self.cdt.insert(at)
        } else {
            self.cdt.insert_with_hint(at, self.last)
        };
        self.last = inserted.expect("coordinates of a region are measured in cells and finite");
        Ok(self.last.index() as u32)
    }

    /// Constrains the segment between two points, unless that would touch something on its way.
    pub(super) fn constrain(&mut self, ends: [u32; 2], monitor: &dyn Monitor) -> Result<Outcome, Cancelled> {
        self.ask(monitor)?;
        let [from, to] = ends.map(|end| FixedVertexHandle::from_index(end as usize));
        if from == to {
            return Ok(Outcome::Degenerate);
        }
        let ends_here = |v: FixedVertexHandle| v == from || v == to;
        for met in LineIntersectionIterator::new_from_handles(&self.cdt, from, to) {
            match met {
                Intersection::VertexIntersection(v) if !ends_here(v.fix()) => {
                    return Ok(Outcome::Touches(v.fix().index() as u32));
                }
                Intersection::EdgeIntersection(edge) if edge.is_constraint_edge() => {
                    return Ok(Outcome::Crosses(edge.vertices().map(|v| v.fix().index() as u32)));
                }
                // One that goes but a part of the way ends at a point, which comes next.
                Intersection::EdgeOverlap(edge)
                    if edge.is_constraint_edge() && edge.vertices().iter().all(|v| ends_here(v.fix())) =>
                {
                    return Ok(Outcome::Exists);
                }
                _ => {}
            }
        }
        self.cdt.add_constraint(from, to);
        Ok(Outcome::Added)
    }

    /// For each face by its number whether it is inside: from outside, every segment that is of the `outline` is the
    /// way in, or out.
    pub(super) fn inside(&self, outline: impl Fn([u32; 2]) -> bool) -> Vec<bool> {
        let mut inside: Vec<Option<bool>> = vec![None; self.cdt.num_all_faces()];
        let outer = self.cdt.outer_face();
        inside[outer.fix().index()] = Some(false);
        let mut front: VecDeque<_> = self.cdt.convex_hull().map(|edge| (edge.fix(), false)).collect();
        while let Some((edge, here)) = front.pop_front() {
            let edge = self.cdt.directed_edge(edge);
            let there = edge.rev().face();
            if inside[there.fix().index()].is_some() {
                continue;
            }
            let ends = edge.vertices().map(|v| v.fix().index() as u32);
            let now =
                here != (edge.is_constraint_edge() && outline([ends[0].min(ends[1]), ends[0].max(ends[1])]));
            inside[there.fix().index()] = Some(now);
            let start = edge.rev();
            front.extend([start.next(), start.prev()].map(|e| (e.fix(), now)));
        }
        inside.into_iter().map(|is| is.unwrap_or(false)).collect()
    }

    /// All triangles.
    pub(super) fn all_triangles(&self) -> Triangles {
        self.triangles(&vec![true; self.cdt.num_all_faces()])
    }

    /// The triangles for which `inside` is true, and how the faces are numbered among them.
    pub(super) fn triangles(&self, inside: &[bool]) -> Triangles {
        let mut number = vec![NONE; inside.len()];
        let faces = self.cdt.inner_faces().filter(|face| inside[face.fix().index()]);
        let faces: Vec<FixedFaceHandle<InnerTag>> = faces.map(|face| face.fix()).collect();
        for (k, face) in faces.iter().enumerate() {
            number[face.index()] = k as u32;
        }
        let mut triangles = Triangles::default();
        for &face in &faces {
            let edges = self.cdt.face(face).adjacent_edges();
            triangles.corners.push(edges.map(|edge| edge.from().fix().index() as u32));
            triangles.beyond.push(edges.map(|edge| number[edge.rev().face().fix().index()]));
            triangles.constrained.push(edges.map(|edge| edge.is_constraint_edge()));
        }
        triangles
    }

    /// The face that `point` is in, or on the border of, and its corners; `None` beyond all faces. `near` is a point
    /// close by.
    pub(super) fn locate(&self, point: DVec2, near: u32) -> Option<(usize, [u32; 3])> {
        use PositionInTriangulation::{NoTriangulation, OnEdge, OnFace, OnVertex, OutsideOfConvexHull};
        let near = FixedVertexHandle::from_index(near as usize);
        let face = match self.cdt.locate_with_hint(Point2::new(point.x, point.y), near) {
            OnFace(face) => Some(self.cdt.face(face)),
            OnEdge(edge) => {
                let edge = self.cdt.directed_edge(edge);
                edge.face().as_inner().or(edge.rev().face().as_inner())
            }
            OnVertex(v) => self.cdt.vertex(v).out_edges().find_map(|edge| edge.face().as_inner()),
            OutsideOfConvexHull(_) | NoTriangulation => None,
        }?;
        Some((face.fix().index(), face.vertices().map(|v| v.fix().index() as u32)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Silent;

    #[test]
    fn a_segment_along_others_touches_the_points_between() {
        let mut triangulation = Triangulation::new();
        let points = [[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [1.0, 1.0]];
        let ids = points.map(|p| triangulation.insert(p.into(), &Silent).unwrap());
        let mut constrain = |a: usize, b: usize| triangulation.constrain([ids[a], ids[b]], &Silent).unwrap();
        assert_eq!(constrain(0, 1), Outcome::Added);
        assert_eq!(constrain(0, 2), Outcome::Touches(ids[1]));
        assert_eq!(constrain(1, 0), Outcome::Exists);
        assert_eq!(constrain(3, 3), Outcome::Degenerate);
    }
}
