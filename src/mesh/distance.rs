//! How far a mesh and a surface are from each other.

use serde::Serialize;

use super::samples::{Quads, Sampled, Triangles};
use super::topology::hex_boundary;
use super::{HexMesh, NodeId};
use crate::geometry::{CutQuad, Point};
use crate::monitor::Part;
use crate::{Cancelled, Monitor, Stage, parallel};

/// The stage that a monitor hears of.
const MEASURING: Stage = Stage("distance");

/// Samples between two questions to the monitor.
const BATCH: usize = 1 << 14;

/// Distances both ways: small one way alone may mean that the mesh covers but a part of the surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Distances {
    /// From samples of the mesh to the surface.
    pub mesh_to_surface: Distance,
    /// From samples of the surface to the mesh.
    pub surface_to_mesh: Distance,
}

/// Distances of samples of one surface to another: of its nodes, of points along its sides and of points in its faces, such
/// that they are no farther from each other than about an edge of the mesh. What is no more than rounding makes is 0.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub struct Distance {
    /// The greatest.
    pub max: f64,
    /// The mean.
    pub mean: f64,
    /// Root of the mean square.
    pub rms: f64,
    /// The sample of the greatest distance.
    pub farthest: [f64; 3],
    /// How many samples there are.
    pub samples: usize,
}

impl Distances {
    /// Measures; both surfaces have triangles with finite corners.
    ///
    /// # Errors
    /// [`Cancelled`] when the monitor says so.
    pub fn between(
        mesh: Triangles<'_>,
        surface: Triangles<'_>,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        Self::of_sampled(mesh, surface, monitor)
    }

    /// The same, of a mesh with quads at its boundary.
    ///
    /// # Errors
    /// [`Cancelled`] when the monitor says so.
    pub fn of_quads(
        mesh: Quads<'_>,
        surface: Triangles<'_>,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        Self::of_sampled(mesh, surface, monitor)
    }

    fn of_sampled(
        mesh: impl Sampled,
        surface: Triangles<'_>,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let search = surface.search(monitor)?;
        Ok(Self::with_samples_beyond(f64::INFINITY, mesh, (surface, &|p| search.distance(p)), monitor)?.0)
    }

