//! How many hexes are told before the work.

use hexmill::Silent;
use hexmill::geometry::Point;
use hexmill::hexing::{HexingOptions, forecast_hexes};
use hexmill::io;
use hexmill::sizing::{Region, Shape, Target};
use hexmill::solid::{SolidModel, SolidOptions};

const CUBE: &[u8] = b"v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n\
    f 4 3 2 1\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

#[test]
fn regions_count_by_their_volume_in_the_solid_and_their_level() {
    let surface = io::obj::read(CUBE).unwrap().into_surface().unwrap();
    let (solid, _) = SolidModel::new(&surface, &SolidOptions::default(), &Silent).unwrap();
    let forecast = |targets: &[Target]| {
        let (min, max) = (Point::splat(0.5), Point::splat(9.0));
        let shape = Shape::Box { min, max, rotation: glam::DQuat::IDENTITY };
        let regions = targets.iter().map(|&target| Region { shape: shape.clone(), target }).collect();
        let options = HexingOptions { edge_length: 0.1, regions, ..HexingOptions::default() };
        forecast_hexes(&solid, &options, &Silent).unwrap().hexes
    };
    for (target, levels) in [(Target::Level(2), 2), (Target::Size(0.05), 1), (Target::Size(0.2), 0)] {
        let more = 125.0 * (8_f64.powi(levels) - 1.0);
        assert!((forecast(&[target]) - forecast(&[]) - more).abs() < 1e-6, "{target:?}");
    }
}
