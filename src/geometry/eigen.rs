//! Eigenvalues and eigenvectors of symmetric 3 x 3 matrices.

use glam::DMat3;

use super::Point;

/// Sweeps after which Jacobi's method stands still for any 3 x 3 matrix: it converges quadratically.
const SWEEPS: usize = 12;

/// The eigenvalues of a symmetric matrix, ascending, and their unit eigenvectors, by Jacobi's rotations.
pub fn symmetric_eigen(matrix: DMat3) -> [(f64, Point); 3] {
    let (mut m, mut vectors) = (matrix, DMat3::IDENTITY);
    for (p, q) in [(0, 1), (0, 2), (1, 2)].repeat(SWEEPS) {
        let beside = m.col(q)[p];
        if beside == 0.0 {
            continue;
        }
        let theta = (m.col(q)[q] - m.col(p)[p]) / (2.0 * beside);
        let tangent = theta.signum() / (theta.abs() + (theta * theta + 1.0).sqrt());
        let cosine = 1.0 / (tangent * tangent + 1.0).sqrt();
        let mut turn = DMat3::IDENTITY;
        turn.col_mut(p)[p] = cosine;
        turn.col_mut(q)[q] = cosine;
        turn.col_mut(q)[p] = tangent * cosine;
        turn.col_mut(p)[q] = -tangent * cosine;
        m = turn.transpose() * m * turn;
        vectors *= turn;
    }
    let mut pairs = [0, 1, 2].map(|i| (m.col(i)[i], vectors.col(i)));
    pairs.sort_by(|a, b| a.0.total_cmp(&b.0));
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn diagonal_matrices_have_the_axes() {
        let pairs = symmetric_eigen(DMat3::from_diagonal(Point::new(3.0, 1.0, 2.0)));
        assert_eq!(pairs, [(1.0, Point::Y), (2.0, Point::Z), (3.0, Point::X)]);
        assert_eq!(symmetric_eigen(DMat3::ZERO).map(|p| p.0), [0.0; 3]);
    }

    #[cfg(not(target_arch = "wasm32"))]
    proptest::proptest! {
        #[test]
        fn they_make_up_the_matrix(m in crate::geometry::samples::points::<3>(1.0), scale in -9..9) {
            let m = DMat3::from_cols(m[0], m[1], m[2]) * 10.0_f64.powi(scale);
            let m = m + m.transpose();
            let pairs = symmetric_eigen(m);
            let made: DMat3 = pairs
                .iter()
                .map(|&(value, v)| DMat3::from_cols(v * v.x, v * v.y, v * v.z) * value)
                .fold(DMat3::ZERO, |a, b| a + b);
            let size = 10.0_f64.powi(scale);
            proptest::prop_assert!((made - m).to_cols_array().iter().all(|d| d.abs() < 1e-13 * size));
            proptest::prop_assert!(pairs[0].0 <= pairs[1].0 && pairs[1].0 <= pairs[2].0);
        }
    }
}
