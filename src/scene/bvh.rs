//! Which face a ray meets first: a packed tree of boxes over faces sorted along a space-filling curve.
//!
//! 1. Faces are sorted by the Morton code of their middle, so that neighbours in the array are
//!    neighbours in space.
//! 2. Level 0 holds a box around each [`WIDTH`] consecutive faces, each further level a box around
//!    each `WIDTH` boxes of the level below, up to a single one.
//! 3. A ray walks the tree nearest box first and tests the triangles of the faces it comes to.
//!
//! The tree takes about 8 bytes a face and is built in one sort.

use glam::{DVec3, Vec3};

use super::{Ray, Surface};
use crate::geometry::{Point, triangulate};

/// Children of a box. Wide and shallow: few boxes, and they are read in runs.
const WIDTH: usize = 8;

/// Room around a box, in scene units: rounding must not lose a face on its side.
const ROUNDING: f64 = 1e-7;

/// A tree over the faces of one surface.
#[derive(Clone, Debug)]
pub struct Bvh {
    /// Faces in the order of their middles along the curve.
    order: Vec<u32>,
    /// Boxes of each level, from the faces up.
    levels: Vec<Vec<Bounds>>,
}

/// Where a ray meets a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The face.
    pub face: usize,
    /// The point, in world coordinates.
    pub point: Point,
    /// Distance from the ray's origin, in world units.
    pub distance: f64,
}

#[derive(Clone, Copy, Debug)]
struct Bounds {
    min: Vec3,
    max: Vec3,
}

impl Bounds {
    const EMPTY: Self = Self { min: Vec3::INFINITY, max: Vec3::NEG_INFINITY };

    fn with(self, p: Vec3) -> Self {
        Self { min: self.min.min(p), max: self.max.max(p) }
    }

    fn union(self, other: &Self) -> Self {
        Self { min: self.min.min(other.min), max: self.max.max(other.max) }
    }

    /// Where the ray enters the box, if it does so before `limit`. (Slab test; `inverse` is 1 over the
    /// direction.)
    fn entry(&self, origin: DVec3, inverse: DVec3, limit: f64) -> Option<f64> {
        let a = (self.min.as_dvec3() - ROUNDING - origin) * inverse;
        let b = (self.max.as_dvec3() + ROUNDING - origin) * inverse;
        let near = a.min(b).max_element().max(0.0);
        let far = a.max(b).min_element();
        (near <= far && near <= limit).then_some(near)
    }
}

impl Bvh {
    /// The tree of a surface.
    pub fn new(surface: &Surface) -> Self {
        let boxes: Vec<Bounds> = (0..surface.face_count()).map(|f| face_bounds(surface, f)).collect();
        let order = curve_order(&boxes);
        let mut levels = vec![group(&order, |&f| boxes[f as usize])];
        while levels.last().is_some_and(|l| l.len() > 1) {
            let above = group(&levels[levels.len() - 1], |b| *b);
            levels.push(above);
        }
        Self { order, levels }
    }

    /// The first face of `surface` (the one that the tree was made of) that `ray` meets, from either
    /// side.
    pub fn first_hit(&self, surface: &Surface, ray: &Ray) -> Option<Hit> {
        let frame = surface.frame();
        let origin = frame.scene_f64(ray.origin);
        // Finite where the direction is 0: infinity times a distance of 0 would be no number.
        let inverse = ray.direction.recip().clamp(DVec3::splat(-f64::MAX), DVec3::splat(f64::MAX));
        let mut best: Option<(f64, u32)> = None;
        let mut corners = Vec::new();
        let mut triangles = Vec::new();
        let top = self.levels.len() - 1;
        let mut stack: Vec<(f64, usize, usize)> =
            (0..self.levels[top].len()).map(|i| (0.0, top, i)).collect();
        while let Some((entry, level, index)) = stack.pop() {
            let limit = best.map_or(f64::INFINITY, |b| b.0);
            if entry > limit {
                continue;
            }
            if level > 0 {
                let below = &self.levels[level - 1];
                let first = stack.len();
                for (child, bounds) in below.iter().enumerate().skip(index * WIDTH).take(WIDTH) {
                    stack.extend(bounds.entry(origin, inverse, limit).map(|t| (t, level - 1, child)));
                }
                stack[first..].sort_by(|a, b| b.0.total_cmp(&a.0));
                continue;
            }
            for &face in &self.order[index * WIDTH..((index + 1) * WIDTH).min(self.order.len())] {
                surface.face_points(face as usize, &mut corners);
                triangles.clear();
                triangulate(&corners, &mut triangles);
                for t in &triangles {
                    let limit = best.map_or(f64::INFINITY, |b| b.0);
                    let met = meet(origin, ray.direction, t.map(|c| corners[c as usize]));
                    if let Some(distance) = met.filter(|&d| d < limit) {
                        best = Some((distance, face));
                    }
                }
            }
        }
        best.map(|(distance, face)| Hit {
            face: face as usize,
            point: frame.world(origin + ray.direction * distance),
            distance: distance / frame.scale,
        })
    }
}

fn face_bounds(surface: &Surface, face: usize) -> Bounds {
    let positions = surface.positions();
    surface.face(face).iter().fold(Bounds::EMPTY, |b, &n| b.with(positions[n as usize]))
}

fn group<T>(items: &[T], bounds: impl Fn(&T) -> Bounds) -> Vec<Bounds> {
    items.chunks(WIDTH).map(|run| run.iter().fold(Bounds::EMPTY, |b, item| b.union(&bounds(item)))).collect()
}