    /// The same, with the samples that are more than `limit` from the other surface: those of the mesh, then those of the
    /// surface, of which it is known at what `distance` it is from a point.
    pub(crate) fn with_samples_beyond(
        limit: f64,
        mesh: impl Sampled,
        (surface, distance): (Triangles<'_>, &(dyn Fn(Point) -> f64 + Sync)),
        monitor: &dyn Monitor,
    ) -> Result<(Self, Vec<Point>), Cancelled> {
        let half = |range| Part { whole: monitor, stage: MEASURING, range };
        monitor.checkpoint(MEASURING, 0.0)?;
        let edge = mesh.mean_side();
        let (mesh_to_surface, mut beyond) =
            Measured::of(mesh, edge, limit, distance, &half([0.0, 0.5]))?.told();
        let (surface_to_mesh, of_surface) =
            Measured::from(surface, mesh, edge, limit, &half([0.5, 1.0]))?.told();
        monitor.progress(MEASURING, 1.0);
        beyond.extend(of_surface);
        Ok((Self { mesh_to_surface, surface_to_mesh }, beyond))
    }

    /// Those of surfaces without a sample.
    pub(crate) fn none() -> Self {
        Self { mesh_to_surface: Distance::none(), surface_to_mesh: Distance::none() }
    }

    /// Those of two pairs of surfaces together.
    pub(crate) fn joined(&self, other: &Self) -> Self {
        Self {
            mesh_to_surface: self.mesh_to_surface.joined(&other.mesh_to_surface),
            surface_to_mesh: self.surface_to_mesh.joined(&other.surface_to_mesh),
        }
    }

    /// The greater of the greatest distances both ways, the Hausdorff distance of the samples.
    pub fn hausdorff(&self) -> f64 {
        self.mesh_to_surface.max.max(self.surface_to_mesh.max)
    }

    /// The sample that is as far as that.
    pub(crate) fn farthest(&self) -> Point {
        let [mesh, surface] = [&self.mesh_to_surface, &self.surface_to_mesh];
        Point::from(if surface.max > mesh.max { surface.farthest } else { mesh.farthest })
    }
}

/// How far a surface is from a mesh with quads at its boundary, at most: at samples that are no farther from each other than
/// about a `step`.
///
/// # Errors
/// [`Cancelled`] when the monitor says so.
pub(crate) fn farthest_from_quads(
    surface: Triangles<'_>,
    mesh: Quads<'_>,
    step: f64,
    monitor: &dyn Monitor,
) -> Result<f64, Cancelled> {
    monitor.checkpoint(MEASURING, 0.0)?;
    let far = Measured::from(surface, mesh, step, f64::INFINITY, monitor)?.max;
    monitor.checkpoint(MEASURING, 1.0)?;
    Ok(far)
}

/// For each hex how far its boundary faces are from a surface: the greatest distance of their nodes and
/// of the middles of their sides and diagonals, in model units. NaN for hexes without boundary faces, or if the surface is empty.
///
/// # Errors
/// [`Cancelled`] when the monitor says so.
pub fn distances_of_hexes(
    mesh: &HexMesh,
    surface: Triangles<'_>,
    monitor: &dyn Monitor,
) -> Result<Vec<f32>, Cancelled> {
    let nearest = surface.search(monitor)?;
    let boundary = hex_boundary(&mesh.hexes);
    let distance = |p: Point| nearest.closest_point(p).map_or(f64::NAN, |q| q.distance(p));
    let farthest = |quad: &[NodeId; 4]| {
        let corners = quad.map(|n| mesh.positions[n.index()]);
        let sides = (0..4).map(|k| corners[k].midpoint(corners[(k + 1) % 4]));
        let places = corners.into_iter().chain(sides).chain(CutQuad(corners).middles());
        places.map(distance).fold(f64::NAN, f64::max)
    };
    let mut distances = vec![f32::NAN; mesh.hexes.len()];
    for (number, batch) in boundary.chunks(BATCH).enumerate() {
        monitor.checkpoint(MEASURING, (number * BATCH) as f64 / boundary.len() as f64)?;
        let of_faces = parallel::collect(batch.len(), |k| farthest(&batch[k].0));
        for (&(_, hex), of_face) in batch.iter().zip(of_faces) {
            let of_hex = &mut distances[hex.index()];
            *of_hex = of_hex.max(of_face as f32);
        }
    }
    Ok(distances)
}

/// What is known of the distances of samples.
struct Measured {
    max: f64,
    sum: f64,
    squares: f64,
    farthest: Point,
    samples: usize,
    /// Those that are farther than the limit.
    beyond: Vec<Point>,
}

impl Measured {
    /// Measures at what `distance` another surface is from samples of one.
    fn of(
        sampled: impl Sampled,
        edge: f64,
        limit: f64,
        distance: &(dyn Fn(Point) -> f64 + Sync),
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let [max, sum, squares] = [0.0; 3];
        let mut all = Self { max, sum, squares, farthest: Point::ZERO, samples: 0, beyond: Vec::new() };
        let mut take = |batch: &[Point], done: f64| {
            for (&p, d) in batch.iter().zip(parallel::collect(batch.len(), |k| distance(batch[k]))) {
                (all.sum, all.squares) = (all.sum + d, all.squares + d * d);
                if d >= all.max {
                    (all.max, all.farthest) = (d, p);
                }
                if d > limit {
                    all.beyond.push(p);
                }
            }
            all.samples += batch.len();
            monitor.progress(MEASURING, done);
        };
        sampled.sample(edge, monitor, &mut take)?;
        Ok(all)
    }

    /// The same, of a surface and a mesh.
    fn from(
        surface: Triangles<'_>,
        mesh: impl Sampled,
        edge: f64,
        limit: f64,
        monitor: &dyn Monitor,
    ) -> Result<Self, Cancelled> {
        let nearest = mesh.search(monitor)?;
        Self::of(surface, edge, limit, &|p| nearest.distance(p), monitor)
    }

