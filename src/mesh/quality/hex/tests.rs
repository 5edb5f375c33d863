use super::*;
use crate::mesh::NodeId;
use crate::mesh::numbering::hex::{CORNERS, SYMMETRIES};

fn cube() -> [Point; 8] {
    CORNERS.map(|c| Point::from(c.map(f64::from)))
}

#[track_caller]
fn near(got: f64, expected: f64) {
    assert!((got - expected).abs() < 1e-12 * expected.abs().max(1.0), "{got} is not {expected}");
}

#[test]
fn a_cube_is_perfect_however_it_is_numbered() {
    for (s, symmetry) in SYMMETRIES.into_iter().enumerate() {
        let mut corners = [Point::ZERO; 8];
        for k in 0..8 {
            corners[usize::from(symmetry[k])] = 3.0 * cube()[k];
        }
        let sign = if s < 24 { 1.0 } else { -1.0 };
        assert_eq!(corner_scaled_jacobians(&corners), [sign; 8]);
        near(hex_volume(&corners), 27.0 * sign);
        near(aspect(&corners), 1.0);
    }
}

#[test]
fn a_shear_by_60_degrees() {
    let h = 0.75f64.sqrt();
    let corners = cube().map(|p| Point::new(p.x + 0.5 * p.y, h * p.y, 2.0 * p.z));
    corner_scaled_jacobians(&corners).into_iter().for_each(|sj| near(sj, h));
    near(hex_volume(&corners), 2.0 * h);
    near(aspect(&corners), 2.0);
}

#[test]
fn one_bad_corner_is_found_wherever_it_is() {
    for k in 0..8 {
        let mut corners = cube();
        corners[k] = Point::splat(0.5) * 1.5 + corners[k] * -0.5;
        let jacobians = corner_scaled_jacobians(&corners);
        assert!(jacobians[k] < 0.0, "corner {k}: {jacobians:?}");
        assert_eq!(scaled_jacobian(&corners), jacobians.into_iter().fold(1.0, f64::min));
    }
}

/// A frustum: the top is a square of half the side.
#[test]
fn the_volume_of_a_frustum() {
    let corners = cube().map(|p| {
        let side = 1.0 - 0.5 * p.z;
        Point::new(0.5 + side * (p.x - 0.5), 0.5 + side * (p.y - 0.5), p.z)
    });
    near(hex_volume(&corners), (1.0 + 0.5 + 0.25) / 3.0);
}

#[test]
fn a_collapsed_hex_has_the_largest_aspect() {
    let positions = vec![Point::ZERO; 8];
    let mesh = HexMesh { positions, hexes: vec![[0, 1, 2, 3, 4, 5, 6, 7].map(NodeId)], ..Default::default() };
    let quality = hex_quality(&mesh);
    assert_eq!((quality.scaled_jacobian[0], quality.aspect[0]), (0.0, f32::MAX));
    assert_eq!(quality.report().unwrap().not_positive, 1);
}

#[test]
fn the_report_has_the_same_bits_for_any_number_of_threads() {
    let n = 20u32;
    let wave = |i: u32| f64::from(i) + 0.1 * f64::from(i * i % 7);
    let node = |x: u32, y: u32, z: u32| NodeId(x + (n + 1) * (y + (n + 1) * z));
    let positions = (0..(n + 1).pow(3)).map(|i| {
        let [x, y, z] = [i % (n + 1), i / (n + 1) % (n + 1), i / (n + 1).pow(2)];
        Point::new(wave(x + y), wave(y + z), wave(z))
    });
    let hexes = (0..n.pow(3)).map(|i| {
        let [x, y, z] = [i % n, i / n % n, i / (n * n)];
        CORNERS.map(|c| {
            let [dx, dy, dz] = c.map(u32::from);
            node(x + dx, y + dy, z + dz)
        })
    });
    let mesh = HexMesh { positions: positions.collect(), hexes: hexes.collect(), ..Default::default() };
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| hex_quality(&mesh).report().unwrap())
    };
    let one = with(1);
    assert_eq!(one, with(3));
    assert_eq!(one.scaled_jacobian.histogram.counts.iter().sum::<u32>(), n.pow(3));
    assert!(serde_json::to_value(&one).unwrap()["scaledJacobian"]["percentile1"].is_number());
    assert_eq!(HexQuality::default().report(), None);
}
