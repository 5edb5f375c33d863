//! The point of a surface that is nearest to another point.

use super::{Aabb, Point, closest_on_triangle};
use crate::{Cancelled, Monitor, Silent};

/// A leaf of the tree has at most this many triangles.
const LEAF: usize = 4;

/// The monitor is asked before more triangles than this are split.
const MANY: usize = 1 << 14;

/// More levels than a tree of 2^32 triangles has, which are split in halves.
const DEPTH: usize = 48;

/// Finds, among many triangles, the one that is nearest to a point: a tree of boxes, split in halves along their longest
/// side. General R-trees keep a heap for each question, and take several times as long; optimisation asks millions.
#[derive(Debug)]
pub struct NearestTriangle {
    /// The root first, each branch before its halves.
    nodes: Vec<Node>,
    /// In the order of the tree.
    triangles: Vec<Triangle>,
}

/// A triangle by its corners, and its place in the order in which the triangles were given.
#[derive(Clone, Debug)]
struct Triangle {
    corners: [Point; 3],
    index: u32,
}

#[derive(Clone, Copy, Debug)]
struct Node {
    bounds: Aabb,
    below: Below,
}

#[derive(Clone, Copy, Debug)]
enum Below {
    /// The left half is the next node; where the right one is.
    Right(u32),
    /// The first triangle, and how many there are.
    Leaf(u32, u32),
}

/// The triangle that is nearest to a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Nearest {
    /// Its place in the order in which the triangles were given.
    pub triangle: usize,
    /// Its point that is closest.
    pub point: Point,
}

impl NearestTriangle {
    /// An index of triangles with finite corners.
    ///
    /// # Panics
    /// If there are more than 2^32 triangles.
    pub fn new(triangles: impl IntoIterator<Item = [Point; 3]>) -> Self {
        Self::within(triangles, &Silent).expect("nobody stops it")
    }

    /// As [`new`](Self::new), told by a monitor when to stop.
    ///
    /// # Errors
    /// If the monitor stops it.
    ///
    /// # Panics
    /// As [`new`](Self::new).
    pub fn within(
        triangles: impl IntoIterator<Item = [Point; 3]>,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let numbered = triangles.into_iter().enumerate().map(|(index, corners)| Triangle {
            corners,
            index: u32::try_from(index).expect("more than 2^32 triangles"),
        });
        let mut all = Self { nodes: Vec::new(), triangles: numbered.collect() };
        let mut triangles = std::mem::take(&mut all.triangles);
        if !triangles.is_empty() {
            all.branch(&mut triangles, 0, monitor)?;
        }
        Ok(Self { triangles, ..all })
    }

    /// Adds the nodes of these triangles, which are those from `first` on.
    fn branch(
        &mut self,
        triangles: &mut [Triangle],
        first: usize,
        monitor: &dyn Monitor,
    ) -> Result<(), Cancelled> {
        if triangles.len() > MANY {
            monitor.proceed()?;
        }
        let bounds = Aabb::around(triangles.iter().flat_map(|t| &t.corners));
        let place = self.nodes.len();
        self.nodes.push(Node { bounds, below: Below::Leaf(first as u32, triangles.len() as u32) });
        if triangles.len() <= LEAF {
            return Ok(());
        }
        let size = bounds.size();
        let axis = (1..3).fold(0, |longest, axis| if size[axis] > size[longest] { axis } else { longest });
        let middle = |t: &Triangle| t.corners.iter().map(|p| p[axis]).sum::<f64>();
        let half = triangles.len() / 2;
        triangles
            .select_nth_unstable_by(half, |a, b| middle(a).total_cmp(&middle(b)).then(a.index.cmp(&b.index)));
        let (left, right) = triangles.split_at_mut(half);
        self.branch(left, first, monitor)?;
        self.nodes[place].below = Below::Right(self.nodes.len() as u32);
        self.branch(right, first + half, monitor)
    }

