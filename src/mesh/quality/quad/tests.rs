use super::*;

fn one_quad(points: [[f64; 3]; 4]) -> Measures {
    Measures::of(points.map(Point::from))
}

#[track_caller]
fn near(got: f64, expected: f64) {
    assert!((got - expected).abs() < 1e-12 * expected.abs().max(1.0), "{got} is not {expected}");
}

#[test]
fn a_square_is_perfect_wherever_it_lies() {
    for scale in [1e-9, 1.0, 1e9] {
        let square = [[0., 0., 0.], [0., 3., 4.], [-5., 3., 4.], [-5., 0., 0.]];
        let m = one_quad(square.map(|p| p.map(|x| scale * x)));
        near(m.scaled_jacobian, 1.0);
        near(m.min_angle, 90.0);
        near(m.max_angle, 90.0);
        near(m.aspect, 1.0);
    }
}

#[test]
fn a_rhombus_of_60_degrees() {
    let h = 0.75f64.sqrt();
    let m = one_quad([[0., 0., 0.], [1., 0., 0.], [1.5, h, 0.], [0.5, h, 0.]]);
    near(m.scaled_jacobian, h);
    near(m.min_angle, 60.0);
    near(m.max_angle, 120.0);
    near(m.aspect, 1.0 / h);
}

/// ```text
/// 3
/// | \       the corner at 2 is reflex: 270 degrees
/// |  2
/// 0---1
/// ```
#[test]
fn a_reflex_corner_has_a_negative_jacobian_and_an_angle_above_180() {
    let m = one_quad([[0., 0., 0.], [4., 0., 0.], [1., 1., 0.], [0., 4., 0.]]);
    assert!(m.scaled_jacobian < 0.0);
    near(m.max_angle, 360.0 - libm::acos(-0.6).to_degrees());
    near(m.min_angle, libm::acos(3.0 / 10f64.sqrt()).to_degrees());
}

#[test]
fn a_warped_quad_is_measured_against_its_mean_normal() {
    // All corners have the angle of (1, 0, z) and (0, 1, z) with z alternating: u.v = -z*z / (1 + z*z)
    let z = 0.5;
    let m = one_quad([[0., 0., 0.], [1., 0., z], [1., 1., 0.], [0., 1., z]]);
    near(m.scaled_jacobian, 1.0 / (1.0 + z * z));
}

#[test]
fn a_quad_without_area_has_jacobian_zero_and_the_largest_aspect() {
    let positions = [[0., 0., 0.], [1., 0., 0.], [2., 0., 0.], [3., 0., 0.]].map(Point::from).to_vec();
    let quads = vec![[0, 1, 2, 3].map(NodeId), [0; 4].map(NodeId)];
    let quality = quad_quality(&QuadMesh { positions, quads });
    assert_eq!(quality.scaled_jacobian, [0.0; 2]);
    assert_eq!(quality.aspect[0], f32::MAX);
    assert!(quality.min_angle.iter().all(|a| a.is_finite()));
}

#[test]
fn a_quad_that_is_a_triangle_keeps_its_other_angles() {
    let corners = [[0., 0., 0.], [0., 0., 0.], [1., 0., 0.], [0., 1., 0.]];
    for k in 0..4 {
        let m = one_quad(std::array::from_fn(|i| corners[(i + k) % 4]));
        near(m.min_angle, 0.0);
        near(m.max_angle, 45.0);
        near(m.scaled_jacobian, 0.0);
    }
}

#[test]
fn ranks_grow_with_angles() {
    let ranks =
        (0..360).map(|d| f64::from(d).to_radians()).map(|r| Turn { sine: r.sin(), cosine: r.cos() }.rank());
    assert!(ranks.collect::<Vec<_>>().windows(2).all(|w| w[0] < w[1]));
}

#[test]
fn the_same_bits_for_any_number_of_threads() {
    let n = 300u32;
    let wave = |i: u32| f64::from(i) + 0.3 * f64::from(i * i % 7);
    let positions =
        (0..=n).flat_map(|j| (0..=n).map(move |i| Point::new(wave(i + j), wave(2 * j), wave(i * j % 5))));
    let cells = (0..n).flat_map(|j| (0..n).map(move |i| j * (n + 1) + i));
    let mesh = QuadMesh {
        positions: positions.collect(),
        quads: cells.map(|a| [a, a + 1, a + n + 2, a + n + 1].map(NodeId)).collect(),
    };
    let with = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| quad_quality(&mesh).report().unwrap())
    };
    let one = with(1);
    assert_eq!(one, with(2));
    assert_eq!(one, with(5));
    assert_eq!(
        serde_json::to_value(&one).unwrap()["scaledJacobian"]["histogram"]["counts"]
            .as_array()
            .unwrap()
            .len(),
        40
    );
    assert!(serde_json::to_value(&one).unwrap()["minAngle"]["percentile1"].is_number());
}
