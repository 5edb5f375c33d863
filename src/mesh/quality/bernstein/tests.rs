use super::*;
use crate::mesh::numbering::hex::CORNERS;
use crate::mesh::quality::corner_scaled_jacobians;

fn cube() -> [Point; 8] {
    CORNERS.map(|c| Point::from(c.map(f64::from)))
}

/// The determinant at x, y, z, from the derivatives of the trilinear map.
fn determinant(corners: &[Point; 8], [x, y, z]: [f64; 3]) -> f64 {
    let edges = Edges::of(corners);
    let mix =
        |e: &[[Point; 2]; 2], s: f64, t: f64| e[0][0].lerp(e[0][1], t).lerp(e[1][0].lerp(e[1][1], t), s);
    mix(&edges.x, y, z).dot(mix(&edges.y, x, z).cross(mix(&edges.z, x, y)))
}

/// The top turned by `degrees` about the vertical through its centre.
fn twisted(degrees: f64) -> [Point; 8] {
    let (sine, cosine) = libm::sincos(degrees.to_radians());
    let mut corners = cube();
    for p in &mut corners[4..] {
        let (x, y) = (p.x - 0.5, p.y - 0.5);
        *p = Point::new(0.5 + cosine * x - sine * y, 0.5 + sine * x + cosine * y, p.z);
    }
    corners
}

/// The top turned by half a turn and twice as long in x: at height z the hex is 1 - 3z long and 1 - 2z wide, so its
/// corners are positive, and between a third and half of its height it is inside out.
fn turned_over() -> [Point; 8] {
    let mut corners = cube();
    for p in &mut corners[4..] {
        *p = Point::new(1.0 - 2.0 * p.x, 1.0 - p.y, p.z);
    }
    corners
}

#[test]
fn the_bound_encloses_what_sampling_finds() {
    for corners in [cube(), twisted(40.0), twisted(75.0), twisted(120.0), turned_over()] {
        let bound = min_jacobian_bound(&corners);
        let n = 20;
        let at = |i: usize| i as f64 / n as f64;
        let sampled = (0..(n + 1) * (n + 1) * (n + 1))
            .map(|s| {
                determinant(&corners, [at(s % (n + 1)), at(s / (n + 1) % (n + 1)), at(s / (n + 1) / (n + 1))])
            })
            .fold(f64::INFINITY, f64::min);
        assert!(bound.lower <= sampled + 1e-12, "{bound:?} {sampled}");
        assert!(bound.upper <= sampled + 0.02 && bound.lower <= bound.upper, "{bound:?} {sampled}");
        assert!(bound.upper - bound.lower < 0.02, "{bound:?}");
    }
}

#[test]
fn a_hex_positive_at_its_corners_alone_is_seen() {
    let corners = turned_over();
    assert!(corner_scaled_jacobians(&corners).iter().all(|&sj| sj > 0.1));
    assert_eq!(is_positive(&corners), Certainty::NotPositive);
    // (1 - 3z)(1 - 2z) is least at z = 5/12.
    let bound = min_jacobian_bound(&corners);
    let least = -1.0 / 24.0;
    assert!(bound.lower <= least + 1e-12 && bound.upper >= least - 1e-12, "{bound:?}");
    assert!(bound.upper - bound.lower < 0.01, "{bound:?}");
}

/// At height z the sides are turned, and the section's area is 1 - 2z(1 - z)(1 - cos): positive until half a turn.
#[test]
fn a_twist_is_positive_until_half_a_turn() {
    for degrees in [0.0, 45.0, 90.0, 135.0, 170.0] {
        assert_eq!(is_positive(&twisted(degrees)), Certainty::Positive, "{degrees} degrees");
    }
    assert_ne!(is_positive(&twisted(180.0)), Certainty::Positive);
}

#[test]
fn subdivision_decides_where_the_coefficients_do_not() {
    let mut asked = 0;
    for tenth in 0..1800 {
        let corners = twisted(f64::from(tenth) / 10.0);
        let whole = Part::of(&corners);
        if whole.least() <= 0.0
            && whole.ends().all(|v| v > 1e-3)
            && is_positive(&corners) != Certainty::Undecided
        {
            asked += 1;
        }
    }
    assert!(asked > 0, "no twist needs a subdivision");
}

#[test]
fn flat_and_broken_hexes_are_not_positive() {
    let flat = cube().map(|p| Point::new(p.x, p.y, 0.0));
    assert_eq!(is_positive(&flat), Certainty::NotPositive);
    assert_eq!(is_positive(&[Point::ZERO; 8]), Certainty::NotPositive);
    assert_eq!(is_positive(&[Point::NAN; 8]), Certainty::NotPositive);
    let mirrored = cube().map(|p| Point::new(-p.x, p.y, p.z));
    assert_eq!(is_positive(&mirrored), Certainty::NotPositive);
}

#[test]
fn the_verdict_does_not_depend_on_size() {
    for scale in [1e-60, 1e-9, 1.0, 1e60] {
        assert_eq!(is_positive(&twisted(60.0).map(|p| p * scale)), Certainty::Positive);
        assert_eq!(is_positive(&turned_over().map(|p| p * scale)), Certainty::NotPositive);
    }
}
