//! The Jacobian of hexes of the second order, everywhere inside them.
//!
//! Coordinates have degree 2 in each of the three parameters, so the determinant has degree 5 in each. It is written in
//! Bernstein's basis, with 216 coefficients: no value is below the least of them, and those at the corners are values.
//! As Johnen, Remacle, Geuzaine, *Geometrical validity of curvilinear finite elements* (2013), with the coefficients as
//! products of polynomials instead of from samples.

use super::bernstein::JacobianBound;
use crate::geometry::Point;
use crate::mesh::second_order::LATTICE;

/// Encloses the least value of the Jacobian determinant of a hex of 27 nodes, in the order of
/// [`SecondOrder::nodes`](crate::mesh::SecondOrder::nodes). One of 20 nodes is one of 27 whose others are where those at
/// edges and corners would have them. The lower number may be far below: it is not refined.
pub fn second_order_jacobian(nodes: &[Point; 27]) -> JacobianBound {
    let along = derivatives(&scaled(nodes));
    // The product of polynomials adds up their degrees: (2, 1, 2) and (2, 2, 1) to (4, 3, 3), with (1, 2, 2) to 5 each.
    let mut area = [Point::ZERO; 5 * 4 * 4];
    for (b, [bx, by, bz]) in places([3, 2, 3]) {
        for (c, [cx, cy, cz]) in places([3, 3, 2]) {
            area[bx + cx + 5 * (by + cy + 4 * (bz + cz))] += along[1][b].cross(along[2][c]);
        }
    }
    let mut products = [0.0; 216];
    for (a, [ax, ay, az]) in places([2, 3, 3]) {
        for (s, [sx, sy, sz]) in places([5, 4, 4]) {
            products[ax + sx + 6 * (ay + sy + 6 * (az + sz))] += along[0][a].dot(area[s]);
        }
    }
    let mut bound = JacobianBound { lower: f64::INFINITY, upper: f64::INFINITY };
    for (k, place) in places([6; 3]) {
        let value = products[k] / place.iter().map(|&i| BINOMIAL[i]).product::<f64>();
        // Written so that a number that is none is the least.
        if value < bound.lower || value.is_nan() {
            bound.lower = value;
        }
        if place.iter().all(|i| [0, 5].contains(i)) && (value < bound.upper || value.is_nan()) {
            bound.upper = value;
        }
    }
    bound
}

/// 5 over i.
const BINOMIAL: [f64; 6] = [1.0, 5.0, 10.0, 10.0, 5.0, 1.0];

/// The indices of a table of so many entries along x, y and z, each with its place in it.
fn places(size: [usize; 3]) -> impl Iterator<Item = (usize, [usize; 3])> {
    let [nx, ny, nz] = size;
    (0..nx * ny * nz).map(move |k| (k, [k % nx, k / nx % ny, k / (nx * ny)]))
}

/// The coordinates' coefficients times the binomial coefficients: sums of these times t^i (1 - t)^(2 - i), whose products
/// are those of plain polynomials.
fn scaled(nodes: &[Point; 27]) -> [Point; 27] {
    let mut at = [Point::ZERO; 27];
    for (node, place) in nodes.iter().zip(LATTICE) {
        at[place] = *node;
    }
    for stride in [1_usize, 3, 9] {
        for first in (0..27_usize).filter(|k| (k / stride).is_multiple_of(3)) {
            let ends = at[first] + at[first + 2 * stride];
            at[first + stride] = at[first + stride] * 4.0 - ends;
        }
    }
    at
}