    /// The triangle that is nearest to `p`, the first of those that are equally near; `None` if there are no triangles.
    pub fn nearest(&self, p: Point) -> Option<Nearest> {
        let mut best: Option<(f64, u32, Point)> = None;
        let mut waiting = [(0.0, 0); DEPTH];
        let mut count = usize::from(!self.nodes.is_empty());
        while count > 0 {
            count -= 1;
            let (distance, mut at) = waiting[count];
            if best.is_some_and(|(nearest, ..)| distance > nearest) {
                continue;
            }
            // Down to the nearer half each time, while the other waits.
            while let Below::Right(right) = self.nodes[at as usize].below {
                let mut halves =
                    [at + 1, right].map(|k| (self.nodes[k as usize].bounds.distance_squared(p), k));
                if halves[1].0 < halves[0].0 {
                    halves.swap(0, 1);
                }
                waiting[count] = halves[1];
                count += 1;
                at = halves[0].1;
            }
            let Below::Leaf(first, len) = self.nodes[at as usize].below else { continue };
            for triangle in &self.triangles[first as usize..(first + len) as usize] {
                let point = closest_on_triangle(p, triangle.corners);
                let distance = point.distance_squared(p);
                let is_nearer = |(nearest, index, _): (f64, u32, Point)| {
                    distance < nearest || distance == nearest && triangle.index < index
                };
                if best.is_none_or(is_nearer) {
                    best = Some((distance, triangle.index, point));
                }
            }
        }
        best.map(|(_, index, point)| Nearest { triangle: index as usize, point })
    }

    /// The point of a triangle that is closest to `p`; `None` if there are no triangles.
    pub fn closest_point(&self, p: Point) -> Option<Point> {
        self.nearest(p).map(|nearest| nearest.point)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A zigzag of triangles over the unit square, `n` times `n` pairs.
    fn sheet(n: usize) -> Vec<[Point; 3]> {
        let at = |i: usize, j: usize| {
            let [x, y] = [i, j].map(|k| k as f64 / n as f64);
            Point::new(x, y, if (i + j).is_multiple_of(2) { 0.0 } else { 0.1 })
        };
        let cell =
            |i, j| [[at(i, j), at(i + 1, j), at(i, j + 1)], [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]];
        (0..n * n).flat_map(|k| cell(k % n, k / n)).collect()
    }

    #[test]
    fn the_tree_finds_what_a_walk_over_all_finds() {
        let triangles = sheet(9);
        let index = NearestTriangle::new(triangles.iter().copied());
        for k in 0..200 {
            let p = Point::new(
                f64::from(k % 7) / 4.0 - 0.3,
                f64::from(k % 11) / 7.0 - 0.2,
                f64::from(k % 5) - 2.0,
            );
            let walked = triangles
                .iter()
                .map(|t| closest_on_triangle(p, *t).distance(p))
                .fold(f64::INFINITY, f64::min);
            let nearest = index.nearest(p).unwrap();
            assert_eq!(nearest.point.distance(p), walked, "{p}");
            assert_eq!(closest_on_triangle(p, triangles[nearest.triangle]), nearest.point, "{p}");
        }
    }

    #[test]
    fn the_first_of_equal_triangles_is_found() {
        let twice: Vec<[Point; 3]> = sheet(5).into_iter().chain(sheet(5)).collect();
        let index = NearestTriangle::new(twice.iter().copied());
        for t in &twice[..50] {
            let found = index.nearest((t[0] + t[1] + t[2]) / 3.0).unwrap();
            assert_eq!(twice[found.triangle], *t);
            assert!(found.triangle < 50);
        }
    }

    #[test]
    fn no_triangles_have_no_nearest_point() {
        assert_eq!(NearestTriangle::new([]).closest_point(Point::ZERO), None);
    }

    #[cfg(not(target_arch = "wasm32"))]
    mod random {
        use proptest::prelude::*;

        use super::*;
        use crate::geometry::samples::{point, points};

        proptest! {
            #[test]
            fn the_closest_point_agrees_with_a_search_of_all(
                triangles in prop::collection::vec(points::<3>(1.0), 1..60), p in point(2.0),
            ) {
                let found = NearestTriangle::new(triangles.iter().copied()).closest_point(p).unwrap();
                let distances = triangles.iter().map(|t| closest_on_triangle(p, *t).distance(p));
                prop_assert_eq!(found.distance(p), distances.fold(f64::INFINITY, f64::min));
            }
        }
    }
}