    /// The distance, and the samples beyond the limit.
    fn told(self) -> (Distance, Vec<Point>) {
        let count = self.samples as f64;
        let distance = Distance {
            max: self.max,
            mean: self.sum / count,
            rms: (self.squares / count).sqrt(),
            farthest: self.farthest.to_array(),
            samples: self.samples,
        };
        (distance, self.beyond)
    }
}

impl Distance {
    fn none() -> Self {
        Self { max: 0.0, mean: 0.0, rms: 0.0, farthest: [0.0; 3], samples: 0 }
    }

    /// That of both sets of samples together.
    fn joined(&self, other: &Self) -> Self {
        if self.samples == 0 {
            return other.clone();
        }
        let samples = self.samples + other.samples;
        let together = |a: f64, b: f64| (a * self.samples as f64 + b * other.samples as f64) / samples as f64;
        let farther = if other.max > self.max { other } else { self };
        Self {
            max: farther.max,
            mean: together(self.mean, other.mean),
            rms: together(self.rms * self.rms, other.rms * other.rms).sqrt(),
            farthest: farther.farthest,
            samples,
        }
    }

    /// In a line.
    pub fn in_words(&self) -> String {
        let [x, y, z] = self.farthest;
        format!("mean {:.6e}, rms {:.6e}, greatest {:.6e} at {x}, {y}, {z}", self.mean, self.rms, self.max)
    }
}

#[cfg(test)]
mod tests {
    use std::sync::Mutex;

    use super::*;
    use crate::Silent;
    use crate::geometry::Aabb;
    use crate::mesh::{GridOptions, hex_grid};

    /// The corners of a right triangle of legs 3 in the plane at height `z`, and a point that it does not use.
    fn corners(z: f64) -> [Point; 4] {
        [[0.0, 0.0], [3.0, 0.0], [0.0, 3.0], [9.0, 9.0]].map(|[x, y]| Point::new(x, y, z))
    }

    fn between(mesh: &[Point], surface: &[Point]) -> Distances {
        let triangle = |positions| Triangles { positions, triangles: &[[0, 1, 2]] };
        Distances::between(triangle(mesh), triangle(surface), &Silent).unwrap()
    }

    #[test]
    fn of_parallel_triangles() {
        let distances = between(&corners(0.0), &corners(2.0));
        let Distance { max, mean, rms, farthest, samples } = distances.mesh_to_surface;
        // At the corners, twice on the legs and four times on the longest side, in the middle and in the two halves.
        assert_eq!((max, mean, rms, farthest[2], samples), (2.0, 2.0, 2.0, 0.0, 14));
        assert_eq!(distances.hausdorff(), 2.0);
    }

    #[test]
    fn of_hexes_at_the_boundary_alone() {
        let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 100 };
        let block = hex_grid(Aabb { min: Point::ZERO, max: Point::splat(3.0) }, &options).unwrap();
        let floor = corners(-0.5);
        let surface = Triangles { positions: &floor, triangles: &[[0, 1, 2]] };
        let distances = distances_of_hexes(&block, surface, &Silent).unwrap();
        // The corner under the triangle's right angle, and the one in the middle, which has no boundary face.
        assert_eq!(distances[0], 1.5);
        assert_eq!(distances.iter().filter(|d| d.is_nan()).count(), 1);
        assert!(distances[13].is_nan());
    }

    /// Hears what is told.
    #[derive(Default)]
    struct Hearing(Mutex<Vec<f64>>);

    impl Monitor for Hearing {
        fn progress(&self, stage: Stage, fraction: f64) {
            assert_eq!(stage, MEASURING);
            self.0.lock().unwrap().push(fraction);
        }
        fn cancelled(&self) -> bool {
            false
        }
    }

