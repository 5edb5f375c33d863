//! What another try is to refine (design, section 5): where one failed, cells become a level finer.

use super::pieces::pieces;
use crate::geometry::Point;
use crate::sizing::{Region, Shape, Target};
use crate::solid::{CurveId, SolidModel, SurfaceId};

/// Something that a try missed.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    /// Points of it, no further apart than cells there.
    pub points: Vec<Point>,
    /// The level of the cells there; 0 in a plain grid.
    pub level: u8,
    /// What is missed there.
    pub missed: Missed,
}

/// What a try can miss.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Missed {
    /// A part of the solid, a surface or a curve was lost.
    Lost,
    /// Mesh and solid are too far from each other.
    Far,
}

impl Missed {
    /// How many cells around it are refined: what something lost borders on has to find room too.
    fn reach(self) -> f64 {
        match self {
            Self::Lost => 2.0,
            Self::Far => 1.0,
        }
    }
}

impl Failure {
    /// Something that was lost, among cells of a level.
    pub fn of_lost(points: Vec<Point>, level: u8) -> Self {
        Self { points, level, missed: Missed::Lost }
    }

    /// A place where mesh and solid are too far from each other, among cells of a level.
    pub fn of_far(place: Point, level: u8) -> Self {
        Self { points: vec![place], level, missed: Missed::Far }
    }

    /// A curve that was lost among cells of a level and an edge length.
    pub fn of_curve(solid: &SolidModel, curve: CurveId, level: u8, edge_length: f64) -> Self {
        let vertices = &solid.curves()[curve.index()].vertices;
        let mut points = Vec::new();
        for edge in vertices.windows(2) {
            let [a, b] = [edge[0], edge[1]].map(|v| solid.points()[v as usize]);
            let steps = (a.distance(b) / edge_length).ceil().max(1.0) as u32;
            points.extend((0..steps).map(|k| a.lerp(b, f64::from(k) / f64::from(steps))));
        }
        points.extend(vertices.last().map(|&v| solid.points()[v as usize]));
        Self::of_lost(points, level)
    }

    /// A surface that was lost among cells of a level and an edge length.
    pub fn of_surface(solid: &SolidModel, surface: SurfaceId, level: u8, edge_length: f64) -> Self {
        let mut points = Vec::new();
        let is_small =
            |&[a, b, c]: &[Point; 3]| a.distance(b).max(b.distance(c)).max(c.distance(a)) <= edge_length;
        for &t in &solid.surfaces()[surface.index()].triangles {
            let corners = solid.corners_of(t as usize);
            pieces(corners, is_small, &mut |[a, b, c]| points.push((a + b + c) / 3.0));
        }
        Self::of_lost(points, level)
    }
}

/// Where another try is to refine, and how far: a level more around each failure, but none beyond the `finest`. Levels count
/// from the grid's cells, whose edges have this length.
pub fn retry(failures: &[Failure], edge_length: f64, finest: u8) -> Vec<Region> {
    let mut regions = Vec::new();
    for (level, missed) in (0..finest).flat_map(|level| [(level, Missed::Lost), (level, Missed::Far)]) {
        let alike = failures.iter().filter(|failure| failure.level == level && failure.missed == missed);
        let points: Vec<Point> = alike.flat_map(|failure| failure.points.iter().copied()).collect();
        if !points.is_empty() {
            let radius = missed.reach() * edge_length / f64::from(1u32 << level.min(31));
            let shape = Shape::Points { points, radius };
            regions.push(Region { shape, target: Target::Level(level + 1) });
        }
    }
    regions
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::solid::testing::{cylinder, solid};

    #[test]
    fn failures_of_a_level_ask_for_the_next_until_the_finest() {
        let at = |x: f64, level| Failure::of_lost(vec![Point::X * x], level);
        let far = Failure::of_far(Point::X * 5.0, 0);
        let asked = retry(&[at(1.0, 0), at(2.0, 2), at(3.0, 1), at(4.0, 0), far], 0.5, 2);
        let points = |xs: &[f64], radius, level| Region {
            shape: Shape::Points { points: xs.iter().map(|&x| Point::X * x).collect(), radius },
            target: Target::Level(level),
        };
        assert_eq!(asked, [points(&[1.0, 4.0], 1.0, 1), points(&[5.0], 0.5, 1), points(&[3.0], 0.5, 2)]);
    }

    #[test]
    fn a_curve_is_lost_all_along() {
        let solid = solid(&cylinder(6));
        for k in 0..solid.curves().len() as u32 {
            let lost = Failure::of_curve(&solid, CurveId(k), 0, 0.3);
            assert!(lost.points.windows(2).all(|pair| pair[0].distance(pair[1]) <= 0.3 + 1e-12));
            assert!(lost.points.iter().all(|&p| solid.nearest_on_curve(CurveId(k), p).distance < 1e-12));
        }
    }

    #[test]
    fn a_surface_is_lost_all_over() {
        let solid = solid(&cylinder(6));
        for k in 0..solid.surfaces().len() as u32 {
            let lost = Failure::of_surface(&solid, SurfaceId(k), 0, 0.3);
            assert!(lost.points.iter().all(|&p| solid.nearest_on_surface(SurfaceId(k), p).distance < 1e-12));
            let near = |p: Point| lost.points.iter().any(|q| q.distance(p) <= 0.3);
            let corners = solid.surfaces()[k as usize].triangles.iter();
            assert!(corners.flat_map(|&t| solid.corners_of(t as usize)).all(near));
        }
    }
}
