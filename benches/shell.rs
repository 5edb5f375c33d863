//! A shell refined in cubes: what is measured of hexes.

use hexmill::geometry::{Aabb, Point};
use hexmill::mesh::{GridOptions, HexMesh, hex_grid};
use hexmill::refine::hex::{HexOptions, Method};
use hexmill::sizing::{Region, Shape, Target};

/// Names of the sizes, by the hexes that Method II makes; cubes an axis; levels.
pub const SIZES: [(&str, u32, u8); 2] = [("0.1M", 4, 4), ("1M", 6, 5)];

/// `n` unit cubes an axis.
pub fn cubes(n: u32) -> HexMesh {
    let bounds = Aabb { min: Point::ZERO, max: Point::splat(f64::from(n)) };
    let options = GridOptions { spacing: 1.0, margin: 0.0, fitted: false, max_hexes: 1 << 24 };
    hex_grid(bounds, &options).expect("a small grid")
}

/// Refines to a level what a sphere of 0.35 of the cubes' extent passes.
pub fn shell(n: u32, level: u8, method: Method) -> HexOptions {
    let (middle, radius) = (Point::splat(0.5 * f64::from(n)), 0.35 * f64::from(n));
    let (around, along) = (256u32, 128u32);
    let at = |i: u32, j: u32| {
        let turn = |k: u32, of: u32| std::f64::consts::PI * f64::from(k) / f64::from(of);
        let (polar, azimuth) = (turn(i, along), 2.0 * turn(j, around));
        let (up, out) = (libm::cos(polar), libm::sin(polar));
        middle + radius * Point::new(out * libm::cos(azimuth), out * libm::sin(azimuth), up)
    };
    let positions = (0..=along).flat_map(|i| (0..around).map(move |j| at(i, j))).collect();
    let id = |i: u32, j: u32| i * around + j % around;
    let triangles = (0..along).flat_map(|i| {
        (0..around).flat_map(move |j| {
            [[id(i, j), id(i + 1, j), id(i + 1, j + 1)], [id(i, j), id(i + 1, j + 1), id(i, j + 1)]]
        })
    });
    let shape = Shape::Surface { positions, triangles: triangles.collect(), distance: 0.0 };
    HexOptions {
        method,
        regions: vec![Region { shape, target: Target::Level(level) }],
        ..HexOptions::default()
    }
}
