//! Small backgrounds for tests.

use crate::Silent;
use crate::geometry::{Aabb, Point};
use crate::mesh::{GridOptions, HexMesh, hex_grid};
use crate::refine::hex::{HexOptions, Method, refine_hexes};
use crate::sizing::{Region, Shape, Target};

/// Cubes of edge 1 from the origin on.
pub(super) fn cubes(counts: [u32; 3]) -> HexMesh {
    let max = Point::from(counts.map(f64::from));
    let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 10_000 };
    hex_grid(Aabb { min: Point::ZERO, max }, &options).unwrap()
}

/// Cubes refined by Method II around a place: cells of many valences.
pub(super) fn refined_cubes() -> HexMesh {
    let shape = Shape::Sphere { center: Point::new(2.0, 2.0, 1.0), radius: 0.7 };
    let options = HexOptions {
        method: Method::Two,
        regions: vec![Region { shape, target: Target::Level(2) }],
        ..Default::default()
    };
    refine_hexes(&cubes([4, 4, 4]), &options, &Silent).unwrap().mesh
}

/// A number from 0 to 1 for each pair of numbers.
pub(super) fn noise(a: usize, b: usize) -> f64 {
    let mixed = (a as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15)
        ^ (b as u64 + 1).wrapping_mul(0xd1b5_4a32_d192_ed03);
    (mixed.wrapping_mul(0xff51_afd7_ed55_8ccd) >> 40) as f64 / (1u64 << 24) as f64
}

/// Stops at once.
pub(super) struct Stop;

impl crate::Monitor for Stop {
    fn progress(&self, _: crate::Stage, _: f64) {}
    fn cancelled(&self) -> bool {
        true
    }
}