    /// Of a square of many small triangles, whose nodes, sides and faces are some batches of samples.
    #[test]
    fn progress_rises_in_small_steps() {
        let at = |x: u32, y: u32| y * 101 + x;
        let squares = (0..100u32).flat_map(|y| (0..100u32).map(move |x| [x, y]));
        let triangles: Vec<[u32; 3]> = squares
            .flat_map(|[x, y]| {
                let [a, b, c, d] = [at(x, y), at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)];
                [[a, b, c], [a, c, d]]
            })
            .collect();
        let points =
            |z: f64| (0..101 * 101).map(move |n| Point::new(f64::from(n % 101), f64::from(n / 101), z));
        let [low, high] = [0.0, 1.0].map(|z| points(z).collect::<Vec<_>>());
        let square = |positions| Triangles { positions, triangles: &triangles };
        let hearing = Hearing::default();
        let distances = Distances::between(square(&low), square(&high), &hearing).unwrap();
        assert_eq!(distances.hausdorff(), 1.0);
        let told = hearing.0.into_inner().unwrap();
        assert!(told.is_sorted() && told.first() == Some(&0.0) && told.last() == Some(&1.0), "{told:?}");
        let step = told.windows(2).map(|pair| pair[1] - pair[0]).fold(0.0, f64::max);
        assert!(step < 0.15, "{told:?}");
    }

    #[test]
    fn of_two_pairs_together() {
        let one = between(&corners(0.0), &corners(2.0));
        let two = one.joined(&between(&corners(0.0), &corners(1.0)));
        let Distance { max, mean, rms, farthest, samples } = two.mesh_to_surface;
        assert_eq!((max, mean, farthest, samples), (2.0, 1.5, one.mesh_to_surface.farthest, 28));
        assert!((rms - 2.5_f64.sqrt()).abs() < 1e-12);
        assert_eq!(Distances::none().joined(&one), one);
    }

    #[test]
    fn samples_beyond_a_limit() {
        let (mesh, surface) = (corners(0.0), corners(2.0));
        let triangle = |positions| Triangles { positions, triangles: &[[0, 1, 2]] };
        let measured = |limit| {
            let surface = triangle(&surface);
            let search = surface.search(&Silent).unwrap();
            let distance = |p: Point| search.distance(p);
            Distances::with_samples_beyond(limit, triangle(&mesh), (surface, &distance), &Silent).unwrap()
        };
        let (distances, beyond) = measured(1.9);
        assert_eq!(distances, between(&mesh, &surface));
        let mut of_mesh: Vec<Point> = Vec::new();
        let edge = triangle(&mesh).mean_side();
        triangle(&mesh).sample(edge, &Silent, &mut |batch, _| of_mesh.extend(batch)).unwrap();
        let of_surface: Vec<_> = of_mesh.iter().map(|p| p.with_z(2.0)).collect();
        assert_eq!(beyond, [of_mesh, of_surface].concat());
        assert_eq!(measured(2.0).1, []);
    }

    #[test]
    fn of_a_part_and_the_whole() {
        let mut half = corners(0.0);
        half[1].x = 1.0;
        let distances = between(&half, &corners(0.0));
        assert!(distances.mesh_to_surface.max < 1e-12);
        assert!(distances.surface_to_mesh.max > 1.0);
        assert_eq!(distances.hausdorff(), distances.surface_to_mesh.max);
        assert_eq!(distances.farthest(), Point::from(distances.surface_to_mesh.farthest));
        let other_way = between(&corners(0.0), &half);
        assert_eq!(other_way.farthest(), Point::from(other_way.mesh_to_surface.farthest));
    }

    /// A long triangle with an end at a small quad.
    #[test]
    fn a_surface_is_measured_from_quads() {
        let quad = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]].map(|[x, y]| Point::new(x, y, 0.0));
        let mesh = Quads { positions: &quad, quads: &[[0, 1, 2, 3].map(NodeId)] };
        let long = [[0.5, 0.0], [9.0, 0.5], [0.5, 1.0]].map(|[x, y]| Point::new(x, y, 0.25));
        let surface = Triangles { positions: &long, triangles: &[[0, 1, 2]] };
        let far = farthest_from_quads(surface, mesh, 1.0, &Silent).unwrap();
        assert!((far - f64::hypot(8.0, 0.25)).abs() < 1e-12, "{far}");
    }
}
