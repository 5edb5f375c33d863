//! How far a mesh and a surface are from each other.

use hexmill::geometry::{NearestTriangle, Point};
use hexmill::parallel;
use serde::Serialize;

/// A surface of triangles.
pub(crate) struct Triangles {
    pub(crate) positions: Vec<Point>,
    pub(crate) triangles: Vec<[u32; 3]>,
}

/// Distances both ways: small one way alone may mean that the mesh covers but a part of the surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Distances {
    pub(crate) mesh_to_surface: Distance,
    pub(crate) surface_to_mesh: Distance,
}

/// Distances of samples of one surface, its nodes and the centroids of its triangles, to another surface.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "camelCase")]
pub(crate) struct Distance {
    pub(crate) max: f64,
    pub(crate) mean: f64,
    /// Root of the mean square.
    pub(crate) rms: f64,
    /// The sample of the greatest distance.
    pub(crate) farthest: [f64; 3],
    samples: usize,
}

impl Distances {
    /// Measures; both surfaces have triangles.
    pub(crate) fn between(mesh: &Triangles, surface: &Triangles) -> Self {
        Self {
            mesh_to_surface: Distance::from_to(mesh, surface),
            surface_to_mesh: Distance::from_to(surface, mesh),
        }
    }
}

impl Triangles {
    fn corners(&self) -> impl Iterator<Item = [Point; 3]> {
        self.triangles.iter().map(|t| t.map(|n| self.positions[n as usize]))
    }

    /// The nodes in use and the centroids.
    fn samples(&self) -> Vec<Point> {
        let mut used = vec![false; self.positions.len()];
        for &node in self.triangles.as_flattened() {
            used[node as usize] = true;
        }
        let nodes = self.positions.iter().zip(used).filter(|(_, used)| *used).map(|(p, _)| *p);
        nodes.chain(self.corners().map(|[a, b, c]| (a + b + c) / 3.0)).collect()
    }
}

impl Distance {
    fn from_to(from: &Triangles, to: &Triangles) -> Self {
        let nearest = NearestTriangle::new(to.corners());
        let samples = from.samples();
        let distance = |p: Point| nearest.closest_point(p).map_or(f64::INFINITY, |q| q.distance(p));
        let distances: Vec<f64> = parallel::collect(samples.len(), |k| distance(samples[k]));
        let farthest = (0..samples.len()).max_by(|&i, &j| distances[i].total_cmp(&distances[j]));
        let count = samples.len() as f64;
        Self {
            max: farthest.map_or(0.0, |i| distances[i]),
            mean: distances.iter().sum::<f64>() / count,
            rms: (distances.iter().map(|d| d * d).sum::<f64>() / count).sqrt(),
            farthest: farthest.map_or([0.0; 3], |i| samples[i].to_array()),
            samples: samples.len(),
        }
    }

    /// In a line.
    pub(crate) fn in_words(&self) -> String {
        let [x, y, z] = self.farthest;
        format!("mean {:.6e}, rms {:.6e}, greatest {:.6e} at {x}, {y}, {z}", self.mean, self.rms, self.max)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A right triangle of legs 3 in the plane at height `z`.
    fn triangle(z: f64) -> Triangles {
        let positions = [[0.0, 0.0], [3.0, 0.0], [0.0, 3.0], [9.0, 9.0]];
        Triangles {
            positions: positions.map(|[x, y]| Point::new(x, y, z)).to_vec(),
            triangles: vec![[0, 1, 2]],
        }
    }

    #[test]
    fn of_parallel_triangles() {
        let distances = Distances::between(&triangle(0.0), &triangle(2.0));
        assert_eq!(
            distances.mesh_to_surface,
            Distance { max: 2.0, mean: 2.0, rms: 2.0, farthest: [1.0, 1.0, 0.0], samples: 4 }
        );
        assert_eq!(distances.surface_to_mesh.max, 2.0);
    }

    #[test]
    fn of_a_part_and_the_whole() {
        let mut half = triangle(0.0);
        half.positions[1].x = 1.0;
        let distances = Distances::between(&half, &triangle(0.0));
        assert_eq!(distances.mesh_to_surface.max, 0.0);
        assert!(distances.surface_to_mesh.max > 1.0);
    }
}
