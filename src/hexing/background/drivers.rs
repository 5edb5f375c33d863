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
}

impl Failure {
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
        Self { points, level }
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
        Self { points, level }
    }
}

/// What another try is to refine.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Retry {
    /// Where it is to refine, and how far; levels count from the grid's cells.
    pub regions: Vec<Region>,
    /// Failures, by their place in the list, that are as fine as may be: to be reported.
    pub given_up: Vec<usize>,
}

/// How many cells around a failure are refined.
const BAND: f64 = 2.0;

/// Asks for one level more around each failure, but for none beyond the `finest`. `edge_length` is that of level 0.
pub fn retry(failures: &[Failure], edge_length: f64, finest: u8) -> Retry {
    let mut retry = Retry::default();
    for level in 0..finest {
        let of_level = failures.iter().filter(|failure| failure.level == level);
        let points: Vec<Point> = of_level.flat_map(|failure| failure.points.iter().copied()).collect();
        if !points.is_empty() {
            let radius = BAND * edge_length / f64::from(1u32 << level.min(31));
            let shape = Shape::Points { points, radius };
            retry.regions.push(Region { shape, target: Target::Level(level + 1) });
        }
    }
    retry.given_up = (0..failures.len()).filter(|&k| failures[k].level >= finest).collect();
    retry
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::solid::testing::{cylinder, solid};

    #[test]
    fn failures_of_a_level_ask_for_the_next_until_the_finest() {
        let at = |x: f64, level| Failure { points: vec![Point::X * x], level };
        let asked = retry(&[at(1.0, 0), at(2.0, 2), at(3.0, 1), at(4.0, 0)], 0.5, 2);
        assert_eq!(asked.given_up, [1]);
        let points = |xs: &[f64], radius, level| Region {
            shape: Shape::Points { points: xs.iter().map(|&x| Point::X * x).collect(), radius },
            target: Target::Level(level),
        };
        assert_eq!(asked.regions, [points(&[1.0, 4.0], 1.0, 1), points(&[3.0], 0.5, 2)]);
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