/// The derivatives along x, y and z, of degree 1 along their own axis, scaled likewise; the last entries of each table
/// are not used.
fn derivatives(scaled: &[Point; 27]) -> [[Point; 18]; 3] {
    std::array::from_fn(|axis| {
        let stride = [1, 3, 9][axis];
        let mut size = [3; 3];
        size[axis] = 2;
        let mut along = [Point::ZERO; 18];
        for (k, [x, y, z]) in places(size) {
            let first = x + 3 * y + 9 * z;
            // 2 (b1 - b0) or 2 (b2 - b1), where the middle coefficient is scaled by 2.
            let is_upper = [x, y, z][axis] == 1;
            let (from, to) = (scaled[first], scaled[first + stride]);
            along[k] = if is_upper { to * 2.0 - from } else { to - from * 2.0 };
        }
        along
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::numbering::hex::{CORNERS, EDGES, FACES, NEIGHBOURS};
    use crate::mesh::quality::min_jacobian_bound;

    /// The 27 nodes of a trilinear hex.
    fn straight(corners: &[Point; 8]) -> [Point; 27] {
        let mean = |of: &[u8]| of.iter().map(|&c| corners[usize::from(c)]).sum::<Point>() / of.len() as f64;
        let mut nodes = [mean(&[0, 1, 2, 3, 4, 5, 6, 7]); 27];
        nodes[..8].copy_from_slice(corners);
        EDGES.iter().enumerate().for_each(|(e, ends)| nodes[8 + e] = mean(ends));
        let faces = [5, 3, 2, 4, 0, 1].map(|f: usize| FACES[f]);
        faces.iter().enumerate().for_each(|(f, around)| nodes[20 + f] = mean(around));
        nodes
    }

    /// The determinant at x, y, z, from differences of the interpolated position.
    fn determinant(nodes: &[Point; 27], at: [f64; 3]) -> f64 {
        let shape =
            |i: usize, t: f64| [2.0 * (t - 0.5) * (t - 1.0), 4.0 * t * (1.0 - t), 2.0 * t * (t - 0.5)][i];
        let position = |[x, y, z]: [f64; 3]| {
            let of = |(node, place): (&Point, usize)| {
                *node * (shape(place % 3, x) * shape(place / 3 % 3, y) * shape(place / 9, z))
            };
            nodes.iter().zip(LATTICE).map(of).sum::<Point>()
        };
        let along = |axis: usize| {
            let mut ends = [at; 2];
            ends[0][axis] -= 1e-5;
            ends[1][axis] += 1e-5;
            (position(ends[1]) - position(ends[0])) / 2e-5
        };
        along(0).dot(along(1).cross(along(2)))
    }

    /// A cube whose corners and other nodes are moved by up to `most`, by a linear congruence.
    fn shaken(seed: u64, most: f64) -> [Point; 27] {
        let mut state = seed;
        let mut next = || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
            ((state >> 33) as f64 / (1u64 << 31) as f64 * 2.0 - 1.0) * most
        };
        straight(&CORNERS.map(|c| Point::from(c.map(f64::from))))
            .map(|p| p + Point::new(next(), next(), next()))
    }

    #[test]
    fn straight_hexes_have_the_bound_of_trilinear_ones() {
        for seed in 0..50 {
            let corners: [Point; 8] = shaken(seed, 0.3)[..8].try_into().unwrap();
            let (ours, theirs) = (second_order_jacobian(&straight(&corners)), min_jacobian_bound(&corners));
            assert!(
                ours.lower <= theirs.upper + 1e-12 && ours.upper >= theirs.lower - 1e-12,
                "{seed}: {ours:?} {theirs:?}"
            );
            assert!((ours.upper - at_corners(&corners)).abs() < 1e-12, "{seed}");
        }
    }

    /// The least determinant at the corners.
    fn at_corners(corners: &[Point; 8]) -> f64 {
        let at = |c: usize| {
            let [a, b, d] = NEIGHBOURS[c].map(|n| corners[usize::from(n)] - corners[c]);
            a.dot(b.cross(d))
        };
        (0..8).map(at).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn no_value_is_below_the_bound() {
        let mut decided = 0;
        for seed in 0..40 {
            let nodes = shaken(seed, 0.12);
            let bound = second_order_jacobian(&nodes);
            decided += usize::from(bound.lower > 0.0);
            for k in 0..125_usize {
                let at = [k % 5, k / 5 % 5, k / 25].map(|i| i as f64 / 4.0);
                let value = determinant(&nodes, at);
                assert!(value >= bound.lower - 1e-6, "{seed} {at:?}: {value} {bound:?}");
            }
        }
        assert!((5..40).contains(&decided), "{decided}");
    }
}
