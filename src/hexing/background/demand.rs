//! Where a solid's boundary wants smaller cells (section 4.3; which sizes is the design's).
//!
//! | what | size of a cell there |
//! |---|---|
//! | a curved surface | so that it turns by the angle given along an edge |
//! | a thin wall, a narrow gap | half of it |
//! | a curve between corners | its length / 1.5 |
//! | a closed curve | its length / 6: a hole's rim is a hexagon at least |
//!
//! A size is met by the nearest level: cells of up to 1.4 times it will do. Where the boundary is curved more than even the
//! finest cells allow for, it gets these. Of the others, what even cells of twice the finest size would be too large for is
//! left alone: the core keeps or gives it up as it is.

use super::pieces::pieces;
use crate::geometry::{Firsts, Point};
use crate::mesh::{NodeId, PolygonMesh};
use crate::sizing::turn_per_length;
use crate::solid::SolidModel;
use crate::{Cancelled, Monitor, parallel};

/// Which sizes are asked for.
#[derive(Clone, Copy, Debug)]
pub(super) struct Demands {
    /// The edge length of level 0.
    pub edge_length: f64,
    /// Degrees that the surface may turn along an edge.
    pub curvature: Option<f64>,
    /// Ask for thin walls, gaps and short curves?
    pub details: bool,
    /// The finest level.
    pub finest: u8,
}

/// The cosine between the normals of two walls that face each other, at most.
const FACING: f64 = -0.5;

/// Of points that ask for cells of one level those that are the first in a cube of so many of their edges stand for all there:
/// much farther around them there are cells of that level.
const APART: f64 = 0.25;

impl Demands {
    /// For each level from 1 to the finest, the points of the boundary around which cells are to be of that level.
    pub fn points(&self, solid: &SolidModel, monitor: &dyn Monitor) -> Result<Vec<Vec<Point>>, Cancelled> {
        let turns = match self.curvature {
            Some(_) => turn_per_length(&surface_of(solid), monitor)?,
            None => Vec::new(),
        };
        let found = parallel::try_gather(solid.triangles().len(), monitor, |t, found| {
            let curved = self.curvature.map_or(f64::INFINITY, |angle| angle / turns[t]);
            let is_small = |piece: &[Point; 3]| {
                let [a, b, c] = *piece;
                a.distance(b).max(b.distance(c)).max(c.distance(a)) <= self.edge_length
            };
            pieces(solid.corners_of(t), is_small, &mut |[a, b, c]| {
                let at = (a + b + c) / 3.0;
                let room = if self.details { self.level_of_detail(self.room(solid, at, t)) } else { None };
                found.extend(self.level(curved).max(room).map(|level| (level, at)));
            });
        })?;
        let curves = solid.curves().iter().filter(|_| self.details).flat_map(|curve| {
            let level = self.level_of_detail(curve.length / if curve.ends.is_some() { 1.5 } else { 6.0 });
            let points = curve.vertices.iter().map(|&v| solid.points()[v as usize]);
            level.into_iter().flat_map(move |level| points.clone().map(move |at| (level, at)))
        });
        let mut by_level = vec![Vec::new(); usize::from(self.finest)];
        let edge = |level: u8| self.edge_length / f64::from(1u32 << level.min(31));
        let firsts = |level: u8| Firsts::new(solid.bounds().min, APART * edge(level));
        let mut firsts: Vec<Firsts> = (1..=self.finest).map(firsts).collect();
        for (level, at) in found.into_iter().chain(curves) {
            let level = usize::from(level) - 1;
            if firsts[level].is_first(at) {
                by_level[level].push(at);
            }
        }
        Ok(by_level)
    }

    /// Half of how thick the solid is at a point of its boundary, or of how narrow the gap beyond; infinite where that is
    /// no less than an edge.
    fn room(&self, solid: &SolidModel, at: Point, triangle: usize) -> f64 {
        let normal = solid.normals()[triangle];
        let across = |side: f64| {
            let probe = at + normal * (self.edge_length * side);
            let (distance, foot) = solid.signed_nearest(probe);
            let thickness = self.edge_length + distance * side;
            let faces = foot.normal.dot(normal) < FACING;
            if thickness < 1.99 * self.edge_length && faces { 0.5 * thickness } else { f64::INFINITY }
        };
        across(1.0).min(across(-1.0))
    }

    /// The level whose cells have about this size, or the finest if they are larger; `None` if that is 0.
    fn level(&self, size: f64) -> Option<u8> {
        let level = self.halvings(size).clamp(0.0, f64::from(self.finest)) as u8;
        (level > 0).then_some(level)
    }

    /// The same for what cells far larger do not show: `None` if it is far beyond the finest.
    fn level_of_detail(&self, size: f64) -> Option<u8> {
        self.level(size).filter(|_| self.halvings(size) <= f64::from(self.finest) + 1.0)
    }

    /// How often the edge length is to be halved for about this size.
    fn halvings(&self, size: f64) -> f64 {
        libm::log2(self.edge_length / size).round()
    }
}

/// The boundary as a surface whose curves are creases.
fn surface_of(solid: &SolidModel) -> PolygonMesh {
    let mut surface = PolygonMesh { positions: solid.points().to_vec(), ..Default::default() };
    solid.triangles().iter().for_each(|t| surface.push_face(t.map(NodeId)));
    let edges = solid.curves().iter().flat_map(|curve| curve.vertices.windows(2));
    surface.features.creases = edges.map(|edge| ([NodeId(edge[0]), NodeId(edge[1])], 1.0)).collect();
    surface
}

#[cfg(all(test, not(target_arch = "wasm32")))]
mod tests {
    use super::*;
    use crate::Silent;
    use crate::solid::testing::{cylinder, solid};

    /// However many triangles a surface has, as many points ask for smaller cells.
    #[test]
    fn few_points_stand_for_many_small_triangles() {
        let demands = Demands { edge_length: 0.5, curvature: Some(20.0), details: false, finest: 1 };
        let [few, many] = [200, 1600].map(|sides| {
            let by_level = demands.points(&solid(&cylinder(sides)), &Silent).unwrap();
            by_level[0].len()
        });
        assert!(few > 100 && many < 2 * few, "{few} {many}");
    }
}