/// Face ids sorted along a Morton curve through the boxes' middles, 10 bits an axis.
fn curve_order(boxes: &[Bounds]) -> Vec<u32> {
    let all = boxes.iter().fold(Bounds::EMPTY, |b, c| b.union(c));
    let scale = 1023.0 / (all.max - all.min).max(Vec3::splat(f32::MIN_POSITIVE));
    let mut keys: Vec<u64> = boxes
        .iter()
        .enumerate()
        .map(|(face, b)| {
            let cell = ((b.min.midpoint(b.max) - all.min) * scale).as_uvec3();
            let code = spread(cell.x) | spread(cell.y) << 1 | spread(cell.z) << 2;
            u64::from(code) << 32 | face as u64
        })
        .collect();
    keys.sort_unstable();
    keys.iter().map(|&k| k as u32).collect()
}

/// The low ten bits of `v`, two zeros between any two of them.
fn spread(v: u32) -> u32 {
    let v = (v | v << 16) & 0x0300_00ff;
    let v = (v | v << 8) & 0x0300_f00f;
    let v = (v | v << 4) & 0x030c_30c3;
    (v | v << 2) & 0x0924_9249
}

/// Distance at which the ray meets a triangle (Möller and Trumbore 1997).
fn meet(origin: DVec3, direction: DVec3, [a, b, c]: [DVec3; 3]) -> Option<f64> {
    let (ab, ac) = (b - a, c - a);
    let p = direction.cross(ac);
    let determinant = ab.dot(p);
    if determinant == 0.0 {
        return None;
    }
    let inverse = determinant.recip();
    let s = origin - a;
    let u = s.dot(p) * inverse;
    let q = s.cross(ab);
    let v = direction.dot(q) * inverse;
    let t = ac.dot(q) * inverse;
    // A hair of slack, so that no ray slips between two triangles.
    const SLACK: f64 = 1e-9;
    (u >= -SLACK && v >= -SLACK && u + v <= 1.0 + SLACK && t >= 0.0).then_some(t)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `n` by `n` quads over the unit square, bumped by a wave.
    fn grid(n: u32, height: impl Fn(f64, f64) -> f64) -> Surface {
        let mut coordinates = Vec::new();
        for j in 0..=n {
            for i in 0..=n {
                let (x, y) = (f64::from(i) / f64::from(n), f64::from(j) / f64::from(n));
                coordinates.extend([x, y, height(x, y)]);
            }
        }
        let at = |i, j| j * (n + 1) + i;
        let corners = (0..n)
            .flat_map(|j| (0..n).flat_map(move |i| [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]))
            .collect();
        Surface::new(&coordinates, None, corners).unwrap()
    }

    #[test]
    fn rays_down_hit_the_quad_below_them() {
        let n = 37;
        let surface = grid(n, |x, y| 0.1 * (7.0 * x).sin() * (5.0 * y).cos());
        let tree = Bvh::new(&surface);
        for j in 0..n {
            for i in 0..n {
                let (x, y) = ((f64::from(i) + 0.4) / f64::from(n), (f64::from(j) + 0.7) / f64::from(n));
                let ray = Ray { origin: Point::new(x, y, 3.0), direction: DVec3::NEG_Z };
                let hit = tree.first_hit(&surface, &ray).expect("a hit");
                assert_eq!(hit.face as u32, j * n + i);
                assert!((hit.point.x - x).abs() < 1e-6 && (hit.distance - (3.0 - hit.point.z)).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn rays_on_nodes_and_edges_of_a_plane_hit() {
        let surface = grid(8, |_, _| 0.0);
        let tree = Bvh::new(&surface);
        for k in 0..=16 {
            let at = f64::from(k) / 16.0;
            for (x, y) in [(at, 0.5), (0.5, at), (at, at)] {
                let ray = Ray { origin: Point::new(x, y, 1.0), direction: DVec3::NEG_Z };
                assert!(tree.first_hit(&surface, &ray).is_some(), "{x} {y}");
            }
        }
        let past = Ray { origin: Point::new(1.01, 0.5, 1.0), direction: DVec3::NEG_Z };
        assert_eq!(tree.first_hit(&surface, &past), None);
        let behind = Ray { origin: Point::new(0.5, 0.5, -1.0), direction: DVec3::NEG_Z };
        assert_eq!(tree.first_hit(&surface, &behind), None);
    }

    #[test]
    fn the_nearest_of_two_sheets_is_hit() {
        let coordinates = [0., 0., 0., 1., 0., 0., 0., 1., 0., 0., 0., 1., 1., 0., 1., 0., 1., 1.];
        let surface = Surface::new(&coordinates, Some(vec![0, 3, 6]), vec![0, 1, 2, 3, 4, 5]).unwrap();
        let tree = Bvh::new(&surface);
        let mut ray = Ray { origin: Point::new(0.2, 0.2, 5.0), direction: DVec3::NEG_Z };
        assert_eq!(tree.first_hit(&surface, &ray).map(|h| h.face), Some(1));
        ray = Ray { origin: Point::new(0.2, 0.2, -5.0), direction: DVec3::Z };
        assert_eq!(tree.first_hit(&surface, &ray).map(|h| h.face), Some(0));
    }

    #[test]
    fn nothing_is_hit_in_an_empty_surface() {
        let surface = Surface::new(&[], None, vec![]).unwrap();
        let ray = Ray { origin: Point::ZERO, direction: DVec3::Z };
        assert_eq!(Bvh::new(&surface).first_hit(&surface, &ray), None);
    }
}
