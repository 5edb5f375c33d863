//! Untangling and smoothing of hex meshes.

mod ball;
mod grids;
mod layers;
mod pillow;
mod promises;

use hexmill::Silent;
use hexmill::geometry::Point;
use hexmill::mesh::numbering::hex::CORNERS;
use hexmill::mesh::quality::{HexQuality, hex_quality};
use hexmill::mesh::topology::hex_boundary;
use hexmill::mesh::{HexMesh, NodeId, QuadMesh};
use hexmill::optimize::{BoundarySurface, Constraints, OptimizeOptions, OptimizeReport, optimize};

/// Faces of a boundary that meet at more than this make a ridge.
const RIDGE_DEGREES: f64 = 35.0;

/// Numbers from -1 to 1 that look random.
struct Noise(u64);

impl Noise {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as f64 / f64::from(1 << 30) - 1.0
    }

    fn point(&mut self) -> Point {
        Point::new(self.next(), self.next(), self.next())
    }
}

/// `n` cells a side, unit cubes.
fn grid(n: u32) -> (Vec<Point>, Vec<[NodeId; 8]>) {
    let m = n + 1;
    let positions = (0..m.pow(3)).map(|i| [i % m, i / m % m, i / (m * m)].map(f64::from).into());
    let hexes = (0..n.pow(3)).map(|i| {
        CORNERS.map(|c| {
            let [x, y, z] =
                [i % n + u32::from(c[0]), i / n % n + u32::from(c[1]), i / (n * n) + u32::from(c[2])];
            NodeId(x + m * (y + m * z))
        })
    });
    (positions.collect(), hexes.collect())
}

fn boundary(positions: &[Point], hexes: &[[NodeId; 8]]) -> QuadMesh {
    QuadMesh {
        positions: positions.to_vec(),
        quads: hex_boundary(hexes).into_iter().map(|(q, _)| q).collect(),
    }
}

fn measured(positions: &[Point], hexes: &[[NodeId; 8]]) -> HexQuality {
    hex_quality(&HexMesh { positions: positions.to_vec(), hexes: hexes.to_vec(), ..Default::default() })
}

/// Optimises with the default options, on the boundary of `input`.
fn optimized(
    input: &[Point],
    positions: &mut [Point],
    hexes: &[[NodeId; 8]],
    movable: &[bool],
) -> OptimizeReport {
    let surface = BoundarySurface::new(&boundary(input, hexes), RIDGE_DEGREES);
    let constraints = Constraints::of_hexes(input, hexes, &surface);
    optimize(positions, hexes, movable, &constraints, &OptimizeOptions::default(), &Silent)
        .expect("not cancelled")
}
