//! A curved boundary.

use super::*;

/// A ball of radius 1 from a grid: each shell of the cube becomes a sphere.
fn ball(n: u32) -> (Vec<Point>, Vec<[NodeId; 8]>) {
    let (mut positions, hexes) = grid(n);
    for p in &mut positions {
        let q = *p * (2.0 / f64::from(n)) - Point::ONE;
        *p = q.normalize_or_zero() * q.abs().max_element();
    }
    (positions, hexes)
}

/// How deep below the unit sphere triangles of the boundary's nodes reach.
fn sagitta(boundary: &QuadMesh) -> f64 {
    let corners = boundary
        .quads
        .iter()
        .flat_map(|q| [[0, 1, 2], [0, 2, 3], [0, 1, 3], [1, 2, 3]].map(|t| t.map(|k: usize| q[k])));
    let depth = corners.map(|t| {
        let [a, b, c] = t.map(|n| boundary.positions[n.index()]);
        1.0 - (b - a).cross(c - a).normalize().dot(a).abs()
    });
    depth.fold(0.0, f64::max)
}

#[test]
fn nodes_of_a_sphere_slide_on_it() {
    let (input, hexes) = ball(8);
    let surface = boundary(&input, &hexes);
    let deepest = sagitta(&surface);
    let mut noise = Noise(3);
    // Inside at random, and not on the boundary: there the optimiser starts from the surface.
    let mut positions: Vec<Point> =
        input.iter().map(|p| if p.length() > 0.99 { *p } else { *p + 0.15 * noise.point() }).collect();
    assert!(measured(&positions, &hexes).report().unwrap().not_positive > 0);
    let report = optimized(&input, &mut positions, &hexes, &vec![true; input.len()]);
    assert_eq!(report.inverted, []);
    assert!(report.off_boundary < 1e-12, "{report:?}");
    let mut slid = 0;
    for (p, q) in input.iter().zip(&positions).filter(|(p, _)| p.length() > 0.99) {
        assert!((1.0 - deepest - 1e-12..=1.0 + 1e-12).contains(&q.length()), "{p} went to {q}");
        slid += usize::from(p.distance(*q) > 1e-3);
    }
    assert!(slid > 100, "only {slid} boundary nodes moved");
    let untouched = measured(&input, &hexes).report().unwrap().scaled_jacobian.summary.min;
    assert!(report.worst_after.unwrap() > f64::from(untouched), "{untouched} {report:?}");
}

/// The upper half of the ball: nodes of the rim stay on the rim.
#[test]
fn nodes_of_a_curved_ridge_slide_along_it() {
    let (input, hexes) = ball(8);
    let hexes: Vec<[NodeId; 8]> =
        hexes.into_iter().filter(|h| h.iter().all(|n| input[n.index()].z > -1e-9)).collect();
    let mut noise = Noise(5);
    let mut positions: Vec<Point> = input
        .iter()
        .map(|p| if p.length() > 0.99 || p.z.abs() < 1e-9 { *p } else { *p + 0.08 * noise.point() })
        .collect();
    let report = optimized(&input, &mut positions, &hexes, &vec![true; input.len()]);
    assert_eq!(report.inverted, []);
    let deepest = sagitta(&boundary(&input, &hexes).only_curved());
    let mut rim = 0;
    for (p, q) in input.iter().zip(&positions) {
        if p.z.abs() < 1e-9 {
            assert!(q.z.abs() < 1e-12, "{p} left the plane for {q}");
        }
        if p.length() > 0.99 && p.z > -1e-9 {
            assert!((q.length() - 1.0).abs() <= deepest + 1e-12, "{p} went to {q}");
            rim += usize::from(p.z.abs() < 1e-9);
        }
    }
    assert_eq!(rim, 32);
}

trait Curved {
    /// The faces whose nodes lie on the sphere.
    fn only_curved(self) -> Self;
}

impl Curved for QuadMesh {
    fn only_curved(mut self) -> Self {
        let Self { positions, quads } = &mut self;
        quads.retain(|q| q.iter().all(|n| positions[n.index()].length() > 0.99));
        self
    }
}
